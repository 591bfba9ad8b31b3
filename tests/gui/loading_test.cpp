// What takes its time and is shown to: how far it is, and that it can be given up.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include "base/atomic_file.h"
#include "base/clock.h"
#include "export/ply.h"
#include "scene/obj_reader.h"
#include "session/saved_solve.h"
#include "support/given_up.h"
#include "support/landscape.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"

namespace unshot {
namespace {

using namespace testing_support;

class GivenUp : public testing::TestWithParam<const char*> {};

TEST_P(GivenUp, LoadingLeavesTheSceneBefore) {
  const TempFolder folder;
  folder.write("land.mtl", kLandscapeMaterials);
  const std::string landscape_file = folder.write("land.obj", landscape(200));
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 200;
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  const std::uint64_t first = live->state().epoch;
  live->perform("elements", "300");
  ASSERT_TRUE(live.until([&] { return live->state().epoch > first; }));
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  const std::uint64_t epoch = live->state().epoch;
  live->perform("open", landscape_file);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kLoading));
  // Esc takes only what is shown.
  ASSERT_TRUE(live.until([&] {
    const std::vector<Task> tasks = live->tasks();
    return !tasks.empty() && tasks.front().shown(wallSeconds());
  }));
  live->perform(GetParam());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  live.draw();
  EXPECT_EQ(live->state().epoch, epoch);
  EXPECT_EQ(live->state().facts->scene_name, "cornell_box");
  EXPECT_EQ(live->ui().options.elements, 300u);
  EXPECT_FALSE(live->error());
  EXPECT_EQ(live->exitCode(), 0);
  // Of the scene that stays.
  live->perform("reflectance", "white 0.5,0.5,0.5");
  live->perform("save-solve", folder / "s.unshot");
  ASSERT_TRUE(live.until([&] { return live->state().saves == 1 || live->error(); }));
  EXPECT_FALSE(live->error());
}

// A small scene is there again before anybody could read that it is loaded.
TEST(ShortTasks, DoNotFlash) {
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 200;
  LiveViewer live(options);
  const auto rest = [&] {
    return live->state().phase == SessionPhase::kConverged && live->nextFrame(0) > 1e30;
  };
  ASSERT_TRUE(live.until(rest));
  const auto active = [](const char* name) {
    const ImGuiWindow* window = ImGui::FindWindowByName(name);
    return window && window->Active;
  };
  // Each of them loads, or looks for a view, anew.
  for (const char* action : {"restart", "hemicube 32", "emit front", "sky 1,1,1", "frame"}) {
    const std::string text = action;
    const std::size_t space = std::min(text.find(' '), text.size());
    const double began = wallSeconds();
    int frames = 0;
    live->perform(text.substr(0, space), text.substr(std::min(space + 1, text.size())));
    ASSERT_TRUE(live.until([&] {
      live.draw();
      ++frames;
      const bool said = active("tasks") || active("framing");
      EXPECT_TRUE(!said || wallSeconds() > began + Task::kMoment) << text;
      return live->upToDate() && rest();
    }));
    EXPECT_GT(frames, 1);
  }
}

/// What a large scene tells while it is loaded.
class LongTasks : public testing::Test {
 protected:
  LongTasks() {
    folder_.write("land.mtl", kLandscapeMaterials);
    LiveViewer::Options options;
    options.scene = folder_.write("land.obj", landscape(150));
    options.solve.elements = 1;
    live_.emplace(options);
  }
  LiveViewer& live() { return *live_; }
  Viewer& viewer() { return **live_; }
  bool untilShot() {
    return live_->until([&] { return viewer().state().measures.shots > 0; });
  }

  const TempFolder folder_;
  std::optional<LiveViewer> live_;
};

TEST_F(LongTasks, LoadingSaysHowFarItIs) {
  std::map<std::string, std::vector<double>> told;
  ASSERT_TRUE(live().until([&] {
    const SessionState& state = viewer().state();
    if (state.phase == SessionPhase::kLoading && state.task_done) {
      std::vector<double>& of_task = told[state.task];
      if (of_task.empty() || of_task.back() != *state.task_done) of_task.push_back(*state.task_done);
      EXPECT_EQ(viewer().tasks().front().done, state.task_done);
    }
    return state.facts != nullptr;
  }));
  const std::vector<double>& meshing = told["meshing land.obj"];
  EXPECT_GE(meshing.size(), 3u) << "a bar that stands";
  EXPECT_TRUE(std::is_sorted(meshing.begin(), meshing.end()));
  for (const double done : meshing) EXPECT_TRUE(done >= 0 && done <= 1) << done;
  EXPECT_FALSE(viewer().state().task_done) << "after its end";
}

TEST_F(LongTasks, ALookForAViewEndsWithTheBestSoFar) {
  viewer().pause();
  const glm::dvec3 before = viewer().camera().eye;
  const auto looks = [&] {
    const std::vector<Task> tasks = viewer().tasks();
    return !tasks.empty() && tasks.front().text.starts_with("looking");
  };
  ASSERT_TRUE(live().until([&] {
    return looks() && *viewer().tasks().front().done > 0 && viewer().tasks().front().shown(wallSeconds());
  }));
  EXPECT_LT(*viewer().tasks().front().done, 1);
  viewer().perform("dismiss");
  ASSERT_TRUE(live().until([&] { return !looks(); }));
  EXPECT_NE(viewer().camera().eye, before);
  EXPECT_FALSE(viewer().error());
}

