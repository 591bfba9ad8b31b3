// Closed rooms in which things stand, of one radiosity: with E = 1 - rho on every side of every surface B is
// 1 everywhere, whatever the reflectances and the geometry. At a reflectance of 0.99 an error of 1 % in what
// vertices see takes half of it away, so that rows must be closed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// A room with a box that hangs in it and one that stands on its floor, or on it with a bottom of its own.
Scene furnishedRoom(double rho) {
  SceneBuilder b;
  // Every other wall reflects half of it, for the answer is the same.
  const auto white = b.material("white", glm::dvec3(rho), glm::dvec3(1 - rho)),
             grey =
                 b.material("grey", glm::dvec3(rho, rho / 2, rho), glm::dvec3(1 - rho, 1 - rho / 2, 1 - rho));
  addBox(b, allOf(white), {0, 0, 0}, {1, 1, 1}, true);
  addBox(b, allOf(white), {0.6, 0.3, 0.1}, {0.2, 0.3, 0.6}, false);
  addBox(b, allOf(grey), {0.2, 0, 0.2}, {0.3, 0.5, 0.4}, false);
  return b.finish();
}

struct RoomCase {
  const char* method;
  double rho;
  std::uint64_t elements;  // 0: a mesh that follows the light
};

std::vector<RoomCase> roomCases() {
  std::vector<RoomCase> out;
  for (const char* method : {"rays", "hemicube-visibility"}) {
    for (const double rho : {0.5, 0.9, 0.99, 0.999, 0.9999}) out.push_back({method, rho, 400});
  }
  out.push_back({"rays", 0.99, 0});
  return out;
}

class ClosedRooms : public testing::TestWithParam<RoomCase> {};

TEST_P(ClosedRooms, AreOfOneRadiosityWhateverStandsInThem) {
  const auto& [method, rho, elements] = GetParam();
  SolveOptions options;
  options.form_factors = method;
  options.mode = "gmres";
  options.error = elements ? 1e-4 : 0.02;
  if (elements) options.elements = elements;
  const auto solve = solved(furnishedRoom(rho), options);
  const Snapshot snapshot = solve->snapshot();
  double worst = 0, squares = 0, area = 0;
  for (std::size_t v = 0; v < solve->mesh().vertices.size(); ++v)
    worst = std::max(worst, std::abs(radiosity(snapshot, v, false).x - 1));
  for (std::size_t e = 0; e < solve->mesh().element_count; ++e) {
    const Side& side = solve->mesh().sides[solve->mesh().element_side[e]];
    const double error =
        side.emission.x + side.reflectance.x * static_cast<double>(snapshot.element_irradiance[e].x) - 1;
    squares += solve->mesh().element_area[e] * error * error;
    area += solve->mesh().element_area[e];
  }
  measured("RMS error", std::sqrt(squares / area));
  measured("worst vertex", worst);
  // Rows are closed to single precision, 6e-8, which 1 / (1 - rho) makes 6e-4 at most, and the solver is
  // within 1e-4 (in the last case 8e-3). Measured: 2e-4 and 4e-4 at 0.9999, below 2e-5 elsewhere.
  const double tolerance = elements ? 1e-4 + 6e-8 / (1 - rho) : 8e-3;
  EXPECT_LT(std::sqrt(squares / area), tolerance);
  EXPECT_LT(worst, 2 * tolerance);
}

INSTANTIATE_TEST_SUITE_P(Methods, ClosedRooms, testing::ValuesIn(roomCases()), [](const auto& row) {
  return testName(row.param.method) + std::to_string(static_cast<int>(std::lround(1e4 * row.param.rho))) +
         (row.param.elements ? "" : "FollowingLight");
});

}  // namespace
}  // namespace unshot
