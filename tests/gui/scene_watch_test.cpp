// Files of a scene that change while it is shown.
#include "viewer/scene_watch.h"

#include <gmock/gmock.h>

#include <cmath>

#include "base/clock.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"

namespace unshot {
namespace {

using testing::ElementsAre;
using testing_support::LiveViewer;
using testing_support::TempFolder;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(SceneFiles, AreTheObjAndAllThatItsMtllibsMayName) {
  const TempFolder folder;
  const std::filesystem::path& f = folder.path();
  folder.write("a.obj",
               "# mtllib no.mtl\nmtllib a.mtl\n  mtllib\tb c.mtl\nmtllibs no.mtl\nmtllib\n" + kTriangle);
  EXPECT_THAT(sceneFiles(f / "a.obj"),
              ElementsAre(f / "a.obj", f / "a.mtl", f / "b c.mtl", f / "b", f / "c.mtl"));
  EXPECT_THAT(sceneFiles(f / "gone.obj"), ElementsAre(f / "gone.obj"));
}

class Watch : public testing::Test {
 protected:
  Watch() {
    obj_ = folder_.write("scene.obj", "mtllib scene.mtl\n" + kTriangle);
    watch_.opening(obj_);
    watch_.opened();
    // The files are read by a thread of their own.
    while (!watch_.stands()) look();
  }
  /// Looks when it is time to, and returns whether there is something new.
  bool look() {
    now_ = std::max(now_ + 0.01, watch_.nextLook());
    return watch_.look(now_);
  }
  /// What happens within the next few looks.
  bool notices() {
    for (int k = 0; k < 4; ++k) look();
    return watch_.changed();
  }

  TempFolder folder_;
  std::string obj_;
  SceneWatch watch_;
  double now_ = 0;
};

TEST_F(Watch, IsCheapAndSeesNothingWhereNothingHappens) {
  for (int k = 0; k < 10; ++k) EXPECT_FALSE(look());
  EXPECT_FALSE(watch_.changed());
  EXPECT_GE(watch_.nextLook() - now_, 1) << "looks more often than once a second";
  EXPECT_FALSE(watch_.look(now_ + 0.5)) << "looks before it is time";
}

TEST_F(Watch, WaitsUntilAFileStandsStill) {
  for (int k = 0; k < 5; ++k) {
    folder_.write("scene.obj", std::string(static_cast<std::size_t>(100 + k), '#') + "\n" + kTriangle);
    look();
    EXPECT_FALSE(watch_.changed()) << "while it is written";
    EXPECT_LT(watch_.nextLook() - now_, 1);
  }
  EXPECT_TRUE(look());
  EXPECT_TRUE(watch_.changed());
  EXPECT_FALSE(look()) << "said twice";
  EXPECT_TRUE(watch_.changed());
}

TEST_F(Watch, SeesMaterialsThatComeChangeAndGo) {
  folder_.write("scene.mtl", "newmtl a\n");
  EXPECT_TRUE(notices());
  watch_.accept();
  EXPECT_FALSE(notices());
  folder_.write("scene.mtl", "newmtl a\nKd 1 0 0\n");
  EXPECT_TRUE(notices());
  watch_.accept();
  std::filesystem::remove(folder_ / "scene.mtl");
  EXPECT_TRUE(notices());
}

TEST_F(Watch, DoesNotOfferWhatIsGoneOrEmpty) {
  folder_.write("scene.obj", "");
  EXPECT_FALSE(notices());
  std::filesystem::remove(obj_);
  EXPECT_FALSE(notices());
  folder_.write("scene.obj", kTriangle);
  EXPECT_TRUE(notices());
}

TEST_F(Watch, GoesOnWithTheNextSceneOnlyWhenThatIsOpened) {
  const std::string other = folder_.write("other.obj", kTriangle);
  watch_.opening(other);
  EXPECT_EQ(watch_.scene(), obj_);
  folder_.write("scene.obj", "# longer\n" + kTriangle);
  EXPECT_TRUE(notices());
  watch_.opened();
  EXPECT_EQ(watch_.scene(), other);
  EXPECT_FALSE(watch_.changed());
  watch_.stop();
  EXPECT_TRUE(std::isinf(watch_.nextLook()));
}

// Files of a gigabyte are scanned for their materials.
TEST(SceneWatchOfALargeFile, DoesNotHoldUpTheNextOne) {
  const TempFolder folder;
  const std::string large = folder.write("large.obj", std::string(std::size_t{1} << 26, '\n'));
  const std::string small = folder.write("small.obj", kTriangle);
  SceneWatch watch;
  watch.opening(large);
  const double began = wallSeconds();
  watch.opening(small);
  watch.opened();
  EXPECT_LT(wallSeconds() - began, 0.2);
  EXPECT_EQ(watch.scene(), small);
}

class WatchingViewer : public testing::Test {
 protected:
  WatchingViewer() {
    for (const char* ending : {".obj", ".mtl"})
      std::filesystem::copy_file(
          std::filesystem::path(UNSHOT_SOURCE_DIR) / "assets" / (std::string("two_patches") + ending),
          folder_.path() / (std::string("two_patches") + ending));
    LiveViewer::Options options;
    options.scene = folder_.path() / "two_patches.obj";
    live_ = std::make_unique<LiveViewer>(options);
    EXPECT_TRUE(live_->untilPhase(SessionPhase::kConverged));
    EXPECT_TRUE(live_->until([&] { return viewer().nextFrame(0) > 1e30; }));
  }
  Viewer& viewer() { return **live_; }
  std::size_t triangles() { return viewer().state().facts->triangles; }
  void append(const std::string& text) {
    folder_.write("two_patches.obj", folder_.read("two_patches.obj") + text);
  }

