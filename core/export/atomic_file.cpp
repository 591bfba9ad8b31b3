#include "export/atomic_file.h"

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

class FileDescriptor {
 public:
  explicit FileDescriptor(int value) : value_(value) {}
  ~FileDescriptor() {
    if (value_ >= 0) ::close(value_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int value() const { return value_; }
  /// 0, or the error: a full disk may show only here.
  int close() { return ::close(std::exchange(value_, -1)) == 0 ? 0 : errno; }

 private:
  int value_;
};

/// Removes its file unless told that the file has been renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) {
    // The name must fit where the target's does, so a long one is cut.
    const std::string stem =
        "." + target.filename().string().substr(0, 200) + "." + std::to_string(::getpid());
    for (int attempt = 0;; ++attempt) {
      path_ = target.parent_path() / (stem + "-" + std::to_string(attempt) + ".tmp");
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ >= 0) return;
      if (errno != EEXIST || attempt == 99) failWith(target, errno);
    }
  }
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int takeDescriptor() { return std::exchange(descriptor_, -1); }
  const fs::path& path() const { return path_; }
  void keep() { path_.clear(); }

 private:
  fs::path path_;
  int descriptor_ = -1;
};

/// A device or a pipe: neither a file nor a folder.
bool isSpecial(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// What is to be replaced: the end of a chain of symbolic links. Throws where `path` cannot be a file.
fs::path resolveTarget(const fs::path& path) {
  if (path.empty()) fail("''", "the name is empty", "a file name");
  std::error_code error;
  // Links such as /dev/stdout lead to what has no path of its own.
  if (isSpecial(path)) return path;
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

void writeAll(const FileDescriptor& file, std::string_view bytes, const fs::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.value(), bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      failWith(path, errno);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace

void checkWritable(const fs::path& path) {
  const fs::path target = resolveTarget(path);
  if (isSpecial(target)) {
    if (::access(target.c_str(), W_OK) != 0) failWith(path, errno);
    return;
  }
  try {
    TemporaryFile temporary(target);
    const FileDescriptor closed_at_once(temporary.takeDescriptor());
  } catch (const Error& error) {
    throw Error(error.kind(), error.what(), path.string(), error.advice());
  }
}

void writeWholeFile(const fs::path& path, std::string_view bytes) {
  const fs::path target = resolveTarget(path);
  if (isSpecial(target)) {
    FileDescriptor file(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.value() < 0) failWith(path, errno);
    writeAll(file, bytes, path);
    return;
  }
  TemporaryFile temporary(target);
  FileDescriptor file(temporary.takeDescriptor());
  struct stat before {};
  if (::stat(target.c_str(), &before) == 0 && ::fchmod(file.value(), before.st_mode & 07777) != 0) {
    failWith(path, errno);
  }
  writeAll(file, bytes, path);
  if (::fsync(file.value()) != 0 && errno != EINVAL) failWith(path, errno);
  if (const int error = file.close()) failWith(path, error);
  if (::rename(temporary.path().c_str(), target.c_str()) != 0) failWith(path, errno);
  temporary.keep();
}

}  // namespace unshot
