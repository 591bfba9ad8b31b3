#include "mesh/near_emitters.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>

#include "base/point_tree.h"

namespace unshot {
namespace {

// A small light at a distance d from a plane lights a disc of about d across: interpolated between vertices
// so far apart, light is some percent off.
constexpr double kShareOfDistance = 1.0 / 3;
// Right beside an emitter, of its size.
constexpr double kShareOfEmitter = 0.25;
// Emitters larger than so many cells are cut, and what they light is smooth on the scale of a cell.
constexpr double kMostCellsOfEmitter = 2;
// Cells of a surface's grid, which is even.
constexpr double kMostCells = 256;

struct Emitter {
  glm::dvec3 normal;
  glm::dvec3 half_u, half_v;  // from its centre to the middles of two edges
  double size;                // the longer edge [m]
};

double distanceTo(const Surface& s, const glm::dvec3& p) {
  const glm::dvec2 uv = s.chart(p);
  return glm::distance(p, s.point(glm::clamp(uv, glm::dvec2(0.0), s.extent)));
}

// Whether light gets from the emitter to a side of the surface, for all that their planes say.
bool mayLight(const Surface& s, const Emitter& e, const glm::dvec3& centre) {
  const double height = glm::dot(centre - s.origin, s.normal), margin = 1e-3 * e.size;
  const double reach = std::abs(glm::dot(e.half_u, s.normal)) + std::abs(glm::dot(e.half_v, s.normal));
  const bool in_front = s.side[0] != kNone && height + reach > margin;
  const bool behind = s.side[1] != kNone && height - reach < -margin;
  if (!in_front && !behind) return false;
  for (const glm::dvec2& corner :
       {glm::dvec2(0.0), glm::dvec2(s.extent.x, 0), glm::dvec2(0, s.extent.y), s.extent}) {
    if (glm::dot(s.point(corner) - centre, e.normal) > margin) return true;
  }
  return false;
}

}  // namespace

void refineNearEmitters(const Mesh& mesh, std::vector<double>& sizes, const CancelToken& cancel) {
  std::vector<glm::dvec3> centres;
  std::vector<Emitter> emitters;
  for (const Side& side : mesh.sides) {
    if (glm::compMax(side.emission) <= 0) continue;
    const Surface& s = mesh.surfaces[side.surface];
    const double size = glm::compMax(s.extent);
    if (size > kMostCellsOfEmitter * sizes[side.surface]) continue;
    centres.push_back(s.point(0.5 * s.extent));
    emitters.push_back({side.normal, 0.5 * s.extent.x * s.axis_u, 0.5 * s.extent.y * s.axis_v, size});
  }
  if (emitters.empty()) return;
  const PointTree tree(centres, cancel);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const Surface& s = mesh.surfaces[k];
    cancel.check();
    if ((s.side[0] == kNone && s.side[1] == kNone) ||
        glm::compMax(mesh.materials[s.material].reflectance) <= 0)
      continue;
    // Within the least size that is used, and never coarser than it was.
    const double usual = std::min(sizes[k], glm::compMax(s.extent));
    const double least = std::min(sizes[k], std::sqrt(s.extent.x * s.extent.y / kMostCells));
    const bool wide = s.extent.x > s.extent.y;
    const glm::dvec2 middle = 0.5 * s.extent;
    const glm::dvec3 a = s.point(wide ? glm::dvec2(0, middle.y) : glm::dvec2(middle.x, 0));
    const glm::dvec3 b = s.point(wide ? glm::dvec2(s.extent.x, middle.y) : glm::dvec2(middle.x, s.extent.y));
    const double reach = usual / kShareOfDistance + glm::compMin(middle);
    double wanted = sizes[k];
    tree.nearSegment(a, b, reach, [&](std::uint32_t n) {
      if (!mayLight(s, emitters[n], centres[n])) return;
      wanted = std::min(
          wanted, std::max(kShareOfDistance * distanceTo(s, centres[n]), kShareOfEmitter * emitters[n].size));
    });
    if (wanted < usual) sizes[k] = std::max(wanted, least);
  }
}

}  // namespace unshot
