#include "viewer/panels/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gui/support/gui_bench.h"
#include "gui/support/gui_layout.h"
#include "viewer/panels/plot_axes.h"
#include "viewer/panels/plot_labels.h"

namespace unshot {
namespace {

using testing_support::expectOnlyInside;
using testing_support::GuiBench;
using testing_support::keepPicture;
using testing_support::Letter;
using testing_support::Letters;
using testing_support::pixelAt;

using Points = std::vector<PlotPoint>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(RoundStep, ExactValues) {
  EXPECT_EQ(roundStep(10, 10), 1);
  EXPECT_EQ(roundStep(10, 5), 2);
  EXPECT_EQ(roundStep(10, 4), 5);
  EXPECT_EQ(roundStep(10, 1), 10);
  EXPECT_EQ(roundStep(3000, 6), 500);
  EXPECT_EQ(roundStep(3001, 6), 1000);
  EXPECT_EQ(roundStep(1, 10), 0.1);
  EXPECT_EQ(roundStep(1, 5), 0.2);
  EXPECT_EQ(roundStep(0.3, 3), 0.1);
  EXPECT_EQ(roundStep(7e-300, 4), 2e-300);
  EXPECT_EQ(roundStep(1e300, 3), 5e299);
  for (double nothing : {0.0, -1.0, kNan, kInfinity}) EXPECT_EQ(roundStep(nothing, 5), 1);
  EXPECT_EQ(roundStep(10, 0), 10);
}

TEST(RoundStep, CutsIntoAtMostThatManyParts) {
  for (double high = 1e-9; high < 1e9; high *= 1.37) {
    for (int most : {1, 2, 3, 5, 8, 13}) {
      const double step = roundStep(high, most);
      EXPECT_LE(high / step, most * (1 + 1e-9)) << high;
      EXPECT_GT(high / step, most / 2.5 * (1 - 1e-9)) << high;
    }
  }
}

TEST(ValueTexts, AreShortAndExact) {
  EXPECT_EQ(valueText(1, true, 1), "100 %");
  EXPECT_EQ(valueText(0.1234, true, 3), "12.3 %");
  EXPECT_EQ(valueText(0.001, true, 1), "0.1 %");
  EXPECT_EQ(valueText(0.09999, true, 3), "10.0 %");
  EXPECT_EQ(valueText(1e-5, true, 1), "0.001 %");
  EXPECT_EQ(valueText(1e-9, true, 1), "10⁻⁷ %");
  EXPECT_EQ(valueText(2.5e-9, true, 2), "2.5×10⁻⁷ %");
  EXPECT_EQ(valueText(1e300, true, 1), "10³⁰² %");
  EXPECT_EQ(valueText(0.125, false, 3), "0.125");
  EXPECT_EQ(valueText(12345, false, 5), "12,345");
  EXPECT_EQ(shortValueText(0.001, true), "0.1 %");
  EXPECT_EQ(shortValueText(0.0015, true), "0.15 %");
  EXPECT_EQ(positionText(1500, ""), "1,500");
  EXPECT_EQ(positionText(-1234567, ""), "−1,234,567");
  EXPECT_EQ(positionText(0.5, "s"), "0.500 s");
}

TEST(ValueAxis, ShowsAtLeastOneWholeDecade) {
  const auto whole = [](const Points& points, std::optional<double> goal = {}) {
    const AxisRange range = valueRange(points, goal);
    EXPECT_GE(std::floor(range.high + 1e-9) - std::ceil(range.low - 1e-9), 1);
    for (const PlotPoint& point : points) {
      EXPECT_GE(std::log10(point.y), range.low);
      EXPECT_LE(std::log10(point.y), range.high + 1e-9);
    }
  };
  whole({});
  whole({}, 1e-3);
  whole({{0, 1}});
  whole({{0, 0.3}, {1, 0.29}});
  whole({{0, 1}, {1, 0.11}});
  whole({{0, 2}, {1, 0.9}});
  whole({{0, 1}, {1, 1e-12}}, 1e-3);
  whole({{0, 5e-324}, {1, 1e308}});
  EXPECT_EQ(valueRange(Points{{0, 1}}, {}).high, 0);
  EXPECT_EQ(valueRange(Points{{0, 1}}, 1.0).low, -1);
}

std::vector<std::string> textsOf(const std::vector<Tick>& ticks) {
  std::vector<std::string> texts;
  for (const Tick& tick : ticks) {
    if (!tick.text.empty()) texts.push_back(tick.text);
  }
  return texts;
}

TEST(ValueAxis, NumbersThinOut) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(textsOf(valueTicks({-3, 0}, true, 90, 15)), (Texts{"0.1 %", "1 %", "10 %", "100 %"}));
  EXPECT_EQ(textsOf(valueTicks({-2, 0}, false, 60, 15)), (Texts{"10⁻²", "10⁻¹", "10⁰"}));
  EXPECT_EQ(textsOf(valueTicks({-12, 0}, true, 90, 15)),
            (Texts{"10⁻¹⁰ %", "10⁻⁷ %", "10⁻⁴ %", "0.1 %", "100 %"}));
  EXPECT_LE(textsOf(valueTicks({-300, 300}, true, 120, 15)).size(), 7u);
  EXPECT_EQ(textsOf(valueTicks({-1, 0}, true, 120, 15)), (Texts{"10 %", "100 %", "20 %", "50 %"}));
}

TEST(PositionAxis, RoundNumbersWithRoom) {
  const auto width = [](const std::string& text) { return 8.0 * static_cast<double>(text.size()); };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(textsOf(positionTicks({0, 3000}, {}, 300, 20, width)), (Texts{"0", "1,000", "2,000", "3,000"}));
  EXPECT_EQ(textsOf(positionTicks({0, 1.6}, {"s"}, 300, 20, width)),
            (Texts{"0 s", "0.5 s", "1.0 s", "1.5 s"}));
  EXPECT_EQ(textsOf(positionTicks({0, 3}, {"", true}, 300, 20, width)), (Texts{"0", "1", "2", "3"}));
  EXPECT_EQ(textsOf(positionTicks({0, 1e9}, {}, 600, 20, width)).back(), "10⁹");
  EXPECT_LE(textsOf(positionTicks({-4e307, 4e307}, {"s"}, 300, 20, width)).size(), 9u);
  EXPECT_EQ(positionRange(Points{}).high, 1);
  EXPECT_EQ(positionRange(Points{{5, 1}, {kInfinity, 1}, {9, 0}}).high, 5);
}

TEST(Thinning, KeepsTheLowestAndHighestOfAColumn) {
  std::vector<ImVec2> pixels;
  for (int i = 0; i < 10000; ++i) {
    pixels.push_back({static_cast<float>(i) / 100, i == 4321 ? 0.0f : i == 4322 ? 99.0f : 50.0f});
  }
  const std::vector<ImVec2> kept = thinnedOut(pixels);
  EXPECT_LE(kept.size(), 202u);
  const auto holds = [&](const ImVec2& p) {
    return std::any_of(kept.begin(), kept.end(), [&](const ImVec2& k) { return k.x == p.x && k.y == p.y; });
  };
  EXPECT_TRUE(holds(pixels.front()) && holds(pixels.back()) && holds(pixels[4321]) && holds(pixels[4322]));
  EXPECT_TRUE(thinnedOut({}).empty());
}

TEST(Labels, NeitherOverlapNorLeaveTheirRectangle) {
  GuiBench bench(100, 60);
  bench.layOut([] {
    PlotLabels labels({10, 10}, {90, 50}, 4);
    EXPECT_TRUE(labels.place("100 %", {0, 0}, {0.5f, 0.5f}, 0));
    EXPECT_EQ(labels.placed()[0].min.x, 10);
    EXPECT_FALSE(labels.place("10 %", {20, 12}, {0, 0}, 0)) << "over the first";
    EXPECT_TRUE(labels.place("10 %", {500, 500}, {0, 0}, 0));
    EXPECT_LE(labels.placed()[1].max.x, 90);
    EXPECT_LE(labels.placed()[1].max.y, 50);
    EXPECT_FALSE(labels.place("wider than the rectangle is", {10, 30}, {0, 0}, 0));
    EXPECT_FALSE(labels.place("", {10, 30}, {0, 0}, 0));
  });
}

// A plot of `width` pixels in a window without edges at (20, 20).
Image8 drawn(GuiBench& bench, const Points& points, float width, const PlotStyle& style) {
  return bench.frame([&] {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("Plot", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground);
    ImGui::PopStyleVar();
    ImGui::SetCursorScreenPos({20, 20});
    ImGui::BeginChild("room", {width, 0});
    ImGui::PushClipRect({0, 0}, {1000, 1000}, false);  // what leaves the plot's rectangle must show
    logPlot("curve", points, style);
    ImGui::PopClipRect();
    ImGui::EndChild();
    ImGui::End();
  });
}

struct Degenerate {
  std::string name;
  Points points;
};

std::vector<Degenerate> degenerates() {
  Points many, noisy;
  for (int i = 0; i < 10000; ++i) {
    many.push_back({1.0 * i, std::exp(-i / 1500.0)});
    noisy.push_back({1.0 * i, i % 2 ? 1.0 : 1e-3});
  }
  return {{"None", {}},
          {"One", {{0, 1}}},
          {"OneFarAway", {{1e12, 1e-40}}},
          {"AllEqual", {{3, 0.2}, {3, 0.2}, {3, 0.2}}},
          {"SameHeight", {{0, 0.5}, {10, 0.5}}},
          {"WidestValues", {{0, 1e-300}, {1, 1e300}}},
          {"Denormal", {{0, 5e-324}, {5e-324, 1.7e308}}},
          {"WidestPositions", {{-1.7e308, 1}, {1.7e308, 0.5}}},
          {"NoNumbers", {{0, kNan}, {kNan, 1}, {kInfinity, 1}, {1, kInfinity}, {2, 0}, {3, -1}}},
          {"SomeNumbers", {{0, kNan}, {1, 0.5}, {2, -kInfinity}, {3, 0.1}}},
          {"Backwards", {{3, 0.5}, {1, 0.1}, {2, 0.7}}},
          {"Many", many},
          {"Noisy", noisy}};
}

class DegeneratePlot : public testing::TestWithParam<Degenerate> {};

TEST_P(DegeneratePlot, DrawsInsideItsRectangle) {
  GuiBench bench(360, 260);
  for (const bool percent : {true, false}) {
    for (const std::optional<double> goal : {std::optional<double>(), std::optional<double>(1e-3)}) {
      ImGui::GetIO().MousePos = {percent ? -1000.0f : 150.0f, 90.0f};
      const PlotStyle style{"shots", "", "Unshot flux", goal, percent, 180};
      const Image8 image = drawn(bench, GetParam().points, 300, style);
      // Under the mouse a tooltip is drawn too, where it likes.
      if (percent) expectOnlyInside(image, 20, 20, 320, 200);
      keepPicture(image, "plot_" + GetParam().name + (percent ? "" : "_hovered") + (goal ? "_goal" : ""));
    }
  }
}

TEST_P(DegeneratePlot, CopesWithAnySize) {
  GuiBench bench(360, 260);
  for (const float width : {1.0f, 7.0f, 40.0f, 90.0f}) {
    for (const float height : {1.0f, 30.0f, 0.0f}) {
      const PlotStyle style{"shots", "s", "Unshot flux", 1e-3, true, height};
      EXPECT_NO_THROW(drawn(bench, GetParam().points, width, style));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Plot, DegeneratePlot, testing::ValuesIn(degenerates()),
                         [](const auto& row) { return row.param.name; });

TEST(Plot, UnderTheMouseStandsTheNearestPoint) {
  GuiBench bench(360, 260);
  const Points points{{0, 1}, {50, 0.1}, {100, 0.01}};
  const PlotStyle style{"shots", "", "", {}, true, 180};
  const auto litColumn = [&](float mouse_x) {
    ImGui::GetIO().MousePos = {-1000, -1000};
    drawn(bench, points, 300, style);
    const Image8 without = drawn(bench, points, 300, style);
    ImGui::GetIO().MousePos = {mouse_x, 60};
    const Image8 with = drawn(bench, points, 300, style);
    int changed_most = 0, column = -1;
    for (int x = 20; x < 320; ++x) {
      int changed = 0;
      for (int y = 50; y < 150; ++y) changed += pixelAt(with, x, y) != pixelAt(without, x, y);
      if (changed > changed_most) changed_most = changed, column = x;
    }
    return changed_most < 90 ? -1 : column;
  };
  EXPECT_EQ(litColumn(-1000), -1);
  const int middle = litColumn(180);
  EXPECT_GT(middle, 150);
  EXPECT_LT(middle, 230);
  EXPECT_EQ(litColumn(195), middle);
  EXPECT_LT(litColumn(80), 100);
}

std::string lettersOfFrame() {
  const Letters letters(*ImGui::GetIO().Fonts);
  const ImDrawData& data = *ImGui::GetDrawData();
  std::string out;
  for (int k = 0; k < data.CmdListsCount; ++k) {
    for (const Letter& letter : letters.of(*data.CmdLists[k])) out += letter.text;
  }
  return out;
}

TEST(Plot, TheCurveHasItsNameBesideItAndUnderTheMouse) {
  GuiBench bench(360, 260);
  const Points points{{0, 1}, {50, 0.1}, {100, 0.01}};
  PlotStyle style{"", "s", "", {}, true, 180};
  const auto shown = [&](float mouse_x) {
    ImGui::GetIO().MousePos = {mouse_x, 60};
    for (int frame = 0; frame < 3; ++frame) drawn(bench, points, 300, style);
    return lettersOfFrame();
  };
  EXPECT_EQ(shown(180).find("unshot"), std::string::npos);
  style.name = "unshot";
  const std::string beside = shown(-1000);
  EXPECT_NE(beside.find("unshot"), std::string::npos) << beside;
  EXPECT_EQ(beside.find("unshot10.0%"), std::string::npos) << beside;
  const std::string hovered = shown(180);
  EXPECT_NE(hovered.find("unshot10.0%"), std::string::npos) << hovered;
}

TEST(Plot, ThousandsOfPointsCostFewVertices) {
  GuiBench bench(360, 260);
  Points points;
  for (int i = 0; i < 10000; ++i) points.push_back({1.0 * i, std::exp(-i / 1500.0)});
  drawn(bench, points, 300, {});
  EXPECT_LT(ImGui::GetDrawData()->TotalVtxCount, 8000);
}

}  // namespace
}  // namespace unshot
