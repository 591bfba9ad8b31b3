// A picture laid over that of the scene: the wipe, the difference and its figure.
#include "viewer/reference_picture.h"

#include <gtest/gtest.h>

#include "export/image_files.h"
#include "report/difference.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"

namespace unshot {
namespace {

using testing_support::LiveViewer;
using testing_support::TempFolder;

/// The box, solved, with two pictures of it at hand: with all light and with direct light alone.
class ReferencePictures : public testing::Test {
 protected:
  static constexpr int kWidth = 400, kHeight = 300;

  void SetUp() override {
    ASSERT_TRUE(viewer_.untilPhase(SessionPhase::kConverged));
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
