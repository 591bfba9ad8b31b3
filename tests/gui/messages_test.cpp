// What the window says stays until it is read: errors one after the other, notices, and the list of all of
// them.
#include "viewer/messages.h"

#include <gmock/gmock.h>
#include <imgui_internal.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "base/clock.h"
#include "gui/support/gui_layout.h"
#include "gui/support/mouse.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"
#include "viewer/window_words.h"

namespace unshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing_support::LiveViewer;
using testing_support::TempFolder;

Error errorOf(const std::string& text) { return Error(ErrorKind::kUsage, text, {}, "something else"); }

TEST(Messages, ErrorsWaitUntilThoseBeforeAreRead) {
  Messages said;
  EXPECT_FALSE(said.error());
  for (const char* text : {"one", "two", "one", "three", "two"}) said.addError(errorOf(text), false, 0);
  for (const char* text : {"one", "two", "three"}) {
    ASSERT_TRUE(said.error());
    EXPECT_STREQ(said.error()->what(), text);
    said.dismissError();
  }
  EXPECT_FALSE(said.error());
  EXPECT_EQ(said.log().size(), 5u);
  EXPECT_THAT(said.log()[1].text, HasSubstr("something else"));
}

TEST(Messages, AnotherSceneTakesOnlyErrorsOfTheOneBefore) {
  Messages said;
  said.addError(errorOf("of the scene"), true, 0);
  said.addError(errorOf("of a key"), false, 0);
  said.addError(errorOf("of the scene too"), true, 0);
  said.forgetErrorsOfSolve();
  ASSERT_TRUE(said.error());
  EXPECT_STREQ(said.error()->what(), "of a key");
  EXPECT_EQ(said.waiting(), 0u);
  EXPECT_EQ(said.log().size(), 3u) << "what was said is still listed";
}

TEST(Messages, NoticesStayUntilTheUserHasWorkedUnderThem) {
  Messages said;
  said.add("written: a", 0);
  said.addPassing("display: Mesh", 0);
  said.addPassing("display: Patches", 1);
  said.add("written: b", 1);
  EXPECT_THAT(said.lines(), ElementsAre("written: a", "written: b", "display: Patches"));
  EXPECT_LT(said.nextExpiry(), 10);
  EXPECT_FALSE(said.expire(2));
  EXPECT_TRUE(said.expire(said.nextExpiry()));
  EXPECT_FALSE(said.expire(1e6));
  // An act now and then is not reading.
  for (int hour = 1; hour < 5; ++hour) EXPECT_FALSE(said.userActs(3600 * hour));
  EXPECT_THAT(said.lines(), ElementsAre("written: a", "written: b"));
  double now = 1e5;
  for (int k = 0; k < 100 && !said.lines().empty(); ++k) said.userActs(now += 0.25);
  EXPECT_THAT(said.lines(), IsEmpty());
  EXPECT_GT(now, 1e5 + 1);
  EXPECT_EQ(said.log().size(), 4u);
}

TEST(Messages, NoticesAreDismissedAndPassingOnesStay) {
  Messages said;
  said.addPassing("copied", 0);
  said.add("written: c", 0);
  EXPECT_THAT(said.lines(), ElementsAre("written: c", "copied"));
  EXPECT_TRUE(said.dismissNotices());
  EXPECT_FALSE(said.dismissNotices());
}

TEST(Messages, WhatGoesUnreadIsCountedUntilItIsSeen) {
  Messages said;
  said.addPassing("display: Mesh", 0);  // an echo
  EXPECT_EQ(said.unread(), 0u);
  said.add("written: a", 0);
  said.addError(errorOf("wrong"), false, 0);
  said.addError(errorOf("of the scene"), true, 0);
  EXPECT_EQ(said.unread(), 3u);
  said.dismissError();
  EXPECT_EQ(said.unread(), 2u);
  said.forgetErrorsOfSolve();
  for (double now = 0; now < 100; now += 0.25) said.userActs(now);
  EXPECT_THAT(said.lines(), testing::Not(testing::Contains("written: a")));
  EXPECT_EQ(said.unread(), 2u) << "gone is not read";
  said.add("written: b", 100);
  said.dismissNotices();
  EXPECT_EQ(said.unread(), 2u);
  said.readAll();
  EXPECT_EQ(said.unread(), 0u);
}

