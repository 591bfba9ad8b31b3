#include "cli/solve_request.h"

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parse.h"
#include "render/display_modes.h"

namespace unshot {
namespace {

[[noreturn]] void refuse(const std::string& message, const std::string& advice) {
  throw Error(ErrorKind::kUsage, message, {}, advice);
}

std::optional<glm::dvec3> vectorOf(const std::string& text) {
  return text.empty() ? std::nullopt : parseVector(text);
}

}  // namespace

bool SolveRequest::needsPicture() const {
  return std::any_of(outputs.begin(), outputs.end(),
                     [](const Output& o) { return o.exporter->needs != PictureNeed::kNoPicture; });
}

SolveArguments::SolveArguments(Command& command)
    : solver_(command, SolverUse::kSolve), outputs_(exporters().size()) {
  command.argument("SCENE.obj", scene_, "The scene: Wavefront OBJ with MTL");
  addOutputs(command);
  addPicture(command);
  saving_.add(command, SolverUse::kSolve);
}

void SolveArguments::addOutputs(Command& command) {
  command.group("What to write");
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    const Exporter& exporter = exporters()[k];
    command.add("--" + std::string(exporter.info.key), outputs_[k], "F" + std::string(exporter.ending),
                std::string(exporter.info.title) + ": " + std::string(exporter.info.help), fileName());
  }
  command.add("--probe", probe_, "POINTS.csv", "Points to probe: lines x,y,z,nx,ny,nz in file coordinates",
              fileName());
  command.need("--probe", "--probe-out");
  command.need("--probe-out", "--probe");
}

void SolveArguments::addPicture(Command& command) {
  command.group("The picture");
  command.add("--size", size_, "WxH", "Size in pixels (default 1280x960)", sizeText(kLargestPicture));
  command.add("--eye", eye_, "x,y,z", "Where the viewer stands, in file coordinates (default: chosen)",
              vectorText());
  command.add("--at", at_, "x,y,z", "What the viewer looks at, in file coordinates (default: chosen)",
              vectorText());
  command.add("--up", up_, "x,y,z", "What is upwards (default 0,1,0)", vectorText());
  command.add("--fov", picture_.fov_deg, "D", "Vertical angle of view, 1 to 170 degrees (default: chosen)",
              numberWithin(1, 170, "degrees"));
  command.add("--display", picture_.display, "MODE",
              "What is shown: " + keysOf(displayModes(), false) + " (default radiosity)",
              keyOf(displayModes(), false));
  command.add("--exposure", picture_.exposure_ev, "EV",
              "Stops brighter than the automatic exposure (default 0)", numberWithin(-100, 100, "stops"));
  command.flag("--ambient", picture_.ambient,
               "Add an estimate of the light still unshot to all that is written");
}

SolveRequest SolveArguments::request() const {
  SolveRequest request;
  request.scene = scene_;
  request.options = solver_.options();
  request.gl = solver_.gl();
  request.shader_dir = solver_.shaderDir();
  request.probe = probe_;
  request.save = saving_.save();
  request.resume = saving_.resume();
  request.save_every = saving_.saveEvery();
  request.error_given = solver_.errorGiven();
  request.picture = picture_;
  request.picture.linear = false;
  if (!size_.empty()) {
    const std::vector<std::string_view> parts = splitParts(size_, 'x');
    request.picture.width = static_cast<int>(*parseNumber(parts[0]));
    request.picture.height = static_cast<int>(*parseNumber(parts[1]));
  }
  request.picture.eye = vectorOf(eye_);
  request.picture.at = vectorOf(at_);
  request.picture.up = vectorOf(up_);
  const PictureOptions& picture = request.picture;
  if (picture.eye && picture.at && *picture.eye == *picture.at) {
    refuse("--eye and --at are the same point", "a point in front of the viewer for --at");
  }
  if (picture.up && *picture.up == glm::dvec3(0.0)) refuse("--up has no direction", "--up 0,1,0");
  if (picture.up && picture.eye && picture.at &&
      glm::length(glm::cross(glm::normalize(*picture.up), glm::normalize(*picture.at - *picture.eye))) <
          1e-6) {
    refuse("--up is along the line of sight", "another direction for --up");
  }
  for (std::size_t k = 0; k < outputs_.size(); ++k) {
    if (outputs_[k].empty()) continue;
    request.outputs.push_back({&exporters()[k], outputs_[k]});
    request.picture.linear = request.picture.linear || exporters()[k].needs == PictureNeed::kLinear;
  }
  return request;
}

void checkOutputs(const SolveRequest& request) {
  struct Target {
    std::string option;
    std::filesystem::path path;
  };
  std::vector<Target> targets;
  for (const Output& output : request.outputs)
    targets.push_back({"--" + std::string(output.exporter->info.key), output.path});
  if (!request.save.empty()) targets.push_back({"--save", request.save});
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const auto& [option, path] = targets[k];
    for (const std::filesystem::path& input : {request.scene, request.probe, request.resume}) {
      // A solve may be saved where it was resumed from.
      if (input.empty() || !samePath(path, input) || (option == "--save" && input == request.resume))
        continue;
      refuse(option + " would replace the input " + input.string(), "another file name");
    }
    for (std::size_t other = 0; other < k; ++other) {
      if (!samePath(path, targets[other].path)) continue;
      refuse(option + " and " + targets[other].option + " name the same file", "a file name for each");
    }
    checkWritable(path);
  }
}

Diagnostics endingNotes(const SolveRequest& request) {
  Diagnostics notes;
  for (const Output& output : request.outputs) {
    std::string ending = output.path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending.empty() || ending == output.exporter->ending || isPipeOrDevice(output.path)) continue;
    notes.push_back({Severity::kNote,
                     "file-ending",
                     "written as " + std::string(output.exporter->info.title) + " all the same: --" +
                         std::string(output.exporter->info.key) + " writes nothing else",
                     output.path.string(),
                     {}});
  }
  return notes;
}

}  // namespace unshot
