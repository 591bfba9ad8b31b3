// Solving for real: what is written, how it ends, and that nothing is lost on the way.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "support/run_program.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using testing_support::eventually;
using testing_support::ProgramResult;
using testing_support::ProgramRun;
using testing_support::runProgram;
using testing_support::TempFolder;
using testing_support::writeRoom;

TEST(Solve, WritesEverythingAskedFor) {
  const TempFolder folder;
  writeRoom(folder, testing_support::boxObj());
  folder.write("points.csv", "# a comment\nx,y,z,nx,ny,nz\n0.1,0,0.1,0,1,0\n0.5,0.5,0.5,0,1,0\n");
  const ProgramResult result = runProgram(
      folder, {"solve", "room.obj", "--elements", "300", "--png", "p.png", "--hdr", "p.hdr", "--ply", "p.ply",
               "--report", "p.json", "--probe", "points.csv", "--probe-out", "p.csv", "--size", "64x48"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(folder.names(), ElementsAre("p.csv", "p.hdr", "p.json", "p.ply", "p.png", "points.csv",
                                          "room.mtl", "room.obj"));
  EXPECT_THAT(folder.read("p.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(folder.read("p.hdr"), StartsWith("#?RADIANCE"));
  EXPECT_THAT(folder.read("p.ply"), StartsWith("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_THAT(folder.read("p.csv"), AllOf(StartsWith("x,y,z,nx,ny,nz,B_r,B_g,B_b\n0.1,0,0.1,0,1,0,"),
                                          HasSubstr("\n0.5,0.5,0.5,0,1,0,,,\n")));
  EXPECT_THAT(result.err, HasSubstr("warning: 1 of 2 probes lie on no surface"));
  for (const char* label :
       {"scene ", "mesh ", "method ", "renderer ", "shots ", "unshot ", "time ", "stopped by ", "written "}) {
    EXPECT_THAT(result.out, HasSubstr(label));
  }
  const nlohmann::json report = nlohmann::json::parse(folder.read("p.json"));
  EXPECT_THAT(report["stopped_by"], testing::StartsWith("solver_"));
  EXPECT_NEAR(report["counts"]["elements"].get<double>(), 300, 30);
  const auto& errors = report["errors"];
  EXPECT_LE(errors[report["stopped_by"].get<std::string>()].get<double>(), 0.01);
  EXPECT_TRUE(report["gl"]["renderer"].is_string());
  EXPECT_GT(report["history"].size(), 0u);
  const double emitted = report["energy"]["emitted"].get<double>();
  EXPECT_NEAR(report["energy"]["residual"].get<double>(), 0, 1e-9 * emitted);
}

TEST(Solve, WithoutOutputsPrintsTheSummary) {
  const TempFolder folder;
  writeRoom(folder);
  const auto before = folder.names();
  const ProgramResult result = runProgram(folder, {"solve", "room.obj", "--elements", "60"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("stopped by"));
  EXPECT_EQ(folder.names(), before);
}

// What does not fit into the memory allowed is computed again: the same light, but for where the error's
// bound (which has no room either) ends the solve. That is said once, with how much would do.
TEST(Solve, FormFactorsThatDoNotFitAreSaidAndTheResultIsWritten) {
  const TempFolder folder;
  writeRoom(folder);
  const auto solve = [&](const char* megabytes, const char* file) {
    return runProgram(folder, {"solve", "room.obj", "--elements", "100", "--mode", "jacobi", "--keep",
                               megabytes, "--ply", file});
  };
  const ProgramResult roomy = solve("100", "roomy.ply"), cramped = solve("0", "cramped.ply");
  EXPECT_EQ(roomy.code, 0) << roomy.err;
  EXPECT_EQ(cramped.code, 0) << cramped.err;
  EXPECT_THAT(roomy.err, Not(HasSubstr("form factors take")));
  EXPECT_THAT(cramped.err, HasSubstr("form factors take about 1 MB and may take 0 MB"));
  EXPECT_THAT(cramped.err, HasSubstr("try: --keep 1, "));
  const ProgramResult same =
      runProgram(folder, {"compare", "roomy.ply", "cramped.ply", "--tolerance", "0.02"});
  EXPECT_EQ(same.code, 0) << same.out;
}

TEST(Solve, AResolutionForNoHemicubesIsSaid) {
  const TempFolder folder;
  writeRoom(folder);
  for (const std::string method : {"rays", "hemicube", "hemicube-visibility"}) {
    const ProgramResult result = runProgram(
        folder, {"solve", "room.obj", "--elements", "60", "--hemicube", "32", "--form-factors", method});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err.find("take no hemicubes") != std::string::npos, method == "rays") << result.err;
  }
}

// A cluttered pair of rooms, lit through a door, has shadows that so coarse a mesh does not follow; an empty
// room asks for no word.
TEST(Solve, SaysWhereTheErrorAskedForIsMissed) {
  const TempFolder folder;
  writeRoom(folder);
  const ProgramResult rooms =
      runProgram(folder, {"solve", UNSHOT_SOURCE_DIR "/assets/two_rooms.obj", "--error", "0.06"});
  const ProgramResult room = runProgram(folder, {"solve", "room.obj"});
  EXPECT_EQ(rooms.code, 0);
  EXPECT_EQ(room.code, 0);
  EXPECT_THAT(rooms.err, HasSubstr("was asked for: some light changes faster than the mesh"));
  EXPECT_THAT(room.err, Not(HasSubstr("was asked for")));
}

// A lamp a ten-thousandth below the ceiling shines upwards: all light goes to and fro in the gap, between
// reflectances of 0.5 and 0.7, where B of the ceiling is 0.7 * 3 / (1 - 0.35). (Without the slivers along the
// lamp's outline it was 8 % less.)
TEST(Solve, ALampThatAllButTouchesTheCeilingLightsIt) {
  const TempFolder folder;
  folder.write("room.mtl", testing_support::kMaterials);
  folder.write("room.obj", testing_support::roomObj("white", "white") +
                               "usemtl light\nv 0.42 0.9999 0.42\nv 0.63 0.9999 0.42\nv 0.63 0.9999 0.61\n"
                               "v 0.42 0.9999 0.61\nf 12 11 10 9\n");
  folder.write("points.csv", "0.52,1,0.52,0,-1,0\n0.45,1,0.45,0,-1,0\n0.55,1,0.6,0,-1,0\n");
  const ProgramResult result = runProgram(
      folder, {"solve", "room.obj", "--emit", "front", "--probe", "points.csv", "--probe-out", "values.csv"});
  EXPECT_EQ(result.code, 0);
  std::istringstream lines(folder.read("values.csv"));
  std::string line;
  std::getline(lines, line);
  int points = 0;
  for (; std::getline(lines, line); ++points) {
    double v[7];
    ASSERT_EQ(
        std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", v, v + 1, v + 2, v + 3, v + 4, v + 5, v + 6),
        7);
    EXPECT_NEAR(v[6], 0.7 * 3 / (1 - 0.35), 0.02) << line;
  }
  EXPECT_EQ(points, 3);
}

TEST(Solve, TheSameTwiceIsTheSame) {
  const TempFolder folder;
  writeRoom(folder);
  for (const char* file : {"a.ply", "b.ply"}) {
    ASSERT_EQ(runProgram(folder, {"solve", "room.obj", "--elements", "100", "--ply", file}).code, 0);
  }
  EXPECT_EQ(folder.read("a.ply"), folder.read("b.ply"));
}

TEST(Solve, AtALimitEndsWith5AndWritesTheResult) {
  const TempFolder folder;
  writeRoom(folder);
  const ProgramResult result =
      runProgram(folder, {"solve", "room.obj", "--elements", "200", "--error", "1e-6", "--max-shots", "3",
                          "--ply", "p.ply", "--report", "p.json"});
  EXPECT_EQ(result.code, 5);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("unshot: not converged"), HasSubstr("max_shots"), HasSubstr("\n  try: ")));
  EXPECT_EQ(nlohmann::json::parse(folder.read("p.json"))["stopped_by"], "max_shots");
  EXPECT_THAT(folder.read("p.ply"), StartsWith("ply\n"));
}

TEST(Solve, OutputThatCannotBeWrittenIsFoundBeforeTheSolve) {
  const TempFolder folder;
  writeRoom(folder);
  std::filesystem::create_directory(folder / "sub");
  folder.write("old.png", "old");
  const auto before = folder.names();
  for (const char* bad : {"no/such/folder.png", "sub", "sub/", "old.png/inside.png"}) {
    const ProgramResult result = runProgram(folder, {"solve", "room.obj", "--png", bad});
    EXPECT_EQ(result.code, 4) << bad;
    EXPECT_THAT(result.err, AllOf(StartsWith(std::string("unshot: ") + bad), HasSubstr("\n  try: "))) << bad;
    EXPECT_THAT(result.out, IsEmpty()) << "the solve ran";
  }
  EXPECT_EQ(folder.names(), before);
  EXPECT_EQ(folder.read("old.png"), "old");
}

TEST(Solve, AnOutputThatFailsLateDoesNotCostTheOthers) {
  const TempFolder folder;
  writeRoom(folder);
  // A full disk: it shows only when written to. Devices are written after files, the PLY before the report.
  for (const std::string report : {"p.json", "/dev/null"}) {
    const ProgramResult result = runProgram(
        folder, {"solve", "room.obj", "--elements", "60", "--ply", "/dev/full", "--report", report});
    EXPECT_EQ(result.code, 4);
    EXPECT_THAT(result.err, AllOf(HasSubstr("unshot: /dev/full: cannot be written"), HasSubstr("\n  try: ")));
    EXPECT_THAT(result.out, HasSubstr("written       " + report));
  }
  EXPECT_THAT(folder.read("p.json"), StartsWith("{"));
}

class SolveInterrupted : public testing::TestWithParam<int> {};

TEST_P(SolveInterrupted, EndsWith130AndWritesTheResult) {
  const TempFolder folder;
  writeRoom(folder, testing_support::boxObj());
  ProgramRun run(folder.path(), {"solve", "room.obj", "--elements", "40000", "--error", "1e-12", "--ply",
                                 "p.ply", "--report", "p.json"});
  ASSERT_TRUE(
      eventually([&] { return run.errorsSoFar().find("solving: ") != std::string::npos || !run.running(); }));
  run.send(GetParam());
  const ProgramResult result = run.wait();
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  EXPECT_EQ(nlohmann::json::parse(folder.read("p.json"))["stopped_by"], "interrupted");
  EXPECT_THAT(folder.names(), ElementsAre("p.json", "p.ply", "room.mtl", "room.obj"));
}

INSTANTIATE_TEST_SUITE_P(Signals, SolveInterrupted, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST(SolveInterruptedEarly, EndsWith130AfterMeshingAndWritesNothing) {
  const TempFolder folder;
  writeRoom(folder, testing_support::boxObj() + "f 1 1 2\n");
  const auto before = folder.names();
  ProgramRun run(folder.path(), {"solve", "room.obj", "--elements", "300000", "--ply", "p.ply"});
  // What is doubtful about the file is said before meshing, which takes a while.
  ASSERT_TRUE(
      eventually([&] { return run.errorsSoFar().find("  try: ") != std::string::npos || !run.running(); }));
  run.send(SIGINT);
  const ProgramResult result = run.wait();
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("unshot: interrupted before the solve began; there is no result"));
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_EQ(folder.names(), before);
}

/// A solve that has ended and waits for a reader of its pipe; the report is written by then.
class SolveWriting : public testing::Test {
 protected:
  SolveWriting() {
    writeRoom(folder_);
    EXPECT_EQ(::mkfifo((folder_ / "p.ply").c_str(), 0600), 0);
    run_.emplace(folder_.path(), std::vector<std::string>{"solve", "room.obj", "--elements", "60", "--ply",
                                                          "p.ply", "--report", "p.json"});
    EXPECT_TRUE(eventually([&] { return folder_.names().count("p.json") > 0 || !run_->running(); }));
  }
  TempFolder folder_;
  std::optional<ProgramRun> run_;
};

TEST_F(SolveWriting, InterruptedOnceWritesAllAndEndsWith130) {
  run_->send(SIGINT);
  EXPECT_THAT(folder_.read("p.ply"), StartsWith("ply\n"));
  const ProgramResult result = run_->wait();
  EXPECT_EQ(result.code, 130);
  EXPECT_THAT(result.err, HasSubstr("unshot: interrupted after the solve had ended (solver_"));
  EXPECT_THAT(result.out, HasSubstr("p.ply"));
  EXPECT_THAT(nlohmann::json::parse(folder_.read("p.json"))["stopped_by"], testing::StartsWith("solver_"));
}

TEST_F(SolveWriting, InterruptedTwiceEndsAtOnce) {
  // Two signals of a kind may arrive as one.
  EXPECT_TRUE(eventually([&] {
    run_->send(SIGINT);
    run_->send(SIGTERM);
    return !run_->running();
  }));
  EXPECT_GE(run_->wait().code, 128);
  EXPECT_THAT(folder_.names(), ElementsAre("p.json", "p.ply", "room.mtl", "room.obj"));
  EXPECT_THAT(folder_.read("p.json"), StartsWith("{"));
}

TEST(Solve, ARoomThatReflectsAllHasNoSolutionAndIsWrittenAllTheSame) {
  const TempFolder folder;
  folder.write("room.mtl", "newmtl white\nKd 1 1 1\nnewmtl light\nKd 1 1 1\nKe 3 3 3\n");
  folder.write("room.obj", testing_support::roomObj());
  const ProgramResult result =
      runProgram(folder, {"solve", "room.obj", "--elements", "24", "--report", "p.json"});
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("no finite solution"), HasSubstr("\n  try: a reflectance (Kd) below 1"),
                    HasSubstr("--max-shots"), HasSubstr("--bounces")));
  EXPECT_EQ(runProgram(folder, {"solve", "room.obj", "--elements", "24", "--bounces", "3"}).code, 0);
  EXPECT_THAT(nlohmann::json::parse(folder.read("p.json"))["stopped_by"].get<std::string>(),
              StartsWith("no finite solution"));
  EXPECT_EQ(runProgram(folder, {"solve", "room.obj", "--elements", "24", "--max-shots", "100"}).code, 5);
}

