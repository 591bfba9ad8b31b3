// P = R K among patches: the laws that its form factors keep.
#include "solver/patch_matrix.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

namespace unshot {
namespace {

// Patches that receive as one element each.
struct Patches {
  std::vector<double> area;
  Receivers receivers;
  PatchMatrix matrix;

  explicit Patches(std::vector<double> areas)
      : area(std::move(areas)), receivers(onePerPatch(area)), matrix(receivers, area, std::size_t{1} << 30) {}

  static Receivers onePerPatch(const std::vector<double>& area) {
    Receivers out;
    out.kind = ReceiverKind::kElements;
    out.area = area;
    out.start.resize(area.size() + 1);
    std::iota(out.start.begin(), out.start.end(), 0u);
    for (std::uint32_t p = 0; p < area.size(); ++p) out.shares.push_back({p, p, area[p]});
    return out;
  }

  /// F_pq of all p.
  void set(std::uint32_t q, const std::vector<float>& factors, double defect = 0) {
    Column column;
    column.defect = defect;
    column.k.assign(factors.begin(), factors.end());
    matrix.set(q, column);
  }
};

// Columns with gaps of every length, one of them replaced, against sums over a full table.
TEST(PatchMatrix, MultipliesWhatItWasGiven) {
  constexpr std::uint32_t kPatches = 400;
  std::vector<double> area(kPatches);
  for (std::uint32_t p = 0; p < kPatches; ++p) area[p] = 1 + 0.1 * (p % 7);
  Patches patches(area);
  std::vector<std::vector<float>> factors(kPatches);
  std::size_t known = 0;
  for (int round = 0; round < 2; ++round) {
    for (std::uint32_t q = 0; q < kPatches; ++q) {
      if (q % 5 == 4 || (round == 1 && q % 3 != 0)) continue;  // some stay unknown, some are set again
      factors[q].assign(kPatches, 0.0f);
      // Few of them in some columns.
      for (std::uint32_t p = q % 4; p < kPatches; p += 1 + (p * p + q + round) % (q % 2 ? 6 : 97))
        factors[q][p] = 0.001f * static_cast<float>(1 + (p + 2 * q + round) % 50);
      known += round == 0;
      patches.set(q, factors[q]);
    }
  }
  EXPECT_EQ(patches.matrix.knownCount(), known);
  std::vector<glm::dvec3> x(kPatches), image(kPatches), mean(kPatches);
  for (std::uint32_t p = 0; p < kPatches; ++p) x[p] = {1.0 + p, 2.0 - 0.3 * p, p % 2 ? 0.0 : 1.0};
  patches.matrix.product(x, image);
  patches.matrix.transposed(x, mean);
  for (std::uint32_t p = 0; p < kPatches; ++p) {
    glm::dvec3 arrives(0.0), sent(0.0);
    for (std::uint32_t q = 0; q < kPatches; ++q) {
      if (!factors[q].empty()) arrives += double{factors[q][p]} * x[q];
      if (!factors[p].empty()) sent += area[q] * double{factors[p][q]} * x[q] / area[p];
    }
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(image[p][c], arrives[c], 1e-6 * (1 + std::abs(arrives[c])));
      EXPECT_NEAR(mean[p][c], sent[c], 1e-6 * (1 + std::abs(sent[c])));
      EXPECT_NEAR(patches.matrix.transposed(p, x)[c], sent[c], 1e-6 * (1 + std::abs(sent[c])));
    }
  }
}

// Channels that are equal to the last bit, dark ones exactly, those in proportion to rounding; any that is
// not quite, be it at one patch alone, as if nothing were left out.
TEST(PatchMatrix, TakesChannelsFromOthersOnlyWhereTheyAreAlike) {
  constexpr std::uint32_t kPatches = 50;
  Patches patches(std::vector<double>(kPatches, 1.5));
  for (std::uint32_t q = 0; q < kPatches; ++q) {
    std::vector<float> factors(kPatches);
    for (std::uint32_t p = 0; p < kPatches; ++p)
      factors[p] = 0.001f * static_cast<float>(1 + (3 * p + 7 * q) % 23);
    patches.set(q, factors);
  }
  using Field = std::vector<glm::dvec3>;
  const auto products = [&](const Field& x, bool fewer) {
    patches.matrix.allowFewerChannels(fewer);
    std::array<Field, 2> out{Field(kPatches), Field(kPatches)};
    patches.matrix.product(x, out[0]);
    patches.matrix.transposed(x, out[1]);
    return out;
  };
  const auto field = [](auto&& colour) {
    Field x;
    for (std::uint32_t p = 0; p < kPatches; ++p) x.push_back(colour(p % 3 == 1 ? 0.0 : 0.1 + 0.7 * p));
    return x;
  };
  const auto expectSame = [&](const Field& x) { EXPECT_EQ(products(x, true), products(x, false)); };
  expectSame(field([](double v) { return glm::dvec3(v); }));
  expectSame(field([](double v) { return glm::dvec3(0, v, 0); }));
  expectSame(field([](double v) { return glm::dvec3(v, 1 - v, 0); }));
  expectSame(field([](double) { return glm::dvec3(0.0); }));
  expectSame(field([](double v) { return glm::dvec3(v, v * v, v); }));
  expectSame(field([](double v) { return glm::dvec3(v, v + 1e-6, v - 1e-6); }));
  Field one_apart = field([](double v) { return glm::dvec3(v, 2 * v, 4 * v); });
  expectSame(one_apart);  // powers of 2 round nothing
  one_apart.back().y *= 1 + 1e-6;
  one_apart[1].z = 1e-9;  // where the others are 0
  expectSame(one_apart);
  const Field warm = field([](double v) { return v * glm::dvec3(10, 9.6, 8.8); });
  const auto fewer = products(warm, true), all = products(warm, false);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::uint32_t p = 0; p < kPatches; ++p) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(fewer[k][p][c], all[k][p][c], 1e-12 * all[k][p][c]);
      // They are taken from it.
      EXPECT_EQ(fewer[k][p].y, warm[0].y / warm[0].x * fewer[k][p].x);
    }
  }
}

