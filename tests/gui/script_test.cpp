#include "viewer/script.h"

#include <gmock/gmock.h>

#include <set>
#include <sstream>

#include "base/error.h"
#include "render/display_modes.h"
#include "support/temp_folder.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

using testing::HasSubstr;

std::vector<ScriptLine> parse(const std::string& text) {
  std::istringstream stream(text);
  return parseScript(stream, "demo.txt");
}

TEST(Script, ActionsArgumentsAndWaits) {
  const auto script = parse(
      "step\nstep 5\nopen my scenes/a room.obj\nwait converged\nwait shots 10\nwait seconds 1.5\n"
      "camera 0,0,5,0,0,0\nwait seconds 0\n");
  ASSERT_EQ(script.size(), 8u);
  EXPECT_EQ(script[0].action, "step");
  EXPECT_EQ(script[0].argument, "");
  EXPECT_EQ(script[1].argument, "5");
  EXPECT_EQ(script[2].argument, "my scenes/a room.obj");
  EXPECT_EQ(script[3].wait, WaitFor::kConverged);
  EXPECT_EQ(script[4].wait, WaitFor::kShots);
  EXPECT_EQ(script[4].amount, 10);
  EXPECT_EQ(script[5].wait, WaitFor::kSeconds);
  EXPECT_EQ(script[5].amount, 1.5);
  for (std::size_t i = 0; i < script.size(); ++i) EXPECT_EQ(script[i].number, static_cast<int>(i + 1));
}

TEST(Script, CommentsEmptyLinesTabsAndCarriageReturns) {
  const auto script = parse(
      "# what it shows\r\n\r\n  \t \r\n\tstep \t 5 \t\r\n  # indented\r\nwait\tshots \t7\r\nopen "
      "a#1.obj\r\nhelp");
  ASSERT_EQ(script.size(), 4u);
  EXPECT_EQ(script[0].number, 4);
  EXPECT_EQ(script[0].action, "step");
  EXPECT_EQ(script[0].argument, "5");
  EXPECT_EQ(script[1].number, 6);
  EXPECT_EQ(script[1].amount, 7);
  EXPECT_EQ(script[2].argument, "a#1.obj");
  EXPECT_EQ(script[3].action, "help");
  EXPECT_TRUE(parse("").empty());
  EXPECT_TRUE(parse("\n\n#\n").empty());
}

struct Refused {
  std::string line, message;
};

void PrintTo(const Refused& refused, std::ostream* out) { *out << "'" << refused.line << "'"; }

class RefusedLine : public testing::TestWithParam<Refused> {};

TEST_P(RefusedLine, IsAUsageErrorWithFileAndLine) {
  try {
    parse("# one\nstep 3\n\n" + GetParam().line + "\nquit\n");
    FAIL() << "was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_EQ(error.where(), "demo.txt:4");
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
    EXPECT_NE(error.advice(), "");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Script, RefusedLine,
    testing::Values(
        Refused{"jump", "no action 'jump'"}, Refused{"Step", "no action 'Step'"},
        Refused{"step5", "no action 'step5'"}, Refused{"open", "needs PATH"},
        Refused{"quit now", "takes no argument"}, Refused{"step 0", "'0' is no whole number"},
        Refused{"step -1", "'-1'"}, Refused{"step 2.5", "'2.5'"}, Refused{"step 1 2", "'1 2'"},
        Refused{"pause yes", "neither on nor off"}, Refused{"display", "needs KEY"},
        Refused{"display colours", "no 'colours'"}, Refused{"mode fast", "no 'fast'"},
        Refused{"form-factors guess", "no 'guess'"}, Refused{"elements many", "'many'"},
        Refused{"hemicube 33", "not even"}, Refused{"hemicube 8", "'8'"},
        Refused{"error 1", "between 0 and 1"}, Refused{"exposure nan", "'nan'"},
        Refused{"size 100x100", "from 200"}, Refused{"size 640", "no size"},
        Refused{"size 640x480x2", "no size"}, Refused{"scale 9", "'9'"}, Refused{"camera 1,2,3", "no camera"},
        Refused{"camera 1,2,3,1,2,3", "the eye is at"}, Refused{"camera 0,0,0,1,0,0,0", "angle of view"},
        Refused{"plot time", "neither"}, Refused{"wait", "does not say what for"},
        Refused{"wait long", "does not say"}, Refused{"wait shots", "needs a number"},
        Refused{"wait shots -3", "needs a number"}, Refused{"wait seconds inf", "needs a number"},
        Refused{"wait seconds nan", "needs a number"}, Refused{"wait seconds 1s", "needs a number"},
        Refused{"wait converged 3", "takes no number"}, Refused{"wait shots 3 4", "says too much"}));

TEST(Script, TheGalleryShowsEveryDisplayModeAndPageOfTheLecture) {
  std::set<std::string> shown, pages;
  bool hemicube = false;
  for (const ScriptLine& line : readScript(std::string(UNSHOT_SOURCE_DIR) + "/docs/gallery.script")) {
    if (line.action == "display") shown.insert(line.argument);
    if (line.action == "lecture-page") pages.insert(line.argument);
    hemicube = hemicube || (line.action == "hemicube-view" && line.argument == "on");
  }
  EXPECT_TRUE(hemicube);
  for (const LecturePageRow& row : lecturePages())
    EXPECT_TRUE(pages.contains(std::string(row.info.key))) << row.info.key;
  for (const DisplayMode& mode : displayModes())
    EXPECT_TRUE(shown.contains(std::string(mode.info.key))) << mode.info.key;
}

TEST(Script, AFileThatCannotBeReadIsAnInputError) {
  const testing_support::TempFolder folder;
  for (const std::string& path : {folder / "missing.txt", folder.path().string()}) {
    try {
      readScript(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_EQ(error.where(), path);
    }
  }
  const std::string good = folder.write("good.txt", "step\nquit\n");
  EXPECT_EQ(readScript(good).size(), 2u);
}

}  // namespace
}  // namespace unshot
