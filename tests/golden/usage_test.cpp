// What the program says about itself, and about words that it does not understand: exit codes 0 and 2.
#include <gmock/gmock.h>

#include <cstdlib>

#include "support/run_program.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing_support::ProgramResult;
using testing_support::runProgram;
using testing_support::TempFolder;

TEST(Help, TellsAboutEveryCommand) {
  const TempFolder folder;
  const ProgramResult result = runProgram(folder, {"--help"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, IsEmpty());
  for (const char* command :
       {"view", "solve", "report", "check", "compare", "list", "selftest", "Exit codes"}) {
    EXPECT_THAT(result.out, HasSubstr(command));
  }
  for (const char* command : {"view", "solve", "report", "check", "compare", "list", "selftest"}) {
    const ProgramResult help = runProgram(folder, {command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, HasSubstr(std::string("Usage: unshot ") + command));
  }
}

TEST(Help, NamesEveryOptionOfSolve) {
  const ProgramResult result = runProgram(TempFolder(), {"solve", "--help"});
  for (const char* option :
       {"--mode",     "--form-factors", "--gl",         "--elements", "--element-size", "--emit",
        "--error",    "--max-seconds",  "--max-shots",  "--seed",     "--png",          "--hdr",
        "--size",     "--eye",          "--at",         "--up",       "--fov",          "--display",
        "--exposure", "--ambient",      "--ply",        "--probe",    "--probe-out",    "--report",
        "--hemicube", "--keep",         "--shader-dir", "--bounces",  "--sky"}) {
    EXPECT_THAT(result.out, HasSubstr(std::string("  ") + option + " "));
  }
}

TEST(Version, IsPrinted) {
  const ProgramResult result = runProgram(TempFolder(), {"--version"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "unshot " UNSHOT_VERSION "\n");
}

TEST(List, NamesEveryTable) {
  const ProgramResult result = runProgram(TempFolder(), {"list"});
  EXPECT_EQ(result.code, 0);
  for (const char* key : {"southwell", "jacobi", "hemicube", "radiosity", "--png", "--report", "osmesa",
                          "egl", "light-in-solid"}) {
    EXPECT_THAT(result.out, HasSubstr(std::string("  ") + key));
  }
}

TEST(View, SaysHowToSolveWithoutADisplay) {
  const TempFolder folder;
  testing_support::writeRoom(folder);
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"view"}, {"view", "room.obj"}, {"room.obj"}}) {
    const ProgramResult result = runProgram(folder, arguments);
    EXPECT_EQ(result.code, 4);
    EXPECT_THAT(result.err, HasSubstr("unshot solve "));
    EXPECT_THAT(result.err, HasSubstr("--png"));
  }
}

TEST(AppRun, RefusesASecondArgument) {
  const TempFolder folder;
  const std::string command =
      "'" UNSHOT_SOURCE_DIR "/app/run' one.obj two >'" + folder / "out" + "' 2>'" + folder / "err" + "'";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_THAT(folder.read("out"), IsEmpty());
  EXPECT_THAT(folder.read("err"), StartsWith("unshot: 'two' is one argument too many\n  try: "));
}

struct UsageCase {
  std::vector<std::string> arguments;
  std::string message;
};

void PrintTo(const UsageCase& c, std::ostream* out) { *out << testing::PrintToString(c.arguments); }

class Usage : public testing::TestWithParam<UsageCase> {};

TEST_P(Usage, IsRefusedWithOneMessage) {
  const TempFolder folder;
  testing_support::writeRoom(folder);
  folder.write("points.csv", "0.5,0,0.5,0,1,0\n");
  const auto before = folder.names();
  const ProgramResult result = runProgram(folder, GetParam().arguments);
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, StartsWith("unshot: "));
  EXPECT_THAT(result.err, HasSubstr(GetParam().message));
  EXPECT_THAT(result.err, HasSubstr("\n  try: "));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Words, Usage,
    testing::Values(
        UsageCase{{"sovle", "room.obj"}, "no command 'sovle'"}, UsageCase{{"solve"}, "SCENE.obj is missing"},
        UsageCase{{"solve", "room.obj", "--frobnicate"}, "no option '--frobnicate'"},
        UsageCase{{"room.obj", "--frobnicate", "3"}, "no option '--frobnicate'"},
        UsageCase{{"check", "room.obj", "-x"}, "no option '-x'"},
        UsageCase{{"solve", "room.obj", "other.obj"}, "'other.obj' is one argument too many"},
        UsageCase{{"solve", "room.obj", "--png"}, "--png needs a value"},
        UsageCase{{"solve", "room.obj", "--png", "--hdr", "a.hdr"}, "a file name is missing before --hdr"},
        UsageCase{{"solve", "room.obj", "--png", "a.png", "--png", "b.png"}, "--png may be given only once"},
        UsageCase{{"compare", "a.png"}, "B is missing"}));

