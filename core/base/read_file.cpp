#include "base/read_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>

#include "base/error.h"

namespace unshot {

std::string readFile(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& why, const std::string& advice) {
    throw Error(ErrorKind::kInput, why, path.string(), advice);
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail("there is no such file", "check the name and the folder");
  if (std::filesystem::is_directory(status)) fail("this is a folder, not a file", "name a file in it");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(std::string("cannot be read: ") + std::strerror(errno), "check its permissions");
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (stream.bad()) fail("reading stopped half-way", "check the disk");
  if (bytes.empty()) fail("the file is empty", "write it again");
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    fail("the file is too large", "a smaller one");
  return bytes;
}

}  // namespace unshot
