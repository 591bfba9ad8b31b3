// Scenes with path-traced reference values at finer meshes. Those under $UNSHOT_SCENES are passed over where
// it is not set.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "scene/obj_reader.h"
#include "support/deviations.h"
#include "support/solving.h"
#include "support/test_scenes.h"
#include "support/truth.h"

namespace unshot {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

constexpr double kSolverError = 0.003;

/// Standard error of reflectedError() as a figure of all the surfaces, of which the reference has a few
/// hundred points (jackknife).
double spreadOver(const Truth& truth, const Values& values) {
  std::vector<double> without;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    Truth fewer = truth;
    Values fewer_values = values;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    fewer_values.erase(fewer_values.begin() + static_cast<std::ptrdiff_t>(k));
    without.push_back(reflectedError(fewer, fewer_values));
  }
  const auto n = static_cast<double>(without.size());
  double mean = 0, squares = 0;
  for (const double x : without) mean += x / n;
  for (const double x : without) squares += (x - mean) * (x - mean);
  return std::sqrt((n - 1) / n * squares);
}

/// The error of the reflected light at the reference's points: with hemicubes and so many elements, or with
/// rays and a mesh that follows the light. What the program itself estimates, at points of its own, holds it
/// in its interval (widened by two standard errors of what the reference's points say).
double errorAgainst(const fs::path& scene, const fs::path& reference, std::optional<std::uint64_t> elements,
                    bool front_only) {
  SolveOptions options;
  options.form_factors = elements ? "hemicube" : "rays";
  options.elements = elements;
  if (elements) options.error = kSolverError;
  options.emit_front_only = front_only;
  const auto solve = solved(readObj(scene), options);
  const Truth truth = readReferencePoints(reference);
  const Values values = answerProbes(solve->snapshot(), probesOf(truth), false);
  const double error = reflectedError(truth, values), spread = spreadOver(truth, values);
  const ErrorEstimate estimate = solve->estimate(512).total;
  const std::string name =
      scene.filename().string() + ", " + std::to_string(solve->mesh().element_count) + " elements, ";
  measured(name + "nRMSE", error);
  measured(name + "its standard error", spread);
  measured(name + "estimated", estimate.value);
  measured(name + "interval, low", estimate.low);
  measured(name + "interval, high", estimate.high);
  EXPECT_EQ(estimate.places, 512u) << name;
  EXPECT_GE(error, estimate.low - 2 * spread) << name;
  EXPECT_LE(error, estimate.high + 2 * spread) << name;
  return error;
}

// The finer the mesh, the nearer to the reference, down to about 1.5 %: there elements become smaller than a
// hemicube's pixels, and their noise stands beside the reference's own.
TEST(Reference, IsApproachedByTheCornellBoxAsTheMeshIsRefined) {
  const fs::path data = UNSHOT_TEST_DATA;
  const auto error = [&](std::uint64_t elements) {
    return errorAgainst(data / "cornell_published.obj", data / "cornell_published.csv", elements, false);
  };
  const double coarse = error(1'000), middle = error(10'000), fine = error(50'000);
  EXPECT_LT(middle, 0.6 * coarse);
  EXPECT_LT(fine, 0.02);
}

struct Shared {
  const char *name, *scene, *reference;
  std::optional<std::uint64_t> elements;  // without: the mesh follows the light
  bool front_only;
  double tolerance;
};

const Shared kShared[] = {
    {"CornellOriginal",
     "mcguire_cornell/CornellBox-Original.obj",
     "truth/mcguire_cornell_original.csv",
     {},
     false,
     0.04},
    {"CornellOriginalFront",
     "mcguire_cornell/CornellBox-Original.obj",
     "truth/mcguire_cornell_original_emitfront.csv",
     {},
     true,
     0.03},
    {"CornellOriginalHemicubes", "mcguire_cornell/CornellBox-Original.obj",
     "truth/mcguire_cornell_original.csv", 10'000, false, 0.1},
    {"CornellOriginalFrontHemicubes", "mcguire_cornell/CornellBox-Original.obj",
     "truth/mcguire_cornell_original_emitfront.csv", 10'000, true, 0.05},
    {"TeapotBox", "teapot_box/teapot_box.obj", "truth/teapot_box.csv", 30'000, false, 0.08}};

class SharedScene : public testing::TestWithParam<Shared> {};

TEST_P(SharedScene, MeetsItsReference) {
  const char* folder = std::getenv("UNSHOT_SCENES");
  if (!folder) GTEST_SKIP() << "UNSHOT_SCENES is not set";
  const Shared& s = GetParam();
  EXPECT_LT(
      errorAgainst(fs::path(folder) / s.scene, fs::path(folder) / s.reference, s.elements, s.front_only),
      s.tolerance);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedScene, testing::ValuesIn(kShared),
                         [](const auto& row) { return row.param.name; });

// The program's own path tracer against an independent one, in units of both standard errors.
class TracedScene : public testing::TestWithParam<Shared> {};

TEST_P(TracedScene, AgreesWithItsReference) {
  const char* folder = std::getenv("UNSHOT_SCENES");
  if (!folder) GTEST_SKIP() << "UNSHOT_SCENES is not set";
  const Shared& s = GetParam();
  const Truth truth = readReferencePoints(fs::path(folder) / s.reference);
  ReferenceOptions options;
  options.places = placesOf(truth);
  options.emit_front_only = s.front_only;
  options.relative_error = 0.006;
  const Reference reference = traceReference(readObj(fs::path(folder) / s.scene), options);
  Deviations deviations;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const ReferencePoint& ours = reference.points[k];
    if (ours.emission != glm::dvec3(0.0)) continue;
    deviations.add(ours.radiosity.x, truth[k].radiosity.x,
                   std::hypot(ours.standard_error.x, truth[k].standard_error.x));
  }
  measured("paths a point", static_cast<double>(reference.points[0].samples));
  measured("mean square of deviation / standard error", deviations.meanSquare());
  measured("worst of them", deviations.worst);
  EXPECT_GT(deviations.meanSquare(), 0.7);
  EXPECT_LT(deviations.meanSquare(), 1.3);
  EXPECT_LT(deviations.worst, 5);
}

// Each scene once.
INSTANTIATE_TEST_SUITE_P(Scenes, TracedScene, testing::Values(kShared[0], kShared[1], kShared[4]),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace unshot
