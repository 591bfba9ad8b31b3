#include "session/linear_fit.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "mesh/triangle_slope.h"

namespace unshot {
namespace {

// Of the larger of two values: how far the middle between them may be from their mean. Gradients of slivers
// may lead anywhere; beside a step from nothing to light the bend is a sixteenth of it.
constexpr double kMostBend = 0.25;

using Gradient = std::array<glm::dvec3, 3>;  // one vector a channel

}  // namespace

std::vector<glm::dvec3> fitBetween(const Mesh& mesh, std::vector<glm::dvec3> values) {
  const std::size_t triangles = mesh.triangle_element.size();
  std::vector<double> area(values.size(), 0.0), triangle_area;
  triangle_area.reserve(triangles);
  // The area-weighted mean over a vertex's triangles of the gradients of what is interpolated.
  std::vector<Gradient> gradient(values.size());
  for (std::size_t t = 0; t < triangles; ++t) {
    const TriangleSlope triangle(mesh, t);
    triangle_area.push_back(triangle.area);
    for (int k = 0; k < 3; ++k) area[triangle.corner[k]] += triangle.area;
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3 slope = triangle.gradient(values, c);
      for (int k = 0; k < 3; ++k) gradient[triangle.corner[k]][c] += slope;
    }
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    for (glm::dvec3& g : gradient[k]) g /= area[k] > 0 ? area[k] : 1;
  }
  std::vector<glm::dvec3> shift(values.size(), glm::dvec3(0.0));
  for (std::size_t t = 0; t < triangles; ++t) {
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    // How far the field is from its interpolation in the middle of the edge from corner k to the next, as the
    // cubic with these gradients has it.
    std::array<glm::dvec3, 3> bend;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corner[k], b = corner[(k + 1) % 3];
      const glm::dvec3 edge = glm::dvec3(mesh.vertices[b].position) - glm::dvec3(mesh.vertices[a].position);
      for (int c = 0; c < 3; ++c) bend[k][c] = glm::dot(gradient[a][c] - gradient[b][c], edge) / 8;
      const glm::dvec3 most = kMostBend * glm::max(glm::abs(values[a]), glm::abs(values[b]));
      bend[k] = glm::clamp(bend[k], -most, most);
    }
    // The integral of the hat function of each corner times 4 bend l_a l_b, l being barycentric coordinates,
    // over that of the hat function.
    for (std::size_t k = 0; k < 3; ++k)
      shift[corner[k]] += triangle_area[t] * (0.4 * (bend[k] + bend[(k + 2) % 3]) + 0.2 * bend[(k + 1) % 3]);
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!(area[k] > 0)) continue;
    for (int c = 0; c < 3; ++c) {
      if (values[k][c] > 0) values[k][c] = std::max(values[k][c] + shift[k][c] / area[k], 0.0);
    }
  }
  return values;
}

}  // namespace unshot
