// The hemicube and the lecture in the viewer: what they show is what the solver has.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <set>

#include "base/clock.h"
#include "formfactor/hemicube_view.h"
#include "gui/support/gui_layout.h"
#include "gui/support/program_pictures.h"
#include "support/assets.h"
#include "support/live_viewer.h"
#include "viewer/hemicube_cross.h"
#include "viewer/matrix_series.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

using testing_support::kCornellBox;
using testing_support::LiveViewer;
using testing_support::picture;
using testing_support::ProgramResult;
using testing_support::runScript;
using testing_support::showsSomething;
using testing_support::TempFolder;

LiveViewer::Options boxToTeachWith(const std::string& script) {
  LiveViewer::Options options;
  options.scene = kCornellBox;
  options.solve.elements = 500;
  options.solve.error = 0.01;
  options.script = script;
  options.width = 1280;
  options.height = 800;
  options.pixels = false;
  return options;
}

bool finished(LiveViewer& live) {
  return live.until([&] { return live->scriptDone(); }) && live->exitCode() == 0;
}

/// Where a pixel of the layout looks.
glm::dvec3 directionOf(HemicubeLayout layout, std::size_t pixel) {
  const HemicubeFaces faces(HemicubeFrame{});
  const auto row = static_cast<std::uint32_t>(pixel / layout.width()), n = layout.resolution;
  const std::uint32_t face = row < n ? 0 : 1 + (row - n) / (n / 2);
  const double x = (static_cast<double>(pixel % n) + 0.5) * 2 / n - 1;
  const double y = (row - layout.faceRow(face) + 0.5) * 2 / n - (face == 0 ? 1 : 0);
  return glm::normalize(faces.forward[face] + y * faces.up[face] +
                        x * glm::cross(faces.forward[face], faces.up[face]));
}

TEST(HemicubeCross, HasEachPixelOnceAndNeighboursLookTheSameWay) {
  const HemicubeLayout layout{32};
  const std::uint32_t size = crossSize(layout);
  std::set<std::size_t> seen;
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      const auto pixel = crossPixel(layout, x, y);
      if (!pixel) continue;
      EXPECT_TRUE(seen.insert(*pixel).second) << x << ", " << y;
      // A pixel is no wider than 2 / n seen from the middle, and so are two halves of two pixels on either
      // side of an edge.
      for (const auto& beside : {crossPixel(layout, x + 1, y), crossPixel(layout, x, y + 1)}) {
        if (!beside || x + 1 == size || y + 1 == size) continue;
        EXPECT_LT(glm::length(directionOf(layout, *pixel) - directionOf(layout, *beside)), 2.01 / 32)
            << x << ", " << y;
      }
    }
  }
  EXPECT_EQ(seen.size(), std::size_t{layout.width()} * layout.height());
}

TEST(MatrixSeries, OfAMatrixThatIsKnown) {
  // Two patches that see each other alone: M swings, its powers are 0.06^k.
  MatrixSeries series({0, 0.2, 0.3, 0}, 2);
  EXPECT_NEAR(series.radius(), std::sqrt(0.06), 1e-4);
  EXPECT_EQ(series.power(0), (std::vector<double>{1, 0, 0, 1}));
  EXPECT_NEAR(series.power(4)[0], 0.0036, 1e-15);
  EXPECT_NEAR(series.norm(1), 0.3, 1e-15);
  // (I - M)^-1 = [1 0.2; 0.3 1] / 0.94.
  const std::vector<double> sum = series.sum(40);
  EXPECT_NEAR(sum[0], 1 / 0.94, 1e-12);
  EXPECT_NEAR(sum[1], 0.2 / 0.94, 1e-12);
  EXPECT_NEAR(sum[2], 0.3 / 0.94, 1e-12);
  EXPECT_NEAR(series.light({1, 0}, 40)[1], 0.3 / 0.94, 1e-12);
  MatrixSeries growing({0, 1.2, 1.2, 0}, 2);
  EXPECT_NEAR(growing.radius(), 1.2, 1e-4);
  EXPECT_GT(growing.norm(20), growing.norm(10));
  EXPECT_EQ(series.terms(), SeriesTerms::kShrink);
  EXPECT_EQ(growing.terms(), SeriesTerms::kGrow);
  EXPECT_EQ(MatrixSeries({0, 1, 1, 0}, 2).terms(), SeriesTerms::kStay);
  EXPECT_EQ(MatrixSeries({0.5, 0.5, 0.25, 0.75}, 2).terms(), SeriesTerms::kStay);
}

