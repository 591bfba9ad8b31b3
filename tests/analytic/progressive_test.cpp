// Progressive refinement: how soon the picture is useful.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/obj_reader.h"
#include "support/solving.h"

namespace unshot {
namespace {

using namespace testing_support;

/// nRMSE of the reflected light of patches without emission.
double errorOf(const Mesh& mesh, const std::vector<glm::dvec3>& now, const std::vector<glm::dvec3>& exact) {
  double error = 0, truth = 0;
  for (std::size_t q = 0; q < exact.size(); ++q) {
    if (mesh.sides[mesh.patch_side[q]].emission != glm::dvec3(0.0)) continue;
    for (int c = 0; c < 3; ++c) {
      error += mesh.patch_area[q] * std::pow(now[q][c] - exact[q][c], 2);
      truth += mesh.patch_area[q] * std::pow(exact[q][c], 2);
    }
  }
  return std::sqrt(error / truth);
}

// Against the solution of the full form factors. Shooting patch by patch, southwell would need four fifths of
// the columns to come within 10 %: patches are alike, so no few of them hold most of the light.
TEST(ProgressiveRefinement, IsWithinAFifthAfterATenthOfTheColumnsWithoutAmbient) {
  const auto box = [] { return readObj(std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj"); };
  SolveOptions options = optionsOf("hemicube", 10'000, 1e-6);
  options.mode = "gmres";
  const std::vector<glm::dvec3> exact = solved(box(), options)->patchRadiosity();
  options.mode = "southwell";
  options.draft_first = true;
  options.error = 1e-3;
  const auto solve = begun(box(), options);
  const Mesh& mesh = solve->mesh();
  double at_tenth = 1;
  while (solve->state() == SolveState::kRunning) {
    solve->step();
    if (solve->measures().rows > mesh.patch_count / 10) break;
    at_tenth = errorOf(mesh, solve->patchRadiosity(), exact);
  }
  measured("error after a tenth of the columns", at_tenth);
  EXPECT_LT(at_tenth, 0.2);
}

}  // namespace
}  // namespace unshot
