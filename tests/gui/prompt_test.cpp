// The searchable list of actions, the list of scenes, the hint: their models, and typed at as a person does.
#include <gmock/gmock.h>

#include "export/image_files.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"
#include "viewer/actions/action_search.h"
#include "viewer/file_list.h"

namespace unshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing_support::LiveViewer;
using testing_support::TempFolder;

std::vector<std::string_view> keysOf(const std::vector<FoundAction>& rows) {
  std::vector<std::string_view> keys;
  for (const FoundAction& row : rows) keys.push_back(row.action->key);
  return keys;
}

std::vector<std::string> textsOf(const std::vector<FoundAction>& rows) {
  std::vector<std::string> texts;
  for (const FoundAction& row : rows) texts.push_back(std::string(row.action->key) + " " + row.argument);
  return texts;
}

TEST(ActionSearch, ListsAllWithoutATextAndNoneThatDoesNotHaveIt) {
  EXPECT_EQ(matchingActions("").size(), actions().size());
  EXPECT_EQ(matchingActions(" ").size(), actions().size());
  EXPECT_THAT(matchingActions("zebra"), IsEmpty());
  EXPECT_THAT(keysOf(matchingActions("CLEAR-P")), ElementsAre("clear-probes"));
  for (const Action& action : actions()) {
    EXPECT_EQ(matchingActions(action.key).front().action, &action) << action.key;
    EXPECT_THAT(keysOf(matchingActions(action.help)), testing::Contains(action.key));
  }
}

TEST(ActionSearch, PutsNamesBeforeDescriptions) {
  const std::vector<std::string_view> keys = keysOf(matchingActions("camera"));
  ASSERT_GE(keys.size(), 4u);
  EXPECT_EQ(keys[0], "camera");
  EXPECT_EQ(keys[1], "camera-preset");
  EXPECT_EQ(keys[2], "copy-camera");
  EXPECT_THAT(keysOf(matchingActions("angle zebra")), IsEmpty());
  EXPECT_THAT(keysOf(matchingActions("170 angle")), ElementsAre("fov"));
}

TEST(ActionSearch, FindsChoicesByNameAndTitle) {
  EXPECT_THAT(textsOf(matchingActions("jacobi")), testing::IsSupersetOf({"mode jacobi", "race jacobi"}));
  EXPECT_THAT(textsOf(matchingActions("colour zebra")), IsEmpty());
  EXPECT_THAT(textsOf(matchingActions("colour Irradiance")), testing::Contains("display false-irradiance"));
  EXPECT_THAT(textsOf(matchingActions("filmic")), testing::Contains("tone filmic"));
  // Behind the name of an action its own alone, and itself where the choice is whole.
  EXPECT_THAT(textsOf(matchingActions("display irr")),
              testing::UnorderedElementsAre("display irradiance", "display false-irradiance"));
  EXPECT_THAT(textsOf(matchingActions("display irradiance")), ElementsAre("display irradiance"));
  EXPECT_THAT(textsOf(matchingActions("display zebra")), ElementsAre("display zebra"));
  EXPECT_THAT(textsOf(matchingActions("fov 30")), ElementsAre("fov 30"));
}

TEST(ActionSearch, FindsWhatOthersCallOtherwise) {
  const auto first = [](const char* text) { return textsOf(matchingActions(text)).at(0); };
  EXPECT_EQ(first("mesh"), "display mesh");
  EXPECT_EQ(first("wireframe"), "display mesh");
  EXPECT_EQ(first("wirefra"), "display mesh");
  EXPECT_EQ(first("reset view"), "frame ");
  EXPECT_EQ(first("field of view"), "fov ");
  EXPECT_THAT(textsOf(matchingActions("make it a light")), testing::Contains("light "));
}

TEST(ActionSearch, ReadsAnArgumentBehindTheName) {
  EXPECT_EQ(typedAction("fov").action, nullptr);
  EXPECT_EQ(typedAction("fo 30").action, nullptr);
  const TypedAction typed = typedAction("fov  30 ");
  EXPECT_EQ(typed.action, &findAction("fov"));
  EXPECT_EQ(typed.argument, "30");
}

class Files : public testing::Test {
 protected:
  Files() {
    for (const char* name : {"b.obj", "A.OBJ", "notes.txt", ".hidden.obj", "room one.obj", "room two.obj",
                             "A.mtl", "a later.unshot", "a.Png", "a.ply"})
      folder_.write(name, "");
    for (const char* name : {"rooms", "empty", ".git"})
      std::filesystem::create_directory(folder_.path() / name);
    folder_.write("rooms/hall.obj", "");
    files_.open(folder_.path());
  }
  static std::vector<std::string> namesOf(const std::vector<FileList::Entry>& entries) {
    std::vector<std::string> names;
    for (const FileList::Entry& entry : entries) names.push_back(entry.name + (entry.folder ? "/" : ""));
    return names;
  }
  TempFolder folder_;
  FileList files_;
};

