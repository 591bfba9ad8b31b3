// What a lecture shows of a solve: form factors of a patch, single shots, and M gathered to groups.
#include "session/insight.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "session/gathered_matrix.h"
#include "session/looking_on.h"
#include "session/solve_inside.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using testing_support::begun;
using testing_support::optionsOf;
using testing_support::publishedCornellBox;
using testing_support::solved;

/// A box from 0 to 1 of two materials with a lamp in the middle of its ceiling, nothing open.
Scene closedBox() {
  SceneBuilder b;
  const auto grey = b.material("grey", {0.5, 0.4, 0.3}), red = b.material("red", {0.7, 0.2, 0.1});
  const auto light = b.material("light", glm::dvec3(0.2), glm::dvec3(3, 2, 1));
  b.quad(grey, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  b.quad(light, {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  b.quad(red, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  b.quad(grey, {1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  b.quad(red, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  b.quad(grey, {0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  return b.finish();
}

/// All that there is to gather, gathered.
std::shared_ptr<const GatheredMatrix> gatheredOf(const Solve& solve) {
  MatrixGatherer gatherer(solve.mesh(), transportOf(solve), stateOf(solve));
  while (gatherer.hasWork()) gatherer.advance();
  return gatherer.matrix();
}

/// P_pq of the solver's own columns.
std::vector<double> factorsOf(const Solve& solve) {
  const Transport& transport = transportOf(solve);
  const std::size_t n = solve.mesh().patch_count;
  std::vector<double> out(n * n, 0.0);
  for (std::uint32_t q = 0; q < n; ++q) {
    const Column* column = transport.kept(q);
    if (!column) continue;
    column->forEach([&](std::uint32_t v, double k) {
      for (std::uint32_t s = transport.receivers().start[v]; s < transport.receivers().start[v + 1]; ++s) {
        const PatchShare& share = transport.receivers().shares[s];
        out[share.patch * n + q] += share.area * k / solve.mesh().patch_area[share.patch];
      }
    });
  }
  return out;
}

class Insights : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Methods, Insights, testing::Values("hemicube", "rays", "closed-form"));

// Sums of a few hundred values kept as float: 1e-6 of 1 and less.
TEST_P(Insights, GroupsOfOnePatchHoldTheSolversOwnFactors) {
  const auto solve = solved(closedBox(), optionsOf(GetParam(), 50, 1e-4));
  const std::uint32_t n = solve->mesh().patch_count;
  ASSERT_LE(n, GatheredMatrix::kMostGroups);
  const auto m = gatheredOf(*solve);
  ASSERT_TRUE(m);
  ASSERT_EQ(m->size(), n);
  EXPECT_EQ(m->missing, 0u);
  const std::vector<double> factors = factorsOf(*solve);
  for (std::uint32_t p = 0; p < n; ++p) {
    for (std::uint32_t q = 0; q < n; ++q) {
      const std::uint32_t i = m->group[p], j = m->group[q];
      EXPECT_NEAR(m->factor(i, j), factors[p * n + q], 1e-12);
      EXPECT_LT(glm::length(m->at(i, j) - stateOf(*solve).reflectance()[p] * factors[p * n + q]), 1e-12);
    }
  }
}

// The plan proves the box closed, so that rows are scaled to 1 but for the float of each value; the closed
// form is pointwise, and next to edges its rows are only nearly 1 before that.
TEST_P(Insights, RowsOfAClosedSceneSumToOne) {
  for (const std::uint64_t elements : {100, 3000}) {
    const auto solve = solved(closedBox(), optionsOf(GetParam(), elements, 1e-3));
    const auto m = gatheredOf(*solve);
    ASSERT_TRUE(m);
    EXPECT_LE(m->size(), GatheredMatrix::kMostGroups);
    const bool closed = !transportOf(*solve).closure().scale.empty();
    for (std::size_t i = 0; i < m->size(); ++i) EXPECT_NEAR(m->rowSum(i), 1, closed ? 1e-5 : 0.05) << i;
  }
}

TEST(GatheredMatrix, GroupsStayOnOneSideAndCoverAllPatches) {
  const auto solve = begun(publishedCornellBox(), optionsOf("hemicube", 5000, 0.1));
  const Mesh& mesh = solve->mesh();
  const std::vector<std::uint32_t> group = patchGroups(mesh, 64);
  ASSERT_EQ(group.size(), mesh.patch_count);
  std::map<std::uint32_t, std::set<std::uint32_t>> sides;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) sides[group[q]].insert(mesh.patch_side[q]);
  EXPECT_LE(sides.size(), 64u);
  EXPECT_GT(sides.size(), 16u);
  for (const auto& [number, of] : sides) EXPECT_EQ(of.size(), 1u) << "group " << number;
  // Fewer than there are sides.
  const std::vector<std::uint32_t> few = patchGroups(mesh, 4);
  EXPECT_LE(std::set<std::uint32_t>(few.begin(), few.end()).size(), 4u);
}

TEST(LookingOn, APatchHasAllItsLightAndReceivesWhatTheSolveSays) {
  auto solve = solved(publishedCornellBox(), optionsOf("hemicube", 1000, 1e-4));
  LookingOn looking(*solve);
  for (const std::uint32_t patch : {0u, 7u, solve->mesh().patch_count - 1}) {
    computeColumn(*solve, patch);
    looking.want({.cut = solve->mesh().cut, .patch = patch});
    looking.refresh(true);
    const PatchInsight* p = looking.shown()->patch.get();
    ASSERT_TRUE(p);
    EXPECT_EQ(p->patch, patch);
    double sent = p->escape + p->defect;
    for (const float f : p->sent) sent += static_cast<double>(f);
    EXPECT_NEAR(sent, 1, 1e-5) << "floats of about a hundred values";
    ASSERT_TRUE(p->sent_over);
    EXPECT_EQ(p->sent_over->values.size(), solve->mesh().vertices.size());
    // B = E + R sum F B to what is unshot, 1e-4 of the light.
    const glm::dvec3 right = p->emission + p->reflectance * p->gathered;
    EXPECT_LT(glm::length(right - p->radiosity), 2e-3 * glm::length(p->radiosity)) << patch;
    EXPECT_LT(glm::length(p->gathered - p->received), 2e-3 * glm::length(p->received)) << patch;
  }
}

TEST(LookingOn, WhatIsWantedOfAnotherMeshIsNotLookedAt) {
  const auto solve = solved(closedBox(), optionsOf("rays", 100, 1e-2));
  LookingOn looking(*solve);
  looking.want({.cut = solve->mesh().cut + 1, .patch = 0u});
  looking.refresh(true);
  EXPECT_FALSE(looking.shown()->patch);
  looking.want({.cut = solve->mesh().cut, .patch = solve->mesh().patch_count});
  looking.refresh(true);
  EXPECT_FALSE(looking.shown()->patch);
}

TEST(LookingOn, AShotIsTheChangeOfTheStateAndItsEnergyAddsUp) {
  const auto solve = begun(publishedCornellBox(), optionsOf("hemicube", 1000, 1e-3));
  LookingOn looking(*solve);
  for (int k = 0; k < 12; ++k) {
    looking.refresh(true);
    const std::uint32_t next = looking.shown()->next;
    const std::vector<glm::dvec3> before = stateOf(*solve).unshot();
    looking.beforeStep();
    solve->step();
    looking.afterStep();
    looking.refresh(true);
    const ShotInsight* shot = looking.shown()->shot.get();
    ASSERT_TRUE(shot);
    if (shot->moved == 0) continue;  // a column was computed
    ASSERT_EQ(shot->moved, 1u);
    EXPECT_EQ(shot->patch, next) << "southwell takes the one with the most unshot power";
    EXPECT_LT(glm::length(shot->sent - shot->area * before[next]), 1e-9 * glm::length(shot->sent));
    const glm::dvec3 all = shot->absorbed + shot->reflected + shot->escaped + shot->defect;
    EXPECT_LT(glm::length(all - shot->sent), 1e-6 * glm::length(shot->sent));
    glm::dvec3 gained(0.0);
    for (std::uint32_t q = 0; q < before.size(); ++q) {
      if (q != next) gained += solve->mesh().patch_area[q] * (stateOf(*solve).unshot()[q] - before[q]);
    }
    EXPECT_LT(glm::length(gained - shot->reflected), 1e-6 * glm::length(shot->sent));
    ASSERT_TRUE(shot->added);
  }
}

}  // namespace
}  // namespace unshot
