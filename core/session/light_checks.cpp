// Checks of lights: each light is judged by where its rays arrive (light_views.h).
#include <algorithm>
#include <functional>

#include "base/text.h"
#include "session/scene_checks.h"

namespace unshot {
namespace {

constexpr double kMostlyLit = 0.95;

/// One warning about all lights that `wrong` holds for: "a light of 'lamp'" or "3 lights (the first of
/// 'lamp')", then what `one` or `many` says of them.
Diagnostics warnOf(CheckedScene& checked, const std::function<bool(const LightView&)>& wrong,
                   const std::string& one, const std::string& many, const std::string& advice) {
  std::size_t count = 0;
  const Surface* first = nullptr;
  for (const LightView& light : checked.lights()) {
    if (!wrong(light)) continue;
    ++count;
    for (const std::uint32_t s : light.surfaces) {
      const Surface& surface = checked.mesh().surfaces[s];
      if (!first || surface.polygon < first->polygon) first = &surface;
    }
  }
  if (count == 0) return {};
  const std::string name = "'" + checked.mesh().materials[first->material].name + "'";
  const std::string text = count == 1
                               ? "the light of material " + name + " " + one
                               : countText(count) + " lights, the first of material " + name + ", " + many;
  return {{Severity::kWarning, {}, text, checked.placeOfPolygon(first->polygon), advice}};
}

}  // namespace

Diagnostics checkLightsThatFaceWalls(CheckedScene& checked) {
  const std::string front = checked.emitFrontOnly() ? ", turned around, or let it emit from both sides" : "";
  Diagnostics out = warnOf(
      checked, [](const LightView& light) { return 2 * light.flush > light.rays; },
      "lies in the plane of another surface, on it: which of the two is seen is left to chance",
      "lie in the plane of other surfaces, on them: which of the two is seen is left to chance",
      "move it off that surface by a hundredth of its size, or cut a hole for it");
  const Diagnostics facing = warnOf(
      checked,
      [](const LightView& light) {
        return 2 * light.flush <= light.rays && light.near > 0 &&
               light.near >= kMostlyLit * (light.near + light.arrived());
      },
      "faces a surface directly before it: nothing of its light gets any further",
      "face surfaces directly before them: nothing of their light gets any further",
      "move it to the other side of that surface" + front);
  out.insert(out.end(), facing.begin(), facing.end());
  return out;
}

Diagnostics checkLightsInSolids(CheckedScene& checked) {
  return warnOf(
      checked, [](const LightView& light) { return light.shut_in; },
      "is shut into a solid: it shines on the backs of its faces, and none of it gets out",
      "are shut into solids: they shine on the backs of faces, and none of their light gets out",
      "move it out, or open the solid: all surfaces are opaque, lamp glasses and shades too");
}

Diagnostics checkLightsThatSeeNothing(CheckedScene& checked) {
  return warnOf(
      checked, [](const LightView& light) { return light.lost == light.rays; },
      "sees nothing of the scene: no surface receives its light",
      "see nothing of the scene: no surface receives their light",
      checked.emitFrontOnly()
          ? "turn it around (its front is given by the winding), or let it emit from both sides"
          : "move it, or remove it");
}

}  // namespace unshot
