// Picking in the viewer: clicked or by script, live values, probes, marks.
#include "viewer/picking.h"

#include <gmock/gmock.h>
#include <imgui_internal.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "formfactor/polygon_factor.h"
#include "gui/support/panel.h"
#include "gui/support/program_pictures.h"
#include "render/camera.h"
#include "support/assets.h"
#include "support/live_viewer.h"
#include "viewer/scene_area.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing_support::kCornellBox;
using testing_support::kPanel;
using testing_support::kTwoPatches;
using testing_support::LiveViewer;
using testing_support::picture;
using testing_support::ProgramResult;
using testing_support::runProgram;
using testing_support::runScript;
using testing_support::TempFolder;

// In the picture that the scene's own camera makes: floor in front of the blocks.
const std::string kFloor = "pick 0.5,0.93\n";

LiveViewer::Options boxToPickFrom(const std::string& script = {}) {
  LiveViewer::Options options;
  options.scene = kCornellBox;
  options.solve.elements = 300;
  options.solve.error = 0.1;
  options.script = script;
  options.width = 700 + kPanel;
  options.height = 700;
  options.pixels = false;
  return options;
}

const PickedPoint& picked(LiveViewer& live) { return live->picking().required(); }

glm::dvec3 probed(LiveViewer& live, const Probe& probe) {
  const auto answers = answerProbes(*live->state().snapshot, std::span(&probe, 1), false);
  return answers.front().value_or(glm::dvec3(-1));
}

void expectFloor(LiveViewer& live) {
  ASSERT_TRUE(live->picking().picked());
  EXPECT_NEAR(picked(live).probe.position.y, 0, 1e-5);
  EXPECT_LT(glm::length(picked(live).probe.normal - glm::dvec3(0, 1, 0)), 1e-6);
}

/// As a hand does: presses there, moves on by `drag`, lets go.
void click(LiveViewer& live, const ImVec2& at, const ImVec2& drag = {0, 0}) {
  ImGuiIO& io = ImGui::GetIO();
  const auto frame = [&] {
    live->input();
    live.draw();
  };
  io.MousePos = at;
  frame();
  io.MouseDown[0] = true;
  frame();
  io.MousePos = {at.x + drag.x, at.y + drag.y};
  frame();
  io.MouseDown[0] = false;
  frame();
  io.MousePos = {-FLT_MAX, -FLT_MAX};
  frame();
}

TEST(Picking, ShowsWhatProbesShowAndFollowsTheLight) {
  LiveViewer live(boxToPickFrom("pause on\nstep 2\nwait shots 2\n" + kFloor));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  expectFloor(live);
  const PickedPoint first = picked(live);
  const glm::dvec3 early = *radiosityAt(first.place, *live->state().snapshot);
  EXPECT_EQ(early, probed(live, first.probe));
  live->perform("pause", "off");
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  ASSERT_TRUE(live.until([&] { return !live->state().spareWork(); }));
  const Snapshot& snapshot = *live->state().snapshot;
  const glm::dvec3 late = *radiosityAt(picked(live).place, snapshot);
  EXPECT_EQ(late, probed(live, first.probe));
  EXPECT_GT(late.x, early.x);
  // B = E + rho H, and the patch sends as much as its area and that make it: light on it is even within this.
  const Side& side = snapshot.mesh->sides[picked(live).pick.side];
  const glm::dvec3 received = *irradianceAt(picked(live).place, snapshot);
  EXPECT_LT(glm::length(side.emission + side.reflectance * received - late), 1e-6 * glm::length(late));
  for (const PickedQuantity& quantity : pickedQuantities()) {
    const auto value = quantity.of(picked(live), snapshot);
    EXPECT_FALSE(quantity.tip.empty()) << quantity.title;
    EXPECT_EQ(quantity.unit.empty(), quantity.tip.find("[") == std::string_view::npos) << quantity.title;
    if (quantity.title == "Row sum of K") {
      // The rest escapes by the open front. Interpolated over elements of a tenth of the room.
      ASSERT_TRUE(value);
      const std::array<glm::dvec3, 4> front = {{{0, 0, 0}, {0, 548.8, 0}, {554, 548.8, 0}, {554, 0, 0}}};
      std::vector<glm::dvec3> scratch;
      const double escapes =
          std::abs(pointToPolygonFactor(first.probe.position, first.probe.normal, front, scratch));
      EXPECT_NEAR(value->x, 1 - escapes, 0.05);
    }
    if (quantity.title != "Power [W]") continue;
    ASSERT_TRUE(value);
    EXPECT_NEAR(value->x / snapshot.mesh->patch_area[picked(live).pick.patch] / late.x, 1, 0.6);
  }
}

