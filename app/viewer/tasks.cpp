// What of the viewer's doing takes its time, and giving it up.
#include "viewer/tasks.h"

#include "viewer/teaching.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

template <class Result>
Task taskOf(FileLoad<Result>& load) {
  return {"reading " + load.file().filename().string(), load.done(), "nothing else is compared with",
          [&load] { load.giveUp(); }, load.began()};
}

}  // namespace

std::vector<Task> Viewer::tasks() {
  std::vector<Task> out;
  if (state_->phase == SessionPhase::kLoading)
    out.push_back(
        {state_->task, state_->task_done, "the scene before stays", [this] { giveUpLoading(); }, 0});
  if (scene_.framing())
    out.push_back({"looking for a good view", scene_.framingDone(), "the best view so far",
                   [this] { scene_.hurryFraming(); }, scene_.framingBegan()});
  if (const auto since = screenshots_.began()) {
    const auto give_up = [this] {
      screenshots_.giveUp();
      scene_.endFiner();
    };
    out.push_back({"writing " + screenshots_.path().filename().string(), screenshots_.done(scene_),
                   "no file is written", give_up, *since});
  }
  if (reference_load_.underWay()) out.push_back(taskOf(reference_load_));
  if (picture_load_.underWay()) out.push_back(taskOf(picture_load_));
  if (state_->saving)
    out.push_back({state_->task, state_->task_done, "a file that is there stays as it was",
                   [this] { session_.giveUpSaving(); }, state_->task_began});
  if (state_->gathering)
    out.push_back({"gathering M", state_->gathering, "the lecture is closed",
                   [this] { teaching_->choices.lecture = false; }, state_->task_began});
  return out;
}

bool Viewer::giveUp() {
  const std::vector<Task> all = tasks();
  if (all.empty()) return false;
  giveUp(all.front());
  return true;
}

void Viewer::giveUp(const Task& task) {
  const std::string text = task.text;
  task.giveUp();
  passingNotice("given up: " + text);
}

}  // namespace unshot
