#include "scene/sky.h"

#include <algorithm>
#include <cmath>

#include "base/parse.h"

namespace unshot {

bool emitsLight(const Scene& scene) {
  return std::any_of(scene.polygons.begin(), scene.polygons.end(),
                     [&](const Polygon& p) { return scene.materials[p.material].emits(); });
}

std::optional<glm::dvec3> parseSky(std::string_view text) {
  const std::optional<glm::dvec3> sky = parseVector(text);
  for (int c = 0; c < 3; ++c) {
    if (!sky || !std::isfinite((*sky)[c]) || (*sky)[c] < 0) return std::nullopt;
  }
  return sky;
}

glm::dvec3 skyOver(const Scene& scene, const std::optional<glm::dvec3>& asked) {
  return asked.value_or(glm::dvec3(emitsLight(scene) ? 0.0 : 1.0));
}

}  // namespace unshot