TEST(Solve, SaysWhereANameEndsAsIfTheFileHeldSomethingElse) {
  const TempFolder folder;
  writeRoom(folder);
  const ProgramResult result =
      runProgram(folder, {"solve", "room.obj", "--elements", "60", "--ply", "p.obj", "--report", "P.JSON"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "p.obj: note: written as PLY solution all the same: --ply writes nothing else\n");
  EXPECT_THAT(folder.read("p.obj"), StartsWith("ply\n"));
}

// The C library says on standard error what is loaded.
TEST(Check, NeedsNoOpenGl) {
  const TempFolder folder;
  writeRoom(folder, testing_support::boxObj());
  ::setenv("LD_DEBUG", "files", 1);
  const ProgramResult result = runProgram(folder, {"check", "room.obj"});
  ::unsetenv("LD_DEBUG");
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, HasSubstr("libc.so"));
  EXPECT_THAT(result.err, testing::Not(HasSubstr("libOSMesa")));
  EXPECT_THAT(result.err, testing::Not(HasSubstr("libEGL")));
  EXPECT_THAT(result.out, HasSubstr("Nothing is wrong"));
}

TEST(Check, PrintsFiguresAndJson) {
  const TempFolder folder;
  writeRoom(folder);
  const ProgramResult text = runProgram(folder, {"check", "room.obj"});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.out, AllOf(HasSubstr("faces"), HasSubstr("closed"), HasSubstr("yes"),
                              HasSubstr("Nothing is wrong")));
  const ProgramResult json = runProgram(folder, {"check", "room.obj", "--json"});
  EXPECT_EQ(json.code, 0);
  const nlohmann::json figures = nlohmann::json::parse(json.out);
  EXPECT_EQ(figures["scene"]["faces"], 6);
  EXPECT_EQ(figures["scene"]["closed"], true);
  EXPECT_TRUE(figures["plan"].is_array());
}

}  // namespace
}  // namespace unshot
