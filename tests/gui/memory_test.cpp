// What the viewer remembers from one run to the next.
#include "viewer/memory.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "support/live_viewer.h"
#include "support/temp_folder.h"

namespace unshot {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing_support::LiveViewer;
using testing_support::TempFolder;

const std::filesystem::path kAssets = UNSHOT_SOURCE_DIR "/assets";

TEST(RememberedLines, KeepTheNewestInFrontAndNoMoreThanAllowed) {
  const TempFolder folder;
  const RememberedLines lines(folder / "deep/lines", 3);
  EXPECT_THAT(lines.read(), IsEmpty());
  lines.put("a", "1");
  lines.put("b with\ta tab", "2");
  lines.put("c", "");
  lines.put("a", "4");
  EXPECT_THAT(lines.read(), ElementsAre(Pair("a", "4"), Pair("c", ""), Pair("b with\ta tab", "2")));
  lines.put("d", "5");
  EXPECT_THAT(lines.read(), ElementsAre(Pair("d", "5"), Pair("a", "4"), Pair("c", "")));
  lines.put("a", std::nullopt);
  EXPECT_THAT(lines.read(), ElementsAre(Pair("d", "5"), Pair("c", "")));
  lines.put("new\nline", "6");
  lines.put("e", "a\tb");
  EXPECT_EQ(lines.read().size(), 2u) << "a key or value that no line holds";
}

TEST(RememberedLines, PassOverWhatIsNoLine) {
  const TempFolder folder;
  folder.write("lines", "nonsense\n\n1\ta\n\t\n\xff\xfe");
  const RememberedLines lines(folder / "lines", 10);
  EXPECT_EQ(lines.find("a"), "1");
  EXPECT_EQ(lines.find("b"), std::nullopt);
}

TEST(Memory, KeepsCamerasToTheLastDigitForAHundredScenes) {
  const TempFolder folder;
  const Camera camera{{1.0 / 3, -2e-17, 3e20}, {4, 5, 6}, {0, 0, 1}, 39.3077, true};
  for (int k = 0; k < 101; ++k) Memory(folder.path()).keepCamera("/scene" + std::to_string(k), camera);
  const Memory memory(folder.path());
  EXPECT_EQ(memory.camera("/scene100"), camera);
  EXPECT_EQ(memory.camera("/elsewhere/.././scene1"), camera);
  EXPECT_EQ(memory.camera("/scene0"), std::nullopt);
}

TEST(Memory, PassesOverCamerasThatSeeNothing) {
  const TempFolder folder;
  for (const std::string text :
       {"", "1,2,3", "0,0,0,0,0,0,0,1,0,40,0", "0,0,0,0,0,1,0,0,0,40,0", "0,0,0,0,0,1,0,1,0,0,0",
        "0,0,nan,0,0,1,0,1,0,40,0", "a,0,0,0,0,1,0,1,0,40,0"}) {
    folder.write("cameras", text + "\t/scene\n");
    EXPECT_FALSE(Memory(folder.path()).camera("/scene")) << text;
  }
}

TEST(Memory, OffersTheScenesThatAreStillThere) {
  const TempFolder folder;
  const std::string there = folder.write("there.obj", "v 0 0 0\n"), gone = folder / "gone.obj";
  Memory memory(folder / "memory");
  memory.noteScene(there);
  memory.noteScene(gone);
  memory.noteScene(folder.path());
  EXPECT_THAT(memory.scenes(), ElementsAre(there));
}

TEST(Memory, SaysOnceThatItCannotKeepAnything) {
  const TempFolder folder;
  folder.write("file", "");
  Memory memory(folder.path() / "file" / "memory");
  testing::internal::CaptureStderr();
  memory.keepSetting("a", "1");
  memory.keepSetting("b", "2");
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, testing::HasSubstr("not remembered"));
  EXPECT_EQ(said.find("not remembered"), said.rfind("not remembered"));
  EXPECT_FALSE(memory.on());
  EXPECT_THAT(memory.takeComplaint(), testing::HasSubstr("not remembered"));
  EXPECT_EQ(memory.takeComplaint(), "");
}

TEST(Memory, WithoutAFolderRemembersNothing) {
  Memory memory("");
  memory.keepSetting("a", "1");
  memory.noteScene(kAssets / "cornell_box.obj");
  EXPECT_EQ(memory.setting("a"), std::nullopt);
  EXPECT_THAT(memory.scenes(), IsEmpty());
}

TEST(Memory, ItsUsualFolderIsThatOfTheDesktop) {
  const auto with = [](const char* state, const char* home) {
    ::setenv("XDG_STATE_HOME", state, 1);
    ::setenv("HOME", home, 1);
    return Memory::usualFolder();
  };
  const char* before = std::getenv("HOME");
  const std::string home = before ? before : "/";
  EXPECT_EQ(with("/state", "/home/me"), "/state/unshot");
  EXPECT_EQ(with("relative", "/home/me"), "/home/me/.local/state/unshot");
  EXPECT_EQ(with("", ""), "");
  ::unsetenv("XDG_STATE_HOME");
  ::setenv("HOME", home.c_str(), 1);
}

