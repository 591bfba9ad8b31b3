// The real window on a screen of the test's own, with keys and mouse as a person has them.
#include <gmock/gmock.h>

#include <cstdlib>

#include "export/image_files.h"
#include "gui/support/screen.h"
#include "render/display_modes.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing_support::askToClose;
using testing_support::eventually;
using testing_support::ProgramResult;
using testing_support::runProgram;
using testing_support::Screen;
using testing_support::TempFolder;
using testing_support::WindowRun;
using testing_support::xdotool;

const std::string kTitle = "cornell_box \u2013 Unshot";

// Solves for minutes, and each shot changes the picture of the unshot light, which has an exposure of its
// own.
const std::vector<std::string> kLongSolve{"--size", "960x360", "--display", "unshot", "--elements",
                                          "20000",  "--error", "1e-9",      "--keep", "0"};

class Window : public testing::Test {
 protected:
  Screen screen_;

  /// The scene loaded, the solve paused after some shots.
  static std::string pausedScene(WindowRun& run) {
    if (!run.hasTitle(kTitle)) ADD_FAILURE() << "has the title " << run.title();
    const std::string first = run.scene();
    if (!run.sceneChanges(first)) ADD_FAILURE() << "nothing is shot";
    run.key("space");
    return run.sceneAtRest();
  }
};

TEST_F(Window, SpacePausesAndNStepsAndSpaceGoesOn) {
  WindowRun run(kLongSolve);
  const std::string paused = pausedScene(run);
  run.key("n");
  EXPECT_TRUE(run.sceneChanges(paused)) << "no step";
  const std::string stepped = run.sceneAtRest();
  EXPECT_NE(stepped, paused);
  run.key("space");
  EXPECT_TRUE(run.sceneChanges(stepped)) << "does not go on";
  run.endsOn("ctrl+q");
}

TEST_F(Window, KeysOfTheDisplay) {
  WindowRun run(kLongSolve);
  const std::string unshot = pausedScene(run);
  std::set<std::string> pictures{unshot};
  const std::size_t modes = displayModes().size();
  // Two are black as yet: nothing is picked, and no step was taken by itself.
  for (std::size_t i = 0; i + 1 < modes; ++i) {
    run.key("m");
    pictures.insert(run.scene());
  }
  EXPECT_EQ(pictures.size(), modes - 1);
  run.key("m");
  EXPECT_EQ(run.scene(), unshot) << "does not come round";
  std::size_t shown = 0;
  while (displayModes()[shown].info.key != "unshot") ++shown;
  for (; displayModes()[shown % modes].info.key != "radiosity"; ++shown) run.key("m");
  const std::string radiosity = run.scene();
  run.key("b");
  const std::string direct = run.scene();
  EXPECT_NE(direct, radiosity);
  run.key("b");
  EXPECT_EQ(run.scene(), radiosity);
  run.key("g");
  EXPECT_NE(run.scene(), radiosity);
  run.key("g");
  run.key("plus");
  EXPECT_NE(run.scene(), radiosity);
  run.key("minus");
  EXPECT_EQ(run.scene(), radiosity);
  const int beside_panel = readImage(run.folder().path() / run.screenshot()).width;
  run.key("Tab");
  EXPECT_TRUE(
      eventually([&] { return readImage(run.folder().path() / run.screenshot()).width > beside_panel; }));
  run.endsOn("ctrl+q");
}

TEST_F(Window, AnActionIsTypedIntoTheList) {
  WindowRun run(kLongSolve);
  ASSERT_TRUE(run.hasTitle(kTitle));
  // As fast as one can type: none of the keys waits for a frame.
  xdotool("key ctrl+p type --delay 0 'screenshot typed.png'");
  xdotool("key Return ctrl+F12");
  EXPECT_TRUE(eventually([&] { return run.folder().names().size() == 2; }));
  EXPECT_EQ(run.folder().names(), (std::set<std::string>{"typed.png", "unshot-cornell_box-001.png"}))
      << "typed keys went to the scene too, or the key after the list to nobody";
  run.endsOn("ctrl+q");
}

// Y and Z have changed places there, and + and - are elsewhere.
TEST_F(Window, KeysAreThoseThatAreSeenOnTheKeyboard) {
  ASSERT_EQ(std::system("setxkbmap de"), 0);
  WindowRun run(kLongSolve);
  const std::string paused = pausedScene(run);
  run.key("plus");
  EXPECT_TRUE(run.sceneChanges(paused)) << "no brighter";
  run.key("minus");
  EXPECT_TRUE(eventually([&] { return run.scene() == paused || HasFailure(); })) << "no darker";
  // What the desktop takes for itself.
  for (const char* chord : {"super+b", "alt+b", "super+plus"}) run.key(chord);
  EXPECT_EQ(run.scene(), paused);
  run.key("ctrl+p");
  xdotool("type --delay 0 'reflectance red 0.9,0.9,0.9'");
  run.key("Return");
  EXPECT_TRUE(run.sceneChanges(paused)) << "no edit";
  const std::string edited = run.sceneAtRest();
  run.key("ctrl+z");
  EXPECT_TRUE(run.sceneChanges(edited)) << "not undone";
  const std::string undone = run.sceneAtRest();
  run.key("ctrl+y");
  EXPECT_TRUE(run.sceneChanges(undone)) << "not done again";
  run.key("ctrl+z");  // nothing is left to be kept
  run.endsOn("ctrl+q");
}

