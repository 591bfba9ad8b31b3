// Two squares: what one receives of the other is a form factor with a closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/obj_reader.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

constexpr double kFaceToFace = 0.199824895698, kPerpendicular = 0.200043776075;

// The light is black and its E = 1, so the mean irradiance of the floor (side 0) is the form factor.
double receivedBy(Scene scene, const SolveOptions& options) {
  return sideMeans(solved(std::move(scene), options)->snapshot())[0].x;
}

class TwoSquares : public testing::TestWithParam<FormFactorMethodRow> {
 protected:
  double errorOf(Scene scene, std::uint64_t elements, double exact) {
    const double error =
        receivedBy(std::move(scene), optionsOf(GetParam().info.key, elements, 1e-6)) / exact - 1;
    measured(std::to_string(elements) + " elements, relative error", error);
    return std::abs(error);
  }
};

TEST_P(TwoSquares, ReceiveTheFormFactorFaceToFace) {
  for (const std::uint64_t elements : {200u, 2000u}) {
    EXPECT_LT(errorOf(parallelSquares(0.5), elements, kFaceToFace), 0.005);
  }
}

// Along the common edge the irradiance changes within the last element; 2000 elements are 32 along each side.
TEST_P(TwoSquares, ReceiveTheFormFactorAtARightAngle) {
  EXPECT_LT(errorOf(perpendicularSquares(0.5), 200, kPerpendicular), 0.02);
  EXPECT_LT(errorOf(perpendicularSquares(0.5), 2000, kPerpendicular), 0.005);
}

// The file's figures hold for one radiosity per patch; the floor is lit more in its middle, which sends more
// back: the true means are 0.2 % above them (measured by both methods).
TEST_P(TwoSquares, AgreeWithTheTwoPatchFormulaOfTheBundledScene) {
  SolveOptions options = optionsOf(GetParam().info.key, 3000, 1e-6);
  options.emit_front_only = true;
  const auto solve = solved(readObj(UNSHOT_SOURCE_DIR "/assets/two_patches.obj"), options);
  const std::vector<glm::dvec3> b = sideRadiosities(solve->snapshot());
  const Mesh& mesh = solve->mesh();
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (mesh.sides[k].back) continue;
    const bool light = mesh.sides[k].emission.x > 0;
    measured(light ? "B1" : "B2", b[k].x);
    EXPECT_NEAR(b[k].x, light ? 10.128536 : 0.510271, 0.005 * (light ? 10.128536 : 0.510271));
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, TwoSquares,
                         testing::ValuesIn(formFactorMethods().begin(), formFactorMethods().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

// Closed-form factors are exact at points, so only the trapezoidal mean over vertices has an error: it falls
// with the square of the element's size.
TEST(ClosedForm, ConvergesWithTheSquareOfTheElementsSize) {
  double last = 0;
  for (const std::uint64_t along : {2u, 4u, 8u, 16u}) {
    const double error =
        receivedBy(parallelSquares(0.5), optionsOf("closed-form", 2 * along * along, 1e-6)) / kFaceToFace - 1;
    measured(std::to_string(along) + " elements along an edge, relative error", error);
    if (last != 0) {
      const double order = std::log2(std::abs(last / error));
      measured("order", order);
      EXPECT_GT(order, 1.8);
      EXPECT_LT(order, 2.2);
    }
    last = error;
  }
}

// The common edge does not lower the order of the mean (measured: 2).
TEST(ClosedForm, ConvergesAsFastWithACommonEdge) {
  double last = 0;
  for (const std::uint64_t along : {4u, 8u, 16u, 32u}) {
    const double error =
        receivedBy(perpendicularSquares(0.5), optionsOf("closed-form", 2 * along * along, 1e-6)) /
            kPerpendicular -
        1;
    measured(std::to_string(along) + " elements along an edge, relative error", error);
    if (last != 0) {
      measured("order", std::log2(std::abs(last / error)));
      EXPECT_LT(std::abs(error), 0.3 * std::abs(last));  // an order of 1.7
    }
    last = error;
  }
}

}  // namespace
}  // namespace unshot
