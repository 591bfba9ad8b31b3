// Scripts in the real window, and the panel's choices clicked as a person does: every row of the tables.
#include <gmock/gmock.h>

#include "formfactor/methods.h"
#include "gui/support/panel.h"
#include "gui/support/program_pictures.h"
#include "gui/support/screen.h"
#include "gui/support/valid_arguments.h"
#include "render/display_modes.h"
#include "solver/modes.h"
#include "viewer/actions/actions.h"

namespace unshot {
namespace {

using namespace testing_support;

const std::string kFurnace = std::string(UNSHOT_SOURCE_DIR) + "/assets/furnace.obj";

/// Runs the lines in a window and expects that nothing was wrong.
void runInWindow(const TempFolder& folder, const std::string& lines, const std::string& size = "640x480") {
  const Screen screen;
  folder.write("script.txt", lines);
  const ProgramResult run = runProgram(
      folder, {"view", "--script", "script.txt", "--size", size, "--elements", "300", "--error", "0.02"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
}

TEST(WindowScript, PausesStepsResizesOpensAndCloses) {
  const TempFolder folder;
  runInWindow(folder,
              "ambient off\npause on\nstep 3\nwait shots 3\nframe\nscreenshot-scene three.png\n"
              "step 2\nwait shots 5\nscreenshot-scene five.png\npause off\nwait converged\n"
              "screenshot converged.png\nsize 900x600\nscreenshot large.png\nopen " +
                  kFurnace +
                  "\nwait converged\nscreenshot furnace.png\n"
                  "elements 30000\nwait shots 1\nquit\n");
  const ImageF converged = picture(folder, "converged.png"), large = picture(folder, "large.png"),
               furnace = picture(folder, "furnace.png");
  EXPECT_EQ(std::pair(converged.width, converged.height), std::pair(640, 480));
  EXPECT_EQ(std::pair(large.width, large.height), std::pair(900, 600));
  EXPECT_GT(lightDifference(furnace, large), 0.1);
  EXPECT_GT(lightDifference(picture(folder, "three.png"), picture(folder, "five.png")), 0.01);
}

// Each action once with an argument and once without, as far as it takes both: over a scene that is there, in
// the order of the table.
TEST(WindowScript, EveryActionOfTheTableIsPerformed) {
  const TempFolder folder;
  const ProgramResult solved =
      runProgram(folder, {"solve", std::string(UNSHOT_SOURCE_DIR) + "/assets/two_patches.obj", "--elements",
                          "300", "--do-all", "--ply", "solution.ply"});
  ASSERT_EQ(solved.code, 0) << solved.err;
  writePng(folder / "picture.png", Image8{2, 1, {255, 128, 0, 0, 128, 255}});
  std::string script = "wait converged\n";
  for (const Action& action : actions()) {
    if (action.key == "quit") continue;
    const std::string key(action.key);
    const auto valid = validArguments().find(action.key);
    if (valid != validArguments().end()) script += key + " " + valid->second + "\n";
    // A solve that was paused converges no more.
    if (key == "pause") script += "pause off\n";
    script += "wait converged\n";
    if (!action.needsArgument())
      script += key + "\n" + (key == "pause" ? "pause off\n" : "") + "wait converged\n";
  }
  runInWindow(folder, script + "quit\n", "940x640");
  for (const char* name : {"with.png", "without.png", "with.unshot", "with.mtl", "with.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
}

TEST(WindowScript, EveryModeAndEveryMethodConvergesToTheSame) {
  const TempFolder folder;
  std::string script = "error 0.001\nambient off\nwait converged\n";
  std::vector<std::string> names;
  const auto shoot = [&](const std::string& method, const std::string& mode) {
    names.push_back(method + "_" + mode + ".png");
    script += "restart\nmode " + mode + "\nwait converged\nscreenshot-scene " + names.back() + "\n";
  };
  script += "form-factors hemicube\n";
  for (const IterationModeRow& mode : iterationModes()) shoot("hemicube", std::string(mode.info.key));
  const std::size_t modes = names.size();
  for (const FormFactorMethodRow& method : formFactorMethods()) {
    if (method.info.key == "hemicube") continue;
    script += "form-factors " + std::string(method.info.key) + "\n";
    shoot(std::string(method.info.key), "southwell");
    shoot(std::string(method.info.key), "gmres");
  }
  // Half way, what was shot stays.
  script += "form-factors hemicube\nrestart\npause on\n";
  for (const IterationModeRow& mode : iterationModes())
    script += "mode " + std::string(mode.info.key) + "\nstep 4\nwait shots 1000000\n";
  runInWindow(folder, script + "pause off\nwait converged\nscreenshot-scene mixed.png\nquit\n");
  names.push_back("mixed.png");
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string& same = names[k < modes || k + 1 == names.size() ? 0 : k - (k - modes) % 2];
    const ImageF found = picture(folder, names[k]);
    EXPECT_LT(lightDifference(found, picture(folder, same)), 0.02)
        << names[k] << " against " << same << "; mean light " << meanLight(found) << " against "
        << meanLight(picture(folder, same)) << (showsSomething(found) ? "" : ", one even colour");
  }
}

TEST(WindowScript, EveryDisplayModeShowsAPictureOfItsOwn) {
  const TempFolder folder;
  // A single shot for the mode that shows the last one, which has to be asked for before; a patch whose form
  // factors are shown.
  std::string script =
      "display last-shot\npause on\nstep\nwait shots 1\npause off\nwait converged\npick 0.5,0.4\n";
  for (const DisplayMode& mode : displayModes()) {
    const std::string key(mode.info.key);
    script += "display " + key + "\nscreenshot-scene " + key + ".png\n";
  }
  runInWindow(folder, script + "quit\n");
  std::set<std::string> pictures;
  for (const DisplayMode& mode : displayModes()) {
    const std::string name = std::string(mode.info.key) + ".png";
    EXPECT_TRUE(showsSomething(picture(folder, name))) << name;
    EXPECT_TRUE(pictures.insert(folder.read(name)).second) << name;
  }
}

/// A choice of the panel at scale 1: the list opens below it, where the window has the room, its rows 20 px
/// apart (app/viewer/panels/theme.cpp).
class PanelChoices : public testing::Test {
 protected:
  static constexpr int kWidth = 900, kLeft = kWidth - kPanel;
  static constexpr int kScene = 21, kMode = 125, kMethod = 177, kShow = 333;

  void click(int x, int y) {
    xdotool("mousemove --window " + run_.window() + " " + std::to_string(x) + " " + std::to_string(y) +
            " click 1");
    run_.screenshot();  // a frame of the GUI after it
  }
  void choose(int y, std::size_t row) {
    click(kLeft + 180, y);
    click(kLeft + 180, y + 29 + 20 * static_cast<int>(row));
    xdotool("mousemove --window " + run_.window() + " 100 600");
  }
  /// What the panel shows in a line.
  std::string textAt(int y) {
    const ImageF image = readImage(run_.folder().path() / run_.screenshot("F12"));
    std::string bytes;
    for (int row = y - 9; row < y + 9; ++row) {
      for (int x = kLeft + 115; x < kLeft + 250; ++x) {
        const float green = image.rgb[static_cast<std::size_t>(3 * (row * image.width + x) + 1)];
        bytes += green > 0.3f ? '#' : ' ';
      }
    }
    return bytes;
  }
  /// The first, a middle and the last row of the table, each chosen and then shown.
  void chooseSome(int y, std::size_t first, std::size_t rows) {
    std::set<std::string> shown;
    for (const std::size_t k : {std::size_t{0}, rows / 2, rows - 1}) {
      choose(y, first + k);
      EXPECT_TRUE(eventually([&] { return shown.insert(textAt(y)).second; }, 20)) << "row " << k;
    }
  }

  const Screen screen_;
  WindowRun run_{{"--size", "900x1000", "--elements", "100", "--error", "0.5"}};
};

TEST_F(PanelChoices, RowsOfEveryTable) {
  ASSERT_TRUE(run_.hasTitle("cornell_box \u2013 Unshot"));
  chooseSome(kMode, 1, iterationModes().size());
  chooseSome(kShow, 0, displayModes().size());
  // Last: of some there is a warning, for which the rows make room.
  chooseSome(kMethod, 1, formFactorMethods().size());
  choose(kScene, 4);
  EXPECT_TRUE(run_.hasTitle("two_rooms \u2013 Unshot")) << run_.title();
  run_.endsOn("ctrl+q");
}

}  // namespace
}  // namespace unshot
