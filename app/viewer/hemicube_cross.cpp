#include "viewer/hemicube_cross.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "base/srgb.h"
#include "base/tone.h"
#include "render/exposure.h"
#include "render/false_colour.h"
#include "render/patch_colours.h"

namespace unshot {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr Rgb kNothingThere = {24, 24, 28};
constexpr std::size_t kMeteredStep = 3;  // the exposure is found from each third pixel

Rgb encoded(const glm::dvec3& linear) {
  return {srgb8FromLinear(linear.x), srgb8FromLinear(linear.y), srgb8FromLinear(linear.z)};
}

/// Colours of what elements show, each worked out once.
class ElementColours {
 public:
  ElementColours(std::size_t elements, std::function<Rgb(std::uint32_t)> make)
      : make_(std::move(make)), colours_(elements), known_(elements, 0) {}
  const Rgb& at(std::uint32_t e) {
    if (!known_[e]) {
      colours_[e] = make_(e);
      known_[e] = 1;
    }
    return colours_[e];
  }

 private:
  std::function<Rgb(std::uint32_t)> make_;
  std::vector<Rgb> colours_;
  std::vector<char> known_;
};

const Side& sideOf(const Snapshot& snapshot, std::uint32_t element) {
  return snapshot.mesh->sides[snapshot.mesh->element_side[element]];
}

glm::dvec3 radiosityOf(const Snapshot& snapshot, std::uint32_t element) {
  const Side& side = sideOf(snapshot, element);
  return side.emission + side.reflectance * glm::dvec3(snapshot.element_irradiance[element]);
}

double exposureOf(const HemicubeLook& look, const Snapshot& snapshot) {
  std::vector<glm::vec4> pixels;
  for (std::size_t k = 0; k < look.elements.size(); k += kMeteredStep) {
    const std::uint32_t e = look.elements[k];
    if (e == kNone) continue;
    const bool lamp = sideOf(snapshot, e).emission != glm::dvec3(0.0);
    pixels.emplace_back(glm::vec3(radiosityOf(snapshot, e)), lamp ? kEmitterPixel : kSurfacePixel);
  }
  return automaticExposure(pixels);
}

std::function<Rgb(std::uint32_t)> elementColour(const HemicubeLook& look, HemicubeColours colours,
                                                const Snapshot& snapshot) {
  if (colours == HemicubeColours::kLight) {
    const double exposure = exposureOf(look, snapshot);
    return [exposure, &snapshot](std::uint32_t e) {
      return encoded(toneMap(exposure * radiosityOf(snapshot, e)));
    };
  }
  if (colours == HemicubeColours::kMaterials) {
    return [&snapshot](std::uint32_t e) {
      const Side& side = sideOf(snapshot, e);
      const double most = std::max({side.emission.x, side.emission.y, side.emission.z});
      return encoded(most > 0 ? side.emission / most : side.reflectance);
    };
  }
  if (colours == HemicubeColours::kPatches) {
    return [&look](std::uint32_t e) {
      return encoded(glm::dvec3(kPatchPalette[(*look.colours)[look.mesh->element_patch[e]]]));
    };
  }
  auto shares = std::make_shared<std::vector<double>>(look.shares());
  shares->pop_back();
  const double most = shares->empty() ? 0 : *std::max_element(shares->begin(), shares->end());
  return [shares = std::move(shares), most, &look](std::uint32_t e) {
    const double share = (*shares)[look.mesh->element_patch[e]];
    return encoded(glm::dvec3(falseColourAt(falseColourPlace(share, most, true))));
  };
}

}  // namespace

std::span<const HemicubePictureRow> hemicubePictures() {
  static constexpr std::array<HemicubePictureRow, 5> table = {{
      {{"light", "What it sees", "the light of the elements it sees, exposed for itself"},
       HemicubeColours::kLight},
      {{"materials", "Materials", "the reflectance of what it sees; lamps in the colour of their light"},
       HemicubeColours::kMaterials},
      {{"patches", "Patches",
        "which patch each pixel sees: the item buffer, in colours that neighbours do not share"},
       HemicubeColours::kPatches},
      {{"delta", "Delta form factors", "what share of the patch's light leaves through each pixel"},
       HemicubeColours::kDelta},
      {{"shares", "What each patch gets",
        "form factors G_ij: each patch in the colour of the delta form factors that it fills, three decades"},
       HemicubeColours::kShares},
  }};
  return table;
}

std::optional<std::size_t> crossPixel(HemicubeLayout layout, std::uint32_t px, std::uint32_t py) {
  const std::uint32_t n = layout.resolution, half = n / 2;
  const auto at = [&](std::uint32_t face, std::uint32_t column, std::uint32_t row) {
    return std::size_t{layout.faceRow(face) + row} * n + column;
  };
  const bool middle_x = px >= half && px < half + n, middle_y = py >= half && py < half + n;
  const std::uint32_t x = px - half, y = py - half;  // where they count, from the top face's upper left
  // Rows of the layout's faces go up, those of its sides from the horizon; the sides' columns follow from
  // HemicubeFaces.
  if (middle_x && middle_y) return at(0, x, n - 1 - y);
  if (middle_x) return py < half ? at(2, n - 1 - x, py) : at(4, x, 2 * n - 1 - py);
  if (middle_y) return px < half ? at(1, y, px) : at(3, n - 1 - y, 2 * n - 1 - px);
  return std::nullopt;
}

std::vector<std::uint8_t> paintCross(const HemicubeLook& look, HemicubeColours colours,
                                     const Snapshot& snapshot) {
  const std::uint32_t size = crossSize(look.layout);
  std::vector<std::uint8_t> out(std::size_t{4} * size * size, 0);
  ElementColours of_elements(look.mesh->element_count, elementColour(look, colours, snapshot));
  const double most = *std::max_element(look.delta->begin(), look.delta->end());
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      const std::optional<std::size_t> pixel = crossPixel(look.layout, x, y);
      if (!pixel) continue;
      const std::uint32_t element = look.elements[*pixel];
      Rgb colour = kNothingThere;
      if (colours == HemicubeColours::kDelta)
        colour = encoded(glm::dvec3((*look.delta)[*pixel] / most));
      else if (element != kNone)
        colour = of_elements.at(element);
      std::uint8_t* rgba = &out[4 * (std::size_t{y} * size + x)];
      std::copy(colour.begin(), colour.end(), rgba);
      rgba[3] = 255;
    }
  }
  return out;
}

}  // namespace unshot
