// Saves a solve while it runs, so that little is lost however the program ends.
#pragma once

#include <filesystem>

#include "session/solve.h"

namespace unshot {

class Saver {
 public:
  /// An empty `path`: nothing is ever saved. `every`: seconds between two saves at least.
  Saver(std::filesystem::path path, double every);

  /// Saves where it is time. Where that fails a line says so, and it is tried again later: the solve goes on.
  void offer(const Solve& solve);
  /// Saves. Throws Error (kEnvironment).
  void save(const Solve& solve);

 private:
  std::filesystem::path path_;
  double every_;
  double next_;  // wall time
};

}  // namespace unshot
