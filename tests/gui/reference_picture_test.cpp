// A picture laid over that of the scene: the wipe, the difference and its figure.
#include "viewer/reference_picture.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <cstdio>
#include <ctime>
#include <utility>

#include "export/image_files.h"
#include "report/difference.h"
#include "support/live_viewer.h"
#include "support/sanitized.h"
#include "support/temp_folder.h"
#include "viewer/mip_levels.h"

namespace unshot {
namespace {

using testing_support::LiveViewer;
using testing_support::TempFolder;

double threadSeconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The box, solved, with two pictures of it at hand: with all light and with direct light alone.
class ReferencePictures : public testing::Test {
 protected:
  static constexpr int kWidth = 400, kHeight = 300;

  void SetUp() override {
    ASSERT_TRUE(viewer_.untilPhase(SessionPhase::kConverged));
    // A later state would be drawn with other edges until it is sharpened.
    ASSERT_TRUE(viewer_.until([this] { return !viewer_->state().spareWork() && viewer_->upToDate(); }));
    viewer_->perform("panel", "off");
    viewer_->perform("lock-exposure", "on");
    viewer_->perform("ambient", "off");
    all_ = taken("all.png");
    viewer_->perform("radiosity", "off");
    direct_ = taken("direct.png");
  }

  /// The scene's picture as a file, which becomes the one that is shown.
  std::string taken(const std::string& name) {
    const std::string path = (folder_.path() / name).string();
    viewer_->perform("screenshot-scene", path);
    EXPECT_TRUE(viewer_.until([&] { return std::filesystem::exists(path); }));
    return path;
  }
  void look(int frames = 4) {
    for (int k = 0; k < frames; ++k) viewer_.draw();
  }
  double error() {
    const ReferencePicture* picture = viewer_->referencePicture();
    return picture ? picture->error().value_or(-1) : -2;
  }
  static glm::dvec3 at(const ImageF& image, int x, int y) {
    const std::size_t k = 3 * static_cast<std::size_t>(y * image.width + x);
    return {image.rgb[k], image.rgb[k + 1], image.rgb[k + 2]};
  }

  const TempFolder folder_;
  LiveViewer viewer_{options()};
  std::string all_, direct_;