// 500 elements are about a hundred patches, twice as many as groups. Gathering counts the patches of a group
// as equally bright, which here is worth 5 % of the power; the series itself ends at 0.5^64.
TEST(Lecture, PartialSumsTendToTheSolvesLight) {
  const TempFolder folder;
  LiveViewer live(boxToTeachWith("wait converged\ncomplete-bounces\nlecture-page matrix\nscreenshot-scene " +
                                 (folder.path() / "a.png").string() + "\n"));
  ASSERT_TRUE(finished(live));
  Teaching& teaching = live->teaching();
  ASSERT_TRUE(teaching.insight() && teaching.insight()->matrix);
  const GatheredMatrix& m = *teaching.insight()->matrix;
  EXPECT_EQ(m.missing, 0u);
  for (int channel = 0; channel < 3; ++channel) {
    teaching.choices.channel = channel;
    const std::vector<double> solved = teaching.solution(), e = teaching.emission();
    double before = 0;
    for (const std::size_t k : {0u, 1u, 3u, 64u}) {
      const std::vector<double> light = teaching.series().light(e, k);
      double sum = 0, all = 0;
      for (std::size_t i = 0; i < m.size(); ++i) {
        sum += m.groups[i].area * light[i];
        all += m.groups[i].area * solved[i];
      }
      EXPECT_GT(sum / all, before);
      before = sum / all;
    }
    EXPECT_NEAR(before, 1, 0.05) << "channel " << channel;
    EXPECT_LT(teaching.series().radius(), 0.8);
  }
  live->perform("allow-divergence", "on");
  live->perform("matrix-reflectance", "1.2");
  EXPECT_GT(teaching.series().radius(), 1);
}

// The picture and the solver's column are two samplings of one thing: pixels of 128 from the middle of the
// patch, against parts of it where something is near. 2 % of all light in any one patch.
TEST(Hemicube, ThePictureHasTheSolversFormFactors) {
  const TempFolder folder;
  LiveViewer live(boxToTeachWith("wait converged\npick 0.5,0.2\nhemicube-view on\nscreenshot-scene " +
                                 (folder.path() / "a.png").string() + "\n"));
  ASSERT_TRUE(finished(live));
  const Teaching& teaching = live->teaching();
  const std::uint32_t patch = live->picking().required().pick.patch;
  ASSERT_TRUE(teaching.look());
  EXPECT_EQ(teaching.look()->patch, patch);
  const std::vector<double>& delta = *teaching.look()->delta;
  EXPECT_NEAR(std::accumulate(delta.begin(), delta.end(), 0.0), 1, 1e-12);
  EXPECT_NEAR(std::accumulate(teaching.shares().begin(), teaching.shares().end(), 0.0), 1, 1e-9);
  ASSERT_TRUE(teaching.patch());
  ASSERT_EQ(teaching.patch()->patch, patch);
  ASSERT_EQ(teaching.patch()->sent.size() + 1, teaching.shares().size());
  for (std::size_t q = 0; q < teaching.patch()->sent.size(); ++q)
    EXPECT_NEAR(teaching.shares()[q], static_cast<double>(teaching.patch()->sent[q]), 0.02) << q;
  EXPECT_NEAR(teaching.shares().back(), teaching.patch()->escape, 0.02);
}

