#include "mesh/air.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

namespace unshot {
namespace {

constexpr double kNoWedge = 1e-3;  // radians: surfaces on top of each other have no air between them

// A surface around an edge: at which angle it leaves the edge, and the patches of its sides there, the one
// that faces growing angles and the one that faces falling ones (kNone where no light can reach).
struct Leaf {
  double angle;
  std::uint32_t ahead, behind;
};

class AirJoiner {
 public:
  AirJoiner(Mesh& mesh, std::span<const glm::dvec3> points) : mesh_(mesh), points_(points) {
    mesh_.patch_air.resize(mesh_.patch_count);
    std::iota(mesh_.patch_air.begin(), mesh_.patch_air.end(), 0u);
  }

  // `uses`: all edges between the same two points.
  void joinAround(std::span<const PieceEdge> uses) {
    if (uses.size() < 2) return;
    const glm::dvec3 axis = points_[uses[0].high] - points_[uses[0].low];
    const double length = glm::length(axis);
    if (length == 0) return;
    leaves_.clear();
    const glm::dvec3 across = inward(uses[0], axis / length);
    const glm::dvec3 ahead = glm::cross(axis / length, across);
    for (const PieceEdge& use : uses) {
      const glm::dvec3 d = inward(use, axis / length);
      const std::uint32_t front = patchOf(use, 0), back = patchOf(use, 1);
      leaves_.push_back({std::atan2(glm::dot(d, ahead), glm::dot(d, across)), use.forward ? front : back,
                         use.forward ? back : front});
    }
    std::sort(leaves_.begin(), leaves_.end(), [](const Leaf& a, const Leaf& b) { return a.angle < b.angle; });
    for (std::size_t k = 0; k < leaves_.size(); ++k) {
      const bool last = k + 1 == leaves_.size();
      const Leaf &one = leaves_[k], &two = leaves_[last ? 0 : k + 1];
      const double wedge = two.angle - one.angle + (last ? 2 * glm::pi<double>() : 0.0);
      if (wedge < kNoWedge || one.ahead == kNone || two.behind == kNone) continue;
      mesh_.patch_air[find(one.ahead)] = find(two.behind);
    }
  }

  void flatten() {
    for (std::uint32_t q = 0; q < mesh_.patch_air.size(); ++q) mesh_.patch_air[q] = find(q);
  }

 private:
  // The direction in the surface, across the edge, into the piece.
  glm::dvec3 inward(const PieceEdge& use, const glm::dvec3& axis) const {
    const glm::dvec3 left = glm::cross(mesh_.surfaces[use.surface].normal, axis);
    return use.forward ? left : -left;
  }

  std::uint32_t patchOf(const PieceEdge& use, int back) const {
    const Surface& surface = mesh_.surfaces[use.surface];
    if (surface.side[back] == kNone) return kNone;
    const std::uint32_t element = surface.elements.first + mesh_.pieces[use.piece].element;
    return mesh_.sides[surface.side[back]].first_patch + mesh_.shapes[element].patch;
  }

  std::uint32_t find(std::uint32_t q) {
    std::vector<std::uint32_t>& air = mesh_.patch_air;
    while (air[q] != q) q = air[q] = air[air[q]];
    return q;
  }

  Mesh& mesh_;
  std::span<const glm::dvec3> points_;
  std::vector<Leaf> leaves_;
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
