// --save, --save-every and --resume, which `unshot solve` and `unshot view` share.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/options.h"
#include "cli/solver_arguments.h"

namespace unshot {

class SavingArguments {
 public:
  /// After the options of the solver.
  void add(Command& command, SolverUse use);

  /// Empty where not asked for.
  std::filesystem::path save() const { return save_; }
  std::filesystem::path resume() const { return resume_; }
  double saveEvery() const { return save_every_.value_or(60); }  ///< [s]

 private:
  std::string save_, resume_;
  std::optional<double> save_every_;
};

/// The saved solve to go on from, announced on standard error, and what is to be asked of it: where no error
/// was given, the one that it aimed for. None where `path` is empty. Throws as readSavedSolve.
std::shared_ptr<SavedSolve> readResumed(const std::filesystem::path& path, bool error_given,
                                        SolveOptions& options);

}  // namespace unshot
