// Random points of elements, by their display triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "mesh/mesh.h"

namespace unshot {

class ElementPoints {
 public:
  /// The mesh must outlive it.
  explicit ElementPoints(const Mesh& mesh) : mesh_(mesh), triangles_(mesh.element_count) {
    for (std::uint32_t t = 0; t < mesh.triangle_element.size(); ++t)
      triangles_[mesh.triangle_element[t]].push_back(t);
  }

  /// Whether the element has no display triangles.
  bool empty(std::uint32_t element) const { return triangles_[element].empty(); }

  /// A point of the element, which is not empty, evenly over its area; `draw()` is uniform in [0, 1).
  template <class Draw>
  glm::dvec3 at(std::uint32_t element, Draw&& draw) const {
    glm::dvec3 p[3]{};
    double sum = 0;
    // One of the triangles by area: each takes the place of those before with its share of all so far.
    for (const std::uint32_t t : triangles_[element]) {
      glm::dvec3 corner[3];
      for (int k = 0; k < 3; ++k)
        corner[k] = glm::dvec3(mesh_.vertices[mesh_.triangle_vertices[3 * t + k]].position);
      const double area = glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
      sum += area;
      if (t != triangles_[element][0] && draw() * sum >= area) continue;
      std::copy(corner, corner + 3, p);
    }
    const double root = std::sqrt(draw()), v = draw();
    return (1 - root) * p[0] + root * (1 - v) * p[1] + root * v * p[2];
  }

 private:
  const Mesh& mesh_;
  std::vector<std::vector<std::uint32_t>> triangles_;
};

}  // namespace unshot