  TempFolder folder_;
  std::unique_ptr<LiveViewer> live_;
};

TEST_F(WatchingViewer, OffersToReloadAndKeepsTheCamera) {
  viewer().perform("watch", "on");
  viewer().navigator().orbit({40, 10}, 240);
  const Camera camera = *viewer().cameraInFile();
  const std::size_t before = triangles();
  append("v 9 9 9\nv 9 9 8\nv 9 8 9\nf -1 -2 -3\n");
  ASSERT_TRUE(live_->until([&] { return viewer().sceneChanged(); }, 20));
  EXPECT_EQ(triangles(), before) << "loaded without being asked to";
  viewer().perform("reload");
  ASSERT_TRUE(live_->until([&] { return triangles() == before + 1; }));
  EXPECT_FALSE(viewer().sceneChanged());
  ASSERT_TRUE(live_->until([&] { return viewer().nextFrame(0) > 1e30; }));
  EXPECT_LT(glm::distance(viewer().cameraInFile()->eye, camera.eye), 1e-9);
  EXPECT_EQ(viewer().navigator().speedFactor(), 1);
}

TEST_F(WatchingViewer, AFileThatCannotBeReadIsSaidAndOfferedAgainOnceItIsMended) {
  viewer().perform("watch", "on");
  const std::string whole = folder_.read("two_patches.obj");
  append("f 1 2 1000000\n");
  ASSERT_TRUE(live_->until([&] { return viewer().sceneChanged(); }, 20));
  EXPECT_FALSE(viewer().error()) << "nobody asked";
  viewer().perform("reload");
  ASSERT_TRUE(live_->until([&] { return viewer().error().has_value(); }));
  EXPECT_EQ(viewer().state().facts->scene_name, "two_patches") << "what was shown is gone";
  viewer().perform("dismiss");
  folder_.write("two_patches.obj", whole + "# mended\n");
  ASSERT_TRUE(live_->until([&] { return viewer().sceneChanged(); }, 20));
  viewer().perform("reload");
  const std::uint64_t epoch = viewer().state().epoch;
  ASSERT_TRUE(live_->until([&] { return viewer().state().epoch > epoch; }));
  EXPECT_FALSE(viewer().error());
}

TEST_F(WatchingViewer, WhatIsKeptIsNotOfferedAgain) {
  viewer().perform("watch", "on");
  append("# more\n");
  ASSERT_TRUE(live_->until([&] { return viewer().sceneChanged(); }, 20));
  viewer().perform("dismiss");
  EXPECT_FALSE(viewer().sceneChanged());
  viewer().perform("watch", "off");
  append("# and more\n");
  const double end = wallSeconds() + 2.5;
  live_->until([&] { return wallSeconds() > end; });
  EXPECT_FALSE(viewer().sceneChanged());
}

}  // namespace
}  // namespace unshot