TEST(FormFactorDefects, AreNoneOfReciprocalFactorsThatAddUp) {
  Patches patches({1, 2, 4});
  // A_p F_pq = 0.25 for all pairs.
  patches.set(0, {0, 0.125f, 0.0625f});
  patches.set(1, {0.25f, 0, 0.0625f});
  patches.set(2, {0.25f, 0.125f, 0});
  const FormFactorDefects defects = patches.matrix.defects();
  EXPECT_EQ(defects.columns, 3u);
  EXPECT_EQ(defects.closure.value(), 0);
  EXPECT_EQ(defects.reciprocity.value(), 0);
}

// sqrt(((a - b)^2 summed) / ((a^2 + b^2) summed)) by hand.
TEST(FormFactorDefects, AreWhatTheDefinitionSays) {
  Patches patches({1, 2, 4});
  patches.set(0, {0, 0.15f, 0.0625f}, 0.1);
  patches.set(1, {0.25f, 0, 0}, -0.2);
  const auto reciprocity = [](double there, double back) {
    return std::sqrt((there - back) * (there - back) / (there * there + back * back));
  };
  FormFactorDefects defects = patches.matrix.defects();
  EXPECT_EQ(defects.columns, 2u);
  EXPECT_NEAR(defects.reciprocity.value(), reciprocity(0.3, 0.25), 1e-6);
  EXPECT_NEAR(defects.closure.value(), std::sqrt((1 * 0.01 + 2 * 0.04) / 3), 1e-12);
  // Light that arrives and does not come back is all error, from whichever side it is met.
  patches.set(2, {0.25f, 0.125f, 0});
  const double d = 0.05 * 0.05 + 0.25 * 0.25, s = 0.3 * 0.3 + 3 * 0.25 * 0.25 + 0.25 * 0.25;
  defects = patches.matrix.defects();
  EXPECT_NEAR(defects.reciprocity.value(), std::sqrt((2 * 0.05 * 0.05 + 2 * 0.25 * 0.25) / (2 * s)), 1e-6);
  EXPECT_NEAR(defects.reciprocity.value(), std::sqrt(d / s), 1e-6);
}

// Errors of one relative size, independent both ways, are told by their size.
TEST(FormFactorDefects, AreTheRelativeErrorOfIndependentFactors) {
  constexpr std::size_t kPatches = 60;
  constexpr double kError = 0.1;
  Patches patches(std::vector<double>(kPatches, 1));
  std::uint32_t state = 1;
  for (std::uint32_t q = 0; q < kPatches; ++q) {
    std::vector<float> factors(kPatches);
    for (std::uint32_t p = 0; p < kPatches; ++p) {
      state = state * 1664525u + 1013904223u;
      factors[p] = p == q ? 0.0f : static_cast<float>(0.01 * (1 + (state >> 31 ? kError : -kError)));
    }
    patches.set(q, factors);
  }
  // 3,540 pairs: the RMS of their differences is known to about a fiftieth.
  EXPECT_NEAR(patches.matrix.defects().reciprocity.value(), kError, 0.1 * kError);
}

}  // namespace
}  // namespace unshot
