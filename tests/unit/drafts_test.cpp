// Drafts of form factors first, the real ones later: the end is the same.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "solver/state.h"
#include "support/solving.h"
#include "support/table_method.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

/// A table whose drafts of patches without emission send all of their light to their first receiver.
class DraftMethod final : public FormFactorMethod {
 public:
  explicit DraftMethod(const TableSystem& system)
      : system_(system), table_(system.k, system.receivers, system.patch_area, system.calls) {}
  ReceiverKind receiverKind() const override { return table_.receiverKind(); }
  Column column(std::uint32_t q) override { return table_.column(q); }
  Row row(std::uint32_t v) override { return table_.row(v); }
  Column draft(std::uint32_t q, ColumnQuality) override {
    Column out = table_.column(q);
    if (system_.emission[q] != glm::dvec3(0.0)) return out;
    out.receiver.resize(1);
    const double sum = (1 - out.escape - out.defect) * system_.patch_area[q];
    out.k = {static_cast<float>(sum / system_.receivers.area[out.receiver[0]])};
    out.defect =
        1 - out.escape -
        static_cast<double>(out.k[0]) * system_.receivers.area[out.receiver[0]] / system_.patch_area[q];
    out.quality = ColumnQuality::kOnePoint;
    return out;
  }

 private:
  const TableSystem& system_;
  TableMethod table_;
};

Transport draftTransport(const TableSystem& system, std::size_t kept_bytes) {
  Transport transport(std::make_unique<DraftMethod>(system), system.receivers, system.patch_area, kept_bytes);
  transport.allowDrafts(true);
  return transport;
}

void shootUntil(double unshot, RadiosityState& state, Transport& transport) {
  const auto mode = makeSouthwell();
  while (state.unshotPower() > unshot * state.emittedPower() && mode->step(state, transport)) {
  }
}

class Drafts : public testing::TestWithParam<std::size_t> {};

TEST_P(Drafts, EndAtTheSolutionOfTheRealFormFactors) {
  const TableSystem system = randomSystem(11, 24, 3, true, 0.9);
  Transport transport = draftTransport(system, GetParam());
  RadiosityState state(transport, system.emission, system.reflectance);
  shootUntil(1e-3, state, transport);
  EXPECT_EQ(transport.draftCount(), 16u);  // all but the emitters, every third
  const std::vector<double> exact = system.solution(0);
  double worst_draft = 0;
  for (std::uint32_t q = 0; q < 24; ++q)
    worst_draft = std::max(worst_draft, std::abs(state.shot()[q].x - exact[q]) / exact[q]);
  EXPECT_GT(worst_draft, 0.1) << "the drafts are too good to test anything";
  transport.allowDrafts(false);
  for (std::uint32_t q = 0; q < 24; ++q) {
    if (!transport.isDraft(q)) continue;
    const auto [draft, column] = transport.refine(q);
    EXPECT_EQ(draft.quality, ColumnQuality::kOnePoint);
    EXPECT_EQ(column.quality, ColumnQuality::kFull);
    state.replaceColumn(q, draft, column);
    EXPECT_LE(transport.keptBytes(), GetParam());
  }
  EXPECT_EQ(transport.draftCount(), 0u);
  EXPECT_EQ(transport.refined(), 16u);
  shootUntil(1e-13, state, transport);
  // U is the residual; with sum A |U| at 1e-13 of sum A E and reflectances to 0.9, S is within 1e-11.
  for (std::uint32_t q = 0; q < 24; ++q)
    EXPECT_NEAR(state.shot()[q].x, exact[q], 1e-11 * exact[q] + 1e-12) << q;
}

TEST_P(Drafts, KeepEveryReceiversIrradianceAtKTimesS) {
  const TableSystem system = randomSystem(12, 24, 3, false, 0.9);
  Transport transport = draftTransport(system, GetParam());
  RadiosityState state(transport, system.emission, system.reflectance);
  shootUntil(1e-2, state, transport);
  for (std::uint32_t q = 0; q < 24; q += 2) {
    if (!transport.isDraft(q)) continue;
    const auto [draft, column] = transport.refine(q);
    state.replaceColumn(q, draft, column);
  }
  std::vector<glm::dvec3> expected(system.receivers.size());
  transport.product(state.shot(), expected);
  for (std::size_t v = 0; v < expected.size(); ++v)
    EXPECT_LT(glm::length(state.irradiance()[v] - expected[v]), 1e-12 * (1 + glm::length(expected[v]))) << v;
}

// Everything kept, half of it, nothing.
INSTANTIATE_TEST_SUITE_P(Budgets, Drafts,
                         testing::Values(std::size_t{1} << 24, std::size_t{2000}, std::size_t{0}));

TEST(DraftsOfHemicubes, EndAtTheSameLightAndLoseNoEnergy) {
  SolveOptions options = optionsOf("hemicube", 1000, 1e-5);
  const std::unique_ptr<Solve> plain = solved(publishedCornellBox(), options);
  options.draft_first = true;
  const std::unique_ptr<Solve> drafted = begun(publishedCornellBox(), options);
  std::uint64_t most = 0, drawn_before_refining = 0;
  while (drafted->state() == SolveState::kRunning) {
    drafted->step();
    const Measures& m = drafted->measures();
    most = std::max(most, m.drafts);
    if (m.refined == 0) drawn_before_refining = drafted->drawn();
    const EnergyBalance energy = drafted->energy();
    ASSERT_LT(std::abs(energy.residual()), 1e-9 * energy.emitted)
        << m.shots << " shots, " << m.refined << " refined";
  }
  EXPECT_EQ(drafted->state(), SolveState::kConverged) << drafted->stoppedBy();
  EXPECT_GT(most, 50u);
  EXPECT_EQ(drafted->measures().drafts, 0u);
  EXPECT_LT(2 * drawn_before_refining, drafted->drawn()) << "the first picture is not much cheaper";
  measured("hemicubes for the first whole picture, of all",
           static_cast<double>(drawn_before_refining) / static_cast<double>(drafted->drawn()));
  const Snapshot a = plain->snapshot(), b = drafted->snapshot();
  double error = 0, sum = 0;
  for (std::size_t e = 0; e < a.element_irradiance.size(); ++e) {
    const glm::dvec3 difference(a.element_irradiance[e] - b.element_irradiance[e]),
        value(a.element_irradiance[e]);
    error += glm::dot(difference, difference);
    sum += glm::dot(value, value);
  }
  // Both are within about 1e-5 / (1 - rho) of the same solution.
  measured("relative difference", std::sqrt(error / sum));
  EXPECT_LT(std::sqrt(error / sum), 1e-4);
}

TEST(DraftsOfHemicubes, AnotherErrorGoesOnWithoutThem) {
  SolveOptions options = optionsOf("hemicube", 500, 0.05);
  options.draft_first = true;
  const std::unique_ptr<Solve> solve = solved(publishedCornellBox(), options);
  const std::uint64_t refined = solve->measures().refined;
  EXPECT_GT(refined, 0u);
  solve->setError(0.001);
  while (solve->state() == SolveState::kRunning) solve->step();
  EXPECT_EQ(solve->state(), SolveState::kConverged);
  EXPECT_EQ(solve->measures().refined, refined);
}

}  // namespace
}  // namespace unshot
