#include "viewer/actions/actions.h"

#include <gmock/gmock.h>
#include <imgui_internal.h>

#include <set>

#include "base/atomic_file.h"
#include "base/error.h"
#include "export/image_files.h"
#include "export/ply.h"
#include "formfactor/methods.h"
#include "gui/support/gui_layout.h"
#include "gui/support/own_folder.h"
#include "gui/support/valid_arguments.h"
#include "render/display_modes.h"
#include "solver/modes.h"
#include "support/assets.h"
#include "support/live_viewer.h"
#include "viewer/file_kinds.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing_support::asset;
using testing_support::kCornellBox;
using testing_support::kTwoPatches;
using testing_support::LiveViewer;
using testing_support::validArguments;

TEST(Actions, KeysAndShortcutsAreUnique) {
  std::set<std::string_view> keys;
  std::set<std::pair<int, bool>> shortcuts;
  for (const Action& action : actions()) {
    EXPECT_TRUE(keys.insert(action.key).second) << action.key;
    EXPECT_NE(action.key, "wait") << "a word of scripts";
    EXPECT_EQ(action.key.find_first_of(" \t#"), std::string_view::npos) << action.key;
    EXPECT_FALSE(action.help.empty()) << action.key;
    EXPECT_EQ(&findAction(action.key), &action);
    if (action.shortcut.key == 0) continue;
    const std::size_t count = static_cast<std::size_t>(action.shortcut.count);
    EXPECT_TRUE(count == 1 || count == action.choices().size()) << action.key;
    for (int key = action.shortcut.key; key < action.shortcut.key + action.shortcut.count; ++key) {
      EXPECT_TRUE(shortcuts.insert({key, action.shortcut.ctrl}).second) << action.key;
      EXPECT_EQ(actionOfKey(key, action.shortcut.ctrl), &action);
      EXPECT_EQ(checkArgument(action, action.argumentOfKey(key)), "");
    }
    EXPECT_FALSE(action.shortcut.text.empty()) << action.key;
    EXPECT_EQ(action.shortcut.text.starts_with("Ctrl+"), action.shortcut.ctrl) << action.key;
    EXPECT_EQ(
        std::string_view("WASDQE").find(static_cast<char>(action.shortcut.key)) != std::string_view::npos,
        action.shortcut.ctrl && (action.key == "quit" || action.key == "save-solve"))
        << action.key << " has a key of flying";
  }
  EXPECT_EQ(actionOfKey('Z', false), nullptr);
}

// Each key is US's at its place, with what another keyboard has there.
TEST(Actions, KeysGoByWhatIsPrintedOnThem) {
  struct Key {
    int key;
    const char* printed;
    bool ctrl;
    int wanted;
  };
  constexpr int kPlus = '=', kBracket = ']', kTab = 258, kKeypadPlus = 334;
  for (const Key& k : {Key{'Y', "z", true, 'Z'},          // German
                       Key{'Z', "y", true, 'Y'},          //
                       Key{kBracket, "+", false, kPlus},  //
                       Key{'/', "-", false, '-'},         //
                       Key{';', "m", false, 'M'},         // French
                       Key{'M', ",", false, 0},           //
                       Key{'Q', "a", true, 'A'},          //
                       Key{'A', "q", true, 'Q'},          //
                       Key{'6', "-", false, '-'},         //
                       Key{'6', "-", true, '6'},          //
                       Key{'1', "&", true, '1'},          //
                       Key{'Q', "'", true, 0},            // Dvorak
                       Key{'S', "o", false, 'S'},         // a key of flying
                       Key{'S', "o", true, 'O'},          //
                       Key{'M', "\u044c", false, 'M'},    // Russian
                       Key{kTab, nullptr, false, kTab}, Key{kKeypadPlus, "+", false, kPlus}})
    EXPECT_EQ(keyOfActions(k.key, k.printed, k.ctrl), k.wanted) << k.key << " " << k.ctrl;
}

TEST(DroppedFiles, TheFirstSceneCounts) {
  const auto chosen = [](std::initializer_list<const char*> files) {
    return chosenFile({files.begin(), files.size()}).string();
  };
  EXPECT_EQ(chosen({"a.mtl", "b.png", "c.OBJ", "d.obj"}), "c.OBJ");
  EXPECT_EQ(chosen({"a.mtl", "b.HDR", "c.png"}), "b.HDR");
  EXPECT_EQ(chosen({"a.mtl", "b.txt"}), "a.mtl");
  EXPECT_EQ(chosen({"a.script", "b.PLY", "c.unshot"}), "b.PLY");
}

