// The pictures in the scene's part of the window: that of the present solve and, in a race, that of the other
// one beside it, from the same camera and with the same exposure. Where a member says nothing, it is as that
// of SceneDisplay.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "viewer/scene_display.h"

namespace unshot {

/// Columns of pixels that the pictures take of the scene's part of the window.
struct SceneSplit {
  int left = 0;                 ///< width of the first, from 0 on
  int right_at = 0, right = 0;  ///< begin and width of the second; 0 wide: there is none
};
SceneSplit splitScene(int width, bool race);

/// All calls on the thread where the context is current.
class SceneArea {
 public:
  SceneArea(gl::Context& context, std::function<void()> wake)
      : context_(context), wake_(std::move(wake)), first_(context, wake_) {}

  /// `rival` null: no race.
  void setSnapshots(std::shared_ptr<const Snapshot> first, std::shared_ptr<const Snapshot> rival);
  /// Of the present solve.
  const std::shared_ptr<const Snapshot>& snapshot() const { return first_.snapshot(); }
  /// Whether these are what is shown, or drawn next.
  bool has(const std::shared_ptr<const Snapshot>& first, const std::shared_ptr<const Snapshot>& rival) const;
  bool empty() const { return first_.empty(); }
  /// Whether there are two pictures.
  bool racing() const { return second_.has_value(); }

  void startFraming(double aspect) { first_.startFraming(aspect); }
  bool framing() const { return first_.framing(); }
  double framingDone() const { return first_.framingDone(); }
  void hurryFraming() { first_.hurryFraming(); }
  std::optional<Camera> continueFraming(std::optional<double> seconds) {
    return first_.continueFraming(seconds);
  }

  /// Sizes are those of the whole area. In a race, pictures that are higher than wide show as much to the
  /// sides as a square one would.
  using Wanted = SceneDisplay::Wanted;
  bool draw(const Wanted& wanted, double seconds, double deadline);
  bool outdated(const Wanted& wanted) const;
  bool waits(const Wanted& wanted) const;
  std::optional<double> waitingSince() const;
  void giveUpWaiting();
  const std::string& shownDisplay() const { return first_.shownDisplay(); }
  bool drawing() const { return first_.drawing() || second_due_; }
  bool drawnAnew() const { return first_.drawnAnew() || (second_ && second_->drawnAnew()); }
  bool coarse() const { return first_.coarse() || (second_ && second_->coarse()); }
  const Camera& shownCamera() const { return first_.shownCamera(); }
  /// That of the pictures that are made of this.
  Camera cameraOf(const Wanted& wanted) const { return firstOf(wanted).camera; }
  void sharpen(int samples, double deadline);
  bool sharp() const { return first_.sharp() && (!second_ || second_->sharp()); }
  void beginFiner(int samples);
  bool continueFiner(double deadline);
  double finerDone() const;
  void copyFinerTo(int width) const;
  void endFiner();
  std::uint64_t version() const;
  /// Copies the pictures to the lower left of the bound draw framebuffer, into `width` columns of pixels.
  void copyTo(int width) const;
  /// As SceneDisplay's, of the first.
  void rehearseCopies() const { first_.rehearseCopies(); }

  double exposure() const { return first_.exposure(); }
  bool gliding() const { return first_.gliding(); }
  const std::optional<LuminanceHistogram>& histogram() const { return first_.histogram(); }
  void snapExposure() { first_.snapExposure(); }

 private:
  Wanted firstOf(const Wanted& wanted) const;
  Wanted secondOf(const Wanted& wanted) const;

  gl::Context& context_;
  std::function<void()> wake_;
  SceneDisplay first_;
  std::optional<SceneDisplay> second_;  // in a race
  // After a picture of the first comes the one of the second, from the same camera, before the next of the
  // first.
  bool second_due_ = false;
  Wanted second_wanted_;
  std::uint64_t changes_ = 0;  // of the number of pictures, and versions of pictures that are gone
};

}  // namespace unshot
