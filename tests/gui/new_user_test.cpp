// As a new user would: a room of one's own, opened in the real window, watched until it is solved, looked
// into and kept as a picture.
#include <gtest/gtest.h>

#include <cmath>

#include "export/image_files.h"
#include "gui/support/panel.h"
#include "gui/support/screen.h"

namespace unshot {
namespace {

using namespace testing_support;

// A room of 4 x 3 x 2.5 m with a lamp in its ceiling, and a box in it, as modelling programs write them.
constexpr const char* kRoom = R"(# a room
mtllib my room.mtl
o Room
v 0 0 0
v 4 0 0
v 4 0 3
v 0 0 3
v 0 2.5 0
v 4 2.5 0
v 4 2.5 3
v 0 2.5 3
v 1.5 2.49 1
v 2.5 2.49 1
v 2.5 2.49 2
v 1.5 2.49 2
v 0.5 0 0.5
v 1.2 0 0.5
v 1.2 0 1.2
v 0.5 0 1.2
v 0.5 1 0.5
v 1.2 1 0.5
v 1.2 1 1.2
v 0.5 1 1.2
usemtl plaster
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
usemtl red
f 4 1 5 8
usemtl blue
f 2 3 7 6
usemtl lamp
f 9 10 11 12
usemtl wood
f 13 14 18 17
f 14 15 19 18
f 15 16 20 19
f 16 13 17 20
f 17 18 19 20
)";
constexpr const char* kMaterials = R"(newmtl plaster
Kd 0.75 0.75 0.72
newmtl red
Kd 0.6 0.15 0.1
newmtl blue
Kd 0.1 0.2 0.6
newmtl wood
Kd 0.5 0.35 0.2
newmtl lamp
Kd 0 0 0
Ke 12 11 9
)";
constexpr int kWidth = 1100, kHeight = 720;

/// Whether the dot before the solve's state, in the line below the scene, is as green as of one that has
/// converged.
bool showsConverged(const ImageF& window) {
  for (int y = kHeight - 24; y < kHeight; ++y) {
    for (int x = 6; x < 24; ++x) {
      const float* c = &window.rgb[3 * static_cast<std::size_t>(y * window.width + x)];
      if (c[1] > 0.5f && c[1] > 2 * c[0] && c[1] > 2 * c[2]) return true;
    }
  }
  return false;
}

int differentInPanel(const ImageF& a, const ImageF& b) {
  int out = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = kWidth - kPanel; x < kWidth; ++x) {
      const std::size_t k = 3 * static_cast<std::size_t>(y * kWidth + x) + 1;
      out += std::abs(a.rgb[k] - b.rgb[k]) > 0.1f;
    }
  }
  return out;
}

TEST(NewUser, OpensARoomOfTheirOwnWatchesItConvergeAndKeepsAPicture) {
  const Screen screen;
  const TempFolder folder;
  folder.write("my room.mtl", kMaterials);
  const std::string room = folder.write("my room.obj", kRoom);
  WindowRun run({"--size", std::to_string(kWidth) + "x" + std::to_string(kHeight)});
  ASSERT_TRUE(run.hasTitle("cornell_box \u2013 Unshot"));
  run.key("ctrl+o");
  xdotool("type --delay 5 '" + room + "'");
  run.key("Return");
  ASSERT_TRUE(run.hasTitle("my room \u2013 Unshot")) << run.title();
  std::string shot;
  ASSERT_TRUE(eventually([&] {
    shot = run.screenshot("F12");
    return showsConverged(readImage(run.folder() / shot));
  }));
  // What is there: figures in the panel.
  const ImageF before = readImage(run.folder() / shot);
  xdotool("mousemove --sync 400 600");
  xdotool("click 1");
  ASSERT_TRUE(eventually([&] {
    return differentInPanel(readImage(run.folder() / run.screenshot("F12")), before) > 3000;
  })) << "no figures of what was clicked";
  const std::string picture = run.screenshot();
  EXPECT_TRUE(picture.find("my room") != std::string::npos) << picture;
  const ImageF scene = readImage(run.folder() / picture);
  EXPECT_EQ(scene.width, kWidth - kPanel);
  double most = 0;
  for (const float value : scene.rgb) most = std::max(most, static_cast<double>(value));
  EXPECT_GT(most, 0.5) << "dark";
  run.endsOn("ctrl+q");
}

}  // namespace
}  // namespace unshot
