#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstring>
#include <string>
#include <utility>

#include "base/error.h"

namespace unshot {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& why, const std::string& advice) {
  throw Error(ErrorKind::kEnvironment, "cannot be written: " + why, path.string(), advice);
}

std::string adviceFor(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "make room on the disk, or write elsewhere";
    case EACCES:
    case EPERM:
    case EROFS:
      return "a folder that you may write to";
    case ENAMETOOLONG:
      return "a shorter name";
    default:
      return "another file name or folder";
  }
}

[[noreturn]] void failWith(const fs::path& path, int error) {
  fail(path, std::strerror(error), adviceFor(error));
}

struct Closing {
  int descriptor;
  ~Closing() { ::close(descriptor); }
};

/// A new file in the folder of `target`, without a name where the file system can do that, so that nothing is
/// left of it however the program ends. Removes it unless it has been put in the target's place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    descriptor_ = ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
    if (descriptor_ >= 0 && ::access(procPath(descriptor_).c_str(), F_OK) == 0) {
      unnamed_ = true;
      return;
    }
    if (descriptor_ >= 0) ::close(descriptor_);
    takeName([&](const char* name) {
      descriptor_ = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      return descriptor_ >= 0;
    });
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return descriptor_; }

  /// Puts it, synchronised where it is to be, and closed, in the target's place.
  void replaceTarget(bool synchronised) {
    if (synchronised && ::fsync(descriptor_) != 0 && errno != EINVAL) failWith(target_, errno);
    if (unnamed_) {
      const std::string from = procPath(descriptor_);
      const auto link = [&](const char* name) {
        return ::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
      };
      const bool placed = link(target_.c_str());
      // A link replaces nothing, so what is there has to be renamed over.
      if (!placed) takeName(link);
      closeFile();
      if (placed) return;
    } else {
      closeFile();
    }
    if (::rename(name_.c_str(), target_.c_str()) != 0) failWith(target_, errno);
    name_.clear();
  }

 private:
  static std::string procPath(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

  /// Finds a name that `make` can give to the file. It must fit where the target's does, so a long one is
  /// cut.
  template <class Make>
  void takeName(const Make& make) {
    const std::string stem =
        "." + target_.filename().string().substr(0, 200) + "." + std::to_string(::getpid());
    for (int attempt = 0;; ++attempt) {
      const fs::path name = target_.parent_path() / (stem + "-" + std::to_string(attempt) + ".tmp");
      if (make(name.c_str())) {
        name_ = name;
        return;
      }
      if (errno != EEXIST || attempt == 99) failWith(target_, errno);
    }
  }

  /// A full disk may show only here.
  void closeFile() {
    if (::close(std::exchange(descriptor_, -1)) != 0) failWith(target_, errno);
  }

  fs::path target_, name_;  // name_: empty where it has none
  int descriptor_ = -1;
  bool unnamed_ = false;
};

/// What is to be replaced: the end of a chain of symbolic links. Throws where `path` cannot be a file.
fs::path resolveTarget(const fs::path& path) {
  if (path.empty()) fail("''", "the name is empty", "a file name");
  std::error_code error;
  // Links such as /dev/stdout lead to what has no path of its own.
  if (isPipeOrDevice(path)) return path;
  fs::path target = path;
  for (int depth = 0; fs::is_symlink(fs::symlink_status(target, error)); ++depth) {
    if (depth == 40) failWith(path, ELOOP);
    const fs::path next = fs::read_symlink(target, error);
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  if (!target.has_filename() || fs::is_directory(target, error))
    fail(path, "it is a folder", "a file name in it");
  if (target.filename().native().size() > NAME_MAX) failWith(path, ENAMETOOLONG);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::exists(folder, error)) {
    fail(path, "the folder " + folder.string() + " does not exist", "mkdir -p " + folder.string());
  }
  if (!fs::is_directory(folder, error)) fail(path, folder.string() + " is not a folder", "another folder");
  return target;
}

void writeAll(int file, std::string_view bytes, const fs::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      failWith(path, errno);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void writeWhole(const fs::path& path, bool synchronised,
                const std::function<void(const std::function<void(std::string_view)>&)>& write) {
  const fs::path target = resolveTarget(path);
  if (isPipeOrDevice(target)) {
    const int file = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (file < 0) failWith(path, errno);
    const Closing closing{file};
    write([&](std::string_view bytes) { writeAll(file, bytes, path); });
    return;
  }
  TemporaryFile temporary(target);
  struct stat before {};
  if (::stat(target.c_str(), &before) == 0 && ::fchmod(temporary.descriptor(), before.st_mode & 07777) != 0) {
    failWith(path, errno);
  }
  write([&](std::string_view bytes) { writeAll(temporary.descriptor(), bytes, path); });
  temporary.replaceTarget(synchronised);
}

}  // namespace

bool isPipeOrDevice(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

bool samePath(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return fs::is_regular_file(a, error);
  const auto canonical = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, error), error);
  };
  return canonical(a) == canonical(b) && !fs::exists(a, error);
}

void checkWritable(const fs::path& path) {
  const fs::path target = resolveTarget(path);
  if (isPipeOrDevice(target)) {
    if (::access(target.c_str(), W_OK) != 0) failWith(path, errno);
    return;
  }
  try {
    const TemporaryFile removed_at_once(target);
  } catch (const Error& error) {
    throw Error(error.kind(), error.what(), path.string(), error.advice());
  }
}

void writeWholeFile(const fs::path& path, std::string_view bytes) {
  writeWhole(path, true, [&](const auto& sink) { sink(bytes); });
}

void writeWholeFileSoon(const fs::path& path, std::string_view bytes) {
  writeWhole(path, false, [&](const auto& sink) { sink(bytes); });
}

void writeWholeFile(const fs::path& path,
                    const std::function<void(const std::function<void(std::string_view)>&)>& write) {
  writeWhole(path, true, write);
}

}  // namespace unshot
