// A display triangle, and how a field changes along it that is linear between its corners.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "mesh/mesh.h"

namespace unshot {

struct TriangleSlope {
  const std::uint32_t* corner;  ///< three, in Mesh::vertices
  double area = 0;              ///< [m^2]
  glm::dvec3 middle{0.0};       ///< its centroid
  glm::dvec3 along[2] = {};  ///< area times the gradient of what is 1 at corner 1, or 2, and 0 at the others

  TriangleSlope(const Mesh& mesh, std::size_t triangle) : corner(&mesh.triangle_vertices[3 * triangle]) {
    const auto at = [&](int k) { return glm::dvec3(mesh.vertices[corner[k]].position); };
    const glm::dvec3 u = at(1) - at(0), v = at(2) - at(0), n = glm::cross(u, v);
    middle = at(0) + (u + v) / 3.0;
    const double square = glm::dot(n, n);
    if (!(square > 0)) return;
    area = std::sqrt(square) / 2;
    along[0] = area / square * glm::cross(v, n);
    along[1] = area / square * glm::cross(n, u);
  }

  /// Area times the gradient of one channel of a field with values `of[corner]`.
  template <class Field>
  glm::dvec3 gradient(const Field& of, int channel) const {
    const double origin = of[corner[0]][channel];
    return (of[corner[1]][channel] - origin) * along[0] + (of[corner[2]][channel] - origin) * along[1];
  }
};

}  // namespace unshot
