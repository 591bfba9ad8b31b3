// The options that `unshot solve` and `unshot view` share: how to solve, on which mesh, when to stop.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/options.h"
#include "session/solve.h"

namespace unshot {

class SolverArguments {
 public:
  /// `with_window`: --gl may be glfw too.
  SolverArguments(Command& command, bool with_window);

  SolveOptions options() const;
  /// Key of a provider, "glfw" or "auto".
  const std::string& gl() const { return gl_; }
  /// Empty where not given.
  std::filesystem::path shaderDir() const { return shader_dir_; }

 private:
  void addSolver(Command& command, bool with_window);
  void addMesh(Command& command);
  void addLimits(Command& command);

  SolveOptions options_;
  std::string gl_ = "auto", shader_dir_, emit_ = "both";
  std::optional<std::uint64_t> kept_mb_;
};

/// Takes shaders from this folder from now on; nothing where it is empty. Throws Error kEnvironment where it
/// is none.
void useShaderDir(const std::filesystem::path& folder);

}  // namespace unshot
