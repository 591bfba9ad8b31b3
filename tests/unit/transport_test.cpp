#include "formfactor/transport.h"

#include <gtest/gtest.h>

#include "support/table_method.h"

namespace unshot {
namespace {

using namespace testing_support;

std::vector<float> dense(const Column& column, std::size_t receivers) {
  std::vector<float> out(receivers, 0.0f);
  column.forEach([&](std::uint32_t v, double k) { out[v] = static_cast<float>(k); });
  return out;
}

TEST(Transport, KeepsColumnsWithinItsBudget) {
  const TableSystem system = randomSystem(1, 30, 3, false, 0.9);
  Transport all = system.transport();
  for (std::uint32_t q = 0; q < 30; ++q) all.column(q);
  EXPECT_EQ(all.keptColumns(), 30u);
  const std::size_t bytes = all.keptBytes();
  EXPECT_GE(bytes, 30 * sizeof(float));
  for (const std::size_t budget : {std::size_t{0}, bytes / 3, bytes - 1}) {
    Transport some = system.transport(budget);
    for (int pass = 0; pass < 3; ++pass) {
      for (std::uint32_t q = 0; q < 30; ++q) {
        some.column(q);
        EXPECT_LE(some.keptBytes(), budget);
      }
    }
    EXPECT_LT(some.keptColumns(), 30u);
    if (budget > 0) {
      EXPECT_GT(some.keptColumns(), 0u);
    }
  }
}

TEST(Transport, ComputesAKeptColumnOnce) {
  const TableSystem system = randomSystem(2, 20, 3, false, 0.9);
  Transport transport = system.transport();
  for (int pass = 0; pass < 3; ++pass) {
    for (std::uint32_t q = 0; q < 20; ++q) transport.column(q);
  }
  EXPECT_EQ(transport.computed(), 20u);
  EXPECT_EQ(system.calls->columns, 20);
}

TEST(Transport, ComputesAnotherColumnAgainTheSame) {
  const TableSystem system = randomSystem(3, 20, 3, true, 0.9);
  Transport kept = system.transport(), passing = system.transport(0);
  for (int pass = 0; pass < 2; ++pass) {
    for (std::uint32_t q = 0; q < 20; ++q) {
      const Column one = kept.column(q), other = passing.column(q);
      EXPECT_EQ(dense(one, 80), dense(other, 80));
      EXPECT_EQ(one.escape, other.escape);
      EXPECT_EQ(one.defect, other.defect);
    }
  }
  EXPECT_EQ(kept.computed(), 20u);
  EXPECT_EQ(passing.computed(), 40u);
  EXPECT_EQ(passing.keptBytes(), 0u);
}

TEST(Transport, HasTheLastColumnAtHandEvenWhereNothingIsKept) {
  const TableSystem system = randomSystem(4, 5, 2, false, 0.9);
  Transport transport = system.transport(0);
  for (int k = 0; k < 4; ++k) transport.column(3);
  EXPECT_EQ(transport.computed(), 1u);
}

TEST(Transport, MultipliesAsTheSumOfItsColumns) {
  for (const bool shared : {false, true}) {
    const TableSystem system = randomSystem(5, 25, 4, shared, 1);
    for (const std::size_t budget : {std::size_t{0}, std::size_t{1} << 20}) {
      Transport transport = system.transport(budget);
      std::vector<glm::dvec3> d = system.reflectance, out(transport.receiverCount(), glm::dvec3(7.0));
      d[3] = glm::dvec3(0.0);
      transport.product(d, out);
      for (int c = 0; c < 3; ++c) {
        std::vector<double> x;
        for (const glm::dvec3& value : d) x.push_back(value[c]);
        const std::vector<double> expected = multiply(system.k, x);
        for (std::size_t v = 0; v < out.size(); ++v) EXPECT_NEAR(out[v][c], expected[v], 1e-14);
      }
    }
  }
}

TEST(Transport, SkipsColumnsThatCarryNothing) {
  const TableSystem system = randomSystem(6, 10, 2, false, 0.9);
  Transport transport = system.transport(0);
  std::vector<glm::dvec3> d(10, glm::dvec3(0.0)), out(transport.receiverCount());
  d[4].y = 1;
  transport.product(d, out);
  EXPECT_EQ(system.calls->columns, 1);
}

TEST(Transport, CountsRowsAsComputed) {
  const TableSystem system = randomSystem(7, 10, 2, false, 0.5);
  Transport transport = system.transport();
  const Row row = transport.row(7);
  EXPECT_EQ(transport.computed(), 1u);
  EXPECT_NEAR(row.escape, 0.5, 1e-12);
  for (std::size_t k = 0; k < row.source.size(); ++k) {
    EXPECT_EQ(row.k[k], static_cast<float>(system.k[7][row.source[k]]));
  }
}

}  // namespace
}  // namespace unshot