TEST_F(Files, AreFoldersThenScenesThenOthersByName) {
  EXPECT_THAT(namesOf(files_.entries()),
              ElementsAre("../", "empty/", "rooms/", "A.OBJ", "b.obj", "room one.obj", "room two.obj",
                          "a later.unshot", "a.ply", "a.Png"));
  EXPECT_EQ(files_.pathOf(files_.entries()[0]), files_.folder().parent_path());
  EXPECT_EQ(files_.pathOf(files_.entries()[3]), files_.folder() / "A.OBJ");
  FileList root;
  root.open("/");
  EXPECT_NE(root.entries().at(0).name, "..") << "nothing is above it";
}

TEST_F(Files, MatchWhatIsTypedWhateverItsCase) {
  EXPECT_THAT(namesOf(files_.matching("O")),
              ElementsAre("rooms/", "A.OBJ", "b.obj", "room one.obj", "room two.obj", "a later.unshot"));
  EXPECT_THAT(namesOf(files_.matching("ROOM")), ElementsAre("rooms/", "room one.obj", "room two.obj"));
  EXPECT_THAT(files_.matching("zebra"), IsEmpty());
}

TEST_F(Files, AreCompletedAsFarAsTheyAgree) {
  EXPECT_EQ(files_.completed("r"), "room");
  EXPECT_EQ(files_.completed("room "), "room ");
  EXPECT_EQ(files_.completed("ROOM T"), "room two.obj");
  EXPECT_EQ(files_.completed("e"), "empty/");
  EXPECT_EQ(files_.completed("zebra"), "zebra");
}

TEST_F(Files, FollowATypedPath) {
  const std::filesystem::path start = files_.folder();
  EXPECT_EQ(files_.follow("rooms"), "rooms");
  EXPECT_EQ(files_.follow("rooms/ha"), "ha");
  EXPECT_EQ(files_.folder(), start / "rooms");
  EXPECT_EQ(files_.follow("../"), "");
  EXPECT_EQ(files_.folder(), start);
  EXPECT_EQ(files_.follow("nowhere/x"), "nowhere/x");
  EXPECT_EQ(files_.follow("/"), "");
  EXPECT_EQ(files_.folder(), "/");
}

TEST_F(Files, OfAFolderThatIsNoneAreAnErrorAndThoseBeforeStay) {
  const std::filesystem::path start = files_.folder();
  for (const char* name : {"gone", "b.obj"}) {
    try {
      files_.open(start / name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_THAT(error.fullText(), HasSubstr(name));
    }
  }
  EXPECT_EQ(files_.folder(), start);
  EXPECT_FALSE(files_.entries().empty());
}

/// A viewer whose keys are typed through ImGui, as the window's are.
class PromptedViewer : public testing::Test {
 protected:
  PromptedViewer() : live_(options()) {
    ImGuiIO& io = ImGui::GetIO();
    for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = 300 + key;
    EXPECT_TRUE(live_.untilPhase(SessionPhase::kConverged));
  }
  static LiveViewer::Options options() {
    LiveViewer::Options options;
    options.scene = UNSHOT_SOURCE_DIR "/assets/two_patches.obj";
    options.width = 640;
    options.height = 360;
    return options;
  }
  /// So many frames take the focus into the line, and what is typed into the list.
  void frames(int count = 4) {
    for (int k = 0; k < count; ++k) live_.draw();
  }
  void type(const std::string& text) {
    for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(c));
    frames();
  }
  void press(ImGuiKey key) {
    ImGui::GetIO().KeysDown[300 + key] = true;
    live_.draw();
    ImGui::GetIO().KeysDown[300 + key] = false;
    frames();
  }
  Prompt& prompt() { return live_->ui().prompt; }
  std::string text() { return prompt().text.data(); }

  TempFolder folder_;
  LiveViewer live_;
};

TEST_F(PromptedViewer, AnActionIsFoundAndPerformed) {
  live_->key('P', true);
  live_->key('O', false);
  EXPECT_FALSE(live_->camera().orthographic) << "typed before the line is there, and a key of the scene";
  frames();
  EXPECT_TRUE(ImGui::GetIO().WantTextInput) << "keys would go to the scene";
  type("orthogr");
  EXPECT_TRUE(prompt().open());
  press(ImGuiKey_Enter);
  EXPECT_FALSE(prompt().open());
  EXPECT_TRUE(live_->camera().orthographic);
}

TEST_F(PromptedViewer, AnActionAsksForItsArgumentAndSaysWhatIsWrongWithIt) {
  live_->perform("actions");
  frames();
  type("fov");
  press(ImGuiKey_Enter);
  EXPECT_EQ(text(), "fov ") << "does not ask";
  type("wide");
  EXPECT_THAT(prompt().wrong, HasSubstr("'wide' is no angle"));
  press(ImGuiKey_Enter);
  EXPECT_TRUE(prompt().open());
  EXPECT_EQ(text(), "fov wide");
  EXPECT_THAT(prompt().wrong, HasSubstr("'wide' is no angle"));
  for (int k = 0; k < 4; ++k) press(ImGuiKey_Backspace);
  type("33");
  EXPECT_EQ(prompt().wrong, "");
  press(ImGuiKey_Enter);
  EXPECT_FALSE(prompt().open());
  EXPECT_EQ(live_->camera().fov_deg, 33);
}

