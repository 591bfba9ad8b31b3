// Final gathering: nearer to the truth than the hemicubes that it starts from.
#include "session/final_gather.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "formfactor/polygon_factor.h"
#include "mesh/build.h"
#include "scene/analytic_scenes.h"
#include "session/gather.h"
#include "session/saved_solve.h"
#include "support/solving.h"
#include "support/temp_folder.h"
#include "support/test_scenes.h"
#include "support/truth.h"

namespace unshot {
namespace {

using namespace testing_support;

/// Of hemicubes too coarse for what they see.
SolveOptions coarselySeen(bool gather) {
  SolveOptions options = optionsOf("hemicube", 2'000, 0.02);
  options.hemicube_resolution = 16;
  options.hemicube_drawing = HemicubeDrawing::kRays;
  options.final_gather = gather;
  return options;
}

TEST(FinalGather, IsNearerToTracedLightThanWhatItStartsFrom) {
  const Truth points = readReferencePoints(std::filesystem::path(UNSHOT_TEST_DATA) / "cornell_published.csv");
  const auto errorOf = [&](bool gather) {
    const auto solve = solved(publishedCornellBox(), coarselySeen(gather));
    EXPECT_EQ(solve->state(), SolveState::kConverged);
    return reflectedError(points, answerProbes(solve->snapshot(), probesOf(points), false));
  };
  const double before = errorOf(false), after = errorOf(true);
  measured("hemicubes of 16 pixels, nRMSE", before);
  measured("gathered, nRMSE", after);
  // Its own noise and the mesh leave 4 %.
  EXPECT_LT(after, 0.05);
  EXPECT_LT(after, 0.7 * before);
}

// The light that a window shows sharpens in stages.
TEST(FinalGather, IsNearerToTracedLightWithEveryRoundOfLooks) {
  const Truth points = readReferencePoints(std::filesystem::path(UNSHOT_TEST_DATA) / "cornell_published.csv");
  auto solve = begun(publishedCornellBox(), coarselySeen(true));
  std::vector<double> errors;
  const auto look = [&] {
    errors.push_back(reflectedError(points, answerProbes(solve->snapshot(), probesOf(points), false)));
    measured("stage " + std::to_string(errors.size()) + ", nRMSE", errors.back());
  };
  while (!solve->gathers()) solve->step();
  look();
  for (const void* shown = solve->gathered(); solve->state() == SolveState::kRunning;) {
    solve->step();
    if (solve->gathered() == shown) continue;
    shown = solve->gathered();
    look();
  }
  ASSERT_GE(errors.size(), 3u);
  EXPECT_LT(errors[1], errors[0]);
  EXPECT_LT(errors[2], errors[1]);
  EXPECT_LT(errors.back(), 1.02 * errors[2]) << "later ones lower what noise is left";
}

// B = 1 solves B = E + rho H in a closed cube of E = 0.5, rho = 0.5, whatever the mesh. Begun with a third
// of it unshot: bounces bring the rest.
TEST(FinalGather, CarriesLightOnToTheEnd) {
  SolveOptions options = optionsOf("hemicube", 600, 0.01);
  options.hemicube_drawing = HemicubeDrawing::kRays;
  options.final_gather = true;
  options.error = 0.3;
  const auto solve = solved(furnaceScene(0.5, 0.5), options);
  const Snapshot snapshot = solve->snapshot();
  double sum = 0, squares = 0;
  for (const glm::vec3& h : snapshot.irradiance) {
    sum += h.x;
    squares += (h.x - 1.0) * (h.x - 1.0);
  }
  const auto n = static_cast<double>(snapshot.irradiance.size());
  measured("mean of H, 1 in truth", sum / n);
  measured("RMS error", std::sqrt(squares / n));
  // The last bounce changes 0.4 % at most, and those that follow four times as much in all.
  EXPECT_NEAR(sum / n, 1, 0.025);
  EXPECT_LT(std::sqrt(squares / n), 0.05);
}

TEST(FinalGather, IsTheSameWithAnyNumberOfThreads) {
  const auto lightOf = [](unsigned threads) {
    SolveOptions options = coarselySeen(true);
    options.elements = 300;
    options.threads = threads;
    return solved(publishedCornellBox(), options)->snapshot().irradiance;
  };
  EXPECT_EQ(lightOf(1), lightOf(3));
}

TEST(FinalGather, IsSavedWithTheSolve) {
  const TempFolder folder;
  SolveOptions options = coarselySeen(true);
  options.elements = 300;
  const auto solve = solved(publishedCornellBox(), options);
  solve->save(folder.path() / "box.solve");
  SolveOptions later = options;
  later.final_gather = std::nullopt;
  const Solve resumed(
      publishedCornellBox(), later, []() -> gl::Context& { return sharedContext(); }, CancelToken{},
      readSavedSolve(folder.path() / "box.solve"));
  EXPECT_EQ(resumed.state(), SolveState::kConverged);
  EXPECT_EQ(resumed.snapshot().irradiance, solve->snapshot().irradiance);
  EXPECT_EQ(*resumed.snapshot().direct, *solve->snapshot().direct);
}

TEST(FinalGather, EndsWithinALimitOfTimeAndSaysWhereThatIsTooShort) {
  const auto within = [](double seconds) {
    SolveOptions options = coarselySeen(true);
    options.elements = 10'000;
    options.hemicube_resolution = 256;
    options.error = 1e-12;
    options.max_seconds = seconds;
    auto solve = begun(publishedCornellBox(), options);
    while (solve->state() == SolveState::kRunning) solve->step();
    return solve;
  };
  const auto saysSo = [](const Solve& solve) {
    return std::any_of(solve.diagnostics().begin(), solve.diagnostics().end(),
                       [](const Diagnostic& d) { return d.code == "not-gathered"; });
  };
  const auto enough = within(4);
  EXPECT_EQ(enough->stoppedBy(), "max_seconds");
  EXPECT_LT(enough->measures().seconds, 5);
  EXPECT_FALSE(saysSo(*enough));
  EXPECT_TRUE(saysSo(*within(1e-3)));
  // It has brought what is still unshot, which must not be counted again.
  EXPECT_GT(enough->measures().unshot_fraction, 0);
  for (const glm::vec3& h : enough->snapshot().ambient) ASSERT_EQ(h, glm::vec3(0.0f));
}

// Forty lamps above a floor, of which half face away: their sum over many looks is the exact factors'.
TEST(FinalGather, DrawsAmongManyLampsWithoutBias) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5)),
             lamp = b.material("lamp", glm::dvec3(0.1), glm::dvec3(3));
  b.quad(grey, {0, 0, 0}, {0, 0, 8}, {8, 0, 0});
  double expected = 0;
  const glm::dvec3 eye{2.3, 0, 1.1};
  std::vector<glm::dvec3> scratch;
  for (int k = 0; k < 40; ++k) {
    const glm::dvec3 at(0.2 * k, 0.3 + 0.1 * (k % 7), 0.15 * ((5 * k) % 40)), u(0.1, 0.02 * (k % 3), 0),
        v(0, 0, 0.1);
    const bool down = k % 2 == 0;
    b.quad(lamp, at, down ? u : v, down ? v : u);
    const glm::dvec3 &first = down ? u : v, &second = down ? v : u;
    const glm::dvec3 ring[4] = {at, at + first, at + first + second, at + second};
    expected += 3 * std::max(pointToPolygonFactor(eye, {0, 1, 0}, ring, scratch), 0.0);
  }
  MeshOptions options;
  options.emit_front_only = true;
  const Mesh mesh = buildMesh(b.finish(), options);
  const Gatherer gatherer(mesh);
  double sum = 0, squares = 0;
  constexpr int kLooks = 4'000;
  double whole = 0;  // of a look at all of them
  for (const Gather::Light& light :
       gatherer.look(eye - mesh.frame_origin, {0, 1, 0}, 1, {.strata = 2, .emitters = 1'000}).lights)
    whole += 3 * static_cast<double>(light.weight);
  EXPECT_NEAR(whole, expected, 1e-4 * expected);
  for (int k = 0; k < kLooks; ++k) {
    double h = 0;
    for (const Gather::Light& light :
         gatherer.look(eye - mesh.frame_origin, {0, 1, 0}, k, {.strata = 2}).lights)
      h += 3 * static_cast<double>(light.weight);
    sum += h;
    squares += h * h;
  }
  const double mean = sum / kLooks, error = std::sqrt((squares / kLooks - mean * mean) / kLooks);
  measured("H straight from lamps", mean);
  measured("expected", expected);
  measured("noise of a look over it", error * std::sqrt(double{kLooks}) / mean);
  ASSERT_GT(expected, 0);
  EXPECT_NEAR(mean, expected, 4 * error + 1e-4 * expected);
  EXPECT_LT(error * std::sqrt(double{kLooks}), 0.15 * mean) << "lamps that face away cost draws";
}

}  // namespace
}  // namespace unshot