// A pipe takes as long as its reader does.
TEST_F(LongTasks, ASaveThatIsGivenUpIsSaidAndStopsNothingElse) {
  ASSERT_TRUE(untilShot());
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::jthread reader([&] {
    const int file = ::open(pipe.c_str(), O_RDONLY);
    std::vector<char> bytes(1 << 16);
    while (::read(file, bytes.data(), bytes.size()) > 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
    ::close(file);
  });
  viewer().perform("save-solve", pipe);
  ASSERT_TRUE(live().until([&] { return viewer().state().saving; }));
  const std::vector<Task> tasks = viewer().tasks();
  ASSERT_FALSE(tasks.empty());
  EXPECT_EQ(tasks.back().text, "saving pipe");
  EXPECT_TRUE(tasks.back().done);
  EXPECT_NE(viewer().state().phase, SessionPhase::kLoading);
  viewer().giveUp(tasks.back());
  ASSERT_TRUE(live().until([&] { return !viewer().state().saving; }));
  EXPECT_EQ(viewer().state().saves, 0u);
  EXPECT_FALSE(viewer().error());
  const std::uint64_t shots = viewer().state().measures.shots;
  EXPECT_TRUE(live().until([&] { return viewer().state().measures.shots > shots; }));
}

TEST_F(LongTasks, AChangeOfMaterialsCanBeGivenUp) {
  ASSERT_TRUE(untilShot());
  const std::vector<Material> before = viewer().edits().materials();
  std::vector<Task> tasks;
  viewer().perform("reflectance", "ground 0.5,0.25,0.125");
  ASSERT_TRUE(live().until([&] {
    tasks = viewer().tasks();
    return viewer().state().editing;
  }));
  ASSERT_FALSE(tasks.empty());
  EXPECT_EQ(tasks.back().text, "changing materials");
  EXPECT_NE(viewer().state().phase, SessionPhase::kLoading);
  viewer().giveUp(tasks.back());
  ASSERT_TRUE(live().until([&] { return viewer().upToDate(); }));
  EXPECT_EQ(viewer().edits().materials(), before);
  EXPECT_EQ(viewer().state().epoch, 1u);
  EXPECT_FALSE(viewer().state().editing);
  // The solve goes on, can be edited again, and is saved as any other.
  viewer().perform("save-solve", folder_ / "s.unshot");
  ASSERT_TRUE(live().until([&] { return viewer().state().saves == 1 || viewer().error(); }));
  EXPECT_FALSE(viewer().error());
  viewer().perform("reflectance", "ground 0.5,0.25,0.125");
  EXPECT_TRUE(live().until([&] {
    return viewer().upToDate() && viewer().state().snapshot->mesh->materials == viewer().edits().materials();
  }));
  EXPECT_NE(viewer().edits().materials(), before);
}

TEST_F(LongTasks, AReferenceThatIsGivenUpIsNone) {
  ASSERT_TRUE(untilShot());
  writeWholeFile(folder_ / "light.ply", plyBytes(*viewer().state().snapshot, false, 1));
  viewer().perform("reference", folder_ / "light.ply");
  ASSERT_FALSE(viewer().scriptDone());
  viewer().giveUp(viewer().tasks().back());
  EXPECT_TRUE(viewer().scriptDone());
  EXPECT_FALSE(viewer().ui().settings.view.reference);
  live().performAndWait("reference", folder_ / "light.ply");
  EXPECT_TRUE(viewer().ui().settings.view.reference);
  EXPECT_FALSE(viewer().error());
}

// What is asked for half way: the file that was there stays, and nothing is left beside it.
TEST(SavingASolve, LeavesTheFileBeforeWhereItIsGivenUp) {
  const TempFolder folder;
  SolveOptions options;
  options.form_factors = "rays";
  options.elements = 500;
  options.mode = "southwell";
  Solve solve(readObj(UNSHOT_SOURCE_DIR "/assets/cornell_box.obj"), options,
              []() -> gl::Context& { throw std::logic_error("rays need none"); });
  for (int k = 0; k < 20; ++k) solve.step();
  const std::string path = folder.write("s.unshot", "what was there");
  for (const double share : {0.0, 0.5, 0.99}) {
    givenUpAt(share, [&](const CancelToken& cancel) { solve.save(path, cancel); });
    EXPECT_EQ(folder.read("s.unshot"), "what was there");
    EXPECT_EQ(folder.names(), std::set<std::string>{"s.unshot"});
  }
  solve.save(path);
  EXPECT_EQ(readSavedSolve(path)->shots, 20u);
}

INSTANTIATE_TEST_SUITE_P(Gui, GivenUp, testing::Values("give-up", "dismiss"), [](const auto& given) {
  return given.param == std::string("dismiss") ? "Dismiss" : "GiveUp";
});

}  // namespace
}  // namespace unshot
