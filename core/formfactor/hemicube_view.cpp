#include "formfactor/hemicube_view.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace unshot {

glm::dmat3 outlineHeights(const ChartTriangle& t, double far) {
  glm::dmat3 out(far);
  for (int e = 0; e < 3; ++e) {
    for (int k = 0; k < 3; ++k) out[k][e] = far;
    if (!t.outline[e]) continue;
    const glm::dvec2 a = t.uv[e], d = t.uv[(e + 1) % 3] - a, apex = t.uv[(e + 2) % 3] - a;
    out[e][e] = out[(e + 1) % 3][e] = 0;
    out[(e + 2) % 3][e] = std::abs(d.x * apex.y - d.y * apex.x) / glm::length(d);
  }
  return out;
}

HemicubeFaces::HemicubeFaces(const HemicubeFrame& frame) {
  const glm::dvec3 left = glm::cross(frame.normal, frame.right);
  forward[0] = frame.normal;
  up[0] = left;
  forward[1] = frame.right;
  forward[2] = left;
  forward[3] = -frame.right;
  forward[4] = -left;
  for (int face = 1; face < 5; ++face) up[face] = frame.normal;
}

}  // namespace unshot
