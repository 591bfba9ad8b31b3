#include "solver/modes.h"

#include <array>

namespace unshot {

std::span<const IterationModeRow> iterationModes() {
  static const std::array<IterationModeRow, 3> table{{
      {{"southwell", "Progressive refinement",
        "the patch with the most unshot power shoots all of it; the first picture soonest"},
       makeSouthwell},
      {{"jacobi", "Bounce by bounce (Jacobi)",
        "every patch shoots what the last bounce brought it: B_t = E + M B_(t-1)"},
       makeJacobi},
      {{"gauss-seidel", "In turn (Gauss-Seidel)",
        "every patch in turn shoots all that it has by then; about half the sweeps of jacobi"},
       makeGaussSeidel},
  }};
  return table;
}

}  // namespace unshot
