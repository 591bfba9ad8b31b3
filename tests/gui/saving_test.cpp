// Solves saved in the viewer, and gone on from in the viewer and without it.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "gui/support/program_pictures.h"
#include "gui/support/screen.h"
#include "support/live_viewer.h"
#include "support/sanitized.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using namespace testing_support;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kCommon{"room.obj", "--elements", "600",   "--form-factors",
                                       "rays",     "--error",    "0.0001"};

/// The light of `saved` once it has converged, in a file `name`.
void solveOn(const TempFolder& folder, const std::string& saved, const std::string& name) {
  const ProgramResult run = runProgram(folder, {"solve", "room.obj", "--resume", saved, "--ply", name});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("goes on from " + saved));
}

void expectSameLight(const TempFolder& folder, const std::string& one, const std::string& other) {
  const ProgramResult compared = runProgram(folder, {"compare", one, other, "--tolerance", "0.0003"});
  EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
}

class Saving : public testing::Test {
 protected:
  Saving() { writeRoom(folder_, boxObj()); }
  TempFolder folder_;
};

TEST_F(Saving, ASolveGoesOnInTheViewerAndWithoutIt) {
  const ProgramResult saved = runScript(folder_,
                                        "pause on\nstep 20\nwait shots 20\nsave-solve s.unshot\nsave-solve\n"
                                        "step 2\nwait shots 22\nsave-solve later.unshot\nquit\n",
                                        kCommon);
  ASSERT_EQ(saved.code, 0) << saved.err;
  EXPECT_EQ(saved.err, "");
  EXPECT_TRUE(folder_.read("s.unshot") == folder_.read("unshot-room-001.unshot"));
  // What a script asks for last is done, though it quits.
  EXPECT_TRUE(folder_.has("later.unshot"));
  EXPECT_FALSE(folder_.read("s.unshot") == folder_.read("later.unshot"));
  const ProgramResult viewed = runScript(folder_, "wait converged\nsave-solve converged.unshot\n",
                                         {"room.obj", "--resume", "s.unshot"});
  ASSERT_EQ(viewed.code, 0) << viewed.err;
  EXPECT_THAT(viewed.err, HasSubstr("goes on from s.unshot: 20 shots"));
  ASSERT_EQ(runProgram(folder_, with(with({"solve"}, kCommon), {"--ply", "through.ply"})).code, 0);
  solveOn(folder_, "s.unshot", "solve.ply");
  solveOn(folder_, "converged.unshot", "view.ply");
  expectSameLight(folder_, "solve.ply", "through.ply");
  expectSameLight(folder_, "view.ply", "through.ply");
}

TEST_F(Saving, WhatCannotBeSavedIsSaidAndStopsNothingElse) {
  for (const auto& [file, message] :
       {std::pair<std::string, std::string>{"nowhere/s.unshot", "the folder nowhere does not exist"},
        {"room.obj", "room.obj: is the scene itself"},
        {"/dev/full", "/dev/full: cannot be written: No space left on device"}}) {
    SCOPED_TRACE(file);
    const ProgramResult run =
        runScript(folder_, "wait shots 5\nsave-solve " + file + "\nwait shots 9\nscreenshot message.png\n",
                  with(kCommon, {"--size", "640x480"}));
    EXPECT_EQ(run.code, file == "room.obj" ? 2 : 4);
    EXPECT_THAT(run.err, AllOf(HasSubstr(message), HasSubstr("try: ")));
    EXPECT_TRUE(folder_.has("message.png"));
    EXPECT_THAT(folder_.read("room.obj"), testing::StartsWith("mtllib"));
  }
}

