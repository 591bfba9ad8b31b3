// Whole files as bytes.
#pragma once

#include <filesystem>
#include <string>

namespace unshot {

/// The bytes of the file. Throws Error (kInput: missing, a folder, unreadable, empty, 2 GiB or more).
std::string readFile(const std::filesystem::path& path);

}  // namespace unshot