TEST(Hemicube, FollowsThePatchThatShootsAndTheOneThatIsPicked) {
  const TempFolder folder;
  LiveViewer live(boxToTeachWith("pause on\nhemicube-view on\nstep\nwait shots 1\nscreenshot-scene " +
                                 (folder.path() / "a.png").string() + "\n"));
  ASSERT_TRUE(finished(live));
  const Teaching& teaching = live->teaching();
  ASSERT_TRUE(teaching.insight() && teaching.insight()->shot);
  EXPECT_EQ(teaching.hemicubePatch(), teaching.insight()->shot->patch);
  EXPECT_FALSE(teaching.hemicubeIsPicked());
  live->pick({0.5, 0.3});
  ASSERT_TRUE(live.until([&] {
    return teaching.hemicubeIsPicked() && teaching.look() &&
           teaching.look()->patch == live->picking().required().pick.patch;
  }));
  // Beside the shot that the lecture tells of stands its own.
  live->perform("lecture-page", "shots");
  ASSERT_TRUE(live.until([&] {
    return !teaching.hemicubeIsPicked() && teaching.look() &&
           teaching.look()->patch == teaching.insight()->shot->patch;
  }));
  live->perform("lecture", "off");
  ASSERT_TRUE(live.until([&] { return teaching.hemicubeIsPicked(); }));
  live->perform("unpick");
  ASSERT_TRUE(live.until([&] { return !teaching.hemicubeIsPicked(); }));
}

/// The mouse rests there for some frames.
void hover(LiveViewer& live, float x, float y) {
  ImGui::GetIO().MousePos = {x, y};
  live->input();
  for (int frame = 0; frame < 4; ++frame) live.draw();
}

/// Corners of this colour over the scene.
int filledCorners(ImU32 colour) {
  int count = 0;
  for (const ImDrawVert& vertex : ImGui::GetBackgroundDrawList()->VtxBuffer) count += vertex.col == colour;
  return count;
}

// At 1280 x 800 the lecture is 540 px wide, its left map in the upper left of it, the hemicube in the lower
// left of the scene.
TEST(Lecture, WhatTheMouseIsOverIsLitInTheScene) {
  LiveViewer live(boxToTeachWith(
      "wait converged\ncomplete-bounces\nlecture-page matrix\nhemicube-view on\npick 0.5,0.3\n"));
  ASSERT_TRUE(finished(live));
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
  const Teaching& teaching = live->teaching();
  ASSERT_EQ(teaching.marks().size(), 1u) << "the patch of the hemicube";
  EXPECT_TRUE(teaching.marks()[0]->lit.empty()) << "is seen as it is";
  EXPECT_EQ(filledCorners(IM_COL32(255, 176, 64, 120)), 0);
  hover(live, 870, 300);
  ASSERT_EQ(teaching.marks().size(), 3u) << "two groups more";
  int lit = 0;
  for (const auto& mark : teaching.marks()) {
    EXPECT_GE(mark->outline.size(), 3u);
    lit += !mark->lit.empty();
  }
  EXPECT_EQ(lit, 2) << "both groups";
  EXPECT_GE(filledCorners(IM_COL32(255, 176, 64, 120)), 3) << "what sends";
  EXPECT_GE(filledCorners(IM_COL32(96, 190, 255, 120)), 3) << "what receives";
  hover(live, 40, 630);
  ASSERT_EQ(teaching.marks().size(), 2u) << "a side face: what the hemicube's pixel sees";
  EXPECT_GE(filledCorners(IM_COL32(96, 190, 255, 120)), 3);
  hover(live, 400, 100);
  EXPECT_EQ(teaching.marks().size(), 1u);
  // Scripts have no mouse.
  const auto markedBy = [&](const char* action, const char* argument) {
    live->perform(action, argument);
    for (int frame = 0; frame < 4; ++frame) live.draw();
    return teaching.marks().size();
  };
  EXPECT_EQ(markedBy("matrix-cell", "2,1"), 3u);
  EXPECT_GE(filledCorners(IM_COL32(255, 176, 64, 120)), 3) << "what sends";
  EXPECT_EQ(markedBy("matrix-cell", "999,1"), 1u) << "there are 64 at most";
  EXPECT_EQ(markedBy("matrix-cell", "off"), 1u);
  EXPECT_EQ(markedBy("hemicube-pixel", "0.1,0.5"), 2u) << "a side face";
  EXPECT_EQ(markedBy("hemicube-pixel", "off"), 1u);
  EXPECT_FALSE(live->error());
}

