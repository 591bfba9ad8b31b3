// The picture of the scene in the viewer, drawn at once or over several frames.
#include "viewer/scene_display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/clock.h"
#include "gl/context.h"
#include "mesh/build.h"
#include "render/display_modes.h"
#include "scene/obj_reader.h"

namespace unshot {
namespace {

constexpr int kWidth = 200, kHeight = 180;

class SceneDisplays : public testing::Test {
 protected:
  SceneDisplays() : context_(gl::createContext("osmesa")) {
    context_->makeCurrent();
    const Scene scene = readObj(UNSHOT_SOURCE_DIR "/assets/cornell_box.obj");
    snapshot_ = state(std::make_shared<Mesh>(buildMesh(scene, {20'000, {}, false})), 1);
    wanted_ = {{{278, 273, -800}, {278, 273, 0}, {0, 1, 0}, 39}, {}, kWidth, kHeight, 1};
    wanted_.camera.eye -= snapshot_->mesh->frame_origin;
    wanted_.camera.at -= snapshot_->mesh->frame_origin;
    wanted_.settings.view.display = "radiosity";
  }

  static std::shared_ptr<const Snapshot> state(std::shared_ptr<const Mesh> mesh, float light) {
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->mesh = std::move(mesh);
    const std::size_t vertices = snapshot->mesh->vertices.size();
    for (std::size_t v = 0; v < vertices; ++v) {
      const float value = light * static_cast<float>(v % 97) / 97;
      snapshot->irradiance.emplace_back(value);
      snapshot->unshot.emplace_back(0.3f - value);
      snapshot->ambient.emplace_back(0.1f);
    }
    for (std::uint32_t e = 0; e < snapshot->mesh->element_count; ++e)
      snapshot->element_irradiance.emplace_back(light * static_cast<float>(e % 89) / 89);
    return snapshot;
  }

  std::vector<std::uint8_t> pixels(const SceneDisplay& display) {
    const gl::Functions& fn = context_->functions();
    const gl::Texture texture(*context_);
    const gl::Framebuffer framebuffer(*context_);
    fn.BindTexture(GL_TEXTURE_2D, texture.id());
    fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kWidth, kHeight, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
    fn.Clear(GL_COLOR_BUFFER_BIT);
    display.copyTo(0, kWidth);
    std::vector<std::uint8_t> out(4 * std::size_t{kWidth} * kHeight);
    fn.ReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    gl::checkErrors(fn, "a picture in slices");
    return out;
  }
  /// As little in each call as there can be; returns how many calls it took.
  int drawSlowly(SceneDisplay& display) {
    int calls = 0;
    do {
      EXPECT_TRUE(display.draw(wanted_, -1, wallSeconds()));
      ++calls;
    } while (display.drawing() && calls < 1000);
    return calls;
  }

  /// They are found beside the window, and no picture is drawn before; they may be there at once, where the
  /// other thread comes first.
  void findMarks(SceneDisplay& display) {
    const std::uint64_t version = display.version();
    display.draw(wanted_, -1, wallSeconds());
    while (display.waits(wanted_)) display.draw(wanted_, -1, wallSeconds());
    EXPECT_EQ(display.version(), version);
  }

  std::unique_ptr<gl::Context> context_;
  std::shared_ptr<const Snapshot> snapshot_;
  SceneDisplay::Wanted wanted_;
};

TEST_F(SceneDisplays, InSlicesThePictureIsTheSame) {
  for (const DisplayMode& mode : displayModes()) {
    SCOPED_TRACE(mode.info.key);
    wanted_.settings.view.display = mode.info.key;
    SceneDisplay at_once(*context_), slowly(*context_);
    at_once.setSnapshot(snapshot_);
    slowly.setSnapshot(snapshot_);
    if (mode.edges || mode.quantity == Quantity::kPatches) {
      for (SceneDisplay* display : {&at_once, &slowly}) findMarks(*display);
    }
    EXPECT_TRUE(at_once.draw(wanted_, -1, SceneDisplay::kAtOnce));
    EXPECT_FALSE(at_once.drawing());
    EXPECT_GE(drawSlowly(slowly), 3);
    EXPECT_EQ(pixels(slowly), pixels(at_once));
    EXPECT_EQ(slowly.exposure(), at_once.exposure());
    EXPECT_FALSE(slowly.draw(wanted_, -1, wallSeconds())) << "drawn again for nothing";
  }
}

TEST_F(SceneDisplays, ThePictureBeforeAndItsCameraStayUntilTheNextIsWhole) {
  SceneDisplay display(*context_);
  display.setSnapshot(snapshot_);
  drawSlowly(display);
  const std::vector<std::uint8_t> before = pixels(display);
  const glm::dvec3 eye = wanted_.camera.eye;
  wanted_.camera.eye.x += 50;
  while (display.draw(wanted_, -1, wallSeconds()) && display.drawing()) {
    EXPECT_EQ(pixels(display), before);
    EXPECT_EQ(display.shownCamera().eye, eye);
  }
  EXPECT_NE(pixels(display), before);
  EXPECT_EQ(display.shownCamera().eye, wanted_.camera.eye);
}

TEST_F(SceneDisplays, CoarsePicturesOfLargeMeshesHaveCellsMerged) {
  const Scene scene = readObj(UNSHOT_SOURCE_DIR "/assets/cornell_box.obj");
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->mesh = std::make_shared<Mesh>(buildMesh(scene, {40'000, {}, false}));
  for (const Vertex& vertex : snapshot->mesh->vertices)
    snapshot->irradiance.emplace_back(1 +
                                      std::sin(vertex.position.x / 100) * std::sin(vertex.position.y / 90));
  wanted_.divisor = 2;
  wanted_.settings.view.automatic_exposure = 0.5;
  SceneDisplay display(*context_);
  display.setSnapshot(snapshot);
  drawSlowly(display);
  const std::vector<std::uint8_t> all = pixels(display);
  const double began = wallSeconds();
  // They are merged beside the window.
  std::vector<std::uint8_t> merged = all;
  while (merged == all && wallSeconds() < began + 60) {
    wanted_.camera.eye.x += 1e-9;
    drawSlowly(display);
    merged = pixels(display);
  }
  EXPECT_NE(merged, all);
  std::size_t far = 0;
  for (std::size_t k = 0; k < all.size(); ++k) far += std::abs(all[k] - merged[k]) > 4;
  EXPECT_LT(far, all.size() / 200) << "only along lines";
  // At rest elements are as fine as they are.
  wanted_.divisor = 1;
  SceneDisplay other(*context_);
  other.setSnapshot(snapshot);
  for (SceneDisplay* each : {&display, &other}) each->draw(wanted_, -1, SceneDisplay::kAtOnce);
  EXPECT_EQ(pixels(display), pixels(other));
}

TEST_F(SceneDisplays, CoarsePicturesShowTheSameAndAreNoMoreThanAsked) {
  SceneDisplay fine(*context_), coarse(*context_);
  // So few elements that none are merged.
  const Scene scene = readObj(UNSHOT_SOURCE_DIR "/assets/cornell_box.obj");
  const auto few_elements = state(std::make_shared<Mesh>(buildMesh(scene, {10'000, {}, false})), 1);
  for (SceneDisplay* display : {&fine, &coarse}) display->setSnapshot(few_elements);
  fine.draw(wanted_, -1, SceneDisplay::kAtOnce);
  const std::vector<std::uint8_t> all = pixels(fine);
  for (const int divisor : {2, 3}) {  // the height and the width are no multiples of 3
    SCOPED_TRACE(divisor);
    wanted_.divisor = divisor;
    drawSlowly(coarse);
    EXPECT_TRUE(coarse.coarse());
    EXPECT_TRUE(coarse.sharp()) << "at rest another one takes its place";
    const std::vector<std::uint8_t> few = pixels(coarse);
    std::size_t difference = 0, far = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const int d = std::abs(all[k] - few[k]);
      difference += static_cast<std::size_t>(d);
      far += d > 40;
    }
    EXPECT_GT(difference, 0u);
    EXPECT_LT(far, all.size() / 12) << "moved or out of place";
    wanted_.divisor = 1;
    EXPECT_TRUE(coarse.outdated(wanted_));
    coarse.draw(wanted_, -1, SceneDisplay::kAtOnce);
    EXPECT_FALSE(coarse.coarse());
    EXPECT_LE(std::abs(std::log2(coarse.exposure() / fine.exposure())), 0.02);
    wanted_.divisor = 2;
    EXPECT_FALSE(coarse.outdated(wanted_)) << "a fine picture does";
    wanted_.camera.eye.x += 1e-9;
  }
}

TEST_F(SceneDisplays, AFinePictureInTheMakingGivesWayToACameraThatMoves) {
  SceneDisplay display(*context_);
  display.setSnapshot(snapshot_);
  drawSlowly(display);
  wanted_.camera.eye.x += 50;
  display.draw(wanted_, -1, wallSeconds());
  ASSERT_TRUE(display.drawing());
  wanted_.camera.eye.x += 50;
  wanted_.divisor = 2;
  while (display.drawing()) display.draw(wanted_, -1, wallSeconds());
  EXPECT_EQ(display.shownCamera().eye, wanted_.camera.eye) << "the one before was drawn to its end";
}

// The display before follows the camera until they are found.
TEST_F(SceneDisplays, MarksThatAreBeingFoundDoNotHoldTheCameraUp) {
  const Scene scene = readObj(UNSHOT_SOURCE_DIR "/assets/cornell_box.obj");
  snapshot_ = state(std::make_shared<Mesh>(buildMesh(scene, {300'000, {}, false})), 1);
  SceneDisplay display(*context_);
  display.setSnapshot(snapshot_);
  display.draw(wanted_, -1, SceneDisplay::kAtOnce);
  for (const char* mode : {"mesh", "patches"}) {
    SCOPED_TRACE(mode);
    const std::string before = display.shownDisplay();
    wanted_.settings.view.display = mode;
    EXPECT_FALSE(display.draw(wanted_, -1, SceneDisplay::kAtOnce)) << "nothing moved";
    wanted_.camera.eye.x += 50;
    if (display.waits(wanted_)) {
      EXPECT_TRUE(display.outdated(wanted_));
      EXPECT_TRUE(display.draw(wanted_, -1, SceneDisplay::kAtOnce));
      EXPECT_EQ(display.shownCamera().eye, wanted_.camera.eye);
      EXPECT_EQ(display.shownDisplay(), before);
    } else {
      ADD_FAILURE() << "found too soon for this test";
    }
    while (display.waits(wanted_)) display.draw(wanted_, -1, wallSeconds());
    while (display.outdated(wanted_)) display.draw(wanted_, -1, wallSeconds());
    EXPECT_EQ(display.shownDisplay(), mode);
  }
}

TEST_F(SceneDisplays, AtOnceIsOfTheNewestStateWhateverWasBegun) {
  SceneDisplay display(*context_), fresh(*context_);
  display.setSnapshot(snapshot_);
  drawSlowly(display);
  wanted_.camera.eye.x += 50;
  display.draw(wanted_, -1, wallSeconds());
  ASSERT_TRUE(display.drawing());
  const auto newer = state(snapshot_->mesh, 3);
  wanted_.camera.eye.x += 50;
  for (SceneDisplay* d : {&display, &fresh}) {
    d->setSnapshot(newer);
    d->draw(wanted_, -1, SceneDisplay::kAtOnce);
    EXPECT_FALSE(d->drawing());
  }
  EXPECT_EQ(pixels(display), pixels(fresh));
}

TEST_F(SceneDisplays, ASnapshotHalfUploadedIsNeverShown) {
  SceneDisplay display(*context_), fresh(*context_);
  display.setSnapshot(snapshot_);
  display.draw(wanted_, -1, wallSeconds());
  ASSERT_TRUE(display.drawing());
  const auto newer = state(snapshot_->mesh, 3);
  display.setSnapshot(newer);
  drawSlowly(display);
  fresh.setSnapshot(newer);
  fresh.draw(wanted_, -1, SceneDisplay::kAtOnce);
  EXPECT_EQ(pixels(display), pixels(fresh));
  EXPECT_EQ(display.exposure(), fresh.exposure());
}

// Whatever was shown before, and though a solve that began anew came in between.
TEST_F(SceneDisplays, APartOfTheLightIsExposedForItsOwnDisplay) {
  const auto direct = [&](float light) {
    auto snapshot = std::make_shared<Snapshot>(*snapshot_);
    snapshot->direct =
        std::make_shared<const std::vector<glm::vec3>>(snapshot->irradiance.size(), glm::vec3(light));
    return snapshot;
  };
  const auto shown = [&](SceneDisplay& display, const std::shared_ptr<const Snapshot>& snapshot) {
    display.setSnapshot(snapshot);
    display.draw(wanted_, -1, SceneDisplay::kAtOnce);
    return display.exposure();
  };
  SceneDisplay fresh(*context_), used(*context_);
  wanted_.settings.view.display = "residual";
  shown(used, direct(1));
  wanted_.settings.view.display = "false-irradiance";
  wanted_.settings.view.light.indirect = false;
  shown(used, direct(1e-5f));  // nearly nothing is shot yet
  const auto later = direct(1);
  EXPECT_EQ(shown(used, later), shown(fresh, later));
}

TEST_F(SceneDisplays, AnotherExposureDrawsNothingAnew) {
  SceneDisplay display(*context_);
  display.setSnapshot(snapshot_);
  drawSlowly(display);
  EXPECT_TRUE(display.drawnAnew());
  const std::vector<std::uint8_t> before = pixels(display);
  wanted_.settings.view.exposure_ev = 1;
  EXPECT_TRUE(display.draw(wanted_, -1, SceneDisplay::kAtOnce));
  EXPECT_FALSE(display.drawnAnew());
  EXPECT_NE(pixels(display), before);
}

}  // namespace
}  // namespace unshot
