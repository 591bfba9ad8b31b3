// "A good picture of any scene without touching a control": candidates outside and inside the scene, each
// judged by what a small picture of the scene's own polygons from there shows.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gl/context.h"
#include "render/camera.h"
#include "session/snapshot.h"

namespace unshot {

struct AutomaticCameraOptions {
  double aspect = 4.0 / 3.0;
  std::optional<double> fov_deg;  ///< else 40 from outside, 65 inside
  glm::dvec3 up{0, 1, 0};
};

/// Looks for the best of the candidates, one at a time, so that a window can go on living meanwhile. All
/// calls on the thread where `context` is current; each candidate draws all of the scene's polygons once.
class CameraSearch {
 public:
  CameraSearch(gl::Context& context, std::shared_ptr<const Snapshot> snapshot,
               const AutomaticCameraOptions& options);
  ~CameraSearch();
  CameraSearch(CameraSearch&&) noexcept;
  CameraSearch& operator=(CameraSearch&&) noexcept;

  /// Judges one more candidate; false where none was left.
  bool step();
  /// The best of those that were judged.
  Camera best() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// All of a search at once.
Camera automaticCamera(gl::Context& context, const Snapshot& snapshot, const AutomaticCameraOptions& options);

// Its parts, for tests.

struct CameraCandidate {
  Camera camera;
  double prior = 0;  ///< added to the score: what cannot be seen in the picture
};

std::vector<CameraCandidate> cameraCandidates(const Bounds& bounds, const AutomaticCameraOptions& options);

/// What the judge knows of a side.
struct SideLook {
  double luminance = 0;  ///< mean B over its elements
  double area = 0;
  bool emits = false;
};
std::vector<SideLook> sideLooks(const Snapshot& snapshot);

/// What a view shows; the parts are in 0..1.
struct ViewFigures {
  double covered = 0;  ///< pixels with something in them, of the frame
  double lit = 0;  ///< pixels with something that is not dark for this scene, of those where the bounds are
  double variety = 0;   ///< effective number of sides in view, on a log scale
  double seen = 0;      ///< area of the sides in view, of all
  double contrast = 0;  ///< spread of the light
  double lamps = 0;     ///< lamps in view
  double backs = 0;     ///< of the covered pixels: back sides (lamps aside), seldom meant to be seen
  double blocked = 0;   ///< pixels with something right before the eye
  double cut = 0;  ///< of the covered pixels: sides that the frame cuts off, where background shows between
};

/// `ids`: one per pixel, side + 1 or 0, lowest row first.
ViewFigures judgeView(std::span<const std::uint32_t> ids, int width, int height, const Camera& camera,
                      const Mesh& mesh, std::span<const SideLook> looks);

}  // namespace unshot
