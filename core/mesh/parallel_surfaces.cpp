#include "mesh/parallel_surfaces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/lit.h"

namespace unshot {
namespace {

constexpr double kParallelCosine = 0.9994;

std::vector<Box> boxesOf(const Mesh& mesh) {
  std::vector<Box> boxes;
  for (const ChartTriangle& t : litTriangles(mesh)) {
    const glm::dvec3 &a = mesh.positions[t.position[0]], &b = mesh.positions[t.position[1]],
                     &c = mesh.positions[t.position[2]];
    boxes.push_back({glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)});
  }
  return boxes;
}

// Counter-clockwise triangle; its border is not part of it.
bool holds(const ChartTriangle& t, const glm::dvec2& p) {
  for (int k = 0; k < 3; ++k) {
    const glm::dvec2 &a = t.uv[k], d = t.uv[(k + 1) % 3] - a;
    if (d.x * (p.y - a.y) - d.y * (p.x - a.x) <= 0) return false;
  }
  return true;
}

}  // namespace

ParallelSurfaces::ParallelSurfaces(const Mesh& mesh, const CancelToken& cancel)
    : mesh_(mesh), surface_of_(litTriangles(mesh).size()), tree_(boxesOf(mesh), cancel) {
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    const Range& range = mesh.surfaces[s].triangles;
    if (range.end() > surface_of_.size()) continue;
    std::fill_n(surface_of_.begin() + range.first, range.count, s);
  }
}

std::vector<ParallelSurfaces::Found> ParallelSurfaces::around(const glm::dvec3& point, std::uint32_t surface,
                                                              double distance) const {
  std::vector<Found> out;
  const glm::dvec3& normal = mesh_.surfaces[surface].normal;
  tree_.overlapping({point - distance, point + distance}, [&](std::uint32_t t) {
    const std::uint32_t other = surface_of_[t];
    if (other == surface) return;
    const Surface& s = mesh_.surfaces[other];
    const double cosine = glm::dot(s.normal, normal);
    if (std::abs(cosine) < kParallelCosine) return;
    const double height = glm::dot(s.origin - point, s.normal) / cosine;
    if (std::abs(height) > distance || !holds(mesh_.triangles[t], s.chart(point + height * normal))) return;
    out.push_back({other, height, cosine > 0});
  });
  return out;
}

}  // namespace unshot
