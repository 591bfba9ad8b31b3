// A hemicube's five faces unfolded to a cross, as the pictures of lectures show it: the top in the middle,
// the four half sides around it, each with its horizon outside.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/choice.h"
#include "session/snapshot.h"
#include "viewer/hemicube_looks.h"

namespace unshot {

/// What its pixels show.
enum class HemicubeColours { kLight, kMaterials, kPatches, kDelta, kShares };

struct HemicubePictureRow {
  ChoiceInfo info;
  HemicubeColours colours;
};
std::span<const HemicubePictureRow> hemicubePictures();

/// The cross is 2 n pixels wide and high.
inline std::uint32_t crossSize(HemicubeLayout layout) { return 2 * layout.resolution; }
/// The pixel of the layout that is shown at (x, y) of the cross, from the upper left; none in its corners.
std::optional<std::size_t> crossPixel(HemicubeLayout layout, std::uint32_t x, std::uint32_t y);

/// The cross as RGBA, 8 bit sRGB, row by row from the top; transparent in its corners. `snapshot` of the
/// look's mesh, or of one that differs in materials alone. Light has an exposure of its own, found as that of
/// a picture of the scene is.
std::vector<std::uint8_t> paintCross(const HemicubeLook& look, HemicubeColours colours,
                                     const Snapshot& snapshot);

}  // namespace unshot
