// Files that are replaced only by whole ones: written under a temporary name beside the target, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace unshot {

/// Finds out, before long work, whether writeWholeFile can write `path`: its folder exists and can be
/// written, and it is no folder itself. Leaves nothing behind. Throws Error (kEnvironment) that names the
/// path.
void checkWritable(const std::filesystem::path& path);

/// Makes `bytes` the content of `path`. A file that is there keeps its permissions, and keeps its content
/// where this fails; what a symbolic link names is replaced, not the link; a device or pipe is written to
/// directly. Throws Error (kEnvironment) and leaves no temporary file.
void writeWholeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace unshot
