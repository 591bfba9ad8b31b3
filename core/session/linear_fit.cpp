#include "session/linear_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace unshot {
namespace {

// Of the difference between two vertices: how far the middle between them may be from their mean. Beyond, it
// is not a bend that the mesh resolves but a step.
constexpr double kMostBend = 0.25;

using Gradient = std::array<glm::dvec3, 3>;  // one vector a channel

// Of each vertex: the area-weighted mean over its triangles of the gradient of what is interpolated.
std::vector<Gradient> recoveredGradients(const Mesh& mesh, const std::vector<glm::dvec3>& values,
                                         const std::vector<double>& area) {
  std::vector<Gradient> out(values.size());
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    const glm::dvec3 origin(mesh.vertices[corner[0]].position);
    const glm::dvec3 u = glm::dvec3(mesh.vertices[corner[1]].position) - origin,
                     v = glm::dvec3(mesh.vertices[corner[2]].position) - origin, n = glm::cross(u, v);
    const double square = glm::dot(n, n);
    if (!(square > 0)) continue;
    // What grows by 1 from the origin to u or v, and stays along the other; times the triangle's area.
    const double half = 0.5 / std::sqrt(square);
    const glm::dvec3 along_u = half * glm::cross(v, n), along_v = half * glm::cross(n, u);
    const glm::dvec3 to_u = values[corner[1]] - values[corner[0]],
                     to_v = values[corner[2]] - values[corner[0]];
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3 gradient = to_u[c] * along_u + to_v[c] * along_v;
      for (int k = 0; k < 3; ++k) out[corner[k]][c] += gradient;
    }
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    for (glm::dvec3& g : out[k]) g /= area[k] > 0 ? area[k] : 1;
  }
  return out;
}

}  // namespace

std::vector<glm::dvec3> fitBetween(const Mesh& mesh, std::vector<glm::dvec3> values) {
  const std::size_t triangles = mesh.triangle_element.size();
  std::vector<double> area(values.size(), 0.0), triangle_area(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    const glm::dvec3 a(mesh.vertices[corner[0]].position), b(mesh.vertices[corner[1]].position),
        c(mesh.vertices[corner[2]].position);
    triangle_area[t] = glm::length(glm::cross(b - a, c - a)) / 2;
    for (int k = 0; k < 3; ++k) area[corner[k]] += triangle_area[t];
  }
  const std::vector<Gradient> gradient = recoveredGradients(mesh, values, area);
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
