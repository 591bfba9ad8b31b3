// The picture of the scene in the viewer: the newest snapshot from the camera, drawn again only when
// something has changed, with an exposure that glides; and the search for a first camera, a little in each
// frame.
#pragma once

#include <memory>
#include <optional>

#include "render/automatic_camera.h"
#include "render/scene_view.h"
#include "session/snapshot.h"

namespace unshot {

/// What the picture is made with, besides snapshot and camera.
struct DisplaySettings {
  ViewOptions view;              ///< display mode, exposure_ev, ambient, indirect; the rest is chosen here
  bool exposure_locked = false;  ///< keeps the present exposure instead of following the light
};

/// All calls on the thread where the context is current.
class SceneDisplay {
 public:
  explicit SceneDisplay(gl::Context& context);

  /// Uploads it. Null: nothing to show.
  void setSnapshot(std::shared_ptr<const Snapshot> snapshot);
  const std::shared_ptr<const Snapshot>& snapshot() const { return snapshot_; }
  bool empty() const { return !snapshot_; }

  /// Starts looking for a good camera for the present snapshot.
  void startFraming(double aspect);
  bool framing() const { return framing_.has_value(); }
  /// Works on it for about `seconds`, or to its end (no value). Returns the camera once it is found.
  std::optional<Camera> continueFraming(std::optional<double> seconds);

  /// Whether draw() would change the picture: something is new, or the exposure is still gliding.
  bool stale(const Camera& camera, const DisplaySettings& settings, int width, int height, int samples) const;
  /// Brings the picture up to date: `samples` along a pixel's side, `seconds` since the last call for the
  /// glide of the exposure (negative: no glide). Returns whether anything was drawn.
  bool draw(const Camera& camera, const DisplaySettings& settings, int width, int height, int samples,
            double seconds);
  /// Once the picture is up to date: draws it again in bands, a band a call, with `samples` along a pixel's
  /// side, so that a software renderer smooths edges without holding the window up. Returns whether there was
  /// one to draw.
  bool sharpen(int samples);
  /// Whether nothing is left to sharpen.
  bool sharp() const { return !drawn_ || next_band_ >= kBands; }
  /// Copies the picture to the bound draw framebuffer, its lower left at (x, y).
  void copyTo(int x, int y) const;

  /// Factor from linear values to about 1 for white, before exposure_ev.
  double exposure() const { return exposure_; }
  bool gliding() const { return gliding_; }
  /// The next picture takes its own exposure at once.
  void snapExposure() { snap_ = true; }

 private:
  static constexpr int kBands = 8;

  struct Drawn {
    Camera camera;
    DisplaySettings settings;
    int width = 0, height = 0, samples = 0;
  };

  void allocate(int width, int height);
  double nextExposure(double metered, double seconds);

  gl::Context& context_;
  SceneView view_;
  std::shared_ptr<const Snapshot> snapshot_;
  std::optional<CameraSearch> framing_;
  gl::Texture picture_;
  gl::Framebuffer framebuffer_;
  int width_ = 0, height_ = 0;
  std::optional<Drawn> drawn_;
  LinearTarget band_;
  int next_band_ = 0;
  double exposure_ = 1;
  bool gliding_ = false, snap_ = true;
};

}  // namespace unshot
