// The edges of a scene's polygons, put together where they lie on each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace unshot {

/// Of one polygon. Its ends are positions of the scene: of those at the same place always the first.
struct PolygonEdge {
  std::uint32_t low = 0, high = 0;
  std::uint32_t polygon = 0;
  bool forward = true;  ///< the polygon runs from low to high
};

/// Of all polygons, sorted by (low, high, polygon). Edges are compared corner by corner: a corner within a
/// neighbour's edge is none of the neighbour's.
std::vector<PolygonEdge> polygonEdges(const Scene& scene);

/// Calls `found(uses)` with a span of all edges between the same two places, for each such pair.
template <class F>
void forEachEdge(std::span<const PolygonEdge> edges, F&& found) {
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high)
      ++end;
    found(edges.subspan(first, end - first));
  }
}

}  // namespace unshot
