// The options that `unshot solve`, `view` and `report` share: how to solve, on which mesh, when to stop.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/options.h"
#include "session/solve.h"

namespace unshot {

/// Who asks.
enum class SolverUse {
  kSolve,
  kView,   ///< --gl may be glfw too
  kReport  ///< several modes: neither --mode nor the limits of one solve
};

/// The values of --emit.
Check emitText();

class SolverArguments {
 public:
  SolverArguments(Command& command, SolverUse use);

  SolveOptions options() const;
  bool errorGiven() const { return error_.has_value(); }
  /// Key of a provider, "glfw" or "auto".
  const std::string& gl() const { return gl_; }
  /// Empty where not given.
  std::filesystem::path shaderDir() const { return shader_dir_; }

 private:
  void addSolver(Command& command, SolverUse use);
  void addMesh(Command& command);
  void addPlan(Command& command);
  void addLimits(Command& command);
  void addBounces(Command& command);

  SolveOptions options_;
  std::string gl_ = "auto", shader_dir_, emit_ = "both", sky_, do_;
  bool do_all_ = false;
  std::optional<std::uint64_t> kept_mb_;
  std::optional<double> error_;
};

/// Takes shaders from this folder from now on; nothing where it is empty. Throws Error kEnvironment where it
/// is none.
void useShaderDir(const std::filesystem::path& folder);

}  // namespace unshot
