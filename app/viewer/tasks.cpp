// What of the viewer's doing takes its time, and giving it up.
#include "viewer/tasks.h"

#include "viewer/viewer.h"

namespace unshot {

std::vector<Task> Viewer::tasks() {
  std::vector<Task> out;
  if (state_->phase == SessionPhase::kLoading)
    out.push_back({state_->task, std::nullopt, "the scene before stays", [this] { giveUpLoading(); }});
  if (const auto since = screenshots_.began()) {
    const auto give_up = [this] {
      notice("given up: " + screenshots_.path().string());
      screenshots_.giveUp();
      scene_.endFiner();
    };
    out.push_back({"writing " + screenshots_.path().filename().string(), screenshots_.done(scene_),
                   "no file is written", give_up, *since});
  }
  return out;
}

bool Viewer::giveUp() {
  const std::vector<Task> all = tasks();
  if (all.empty()) return false;
  all.front().giveUp();
  input();
  return true;
}

}  // namespace unshot
