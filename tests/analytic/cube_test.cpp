// A closed cube with one face lit: means of emitter, opposite face and sides; modes and methods against each
// other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

struct FaceMeans {
  double emitter = 0, opposite = 0, side = 0;
};

// Faces of cubeOneFaceLit by their normals: the floor shines.
FaceMeans faceMeans(const Solve& solve) {
  FaceMeans out;
  const std::vector<glm::dvec3> b = sideRadiosities(solve.snapshot());
  for (std::size_t k = 0; k < b.size(); ++k) {
    const double up = solve.mesh().sides[k].normal.y;
    (up > 0.5 ? out.emitter : up < -0.5 ? out.opposite : out.side) += b[k].x;
  }
  out.side /= 4;
  return out;
}

void expectNear(const FaceMeans& means, const FaceMeans& expected, double tolerance) {
  EXPECT_NEAR(means.emitter, expected.emitter, tolerance * expected.emitter);
  EXPECT_NEAR(means.opposite, expected.opposite, tolerance * expected.opposite);
  EXPECT_NEAR(means.side, expected.side, tolerance * expected.side);
}

struct Published {
  double rho;
  FaceMeans six_patches;
};

const Published kPublished[] = {{0.5, {1.0909090981, 0.1817458261, 0.1818362689}},
                                {0.8, {1.5517241536, 0.6895510707, 0.6896811939}}};

class Cube : public testing::TestWithParam<Published> {};

// One patch a face is what the published values solve. A hemicube's columns are means over the patch;
// measured: 5e-4.
TEST_P(Cube, HasTheSixPatchRadiositiesWithOnePatchAFace) {
  const auto solve = solved(cubeOneFaceLit(GetParam().rho), optionsOf("hemicube", 6, 1e-9));
  ASSERT_EQ(solve->mesh().patch_count, 6u);
  const FaceMeans means = faceMeans(*solve), &exact = GetParam().six_patches;
  measured("emitter", means.emitter / exact.emitter - 1);
  measured("opposite", means.opposite / exact.opposite - 1);
  measured("sides", means.side / exact.side - 1);
  expectNear(means, exact, 0.002);
}

// Refined, the two methods solve the same continuous equation with nothing in common but the mesh.
TEST_P(Cube, HasTheSameFaceMeansByEveryMethodWhenRefined) {
  std::vector<FaceMeans> means;
  for (const FormFactorMethodRow& row : formFactorMethods()) {
    means.push_back(faceMeans(*solved(cubeOneFaceLit(GetParam().rho), optionsOf(row.info.key, 2400, 1e-6))));
    measured(std::string(row.info.key) + ", emitter", means.back().emitter);
    measured(std::string(row.info.key) + ", opposite", means.back().opposite);
    measured(std::string(row.info.key) + ", sides", means.back().side);
    expectNear(means.back(), means.front(), 0.005);
  }
}

INSTANTIATE_TEST_SUITE_P(Rho, Cube, testing::ValuesIn(kPublished), [](const auto& row) {
  return std::to_string(static_cast<int>(10 * row.param.rho)) + "Tenths";
});

// The modes differ only in what they shoot next: at a solver error of 1e-8 they are the same solution of the
// same K.
class CubeModes : public testing::TestWithParam<FormFactorMethodRow> {};

TEST_P(CubeModes, AgreeAtEveryVertex) {
  std::vector<std::vector<glm::vec3>> fields;
  for (const IterationModeRow& row : iterationModes()) {
    SolveOptions options = optionsOf(GetParam().info.key, 600, 1e-8);
    options.mode = row.info.key;
    const auto solve = solved(cubeOneFaceLit(0.8), options);
    EXPECT_EQ(solve->modeKey(), row.info.key);
    fields.push_back(solve->snapshot().irradiance);
  }
  for (const auto& field : fields) {
    ASSERT_EQ(field.size(), fields[0].size());
    for (std::size_t v = 0; v < field.size(); ++v)
      EXPECT_NEAR(field[v].x, fields[0][v].x, 1e-5f * fields[0][v].x);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, CubeModes,
                         testing::ValuesIn(formFactorMethods().begin(), formFactorMethods().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

}  // namespace
}  // namespace unshot
