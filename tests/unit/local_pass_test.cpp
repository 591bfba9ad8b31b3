#include "session/local_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "formfactor/methods.h"
#include "formfactor/transport.h"
#include "session/fields.h"
#include "solver/state.h"
#include "support/plan_pairs.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

double rms(const std::vector<glm::dvec3>& values) {
  double sum = 0;
  for (const glm::dvec3& x : values) sum += glm::dot(x, x);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::vector<glm::dvec3> added(std::vector<glm::dvec3> a, const std::vector<glm::dvec3>& b, double factor) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += factor * b[k];
  return a;
}

// What is seen is geometry: found in the first round, it serves the second, whose light is another. Elements
// are taken apart as the first round's light asks for, which makes little difference.
TEST(LocalPass, GoesOnWithWhatItHasSeen) {
  const auto solve = solved(publishedCornellBox(), soonest(0.08));
  const Mesh& mesh = solve->mesh();
  FormFactorSetup setup;
  setup.mesh = &mesh;
  setup.receivers = std::make_shared<const Receivers>(makeReceivers(mesh, ReceiverKind::kVertices));
  Transport transport(makeRays(setup), *setup.receivers, mesh.patch_area, std::size_t{1} << 30);
  std::vector<glm::dvec3> emission, reflectance;
  for (const std::uint32_t side : mesh.patch_side) {
    emission.push_back(mesh.sides[side].emission);
    reflectance.push_back(mesh.sides[side].reflectance);
  }
  RadiosityState state(transport, emission, reflectance);
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
      const glm::dvec3 all = state.unshot()[q];
      state.shoot(q, all, transport.column(q));
    }
  }
  const auto run = [&](LocalPass& pass, const std::vector<glm::dvec3>& irradiance) {
    pass.begin(state, makeField(mesh, transport.receivers(), irradiance));
    while (pass.running()) pass.advance(transport);
    return pass.irradiance();
  };
  LocalPass pass(mesh, transport.receivers(), true), anew(mesh, transport.receivers(), true);
  const std::vector<glm::dvec3> first = run(pass, state.irradiance());
  const std::vector<glm::dvec3> shown = added(state.irradiance(), first, 1);
  const std::vector<glm::dvec3> second = run(pass, shown), found_anew = run(anew, shown);
  EXPECT_GT(rms(added(second, first, -1)), 1e-3 * rms(shown)) << "the second round changes nothing";
  EXPECT_LT(rms(added(second, found_anew, -1)), 0.05 * rms(added(second, first, -1)));
}

// Threads share out columns and what the pass looks at; the light is the same to the last bit.
TEST(LocalPass, IsTheSameWithAnyNumberOfThreads) {
  SolveOptions options = soonest(0.02);
  options.threads = 1;
  const Snapshot alone = solved(publishedCornellBox(), options)->snapshot();
  options.threads = 3;
  const Snapshot shared = solved(publishedCornellBox(), options)->snapshot();
  ASSERT_GT(alone.irradiance.size(), 2048u);
  EXPECT_EQ(alone.irradiance, shared.irradiance);
}

}  // namespace
}  // namespace unshot
