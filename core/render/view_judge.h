// How good a view of the scene is, from which side each pixel of a small picture of it shows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/camera.h"
#include "session/snapshot.h"

namespace unshot {

/// What the judge knows of a side.
struct SideLook {
  double luminance = 0;  ///< mean B over its elements [W/m^2]
  double area = 0;
  bool emits = false;
};

/// The light of a snapshot as it will be once solved: B with the ambient term.
struct SceneLight {
  std::vector<SideLook> sides;  ///< one per side
  std::vector<float> elements;  ///< luminance of B, one per element [W/m^2]
  double median = 0;  ///< half the area (of fronts; of all where those are black) is brighter; lamps aside
};
SceneLight sceneLight(const Snapshot& snapshot);

/// What a view shows; the parts are in 0..1.
struct ViewFigures {
  double covered = 0;  ///< pixels with something in them, of the frame
  double lit = 0;  ///< pixels with something that is not dark for this scene, of those where the bounds are
  double variety = 0;   ///< effective number of sides in view, on a log scale
  double seen = 0;      ///< area of the sides in view, of all
  double contrast = 0;  ///< spread of the light
  double clear = 0;     ///< of the covered pixels: neither near black nor blown out at the view's exposure
  double lamps = 0;     ///< lamps in view
  double small = 0;     ///< of the covered pixels: sides too small in the picture to be made out
  double backs = 0;     ///< of the covered pixels: back sides (lamps aside), seldom meant to be seen
  double blocked = 0;   ///< pixels with something right before the eye
  double cut = 0;  ///< of the covered pixels: sides that the frame cuts off, where background shows between
};

/// `ids`: one per pixel, side + 1 or 0, lowest row first.
ViewFigures judgeView(std::span<const std::uint32_t> ids, int width, int height, const Camera& camera,
                      const Mesh& mesh, const SceneLight& light);

/// Points for a view; `best`: the largest of each figure over all views.
double viewScore(const ViewFigures& figures, const ViewFigures& best);

}  // namespace unshot