/// Corners in red of the lecture's page: bars and text that say that a series has no sum.
int redCorners() {
  int count = 0;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!window->Active || !std::string(window->Name).starts_with("lecture/page")) continue;
    for (const ImDrawVert& vertex : window->DrawList->VtxBuffer) {
      const ImVec4 colour = ImGui::ColorConvertU32ToFloat4(vertex.col);
      count += colour.x > 0.99f && colour.y < 0.5f && colour.z < 0.5f;
    }
  }
  return count;
}

// The scene's own reflectances times a factor: the series grows once that brings the radius above 1.
TEST(Lecture, TheGrowingSeriesIsRed) {
  LiveViewer live(boxToTeachWith("wait converged\ncomplete-bounces\nlecture-page matrix\n"));
  ASSERT_TRUE(finished(live));
  ASSERT_TRUE(live.until([&] { return live->teaching().insight() && live->teaching().insight()->matrix; }));
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
  Teaching& teaching = live->teaching();
  const double own = teaching.series().radius();
  ASSERT_LT(own, 1);
  hover(live, 5, 5);
  EXPECT_EQ(redCorners(), 0);
  live->perform("allow-divergence", "on");
  EXPECT_NEAR(teaching.series().radius(), own, 1e-9) << "its own reflectances at first";
  live->perform("matrix-factor", "1.2");
  EXPECT_NEAR(teaching.series().radius(), 1.2 * own, 1e-3);
  live->perform("matrix-factor", std::to_string(1.1 / own));
  EXPECT_NEAR(teaching.series().radius(), 1.1, 1e-3);
  EXPECT_GT(teaching.series().norm(24), teaching.series().norm(12));
  hover(live, 5, 5);
  const int growing = redCorners();
  EXPECT_GE(growing, 4 * 25) << "a bar for each term";
  live->perform("matrix-factor", "1");
  hover(live, 5, 5);
  EXPECT_EQ(redCorners(), 0);
  live->perform("matrix-reflectance", "1.2");
  EXPECT_NEAR(teaching.reflectance(0), 1.2, 1e-12);
  hover(live, 5, 5);
  EXPECT_GE(redCorners(), 4 * 25);
}

/// Whether what is under the mouse in the upper left of the lecture's page can be pressed.
bool firstButtonIsEnabled(LiveViewer& live) {
  live.draw();
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!window->Active || !std::string(window->Name).starts_with("lecture/page")) continue;
    hover(live, window->Pos.x + 12, window->Pos.y + 8);
    const ImGuiContext& gui = *ImGui::GetCurrentContext();
    EXPECT_TRUE(gui.HoveredId != 0 || gui.HoveredIdDisabled) << "nothing is there";
    return !gui.HoveredIdDisabled;
  }
  ADD_FAILURE() << "no page";
  return false;
}

TEST(Lecture, StepIsDisabledWhereNothingIsToBeShot) {
  LiveViewer live(boxToTeachWith("pause on\nlecture-page shots\nstep\nwait shots 1\n"));
  ASSERT_TRUE(finished(live));
  EXPECT_TRUE(live->solveGoesOn());
  EXPECT_TRUE(firstButtonIsEnabled(live));
  live->perform("pause", "off");
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  EXPECT_FALSE(live->solveGoesOn());
  EXPECT_TRUE(firstButtonIsEnabled(live)) << "it begins again, shot by shot";
  live->perform("light", "light off");
  ASSERT_TRUE(live.until([&] { return live->state().stopped_by == "no light"; }));
  EXPECT_FALSE(firstButtonIsEnabled(live));
}

