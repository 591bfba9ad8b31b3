#include "cli/report_request.h"

#include <algorithm>

#include "base/error.h"
#include "base/parse.h"
#include "solver/modes.h"

namespace unshot {
namespace {

namespace fs = std::filesystem;

Check modesText() {
  return [](const std::string& text) -> std::string {
    if (text == "all") return {};
    for (const std::string_view key : splitParts(text, ',')) {
      const std::string wrong = keyOf(iterationModes(), false)(std::string(key));
      if (!wrong.empty()) return wrong;
    }
    return {};
  };
}

/// In the order of the table, each once.
std::vector<std::string> modesOf(const std::string& text) {
  const std::vector<std::string_view> asked = splitParts(text, ',');
  std::vector<std::string> modes;
  for (const IterationModeRow& row : iterationModes()) {
    if (text == "all" || std::find(asked.begin(), asked.end(), row.info.key) != asked.end())
      modes.emplace_back(row.info.key);
  }
  return modes;
}

/// A folder stands for the OBJ files in it.
void addScenes(const fs::path& path, std::vector<fs::path>& scenes) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    scenes.push_back(path);
    return;
  }
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (entry.path().extension() == ".obj") found.push_back(entry.path());
  }
  if (error) throw Error(ErrorKind::kInput, error.message(), path.string(), "a folder that can be read");
  if (found.empty())
    throw Error(ErrorKind::kInput, "the folder holds no scene", path.string(), "a folder with OBJ files");
  std::sort(found.begin(), found.end());
  scenes.insert(scenes.end(), found.begin(), found.end());
}

}  // namespace

ReportArguments::ReportArguments(Command& command) : solver_(command, SolverUse::kReport) {
  command.arguments("SCENE.obj", scenes_, "Scenes, or folders of them");
  command.group("What to measure");
  command.add("--out", out_, "DIR", "Folder for the report; made where it is not there", fileName());
  command.add("--modes", modes_, "a,b,c",
              "Iteration modes, or all (default): " + keysOf(iterationModes(), false), modesText());
  command.add("--error", error_, "X", "Where runs end, 0 < X < 1 (default 0.001)", properFraction());
  command.add("--repeats", repeats_, "N", "Runs of each mode, for medians (default 3)", wholeNumber(1, 99));
  command.add("--max-seconds", max_seconds_, "T",
              "Time for a scene [s] (default 70): repeats beyond it are left out", positiveNumber());
  command.flag("--reference", reference_,
               "Measure against path-traced truth too; it is kept in DIR for the next time");
  command.add("--reference-seconds", reference_seconds_, "T", "Time for tracing it [s] (default 60)",
              positiveNumber());
  command.flag("--no-pictures", no_pictures_, "Leave out the pictures at equal times and rows");
}

ReportRequest ReportArguments::request() const {
  if (out_.empty())
    throw Error(ErrorKind::kUsage, "--out is missing", {}, "--out DIR, a folder for the report");
  ReportRequest request;
  for (const std::string& scene : scenes_) addScenes(scene, request.scenes);
  request.out = out_;
  request.modes = modesOf(modes_);
  request.repeats = repeats_;
  request.max_seconds = max_seconds_;
  request.reference = reference_;
  request.reference_seconds = reference_seconds_;
  request.pictures = !no_pictures_;
  request.options = solver_.options();
  request.options.error = error_;
  request.gl = solver_.gl();
  request.shader_dir = solver_.shaderDir();
  return request;
}

}  // namespace unshot
