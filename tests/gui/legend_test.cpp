// What the legends of the displays say: the quantity, its unit, and values on both sides of 0 where it has
// them.
#include <gmock/gmock.h>
#include <imgui_internal.h>

#include "base/colour.h"
#include "base/text.h"
#include "gui/support/gui_layout.h"
#include "gui/support/panel.h"
#include "support/live_viewer.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing_support::kPanel;
using testing_support::Letters;
using testing_support::LiveViewer;

class Legend : public testing::Test {
 protected:
  Legend() : live_(options()) {
    EXPECT_TRUE(live_.untilPhase(SessionPhase::kConverged));
    rest();
  }
  static LiveViewer::Options options() {
    LiveViewer::Options options;
    options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
    options.solve.elements = 300;
    options.width = 900;
    options.height = 600;
    return options;
  }
  void rest() {
    ASSERT_TRUE(live_.until([&] { return live_->nextFrame(0) > 1e30 && live_->scriptDone(); }));
  }
  void act(const std::string& action, const std::string& argument = {}) {
    live_->perform(action, argument);
    ASSERT_FALSE(live_->error()) << live_->error()->fullText();
    rest();
  }
  /// The letters of the legend at the right; nothing where there is none.
  std::string of(const std::string& display) {
    act("display", display);
    for (int frame = 0; frame < 3; ++frame) live_.draw();
    const ImGuiWindow* window = ImGui::FindWindowByName("false colours");
    std::string out;
    if (!window || !window->Active) return out;
    for (const testing_support::Letter& letter : Letters(*ImGui::GetIO().Fonts).of(*window->DrawList))
      out += letter.text;
    return out;
  }

  LiveViewer live_;
};

// In the unit of the scale, and the same as picking finds there.
TEST_F(Legend, ReadsTheValueUnderTheMouse) {
  EXPECT_THAT(of("false-radiosity"), HasSubstr("pointatthesceneforitsvalue"));
  EXPECT_THAT(of("difference"), Not(HasSubstr("point"))) << "a difference has no value at a point";
  const float width = static_cast<float>(live_.width()) - kPanel, height = static_cast<float>(live_.height());
  act("ambient", "off");  // what is shown has it, what is picked has not
  live_->pick({0.5, 0.9});
  live_.draw();
  const PickedPoint& picked = live_->picking().required();
  struct Display {
    const char* key;
    std::optional<glm::dvec3> (*at)(const std::optional<ProbePlace>&, const Snapshot&);
  };
  for (const auto& [display, at] :
       {Display{"false-radiosity", radiosityAt}, Display{"false-irradiance", irradianceAt}}) {
    act("display", display);
    act("unit", "watts");
    ImGui::GetIO().MousePos = {0.5f * width, 0.9f * height};
    const double value = luminance(*at(picked.place, *live_->state().snapshot));
    EXPECT_THAT(of(display), HasSubstr("underthemouse:" + figureText(value))) << display;
    act("unit", "683");
    EXPECT_THAT(of(display), HasSubstr("underthemouse:" + figureText(683 * value))) << display;
    ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
  }
  act("clean", "legend");
  EXPECT_THAT(of("false-irradiance"), HasSubstr("Irradiance")) << "alone over the scene";
  act("clean", "on");
  EXPECT_EQ(of("false-irradiance"), "");
}

TEST_F(Legend, SaysQuantityAndUnit) {
  EXPECT_EQ(of("radiosity"), "");
  EXPECT_EQ(of("reflectance"), "");
  EXPECT_THAT(of("unshot"), HasSubstr("UnshotradiosityU:whiteat"));
  EXPECT_THAT(of("unshot"), HasSubstr("W/m\u00b2"));
  EXPECT_THAT(of("false-unshot"), HasSubstr("UnshotradiosityU[W/m\u00b2]"));
  EXPECT_THAT(of("residual"), HasSubstr("[W/m\u00b2]"));
  EXPECT_THAT(of("bounces"), HasSubstr("[surfacesmet]"));
  EXPECT_THAT(of("difference"), HasSubstr("alllight\u2212directlightalone"));
  EXPECT_THAT(of("difference"), HasSubstr("%"));
  act("unit", "683");
  EXPECT_THAT(of("residual"), HasSubstr("[lm/m\u00b2]")) << "leaves a surface";
  EXPECT_THAT(of("false-unshot"), HasSubstr("[lm/m\u00b2]"));
  EXPECT_THAT(of("false-irradiance"), HasSubstr("[lux]"));
  EXPECT_THAT(of("bounces"), HasSubstr("[surfacesmet]")) << "is no light";
  EXPECT_THAT(of("difference"), HasSubstr("%"));
}

TEST_F(Legend, GoesToBothSidesOfZeroWhereValuesDo) {
  EXPECT_THAT(of("residual"), Not(HasSubstr("\u2212")));
  const std::string signed_light = of("false-unshot");
  EXPECT_THAT(signed_light, HasSubstr("\u22120."));
  act("logarithmic", "on");
  EXPECT_THAT(of("false-unshot"), HasSubstr("\u2212"));
}

TEST_F(Legend, SaysWhatIsMissingInsteadOfAScaleOfNothing) {
  EXPECT_THAT(of("last-shot"), HasSubstr("nosinglestepwastaken"));
  EXPECT_THAT(of("form-factors"), HasSubstr("nopatchispicked"));
  act("pick", "0.4,0.5");
  EXPECT_THAT(of("form-factors"), HasSubstr("G_ij/A_j[1/m\u00b2]"));
  EXPECT_THAT(of("form-factors"), Not(HasSubstr("nopatch")));
}

// The scale follows what is in view: light that differs little is no even grey.
TEST_F(Legend, OfADifferenceEndsWhereItDoes) {
  act("bounces", "2");
  act("complete-bounces");
  ASSERT_TRUE(live_.until([&] { return !live_->state().bounces_under_way; }));
  of("difference");
  const double second = 1 / live_->exposure();
  act("remember");
  act("bounces", "3");
  of("difference");
  const double third = 1 / live_->exposure();
  EXPECT_LT(third, 0.7 * second) << "the third bounce is less than the second";
  EXPECT_GE(third, 0.01);
}

}  // namespace
}  // namespace unshot
