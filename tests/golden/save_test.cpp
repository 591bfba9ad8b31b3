// Solves that end before their time and go on later: nothing is lost, whatever ends them.
#include <gmock/gmock.h>

#include <csignal>

#include "base/random.h"
#include "support/run_program.h"
#include "support/sanitized.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_support::boxObj;
using testing_support::eventually;
using testing_support::kSanitized;
using testing_support::ProgramResult;
using testing_support::ProgramRun;
using testing_support::runProgram;
using testing_support::TempFolder;
using testing_support::writeRoom;

const std::vector<std::string> kFineMesh = {"--form-factors", "rays",    "--elements",
                                            "6000",           "--error", "1e-4"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Two solves of one system, each with a bound below 1e-4.
void expectSameLight(const TempFolder& folder, const std::string& one, const std::string& other) {
  const ProgramResult compared = runProgram(folder, {"compare", one, other, "--tolerance", "0.0003"});
  EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
}

TEST(Save, AnInterruptedSolveGoesOnWhereItWas) {
  const TempFolder folder;
  writeRoom(folder, boxObj());
  ProgramRun run(folder.path(),
                 with({"solve", "room.obj", "--save", "s.unshot", "--save-every", "0.05"}, kFineMesh));
  ASSERT_TRUE(eventually([&] { return folder.has("s.unshot") || !run.running(); }));
  run.send(SIGTERM);
  const ProgramResult stopped = run.wait();
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_THAT(stopped.out, HasSubstr("written       s.unshot"));
  const ProgramResult resumed =
      runProgram(folder, {"solve", "room.obj", "--resume", "s.unshot", "--ply", "b.ply"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("goes on from s.unshot: "));
  ASSERT_EQ(runProgram(folder, with({"solve", "room.obj", "--ply", "a.ply"}, kFineMesh)).code, 0);
  expectSameLight(folder, "a.ply", "b.ply");
}

// A mesh that follows the light is cut again, with what was shot so far.
TEST(Save, ASmallerErrorTakesAFinerMesh) {
  const TempFolder folder;
  writeRoom(folder, boxObj());
  const std::vector<std::string> rays{"solve", "room.obj", "--form-factors", "rays"};
  ASSERT_EQ(runProgram(folder, with(rays, {"--error", "0.1", "--save", "s.unshot", "--ply", "c.ply"})).code,
            0);
  const ProgramResult finer =
      runProgram(folder, {"solve", "room.obj", "--resume", "s.unshot", "--error", "0.04", "--ply", "a.ply"});
  ASSERT_EQ(finer.code, 0) << finer.err;
  ASSERT_EQ(runProgram(folder, with(rays, {"--error", "0.04", "--ply", "b.ply"})).code, 0);
  // Both are within two fifths of the error of the same light.
  EXPECT_EQ(runProgram(folder, {"compare", "a.ply", "b.ply", "--tolerance", "0.032"}).code, 0);
  EXPECT_NE(folder.read("a.ply").size(), folder.read("c.ply").size()) << "another mesh";
  const ProgramResult late = runProgram(folder, {"solve", "room.obj", "--resume", "s.unshot", "--error",
                                                 "0.001", "--max-seconds", "0.001", "--ply", "c.ply"});
  EXPECT_EQ(late.code, 5) << late.err;
  EXPECT_TRUE(folder.has("c.ply"));
}

// Ended at random moments, also while it saves: what is there then is whole, and goes on to the same light.
TEST(Save, AKilledSolveGoesOnFromItsLastWholeFile) {
  const TempFolder folder;
  writeRoom(folder, boxObj());
  constexpr int kKills = 30;
  std::uint64_t state = 1;
  int killed = 0;
  for (int k = 0; k < kKills; ++k) {
    std::vector<std::string> words = {"solve", "room.obj", "--save", "s.unshot", "--save-every", "0.001"};
    words = k == 0 ? with(words, kFineMesh) : with(words, {"--resume", "s.unshot", "--error", "1e-4"});
    ProgramRun run(folder.path(), words);
    // From the moment that the first file is there: it may end at any time.
    if (k == 0) {
      ASSERT_TRUE(eventually([&] { return folder.has("s.unshot") || !run.running(); }));
    }
    const auto wait = static_cast<long>(5e7 + 1e8 * unitInterval(state = mixBits(state)));
    const timespec moment{0, wait};
    ::nanosleep(&moment, nullptr);
    run.send(SIGKILL);
    const ProgramResult result = run.wait();
    ASSERT_TRUE(result.code == 128 + SIGKILL || result.code == 0) << result.err;
    killed += result.code != 0;
    const ProgramResult looked =
        runProgram(folder, {"solve", "room.obj", "--resume", "s.unshot", "--max-shots", "1"});
    ASSERT_TRUE(looked.code == 0 || looked.code == 5) << "after kill " << k << ": " << looked.err;
  }
  EXPECT_GT(killed, kKills / 2);
  const ProgramResult resumed =
      runProgram(folder, {"solve", "room.obj", "--resume", "s.unshot", "--ply", "b.ply"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  ASSERT_EQ(runProgram(folder, with({"solve", "room.obj", "--ply", "a.ply"}, kFineMesh)).code, 0);
  expectSameLight(folder, "a.ply", "b.ply");
}

// A full disk costs the file of the solve, and nothing else.
TEST(Save, WhatCannotBeSavedStopsNothingElse) {
  const TempFolder folder;
  writeRoom(folder, boxObj());
  const ProgramResult result = runProgram(
      folder, with({"solve", "room.obj", "--save", "/dev/full", "--save-every", "0.05", "--ply", "a.ply"},
                   kFineMesh));
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, AllOf(HasSubstr("/dev/full: cannot be written: No space left on device"),
                                HasSubstr("the solve goes on, and is saved again later")));
  EXPECT_TRUE(folder.has("a.ply"));
}

// A disk that has room for the PLY file and not for the solve: what was saved before stays.
TEST(Save, AFileThatFindsNoRoomLeavesTheOneBefore) {
  const TempFolder folder;
  writeRoom(folder, boxObj());
  ASSERT_EQ(runProgram(folder, {"solve", "room.obj", "--save", "s.unshot"}).code, 0);
  const std::string before = folder.read("s.unshot");
  const ProgramResult result = runProgram(
      folder, with({"solve", "room.obj", "--save", "s.unshot", "--ply", "a.ply"}, kFineMesh), {0, 1'000'000});
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, HasSubstr("s.unshot: cannot be written: File too large"));
  EXPECT_EQ(folder.read("s.unshot"), before);
  EXPECT_TRUE(folder.has("a.ply"));
  EXPECT_EQ(folder.names().size(), 4u);  // no temporary file
}

// Memory that is used up while form factors are computed.
TEST(Save, MemoryThatIsUsedUpEndsTheSolveWithWhatItHas) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes terabytes of addresses";
  const TempFolder folder;
  writeRoom(folder, boxObj());
  const std::vector<std::string> large = {"--form-factors", "rays", "--elements", "60000", "--error", "1e-6"};
  const ProgramResult result = runProgram(
      folder, with({"solve", "room.obj", "--save", "s.unshot", "--ply", "a.ply"}, large), {400'000'000});
  EXPECT_EQ(result.code, 4);
  EXPECT_THAT(result.err, AllOf(HasSubstr("there is not enough memory"), HasSubstr("--keep")));
  EXPECT_TRUE(folder.has("a.ply"));
  const ProgramResult resumed =
      runProgram(folder, {"solve", "room.obj", "--resume", "s.unshot", "--keep", "50", "--max-shots", "10"},
                 {400'000'000});
  EXPECT_EQ(resumed.code, 5) << resumed.err;
}

/// A folder below `folder` that may be entered and read, not written.
std::filesystem::path readOnlyFolder(const TempFolder& folder) {
  namespace fs = std::filesystem;
  fs::permissions(folder.path(), fs::perms(0755));
  const fs::path closed = folder.path() / "closed";
  fs::create_directory(closed);
  std::ofstream(closed / "old") << "old";
  fs::permissions(closed, fs::perms(0555));
  return closed;
}

// Said before any work is done; of other files that were asked for none is written either.
TEST(Save, AFolderThatMayNotBeWrittenIsSaidAtOnce) {
  const TempFolder folder;
  writeRoom(folder, boxObj());
  const std::filesystem::path closed = readOnlyFolder(folder);
  for (const char* option : {"--save", "--png", "--report", "--ply", "--hdr"}) {
    for (const char* file : {"closed/new", "closed/old"}) {
      SCOPED_TRACE(std::string(option) + " " + file);
      const ProgramResult result =
          runProgram(folder, with({"solve", "room.obj", option, file}, kFineMesh), {.permissions = true});
      EXPECT_EQ(result.code, 4);
      EXPECT_EQ(result.err, "unshot: " + std::string(file) +
                                ": cannot be written: Permission denied\n  try: a folder that you may write "
                                "to\n");
      EXPECT_EQ(result.out, "");
    }
  }
  EXPECT_EQ(folder.names(), (std::set<std::string>{"room.mtl", "room.obj", "closed"}));
  EXPECT_EQ(folder.read("closed/old"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(closed), {}), 1);
  std::filesystem::permissions(closed, std::filesystem::perms(0755));  // to be removed by anybody
}

// The same while it solves: the solve goes on, what was saved stays, and the other files are written.
TEST(Save, AFolderThatIsClosedMeanwhileCostsNoOtherFile) {
  const TempFolder folder;
  writeRoom(folder, boxObj());
  const std::filesystem::path closed = readOnlyFolder(folder), open = folder.path() / "open";
  namespace fs = std::filesystem;
  fs::create_directory(open);
  for (const fs::path& path : {closed, open}) fs::permissions(path, fs::perms(0777));
  ProgramRun run(
      folder.path(),
      with({"solve", "room.obj", "--save", "closed/s.unshot", "--save-every", "0.01", "--ply", "open/a.ply"},
           kFineMesh),
      {.permissions = true});
  ASSERT_TRUE(eventually([&] { return folder.has("closed/s.unshot") || !run.running(); }));
  fs::permissions(closed, fs::perms(0555));
  const ProgramResult result = run.wait();
  EXPECT_EQ(result.code, 4) << result.err;
  EXPECT_THAT(result.err, HasSubstr("closed/s.unshot: cannot be written: Permission denied"));
  EXPECT_TRUE(folder.has("open/a.ply"));
  EXPECT_EQ(std::distance(fs::directory_iterator(closed), {}), 2) << "half a file is left";
  fs::permissions(closed, fs::perms(0755));
  EXPECT_EQ(runProgram(folder, {"solve", "room.obj", "--resume", "closed/s.unshot", "--max-shots", "1"}).code,
            5);
}

TEST(Save, AFileThatIsNoSavedSolveIsRefused) {
  const TempFolder folder;
  writeRoom(folder);
  folder.write("damaged", "unshot solve and then nothing that it could be");
  const ProgramResult other = runProgram(folder, {"solve", "room.obj", "--resume", "room.mtl"});
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr("room.mtl: is not a saved solve"));
  EXPECT_EQ(runProgram(folder, {"solve", "room.obj", "--resume", "damaged"}).code, 3);
  EXPECT_EQ(runProgram(folder, {"solve", "room.obj", "--resume", "missing"}).code, 3);
}

TEST(Save, WhatTheFileDecidesIsNotAskedForBesideIt) {
  const TempFolder folder;
  writeRoom(folder);
  ASSERT_EQ(runProgram(folder, {"solve", "room.obj", "--save", "s.unshot"}).code, 0);
  for (const char* option : {"--elements", "--seed"}) {
    const ProgramResult result =
        runProgram(folder, {"solve", "room.obj", "--resume", "s.unshot", option, "100"});
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, HasSubstr(option));
  }
  EXPECT_EQ(runProgram(folder, {"solve", "room.obj", "--save", "room.obj"}).code, 2);
  EXPECT_EQ(runProgram(folder, {"solve", "room.obj", "--ply", "s.unshot", "--resume", "s.unshot"}).code, 2);
  EXPECT_EQ(runProgram(folder, {"solve", "room.obj", "--save", "missing/s.unshot"}).code, 4);
}

}  // namespace
}  // namespace unshot