TEST(FileKinds, EachHasAnActionOrSaysWhatToDo) {
  for (const FileKind& kind : fileKinds()) {
    SCOPED_TRACE(kind.ending);
    EXPECT_EQ(kind.action.empty(), !kind.instead.empty());
    if (kind.action.empty()) continue;
    EXPECT_TRUE(findAction(kind.action).needsArgument());
    EXPECT_EQ(actionOfFile("a" + std::string(kind.ending)), kind.action);
    std::string name(kind.ending.substr(1));
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return static_cast<char>(c - 'a' + 'A'); });
    if (kind.ending == ".jpg" || kind.action == "open") continue;
    EXPECT_THAT(findAction(kind.action).help, HasSubstr(name == "PLY" ? "--ply" : name)) << "not in the help";
  }
}

TEST(Actions, UnknownOnesAreUsageErrors) {
  for (const char* key : {"", "jump", "Quit", "step "}) {
    try {
      findAction(key);
      FAIL() << key;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      EXPECT_THAT(error.advice(), HasSubstr("screenshot-scene"));
    }
  }
}

TEST(Actions, ChecksRefuseNonsenseAndNeverThrow) {
  const std::vector<std::string> nonsense{"",
                                          " ",
                                          "?",
                                          "yes",
                                          "nan",
                                          "inf",
                                          "-inf",
                                          "1e999",
                                          "0x10",
                                          "1;2",
                                          "1,2,3,4",
                                          "1e-400",
                                          "--",
                                          "\xff\xfe",
                                          "\xe2\x88\x9e",
                                          "on twice",
                                          "OFF",
                                          "1x1",
                                          "x",
                                          "200x",
                                          ",,,,,",
                                          "1,,3,4,5,6",
                                          "9999999999999999999999",

                                          "%s%n",
                                          std::string(10000, '9'),
                                          std::string("a\0b", 3)};
  for (const Action& action : actions()) {
    SCOPED_TRACE(action.key);
    const auto valid = validArguments().find(action.key);
    EXPECT_EQ(valid == validArguments().end(), action.argument.empty()) << "no argument to try here";
    if (valid != validArguments().end()) {
      EXPECT_EQ(checkArgument(action, valid->second), "");
    }
    EXPECT_EQ(checkArgument(action, "").empty(), !action.needsArgument());
    const bool any_text = action.check == nullptr && !action.argument.empty();  // paths
    for (const std::string& text : nonsense) {
      std::string wrong;
      ASSERT_NO_THROW(wrong = checkArgument(action, text)) << text;
      if (!text.empty() && !any_text) {
        EXPECT_FALSE(wrong.empty()) << "takes '" << text << "'";
      }
    }
  }
}

LiveViewer::Options boxToActOn() {
  LiveViewer::Options options;
  options.scene = kCornellBox;
  options.solve.elements = 200;
  options.width = 904;  // the panel beside the scene
  options.height = 640;
  return options;
}

/// Performs it and runs until it is carried out and shown.
void performAndSettle(LiveViewer& live, const Action& action, const std::string& argument) {
  static const std::set<std::string_view> kSolveAnew{"open",     "reload",   "restart", "form-factors",
                                                     "elements", "hemicube", "again",   "do",
                                                     "do-all",   "emit",     "keep"};
  const std::uint64_t epoch = live->state().epoch;
  live->perform(action.key, argument);
  for (int frame = 0; frame < 5; ++frame) live.draw();
  ASSERT_TRUE(live.until([&] {
    const SessionPhase phase = live->state().phase;
    if (!live->upToDate() || phase == SessionPhase::kLoading || phase == SessionPhase::kRunning ||
        !live->scriptDone())
      return false;
    if (!kSolveAnew.contains(action.key) || live->error()) return true;
    return live->state().epoch > epoch && (action.key != "open" || live->nextFrame(0) > 1e30);  // its camera
  }));
}

using EveryAction = testing_support::InOwnFolder;