TEST(Lecture, GatheringSaysHowFarItIsAndCanBeGivenUp) {
  LiveViewer::Options options = boxToTeachWith("pause on\nstep 1000\nwait shots 1000\n");
  options.solve.elements = 30000;
  options.solve.form_factors = "rays";
  options.solve.error = 1e-6;
  LiveViewer live(options);
  ASSERT_TRUE(finished(live));
  double asked = 0;
  std::vector<double> told;
  const auto gathering = [&] {
    for (const Task& task : live->tasks()) {
      if (task.text != "gathering M") continue;
      EXPECT_GE(task.since, asked) << "as if it had begun long ago";
      told.push_back(task.done.value());
    }
    return !told.empty();
  };
  asked = wallSeconds();
  live->perform("lecture-page", "matrix");
  ASSERT_TRUE(live.until(gathering));
  live->perform("give-up");
  EXPECT_FALSE(live->teaching().choices.lecture);
  ASSERT_TRUE(live.until([&] { return live->tasks().empty() && live->upToDate(); }));
  EXPECT_FALSE(live->state().gathering);
  told.clear();
  asked = wallSeconds();
  live->perform("lecture-page", "matrix");
  ASSERT_TRUE(live.until([&] {
    gathering();
    const Insight* insight = live->teaching().insight();
    return insight && insight->matrix && !live->state().gathering && live->upToDate();
  }));
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

// Nothing is gathered of it, and nothing is being gathered.
TEST(Lecture, OfASceneWithoutLightSaysSo) {
  LiveViewer live(boxToTeachWith("wait converged\nlight light off\nlecture-page matrix\n"));
  ASSERT_TRUE(finished(live));
  ASSERT_TRUE(live.until([&] { return live->state().stopped_by == "no light" && live->upToDate(); }));
  const auto page = [&] {
    live->input();
    live.draw();
    live.draw();
    std::string text;
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
      if (!window->Active || !std::string(window->Name).starts_with("lecture/page")) continue;
      for (const testing_support::Letter& letter :
           testing_support::Letters(*ImGui::GetIO().Fonts).of(*window->DrawList))
        text += letter.text;
    }
    return text;
  };
  // What was shot before is still known; nothing is of a solve that is dark from the beginning.
  live->perform("sky", "0,0,0");
  ASSERT_TRUE(live.until([&] {
    return live->state().stopped_by == "no light" && live->upToDate() && live->state().measures.shots == 0;
  }));
  EXPECT_NE(page().find("Nothingofthissceneemitslight"), std::string::npos) << page();
}

TEST(HemicubeLooks, ThatGetReadyCanBeGivenUp) {
  LiveViewer::Options options = boxToTeachWith("pause on\n");
  options.solve.elements = 100000;
  LiveViewer live(options);
  ASSERT_TRUE(live.until([&] { return live->state().snapshot != nullptr; }));
  HemicubeLooks looks(nullptr);
  const double asked = wallSeconds();
  looks.want(live->state().snapshot->mesh, 0);
  while (looks.pending() && !looks.preparing()) {
  }
  ASSERT_TRUE(looks.preparing());
  EXPECT_GE(*looks.preparing(), asked);
  looks.giveUp();
  while (looks.pending()) {
  }
  EXPECT_EQ(looks.latest(), nullptr);
  EXPECT_FALSE(looks.problem());
  EXPECT_FALSE(looks.preparing());
  looks.want(live->state().snapshot->mesh, 0);
  while (looks.pending()) {
  }
  EXPECT_NE(looks.latest(), nullptr);
}

TEST(Lecture, PicturesOfAPatchAndOfAShotShowSomething) {
  const TempFolder folder;
  const ProgramResult run = runScript(
      folder,
      "pause on\nstep 3\nwait shots 3\nlecture-page shots\nstep\nwait shots 4\ndisplay last-shot\n"
      "screenshot-scene shot.png\npick 0.5,0.5\ndisplay form-factors\nscreenshot-scene factors.png\n"
      "unpick\nscreenshot-scene none.png\n",
      {"--size", "300x240", "--elements", "300"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(showsSomething(picture(folder, "shot.png")));
  EXPECT_TRUE(showsSomething(picture(folder, "factors.png")));
  EXPECT_NE(folder.read("factors.png"), folder.read("none.png"));
}

}  // namespace
}  // namespace unshot
