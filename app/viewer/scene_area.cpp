#include "viewer/scene_area.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "base/clock.h"

namespace unshot {
namespace {

constexpr int kGap = 4;  // between the pictures [px]

// In a picture that is higher than wide the angle of view is that of its width.
void widenAngle(SceneDisplay::Wanted& picture) {
  if (picture.width >= picture.height || picture.width <= 0) return;
  const double up = std::tan(glm::radians(picture.camera.fov_deg) / 2);
  const double wider = std::atan(up * picture.height / picture.width);
  picture.camera.fov_deg = std::min(glm::degrees(2 * wider), 170.0);
}

}  // namespace

SceneSplit splitScene(int width, bool race) {
  if (!race) return {width, width, 0};
  const int each = std::max((width - kGap) / 2, 0);
  return {each, width - each, each};
}

void SceneArea::setSnapshots(std::shared_ptr<const Snapshot> first, std::shared_ptr<const Snapshot> rival) {
  first_.setSnapshot(std::move(first));
  if (second_.has_value() != (rival != nullptr)) {
    changes_ += 1 + (second_ ? second_->version() : 0);
    second_.reset();
    second_due_ = false;
    if (rival) second_.emplace(context_, wake_);
  }
  if (second_) second_->setSnapshot(std::move(rival));
}

bool SceneArea::has(const std::shared_ptr<const Snapshot>& first,
                    const std::shared_ptr<const Snapshot>& rival) const {
  return first_.snapshot() == first && (second_ ? second_->snapshot() : nullptr) == rival;
}

SceneDisplay::Wanted SceneArea::firstOf(const Wanted& wanted) const {
  Wanted out = wanted;
  out.width = splitScene(wanted.width, second_.has_value()).left;
  if (second_) widenAngle(out);
  return out;
}

SceneDisplay::Wanted SceneArea::secondOf(const Wanted& wanted) const {
  Wanted out = wanted;
  out.width = splitScene(wanted.width, true).right;
  widenAngle(out);
  out.settings.view.automatic_exposure = first_.exposure();
  return out;
}

bool SceneArea::outdated(const Wanted& wanted) const {
  return first_.outdated(firstOf(wanted)) || (second_ && second_->outdated(secondOf(wanted)));
}

bool SceneArea::waits(const Wanted& wanted) const {
  return first_.waits(firstOf(wanted)) || (second_ && second_->waits(secondOf(wanted)));
}

std::optional<double> SceneArea::waitingSince() const {
  const std::optional<double> first = first_.waitingSince();
  return first || !second_ ? first : second_->waitingSince();
}

void SceneArea::giveUpWaiting() {
  first_.giveUpWaiting();
  if (second_) second_->giveUpWaiting();
}

bool SceneArea::draw(const Wanted& wanted, double seconds, double deadline) {
  bool drew = false;
  if (second_due_ && second_wanted_.divisor < wanted.divisor) second_due_ = false;  // it comes too late
  if (!second_due_ || deadline == SceneDisplay::kAtOnce) {
    drew = first_.draw(firstOf(wanted), seconds, deadline);
    if (!second_ || first_.drawing()) return drew;
    second_wanted_ = secondOf(wanted);
    second_wanted_.camera = first_.shownCamera();
    second_due_ = second_->outdated(second_wanted_);
    if (!second_due_ || wallSeconds() >= deadline) return drew;
  }
  second_->draw(second_wanted_, seconds, deadline);
  second_due_ = second_->drawing();
  return true;
}

void SceneArea::sharpen(int samples, double deadline) {
  if (!first_.sharp()) {
    first_.sharpen(samples, deadline);
  } else if (second_) {
    second_->sharpen(samples, deadline);
  }
}

void SceneArea::beginFiner(int samples) {
  first_.beginFiner(samples);
  if (second_) second_->beginFiner(samples);
}

bool SceneArea::continueFiner(double deadline) {
  if (!first_.continueFiner(deadline)) return false;
  return !second_ || second_->continueFiner(deadline);
}

double SceneArea::finerDone() const {
  return second_ ? (first_.finerDone() + second_->finerDone()) / 2 : first_.finerDone();
}

void SceneArea::endFiner() {
  first_.endFiner();
  if (second_) second_->endFiner();
}

void SceneArea::copyFinerTo(int width) const {
  const SceneSplit split = splitScene(width, second_.has_value());
  first_.copyFinerTo(0, split.left);
  if (second_) second_->copyFinerTo(split.right_at, split.right);
}

std::uint64_t SceneArea::version() const {
  return changes_ + first_.version() + (second_ ? second_->version() : 0);
}

void SceneArea::copyTo(int width) const {
  const SceneSplit split = splitScene(width, second_.has_value());
  first_.copyTo(0, split.left);
  if (second_) second_->copyTo(split.right_at, split.right);
}

}  // namespace unshot
