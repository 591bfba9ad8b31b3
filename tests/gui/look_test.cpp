// Pictures of the theme and the curve for the eye (UNSHOT_KEEP_PICTURES=FOLDER); the test only sees that they
// are drawn without an error.
#include <gtest/gtest.h>

#include <cmath>

#include "gui/support/gui_bench.h"
#include "viewer/panels/plot.h"

namespace unshot {
namespace {

using testing_support::GuiBench;
using testing_support::keepPicture;

using Points = std::vector<PlotPoint>;

// Shooting: steep while the lamps shoot, then ever slower.
Points shooting() {
  Points points;
  for (int i = 0; i <= 3000; ++i) {
    const double x = i / 3000.0;
    points.push_back(
        {1.0 * i, 0.45 * std::exp(-40 * x) + 0.4 * std::exp(-9 * x) + 0.15 * std::exp(-5.2 * x)});
  }
  return points;
}

Points straight() {
  Points points;
  for (int i = 0; i <= 160; ++i) points.push_back({i / 100.0, std::pow(10, -i / 160.0 * 6)});
  return points;
}

struct Look {
  std::string name;
  Points points;
  PlotStyle style;
  float width = 280;  // of the plot, at scale 1
  float scale = 1;
  float mouse_x = -1000, mouse_y = -1000;
};

void widgets() {
  int method = 1, elements = 4000;
  float exposure = 0.5f;
  bool ambient = true, edges = false;
  ImGui::TextDisabled("Cornell box  ·  4,032 elements");
  ImGui::Spacing();
  ImGui::PushItemWidth(-7.5f * ImGui::GetFontSize());
  ImGui::Combo("Method", &method, "Gathering\0Shooting\0Southwell\0");
  ImGui::SliderInt("Elements", &elements, 100, 20000);
  ImGui::SliderFloat("Exposure", &exposure, -4, 4, "%+.1f EV");
  ImGui::PopItemWidth();
  ImGui::Checkbox("Ambient term", &ambient);
  ImGui::SameLine();
  ImGui::Checkbox("Edges", &edges);
  ImGui::Button("Start");
  ImGui::SameLine();
  ImGui::Button("Step");
  ImGui::SameLine();
  ImGui::BeginDisabled();
  ImGui::Button("Reset");
  ImGui::EndDisabled();
}

void panel(const Look& look) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float margin = 16 * look.scale;
  ImGui::SetNextWindowPos({margin, margin});
  ImGui::SetNextWindowSize({look.width * look.scale + 2 * style.WindowPadding.x, 0});
  ImGui::Begin("Solve");
  widgets();
  ImGui::Spacing();
  if (ImGui::CollapsingHeader("Convergence", ImGuiTreeNodeFlags_DefaultOpen)) {
    ImGui::Spacing();
    logPlot("curve", look.points, look.style);
  }
  if (ImGui::CollapsingHeader("Statistics")) {
  }
  ImGui::End();
}

class Looks : public testing::TestWithParam<Look> {};

TEST_P(Looks, AreDrawn) {
  const Look& look = GetParam();
  GuiBench::Options options;
  options.scale = look.scale;
  const auto width = static_cast<int>((look.width + 60) * look.scale);
  const auto height = static_cast<int>((look.width * 5 / 9 + 330) * look.scale);
  GuiBench bench(width, height, options);
  ImGui::GetIO().MousePos = {look.mouse_x * look.scale, look.mouse_y * look.scale};
  for (int i = 0; i < 3; ++i) bench.frame([&] { panel(look); }, 26);
  keepPicture(bench.frame([&] { panel(look); }, 26), look.name);
}

Points first(Points points, std::size_t count) {
  points.resize(count);
  return points;
}

const PlotStyle kShots{"shots", "", "Unshot flux", 1e-3, true, 0};

INSTANTIATE_TEST_SUITE_P(
    Gui, Looks,
    testing::Values(
        Look{"Shooting280", shooting(), kShots}, Look{"Shooting560", shooting(), kShots, 560},
        Look{"ShootingTwice", shooting(), kShots, 280, 2},
        Look{"ShootingWideTwice", shooting(), kShots, 560, 2},
        Look{"ShootingEarly", first(shooting(), 300), kShots},
        Look{"Straight280", straight(), {"time", "s", "Residual", 1e-6, false, 0}},
        Look{"Straight560", straight(), {"time", "s", "Residual", {}, true, 0}, 560},
        Look{"Short", {{0, 1}, {1, 0.42}, {2, 0.21}}, {"iterations", "", "Unshot flux", {}, true, 0}},
        Look{"ShortWide", {{0, 1}, {1, 0.42}, {2, 0.21}}, kShots, 560}, Look{"Empty", {}, kShots},
        Look{"Hovered", shooting(), kShots, 280, 1, 180, 330}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace unshot