TEST(Messages, TheSameLineStandsOnce) {
  Messages said;
  for (const char* text : {"converged", "written: a", "converged"}) said.add(text, 0);
  EXPECT_THAT(said.lines(), ElementsAre("written: a", "converged"));
  EXPECT_EQ(said.log().size(), 3u);
}

TEST(Messages, MoreThanHaveRoomAreCounted) {
  Messages said;
  for (int k = 0; k < 7; ++k) said.add("written: " + std::to_string(k), k);
  const std::vector<std::string> lines = said.lines();
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_THAT(lines.front(), HasSubstr("4 more"));
  EXPECT_EQ(lines.back(), "written: 6");
}

LiveViewer::Options box() {
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 300;
  options.width = 1000;
  options.height = 600;
  return options;
}

TEST(ViewerMessages, AreNotInAPictureButOverTheScene) {
  const TempFolder folder;
  LiveViewer live(box());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  const auto written = [&](const char* name) {
    live->perform("screenshot", folder / name);
    EXPECT_TRUE(live.until([&] { return live->scriptDone() && std::filesystem::exists(folder / name); }));
    EXPECT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
    return folder.read(name);
  };
  const std::string first = written("one.png");
  const ImGuiWindow* window = ImGui::FindWindowByName("notice");
  ASSERT_TRUE(window && window->Active);
  EXPECT_THAT(live->messages().lines(), ElementsAre("written: " + (folder / "one.png")));
  const double later = wallSeconds() + 5;
  ASSERT_TRUE(live.until([&] { return wallSeconds() > later; }));
  EXPECT_TRUE(window->Active) << "gone unread";
  written("two.png");
  EXPECT_EQ(live->messages().lines().size(), 2u);
  live->perform("dismiss");
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
  EXPECT_FALSE(window->Active);
}

/// The letters of what scrolls in the panel.
std::string panelText() {
  std::string out;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!window->Active || !std::string(window->Name).starts_with("panel/sections")) continue;
    for (const testing_support::Letter& letter :
         testing_support::Letters(*ImGui::GetIO().Fonts).of(*window->DrawList))
      out += letter.text;
  }
  return out;
}

TEST(ViewerMessages, AreListedAtTheEndOfThePanel) {
  LiveViewer::Options options = box();
  options.height = 2000;  // all of the panel is in it
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  live.draw();
  EXPECT_THAT(panelText(), testing::Not(HasSubstr("Messages")));
  live->perform("display", "zebra");
  live->perform("dismiss");
  live->perform("next-display");
  for (int frame = 0; frame < 3; ++frame) live.draw();
  EXPECT_THAT(panelText(), HasSubstr("Messages(2)"));
  live->notice("written: some.png");
  for (int frame = 0; frame < 3; ++frame) live.draw();
  EXPECT_THAT(panelText(), HasSubstr("Messages(3,1unread)"));
  EXPECT_THAT(panelText(), testing::Not(HasSubstr("zebra")));
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (window->Active && std::string(window->Name).starts_with("panel/sections"))
      ImGui::ActivateItem(ImHashStr("###messages", 0, window->ID));
  }
  for (int frame = 0; frame < 3; ++frame) {
    live->input();
    live.draw();
  }
  const std::string text = panelText();
  EXPECT_LT(text.find("display:Radiosityperelement"), text.find("thereisno'zebra'")) << "the newest is first";
  EXPECT_THAT(text, HasSubstr("Error:thereisno'zebra'"));
  EXPECT_THAT(text, HasSubstr("Messages(3)")) << "all are seen";
}