INSTANTIATE_TEST_SUITE_P(
    Values, Usage,
    testing::Values(
        UsageCase{{"solve", "room.obj", "--elements", "many"}, "--elements: 'many' is not a whole number"},
        UsageCase{{"solve", "room.obj", "--elements", "-5"}, "--elements: '-5' is not a whole number"},
        UsageCase{{"solve", "room.obj", "--elements", "0"}, "--elements: 0 is not from 1 to 20,000,000"},
        UsageCase{{"solve", "room.obj", "--element-size", "0"}, "--element-size: 0 is not above 0"},
        UsageCase{{"solve", "room.obj", "--element-size", "nan"}, "'nan' is not a number"},
        UsageCase{{"solve", "room.obj", "--element-size", "inf"}, "--element-size: inf is not"},
        UsageCase{{"solve", "room.obj", "--error", "2"}, "--error: 2 is not above 0 and below 1"},
        UsageCase{{"solve", "room.obj", "--error", "1"}, "--error: 1 is not above 0 and below 1"},
        UsageCase{{"solve", "room.obj", "--error", "0"}, "--error: 0 is not above 0 and below 1"},
        UsageCase{{"solve", "room.obj", "--error", "nan"}, "--error: nan is not above 0 and below 1"},
        UsageCase{{"solve", "room.obj", "--max-seconds", "0"}, "--max-seconds: 0 is not above 0"},
        UsageCase{{"solve", "room.obj", "--max-shots", "0"}, "--max-shots: 0 is not at least 1"},
        UsageCase{{"solve", "room.obj", "--bounces", "0"}, "--bounces: 0 is not at least 1"},
        UsageCase{{"solve", "room.obj", "--seed", "1.5"}, "--seed: '1.5' is not a whole number"},
        UsageCase{{"solve", "room.obj", "--hemicube", "33"}, "--hemicube: 33 is not even"},
        UsageCase{{"solve", "room.obj", "--hemicube", "8"}, "--hemicube: 8 is not from 16 to 4,096"},
        UsageCase{{"solve", "room.obj", "--emit", "back"}, "--emit: 'back' is neither both nor front"},
        UsageCase{{"solve", "room.obj", "--sky", "1,2"}, "--sky: '1,2' is not r,g,b"},
        UsageCase{{"solve", "room.obj", "--sky", "1,-1,1"}, "--sky: '1,-1,1' is not r,g,b"},
        UsageCase{{"solve", "room.obj", "--size", "800"}, "--size: '800' is not WIDTHxHEIGHT"},
        UsageCase{{"solve", "room.obj", "--size", "0x600"}, "--size: '0x600' is not from 1x1"},
        UsageCase{{"solve", "room.obj", "--eye", "1,2"}, "--eye: '1,2' is not x,y,z"},
        UsageCase{{"solve", "room.obj", "--at", "1,2,inf"}, "--at: '1,2,inf' is not finite"},
        UsageCase{{"solve", "room.obj", "--up", "0,0,0"}, "--up has no direction"},
        UsageCase{{"solve", "room.obj", "--fov", "180"}, "--fov: 180 is not from 1 to 170 degrees"},
        UsageCase{{"solve", "room.obj", "--mode", "magic"}, "it is one of auto, southwell"},
        UsageCase{{"solve", "room.obj", "--form-factors", "magic"}, "it is one of auto, hemicube"},
        UsageCase{{"solve", "room.obj", "--display", "magic"}, "it is one of radiosity"},
        UsageCase{{"solve", "room.obj", "--gl", "magic"}, "it is one of auto, osmesa"},
        UsageCase{{"solve", "room.obj", "--gl", "glfw"}, "'glfw' opens a window: only `unshot view` has one"},
        UsageCase{{"report", "room.obj", "--out", "r", "--modes", "jacobi,magic"}, "there is no 'magic'"},
        UsageCase{{"report", "room.obj", "--out", "r", "--modes", ""}, "there is no ''"},
        UsageCase{{"report", "room.obj"}, "--out is missing"},
        UsageCase{{"report", "--out", "r"}, "SCENE.obj is missing"},
        UsageCase{{"report", "room.obj", "--out", "r", "--repeats", "0"}, "--repeats: 0 is not from 1"},
        UsageCase{{"report", "room.obj", "--out", "r", "--mode", "jacobi"}, "no option '--mode'"},
        UsageCase{{"selftest", "--case", "magic"}, "there is no 'magic'; it is one of all, furnace-0.5"},
        UsageCase{{"selftest", "--mode", "magic"}, "there is no 'magic'"},
        UsageCase{{"selftest", "room.obj"}, "'room.obj' is one argument too many"},
        UsageCase{{"compare", "a", "b", "--tolerance", "-1"}, "--tolerance: -1 is not at least 0"}));

INSTANTIATE_TEST_SUITE_P(
    Combinations, Usage,
    testing::Values(
        UsageCase{{"solve", "room.obj", "--elements", "9", "--element-size", "1"},
                  "cannot be given together"},
        UsageCase{{"solve", "room.obj", "--elements", "9", "--max-elements", "99"},
                  "cannot be given together"},
        UsageCase{{"solve", "room.obj", "--probe", "points.csv"}, "--probe needs --probe-out beside it"},
        UsageCase{{"solve", "room.obj", "--probe-out", "out.csv"}, "--probe-out needs --probe beside it"},
        UsageCase{{"solve", "room.obj", "--eye", "1,2,3", "--at", "1,2,3"},
                  "--eye and --at are the same point"},
        UsageCase{{"solve", "room.obj", "--eye", "0,0,0", "--at", "0,2,0", "--up", "0,1,0"},
                  "along the line of sight"},
        UsageCase{{"solve", "room.obj", "--ply", "room.obj"}, "--ply would replace the input room.obj"},
        UsageCase{{"solve", "room.obj", "--ply", "./room.obj"}, "--ply would replace the input"},
        UsageCase{{"solve", "room.obj", "--probe", "points.csv", "--probe-out", "points.csv"},
                  "would replace the input"},
        UsageCase{{"solve", "room.obj", "--png", "a", "--report", "./a"}, "name the same file"}));

}  // namespace
}  // namespace unshot
