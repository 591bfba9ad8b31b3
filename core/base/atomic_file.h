// Files that are replaced only by whole ones: written without a name or under a temporary one beside the
// target, then put in its place.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace unshot {

/// Finds out, before long work, whether writeWholeFile can write `path`: its folder exists and can be
/// written, and it is no folder itself. Leaves nothing behind. Throws Error (kEnvironment) that names the
/// path.
void checkWritable(const std::filesystem::path& path);

/// Whether both name one file, which need not be there yet; never where it is a pipe, a device or a folder.
bool samePath(const std::filesystem::path& a, const std::filesystem::path& b);

/// Whether `path` is there and is neither a file nor a folder, so that writing may wait for a reader.
bool isPipeOrDevice(const std::filesystem::path& path);

/// Makes `bytes` the content of `path`. A file that is there keeps its permissions, and keeps its content
/// where this fails; what a symbolic link names is replaced, not the link; a device or pipe is written to
/// directly. Throws Error (kEnvironment) and leaves no temporary file. Where the file system knows files
/// without a name (Linux's usual ones do), a program that ends while it writes leaves none behind either.
void writeWholeFile(const std::filesystem::path& path, std::string_view bytes);
/// The same for what is not at hand in one piece: `write` gives it to its argument, piece by piece.
void writeWholeFile(const std::filesystem::path& path,
                    const std::function<void(const std::function<void(std::string_view)>&)>& write);
/// A file at hand, without waiting for the disk, for what may be lost where the machine loses its power.
void writeWholeFileSoon(const std::filesystem::path& path, std::string_view bytes);

}  // namespace unshot
