// `unshot report`: what is written, and how it ends.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "base/csv_table.h"
#include "support/run_program.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing_support::eventually;
using testing_support::ProgramResult;
using testing_support::ProgramRun;
using testing_support::runProgram;
using testing_support::TempFolder;
using testing_support::writeRoom;

ProgramResult report(const TempFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "report");
  arguments.insert(arguments.end(), {"--elements", "60", "--repeats", "1"});
  return runProgram(folder, arguments);
}

nlohmann::json jsonIn(const TempFolder& folder, const std::string& name) {
  return nlohmann::json::parse(folder.read(name));
}

TEST(Report, WritesTablesPlotsAndAPage) {
  const TempFolder folder;
  writeRoom(folder, testing_support::boxObj());
  const ProgramResult result = report(folder, {"room.obj", "--out", "r", "--modes", "gmres,southwell,gmres",
                                               "--reference", "--reference-seconds", "1"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("rows to 10 %"), HasSubstr("0.1 %"), HasSubstr("\n  southwell "),
                                HasSubstr("\n  gmres ")));
  const CsvTable curves = readCsv(folder / "r/room/curves.csv"), table = readCsv(folder / "r/room/table.csv");
  EXPECT_EQ(curves.header.size(), 16u);
  ASSERT_GT(curves.rows.size(), 10u);
  EXPECT_EQ(curves.rows.front()[0], "southwell");
  EXPECT_NEAR(*curves.number(0, *curves.column("solver_error")), 1, 1e-9);
  EXPECT_TRUE(curves.number(0, *curves.column("total_error")));
  EXPECT_EQ(table.rows.size(), 2u * 3 * 5);  // modes, errors, levels
  const nlohmann::json json = jsonIn(folder, "r/room/report.json");
  EXPECT_EQ(json["modes"].size(), 2u);
  EXPECT_EQ(json["modes"][1]["mode"], "gmres");
  EXPECT_EQ(json["exact"]["mode"], "direct");
  EXPECT_EQ(json["reference"]["points"], 256);
  EXPECT_FALSE(json["interrupted"]);
  const std::string html = folder.read("r/index.html");
  EXPECT_THAT(html, AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("data:image/png;base64,"),
                          HasSubstr("total error"), HasSubstr("</html>")));
  EXPECT_THAT(folder.read("r/room/error_over_rows.gp"), HasSubstr("'curves.csv'"));
  EXPECT_TRUE(std::filesystem::exists(folder / ("r/" + json["reference"]["file"].get<std::string>())));
  // Where gnuplot is there, plots are, too; else how to get them is said.
  if (result.err.find("gnuplot is not installed") == std::string::npos) {
    EXPECT_THAT(folder.read("r/room/error_over_time.png"), StartsWith("\x89PNG"));
    EXPECT_THAT(folder.read("r/room/error_over_time.svg"), HasSubstr("<svg"));
    EXPECT_THAT(html, HasSubstr("data:image/svg+xml;base64,"));
  }
}

TEST(Report, OneBadSceneDoesNotCostTheOthersAndNamesMayCollide) {
  const TempFolder folder;
  const std::string room = writeRoom(folder);
  folder.write("dark.obj", testing_support::roomObj("white", "white"));
  std::filesystem::create_directory(folder / "o");
  std::filesystem::copy(room, folder / "o/room.obj");
  std::filesystem::copy(folder / "room.mtl", folder / "o/room.mtl");
  const ProgramResult result = report(folder, {"dark.obj", "gone.obj", "room.obj", "o", "--out", "r",
                                               "--modes", "jacobi", "--no-pictures", "--sky", "0,0,0"});
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("dark.obj: the scene has no light"), HasSubstr("gone.obj")));
  EXPECT_TRUE(std::filesystem::exists(folder / "r/room/report.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "r/room-2/report.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "r/dark"));
  EXPECT_THAT(folder.read("r/index.html"), HasSubstr("id=\"room-2\""));
}

TEST(Report, AReferenceWithoutLightEndsWith3) {
  const TempFolder folder;
  writeRoom(folder);
  folder.write("dark.obj", testing_support::roomObj("white", "white"));
  const ProgramResult result = report(folder, {"dark.obj", "--out", "r", "--reference", "--sky", "0,0,0"});
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("unshot: "), HasSubstr("\n  try: ")));
}

TEST(Report, AFolderThatCannotBeWrittenEndsWith4BeforeTheWork) {
  const TempFolder folder;
  writeRoom(folder);
  folder.write("file", "x");
  for (const char* out : {"file", "file/inside", "/proc/none", "/proc"}) {
    const ProgramResult result = report(folder, {"room.obj", "--out", out});
    EXPECT_EQ(result.code, 4) << out;
    EXPECT_THAT(result.err, AllOf(HasSubstr(out), HasSubstr("\n  try: "))) << out;
    EXPECT_EQ(result.out, "");
  }
  EXPECT_EQ(folder.read("file"), "x");
}

TEST(Report, WithoutRoomForFormFactorsItIsSaidAndDone) {
  const TempFolder folder;
  writeRoom(folder);
  const ProgramResult result =
      report(folder, {"room.obj", "--out", "r", "--modes", "jacobi", "--keep", "0", "--no-pictures"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(folder.read("r/index.html"), HasSubstr("do not all fit"));
}

TEST(Report, InterruptedItEndsWith130AndKeepsWhatWasDone) {
  const TempFolder folder;
  writeRoom(folder);
  ProgramRun run(folder.path(), {"report", "room.obj", "--out", "r", "--modes", "southwell,jacobi",
                                 "--elements", "300", "--repeats", "99", "--no-pictures"});
  ASSERT_TRUE(
      eventually([&] { return run.errorsSoFar().find(", run ") != std::string::npos || !run.running(); }));
  run.send(SIGINT);
  const ProgramResult result = run.wait();
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("what was done by then is written"));
  EXPECT_THAT(result.out, HasSubstr("\n  jacobi "));
  const nlohmann::json json = jsonIn(folder, "r/room/report.json");
  EXPECT_TRUE(json["interrupted"]);
  EXPECT_GT(json["modes"][1]["points"].size(), 5u);
  EXPECT_THAT(folder.read("r/index.html"), HasSubstr("interrupted"));
}

}  // namespace
}  // namespace unshot
