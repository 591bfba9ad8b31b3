// A closed cube with one rho and one E everywhere: B = E / (1 - rho) at every point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// Tolerances of a method: of the mean over the cube, of the worst vertex and element, and of the mean over
// the cube's edges. Closed-form rows sum to 1 to rounding everywhere (measured: 1e-6). Counted pixels are
// noisy, and a hemicube stands at points of its patch, so that next to a common edge some light goes to the
// second element in place of the first: measured 2.6 % at rho = 0.9, where what every bounce brings has that
// error.
struct Tolerance {
  double mean, worst, edge_mean;
};

Tolerance toleranceOf(std::string_view method) {
  return method == "closed-form" ? Tolerance{1e-5, 1e-4, 1e-4} : Tolerance{0.001, 0.03, 0.02};
}

struct FurnaceCase {
  FormFactorMethodRow method;
  double rho;
};

std::vector<FurnaceCase> furnaceCases() {
  std::vector<FurnaceCase> out;
  for (const FormFactorMethodRow& row : formFactorMethods()) {
    for (const double rho : {0.5, 0.9}) out.push_back({row, rho});
  }
  return out;
}

class Furnace : public testing::TestWithParam<FurnaceCase> {};

TEST_P(Furnace, IsOfOneRadiosityEverywhere) {
  const auto [method, rho] = GetParam();
  const auto solve = solved(furnaceScene(rho, 1 - rho), optionsOf(method.info.key, 1500, 1e-6));
  const Snapshot snapshot = solve->snapshot();
  const Mesh& mesh = solve->mesh();
  double mean = 0, worst_vertex = 0, worst_element = 0, worst_at_edge = 0, mean_at_edge = 0;
  int at_edge = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double error = radiosity(snapshot, v, false).x - 1;
    worst_vertex = std::max(worst_vertex, std::abs(error));
    const glm::vec3 p = glm::abs(mesh.vertices[v].position);
    if (std::max({std::min(p.x, p.y), std::min(p.y, p.z), std::min(p.x, p.z)}) < 0.4999f) continue;
    worst_at_edge = std::max(worst_at_edge, std::abs(error));
    mean_at_edge += error;
    ++at_edge;
  }
  for (std::size_t e = 0; e < mesh.element_count; ++e) {
    const double error = 1 - rho + rho * static_cast<double>(snapshot.element_irradiance[e].x) - 1;
    worst_element = std::max(worst_element, std::abs(error));
    mean += error * mesh.element_area[e] / 6;
  }
  ASSERT_GT(at_edge, 100);
  mean_at_edge /= at_edge;
  measured("mean error", mean);
  measured("worst vertex", worst_vertex);
  measured("worst element", worst_element);
  measured("worst vertex on an edge of the cube", worst_at_edge);
  measured("mean error on the edges of the cube", mean_at_edge);
  const Tolerance tolerance = toleranceOf(method.info.key);
  EXPECT_LT(std::abs(mean), tolerance.mean);
  EXPECT_LT(worst_vertex, tolerance.worst);
  EXPECT_LT(worst_element, tolerance.worst);
  EXPECT_LT(std::abs(mean_at_edge), tolerance.edge_mean);
}

INSTANTIATE_TEST_SUITE_P(Methods, Furnace, testing::ValuesIn(furnaceCases()), [](const auto& row) {
  return testName(row.param.method.info.key) + "Rho" + std::to_string(static_cast<int>(100 * row.param.rho));
});

// After each sweep of jacobi B is short of the solution by rho^(k+1); the method's own error stays below that
// of the means.
class FurnaceSweeps : public testing::TestWithParam<FormFactorMethodRow> {};

TEST_P(FurnaceSweeps, GainABounceEach) {
  const double rho = 0.5;
  SolveOptions options = optionsOf(GetParam().info.key, 600, 1e-6);
  options.mode = "jacobi";
  const auto solve = begun(furnaceScene(rho, 1 - rho), options);
  const std::uint64_t patches = solve->mesh().patch_count;
  for (int sweep = 1; sweep <= 6; ++sweep) {
    for (std::uint64_t k = 0; k < patches; ++k) solve->step();
    double mean = 0;
    for (const glm::dvec3& b : sideRadiosities(solve->snapshot())) mean += b.x / 6;
    EXPECT_NEAR(1 - mean, std::pow(rho, sweep + 1), 0.005) << "sweep " << sweep;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, FurnaceSweeps,
                         testing::ValuesIn(formFactorMethods().begin(), formFactorMethods().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

// rho^(k+1) and what follows from it: sweeps from B = E to a relative error of 1e-6. Rows are closed to the
// rounding of single precision, so that rho is off by some 1e-7 of itself: nothing to notice but after
// thousands of sweeps.
TEST(FurnaceSweepsOfClosedFormRows, FollowThePowersOfRhoAndTakeTheSweepsOfTheReference) {
  const std::pair<double, int> expected[] = {{0.5, 19}, {0.8, 61}, {0.9, 131}, {0.99, 1374}, {0.999, 13808}};
  for (const auto& [rho, sweeps] : expected) {
    SolveOptions options = optionsOf("closed-form", 6, 1e-9);
    options.mode = "direct";
    const std::vector<glm::dvec3> exact = solved(furnaceScene(rho, 1 - rho), options)->patchRadiosity();
    options.mode = "jacobi";
    const auto solve = begun(furnaceScene(rho, 1 - rho), options);
    const std::uint64_t patches = solve->mesh().patch_count;
    int sweep = 0;
    for (double error = 1; error > 1e-6 && sweep < 20'000;) {
      ++sweep;
      for (std::uint64_t k = 0; k < patches; ++k) solve->step();
      error = 0;
      const std::vector<glm::dvec3> b = solve->patchRadiosity();
      for (std::size_t q = 0; q < b.size(); ++q) error = std::max(error, std::abs(1 - b[q].x / exact[q].x));
      if (sweep <= 50) {
        EXPECT_NEAR(error / std::pow(rho, sweep + 1), 1, 1e-4) << rho << ", sweep " << sweep;
      }
    }
    measured("sweeps at " + std::to_string(rho), sweep);
    EXPECT_NEAR(sweep, sweeps, 2e-4 * sweeps) << rho;
  }
}

}  // namespace
}  // namespace unshot