TEST(Picking, IsPlacedAnewOnAnotherMeshAndEndsWithTheScene) {
  LiveViewer live(boxToPickFrom("wait converged\n" + kFloor + "pin-probe\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  const PickedPoint before = picked(live);
  const auto area = [&] { return live->state().snapshot->mesh->element_area[picked(live).pick.element]; };
  const double area_before = area();
  const auto solvedAnew = [&](const std::string& action, const std::string& argument) {
    const std::uint64_t epoch = live->state().epoch;
    live->perform(action, argument);
    return live.until(
        [&] { return live->state().epoch > epoch && live->state().phase == SessionPhase::kConverged; });
  };
  ASSERT_TRUE(solvedAnew("elements", "3000"));
  EXPECT_EQ(picked(live).probe.position, before.probe.position);
  EXPECT_LT(area(), area_before) << "of the new mesh";
  ASSERT_EQ(live->picking().pinned().size(), 1u);
  EXPECT_EQ(*radiosityAt(live->picking().pinned()[0].place, *live->state().snapshot),
            probed(live, before.probe));
  ASSERT_TRUE(solvedAnew("open", kTwoPatches));
  EXPECT_FALSE(live->picking().picked());
  EXPECT_TRUE(live->picking().pinned().empty());
  EXPECT_FALSE(live->error());
}

TEST(Picking, ShowsAnEditedMaterial) {
  LiveViewer live(boxToPickFrom("wait converged\n" + kFloor + "reflectance white 0.2,0.3,0.4\n"));
  const auto reflectance = [&] { return *pickedQuantities()[0].of(picked(live), *live->state().snapshot); };
  ASSERT_TRUE(live.until([&] { return live->scriptDone() && reflectance() == glm::dvec3(0.2, 0.3, 0.4); }));
  expectFloor(live);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  EXPECT_EQ(*radiosityAt(picked(live).place, *live->state().snapshot), probed(live, picked(live).probe));
}

TEST(Picking, AClickPicksADragDoesNotAndEscapeUnpicks) {
  LiveViewer live(boxToPickFrom("wait converged\nhelp off\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone() && live->nextFrame(0) > 1e30; }));
  const float width = 700;
  const ImVec2 floor{0.5f * width, 0.93f * 700};
  click(live, floor);
  expectFloor(live);
  const Camera at_rest = live->camera();
  live->dismiss();
  EXPECT_FALSE(live->picking().picked());
  click(live, floor, {40, 0});
  EXPECT_FALSE(live->picking().picked());
  EXPECT_NE(live->camera().eye, at_rest.eye) << "it orbits";
  ASSERT_TRUE(live.until([&] { return live->shownCamera().eye == live->camera().eye; }));
  click(live, floor);
  EXPECT_TRUE(live->picking().picked());
  click(live, {width + 150, 400});
  EXPECT_TRUE(live->picking().picked()) << "the panel is not the scene";
  live->perform("camera", "278,273,-800,278,273,-2000");
  live.draw();
  ASSERT_TRUE(live.until([&] { return live->shownCamera().at == live->camera().at; }));
  click(live, floor);
  EXPECT_FALSE(live->picking().picked()) << "nothing is there";
}

TEST(Picking, AClickRightAfterAMoveLeavesTheCameraAlone) {
  LiveViewer live(boxToPickFrom("wait converged\nhelp off\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone() && live->nextFrame(0) > 1e30; }));
  const Camera before = live->camera();
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {100, 100};
  live.draw();
  // Moved, pressed and let go before the next frame: ImGui makes two frames of it.
  io.MousePos = {350, 0.93f * 700};
  io.MouseDown[0] = true;
  live.draw();
  io.MouseDown[0] = false;
  live.draw();
  EXPECT_EQ(live->camera().eye, before.eye);
  expectFloor(live);
}

TEST(Picking, LooksAtThePointAndOrbitsAroundIt) {
  LiveViewer live(boxToPickFrom("wait converged\n" + kFloor + "focus-picked\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  const glm::dvec3 point = picked(live).pick.position;
  EXPECT_EQ(live->camera().at, point);
  live->pick({0.5, 0.5});
  live.draw();
  EXPECT_LT(glm::length(picked(live).pick.position - point), 1e-6 * glm::length(point));
}

TEST(Picking, InARaceBothPicturesAreOfOneScene) {
  LiveViewer live(boxToPickFrom("wait converged\nrace jacobi\nwait converged\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone() && live->nextFrame(0) > 1e30; }));
  const SceneSplit split = splitScene(700, true);
  glm::dvec3 points[2];
  for (const int left : {0, split.right_at}) {
    click(live, {static_cast<float>(left) + 0.5f * static_cast<float>(split.left), 0.7f * 700});
    ASSERT_TRUE(live->picking().picked());
    points[left > 0] = picked(live).probe.position;
  }
  EXPECT_LT(glm::length(points[0] - points[1]), 1) << "of 555 across; the halves begin at whole pixels";
}

TEST(Picking, WithoutAPickActionsSayWhatToDo) {
  LiveViewer live(boxToPickFrom("wait converged\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  for (const std::string action :
       {"pin-probe", "copy-values", "focus-picked", "save-probes", "unpin-probe"}) {
    live->perform(action, action == "unpin-probe" ? "1" : "");
    ASSERT_TRUE(live->error()) << action;
    EXPECT_EQ(live->error()->kind(), ErrorKind::kUsage) << action;
    live->perform("dismiss");
  }
}

TEST(Picking, CopiesValuesAsText) {
  LiveViewer live(boxToPickFrom("wait converged\n" + kFloor + "copy-values\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  const std::string text = ImGui::GetClipboardText();
  for (const char* part : {"Surface\tno. ", ", front\n", "Material\twhite\n", "Radiosity B [W/m\u00b2]\t",
                           "Element\t", "Plan\t", "Area of patch [m\u00b2]\t"})
    EXPECT_THAT(text, HasSubstr(part));
}

// At the first picture too: marks are of the camera that a screenshot is made with.
TEST(Picking, MarksStandInScreenshots) {
  const TempFolder folder;
  const ProgramResult run = runScript(folder,
                                      "status off\npause on\nstep 1\nwait shots 1\npick 0.5,0.93\nscreenshot "
                                      "with.png\nunpick\nscreenshot without.png\n",
                                      {kCornellBox, "--elements", "300", "--size", "1020x700"});
  ASSERT_EQ(run.code, 0) << run.err;
  const ImageF with = picture(folder, "with.png"), without = picture(folder, "without.png");
  int near = 0, far = 0;
  for (int y = 0; y < 700; ++y) {
    for (int x = 0; x < 700; ++x) {
      const auto at = static_cast<std::size_t>(3 * (y * with.width + x));
      const bool differs = !std::equal(&with.rgb[at], &with.rgb[at] + 3, &without.rgb[at]);
      // The cross is a line of text high; the patch around it is below 150 wide.
      (std::abs(x - 350) < 150 && std::abs(y - 651) < 60 ? near : far) += differs;
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_EQ(far, 0);
}

// Of the same solve, saved and gone on with: the very same bytes.
TEST(Picking, ProbesAreWrittenAsSolveWritesThem) {
  const TempFolder folder;
  const ProgramResult view =
      runScript(folder,
                "wait converged\n" + kFloor +
                    "pin-probe\npick 0.1,0.5\npin-probe\npick 0.6,0.5\npin-probe\nunpin-probe 2\n"
                    "save-probes probes.csv\nsave-solve kept.unshot\nquit\n",
                {kCornellBox, "--elements", "300", "--error", "0.05"});
  ASSERT_EQ(view.code, 0) << view.err;
  const ProgramResult solve =
      runProgram(folder, {"solve", kCornellBox, "--gl", "osmesa", "--resume", "kept.unshot", "--probe",
                          "probes.csv", "--probe-out", "again.csv"});
  ASSERT_EQ(solve.code, 0) << solve.err;
  const std::string written = folder.read("probes.csv");
  EXPECT_EQ(std::count(written.begin(), written.end(), '\n'), 3);
  EXPECT_EQ(written, folder.read("again.csv"));
}

/// The panel as wide as it is, at each size of its text.
class PanelOfPicking : public testing::TestWithParam<double> {};

TEST_P(PanelOfPicking, ClipsNothing) {
  LiveViewer::Options options =
      boxToPickFrom("wait converged\n" + kFloor + "pin-probe\nscale " + std::to_string(GetParam()) + "\n");
  options.width = static_cast<int>(1204 * GetParam());
  options.height = static_cast<int>(900 * GetParam());
  LiveViewer live(options);
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  for (int frame = 0; frame < 3; ++frame) {
    live->input();
    live.draw();
  }
  int tables = 0;
  ImGuiContext& gui = *ImGui::GetCurrentContext();
  for (int k = 0; k < gui.Tables.GetMapSize(); ++k) {
    const ImGuiTable* table = gui.Tables.TryGetMapData(k);
    if (!table || table->ColumnsCount != 4) continue;
    ++tables;
    for (int c = 0; c < 4; ++c) {
      const ImGuiTableColumn& column = table->Columns[c];
      EXPECT_LE(column.ContentMaxXUnfrozen, column.WorkMaxX + 1) << "column " << c;
      EXPECT_GT(column.ContentMaxXUnfrozen, column.WorkMinX) << "column " << c;
    }
    EXPECT_LE(table->Columns[3].WorkMaxX, table->OuterWindow->WorkRect.Max.x + 1);
  }
  EXPECT_EQ(tables, 2) << "what is picked, and the probe";
}

INSTANTIATE_TEST_SUITE_P(Gui, PanelOfPicking, testing::Values(1.0, 1.5, 2.0));

}  // namespace
}  // namespace unshot
