// The real window on a screen of twice the scale, as a desktop tells it: what is drawn twice as large is hit
// where it is drawn.
#include <gtest/gtest.h>

#include "export/image_files.h"
#include "gui/support/panel.h"
#include "gui/support/screen.h"
// After gtest, whose names its macros take.
#include <X11/Xatom.h>

namespace unshot {
namespace {

using testing_support::eventually;
using testing_support::kPanel;
using testing_support::Screen;
using testing_support::WindowRun;
using testing_support::xdotool;

/// Of windows that open from now on.
void setDotsPerInch(int dpi) {
  Display* display = ::XOpenDisplay(nullptr);
  ASSERT_TRUE(display);
  const std::string text = "Xft.dpi:\t" + std::to_string(dpi) + "\n";
  ::XChangeProperty(display, DefaultRootWindow(display), XA_RESOURCE_MANAGER, XA_STRING, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  ::XCloseDisplay(display);
}

void click(int x, int y) {
  xdotool("mousemove --sync " + std::to_string(x) + " " + std::to_string(y));
  xdotool("click 1");
}

TEST(ScaledWindow, IsLaidOutTwiceAsLargeAndFollowsTheMouse) {
  const Screen screen({"-screen", "0", "2000x1300x24"});
  setDotsPerInch(192);
  WindowRun run({"--elements", "100", "--error", "0.5"});
  ASSERT_TRUE(run.hasTitle("cornell_box \u2013 Unshot"));
  // As large as the screen has room for: the panel is beside the scene.
  ASSERT_TRUE(eventually([&] {
    return xdotool("getwindowgeometry " + run.window()).find("2000x1300") != std::string::npos;
  })) << xdotool("getwindowgeometry " + run.window());
  const auto sizeOf = [&](const std::string& name) {
    const ImageF image = readImage(run.folder() / name);
    return std::pair(image.width, image.height);
  };
  ASSERT_TRUE(eventually([&] { return sizeOf(run.screenshot()).first == 2000 - 2 * kPanel; }));
  EXPECT_EQ(sizeOf(run.screenshot("F12")), std::pair(2000, 1300));
  // "Radiosity", which switches to direct light alone; twice where it is at scale 1.
  const int left = 2000 - 2 * kPanel;
  const std::string before = run.sceneAtRest();
  click(left + 2 * 22, 2 * 385);
  EXPECT_TRUE(run.sceneChanges(before)) << "the box is somewhere else";
  click(left + 2 * 22, 2 * 385);
  // The exposure is dragged to its right end.
  const std::string all = run.sceneAtRest();
  const std::string y = " " + std::to_string(2 * 463);
  xdotool("mousemove --sync " + std::to_string(left + 2 * 200) + y + " mousedown 1");
  xdotool("mousemove --sync " + std::to_string(left + 2 * 280) + y);
  EXPECT_TRUE(run.sceneChanges(all)) << "the slider does not follow the mouse";
  xdotool("mouseup 1");
  run.endsOn("ctrl+q");
}

}  // namespace
}  // namespace unshot
