#include "formfactor/delta_form_factors.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace unshot {
namespace {

class DeltaFormFactors : public testing::TestWithParam<std::uint32_t> {
 protected:
  HemicubeLayout layout_{GetParam()};
  std::vector<double> delta_ = deltaFormFactors(layout_);

  double at(std::uint32_t face, std::uint32_t row, std::uint32_t column) const {
    return delta_[std::size_t{layout_.faceRow(face) + row} * layout_.width() + column];
  }
};

TEST_P(DeltaFormFactors, HaveOneValuePerPixelAllAboveZero) {
  ASSERT_EQ(delta_.size(), std::size_t{layout_.width()} * layout_.height());
  for (const double d : delta_) EXPECT_GT(d, 0);
}

TEST_P(DeltaFormFactors, SumToOne) {
  double sum = 0;
  for (const double d : delta_) sum += d;
  EXPECT_NEAR(sum, 1, 1e-12);
}

// Gauss and Legendre's rule of 8 points along each axis, on 4 x 4 parts of the pixel, so that even the two
// pixels across of the coarsest hemicube are integrated to 1e-10.
TEST_P(DeltaFormFactors, EqualTheIntegralOverTheirPixel) {
  constexpr std::array<double, 4> kNode = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                           0.9602898564975363};
  constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                             0.1012285362903763};
  const std::uint32_t n = layout_.resolution, every = n > 16 ? n / 16 - 1 : 1;
  const double step = 2.0 / n;
  const auto integral = [&](auto&& f, double x, double y) {
    const double part = step / 4;
    double sum = 0;
    for (int cell = 0; cell < 16; ++cell) {
      for (int k = 0; k < 64; ++k) {
        const auto i = static_cast<std::size_t>(k % 8), j = static_cast<std::size_t>(k / 8);
        const double u = i < 4 ? -kNode[i] : kNode[i - 4], v = j < 4 ? -kNode[j] : kNode[j - 4];
        const double px = x + part * (cell % 4 + (1 + u) / 2), py = y + part * (cell / 4 + (1 + v) / 2);
        sum += kWeight[i % 4] * kWeight[j % 4] * part * part / 4 * f(px, py);
      }
    }
    return sum / std::numbers::pi;
  };
  const auto top = [](double x, double y) { return 1 / std::pow(1 + x * x + y * y, 2); };
  const auto side = [](double x, double z) { return z / std::pow(1 + x * x + z * z, 2); };
  for (std::uint32_t face = 0; face < 5; ++face) {
    for (std::uint32_t j = 0; j < layout_.faceHeight(face); j += every) {
      for (std::uint32_t i = 0; i < n; i += every) {
        const double expected =
            face == 0 ? integral(top, -1 + i * step, -1 + j * step) : integral(side, -1 + i * step, j * step);
        EXPECT_NEAR(at(face, j, i), expected, 1e-10 * expected + 1e-14) << face << " " << j << " " << i;
      }
    }
  }
}

// Mirrored pixels are computed from mirrored corners; rounding of the four corner terms leaves about 1e-15.
TEST_P(DeltaFormFactors, AreSymmetric) {
  const std::uint32_t n = layout_.resolution;
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      EXPECT_NEAR(at(0, j, i), at(0, i, j), 1e-14);
      EXPECT_NEAR(at(0, j, i), at(0, n - 1 - j, i), 1e-14);
      EXPECT_NEAR(at(0, j, i), at(0, j, n - 1 - i), 1e-14);
    }
  }
  for (std::uint32_t j = 0; j < n / 2; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      EXPECT_NEAR(at(1, j, i), at(1, j, n - 1 - i), 1e-14);
      for (std::uint32_t face = 2; face < 5; ++face) EXPECT_EQ(at(face, j, i), at(1, j, i));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, DeltaFormFactors, testing::Values(2u, 6u, 64u, 256u),
                         [](const auto& row) { return "Pixels" + std::to_string(row.param); });

}  // namespace
}  // namespace unshot