TEST_F(EveryAction, PerformsOnALiveViewer) {
  LiveViewer live(boxToActOn());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; })) << "never at rest";
  for (const Action& action : actions()) {
    if (action.key == "quit") continue;
    const auto valid = validArguments().find(action.key);
    for (const bool with : {true, false}) {
      if (with ? valid == validArguments().end() : action.needsArgument()) continue;
      SCOPED_TRACE(std::string(action.key) + (with ? " " + valid->second : ""));
      if (action.key == "reference")
        writeWholeFile("solution.ply", plyBytes(*live->state().snapshot, false, 1));
      if (action.key == "reference-picture")
        writePng("picture.png", Image8{2, 1, {255, 128, 0, 0, 128, 255}});
      performAndSettle(live, action, with ? valid->second : "");
      ASSERT_FALSE(live->error()) << live->error()->fullText();
    }
  }
  EXPECT_EQ(live->state().facts->scene_name, "two_patches");
  EXPECT_EQ(live->exitCode(), 0);
  EXPECT_FALSE(live->closing());
  live->perform("quit");
  EXPECT_TRUE(live->closing());
  EXPECT_EQ(folder_.names(),
            (std::set<std::string>{"with.png", "without.png", "solution.ply", "unshot-two_patches-001.png",
                                   "unshot-two_patches-002.png", "with.unshot",
                                   "unshot-two_patches-001.unshot", "with.mtl", "unshot-two_patches-001.mtl",
                                   "with.csv", "unshot-two_patches-001.csv", "picture.png"}));
}

TEST_F(EveryAction, WithoutASceneNoneCrashes) {
  LiveViewer::Options options;
  LiveViewer live(options);
  for (const Action& action : actions()) {
    if (action.key == "quit" || action.key == "open") continue;
    const auto valid = validArguments().find(action.key);
    SCOPED_TRACE(action.key);
    performAndSettle(live, action, valid == validArguments().end() ? "" : valid->second);
    if (HasFatalFailure()) return;
    live->perform("dismiss");
  }
  EXPECT_EQ(live->state().phase, SessionPhase::kEmpty);
  EXPECT_TRUE(std::filesystem::exists("with.png"));
}

const ImGuiWindow* sections() {
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (window->Active && std::string(window->Name).starts_with("panel/sections")) return window;
  }
  return nullptr;
}

std::string sectionsText() {
  std::string out;
  for (const auto& letter : testing_support::Letters(*ImGui::GetIO().Fonts).of(*sections()->DrawList))
    out += letter.text;
  return out;
}

TEST(SectionAction, OpensAndClosesEachAndScrollsToIt) {
  LiveViewer live(boxToActOn());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  live->perform("next-display");
  const auto shown = [&](const std::string& argument) {
    live->perform("section", argument);
    for (int frame = 0; frame < 4; ++frame) live.draw();
    EXPECT_FALSE(live->error());
    return sectionsText();
  };
  shown("messages off");
  const float without = sections()->ScrollMax.y;
  const std::string text = shown("messages on");
  EXPECT_THAT(text, HasSubstr("display:Radiosityperelement")) << "the panel is longer than the window";
  EXPECT_GT(sections()->ScrollMax.y, without);
  EXPECT_THAT(shown("messages"), testing::Not(HasSubstr("display:Radiosityperelement")));
  EXPECT_THAT(shown("solve on"), HasSubstr("Iteration"));
  const float open = sections()->ScrollMax.y;
  shown("solve off");
  EXPECT_LT(sections()->ScrollMax.y, open);
  live->perform("section", "zebra");
  EXPECT_TRUE(live->error());
}

TEST(MaterialAction, ChoosesTheOneThatThePanelShows) {
  LiveViewer live(boxToActOn());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  for (const Material& material : live->edits().materials()) {
    live->perform("material", material.name);
    EXPECT_EQ(live->edits().materials()[live->ui().material].name, material.name);
  }
  live->perform("material", "zebra");
  EXPECT_TRUE(live->error());
}

TEST(EmitAction, SolvesAgainWithOneSideOfLights) {
  LiveViewer::Options options = boxToActOn();
  options.scene = kTwoPatches;
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  EXPECT_FALSE(live->state().facts->options.emit_front_only);
  const std::uint64_t epoch = live->state().epoch;
  live->perform("emit", "front");
  ASSERT_TRUE(live.until(
      [&] { return live->state().epoch > epoch && live->state().phase == SessionPhase::kConverged; }));
  EXPECT_TRUE(live->state().facts->options.emit_front_only);
  live->perform("keep", "7");
  ASSERT_TRUE(live.until(
      [&] { return live->state().epoch > epoch + 1 && live->state().phase == SessionPhase::kConverged; }));
  EXPECT_EQ(live->state().facts->options.kept_bytes, 7'000'000u);
}

