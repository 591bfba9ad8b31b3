// The surfaces around an edge, in turn, and the wedges of air between one and the next.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace unshot {

/// Radians: surfaces on top of each other have no air between them.
inline constexpr double kNoWedge = 1e-3;

/// A surface around an edge: at which angle it leaves the edge, and its sides there, the one that faces
/// growing angles and the one that faces falling ones.
struct FanLeaf {
  double angle;
  std::uint32_t ahead, behind;
};

/// Calls `found(one, two, wedge)` for each leaf and the next one, the last and the first among them; `wedge`:
/// the angle between. `along`: the edge, not of length 0; `uses`: one or more of it, each `forward` where it
/// runs along counter-clockwise about `normalOf(use)`; `sideOf(use, back)`: a number of that side.
template <class Uses, class Normal, class Side, class Found>
void forWedges(const glm::dvec3& along, const Uses& uses, Normal&& normalOf, Side&& sideOf, Found&& found) {
  const glm::dvec3 axis = along / glm::length(along);
  const auto inward = [&](const auto& use) {
    const glm::dvec3 left = glm::cross(normalOf(use), axis);
    return use.forward ? left : -left;
  };
  const glm::dvec3 across = inward(uses[0]), ahead = glm::cross(axis, across);
  std::vector<FanLeaf> leaves;
  for (const auto& use : uses) {
    const glm::dvec3 d = inward(use);
    const std::uint32_t front = sideOf(use, 0), back = sideOf(use, 1);
    leaves.push_back({std::atan2(glm::dot(d, ahead), glm::dot(d, across)), use.forward ? front : back,
                      use.forward ? back : front});
  }
  std::sort(leaves.begin(), leaves.end(),
            [](const FanLeaf& a, const FanLeaf& b) { return a.angle < b.angle; });
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    const bool last = k + 1 == leaves.size();
    const FanLeaf &one = leaves[k], &two = leaves[last ? 0 : k + 1];
    found(one, two, two.angle - one.angle + (last ? 2 * glm::pi<double>() : 0.0));
  }
}

}  // namespace unshot