TEST_F(PromptedViewer, ArrowsChooseAndEscapeCloses) {
  live_->perform("actions", "camera");
  frames();
  press(ImGuiKey_DownArrow);
  EXPECT_EQ(prompt().chosen, 1u);
  press(ImGuiKey_UpArrow);
  press(ImGuiKey_UpArrow);
  EXPECT_EQ(prompt().chosen, matchingActions("camera").size() - 1);
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_Tab);
  EXPECT_EQ(text(), "camera-preset ");
  press(ImGuiKey_Escape);
  EXPECT_FALSE(prompt().open());
  EXPECT_FALSE(live_->error());
}

TEST_F(PromptedViewer, ASceneIsOpenedByItsTypedPath) {
  live_->key('O', true);
  frames();
  EXPECT_EQ(prompt().files.folder(), std::filesystem::canonical(UNSHOT_SOURCE_DIR "/assets"));
  type("../ass");
  EXPECT_EQ(prompt().files.folder(), std::filesystem::canonical(UNSHOT_SOURCE_DIR));
  EXPECT_EQ(text(), "ass");
  press(ImGuiKey_Tab);
  EXPECT_EQ(prompt().files.folder(), std::filesystem::canonical(UNSHOT_SOURCE_DIR "/assets"));
  type("nothing");
  press(ImGuiKey_Enter);
  EXPECT_THAT(prompt().wrong, HasSubstr("has 'nothing' in its name"));
  for (int k = 0; k < 7; ++k) press(ImGuiKey_Backspace);
  type("furn");
  press(ImGuiKey_Enter);
  EXPECT_FALSE(prompt().open());
  EXPECT_TRUE(live_.until([&] { return live_->state().facts->scene_name == "furnace"; }));
}

TEST_F(PromptedViewer, APictureIsChosenFromTheListToCompareWith) {
  writePng(folder_.path() / "photograph.png", Image8{2, 1, {255, 128, 0, 0, 128, 255}});
  live_->perform("browse", folder_.path().string());
  frames();
  type("photo");
  press(ImGuiKey_Enter);
  EXPECT_FALSE(prompt().open());
  EXPECT_TRUE(live_.until([&] { return live_->referencePicture() != nullptr; }));
}

TEST_F(PromptedViewer, AFolderThatIsNoneIsSaid) {
  live_->perform("browse", (folder_.path() / "gone").string());
  ASSERT_TRUE(live_->error());
  EXPECT_THAT(live_->error()->fullText(), HasSubstr("gone"));
  EXPECT_FALSE(prompt().open());
}

TEST(FirstHint, GoesWithTheFirstKeyAndIsRemembered) {
  const TempFolder folder;
  LiveViewer::Options options;
  options.memory = folder.path();
  {
    LiveViewer live(options);
    EXPECT_TRUE(live->ui().hint);
    live->key('H', false);
    EXPECT_FALSE(live->ui().hint);
  }
  {
    LiveViewer again(options);
    EXPECT_FALSE(again->ui().hint);
  }
  options.memory.clear();
  LiveViewer without(options);
  EXPECT_FALSE(without->ui().hint) << "where nothing is remembered it would be shown for ever";
}

TEST(FirstHint, IsNotShownInScripts) {
  const TempFolder folder;
  LiveViewer::Options options;
  options.memory = folder.path();
  options.script = "wait seconds 0\n";
  LiveViewer live(options);
  EXPECT_FALSE(live->ui().hint);
}

TEST_F(PromptedViewer, HelpAndPromptsFitAnyWindow) {
  for (const auto& [size, scale] : std::vector<std::pair<std::string, std::string>>{
           {"640x360", "1"}, {"1280x720", "1"}, {"1280x800", "2"}, {"240x200", "1"}}) {
    live_->perform("scale", scale);
    live_->perform("size", size);
    for (const std::string action : {"help", "actions", "browse"}) {
      SCOPED_TRACE(size + " at " + scale + ", " + action);
      live_->perform(action);
      frames(6);
      ASSERT_FALSE(live_->error()) << live_->error()->fullText();
      const ImDrawData& data = *ImGui::GetDrawData();
      // The window's own rectangle, behind all that is clipped to it.
      for (int k = 0; k < data.CmdListsCount; ++k) {
        const std::string name = data.CmdLists[k]->_OwnerName ? data.CmdLists[k]->_OwnerName : "";
        if (name != "help" && name != "prompt") continue;
        for (const ImDrawVert& v : data.CmdLists[k]->VtxBuffer) {
          EXPECT_GE(v.pos.x, -1);
          EXPECT_GE(v.pos.y, -1);
          if (HasFailure()) return;
        }
        const ImDrawVert& corner = data.CmdLists[k]->VtxBuffer[0];
        EXPECT_LE(corner.pos.y, static_cast<float>(live_.height()));
      }
      live_->perform("dismiss");
    }
  }
}

}  // namespace
}  // namespace unshot