TEST(CleanKey, LeavesNothingButTheScene) {
  LiveViewer::Options options = boxToActOn();
  options.width = 1280;
  options.height = 800;
  options.script =
      "wait converged\npick 0.45,0.6\npin-probe\nhemicube-view on\nlecture-page equation\n"
      "display false-radiosity\nradiosity off\nmaterials on\n";
  LiveViewer live(options);
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
  EXPECT_GT(ImGui::GetDrawData()->TotalVtxCount, 1000);
  live->key('X', false);
  for (int frame = 0; frame < 3; ++frame) live.draw();
  EXPECT_EQ(ImGui::GetDrawData()->TotalVtxCount, 0);
  live->key('X', false);
  for (int frame = 0; frame < 3; ++frame) live.draw();
  EXPECT_GT(ImGui::GetDrawData()->TotalVtxCount, 1000);
}

TEST(LiveViewer, AWrongArgumentIsShownAndChangesNothing) {
  LiveViewer live(boxToActOn());
  live->perform("display", "colours");
  ASSERT_TRUE(live->error());
  EXPECT_EQ(live->error()->kind(), ErrorKind::kUsage);
  EXPECT_EQ(live->ui().settings.view.display, "radiosity");
  live->perform("dismiss");
  EXPECT_FALSE(live->error());
}

bool showsNotice(LiveViewer& live) {
  for (int frame = 0; frame < 3; ++frame) live.draw();
  const ImGuiWindow* window = ImGui::FindWindowByName("notice");
  return window && window->Active;
}

// What has converged soon may be gone through step by step: a lecture's first wish.
TEST(LiveViewer, StepBeginsAgainWhatHasConverged) {
  LiveViewer::Options options = boxToActOn();
  options.script = "pause on\nstep\nwait shots 1\n";
  LiveViewer live(options);
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  EXPECT_FALSE(showsNotice(live));
  live->perform("pause", "off");
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  EXPECT_FALSE(showsNotice(live));
  live->perform("step", "2");
  EXPECT_TRUE(showsNotice(live));
  ASSERT_TRUE(live.untilPhase(SessionPhase::kPaused));
  EXPECT_EQ(live->state().measures.shots, 2u);
  live->perform("pause", "off");
  EXPECT_TRUE(live.untilPhase(SessionPhase::kConverged));
  EXPECT_EQ(live->exitCode(), 0);
}

TEST(LiveViewer, CountsShotsExactly) {
  LiveViewer::Options options = boxToActOn();
  options.script = "pause on\nstep 5\nwait shots 5\nstep\nwait shots 6\nstep 37\nwait shots 43\n";
  LiveViewer live(options);
  std::set<std::uint64_t> counts;
  ASSERT_TRUE(live.until([&] {
    if (live->state().phase == SessionPhase::kPaused) counts.insert(live->state().measures.shots);
    return live->scriptDone();
  }));
  EXPECT_EQ(live->state().phase, SessionPhase::kPaused);
  EXPECT_EQ(live->state().measures.shots, 43u);
  EXPECT_EQ(live->state().history->back().measures.shots, 43u);
  for (const std::uint64_t count : counts) {
    EXPECT_TRUE(std::set<std::uint64_t>({0, 5, 6, 43}).contains(count)) << "paused after " << count;
  }
}

TEST(LiveViewer, EveryModeMethodAndFinenessConverges) {
  LiveViewer::Options options = boxToActOn();
  options.scene = asset("furnace.obj");
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  EXPECT_EQ(live.title(), "furnace \u2013 Unshot");
  const auto again = [&](const std::string& action, const std::string& argument) {
    SCOPED_TRACE(action + " " + argument);
    const std::uint64_t epoch = live->state().epoch;
    live->perform(action, argument);
    ASSERT_TRUE(live.until(
        [&] { return live->state().epoch > epoch && live->state().phase == SessionPhase::kConverged; }));
    ASSERT_FALSE(live->error()) << live->error()->fullText();
  };
  for (const FormFactorMethodRow& method : formFactorMethods()) {
    again("form-factors", std::string(method.info.key));
    EXPECT_EQ(live->state().facts->form_factors, method.info.key);
  }
  again("form-factors", "auto");
  again("elements", "600");
  EXPECT_NEAR(static_cast<double>(live->state().facts->elements), 600, 100);
  again("elements", "0");
  EXPECT_FALSE(live->ui().options.elements.has_value());
  again("hemicube", "32");
  again("hemicube", "0");
  for (const IterationModeRow& mode : iterationModes()) {
    live->perform("mode", std::string(mode.info.key));
    again("restart", "");
    EXPECT_EQ(live->state().facts->mode, mode.info.key);
  }
}

}  // namespace
}  // namespace unshot