// What is more than the echo of a key stays.
TEST(ViewerMessages, WhatACommandCameToIsToBeRead) {
  LiveViewer live(box());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  ASSERT_TRUE(live.until([&] { return live->upToDate(); }));
  live->perform("step");
  EXPECT_THAT(live->messages().lines(), testing::Contains(HasSubstr("from nothing")));
  live->perform("projection", "orthographic");
  EXPECT_EQ(live->messages().unread(), 1u) << "an echo needs no reader";
  live->perform("copy-camera", "options");
  EXPECT_EQ(live->messages().unread(), 2u);
  EXPECT_TRUE(live->messages().stays());
}

// In a small window they take much of the scene.
TEST(ViewerMessages, LeaveTheMouseToTheScene) {
  LiveViewer::Options options = box();
  options.width = 640;
  options.height = 360;
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
  live->notice("written: /a/folder/with/a/long/name/and/another/one/picture.png");
  testing_support::Mouse mouse(live);
  mouse.frames();
  const ImGuiWindow* window = ImGui::FindWindowByName("notice");
  ASSERT_TRUE(window && window->Active);
  const ImRect box_of_notice = window->Rect();
  ASSERT_GT(box_of_notice.GetHeight(), 30) << "one line";
  const glm::dvec3 eye = live->camera().eye;
  mouse.drag({box_of_notice.Min.x + 20, box_of_notice.GetCenter().y});
  EXPECT_NE(live->camera().eye, eye) << "the scene cannot be turned below the line";
  mouse.click({box_of_notice.Max.x - 14, box_of_notice.Min.y + 14});
  EXPECT_THAT(live->messages().lines(), IsEmpty());
}

TEST(ViewerMessages, TheWindowSaysThatNothingIsRemembered) {
  const TempFolder folder;
  folder.write("file", "");
  LiveViewer::Options options = box();
  options.memory = folder.path() / "file" / "memory";
  LiveViewer live(options);
  EXPECT_TRUE(live.until([&] {
    const std::vector<std::string> lines = live->messages().lines();
    return !lines.empty() && lines.front().starts_with("cameras and settings are not remembered");
  }));
}

TEST(ViewerMessages, ASecondErrorComesAfterTheFirst) {
  LiveViewer live(box());
  live->perform("display", "one");
  live->perform("display", "two");
  EXPECT_THAT(live->error()->what(), HasSubstr("'one'"));
  live.draw();
  EXPECT_EQ(live->messages().waiting(), 1u);
  live->perform("dismiss");
  EXPECT_THAT(live->error()->what(), HasSubstr("'two'"));
  live->perform("dismiss");
  EXPECT_FALSE(live->error());
}

TEST(WindowWords, NameControlsInsteadOfOptions) {
  EXPECT_EQ(windowWords("1 W/m^2 and 2 W/m^2"), "1 W/m\u00b2 and 2 W/m\u00b2");
  const std::string reflecting = windowWords(
      "a reflectance (Kd) below 1 for some wall, or --bounces N (or --max-shots N) for the light of a "
      "number of bounces");
  EXPECT_THAT(reflecting, testing::Not(HasSubstr("--")));
  EXPECT_THAT(reflecting, HasSubstr("action bounces N"));
}

/// The texts in a source that are strings, those that follow each other joined.
std::vector<std::string> stringsIn(const std::string& source) {
  std::vector<std::string> out;
  bool joined = false;
  for (std::size_t k = 0; k < source.size(); ++k) {
    if (source.compare(k, 2, "//") == 0) {
      k = std::min(source.find('\n', k), source.size());
    } else if (source[k] == '\'') {
      k += source[k + 1] == '\\' ? 3 : 2;
      joined = false;
    } else if (source[k] == '"') {
      std::string text;
      for (++k; k < source.size() && source[k] != '"'; ++k) {
        if (source[k] == '\\') ++k;
        text += source[k];
      }
      if (joined) {
        out.back() += text;
      } else {
        out.push_back(text);
      }
      joined = true;
    } else if (std::isspace(static_cast<unsigned char>(source[k])) == 0) {
      joined = false;
    }
  }
  return out;
}

