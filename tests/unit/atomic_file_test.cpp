#include "base/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/error_of.h"
#include "support/temp_folder.h"

namespace {
int waits_for_the_disk = 0;
}

// In the place of the C library's.
extern "C" int fsync(int file) {
  ++waits_for_the_disk;
  return static_cast<int>(::syscall(SYS_fsync, file));
}

namespace unshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing_support::errorOf;
using testing_support::TempFolder;

TEST(AtomicFile, WritesAndReplacesAWholeFile) {
  const TempFolder folder;
  writeWholeFile(folder / "a.txt", "first");
  EXPECT_EQ(folder.read("a.txt"), "first");
  writeWholeFile(folder / "a.txt", "2nd");
  EXPECT_EQ(folder.read("a.txt"), "2nd");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, WaitsForTheDiskUnlessItMayBeLost) {
  const TempFolder folder;
  const int before = waits_for_the_disk;
  writeWholeFileSoon(folder / "a.txt", "first");
  writeWholeFileSoon(folder / "a.txt", "2nd");
  EXPECT_EQ(folder.read("a.txt"), "2nd");
  EXPECT_EQ(waits_for_the_disk, before);
  writeWholeFile(folder / "a.txt", "third");
  EXPECT_GT(waits_for_the_disk, before);
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, WritesIntoTheWorkingFolder) {
  const TempFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  checkWritable("plain.txt");
  writeWholeFile("plain.txt", "x");
  std::filesystem::current_path(before);
  EXPECT_THAT(folder.names(), ElementsAre("plain.txt"));
}

TEST(AtomicFile, KeepsThePermissionsOfTheFileItReplaces) {
  const TempFolder folder;
  const std::string file = folder.write("a.txt", "old");
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  writeWholeFile(file, "new");
  struct stat status {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
}

TEST(AtomicFile, ReplacesWhatALinkNamesAndKeepsTheLink) {
  const TempFolder folder;
  folder.write("target.txt", "old");
  std::filesystem::create_symlink("target.txt", folder / "link.txt");
  writeWholeFile(folder / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(folder.read("target.txt"), "new");
}

TEST(AtomicFile, WritesToADeviceWithoutReplacingIt) {
  checkWritable("/dev/null");
  writeWholeFile("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, CheckLeavesNothingBehindAndTouchesNothing) {
  const TempFolder folder;
  checkWritable(folder / "new.txt");
  EXPECT_THAT(folder.names(), ElementsAre());
  folder.write("old.txt", "kept");
  checkWritable(folder / "old.txt");
  EXPECT_EQ(folder.read("old.txt"), "kept");
  EXPECT_THAT(folder.names(), ElementsAre("old.txt"));
}

TEST(AtomicFile, SaysWhyAPlaceCannotBeWritten) {
  const TempFolder folder;
  const Error missing = errorOf([&] { checkWritable(folder / "no/such/file.png"); });
  EXPECT_EQ(missing.kind(), ErrorKind::kEnvironment);
  EXPECT_THAT(missing.what(), HasSubstr("does not exist"));
  EXPECT_EQ(missing.where(), folder / "no/such/file.png");
  EXPECT_THAT(missing.advice(), HasSubstr("mkdir -p"));

  EXPECT_THAT(errorOf([&] { checkWritable(folder.path()); }).what(), HasSubstr("it is a folder"));
  EXPECT_THAT(errorOf([&] { writeWholeFile(folder.path(), "x"); }).what(), HasSubstr("it is a folder"));
  const std::string file = folder.write("file", "x");
  EXPECT_THAT(errorOf([&] { checkWritable(file + "/inside"); }).what(), HasSubstr("not a folder"));
  EXPECT_THAT(errorOf([&] { checkWritable(""); }).what(), HasSubstr("empty"));
  EXPECT_THAT(errorOf([&] { checkWritable(folder / std::string(300, 'n')); }).kind(),
              ErrorKind::kEnvironment);
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

TEST(AtomicFile, AProgramThatEndsWhileItWritesLeavesTheOldFileAlone) {
  const TempFolder folder;
  folder.write("a.txt", "old");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    // Ends the child in the middle of the file.
    const rlimit smaller{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &smaller);
    ::signal(SIGXFSZ, SIG_DFL);
    writeWholeFile(folder / "a.txt", std::string(100'000, 'x'));
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGXFSZ);
  EXPECT_EQ(folder.read("a.txt"), "old");
  const int unnamed = ::open(folder.path().c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0600);
  if (unnamed < 0) return;  // a file system that knows only files with names
  ::close(unnamed);
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, KeepsTheOldFileWhereTheDiskIsFull) {
  EXPECT_THAT(errorOf([] { writeWholeFile("/dev/full", "x"); }).what(), HasSubstr("No space left"));
}

}  // namespace
}  // namespace unshot
