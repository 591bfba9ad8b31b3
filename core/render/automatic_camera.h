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
  /// How many of them are judged, from 0 to 1.
  double done() const;
  /// The best of those that were judged; where none was, the first.
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

}  // namespace unshot
