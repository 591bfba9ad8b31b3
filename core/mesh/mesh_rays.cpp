#include "mesh/mesh_rays.h"

#include <algorithm>

#include "mesh/lit.h"

namespace unshot {
namespace {

SceneRays raysOf(const Mesh& mesh) {
  const std::span<const ChartTriangle> triangles = litTriangles(mesh);
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const ChartTriangle& t : triangles) corners.insert(corners.end(), t.position, t.position + 3);
  return {mesh.positions, corners};
}

// Of the surfaces that can stand between two points; nothing where these are all.
std::optional<SceneRays> raysBetween(const Mesh& mesh) {
  if (mesh.all_tested) return std::nullopt;
  const std::span<const ChartTriangle> triangles = litTriangles(mesh);
  std::vector<std::uint32_t> corners;
  for (const Surface& s : mesh.surfaces) {
    if (!s.between || s.triangles.end() > triangles.size()) continue;
    for (const ChartTriangle& t : triangles.subspan(s.triangles.first, s.triangles.count))
      corners.insert(corners.end(), t.position, t.position + 3);
  }
  if (corners.size() == 3 * triangles.size()) return std::nullopt;
  return SceneRays(mesh.positions, corners);
}

}  // namespace

MeshRays::MeshRays(const Mesh& mesh)
    : mesh_(mesh), rays_(raysOf(mesh)), between_(raysBetween(mesh)), surface_of_(rays_.triangleCount()) {
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    const Range& range = mesh.surfaces[s].triangles;
    if (range.end() > surface_of_.size()) continue;
    std::fill_n(surface_of_.begin() + range.first, range.count, s);
  }
}

std::optional<MeshRays::Hit> MeshRays::intersect(const glm::dvec3& origin,
                                                 const glm::dvec3& direction) const {
  const std::optional<SceneRays::Hit> at = rays_.intersect(origin, direction);
  if (!at) return std::nullopt;
  const std::uint32_t surface = surface_of_[at->triangle];
  return Hit{*at, surface, mesh_.surfaces[surface].side[at->back]};
}

}  // namespace unshot