/// Whether the text names an option, as in "--elements".
bool namesOption(const std::string& text) {
  for (std::size_t at = 0; (at = text.find("--", at)) != std::string::npos; at += 2) {
    const char next = at + 2 < text.size() ? text[at + 2] : ' ';
    if (std::islower(static_cast<unsigned char>(next)) != 0) return true;
  }
  return false;
}

// All that core says of options, but for what is said before there is a window, in files of HTML and of
// reports, and where both options are given.
TEST(WindowWords, NameNoOptionOfWhatCoreSays) {
  const std::set<std::string> without_window = {"gl/context.cpp", "gl/functions.cpp", "export/exporters.cpp",
                                                "export/probes.cpp"};
  std::size_t told = 0;
  const std::filesystem::path core = std::filesystem::path(UNSHOT_SOURCE_DIR) / "core";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(core)) {
    const std::string file = std::filesystem::relative(entry.path(), core).string();
    if (entry.path().extension() != ".cpp" || file.starts_with("report/") || without_window.contains(file))
      continue;
    std::ifstream stream(entry.path());
    const std::string source{std::istreambuf_iterator<char>(stream), {}};
    for (const std::string& text : stringsIn(source)) {
      if (!namesOption(text) || text.find("exclude each other") != std::string::npos) continue;
      ++told;
      EXPECT_FALSE(namesOption(windowWords(text))) << file << ": " << windowWords(text);
    }
  }
  EXPECT_GT(told, 15u) << "a check that finds nothing may look at nothing";
}

// What the solver advises is written there, far from these words.
TEST(WindowWords, OfASceneThatNeverFades) {
  const TempFolder folder;
  folder.write("white.mtl", "newmtl white\nKd 1 1 1\nnewmtl lamp\nKd 1 1 1\nKe 1 1 1\n");
  LiveViewer::Options options = box();
  options.scene = folder.write("white.obj",
                               "mtllib white.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
                               "v 1 1 1\nv 0 1 1\nusemtl white\nf 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\n"
                               "f 1 4 8 5\nusemtl lamp\nf 3 4 8 7\n");
  LiveViewer live(options);
  ASSERT_TRUE(live.until([&] { return live->error().has_value(); }));
  EXPECT_THAT(live->error()->what(), HasSubstr("no finite solution"));
  EXPECT_THAT(live->error()->advice(), testing::Not(HasSubstr("--")));
  EXPECT_THAT(live->error()->advice(), HasSubstr("action bounces N"));
}

TEST(WindowWords, OfASceneWithoutLight) {
  const TempFolder folder;
  LiveViewer::Options options = box();
  options.scene = folder.write("dark.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  LiveViewer live(options);
  ASSERT_TRUE(live.until([&] { return !live->messages().lines().empty(); }));
  const std::string line = live->messages().lines().front();
  EXPECT_THAT(line, HasSubstr("a uniform sky of 1 W/m\u00b2 lights the scene"));
  EXPECT_THAT(line, HasSubstr("action sky"));
  EXPECT_THAT(line, testing::Not(HasSubstr("--")));
}

TEST(WindowWords, OfASceneWhoseMaterialsAreMissing) {
  const TempFolder folder;
  LiveViewer::Options options = box();
  options.scene = folder.write(
      "bare.obj", "mtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl lamp\nf 1 2 3 4\n");
  LiveViewer live(options);
  ASSERT_TRUE(live.until([&] { return !live->messages().lines().empty(); }));
  EXPECT_THAT(live->messages().lines().front(), HasSubstr("No materials, so no light of its own"));
  EXPECT_THAT(live->messages().lines().front(), HasSubstr("lost.mtl"));
}

}  // namespace
}  // namespace unshot