TEST_F(Saving, WhatIsNoSavedSolveOfTheSceneIsRefused) {
  ASSERT_EQ(runScript(folder_, "wait converged\nsave-solve s.unshot\n", kCommon).code, 0);
  std::string damaged = folder_.read("s.unshot");
  damaged[damaged.size() / 2] ^= 1;
  folder_.write("damaged", damaged);
  folder_.write("room2.obj", roomObj() + boxObj() + "v 0 0 0.5\nf 1 2 17\n");
  for (const auto& [scene, file, message] :
       {std::array<std::string, 3>{"room.obj", "missing", "missing: "},
        {"room.obj", "damaged", "damaged: is damaged"},
        {"room.obj", "room.mtl", "room.mtl: is not a saved solve"},
        {"room2.obj", "s.unshot", "s.unshot: was saved from another scene than room2.obj"}}) {
    SCOPED_TRACE(file);
    const ProgramResult run = runScript(folder_, "wait converged\n", {scene, "--resume", file});
    EXPECT_EQ(run.code, 3) << run.err;
    EXPECT_THAT(run.err, AllOf(HasSubstr(message), HasSubstr("try: ")));
  }
  const ProgramResult both = runScript(folder_, "quit\n", with(kCommon, {"--resume", "s.unshot"}));
  EXPECT_EQ(both.code, 2) << both.err;
}

TEST_F(Saving, AKeptSolveIsSavedAtItsEndsAndNoOtherScene) {
  folder_.write("other.obj", roomObj());
  ASSERT_EQ(runScript(folder_, "pause on\nstep 7\nwait shots 7\nopen other.obj\nwait converged\n",
                      with(kCommon, {"--save", "s.unshot"}))
                .code,
            0);
  const ProgramResult resumed = runScript(folder_, "pause on\nwait shots 1\nquit\n",
                                          {"room.obj", "--resume", "s.unshot", "--save", "s.unshot"});
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("7 shots"));
  solveOn(folder_, "s.unshot", "a.ply");
  folder_.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
  EXPECT_EQ(runScript(folder_, "wait shots 1\nquit\n", {"broken.obj", "--save", "never.unshot"}).code, 3);
  EXPECT_FALSE(folder_.has("never.unshot"));
  for (const std::string file : {"room.obj", "missing/s.unshot"}) {
    const ProgramResult refused = runScript(folder_, "quit\n", with(kCommon, {"--save", file}));
    EXPECT_EQ(refused.code, file == "room.obj" ? 2 : 4);
    EXPECT_THAT(refused.err, HasSubstr(file));
  }
}

// The disk is full at the end: what was kept before stays, and the exit code tells.
TEST_F(Saving, AKeptSolveThatFindsNoRoomAtTheEndIsReported) {
  ASSERT_EQ(runScript(folder_, "pause on\nstep 3\nwait shots 3\nsave-solve s.unshot\n", kCommon).code, 0);
  const std::string before = folder_.read("s.unshot");
  folder_.write("script.txt", "wait converged\n");
  const ProgramResult run = runProgram(folder_,
                                       {"view", "--gl", "osmesa", "--script", "script.txt", "room.obj",
                                        "--resume", "s.unshot", "--save", "s.unshot"},
                                       {0, before.size() / 2});
  EXPECT_EQ(run.code, 4);
  EXPECT_THAT(run.err, HasSubstr("s.unshot: cannot be written: File too large"));
  EXPECT_TRUE(folder_.read("s.unshot") == before);
  EXPECT_EQ(folder_.names().size(), 4u) << "a temporary file is left";
}

// Memory that is used up while the window solves and draws.
TEST_F(Saving, MemoryThatIsUsedUpIsSaidAndCostsNoSolve) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes terabytes of addresses";
  folder_.write("script.txt", "wait converged\nscreenshot message.png\n");
  const ProgramResult run =
      runProgram(folder_,
                 {"view", "--gl", "osmesa", "--script", "script.txt", "room.obj", "--form-factors", "rays",
                  "--elements", "60000", "--error", "1e-6", "--save", "s.unshot"},
                 {1'000'000'000});
  EXPECT_EQ(run.code, 4) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("there is not enough memory"), HasSubstr("--keep")));
  const ProgramResult resumed =
      runProgram(folder_, {"solve", "room.obj", "--resume", "s.unshot", "--keep", "50", "--max-shots", "10"});
  EXPECT_EQ(resumed.code, 5) << resumed.err;
}

