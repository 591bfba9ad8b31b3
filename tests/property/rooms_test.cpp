// Rooms that no light joins are solved each by itself: by formulas where each is empty and convex, and by
// rays where something stands in one. The light is what rays through the whole scene make of it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "formfactor/methods.h"
#include "session/scene_plan.h"
#include "support/plan_pairs.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

constexpr int kLowX = 0, kHighX = 1, kBottom = 2, kTop = 3;  // faces of a box

/// Rooms of 1 x 1 x 1 along x with a ceiling that shines.
class RoomsAlongX {
 public:
  RoomsAlongX()
      : grey_(builder_.material("grey", glm::dvec3(0.5))),
        lamp_(builder_.material("lamp", glm::dvec3(0.5), glm::dvec3(1.0))),
        dim_(builder_.material("dim", glm::dvec3(0.3), glm::dvec3(0.02))) {}

  /// From x on, without the face `open`.
  RoomsAlongX& room(double x, int open = -1) { return add(x, lamp_, open); }
  RoomsAlongX& dimRoom(double x, int open = -1) { return add(x, dim_, open); }
  RoomsAlongX& darkRoom(double x) { return add(x, grey_, -1); }
  /// Across x, without the highest part.
  RoomsAlongX& wall(double x, double gap = 0) {
    builder_.quad(grey_, {x, 0, 0}, {0, 1 - gap, 0}, {0, 0, 1});
    return *this;
  }
  RoomsAlongX& block(const glm::dvec3& corner, bool bottom = true) {
    BoxMaterials materials = allOf(grey_);
    if (!bottom) materials[kBottom] = kNone;
    addBox(builder_, materials, corner, glm::dvec3(0.3), false);
    return *this;
  }
  Scene scene() { return builder_.finish(); }

 private:
  RoomsAlongX& add(double x, std::uint32_t ceiling, int open) {
    BoxMaterials materials = allOf(grey_);
    materials[kTop] = ceiling;
    if (open >= 0) materials[static_cast<std::size_t>(open)] = kNone;
    addBox(builder_, materials, {x, 0, 0}, glm::dvec3(1), true);
    return *this;
  }
  SceneBuilder builder_;
  std::uint32_t grey_, lamp_, dim_;
};

std::size_t roomsOf(const Mesh& mesh) {
  std::set<std::uint32_t> rooms;
  for (const Side& side : mesh.sides) rooms.insert(side.room);
  return rooms.size();
}

struct RoomsRow {
  std::string name;
  std::function<Scene()> make;
  std::size_t rooms;
  bool by_formulas;
};

class Rooms : public testing::TestWithParam<RoomsRow> {};

// Against rays that know of no rooms. Both are solved to 1e-6; rays take factors from afar as sums over a few
// points (support/plan_proof.h), and where something stands in a room the same rays are asked in either case.
TEST_P(Rooms, HaveTheLightThatRaysThroughTheWholeSceneFind) {
  const RoomsRow& row = GetParam();
  SolveOptions options = soonest(1e-6);
  options.emit_front_only = true;
  options.elements = 400;
  const auto lean = solved(row.make(), options);
  EXPECT_EQ(roomsOf(lean->mesh()), row.rooms);
  EXPECT_EQ(nothingCanOcclude(lean->mesh()), row.by_formulas);
  EXPECT_EQ(lean->formFactorsKey(), row.by_formulas ? "closed-form" : "rays");
  EXPECT_EQ(keysOf(*lean).count(std::string(plan_keys::kOcclusion)), row.by_formulas ? 1u : 0u);
  options.do_anyway = {std::string(plan_keys::kOcclusion), std::string(plan_keys::kOccluders)};
  const auto with = solved(row.make(), options);
  EXPECT_EQ(with->formFactorsKey(), "rays");
  EXPECT_EQ(roomsOf(with->mesh()), 1u);
  ASSERT_EQ(with->mesh().element_count, lean->mesh().element_count);
  const double apart = difference(*with, *lean);
  measured("apart", apart);
  EXPECT_LT(apart, row.by_formulas ? 5e-5 : 2e-6);
  EXPECT_LT(std::abs(lean->energy().residual()), 1e-9 * lean->energy().emitted);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Rooms,
    testing::Values(
        RoomsRow{"two", [] { return RoomsAlongX().room(0).dimRoom(2).scene(); }, 2, true},
        RoomsRow{"one_dark", [] { return RoomsAlongX().room(0).darkRoom(2).scene(); }, 1, true},
        RoomsRow{"one_wall", [] { return RoomsAlongX().room(0).dimRoom(1, kLowX).scene(); }, 2, true},
        RoomsRow{"three", [] { return RoomsAlongX().room(0).dimRoom(1, kLowX).room(3).scene(); }, 3, true},
        RoomsRow{"crack",
                 [] { return RoomsAlongX().room(0, kHighX).dimRoom(1, kLowX).wall(1, 1e-4).scene(); }, 1,
                 false},
        RoomsRow{"block_in_one",
                 [] {
                   return RoomsAlongX().room(0).dimRoom(2).block({0.3, 0.3, 0.3}).scene();
                 },
                 2, false},
        RoomsRow{"block_on_a_floor",
                 [] {
                   return RoomsAlongX().room(0).dimRoom(2).block({0.3, 0, 0.3}, false).scene();
                 },
                 1, false},
        RoomsRow{"block_between",
                 [] {
                   return RoomsAlongX().room(0).dimRoom(2).block({1.3, 0, 0}).scene();
                 },
                 2, true}),
    [](const auto& row) { return row.param.name; });

// B = E / (1 - rho) in each of two boxes that glow, a thousand times as bright in one as in the other.
TEST(RoomsThatGlow, KeepTheirLight) {
  SceneBuilder b;
  const auto bright = b.material("bright", glm::dvec3(0.9), glm::dvec3(100.0)),
             dim = b.material("dim", glm::dvec3(0.5), glm::dvec3(0.5));
  addBox(b, allOf(bright), {0, 0, 0}, glm::dvec3(1), true);
  addBox(b, allOf(dim), {1.5, 0.2, 0}, glm::dvec3(1), true);
  SolveOptions options = soonest(0.01);
  options.emit_front_only = true;
  const auto solve = solved(b.finish(), options);
  EXPECT_EQ(solve->formFactorsKey(), "closed-form");
  const Mesh& mesh = solve->mesh();
  EXPECT_EQ(roomsOf(mesh), 2u);
  const Snapshot snapshot = solve->snapshot();
  double worst = 0;
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    const Side& side = mesh.sides[mesh.element_side[e]];
    const double exact = side.emission.x / (1 - side.reflectance.x);
    worst = std::max(worst, std::abs(static_cast<double>(snapshot.element_irradiance[e].x) / exact - 1));
  }
  measured("worst of all elements", worst);
  EXPECT_LT(worst, options.error);
}

}  // namespace
}  // namespace unshot
