#include "cli/solve_request.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/parse.h"
#include "export/atomic_file.h"
#include "formfactor/methods.h"
#include "gl/context.h"
#include "mesh/build.h"
#include "render/display_modes.h"
#include "solver/modes.h"

namespace unshot {
namespace {

constexpr double kBytesPerMb = 1e6;

[[noreturn]] void refuse(const std::string& message, const std::string& advice) {
  throw Error(ErrorKind::kUsage, message, {}, advice);
}

std::optional<glm::dvec3> vectorOf(const std::string& text) {
  return text.empty() ? std::nullopt : parseVector(text);
}

Check emitText() {
  return [](const std::string& text) -> std::string {
    return text == "both" || text == "front" ? "" : "'" + text + "' is neither both nor front";
  };
}

bool samePath(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return std::filesystem::is_regular_file(a, error);
  const auto canonical = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  return canonical(a) == canonical(b) && !std::filesystem::exists(a, error);
}

}  // namespace

bool SolveRequest::needsPicture() const {
  return std::any_of(outputs.begin(), outputs.end(),
                     [](const Output& o) { return o.exporter->needs != PictureNeed::kNoPicture; });
}

SolveArguments::SolveArguments(Command& command) : outputs_(exporters().size()) {
  command.argument("SCENE.obj", scene_, "The scene: Wavefront OBJ with MTL");
  addSolver(command);
  addMesh(command);
  addLimits(command);
  addOutputs(command);
  addPicture(command);
}

void SolveArguments::addSolver(Command& command) {
  command.group("How to solve");
  const auto modes = iterationModes();
  const auto methods = formFactorMethods();
  command.add("--mode", options_.mode, "M", "Iteration: " + keysOf(modes, true) + " (default auto)",
              keyOf(modes, true));
  command.add("--form-factors", options_.form_factors, "F",
              "Form factors: " + keysOf(methods, true) + " (default auto)", keyOf(methods, true));
  command.add(
      "--hemicube", options_.hemicube_resolution, "N",
      "Pixels along an edge of the hemicube, even, 16 to 4096 (default 64); lights get up to 4 times as many",
      wholeNumber(16, 4096, true));
  command.add("--emit", emit_, "both|front", "Sides on which light sources emit (default both)", emitText());
  command.add("--keep", kept_mb_, "MB", "Memory for form factors that are kept [MB] (default 1074)",
              wholeNumber(0, 1'000'000));
  command.add("--seed", options_.seed, "N", "Start of the random numbers (default 1)", wholeNumber(0));
  command.add("--gl", gl_, "P", "Provider of OpenGL: " + keysOf(gl::providers(), true) + " (default auto)",
              keyOf(gl::providers(), true));
  command.add("--shader-dir", shader_dir_, "DIR", "Take shaders from this folder where it has them",
              fileName());
}

void SolveArguments::addMesh(Command& command) {
  command.group("Mesh");
  command.add("--elements", options_.elements, "N",
              "Elements over all lit sides, within 10 % (default 10000)", wholeNumber(1, kMostElements));
  command.add("--element-size", options_.element_size, "S", "Edge of an element [m]", positiveNumber());
  command.exclude("--elements", "--element-size");
}

void SolveArguments::addLimits(Command& command) {
  command.group("When to stop");
  command.add("--error", options_.error, "X", "Stop when this fraction of the power is unshot (default 0.01)",
              numberWithin(0, 1, {}, true));
  command.add("--max-seconds", options_.max_seconds, "T", "Stop after this time [s] and write the result",
              positiveNumber());
  command.add("--max-shots", options_.max_shots, "N", "Stop after so many shots and write the result",
              wholeNumber(1));
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
  request.options = options_;
  request.options.emit_front_only = emit_ == "front";
  if (kept_mb_)
    request.options.kept_bytes = static_cast<std::size_t>(static_cast<double>(*kept_mb_) * kBytesPerMb);
  request.gl = gl_;
  request.shader_dir = shader_dir_;
  request.probe = probe_;
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
  for (std::size_t k = 0; k < request.outputs.size(); ++k) {
    const Output& output = request.outputs[k];
    const std::string option = "--" + std::string(output.exporter->info.key);
    for (const std::filesystem::path& input : {request.scene, request.probe}) {
      if (!input.empty() && samePath(output.path, input)) {
        refuse(option + " would replace the input " + input.string(), "another file name");
      }
    }
    for (std::size_t other = 0; other < k; ++other) {
      if (!samePath(output.path, request.outputs[other].path)) continue;
      refuse(
          option + " and --" + std::string(request.outputs[other].exporter->info.key) + " name the same file",
          "a file name for each");
    }
    checkWritable(output.path);
  }
  std::error_code error;
  if (!request.shader_dir.empty() && !std::filesystem::is_directory(request.shader_dir, error)) {
    throw Error(ErrorKind::kEnvironment, "there is no such folder", request.shader_dir.string(),
                "the folder shaders/ of the source, or no --shader-dir");
  }
}

}  // namespace unshot
