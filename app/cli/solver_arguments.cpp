#include "cli/solver_arguments.h"

#include "base/error.h"
#include "formfactor/methods.h"
#include "gl/context.h"
#include "gl/shaders.h"
#include "mesh/build.h"
#include "scene/sky.h"
#include "solver/modes.h"

namespace unshot {
namespace {

constexpr double kBytesPerMb = 1e6;

Check skyText() {
  return [](const std::string& text) -> std::string {
    return parseSky(text) ? ""
                          : "'" + text + "' is not r,g,b (three numbers from 0 on with commas, no blanks)";
  };
}

}  // namespace

Check emitText() {
  return [](const std::string& text) -> std::string {
    return text == "both" || text == "front" ? "" : "'" + text + "' is neither both nor front";
  };
}

SolverArguments::SolverArguments(Command& command, SolverUse use) {
  addSolver(command, use);
  addMesh(command);
  addPlan(command);
  if (use != SolverUse::kReport) addLimits(command);
  if (use == SolverUse::kSolve) addBounces(command);
}

void SolverArguments::addSolver(Command& command, SolverUse use) {
  const bool with_window = use == SolverUse::kView;
  options_.soonest = use == SolverUse::kSolve;
  command.group("How to solve");
  const auto modes = iterationModes();
  const auto methods = formFactorMethods();
  if (use != SolverUse::kReport) {
    command.add("--mode", options_.mode, "M", "Iteration: " + keysOf(modes, true) + " (default auto)",
                keyOf(modes, true));
  }
  command.add("--form-factors", options_.form_factors, "F",
              "Form factors: " + keysOf(methods, true) + " (default auto)", keyOf(methods, true));
  command.add(
      "--hemicube", options_.hemicube_resolution, "N",
      "Pixels along an edge of the hemicube, even, 16 to 4096 (default 64); lights get up to 4 times as many",
      wholeNumber(16, 4096, true));
  command.add("--emit", emit_, "both|front", "Sides on which light sources emit (default both)", emitText());
  command.add(
      "--sky", sky_, "r,g,b",
      "Radiosity of a uniform sky around the scene [W/m^2] (default 0,0,0, or 1,1,1 where no face emits)",
      skyText());
  command.add("--keep", kept_mb_, "MB", "Memory for form factors that are kept [MB] (default 1074)",
              wholeNumber(0, 1'000'000));
  command.add("--seed", options_.seed, "N", "Start of the random numbers (default 1)", wholeNumber(0));
  const auto providers = gl::providers();
  const Check headless = keyOf(providers, true);
  command.add("--gl", gl_, "P",
              "Provider of OpenGL: " + keysOf(providers, true) +
                  (with_window ? ", glfw (default auto: a window; without one, a --script is needed)"
                               : " (default auto)"),
              [=](const std::string& key) -> std::string {
                if (key != "glfw") return headless(key);
                return with_window ? "" : "'glfw' opens a window: only `unshot view` has one";
              });
  command.add("--shader-dir", shader_dir_, "DIR", "Take shaders from this folder where it has them",
              fileName());
}

void SolverArguments::addMesh(Command& command) {
  command.group("Mesh");
  command.add(
      "--elements", options_.elements, "N",
      "Elements over all lit sides, within 10 %, all alike (default 10000 where they do not follow the "
      "light)",
      wholeNumber(1, kMostElements));
  command.add("--element-size", options_.element_size, "S", "Edge of an element [m]", positiveNumber());
  command.exclude("--elements", "--element-size");
  command.add("--max-elements", options_.max_elements, "N",
              "About so many elements at most where they follow the light (default 1000000)",
              wholeNumber(1, kMostElements));
  command.exclude("--elements", "--max-elements");
  command.exclude("--element-size", "--max-elements");
}

void SolverArguments::addPlan(Command& command) {
  command.group("What the plan leaves out (unshot check SCENE.obj)");
  command.add("--do", do_, "KEYS", "Do this all the same: a list with commas of " + keysOf(planRows(), false),
              [](const std::string& list) -> std::string {
                try {
                  doAnyway(list);
                } catch (const Error& error) {
                  return error.what();
                }
                return {};
              });
  command.flag("--do-all", do_all_, "Do all of it but shooters (not beside --do)");
  command.exclude("--do", "--do-all");
}

void SolverArguments::addLimits(Command& command) {
  command.group("When to stop");
  command.add("--error", error_, "X",
              "Stop when the bound of the solver's error is below this, 0 < X < 1 (default 0.01)",
              properFraction());
  command.add("--max-seconds", options_.max_seconds, "T", "Stop after this time [s] and write the result",
              positiveNumber());
  command.add("--max-shots", options_.max_shots, "N", "Stop after so many shots and write the result",
              wholeNumber(1));
}

void SolverArguments::addBounces(Command& command) {
  command.add("--bounces", options_.bounces, "N",
              "Only the light of N bounces, E + M E + ... + M^N E, whatever its error; 1 is direct light",
              wholeNumber(1));
  command.exclude("--bounces", "--error");
}

SolveOptions SolverArguments::options() const {
  SolveOptions options = options_;
  options.emit_front_only = emit_ == "front";
  if (error_) options.error = *error_;
  if (do_all_) options.do_anyway = doAll();
  if (!do_.empty()) options.do_anyway = doAnyway(do_);
  if (!sky_.empty()) options.sky = parseSky(sky_);
  if (kept_mb_) options.kept_bytes = static_cast<std::size_t>(static_cast<double>(*kept_mb_) * kBytesPerMb);
  return options;
}

void useShaderDir(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    throw Error(ErrorKind::kEnvironment, "there is no such folder", folder.string(),
                "the folder shaders/ of the source, or no --shader-dir");
  }
  gl::setShaderDir(folder);
}

}  // namespace unshot
