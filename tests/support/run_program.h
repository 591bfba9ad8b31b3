// Runs the program as a user does.
#pragma once

#include <fcntl.h>
#include <grp.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <functional>
#include <string>
#include <vector>

#include "support/temp_folder.h"

namespace unshot::testing_support {

struct ProgramResult {
  int code = -1;  ///< exit code; 128 + signal where one ended it
  std::string out, err;
};

/// What a run may take of the machine [bytes]; 0: as much as it likes.
struct ProgramLimits {
  rlim_t memory = 0, file_size = 0;
  /// Permissions hold for the run, as they do for anybody but root: tests that run as root run it as
  /// `nobody`.
  bool permissions = false;
};

/// A run of UNSHOT_PROGRAM in `folder`.
class ProgramRun {
 public:
  ProgramRun(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
             const ProgramLimits& limits = {}) {
    std::vector<std::string> words = {UNSHOT_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = streams_ / "out", err = streams_ / "err";
    pid_ = ::fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ == 0) {
      redirect("/dev/null", O_RDONLY, STDIN_FILENO);
      redirect(out.c_str(), O_WRONLY | O_CREAT, STDOUT_FILENO);
      redirect(err.c_str(), O_WRONLY | O_CREAT, STDERR_FILENO);
      // What a viewer remembers is none of other runs' business.
      ::setenv("XDG_STATE_HOME", (streams_ / "state").c_str(), 1);
      limit(RLIMIT_AS, limits.memory);
      limit(RLIMIT_FSIZE, limits.file_size);
      // Opened as who runs the tests: others may not reach it by its path.
      const int program = ::open(argv[0], O_RDONLY | O_CLOEXEC);
      if (::chdir(folder.c_str()) != 0) ::_exit(124);
      if (limits.permissions && ::geteuid() == 0) becomeNobody();
      ::fexecve(program, argv.data(), environ);
      ::_exit(127);
    }
  }
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;

  void send(int signal) const { ::kill(pid_, signal); }
  /// What it has written to standard error so far.
  std::string errorsSoFar() const { return streams_.read("err"); }
  bool running() {
    if (status_ < 0 && ::waitpid(pid_, &status_, WNOHANG) == 0) status_ = -1;
    return status_ < 0;
  }
  ProgramResult wait() {
    if (status_ < 0) ::waitpid(pid_, &status_, 0);
    const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
    return {code, streams_.read("out"), streams_.read("err")};
  }

 private:
  static void limit(__rlimit_resource_t resource, rlim_t bytes) {
    const rlimit both{bytes, bytes};
    if (bytes > 0 && ::setrlimit(resource, &both) != 0) ::_exit(125);
  }
  static void becomeNobody() {
    constexpr uid_t kNobody = 65534;
    if (::setgroups(0, nullptr) != 0 || ::setgid(kNobody) != 0 || ::setuid(kNobody) != 0) ::_exit(123);
  }
  static void redirect(const char* file, int flags, int target) {
    const int descriptor = ::open(file, flags, 0600);
    if (descriptor < 0 || ::dup2(descriptor, target) < 0) ::_exit(126);
  }

  TempFolder streams_;
  pid_t pid_ = -1;
  int status_ = -1;
};

/// Arguments and further ones after them.
inline std::vector<std::string> with(std::vector<std::string> arguments,
                                     const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

inline ProgramResult runProgram(const TempFolder& folder, const std::vector<std::string>& arguments,
                                const ProgramLimits& limits = {}) {
  return ProgramRun(folder.path(), arguments, limits).wait();
}

/// Waits until `ready`, looking again every 5 ms; false after two minutes.
template <class Ready>
bool eventually(Ready ready) {
  for (int k = 0; k < 24000; ++k) {
    if (ready()) return true;
    const timespec pause{0, 5'000'000};
    ::nanosleep(&pause, nullptr);
  }
  return false;
}

}  // namespace unshot::testing_support
