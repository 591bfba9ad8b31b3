// A room without light beside one with light: not a single ray leaks through the wall between, whatever the
// orientation.
#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "support/dice.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

struct Place {
  glm::dmat3 turn{1.0};
  double scale = 1;
  glm::dvec3 shift{0.0};
};

// Solves the two rooms at `place`; every vertex and element of the room x > 1 must be 0 at every look.
void expectDark(const FormFactorMethodRow& method, const Place& place, std::uint64_t seed) {
  SolveOptions options = optionsOf(method.info.key, 600, 1e-3);
  options.seed = seed;
  options.do_anyway = {std::string(plan_keys::kDarkSides)};
  const auto solve = begun(moved(litAndDarkRoom(), place.turn, place.scale, place.shift), options);
  const Mesh& mesh = solve->mesh();
  const double size = glm::length(mesh.bounds_max - mesh.bounds_min);
  // A little off the element, on its own side; a vertex belongs to the room of the elements that show it.
  std::vector<char> dark_vertex(mesh.vertices.size()), dark_element;
  double dark_elements = 0;
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    const Side& side = mesh.sides[mesh.element_side[e]];
    const std::uint32_t local = e - side.first_element;
    const glm::dvec3 centre = mesh.shapes[mesh.surfaces[side.surface].elements.first + local].centre;
    const glm::dvec3 off = centre + 1e-3 * size * side.normal + mesh.frame_origin - place.shift;
    dark_element.push_back((glm::transpose(place.turn) * off / place.scale).x > 1);
    dark_elements += dark_element.back();
  }
  for (std::size_t k = 0; k < mesh.triangle_vertices.size(); ++k) {
    dark_vertex[mesh.triangle_vertices[k]] = dark_element[mesh.triangle_element[k / 3]];
  }
  EXPECT_NEAR(dark_elements, 0.5 * mesh.element_count, 0.1 * mesh.element_count);
  std::size_t lit = 0, leaks = 0;
  const auto look = [&] {
    const Snapshot snapshot = solve->snapshot();
    lit = 0;
    for (std::size_t v = 0; v < dark_vertex.size(); ++v) {
      const glm::vec3 light = snapshot.irradiance[v] + snapshot.ambient[v] + snapshot.unshot[v];
      (dark_vertex[v] ? leaks : lit) += light != glm::vec3(0.0f);
    }
    for (std::size_t e = 0; e < dark_element.size(); ++e) {
      leaks += dark_element[e] && snapshot.element_irradiance[e] != glm::vec3(0.0f);
    }
  };
  for (int step = 0; solve->state() == SolveState::kRunning; ++step) {
    solve->step();
    if (step < 5 || step % 100 == 0) look();
  }
  look();
  EXPECT_EQ(leaks, 0u);
  EXPECT_GT(lit, mesh.vertices.size() / 3);
}

class DarkRoom : public testing::TestWithParam<FormFactorMethodRow> {};

TEST_P(DarkRoom, StaysExactlyDarkWhateverTheSeed) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) expectDark(GetParam(), {}, seed);
}

TEST_P(DarkRoom, StaysExactlyDarkWhateverTheOrientation) {
  Dice dice(11);
  for (int k = 0; k < 4; ++k) expectDark(GetParam(), {dice.rotation(), 1, glm::dvec3(0.0)}, 1);
}

TEST_P(DarkRoom, StaysExactlyDarkWhateverTheScaleAndPlace) {
  Dice dice(12);
  for (const double scale : {1e-3, 1e4})
    expectDark(GetParam(), {dice.rotation(), scale, scale * dice.inCube(10)}, 1);
}

INSTANTIATE_TEST_SUITE_P(Methods, DarkRoom, testing::ValuesIn(occludingMethods()),
                         [](const auto& row) { return testName(row.param.info.key); });

}  // namespace
}  // namespace unshot
