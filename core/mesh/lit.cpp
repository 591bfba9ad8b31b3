#include "mesh/lit.h"

#include <algorithm>

namespace unshot {

void putLitTrianglesFirst(Mesh& mesh) {
  std::vector<ChartTriangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const bool lit : {true, false}) {
    for (Surface& s : mesh.surfaces) {
      if (isLit(s) != lit) continue;
      const auto from = mesh.triangles.begin() + s.triangles.first;
      s.triangles.first = static_cast<std::uint32_t>(triangles.size());
      triangles.insert(triangles.end(), from, from + s.triangles.count);
    }
  }
  mesh.triangles = std::move(triangles);
}

std::span<const ChartTriangle> litTriangles(const Mesh& mesh) {
  std::uint32_t end = 0;
  for (const Surface& s : mesh.surfaces) {
    if (isLit(s)) end = std::max(end, s.triangles.end());
  }
  return std::span(mesh.triangles).first(end);
}

}  // namespace unshot
