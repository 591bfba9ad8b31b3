// Figures as people read them.
#include "base/text.h"

#include <gtest/gtest.h>

#include <limits>

namespace unshot {
namespace {

TEST(Text, CountsHaveCommas) {
  EXPECT_EQ(countText(0), "0");
  EXPECT_EQ(countText(999), "999");
  EXPECT_EQ(countText(1'000), "1,000");
  EXPECT_EQ(countText(1'234'567), "1,234,567");
}

TEST(Text, FiguresHaveThreeDigitsAndExponentsOnlyWhereTheyHelp) {
  EXPECT_EQ(figureText(0), "0");
  EXPECT_EQ(figureText(0.012345), "0.0123");
  EXPECT_EQ(figureText(45.64), "45.6");
  EXPECT_EQ(figureText(-2.5), "-2.5");
  EXPECT_EQ(figureText(123456), "123456");
  EXPECT_EQ(figureText(1.2e-8), "1.2e-08");
  EXPECT_EQ(figureText(1e30), "1e+30");
  EXPECT_EQ(figureText(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Text, PercentagesEndWhereRoundingBegins) {
  EXPECT_EQ(percentText(0.01234), "1.23 %");
  EXPECT_EQ(percentText(1), "100 %");
  EXPECT_EQ(percentText(2e-9), "2e-07 %");
  EXPECT_EQ(percentText(2e-17), "0 %");
  EXPECT_EQ(percentText(-2e-17), "0 %");
}

TEST(Text, DurationsChangeTheirUnit) {
  EXPECT_EQ(durationText(0.00123), "1.2 ms");
  EXPECT_EQ(durationText(0.5), "0.500 s");
  EXPECT_EQ(durationText(12.34), "12.3 s");
  EXPECT_EQ(durationText(200), "3 min 20 s");
  EXPECT_EQ(durationText(7500), "2 h 5 min");
  EXPECT_EQ(durationText(std::numeric_limits<double>::quiet_NaN()), "?");
}

}  // namespace
}  // namespace unshot
