// Every quantity that the window shows has a tooltip with its unit or its formula, over its name and over its
// value, and form factors have one symbol, G_ij.
#include <gmock/gmock.h>

#include <cctype>

#include "gui/support/mouse.h"
#include "viewer/panels/bounce_panel.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing::Not;
using namespace testing_support;

LiveViewer::Options boxWithTips() {
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 300;
  options.solve.error = 0.05;
  options.script =
      "wait converged\ncomplete-bounces\nwait converged\npick 0.45,0.6\npin-probe\nsection messages on\n";
  options.width = 1000;
  options.height = 2600;  // all of the panel is in it
  return options;
}

class Tips : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(live_.until([&] { return live_->scriptDone(); }));
    ASSERT_TRUE(live_.until([&] { return !live_->state().bounces_under_way; }));
    openSections(*live_);
    mouse_.rest();
  }
  /// Of what is there; empty where it has none.
  std::string tipAt(const ImVec2& at) {
    mouse_.to(at);
    mouse_.frames(1);
    const ImGuiWindow* tip = tooltipShown();
    return tip ? lettersOf(*tip) : std::string();
  }

  LiveViewer live_{boxWithTips()};
  Mouse mouse_{live_};
};

/// A unit, a formula, or that it is counted; letters come without blanks.
bool saysWhatItIs(const std::string& tip) {
  for (const char* mark : {"[", "=", "\u2211", "0to1", "Numberof", "counted"}) {
    if (tip.find(mark) != std::string::npos) return true;
  }
  return false;
}

bool hasDigit(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Words that stand apart from each other in a line, by where they are.
struct Words {
  std::string text;
  ImRect box;
};
std::vector<Words> wordsOf(const ImGuiWindow& window) {
  const float em = ImGui::GetFontSize();
  std::vector<Words> out;
  for (const Letter& letter : Letters(*ImGui::GetIO().Fonts).of(*window.DrawList)) {
    const bool goes_on = !out.empty() && std::abs(letter.box.Min.y - out.back().box.Min.y) < em &&
                         letter.box.Min.x >= out.back().box.Min.x &&
                         letter.box.Min.x - out.back().box.Max.x < 0.7f * em;
    if (!goes_on) out.push_back({"", letter.box});
    out.back().text += letter.text;
    out.back().box.Add(letter.box);
  }
  return out;
}

TEST_F(Tips, OfTheFiguresInThePanelSayUnitOrFormula) {
  const ImGuiWindow* panel = childOf("panel", "sections");
  ASSERT_TRUE(panel);
  ASSERT_EQ(panel->ScrollMax.y, 0) << "make the window of this test higher";
  int figures = 0;
  std::vector<Words> words = wordsOf(*panel);
  for (std::size_t k = 1; k < words.size(); ++k) {
    // A figure at the right of a name; what can be pressed shows a choice.
    const Words &name = words[k - 1], &value = words[k];
    if (!hasDigit(value.text) || std::abs(name.box.Min.y - value.box.Min.y) > 5) continue;
    const std::string tip = tipAt(value.box.GetCenter());
    if (ImGui::GetCurrentContext()->HoveredId != 0 || name.text.starts_with("llvmpipe")) continue;
    ++figures;
    EXPECT_TRUE(saysWhatItIs(tip)) << name.text << " " << value.text << ": '" << tip << "'";
  }
  std::printf("[ MEASURED ] %d figures\n", figures);
  EXPECT_GT(figures, 20);
}

// Not at the right of a name, as other figures are.
TEST_F(Tips, OfTheHistogramSaysItsUnit) {
  live_->perform("histogram", "on");
  mouse_.rest();
  const ImGuiWindow* panel = childOf("panel", "sections");
  ASSERT_TRUE(panel);
  const std::vector<Words> words = wordsOf(*panel);
  const auto title =
      std::find_if(words.begin(), words.end(), [](const Words& one) { return one.text == "Histogram"; });
  ASSERT_NE(title, words.end());
  const std::string tip = tipAt({title->box.GetCenter().x, title->box.Max.y + 3 * ImGui::GetFontSize()});
  EXPECT_THAT(tip, HasSubstr("Whiteat"));
  EXPECT_TRUE(saysWhatItIs(tip)) << tip;
}

TEST_F(Tips, OfTheStatusLineSayUnitOrFormula) {
  const ImGuiWindow* status = ImGui::FindWindowByName("status");
  ASSERT_TRUE(status && status->Active);
  int figures = 0;
  for (const Words& part : wordsOf(*status)) {
    if (!hasDigit(part.text) || part.text.find("llvm") != std::string::npos) continue;  // the renderer's name
    ++figures;
    EXPECT_TRUE(saysWhatItIs(tipAt(part.box.GetCenter()))) << part.text;
  }
  EXPECT_GE(figures, 1);  // which others there are depends on how far the solve is
}

TEST(PickedQuantities, HaveUnitOrFormulaInTheirTips) {
  for (const PickedQuantity& quantity : pickedQuantities()) {
    const std::string unit = "[" + std::string(quantity.unit) + "]", tip(quantity.tip);
    if (!quantity.unit.empty()) {
      EXPECT_THAT(tip, HasSubstr(unit)) << quantity.title;
    } else {
      EXPECT_TRUE(saysWhatItIs(tip) || tip.find("0 to 1") != std::string::npos) << quantity.title;
    }
  }
}

TEST(BounceText, NamesTheTermOfTheSeries) {
  const std::vector<glm::dvec3> power{glm::dvec3(8), glm::dvec3(4), glm::dvec3(2), glm::dvec3(1)};
  EXPECT_EQ(bounceText(power, 0), "B_0 = E, the light emitted: \u2211 A E = 24 W over the three channels");
  EXPECT_EQ(bounceText(power, 1),
            "Bounce 1, B_1 = M E: \u2211 A B_1 is 50 % of the light emitted, 0.5 times E");
  EXPECT_EQ(bounceText(power, 3),
            "Bounce 3, B_3 = M\u00b3 E: \u2211 A B_3 is 12.5 % of the light emitted, 0.5 times bounce 2");
}

TEST_F(Tips, OfFormFactorsHaveTheLecturesSymbol) {
  live_->perform("hemicube-view", "on");
  ASSERT_TRUE(live_.until([&] { return live_->teaching().settled() && live_->teaching().look(); }));
  mouse_.frames(3);
  const ImGuiWindow* window = ImGui::FindWindowByName("hemicube");
  ASSERT_TRUE(window && window->Active);
  EXPECT_THAT(lettersOf(*window), HasSubstr("\u2211\u0394G="));
  const ImRect box = window->Rect();
  const std::string tip = tipAt({box.GetCenter().x, box.Min.y + 0.6f * box.GetHeight()});
  EXPECT_THAT(tip, HasSubstr("\u0394G="));
  EXPECT_THAT(tip, HasSubstr("G_ij="));
  EXPECT_THAT(tip, Not(HasSubstr("F=")));
  const float em = ImGui::GetFontSize();
  EXPECT_THAT(tipAt({box.Min.x + 2 * em, box.Min.y + 1.1f * em}), HasSubstr("128pixels"))
      << "how it is traced";
  for (const LecturePageRow& row : lecturePages()) EXPECT_THAT(row.info.help, Not(HasSubstr("F B")));
  for (const HemicubePictureRow& row : hemicubePictures()) EXPECT_THAT(row.info.help, Not(HasSubstr(" F")));
}

}  // namespace
}  // namespace unshot
