// Whole runs of `unshot view --script` without a window.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "formfactor/methods.h"
#include "gui/support/program_pictures.h"
#include "render/display_modes.h"
#include "solver/modes.h"
#include "support/assets.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing_support::kCornellBox;
using testing_support::kTwoPatches;
using testing_support::lightDifference;
using testing_support::picture;
using testing_support::ProgramResult;
using testing_support::ProgramRun;
using testing_support::runProgram;
using testing_support::runScript;
using testing_support::showsSomething;
using testing_support::TempFolder;
using testing_support::with;
using testing_support::writeRoom;

const std::vector<std::string> kSmall{kCornellBox, "--elements", "300", "--size", "400x300"};

TEST(Program, OpensConvergesAndTakesScreenshots) {
  const TempFolder folder;
  const ProgramResult run = runScript(folder,
                                      "wait converged\nscreenshot all.png\nscreenshot-scene scene.png\n"
                                      "panel off\nscreenshot-scene wide.png\nscreenshot\nscreenshot\n"
                                      "screenshot-scene last.png\n",
                                      {kCornellBox, "--elements", "300", "--size", "960x300"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(folder.names(),
            (std::set<std::string>{"script.txt", "all.png", "scene.png", "wide.png", "last.png",
                                   "unshot-cornell_box-001.png", "unshot-cornell_box-002.png"}));
  const ImageF all = picture(folder, "all.png"), scene = picture(folder, "scene.png");
  EXPECT_EQ(all.width, 960);
  EXPECT_EQ(all.height, 300);
  EXPECT_EQ(scene.width, 960 - 320) << "without the panel";
  EXPECT_EQ(scene.height, 300);
  EXPECT_EQ(picture(folder, "wide.png").width, 960);
  EXPECT_EQ(folder.read("wide.png"), folder.read("last.png"));
  EXPECT_TRUE(showsSomething(scene));
}

TEST(Program, StepsShootExactlySoOften) {
  const TempFolder folder;
  const ProgramResult run = runScript(folder,
                                      "ambient off\npanel off\npause on\nstep 5\nwait shots 5\nframe\n"
                                      "screenshot-scene five.png\nstep\nwait shots 6\n"
                                      "screenshot-scene six.png\nrestart\npause on\nstep 2\nstep 2\nstep\n"
                                      "wait shots 5\nscreenshot-scene again.png\n",
                                      kSmall);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(folder.read("five.png"), folder.read("again.png"));
  EXPECT_NE(folder.read("five.png"), folder.read("six.png"));
}

// The viewer and `unshot solve` share solver and renderer. They meter the light on copies of different size,
// the viewer on one without smooth edges, so that the exposure differs by some 0.3 %, which moves pixels by
// one step of 8 bits: 0.2 to 0.6 % of the light. One shot more or less moves the picture of seven shots by
// several percent.
constexpr double kSameRenderer = 0.008;

TEST(Program, DrawsWhatSolveDraws) {
  const TempFolder folder;
  const std::vector<std::string> common{kCornellBox, "--elements", "500",   "--form-factors",
                                        "hemicube",  "--seed",     "3",     "--size",
                                        "400x300",   "--error",    "0.001", "--display"};
  struct Meeting {
    std::string display, script, limit;
  };
  for (const Meeting& m : {Meeting{"radiosity", "wait converged\n", "100000"},
                           Meeting{"flat", "pause on\nstep 7\nwait shots 7\n", "7"}}) {
    SCOPED_TRACE(m.display);
    const ProgramResult view =
        runScript(folder,
                  "ambient off\npanel off\n" + m.script +
                      "camera 278,273,-800,278,273,0,39.3\nscreenshot-scene view.png\n",
                  with(common, {m.display}));
    ASSERT_EQ(view.code, 0) << view.err;
    const ProgramResult solve =
        runProgram(folder, with(with({"solve"}, common),
                                {m.display, "--gl", "osmesa", "--eye", "278,273,-800", "--at", "278,273,0",
                                 "--fov", "39.3", "--max-shots", m.limit, "--png", "solve.png"}));
    ASSERT_THAT(solve.code, testing::AnyOf(0, 5)) << solve.err;
    EXPECT_LT(lightDifference(picture(folder, "view.png"), picture(folder, "solve.png")), kSameRenderer);
  }
}

TEST(Program, EveryDisplayModeShowsAPictureOfItsOwn) {
  const TempFolder folder;
  std::string script = "pause on\nstep 20\nwait shots 20\nframe\npick 0.5,0.4\n";  // for its form factors
  for (const DisplayMode& mode : displayModes()) {
    const std::string key(mode.info.key);
    script += "display " + key + "\nscreenshot-scene " + key + ".png\n";
  }
  script +=
      "display radiosity\nradiosity off\nscreenshot-scene direct.png\nradiosity on\nambient off\n"
      "screenshot-scene no_ambient.png\nexposure 2\nscreenshot-scene bright.png\n"
      "exposure 0\nambient on\nscreenshot-scene back.png\n";
  const ProgramResult run = runScript(folder, script, kSmall);
  ASSERT_EQ(run.code, 0) << run.err;
  std::set<std::string> pictures;
  for (const std::string& name : folder.names()) {
    if (!name.ends_with(".png") || name == "back.png") continue;
    EXPECT_TRUE(showsSomething(picture(folder, name))) << name;
    EXPECT_TRUE(pictures.insert(folder.read(name)).second) << name << " is like another";
  }
  EXPECT_EQ(pictures.size(), displayModes().size() + 3);
  EXPECT_EQ(folder.read("back.png"), folder.read("radiosity.png"));
}

// Modes end within the error asked for, 1 % of the power, whose light reaches the picture once more at most.
TEST(Program, EveryMethodFinenessAndHemicube) {
  const TempFolder folder;
  std::string script = "panel off\nwait converged\nscreenshot-scene auto.png\n";
  for (const FormFactorMethodRow& method : formFactorMethods()) {
    const std::string key(method.info.key);
    script += "form-factors " + key + "\nwait converged\nscreenshot-scene " + key + ".png\n";
  }
  script +=
      "form-factors hemicube\nhemicube 128\nwait converged\nscreenshot-scene finer_hemicube.png\n"
      "elements 800\nwait converged\nscreenshot-scene finer_mesh.png\n";
  const ProgramResult run =
      runScript(folder, script, {kTwoPatches, "--elements", "200", "--size", "400x300"});
  ASSERT_EQ(run.code, 0) << run.err;
  const ImageF reference = picture(folder, "finer_mesh.png");
  for (const std::string& name : folder.names()) {
    if (!name.ends_with(".png")) continue;
    EXPECT_LT(lightDifference(picture(folder, name), reference), 0.05) << name;
  }
  EXPECT_NE(folder.read("hemicube.png"), folder.read("closed-form.png"));
}

TEST(Program, LoadsAnotherSceneAndFramesIt) {
  const TempFolder folder;
  const std::string camera = "camera 278,273,-800,278,273,0,39.3\n";
  const ProgramResult run =
      runScript(folder,
                "wait converged\n" + camera + "screenshot-scene first.png\nopen " + kTwoPatches +
                    "\nwait converged\nscreenshot-scene framed.png\n" + camera +
                    "screenshot-scene elsewhere.png\nscreenshot\nopen " + kCornellBox + "\nwait converged\n" +
                    camera + "screenshot-scene third.png\n",
                kSmall);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(folder.names().contains("unshot-two_patches-001.png"));
  EXPECT_EQ(folder.read("third.png"), folder.read("first.png"));
  EXPECT_NE(folder.read("framed.png"), folder.read("elsewhere.png")) << "has not found a camera of its own";
  EXPECT_TRUE(showsSomething(picture(folder, "framed.png")));
}

TEST(Program, ABrokenSceneLeavesThePictureAndEndsWithThree) {
  const TempFolder folder;
  folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  for (const std::string file : {"broken.obj", "missing.obj"}) {
    SCOPED_TRACE(file);
    const ProgramResult run = runScript(folder,
                                        "wait converged\nscreenshot-scene before.png\nopen " + file +
                                            "\nwait seconds 0\nscreenshot message.png\ndismiss\n"
                                            "screenshot-scene after.png\nscreenshot all_after.png\n",
                                        kSmall);
    EXPECT_EQ(run.code, 3) << run.err;
    EXPECT_EQ(folder.read("before.png"), folder.read("after.png"));
    EXPECT_NE(folder.read("message.png"), folder.read("all_after.png")) << "no message in the window";
  }
}

TEST(Program, AFirstSceneThatIsBrokenEndsWithThree) {
  const TempFolder folder;
  folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  const ProgramResult run =
      runScript(folder, "wait converged\nscreenshot message.png\n", {"broken.obj", "--size", "400x300"});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("broken.obj:3"), std::string::npos) << "not said on the terminal: " << run.err;
  EXPECT_TRUE(showsSomething(picture(folder, "message.png")));
  EXPECT_EQ(runScript(folder, "quit\n", {"missing.obj"}).code, 3);
}

TEST(Program, SizeAndScale) {
  const TempFolder folder;
  const ProgramResult run = runScript(
      folder,
      "pause on\nstep\nwait shots 1\nscreenshot small.png\nsize 1900x600\nscale 2\nscreenshot large.png\n"
      "screenshot-scene large_scene.png\nscale 1\nscreenshot-scene scene.png\nsize 400x300\n"
      "screenshot small_again.png\n",
      kSmall);
  ASSERT_EQ(run.code, 0) << run.err;
  const ImageF large = picture(folder, "large.png");
  EXPECT_EQ(large.width, 1900);
  EXPECT_EQ(large.height, 600);
  EXPECT_LT(picture(folder, "large_scene.png").width, picture(folder, "scene.png").width);
  EXPECT_EQ(picture(folder, "small_again.png").width, 400);
}

TEST(Program, QuitsDuringLoadingAndDuringTheFirstShot) {
  const TempFolder folder;
  const std::vector<std::string> large{kCornellBox, "--elements", "50000"};
  EXPECT_EQ(runScript(folder, "quit\nscreenshot never.png\n", large).code, 0);
  EXPECT_EQ(runScript(folder, "wait shots 0\nquit\nscreenshot never.png\n", large).code, 0);
  EXPECT_EQ(runScript(folder, "wait shots 1\nopen " + kTwoPatches + "\nquit\n", kSmall).code, 0);
  EXPECT_FALSE(folder.names().contains("never.png"));
}

TEST(Program, WrongScriptsEndBeforeAnythingRuns) {
  const TempFolder folder;
  for (const std::string wrong : {"jump", "step many", "wait", "display", "camera 1,2,3"}) {
    const ProgramResult run =
        runScript(folder, "screenshot early.png\r\n# then\r\n\t" + wrong + "\r\n", kSmall);
    EXPECT_EQ(run.code, 2) << wrong;
    EXPECT_THAT(run.err, HasSubstr("script.txt:3: "));
    EXPECT_THAT(run.err, HasSubstr("try: "));
  }
  EXPECT_EQ(folder.names(), std::set<std::string>{"script.txt"});
}

TEST(Program, UnreadableScripts) {
  const TempFolder folder;
  for (const std::string path : {"missing.txt", "."}) {
    const ProgramResult run = runProgram(folder, {"view", "--gl", "osmesa", "--script", path});
    EXPECT_EQ(run.code, 3) << run.err;
    EXPECT_THAT(run.err, HasSubstr(path));
  }
}

TEST(Program, WithoutAWindowItNeedsAScript) {
  const TempFolder folder;
  const ProgramResult run = runProgram(folder, {"view", "--gl", "osmesa"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("unshot solve"));
}

TEST(Program, AScreenshotThatCannotBeWrittenIsReported) {
  const TempFolder folder;
  const ProgramResult run =
      runScript(folder, "wait shots 1\nscreenshot nowhere/picture.png\nscreenshot here.png\n", kSmall);
  EXPECT_EQ(run.code, 4);
  EXPECT_TRUE(folder.names().contains("here.png"));
}

// The scene is black, and the window says why.
TEST(Program, ASceneWithoutLightSaysSo) {
  const TempFolder folder;
  folder.write("dark.obj", "v 0 0 0\nv 2 0 0\nv 2 0 2\nv 0 0 2\nv 0 2 0\nv 2 2 0\nf 1 4 3 2\nf 1 2 6 5\n");
  const ProgramResult run =
      runScript(folder, "wait converged\nscreenshot window.png\nscreenshot-scene scene.png\nquit\n",
                {"dark.obj", "--size", "1280x720", "--sky", "0,0,0"});
  EXPECT_EQ(run.code, 0) << run.err;
  const ImageF window = picture(folder, "window.png"), scene = picture(folder, "scene.png");
  const auto brightest = [&](const ImageF& image) {
    float most = 0;
    for (int y = image.height / 2 - 20; y < image.height / 2 + 20; ++y) {
      for (int x = 300; x < 700; ++x) {
        const std::size_t pixel = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                       static_cast<std::size_t>(x));
        most = std::max(most, image.rgb[pixel]);
      }
    }
    return most;
  };
  EXPECT_LT(brightest(scene), 0.05f) << "there is light";
  EXPECT_GT(brightest(window), 0.3f) << "no text over the scene";
}

// A heading in a colour of its own, above all others; the list opens below it.
TEST(Program, WarningsAreSeenWithoutScrolling) {
  const TempFolder folder;
  writeRoom(folder, "usemtl nowhere\nf 1 2 6\n");
  const ProgramResult run =
      runScript(folder, "wait converged\nplot shots\nscreenshot closed.png\nnotes on\nscreenshot open.png\n",
                {"room.obj", "--elements", "100", "--size", "1280x720"});
  EXPECT_EQ(run.code, 0) << run.err;
  const auto colourAt = [](const ImageF& image, int x, int y) {
    const std::size_t pixel = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                   static_cast<std::size_t>(x));
    return std::array<float, 3>{image.rgb[pixel], image.rgb[pixel + 1], image.rgb[pixel + 2]};
  };
  const ImageF closed = picture(folder, "closed.png"), open = picture(folder, "open.png");
  const auto heading = colourAt(closed, 1240, 98);
  EXPECT_GT(heading[0], 3 * heading[2]) << "no warning colour";
  EXPECT_EQ(heading, colourAt(open, 1240, 98));
  EXPECT_NE(colourAt(closed, 1240, 124), colourAt(open, 1240, 124)) << "the next heading has not moved";
}

}  // namespace
}  // namespace unshot