class RememberingViewer : public testing::Test {
 protected:
  LiveViewer::Options options(const std::string& scene = "cornell_box") const {
    LiveViewer::Options options;
    options.scene = kAssets / (scene + ".obj");
    options.solve.elements = 200;
    options.solve.error = 0.1;
    options.memory = folder_.path();
    return options;
  }
  static void untilFramed(LiveViewer& live) {
    const Camera unframed;
    ASSERT_TRUE(live.until([&] { return live->camera() != unframed && live->nextFrame(0) > 1e30; }));
  }
  TempFolder folder_;
};

TEST_F(RememberingViewer, FindsTheSceneAsItWasLeft) {
  Camera left;
  {
    LiveViewer live(options());
    untilFramed(live);
    live->navigator().orbit({50, 20}, 240);
    live->perform("projection", "orthographic");
    live->perform("open", (kAssets / "two_patches.obj").string());
    ASSERT_TRUE(live.until([&] { return live->state().facts->scene_name == "two_patches"; }));
    left = *Memory(folder_.path()).camera(kAssets / "cornell_box.obj");
    EXPECT_TRUE(left.orthographic);
    live->finish();
  }
  LiveViewer live(options());
  untilFramed(live);
  EXPECT_LT(glm::distance(live->cameraInFile()->eye, left.eye), 1e-9);
  EXPECT_TRUE(live->camera().orthographic);
  EXPECT_THAT(live->memory().scenes(), ElementsAre(kAssets / "cornell_box.obj", kAssets / "two_patches.obj"));
  // The automatic camera is no news.
  live->perform("projection", "perspective");
  live->perform("frame");
  untilFramed(live);
  live->finish();
  EXPECT_FALSE(Memory(folder_.path()).camera(kAssets / "cornell_box.obj"));
}

TEST_F(RememberingViewer, KeepsTheCameraWhileItIsOpen) {
  const auto kept = [&] { return Memory(folder_.path()).camera(kAssets / "cornell_box.obj"); };
  LiveViewer live(options());
  untilFramed(live);
  EXPECT_FALSE(kept());
  live->perform("camera", "278,273,-900,278,273,0");
  ASSERT_TRUE(live.until([&] { return kept().has_value(); }));
  EXPECT_LT(glm::distance(kept()->eye, {278, 273, -900}), 1e-9);
}

TEST_F(RememberingViewer, FindsThePanelAsItWasLeft) {
  const auto sectionsOpen = [](LiveViewer& live) {
    std::map<ImGuiID, int> open;
    ImGuiStorage storage;
    live->followSections(storage);
    for (const auto& pair : storage.Data) open[pair.key] = pair.val_i;
    return open;
  };
  {
    LiveViewer live(options());
    live->setScreenScale(2);
    live->perform("scale", "2.5");
    live->perform("materials", "on");
    ImGuiStorage storage;
    live->followSections(storage);
    storage.SetInt(12345, 0);
    storage.SetInt(4000000000u, 1);
    live->followSections(storage);
    live->finish();
  }
  LiveViewer live(options());
  EXPECT_DOUBLE_EQ(live->scale(), 1.25) << "of a screen with half of the pixels";
  EXPECT_TRUE(live->ui().materials);
  const std::map<ImGuiID, int> open = sectionsOpen(live);
  EXPECT_EQ(open.at(12345), 0);
  EXPECT_EQ(open.at(4000000000u), 1);
}

// What a crash would not cost.
TEST_F(RememberingViewer, KeepsThePanelWhileItIsOpen) {
  const Memory memory(folder_.path());
  std::string sections;
  {
    LiveViewer::Options wide = options();
    wide.width = 1000;
    wide.height = 700;
    LiveViewer live(wide);
    untilFramed(live);
    live->perform("scale", "1.1");
    live->perform("section", "solve off");
    ASSERT_TRUE(live.until([&] { return memory.setting("scale") == "1.1"; }, 20));
    sections = memory.setting("sections").value_or("");
    EXPECT_THAT(sections, testing::HasSubstr("-"));
    live->perform("section", "solve on");
    ASSERT_TRUE(live.until([&] { return memory.setting("sections") != sections; }, 20));
    sections = *memory.setting("sections");
  }
  LiveViewer narrow(options());
  untilFramed(narrow);
  narrow->finish();
  EXPECT_EQ(memory.setting("sections"), sections) << "a window without room for the panel forgets them";
}

}  // namespace
}  // namespace unshot
