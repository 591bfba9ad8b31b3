// Files dropped on the real window.
#include <gmock/gmock.h>

#include "export/image_files.h"
#include "gui/support/drag_source.h"
#include "gui/support/panel.h"

namespace unshot {
namespace {

using namespace testing_support;
using testing::HasSubstr;

class Drop : public testing::Test {
 protected:
  Drop() { EXPECT_TRUE(run_.hasTitle("cornell_box \u2013 Unshot")); }

  void drop(const std::filesystem::path& file) {
    EXPECT_TRUE(source_.drop(run_.window(), fileUri(file) + "\r\n")) << file;
  }
  /// What the window shows over the upper half of the scene: there messages stand.
  std::vector<float> upperHalf() {
    run_.sceneAtRest();
    const ImageF image = readImage(run_.folder().path() / run_.screenshot("F12"));
    const auto width = static_cast<std::ptrdiff_t>(image.width), scene = width - kPanel;
    std::vector<float> out;
    for (std::ptrdiff_t y = 0; y < image.height / 2; ++y) {
      const auto row = image.rgb.begin() + 3 * y * width;
      out.insert(out.end(), row, row + 3 * scene);
    }
    return out;
  }
  /// A bundled scene under another name.
  std::string copyOf(const std::string& scene, const std::string& name) const {
    const std::filesystem::path assets = std::filesystem::path(UNSHOT_SOURCE_DIR) / "assets";
    const std::filesystem::path target = files_.path() / name;
    std::filesystem::create_directories(target.parent_path());
    std::filesystem::copy_file(assets / (scene + ".obj"), target);
    std::filesystem::copy_file(assets / (scene + ".mtl"), target.parent_path() / (scene + ".mtl"));
    return target.string();
  }
  void end() {
    run_.key("ctrl+q");
    result_ = run_.end();
    EXPECT_EQ(result_.code, 0) << result_.err;
  }

  const Screen screen_;
  const TempFolder files_;
  WindowRun run_{{"--size", "960x480", "--elements", "20000", "--error", "1e-9", "--keep", "0"}};
  DragSource source_;
  ProgramResult result_;
};

TEST_F(Drop, OfASceneOpensIt) {
  const std::string before = run_.scene();
  drop(copyOf("two_rooms", "two_rooms.obj"));
  EXPECT_TRUE(run_.hasTitle("two_rooms \u2013 Unshot")) << run_.title();
  EXPECT_TRUE(run_.sceneChanges(before));
  drop(copyOf("furnace", "Möbel & Küche/Ofen 100% (neu).obj"));
  EXPECT_TRUE(run_.hasTitle("Ofen 100% (neu) \u2013 Unshot")) << run_.title();
  end();
  EXPECT_EQ(result_.err, "");
}

TEST_F(Drop, OfWhatIsNoSceneIsSaidAndChangesNothing) {
  const std::string first = run_.scene();
  EXPECT_TRUE(run_.sceneChanges(first));
  run_.key("space");
  const std::string scene = run_.sceneAtRest();
  const std::vector<std::pair<std::string, std::string>> refused{
      {files_.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2 3\n"), "'zero' is not a number"},
      {files_.write("notes.txt", "nothing but words\n"), "no line of this file is an OBJ statement"},
      {files_.write("picture.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)),
       "not a picture that can be read"},
      {files_.write("light.ply", "nothing but words\n"), "a PLY file written by unshot solve"},
      {files_.write("walls.mtl", "newmtl wall\n"), "this is no scene but materials of a scene"},
      {files_.write("walk.script", "frame\n"), "this is no scene but a script"},
      {files_ / "gone.obj", "there is no such file"},
      {files_.path().string(), "this is a folder"}};
  const std::vector<float> calm = upperHalf();
  for (const auto& [file, said] : refused) {
    SCOPED_TRACE(said);
    drop(file);
    EXPECT_TRUE(eventually([&, what = said] { return run_.errors().find(what) != std::string::npos; }))
        << run_.errors();
    EXPECT_TRUE(upperHalf() != calm) << "no message in the window";
    EXPECT_TRUE(run_.scene() == scene) << "another picture of the scene";
    EXPECT_EQ(run_.title(), "cornell_box \u2013 Unshot");
    run_.key("Escape");
    EXPECT_TRUE(upperHalf() == calm) << "the message stays";
  }
  end();
}

}  // namespace
}  // namespace unshot
