// Values at vertices that fit best between them, against the functions that they are of.
#include "session/linear_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/build.h"
#include "scene/analytic_scenes.h"
#include "support/solving.h"

namespace unshot {
namespace {

using namespace testing_support;

template <class F>
std::vector<glm::dvec3> atVertices(const Mesh& mesh, F&& f) {
  std::vector<glm::dvec3> out;
  for (const Vertex& vertex : mesh.vertices)
    out.push_back(glm::dvec3(1, 2, 0) * f(glm::dvec3(vertex.position)));
  return out;
}

// RMS over the mesh of what is interpolated minus the function, by seven points a triangle side.
template <class F>
double errorBetween(const Mesh& mesh, const std::vector<glm::dvec3>& values, F&& f) {
  double sum = 0, area = 0;
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    const glm::dvec3 p[] = {glm::dvec3(mesh.vertices[corner[0]].position),
                            glm::dvec3(mesh.vertices[corner[1]].position),
                            glm::dvec3(mesh.vertices[corner[2]].position)};
    const double size = glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 2;
    constexpr int n = 7;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const double u = (i + 1.0 / 3) / n, v = (j + 1.0 / 3) / n, w = 1 - u - v;
        const double off = w * values[corner[0]].x + u * values[corner[1]].x + v * values[corner[2]].x -
                           f(w * p[0] + u * p[1] + v * p[2]);
        sum += size * off * off / (n * (n + 1) / 2);
      }
    }
    area += size;
  }
  return std::sqrt(sum / area);
}

Mesh cube() { return buildMesh(furnaceScene(0.5, 1), {3'000, {}, false}); }

TEST(LinearFit, LeavesWhatIsLinearOnEveryWall) {
  const Mesh mesh = cube();
  const auto f = [](const glm::dvec3& p) { return 5 + p.x - 2 * p.y + 0.5 * p.z; };
  const std::vector<glm::dvec3> values = atVertices(mesh, f), fitted = fitBetween(mesh, values);
  // Positions are in single precision.
  for (std::size_t v = 0; v < values.size(); ++v) EXPECT_LT(glm::length(fitted[v] - values[v]), 1e-5) << v;
}

// On a line the mean square of a parabola minus its interpolation is (f'' h^2)^2 / 120, minus its best fit
// (f'' h^2)^2 / 720: 2.4 times less. Along the edges of a wall the gradients are known on one side only.
TEST(LinearFit, IsNearerToWhatIsRoundThanItsOwnValues) {
  const Mesh mesh = cube();
  const auto round = [](const glm::dvec3& p) { return 4 - glm::dot(p, p); };
  const auto hollow = [](const glm::dvec3& p) { return 1 + glm::dot(p, p); };
  const auto wave = [](const glm::dvec3& p) { return 2 + std::sin(6 * p.x) * std::cos(5 * p.y + 3 * p.z); };
  const auto check = [&](const char* name, auto&& f) {
    const std::vector<glm::dvec3> values = atVertices(mesh, f);
    const double before = errorBetween(mesh, values, f),
                 after = errorBetween(mesh, fitBetween(mesh, values), f);
    measured(std::string(name) + ": error by values over error by fit", before / after);
    EXPECT_GT(before, 1.7 * after) << name;
  };
  check("round", round);
  check("hollow", hollow);
  check("wave", wave);
}

// Where no light comes there is none after it either, and beside a step nothing gets out of hand.
TEST(LinearFit, KeepsTheDarkAndAStepInBounds) {
  const Mesh mesh = cube();
  const auto step = [](const glm::dvec3& p) { return p.x > 0.013 ? 1.0 : 0.0; };
  const std::vector<glm::dvec3> values = atVertices(mesh, step), fitted = fitBetween(mesh, values);
  double most = 0;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (values[v].x == 0) {
      EXPECT_EQ(fitted[v], glm::dvec3(0.0));
    } else {
      EXPECT_GT(fitted[v].x, 0.9);
      most = std::max(most, fitted[v].x);
    }
    EXPECT_EQ(fitted[v].z, 0);
  }
  measured("beside a step of 1, the most", most);
  EXPECT_LT(most, 1.15);
}

}  // namespace
}  // namespace unshot
