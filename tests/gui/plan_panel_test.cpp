// What the solve left out, in the panel: said, opened, and done all the same.
#include "viewer/panels/plan_panel.h"

#include <gmock/gmock.h>
#include <imgui_internal.h>

#include <cstdio>

#include "gui/support/panel.h"
#include "support/live_viewer.h"

namespace unshot {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::StartsWith;
using testing_support::idOf;
using testing_support::LiveViewer;

LiveViewer::Options boxWithAPlan(const std::string& script = {}) {
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 200;
  options.solve.error = 0.1;
  options.script = script;
  options.width = 1020;
  options.height = 1900;  // all of the panel is in it: what is not cannot be clicked
  options.pixels = false;
  return options;
}

std::vector<std::string> keysLeftOut(LiveViewer& live) {
  std::vector<std::string> out;
  for (const PlanLine& line : planLines(*live->state().facts)) {
    if (line.left_out) out.push_back(line.key);
  }
  return out;
}

ImGuiID sectionsOfPanel() {
  char name[32];
  std::snprintf(name, sizeof name, "panel/sections_%08X",
                ImGui::FindWindowByName("panel")->GetID("sections"));
  return ImGui::FindWindowByName(name)->ID;
}

/// As a click on it does, which opens or switches it.
void click(LiveViewer& live, ImGuiID item) {
  ImGui::ActivateItem(item);
  for (int frame = 0; frame < 3; ++frame) {
    live->input();
    live.draw();
  }
}

bool solvedAnew(LiveViewer& live, std::uint64_t epoch) {
  return live.until(
      [&] { return live->state().epoch > epoch && live->state().phase == SessionPhase::kConverged; });
}

TEST(PlanPanel, SaysWhyHowMuchAndHowSure) {
  LiveViewer live(boxWithAPlan());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  const std::vector<PlanLine> lines = planLines(*live->state().facts);
  ASSERT_EQ(lines.size(), live->state().facts->plan.size());
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].key, plan_keys::kOuterSides);
  for (const PlanLine& line : lines) {
    EXPECT_TRUE(line.left_out);
    EXPECT_FALSE(line.title.empty() || line.why.empty() || line.saving.empty() || line.sure.empty())
        << line.key;
  }
}

TEST(PlanPanel, ALineIsOpenedAndSwitchedOffAndOn) {
  LiveViewer live(boxWithAPlan("wait converged\nleft-out on\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  live.draw();
  live.draw();
  const ImGuiID line = idOf("###line", idOf(std::string(plan_keys::kOuterSides), sectionsOfPanel()));
  click(live, line);
  for (const bool done : {true, false}) {
    const std::uint64_t epoch = live->state().epoch;
    click(live, idOf("Do it all the same", line));
    EXPECT_EQ(!leavesOut(live->ui().options.do_anyway, plan_keys::kOuterSides), done);
    ASSERT_TRUE(solvedAnew(live, epoch));
    EXPECT_THAT(planLines(*live->state().facts)[0],
                AllOf(Field(&PlanLine::key, plan_keys::kOuterSides), Field(&PlanLine::left_out, !done)));
  }
  EXPECT_FALSE(live->error());
}

TEST(PlanPanel, EverythingIsSwitchedAtOnce) {
  LiveViewer live(boxWithAPlan("wait converged\nleft-out on\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  const std::vector<std::string> before = keysLeftOut(live);
  const std::uint64_t epoch = live->state().epoch;
  live.draw();
  click(live, idOf("Do everything all the same", sectionsOfPanel()));
  ASSERT_TRUE(solvedAnew(live, epoch));
  EXPECT_THAT(keysLeftOut(live), testing::AnyOf(ElementsAre(), ElementsAre("shooters")));
  std::vector<PlanLine> lines = planLines(*live->state().facts);
  std::erase_if(lines, [](const PlanLine& line) { return line.key == "shooters"; });
  EXPECT_EQ(lines.size(), doAll().size()) << "each can be switched back";
  EXPECT_TRUE(doesAll(live->ui().options.do_anyway)) << "the switch shows it";
  for (const PlanLine& line : lines) EXPECT_THAT(line.title, StartsWith("done all the same: "));
  live->perform("do-all", "off");
  ASSERT_TRUE(solvedAnew(live, epoch + 1));
  EXPECT_EQ(keysLeftOut(live), before);
}

TEST(PlanPanel, ScriptsSwitchByKey) {
  LiveViewer live(
      boxWithAPlan("wait converged\ndo outer-sides on\nwait converged\ndo triangles\nwait converged\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  const Mesh& mesh = *live->state().snapshot->mesh;
  EXPECT_EQ(mesh.sides.size(), 2 * mesh.surfaces.size());
  EXPECT_THAT(live->state().facts->options.do_anyway,
              ElementsAre(plan_keys::kOuterSides, plan_keys::kTriangles));
  live->perform("do", "dark-side on");
  ASSERT_TRUE(live->error());
  EXPECT_THAT(live->error()->what(), HasSubstr("dark-sides, triangles"));
}

}  // namespace
}  // namespace unshot
