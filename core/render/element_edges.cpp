#include "render/element_edges.h"

#include <algorithm>
#include <functional>

namespace unshot {
namespace {

struct Edge {
  std::uint32_t a, b;  // a < b
  std::uint32_t element;
  bool samePlace(const Edge& other) const { return a == other.a && b == other.b; }
  bool operator<(const Edge& other) const { return a != other.a ? a < other.a : b < other.b; }
};

}  // namespace

std::vector<std::uint32_t> elementEdges(const Mesh& mesh, const CancelToken& cancel) {
  std::vector<Edge> edges;
  edges.reserve(mesh.triangle_vertices.size());
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
    cancel.check();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangle_vertices[3 * t + k];
      const std::uint32_t b = mesh.triangle_vertices[3 * t + (k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), mesh.triangle_element[t]});
    }
  }
  std::sort(edges.begin(), edges.end(), cancel.checking(std::less<>()));
  std::vector<std::uint32_t> pairs;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    bool inside = false;  // two triangles of one element meet here
    for (; end < edges.size() && edges[end].samePlace(edges[i]); ++end) {
      inside = inside || edges[end].element == edges[i].element;
    }
    if (!inside) pairs.insert(pairs.end(), {edges[i].a, edges[i].b});
    i = end;
  }
  return pairs;
}

}  // namespace unshot
