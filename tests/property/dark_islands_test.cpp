// Parts of a scene that no light reaches take no part in its solution and cost nothing of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "base/clock.h"
#include "export/probes.h"
#include "mesh/lit.h"
#include "stability/scene_through_obj.h"
#include "support/many_rooms.h"
#include "support/plan_pairs.h"
#include "support/run_program.h"
#include "support/sanitized.h"
#include "support/solving.h"

namespace unshot {
namespace {

using namespace testing_support;

constexpr int kRooms = 12, kRings = 20, kRingsOfOthers = 36;

constexpr double kAskedError = 0.02;

/// On walls, floor and ball of a room.
std::vector<Probe> probesIn(int room) {
  const glm::dvec3 corner = cornerOfRoom(room);
  std::vector<Probe> out;
  for (double a = 0.25; a < 4; a += 0.5) {
    for (double b = 0.25; b < 3; b += 0.5) {
      out.push_back({corner + glm::dvec3(0, b, a), {1, 0, 0}});
      out.push_back({corner + glm::dvec3(4, b, a), {-1, 0, 0}});
      out.push_back({corner + glm::dvec3(a, b, 0), {0, 0, 1}});
      out.push_back({corner + glm::dvec3(a, 0, b), {0, 1, 0}});
    }
  }
  // Beside its poles: on them surfaces meet that join smoothly with some of the others, and rounding says
  // which is nearest.
  out.push_back({corner + glm::dvec3(2.05, 2, 2.02), {0, 1, 0}});
  out.push_back({corner + glm::dvec3(2.05, 0.4, 2.02), {0, -1, 0}});
  return out;
}

struct Timed {
  std::unique_ptr<Solve> solve;
  double cpu_seconds = 0;
};
Timed timed(int rooms) {
  Scene scene = manyRooms(rooms, kRings, kRingsOfOthers);
  const double began = cpuSeconds();
  Timed out;
  out.solve = solved(std::move(scene), soonest(kAskedError));
  out.cpu_seconds = cpuSeconds() - began;
  return out;
}

// More triangles than rays are for, of which light reaches a thirtieth.
TEST(DarkIslands, TakeNoPartInTheSolution) {
  const Timed one = timed(1), many = timed(kRooms);
  const Mesh &alone = one.solve->mesh(), &mesh = many.solve->mesh();
  EXPECT_GT(mesh.triangles.size(), 50'000u);
  EXPECT_EQ(litTriangles(mesh).size(), litTriangles(alone).size());
  EXPECT_EQ(many.solve->formFactorsKey(), one.solve->formFactorsKey());
  EXPECT_EQ(mesh.sides.size(), alone.sides.size());
  EXPECT_EQ(mesh.patch_count, alone.patch_count);
  // Cells are cut where rays, which begin elsewhere by rounding, find shadows.
  EXPECT_NEAR(mesh.element_count, alone.element_count, 0.01 * alone.element_count);

  // The same light but for rays that go elsewhere: to the error asked for.
  const std::vector<Probe> here = probesIn(0);
  const auto a = answerProbes(one.solve->snapshot(), here, false),
             b = answerProbes(many.solve->snapshot(), here, false);
  double apart = 0, light = 0;
  for (std::size_t k = 0; k < here.size(); ++k) {
    ASSERT_TRUE(a[k] && b[k]) << k;
    apart += glm::dot(*a[k] - *b[k], *a[k] - *b[k]);
    light += glm::dot(*a[k], *a[k]);
  }
  measured("apart", std::sqrt(apart / light));
  EXPECT_LT(std::sqrt(apart / light), kAskedError);

  for (const int k : {1, 6, kRooms - 1}) {
    for (const auto& dark : answerProbes(many.solve->snapshot(), probesIn(k), true)) {
      ASSERT_TRUE(dark);
      EXPECT_EQ(*dark, glm::dvec3(0.0)) << "room " << k;
    }
  }
  // Were the dark rooms solved, it would be thirty times. To find out that they are dark takes some 10 us a
  // triangle; machines and the moment make a third.
  measured("CPU over that of the lit room alone", many.cpu_seconds / one.cpu_seconds);
  if (!kSanitized) {
    EXPECT_LT(many.cpu_seconds, 4 * one.cpu_seconds);
  }
}

// 195,000 triangles, alike but for the lamp, of which light reaches a twentieth. Were all lit, they would
// take twenty times what the twentieth does, and more.
TEST(DarkIslands, TakeLittleOfTheTimeAndMemoryOfALargeScene) {
  if (kSanitized) GTEST_SKIP() << "everything takes far longer";
  constexpr int kAll = 20, kRingsOfAll = 50;
  const auto report = [](int rooms) {
    const TempFolder folder;
    writeObj(manyRooms(rooms, kRingsOfAll, kRingsOfAll), folder.path());
    runProgram(folder, {"solve", "scene.obj", "--error", "0.1", "--report", "report.json"});
    return nlohmann::json::parse(folder.read("report.json"));
  };
  const auto one = report(1), all = report(kAll);
  EXPECT_GT(all["scene"]["triangles"], 195'000);
  // Patches join where surfaces meet smoothly, to the rounding of a larger scene.
  EXPECT_NEAR(all["counts"]["patches"], one["counts"]["patches"],
              0.02 * one["counts"]["patches"].get<double>());
  EXPECT_EQ(all["form_factors"], one["form_factors"]);
  const auto ratio = [&](const nlohmann::json& a, const nlohmann::json& b) {
    return a.get<double>() / b.get<double>();
  };
  const double cpu = ratio(all["seconds"]["cpu_solve"], one["seconds"]["cpu_solve"]);
  const double memory = ratio(all["peak_memory_bytes"], one["peak_memory_bytes"]);
  measured("CPU over that of the lit twentieth alone", cpu);
  measured("peak memory over that of the lit twentieth alone", memory);
  measured("peak memory of the whole [MB]", all["peak_memory_bytes"].get<double>() / 1e6);
  EXPECT_LT(cpu, 4);
  EXPECT_LT(memory, 4);
}

/// A room with a lamp and one without, and between them a wall that ends so far below the ceiling.
Scene twoRooms(double gap) {
  SceneBuilder builder;
  const auto grey = builder.material("grey", glm::dvec3(0.5, 0.6, 0.7));
  const auto lamp = builder.material("lamp", glm::dvec3(0.3), glm::dvec3(10));
  BoxMaterials first = allOf(grey), second = allOf(grey);
  first[1] = second[0] = kNone;
  addBox(builder, first, glm::dvec3(0), {4, 3, 4}, true);
  addBox(builder, second, {4, 0, 0}, {4, 3, 4}, true);
  builder.quad(grey, {4, 0, 0}, {0, 3 - gap, 0}, {0, 0, 4});
  builder.quad(lamp, {1.5, 2.8, 1.5}, {1, 0, 0}, {0, 0, 1});
  return builder.finish();
}

// Light might come through: the room behind is solved, and as if the plan looked for nothing dark.
TEST(DarkIslands, ARoomBehindACrackIsNone) {
  const auto plans = [](const Solve& solve) {
    return std::any_of(solve.plan().begin(), solve.plan().end(),
                       [](const PlanDecision& d) { return d.key == plan_keys::kDarkSides; });
  };
  const auto shut = solved(twoRooms(0), soonest(kAskedError)),
             ajar = solved(twoRooms(1e-4), soonest(kAskedError));
  EXPECT_TRUE(plans(*shut));
  EXPECT_FALSE(plans(*ajar));
  SolveOptions all = soonest(kAskedError);
  all.do_anyway = {std::string(plan_keys::kDarkSides)};
  const auto anyway = solved(twoRooms(1e-4), all);
  ASSERT_EQ(ajar->mesh().sides.size(), anyway->mesh().sides.size());
  const std::vector<glm::dvec3> a = ajar->patchRadiosity(), b = anyway->patchRadiosity();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t q = 0; q < a.size(); ++q) EXPECT_EQ(a[q], b[q]) << "patch " << q;
}

}  // namespace
}  // namespace unshot
