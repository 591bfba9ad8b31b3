// What of the viewer's doing takes its time, and giving it up.
#include "viewer/tasks.h"

#include <algorithm>

#include "base/clock.h"
#include "viewer/teaching.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr double kDecodingShare = 0.8;  // of the time that a reference picture takes

template <class Result>
Task taskOf(FileLoad<Result>& load) {
  return {"reading " + load.file().filename().string(), load.done(), "nothing else is compared with",
          [&load] { load.giveUp(); }, load.began()};
}

}  // namespace

std::vector<Task> Viewer::tasks() {
  std::vector<Task> out;
  if (state_->phase == SessionPhase::kLoading)
    out.push_back({state_->task, state_->task_done, "the scene before stays", [this] { giveUpLoading(); },
                   state_->loading_began});
  if (scene_.framing())
    out.push_back({"looking for a good view", scene_.framingDone(), "the best view so far",
                   [this] { scene_.hurryFraming(); }, view_wanted_at_});
  if (const auto since = scene_.waitingSince(); since && scene_.waits(wanted())) {
    const bool edges = displayMode(ui_.settings.view.display).edges;
    out.push_back({edges ? "finding edges" : "colouring patches", std::nullopt, "the display before stays",
                   [this] { giveUpDisplay(); }, *since});
  }
  if (const auto since = screenshots_.began()) {
    const auto give_up = [this] {
      screenshots_.giveUp();
      scene_.endFiner();
    };
    out.push_back({"writing " + screenshots_.path().filename().string(), screenshots_.done(scene_),
                   "no file is written", give_up, *since});
  }
  if (reference_load_.underWay()) out.push_back(taskOf(reference_load_));
  if (picture_load_.underWay() || coming_picture_) {
    Task task = taskOf(picture_load_);
    const double read = task.done.value_or(0), sent = coming_picture_ ? coming_picture_->uploaded() : 0;
    if (task.done || coming_picture_)
      task.done = kDecodingShare * (coming_picture_ ? 1 : read) + (1 - kDecodingShare) * sent;
    task.giveUp = [this] { giveUpReferencePicture(); };
    out.push_back(task);
  }
  if (state_->editing)
    out.push_back({state_->task, state_->task_done, "the materials before stay",
                   [this] { session_.giveUpLoading(); }, state_->task_began});
  if (state_->refining)
    out.push_back({state_->task, state_->task_done, "the mesh stays as it is",
                   [this] { session_.giveUpLoading(); }, state_->task_began});
  if (state_->saving)
    out.push_back({state_->task, state_->task_done, "a file that is there stays as it was",
                   [this] { session_.giveUpSaving(); }, state_->task_began});
  if (state_->completing)
    out.push_back({"computing form factors for bounces", state_->completing,
                   "what is computed stays, the rest is missing", [this] { session_.giveUpBounces(); },
                   state_->completing_began});
  if (state_->gathering)
    out.push_back({"gathering M", state_->gathering, "the lecture is closed",
                   [this] { teaching_->choices.lecture = false; }, state_->gathering_began});
  if (const auto since = teaching_->preparing())
    out.push_back({"preparing the hemicube", std::nullopt, "the hemicube is closed",
                   [this] { teaching_->giveUpLooking(); }, *since});
  return out;
}

/// Back to the one that is shown, where that needs nothing to be found.
void Viewer::giveUpDisplay() {
  std::string& display = ui_.settings.view.display;
  const std::string& before = scene_.shownDisplay();
  display = before.empty() || before == display ? "radiosity" : before;
  scene_.giveUpWaiting();
}

bool Viewer::giveUp(std::size_t number) {
  const std::vector<Task> all = tasks();
  if (number >= all.size()) return false;
  giveUp(all[number]);
  return true;
}

bool Viewer::giveUpShown() {
  const std::vector<Task> all = tasks();
  const auto shown =
      std::find_if(all.begin(), all.end(), [](const Task& task) { return task.shown(wallSeconds()); });
  if (shown == all.end()) return false;
  giveUp(*shown);
  return true;
}

void Viewer::giveUp(const Task& task) {
  const std::string text = task.text;
  task.giveUp();
  notice("given up: " + text);
}

}  // namespace unshot
