#include "mesh/air.h"

#include <glm/geometric.hpp>
#include <numeric>

#include "mesh/edge_fan.h"

namespace unshot {
namespace {

class AirJoiner {
 public:
  AirJoiner(Mesh& mesh, std::span<const glm::dvec3> points) : mesh_(mesh), points_(points) {
    mesh_.patch_air.resize(mesh_.patch_count);
    std::iota(mesh_.patch_air.begin(), mesh_.patch_air.end(), 0u);
  }

  // `uses`: all edges between the same two points.
  void joinAround(std::span<const PieceEdge> uses) {
    if (uses.size() < 2) return;
    const glm::dvec3 along = points_[uses[0].high] - points_[uses[0].low];
    if (along == glm::dvec3(0.0)) return;
    forWedges(
        along, uses, [&](const PieceEdge& use) { return mesh_.surfaces[use.surface].normal; },
        [&](const PieceEdge& use, int back) { return patchOf(use, back); },
        [&](const FanLeaf& one, const FanLeaf& two, double wedge) {
          if (wedge < kNoWedge || one.ahead == kNone || two.behind == kNone) return;
          mesh_.patch_air[find(one.ahead)] = find(two.behind);
        });
  }

  void flatten() {
    for (std::uint32_t q = 0; q < mesh_.patch_air.size(); ++q) mesh_.patch_air[q] = find(q);
  }

 private:
  std::uint32_t patchOf(const PieceEdge& use, int back) const {
    const Surface& surface = mesh_.surfaces[use.surface];
    if (surface.side[back] == kNone) return kNone;
    const std::uint32_t element = surface.elements.first + mesh_.pieces[use.piece].element;
    return mesh_.sides[surface.side[back]].first_part + mesh_.shapes[element].patch;
  }

  std::uint32_t find(std::uint32_t q) {
    std::vector<std::uint32_t>& air = mesh_.patch_air;
    while (air[q] != q) q = air[q] = air[air[q]];
    return q;
  }

  Mesh& mesh_;
  std::span<const glm::dvec3> points_;
};

}  // namespace

void joinAir(Mesh& mesh, std::span<const PieceEdge> edges, std::span<const glm::dvec3> points,
             const CancelToken& cancel) {
  AirJoiner joiner(mesh, points);
  for (std::size_t first = 0; first < edges.size();) {
    cancel.check();
    std::size_t end = first + 1;
    while (end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high)
      ++end;
    joiner.joinAround(edges.subspan(first, end - first));
    first = end;
  }
  joiner.flatten();
}

}  // namespace unshot
