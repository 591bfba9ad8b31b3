// Every iteration mode against the direct solution of the same form factors, per channel, on scenes of many
// kinds; and the bounds of the solver's error on the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/analytic_scenes.h"
#include "support/assets.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

struct TestScene {
  const char* name;
  Scene (*make)();
  const char* method;
  std::uint64_t elements;
};

// Surfaces that each have two black channels, or that reflect all of one.
Scene colouredCube() {
  Scene scene = cubeOneFaceLit(0.9);
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    scene.materials[m].reflectance = m % 2 ? glm::dvec3(1, 0, 0.5) : glm::dvec3(0, 0.9, 0.99);
  return scene;
}

const TestScene kScenes[] = {
    {"CornellBox", [] { return assetScene("cornell_box.obj"); }, "hemicube", 400},
    {"PublishedCornellBox", [] { return publishedCornellBox(); }, "hemicube", 250},
    {"Furnace", [] { return assetScene("furnace.obj"); }, "closed-form", 200},
    {"TwoPatches", [] { return assetScene("two_patches.obj"); }, "closed-form", 100},
    {"Spheres", [] { return concentricSpheres(0.6, 1, 0.8, 0, 6); }, "hemicube", 300},
    {"LitAndDarkRoom", [] { return litAndDarkRoom(); }, "hemicube", 200},
    {"CubeHalf", [] { return cubeOneFaceLit(0.5); }, "closed-form", 300},
    {"CubeNineTenths", [] { return cubeOneFaceLit(0.9); }, "hemicube", 150},
    {"CubeNearlyWhite", [] { return cubeOneFaceLit(0.99); }, "closed-form", 100},
    {"ColouredCube", colouredCube, "closed-form", 150},
    {"LShapedRoom", [] { return lShapedRoom(); }, "hemicube", 300},
    {"BlockOnFloor", [] { return blockOnFloor(0.4); }, "hemicube", 300},
};

class ModesAgree : public testing::TestWithParam<TestScene> {};

double worstDifference(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, int c) {
  double worst = 0, largest = 0;
  for (std::size_t q = 0; q < a.size(); ++q) {
    worst = std::max(worst, std::abs(a[q][c] - b[q][c]));
    largest = std::max(largest, b[q][c]);
  }
  return largest > 0 ? worst / largest : worst;
}

double medianOf(std::vector<double> x) {
  if (x.empty()) return 0;
  std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end());
  return x[x.size() / 2];
}

struct TrueError {
  double rms = 0, total = 0;
};

/// Of reflected light on patches without emission (on all, where all emit): nRMSE, and sum A |e| / sum A (B*
/// - E).
TrueError trueError(const Solve& solve, const std::vector<glm::dvec3>& exact) {
  const Mesh& mesh = solve.mesh();
  const std::vector<glm::dvec3> now = solve.patchRadiosity();
  double error[2] = {0, 0}, truth[2] = {0, 0}, total[2] = {0, 0}, whole[2] = {0, 0};
  bool some = false;
  for (std::size_t q = 0; q < exact.size(); ++q) {
    const glm::dvec3& emission = mesh.sides[mesh.patch_side[q]].emission;
    const bool dark = emission == glm::dvec3(0.0);
    some = some || dark;
    for (int c = 0; c < 3; ++c) {
      const double e = exact[q][c] - now[q][c], r = exact[q][c] - emission[c];
      error[dark] += mesh.patch_area[q] * e * e;
      truth[dark] += mesh.patch_area[q] * r * r;
      total[dark] += mesh.patch_area[q] * std::abs(e);
      whole[dark] += mesh.patch_area[q] * r;
    }
  }
  return {std::sqrt(error[some] / truth[some]), total[some] / whole[some]};
}

// At a bound of 1e-9 of the RMS error, no patch is off by more than the square root of its share of the area
// times that: 1e-6 leaves a factor of 1000 for the smallest.
TEST_P(ModesAgree, WithTheDirectSolution) {
  SolveOptions options = optionsOf(GetParam().method, GetParam().elements, 1e-9);
  options.draft_first = false;  // bounds are those of the form factors at hand
  const bool cornell = std::string_view(GetParam().name) == "CornellBox";
  options.mode = "direct";
  const auto direct = solved(GetParam().make(), options);
  const std::vector<glm::dvec3> exact = direct->patchRadiosity();
  for (const IterationModeRow& row : iterationModes()) {
    options.mode = row.info.key;
    const auto solve = begun(GetParam().make(), options);
    std::vector<double> ratios, total_ratios;
    std::uint64_t step = 0;
    while (solve->state() == SolveState::kRunning) {
      solve->step();
      // The truth costs a pass, and some modes take few steps.
      if (++step % 7 && !(cornell && solve->measures().bounds.upper < kNoBound)) continue;
      const TrueError error = trueError(*solve, exact);
      const SolverBounds& b = solve->measures().bounds;
      // Rounding of the two solutions.
      ASSERT_LE(error.rms, b.upper * (1 + 1e-9) + 1e-12) << row.info.key << " step " << step;
      ASSERT_GE(error.rms * (1 + 1e-9) + 1e-12, b.lower) << row.info.key << " step " << step;
      ASSERT_LE(error.total, b.total_upper * (1 + 1e-9) + 1e-12) << row.info.key << " step " << step;
      ASSERT_GE(error.total * (1 + 1e-9) + 1e-12, b.total_lower) << row.info.key << " step " << step;
      if (error.rms > 1e-7 && b.upper < kNoBound) ratios.push_back(b.upper / error.rms);
      if (error.total > 1e-7 && b.total_upper < kNoBound) total_ratios.push_back(b.total_upper / error.total);
    }
    EXPECT_EQ(solve->state(), SolveState::kConverged) << row.info.key << ": " << solve->stoppedBy();
    const std::vector<glm::dvec3> found = solve->patchRadiosity();
    for (int c = 0; c < 3; ++c)
      EXPECT_LT(worstDifference(found, exact, c), 1e-6) << row.info.key << " channel " << c;
    const double per_patch = medianOf(ratios), total = medianOf(total_ratios);
    measured(std::string(row.info.key) + ", median of bound over error, RMS", per_patch);
    measured(std::string(row.info.key) + ", median of bound over error, total", total);
    if (cornell) {
      EXPECT_LT(per_patch, 3) << row.info.key;
      EXPECT_LT(total, 3) << row.info.key;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ModesAgree, testing::ValuesIn(kScenes),
                         [](const auto& row) { return std::string(row.param.name); });

// F of a closed cube has one eigenvalue at 1 and the rest near 0, so conjugate gradients need few sweeps
// whatever the reflectance (reference: 8 to 14 with reciprocal factors; the collocated ones here are not
// quite).
TEST(ConjugateGradients, TakeFewSweepsInACubeWhateverItsReflectance) {
  for (const double rho : {0.5, 0.8, 0.9, 0.99, 0.999}) {
    SolveOptions options = optionsOf("closed-form", 600, 1e-9);
    options.mode = "direct";
    const std::vector<glm::dvec3> exact = solved(cubeOneFaceLit(rho), options)->patchRadiosity();
    options.mode = "conjugate-gradient";
    const auto solve = begun(cubeOneFaceLit(rho), options);
    while (solve->state() == SolveState::kRunning && trueError(*solve, exact).rms > 1e-6) solve->step();
    const double sweeps = static_cast<double>(solve->measures().shots) / solve->mesh().patch_count;
    measured("sweeps at " + std::to_string(rho), sweeps);
    EXPECT_LE(sweeps, 20) << rho;
  }
}

}  // namespace
}  // namespace unshot
