#include "cli/gnuplot.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "base/parse.h"

namespace unshot {
namespace {

constexpr const char* kProgram = "gnuplot";
constexpr std::size_t kLongestMessage = 400;

std::string readAll(int descriptor) {
  std::string text;
  std::array<char, 512> buffer{};
  for (;;) {
    const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    if (text.size() < kLongestMessage) text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  return text;
}

/// The last line that says something.
std::string lastLine(const std::string& text) {
  std::string last;
  for (const std::string_view line : splitParts(text, '\n')) {
    if (line.find_first_not_of(" \t^") != std::string_view::npos) last = line;
  }
  return last;
}

[[noreturn]] void become(const char* folder, const char* script, int messages) {
  ::signal(SIGINT, SIG_IGN);
  const int nothing = ::open("/dev/null", O_RDWR);
  if (nothing >= 0) {
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(nothing, STDOUT_FILENO);
  }
  ::dup2(messages, STDERR_FILENO);
  if (::chdir(folder) == 0) ::execlp(kProgram, kProgram, script, static_cast<char*>(nullptr));
  ::_exit(127);
}

}  // namespace

bool hasGnuplot() {
  const char* path = std::getenv("PATH");
  if (!path) return false;
  for (const std::string_view folder : splitParts(path, ':')) {
    const std::string file = std::string(folder.empty() ? "." : folder) + "/" + kProgram;
    if (::access(file.c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::string runGnuplot(const std::filesystem::path& folder, const std::string& name) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return std::strerror(errno);
  const std::string place = folder.string();
  const pid_t child = ::fork();
  if (child == 0) become(place.c_str(), name.c_str(), ends[1]);
  const int error = errno;
  ::close(ends[1]);
  const std::string messages = child > 0 ? readAll(ends[0]) : "";
  ::close(ends[0]);
  if (child < 0) return std::strerror(error);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  const std::string line = lastLine(messages);
  return line.empty() ? "gnuplot failed" : "gnuplot: " + line;
}

}  // namespace unshot
