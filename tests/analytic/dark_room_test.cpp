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
void expectDark(const Place& place, std::uint64_t seed) {
  SolveOptions options = optionsOf("hemicube", 600, 1e-3);
  options.seed = seed;
  const auto solve = begun(moved(litAndDarkRoom(), place.turn, place.scale, place.shift), options);
  const Mesh& mesh = solve->mesh();
  const double size = glm::length(mesh.bounds_max - mesh.bounds_min);
  // A little off the wall, on the side's own side of it.
  const auto inDarkRoom = [&](const glm::dvec3& p, const glm::dvec3& normal) {
    const glm::dvec3 off = p + 1e-3 * size * normal + mesh.frame_origin - place.shift;
    return (glm::transpose(place.turn) * off / place.scale).x > 1;
  };
  std::vector<char> dark_vertex, dark_element;
  for (const Vertex& v : mesh.vertices) {
    dark_vertex.push_back(inDarkRoom(glm::dvec3(v.position), mesh.sides[v.side].normal));
  }
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    const Side& side = mesh.sides[mesh.element_side[e]];
    const std::uint32_t local = e - side.first_element;
    dark_element.push_back(
        inDarkRoom(mesh.shapes[mesh.surfaces[side.surface].elements.first + local].centre, side.normal));
  }
  EXPECT_NEAR(std::count(dark_element.begin(), dark_element.end(), 1), 0.5 * mesh.element_count,
              0.1 * mesh.element_count);
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

TEST(DarkRoom, StaysExactlyDarkWhateverTheSeed) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) expectDark({}, seed);
}

TEST(DarkRoom, StaysExactlyDarkWhateverTheOrientation) {
  Dice dice(11);
  for (int k = 0; k < 4; ++k) expectDark({dice.rotation(), 1, glm::dvec3(0.0)}, 1);
}

TEST(DarkRoom, StaysExactlyDarkWhateverTheScaleAndPlace) {
  Dice dice(12);
  for (const double scale : {1e-3, 1e4}) expectDark({dice.rotation(), scale, scale * dice.inCube(10)}, 1);
}

}  // namespace
}  // namespace unshot
