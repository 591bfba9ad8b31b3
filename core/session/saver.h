// Saves a solve while it runs, so that little is lost however the program ends.
#pragma once

#include <filesystem>
#include <optional>

#include "base/error.h"
#include "session/solve.h"

namespace unshot {

class Saver {
 public:
  /// An empty `path`: nothing is ever saved. `every`: seconds between two saves at least.
  Saver(std::filesystem::path path, double every);

  /// Whether it is time: for a solve that has come to rest at once, unless saving would take more than a
  /// twentieth of the time.
  bool due(bool at_rest = false) const;
  /// Saves where it is time. What fails is returned, and it is tried again later, as it is where it is given
  /// up: the solve goes on.
  std::optional<Error> offer(const Solve& solve, bool at_rest = false, const CancelToken& cancel = {});
  /// Saves. Throws Error (kEnvironment), Cancelled: then the file before stays.
  void save(const Solve& solve, const CancelToken& cancel = {});

 private:
  std::filesystem::path path_;
  double every_;
  double next_, next_at_rest_ = 0;  // wall time
};

}  // namespace unshot
