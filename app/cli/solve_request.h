// What `unshot solve` was asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "cli/options.h"
#include "cli/saving_arguments.h"
#include "cli/solver_arguments.h"
#include "export/exporters.h"
#include "render/picture.h"
#include "session/solve.h"

namespace unshot {

/// A file to be written.
struct Output {
  const Exporter* exporter = nullptr;
  std::filesystem::path path;
};

struct SolveRequest {
  std::filesystem::path scene;
  SolveOptions options;
  std::string gl = "auto";
  std::filesystem::path shader_dir;
  PictureOptions picture;
  std::filesystem::path probe;
  std::vector<Output> outputs;
  std::filesystem::path save, resume;  ///< files of a saved solve; empty where not asked for
  double save_every = 60;              ///< [s]
  bool error_given = false;            ///< by the command line, not by default

  bool needsPicture() const;
};

/// The options of `unshot solve` as they are parsed.
class SolveArguments {
 public:
  explicit SolveArguments(Command& command);
  /// Checks what can be checked without reading anything. Throws Error (kUsage).
  SolveRequest request() const;

 private:
  void addPicture(Command& command);
  void addOutputs(Command& command);

  std::string scene_, probe_;
  SavingArguments saving_;
  SolverArguments solver_;
  PictureOptions picture_;
  std::string size_, eye_, at_, up_;
  std::vector<std::string> outputs_;  ///< one per exporter, empty where not asked for
};

/// Finds out before the solve whether every output can be written and none replaces an input or another
/// output. Throws Error (kUsage, kEnvironment).
void checkOutputs(const SolveRequest& request);

/// A note for each file whose name ends as if it held something else.
Diagnostics endingNotes(const SolveRequest& request);

}  // namespace unshot