// Saving a solve that is still being loaded is no save of the one before.
TEST_F(Saving, WhatIsGivenUpBeforeItBeganIsNotSaved) {
  // Meshing takes a while.
  const ProgramResult run =
      runScript(folder_, "wait converged\nelements 1000000\nsave-solve s.unshot\nquit\n", kCommon);
  EXPECT_EQ(run.code, 2) << run.err;
  EXPECT_THAT(run.err, HasSubstr("s.unshot: the solve that was to be saved had not begun"));
  EXPECT_FALSE(folder_.has("s.unshot"));
}

TEST_F(Saving, TheStateSaysWhereItWent) {
  LiveViewer::Options options;
  options.scene = folder_ / "room.obj";
  options.solve.elements = 300;
  options.solve.max_shots = 5;
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kStopped));
  live->perform("save-solve", folder_ / "s.unshot");
  ASSERT_TRUE(live.until([&] { return live->state().saves == 1; }));
  EXPECT_FALSE(live->error());
  EXPECT_EQ(live->state().saved_as, folder_ / "s.unshot");
  live->finish();
  EXPECT_EQ(live->exitCode(), 0);
}

/// A pipe whose reader takes its time, so that a save does.
class SlowFile {
 public:
  explicit SlowFile(std::string path) : path_(std::move(path)) {
    EXPECT_EQ(::mkfifo(path_.c_str(), 0600), 0);
    reader_ = std::jthread([this] {
      const int file = ::open(path_.c_str(), O_RDONLY);
      std::vector<char> bytes(1 << 16);
      for (ssize_t count; (count = ::read(file, bytes.data(), bytes.size())) > 0;) {
        read_ += static_cast<std::size_t>(count);
        std::this_thread::sleep_for(std::chrono::milliseconds(hurries ? 0 : 20));
      }
      ::close(file);
    });
  }
  std::atomic<bool> hurries{false};
  const std::string& path() const { return path_; }
  std::size_t read() const { return read_; }

 private:
  std::string path_;
  std::atomic<std::size_t> read_{0};
  std::jthread reader_;
};

/// A solve that is kept, in a window that was asked to close.
class ClosingWhileItSaves : public Saving {
 protected:
  ClosingWhileItSaves() : file_(folder_ / "kept") {
    LiveViewer::Options options;
    options.scene = folder_ / "room.obj";
    options.solve.elements = 5000;
    options.solve.error = 1e-9;
    options.kept = {file_.path(), 1e9, options.scene};
    live_.emplace(options);
    EXPECT_TRUE(live_->until([&] { return (*live_)->state().measures.shots > 50; }));
    (*live_)->close();
    EXPECT_TRUE(live_->until([&] { return saves() && *(*live_)->tasks().front().done > 0; }));
    EXPECT_FALSE((*live_)->closing());
  }
  bool saves() {
    const std::vector<Task> tasks = (*live_)->tasks();
    return !tasks.empty() && tasks.front().text == "saving kept";
  }
  bool closes() {
    return live_->until([&] { return (*live_)->closing(); }, 60);
  }

  SlowFile file_;
  std::optional<LiveViewer> live_;
};

