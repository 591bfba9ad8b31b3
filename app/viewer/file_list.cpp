#include "viewer/file_list.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "base/error.h"
#include "viewer/file_kinds.h"

namespace unshot {
namespace {

namespace fs = std::filesystem;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// "~" is the home of whoever sits there.
fs::path typedPath(const std::string& text) {
  const char* home = std::getenv("HOME");
  if (home && (text == "~" || text.starts_with("~/")))
    return fs::path(home) / text.substr(std::min<std::size_t>(2, text.size()));
  return text;
}

}  // namespace

std::string lowered(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), lower);
  return out;
}

void FileList::open(const fs::path& folder) {
  std::error_code error;
  const fs::path wanted = fs::weakly_canonical(fs::absolute(folder, error), error);
  std::vector<Entry> found;
  for (fs::directory_iterator at(wanted, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    std::error_code unknown;
    const bool is_folder = at->is_directory(unknown);
    if (name.starts_with('.') || (!is_folder && !isTaken(name))) continue;
    found.push_back({name, is_folder});
  }
  if (error || wanted.empty())
    throw Error(ErrorKind::kInput, "this folder cannot be read: " + error.message(), wanted.string(),
                "another folder");
  const auto place = [](const Entry& e) {
    return std::tuple(!e.folder, !e.folder && !isScene(e.name), lowered(e.name), e.name);
  };
  std::sort(found.begin(), found.end(), [&](const Entry& a, const Entry& b) { return place(a) < place(b); });
  if (wanted.has_relative_path()) found.insert(found.begin(), {"..", true});
  folder_ = wanted;
  entries_ = std::move(found);
}

std::string FileList::follow(const std::string& text) {
  const std::size_t slash = text.rfind('/');
  if (slash == std::string::npos) return text;
  const fs::path folder = folder_ / typedPath(text.substr(0, slash + 1));
  std::error_code error;
  if (!fs::is_directory(folder, error)) return text;
  open(folder);
  return text.substr(slash + 1);
}

std::vector<FileList::Entry> FileList::matching(std::string_view text) const {
  const std::string wanted = lowered(text);
  std::vector<Entry> first, others;
  for (const Entry& entry : entries_) {
    const std::size_t at = lowered(entry.name).find(wanted);
    if (at != std::string::npos) (at == 0 ? first : others).push_back(entry);
  }
  first.insert(first.end(), others.begin(), others.end());
  return first;
}

std::string FileList::completed(const std::string& text) const {
  std::string common;
  std::size_t count = 0;
  bool folder = false;
  for (const Entry& entry : entries_) {
    if (entry.name == ".." || !lowered(entry.name).starts_with(lowered(text))) continue;
    folder = entry.folder;
    if (count++ == 0) common = entry.name;
    std::size_t same = 0;
    while (same < std::min(common.size(), entry.name.size()) &&
           lower(common[same]) == lower(entry.name[same]))
      ++same;
    common.resize(same);
  }
  if (count == 0) return text;
  return count == 1 && folder ? common + "/" : common;
}

fs::path FileList::pathOf(const Entry& entry) const {
  return entry.name == ".." ? folder_.parent_path() : folder_ / entry.name;
}

}  // namespace unshot
