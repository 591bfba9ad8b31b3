#include "cli/saving_arguments.h"

#include <iostream>

#include "cli/text.h"
#include "session/saved_solve.h"

namespace unshot {

void SavingArguments::add(Command& command, SolverUse use) {
  const bool with_window = use == SolverUse::kView;
  command.group("To go on later");
  command.add("--save", save_, "F",
              "Save the solve itself, now and then, " +
                  std::string(with_window ? "when another scene is opened and when the window is closed"
                                          : "on Ctrl-C and at the end") +
                  ": mesh, light and form factors (as large as these)",
              fileName());
  command.add("--save-every", save_every_, "S",
              "Seconds between two saves (default 60), more where saving takes long", positiveNumber());
  command.add("--resume", resume_, "F",
              "Go on from a saved solve of this scene; limits count from there, and its --mode and --error "
              "hold where they are not given",
              fileName());
  command.need("--save-every", "--save");
  for (const char* decided : {"--form-factors", "--elements", "--element-size", "--max-elements", "--emit",
                              "--sky", "--seed", "--hemicube"})
    command.exclude("--resume", decided);
  if (with_window) return;
  command.exclude("--save", "--bounces");
  command.exclude("--resume", "--bounces");
}

std::shared_ptr<SavedSolve> readResumed(const std::filesystem::path& path, bool error_given,
                                        SolveOptions& options) {
  if (path.empty()) return nullptr;
  std::shared_ptr<SavedSolve> saved = readSavedSolve(path);
  if (!error_given) options.error = saved->error;
  std::cerr << "unshot: goes on from " << path.string() << ": " << countedText(saved->shots, "shot") << " in "
            << figureText(saved->seconds) << " s" << std::endl;
  return saved;
}

}  // namespace unshot