TEST_F(ClosingWhileItSaves, AWindowStaysUntilItIsSaved) {
  (*live_)->close();  // once more
  live_->draw();
  EXPECT_FALSE((*live_)->closing());
  (*live_)->perform("restart");  // it does nothing else any more
  file_.hurries = true;
  ASSERT_TRUE(closes());
  (*live_)->finish();
  EXPECT_EQ((*live_)->exitCode(), 0);
  EXPECT_FALSE((*live_)->error());
  EXPECT_GT(file_.read(), 100'000u);
}

TEST_F(ClosingWhileItSaves, TheSaveCanBeGivenUp) {
  (*live_)->perform("give-up");
  ASSERT_TRUE(closes());
  (*live_)->finish();
  EXPECT_EQ((*live_)->exitCode(), 0);
}

TEST_F(Saving, ASavedSolveThatIsDroppedGoesOnOnItsScene) {
  LiveViewer::Options options;
  options.scene = folder_ / "room.obj";
  options.solve.elements = 300;
  options.solve.error = 1e-9;
  options.solve.max_shots = 20;
  LiveViewer live(options);
  const std::string saved = folder_ / "s.unshot";
  live->perform("open", saved);
  EXPECT_TRUE(live->error()) << "its scene is not there yet";
  live->perform("dismiss");
  ASSERT_TRUE(live.untilPhase(SessionPhase::kStopped));
  live->perform("save-solve", saved);
  ASSERT_TRUE(live.until([&] { return live->state().saves == 1; }));
  live->perform("restart");
  live->pause();
  ASSERT_TRUE(live.until([&] { return live->upToDate() && live->state().measures.shots < 20; }));
  live->perform("open", saved);
  ASSERT_TRUE(live.until([&] { return live->state().resumed && live->upToDate(); }));
  EXPECT_FALSE(live->error());
  EXPECT_EQ(live->state().resumed->shots, 20u);
  EXPECT_GE(live->state().measures.shots, 20u);
  EXPECT_EQ(live->state().facts->scene_name, "room");
}

/// The real window.
class SavingInAWindow : public testing::Test {
 protected:
  /// Solves for minutes.
  const std::vector<std::string> kLong{"--size", "400x300", "--form-factors", "rays",   "--elements",
                                       "20000",  "--error", "1e-9",           "--keep", "200"};
  const Screen screen_;

  static bool goesOn(const TempFolder& folder, const std::string& file) {
    const std::string scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
    const ProgramResult run = runProgram(folder, {"solve", scene, "--resume", file, "--max-shots", "1"});
    EXPECT_EQ(run.code, 5) << run.err;
    return run.code == 5;
  }
};

// Closed as soon as the key was pressed: at the latest while it saves.
TEST_F(SavingInAWindow, ClosingWhileItSavesLosesNothing) {
  WindowRun run(kLong);
  ASSERT_TRUE(run.hasTitle("cornell_box \u2013 Unshot"));
  run.key("ctrl+s");
  askToClose(run.window());
  const ProgramResult result = run.end();
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(run.folder().names(), std::set<std::string>{"unshot-cornell_box-001.unshot"});
  EXPECT_TRUE(goesOn(run.folder(), "unshot-cornell_box-001.unshot"));
}

TEST_F(SavingInAWindow, AKeptSolveIsSavedWhenTheWindowCloses) {
  WindowRun run(with(kLong, {"--save", "s.unshot", "--save-every", "1000"}));
  ASSERT_TRUE(run.hasTitle("cornell_box \u2013 Unshot"));
  EXPECT_FALSE(run.folder().has("s.unshot"));
  askToClose(run.window());
  const ProgramResult result = run.end();
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(goesOn(run.folder(), "s.unshot"));
}

// Ctrl-C in the terminal that it was started from, also while it rests.
TEST_F(SavingInAWindow, AKeptSolveIsSavedWhenInterrupted) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TempFolder folder;
    ProgramRun run(folder.path(),
                   with({"view", "--save", "s.unshot", "--save-every", "1000", "--max-shots", "3"}, kLong));
    // Saved where it comes to rest, and once more at the end.
    ASSERT_TRUE(eventually([&] { return folder.has("s.unshot") || !run.running(); })) << run.errorsSoFar();
    std::filesystem::remove(folder.path() / "s.unshot");
    run.send(signal);
    ASSERT_TRUE(eventually([&] { return !run.running(); })) << "sleeps on";
    const ProgramResult result = run.wait();
    EXPECT_EQ(result.code, 130) << result.err;
    EXPECT_EQ(result.err, "unshot: interrupted\n");
    EXPECT_TRUE(goesOn(folder, "s.unshot"));
  }
}

TEST_F(SavingInAWindow, AKeptSolveIsThereAfterAKill) {
  TempFolder folder;
  ProgramRun run(folder.path(), with({"view", "--save", "s.unshot", "--save-every", "0.2"}, kLong));
  ASSERT_TRUE(eventually([&] { return folder.has("s.unshot") || !run.running(); })) << run.errorsSoFar();
  run.send(SIGKILL);
  EXPECT_EQ(run.wait().code, 128 + SIGKILL);
  EXPECT_TRUE(goesOn(folder, "s.unshot"));
}

}  // namespace
}  // namespace unshot