TEST_F(Window, MouseAndFlight) {
  WindowRun run(kLongSolve);
  pausedScene(run);
  run.key("f");
  std::string now = run.sceneAtRest();
  const std::string framed = now;
  // Low in the window: a line on a picture that was written stands at its top.
  const auto drag = [&](int button) {
    SCOPED_TRACE("button " + std::to_string(button));
    xdotool("mousemove --window " + run.window() + " 60 300");
    xdotool("mousedown " + std::to_string(button));
    int x = 60;
    EXPECT_TRUE(eventually([&] {
      x = x < 90 ? x + 5 : 60;
      xdotool("mousemove --window " + run.window() + " " + std::to_string(x) + " 310");
      return run.scene() != now || HasFailure();
    }));
    xdotool("mouseup " + std::to_string(button));
    now = run.sceneAtRest();
  };
  for (const int button : {1, 2, 3}) drag(button);
  xdotool("click 4");
  EXPECT_TRUE(run.sceneChanges(now)) << "the wheel does nothing";
  now = run.sceneAtRest();
  xdotool("keydown w");
  EXPECT_TRUE(run.sceneChanges(now)) << "W does not fly";
  xdotool("keyup w");
  run.sceneAtRest();
  run.key("f");
  EXPECT_TRUE(eventually([&] { return run.scene() == framed || HasFailure(); })) << "F does not go back";
  run.endsOn("ctrl+q");
}

TEST_F(Window, ScreenshotsAreNumberedAndHaveTheWindowsSize) {
  WindowRun run({"--size", "960x480", "--elements", "500"});
  ASSERT_TRUE(run.hasTitle(kTitle));
  EXPECT_EQ(run.screenshot("F12"), "unshot-cornell_box-001.png");
  EXPECT_EQ(run.screenshot("ctrl+F12"), "unshot-cornell_box-002.png");
  const ImageF with = readImage(run.folder().path() / "unshot-cornell_box-001.png");
  const ImageF without = readImage(run.folder().path() / "unshot-cornell_box-002.png");
  EXPECT_EQ(with.width, 960);
  EXPECT_EQ(with.height, 480);
  EXPECT_LT(without.width, 960);
  EXPECT_EQ(without.height, 480);
  struct Size {
    int width, height;
  };
  for (const Size size : {Size{900, 620}, Size{420, 300}}) {
    xdotool("windowsize " + run.window() + " " + std::to_string(size.width) + " " +
            std::to_string(size.height));
    EXPECT_TRUE(eventually([&] {
      const ImageF image = readImage(run.folder().path() / run.screenshot("F12"));
      return (image.width == size.width && image.height == size.height) || HasFailure();
    })) << size.width
        << "x" << size.height;
  }
  run.endsOn("ctrl+q");
}

struct Ending {
  const char* name;
  const char* elements;  ///< so many that this moment lasts
  bool while_loading, by_key;
};

void PrintTo(const Ending& ending, std::ostream* out) { *out << ending.name; }

class WindowEnding : public Window, public testing::WithParamInterface<Ending> {};

TEST_P(WindowEnding, IsPoliteAndSoon) {
  WindowRun run({"--size", "400x300", "--elements", GetParam().elements});
  if (GetParam().while_loading) {
    EXPECT_EQ(run.title(), "Unshot") << "has loaded already";
  } else {
    EXPECT_TRUE(run.hasTitle(kTitle));
  }
  if (GetParam().by_key) {
    run.key("ctrl+q");
  } else {
    askToClose(run.window());
  }
  const ProgramResult result = run.end();
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
}

INSTANTIATE_TEST_SUITE_P(Gui, WindowEnding,
                         testing::Values(Ending{"KeyWhileLoading", "100000", true, true},
                                         Ending{"CloseWhileLoading", "100000", true, false},
                                         Ending{"KeyInTheFirstShot", "30000", false, true},
                                         Ending{"CloseInTheFirstShot", "30000", false, false}),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(NoWindow, WithoutADisplayItNamesTheCommandThatNeedsNone) {
  const TempFolder folder;
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  for (const char* display : {"", ":4711"}) {
    if (*display) ::setenv("DISPLAY", display, 1);
    const ProgramResult result = runProgram(folder, {"view"});
    EXPECT_EQ(result.code, 4);
    EXPECT_THAT(result.err, HasSubstr("no window can be opened here"));
    EXPECT_THAT(result.err, HasSubstr("unshot solve "));
  }
  ::unsetenv("DISPLAY");
}

TEST(NoWindow, AnOpenGlThatIsTooOldIsNamed) {
  const Screen screen;
  const TempFolder folder;
  ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
  const ProgramResult result = runProgram(folder, {"view"});
  ::unsetenv("MESA_GL_VERSION_OVERRIDE");
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, HasSubstr("this display gives no window with OpenGL 3.3: "));
  EXPECT_THAT(result.err, HasSubstr("unshot solve "));
}

TEST(NoGlx, OpensThroughEgl) {
  const Screen screen({"-extension", "GLX"});
  WindowRun run({"--size", "400x300", "--elements", "300"});
  ASSERT_TRUE(run.hasTitle(kTitle));
  const ImageF image = readImage(run.folder().path() / run.screenshot("F12"));
  EXPECT_EQ(image.width, 400);
  run.key("ctrl+q");
  EXPECT_EQ(run.end().code, 0);
}

}  // namespace
}  // namespace unshot
