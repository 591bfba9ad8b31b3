#include "lint/include_rules.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

namespace unshot::lint {
namespace {

/// What each folder of core/ may see, itself aside: everything on its left in
/// base <- scene <- rays <- mesh <- formfactor <- solver <- session <- {report, render, export, stability} <-
/// app.
const std::map<std::string, std::set<std::string>>& visibleFolders() {
  static const std::map<std::string, std::set<std::string>> table = [] {
    std::map<std::string, std::set<std::string>> made;
    std::set<std::string> left;
    for (const char* folder : {"base", "scene", "rays", "mesh", "formfactor", "solver", "session"}) {
      made[folder] = left;
      left.insert(folder);
    }
    for (const char* folder : {"report", "render", "export", "stability"}) made[folder] = left;
    made["gl"] = {"base"};
    return made;
  }();
  return table;
}

/// Whether a file of core/ may name headers of gl/.
bool mayNameGl(const std::string& path) {
  return path.starts_with("core/gl/") || path.starts_with("core/formfactor/hemicube") ||
         path.starts_with("core/session/") || path.starts_with("core/render/");
}

struct Home {
  std::string_view header;               ///< start of the header's name
  std::vector<std::string_view> places;  ///< starts of the paths that may include it
};

const std::vector<Home>& homes() {
  static const std::vector<Home> table = {
      {"tiny_obj_loader", {"core/scene/obj_reader"}},
      {"GL/osmesa", {"core/gl/provider_osmesa"}},
      {"EGL/", {"core/gl/provider_egl"}},
      {"GL/glcorearb", {"core/gl/functions"}},
      {"GL/", {}},
      {"embree", {"core/rays/"}},
      {"xxhash", {"core/base/"}},
      {"Eigen", {"core/solver/"}},
      {"png.h", {"core/export/png_rows"}},
      {"stb_image", {"core/scene/texture_mean.cpp", "core/export/image_files.cpp"}},
      {"CLI/", {"app/cli/"}},
      {"nlohmann/", {"core/report/", "app/cli/"}},
      {"GLFW/", {"app/viewer/"}},
      {"imgui", {"app/viewer/"}},
      {"backends/imgui", {"app/viewer/"}},
  };
  return table;
}

/// The first row wins, so that GL/glcorearb.h is not the rest of GL/.
const Home* homeOf(const std::string& header) {
  const auto found = std::find_if(homes().begin(), homes().end(),
                                  [&](const Home& h) { return header.starts_with(h.header); });
  return found == homes().end() ? nullptr : &*found;
}

/// The name in an include line.
std::optional<std::string> includedHeader(const std::string& line) {
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return std::nullopt;
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return std::nullopt;
  const std::size_t open = line.find_first_of("<\"", at + 7);
  if (open == std::string::npos) return std::nullopt;
  const std::size_t close = line.find(line[open] == '<' ? '>' : '"', open + 1);
  if (close == std::string::npos) return std::nullopt;
  return line.substr(open + 1, close - open - 1);
}

std::string firstFolder(const std::string& path) {
  const std::size_t slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string complaintAbout(const std::string& path, const std::string& header) {
  if (const Home* home = homeOf(header)) {
    const bool at_home = std::any_of(home->places.begin(), home->places.end(),
                                     [&](std::string_view place) { return path.starts_with(place); });
    return at_home ? "" : "<" + header + "> has its home elsewhere";
  }
  if (!path.starts_with("core/")) return "";
  const std::string folder = firstFolder(path.substr(5)), target = firstFolder(header);
  if (target == "cli" || target == "viewer" || header == "exit_codes.h") return "core knows nothing of app";
  const auto& table = visibleFolders();
  if (table.count(target) == 0 || target == folder) return "";
  if (target == "gl") return mayNameGl(path) ? "" : folder + " may not name gl";
  const auto row = table.find(folder);
  if (row == table.end()) return "core/" + folder + " has no place in the order of includes";
  return row->second.count(target) ? "" : folder + " may not include " + target;
}

}  // namespace

Complaints checkIncludes(const Source& source) {
  Complaints complaints;
  std::istringstream lines(source.text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::optional<std::string> header = includedHeader(line);
    if (!header) continue;
    const std::string complaint = complaintAbout(source.path, *header);
    if (!complaint.empty())
      complaints.push_back(source.path + ":" + std::to_string(number) + ": " + complaint);
  }
  return complaints;
}

}  // namespace unshot::lint
