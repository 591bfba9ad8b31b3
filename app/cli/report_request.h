// What `unshot report` was asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"
#include "cli/solver_arguments.h"
#include "session/solve.h"

namespace unshot {

struct ReportRequest {
  std::vector<std::filesystem::path> scenes;
  std::filesystem::path out;
  std::vector<std::string> modes;
  std::size_t repeats = 3;
  double max_seconds = 70;  ///< of a scene, wall time
  bool reference = false, pictures = true;
  double reference_seconds = 60;
  SolveOptions options;
  std::string gl = "auto";
  std::filesystem::path shader_dir;
};

/// The options of `unshot report` as they are parsed.
class ReportArguments {
 public:
  explicit ReportArguments(Command& command);
  /// Throws Error (kUsage, kInput where a folder holds no scene).
  ReportRequest request() const;

 private:
  SolverArguments solver_;
  std::vector<std::string> scenes_;
  std::string out_, modes_ = "all";
  std::uint64_t repeats_ = 3;
  double error_ = 0.001, max_seconds_ = 70, reference_seconds_ = 60;
  bool reference_ = false, no_pictures_ = false;
};

}  // namespace unshot