 private:
  static LiveViewer::Options options() {
    LiveViewer::Options options;
    options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
    options.solve.elements = 500;
    options.width = kWidth;
    options.height = kHeight;
    return options;
  }
};

TEST_F(ReferencePictures, OneOfTheSameIsNoDifferent) {
  viewer_.performAndWait("reference-picture", direct_);
  look();
  EXPECT_GE(error(), 0);
  EXPECT_LT(error(), 0.004) << "one step of 8 bits";
}

// The same figure as `unshot compare` has for the two files.
TEST_F(ReferencePictures, TheFigureIsThatOfTheFiles) {
  const ImageF ours = readImage(direct_), theirs = readImage(all_);
  std::vector<glm::dvec3> a, b;
  for (int y = 0; y < ours.height; ++y) {
    for (int x = 0; x < ours.width; ++x) {
      a.push_back(at(ours, x, y));
      b.push_back(at(theirs, x, y));
    }
  }
  const double wanted = differenceOf(a, b).nrmse;
  EXPECT_GT(wanted, 0.2);
  viewer_.performAndWait("reference-picture", all_);
  look();
  EXPECT_NEAR(error(), wanted, 0.01 * wanted);
}

TEST_F(ReferencePictures, TheLinePartsTheTwo) {
  viewer_.performAndWait("reference-picture", all_);
  viewer_->perform("wipe", "0.25");
  const ImageF both = readImage(taken("both.png")), ours = readImage(direct_), theirs = readImage(all_);
  int apart = 0;
  for (int x = 0; x < kWidth; ++x) {
    for (int y = 0; y < kHeight; ++y) {
      const ImageF& wanted = x < kWidth / 4 ? ours : theirs;
      ASSERT_LT(glm::length(at(both, x, y) - at(wanted, x, y)), 0.02) << x << " " << y;
      apart += glm::length(at(ours, x, y) - at(theirs, x, y)) > 0.1;
    }
  }
  EXPECT_GT(apart, 1000) << "the two pictures are too alike to tell";
  viewer_->perform("picture-difference", "on");
  const ImageF difference = readImage(taken("difference.png"));
  EXPECT_GT(glm::length(at(difference, 200, 100) - at(both, 200, 100)), 0.02);
}

TEST_F(ReferencePictures, TheLineCanBeDragged) {
  viewer_.performAndWait("reference-picture", all_);
  look();
  ImGuiIO& io = ImGui::GetIO();
  const auto move = [&](float x, bool down) {
    io.MousePos = {x, 150};
    io.MouseDown[0] = down;
    viewer_->input();
    look(2);
  };
  const glm::dvec3 eye = viewer_->camera().eye;
  move(200, false);
  move(200, true);
  move(150, true);
  move(100, true);
  move(100, false);
  EXPECT_NEAR(viewer_->ui().wipe, 0.25, 0.01);
  EXPECT_EQ(viewer_->camera().eye, eye) << "the camera went with it";
}

TEST_F(ReferencePictures, WhatIsNoPictureIsRefused) {
  folder_.write("text.png", "no picture");
  viewer_.performAndWait("reference-picture", (folder_.path() / "text.png").string());
  EXPECT_TRUE(viewer_->error());
  EXPECT_FALSE(viewer_->referencePicture());
  viewer_->perform("dismiss");
  viewer_.performAndWait("reference-picture", all_);
  EXPECT_TRUE(viewer_->referencePicture());
  viewer_->perform("display", "false-radiosity");
  EXPECT_FALSE(viewer_->referencePicture()) << "no false colours can be compared";
  viewer_->perform("display", "radiosity");
  viewer_->perform("forget-picture");
  EXPECT_FALSE(viewer_->referencePicture());
}

/// Whether the driver is to answer that a texture of light finds no room.
bool no_room = false, asked_for_room = false;
decltype(gl::Functions::TexImage2D) real_tex_image = nullptr;

TEST_F(ReferencePictures, ThatTheDriverHasNoRoomForAreSaid) {
  auto& fn = const_cast<gl::Functions&>(viewer_.fn());
  real_tex_image = fn.TexImage2D;
  fn.TexImage2D = [](GLenum target, GLint level, GLint format, GLsizei w, GLsizei h, GLint border,
                     GLenum given, GLenum type, const void* pixels) {
    asked_for_room = asked_for_room || format == GL_RGB32F;
    real_tex_image(target, level, format, w, h, border, given, type, pixels);
  };
  fn.GetError = []() -> GLenum {
    return no_room && std::exchange(asked_for_room, false) ? GL_OUT_OF_MEMORY : GL_NO_ERROR;
  };
  no_room = true;
  viewer_.performAndWait("reference-picture", all_);
  no_room = false;
  ASSERT_TRUE(viewer_->error());
  EXPECT_NE(std::string(viewer_->error()->what()).find("memory"), std::string::npos)
      << viewer_->error()->what();
  EXPECT_FALSE(viewer_->referencePicture());
  look();  // the window goes on
  viewer_->perform("dismiss");
  viewer_.performAndWait("reference-picture", all_);
  EXPECT_TRUE(viewer_->referencePicture());
}

// Its head promises a thousand million pixels.
TEST_F(ReferencePictures, ThatFindNoMemoryAreSaid) {
  if (testing_support::kSanitized) GTEST_SKIP() << "a sanitizer takes terabytes of addresses";
  std::string bytes = pngBytes({32768, 1, std::vector<std::uint8_t>(3 * 32768)});
  bytes[22] = '\x80';  // the height
  bytes[23] = '\0';
  const std::string file = folder_.write("large.png", bytes);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  const rlimit less{std::size_t{8} << 30, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &less), 0);
  viewer_.performAndWait("reference-picture", file);
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
  ASSERT_TRUE(viewer_->error());
  EXPECT_FALSE(viewer_->referencePicture());
  look();
}

TEST_F(ReferencePictures, LargeOnesComeInPiecesAndCanBeGivenUp) {
  Image8 large{3000, 2001, {}};
  for (int k = 0; k < 3 * large.width * large.height; ++k)
    large.rgb.push_back(static_cast<std::uint8_t>(k * 2654435761u >> 24));
  writePng(folder_ / "large.png", large);
  ASSERT_TRUE(viewer_.until([&] { return viewer_->tasks().empty(); }));
  for (const double share : {0.0, 0.3, 0.85}) {
    viewer_->perform("reference-picture", folder_ / "large.png");
    ASSERT_EQ(viewer_->tasks().at(0).text, "reading large.png");
    double last = 0;
    ASSERT_TRUE(viewer_.until([&] {
      const std::vector<Task> tasks = viewer_->tasks();
      if (tasks.empty() || !tasks.front().done) return false;
      EXPECT_GE(*tasks.front().done, last);
      last = *tasks.front().done;
      return last > share;
    })) << share;
    viewer_->perform("give-up");
    EXPECT_TRUE(viewer_->tasks().empty());
    EXPECT_TRUE(viewer_->scriptDone());
    EXPECT_FALSE(viewer_->referencePicture());
  }
  // The turn that makes room for it is the longest.
  viewer_->perform("reference-picture", folder_ / "large.png");
  double longest = 0;
  ASSERT_TRUE(viewer_.until([&] {
    const double began = threadSeconds();
    viewer_.pump();
    longest = std::max(longest, threadSeconds() - began);
    return viewer_->scriptDone();
  }));
  EXPECT_TRUE(viewer_->referencePicture());
  std::printf("[ MEASURED ] a picture of 6 million pixels: the longest turn took %.0f ms\n", 1e3 * longest);
}

TEST_F(ReferencePictures, AreNotComparedWhileTheCameraMoves) {
  viewer_.performAndWait("reference-picture", direct_);
  look();
  const double still = error();
  const glm::dvec3 at = viewer_->camera().at;
  for (int k = 0; k < 5; ++k) {
    // Beside the line in the middle.
    ImGui::GetIO().MousePos = {260.0f + 9.0f * static_cast<float>(k), 50};
    ImGui::GetIO().MouseDown[1] = true;
    viewer_->input();
    look(1);
    EXPECT_EQ(error(), still);
  }
  ImGui::GetIO().MouseDown[1] = false;
  viewer_->input();
  EXPECT_NE(viewer_->camera().at, at);
  EXPECT_TRUE(viewer_.until([&] { return error() != still; }, 20)) << "nor after it";
}

TEST(MipLevels, AreMeansOverAreas) {
  ImageF image{7, 5, {}};
  std::array<double, 3> mean{};
  for (int k = 0; k < 7 * 5; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      image.rgb.push_back(static_cast<float>((k * 7 + static_cast<int>(c) * 3) % 11));
      mean[c] += static_cast<double>(image.rgb.back()) / 35;
    }
  }
  const std::vector<ImageF> levels = mipLevels(image);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[0].rgb, image.rgb);
  EXPECT_EQ(std::pair(levels[1].width, levels[1].height), std::pair(3, 2));
  EXPECT_EQ(std::pair(levels[2].width, levels[2].height), std::pair(1, 1));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(levels[2].rgb[c], mean[c], 1e-5);
  EXPECT_EQ(mipLevels({1, 1, {1, 2, 3}}).size(), 1u);
}

// Costs nothing where it is closed.
TEST_F(ReferencePictures, AHistogramIsMadeOnlyWhereItIsShown) {
  look();
  EXPECT_FALSE(viewer_->histogram());
  viewer_->perform("histogram", "on");
  ASSERT_TRUE(viewer_.until([&] { return viewer_->histogram().has_value(); }, 20));
  EXPECT_FALSE(viewer_->histogram()->empty);
  // The lamp is brighter than white, most of the room darker.
  EXPECT_GT(viewer_->histogram()->placeOf(1 / viewer_->exposure()), 0);
  EXPECT_LT(viewer_->histogram()->placeOf(1 / viewer_->exposure()), 1);
  viewer_->perform("histogram", "off");
  EXPECT_TRUE(viewer_.until([&] { return !viewer_->histogram(); }, 20));
}

}  // namespace
}  // namespace unshot
