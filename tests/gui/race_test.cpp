// Two iteration modes side by side in the viewer.
#include <gmock/gmock.h>
#include <imgui_internal.h>

#include "gui/support/program_pictures.h"
#include "support/assets.h"
#include "support/live_viewer.h"
#include "viewer/scene_area.h"

namespace unshot {
namespace {

using testing_support::kCornellBox;
using testing_support::lightDifference;
using testing_support::LiveViewer;
using testing_support::meanLight;
using testing_support::picture;
using testing_support::ProgramResult;
using testing_support::runScript;
using testing_support::TempFolder;

ImageF columns(const ImageF& image, int from, int count) {
  ImageF out{count, image.height, {}};
  for (int y = 0; y < image.height; ++y) {
    const float* row = &image.rgb[3 * static_cast<std::size_t>(y * image.width + from)];
    out.rgb.insert(out.rgb.end(), row, row + 3 * count);
  }
  return out;
}

struct Halves {
  ImageF left, right;
};

Halves halvesOf(const ImageF& image) {
  const SceneSplit split = splitScene(image.width, true);
  return {columns(image, 0, split.left), columns(image, split.right_at, split.right)};
}

TEST(SceneSplit, LeavesAGapBetweenTwoOfOneSize) {
  for (const int width : {976, 977, 200}) {
    const SceneSplit split = splitScene(width, true);
    EXPECT_EQ(split.left, split.right);
    EXPECT_EQ(split.right_at + split.right, width);
    EXPECT_GE(split.right_at - split.left, 4);
    EXPECT_LE(split.right_at - split.left, 5);
  }
  EXPECT_EQ(splitScene(976, false).left, 976);
  EXPECT_EQ(splitScene(976, false).right, 0);
  EXPECT_EQ(splitScene(0, true).left, 0);
}

// The same light from the same camera in the same exposure gives the same picture; seven shots of two modes
// are not the same light.
TEST(Race, ShowsBothAlikeWhereTheyAreAlike) {
  const TempFolder folder;
  const ProgramResult run =
      runScript(folder,
                "ambient off\npanel off\nwait converged\nscreenshot-scene alone.png\nrace jacobi\npause on\n"
                "step 7\nwait shots 7\nscreenshot-scene seven.png\npause off\nwait converged\n"
                "screenshot-scene end.png\nrace off\nscreenshot-scene off.png\n",
                {kCornellBox, "--elements", "300", "--size", "404x300", "--error", "0.0001"});
  EXPECT_EQ(run.code, 0) << run.err;
  const Halves seven = halvesOf(picture(folder, "seven.png")), end = halvesOf(picture(folder, "end.png"));
  EXPECT_EQ(end.left.width, 200);
  EXPECT_LT(lightDifference(end.right, end.left), 0.003);
  EXPECT_GT(lightDifference(seven.right, seven.left), 0.03);
  EXPECT_LT(meanLight(seven.left), 0.9 * meanLight(end.left));
  EXPECT_LT(lightDifference(picture(folder, "off.png"), picture(folder, "alone.png")), 0.003);
}

TEST(Race, LabelsBothPictures) {
  LiveViewer::Options options;
  options.scene = kCornellBox;
  options.solve.elements = 300;
  options.script = "wait converged\nrace gauss-seidel\nwait converged\n";
  options.width = 1000;
  options.height = 720;
  LiveViewer live(options);
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  ASSERT_TRUE(live->state().rival);
  EXPECT_EQ(live->state().rival->facts->mode, "gauss-seidel");
  for (const char* window : {"race-left", "race-right"}) {
    const ImGuiWindow* found = ImGui::FindWindowByName(window);
    ASSERT_TRUE(found) << window;
    EXPECT_TRUE(found->Active) << window;
  }
  live->perform("race", "off");
  ASSERT_TRUE(live.until([&] { return !live->state().rival; }));
  live.draw();
  live.draw();
  EXPECT_FALSE(ImGui::FindWindowByName("race-right")->Active);
}

}  // namespace
}  // namespace unshot
