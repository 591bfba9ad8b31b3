#include "solver/modes.h"

#include <algorithm>
#include <array>

#include "base/clock.h"

namespace unshot {
namespace {

std::string always(const ModeSetup&) { return {}; }

}  // namespace

ModeSetup modeSetup(std::size_t elements, std::span<const glm::dvec3> reflectance) {
  const auto equal = [&](int a, int b) {
    return std::all_of(reflectance.begin(), reflectance.end(),
                       [&](const glm::dvec3& rho) { return rho[a] == rho[b]; });
  };
  const bool second = !equal(0, 1), third = !equal(0, 2) && !equal(1, 2);
  return {reflectance.size(), elements, 1 + second + third, availableMemoryBytes()};
}

std::span<const IterationModeRow> iterationModes() {
  static const std::array<IterationModeRow, 9> table{{
      {{"southwell", "Progressive refinement",
        "the patch with the most unshot power shoots all of it; the first picture soonest"},
       makeSouthwell,
       always},
      {{"kept-first", "Progressive, kept columns first",
        "as southwell, but a patch whose form factors are at hand goes before one whose must be computed"},
       makeKeptFirst,
       always},
      {{"overshoot", "Ambient overshooting",
        "as southwell, but a patch also shoots the ambient light that it expects to receive"},
       makeOvershoot,
       always},
      {{"jacobi", "Bounce by bounce (Jacobi)",
        "every patch shoots what the last bounce brought it: B_t = E + M B_(t-1)"},
       makeJacobi,
       always},
      {{"gauss-seidel", "In turn (Gauss-Seidel)",
        "every patch in turn shoots all that it has by then; about half the sweeps of jacobi"},
       makeGaussSeidel,
       always},
      {{"chebyshev", "Chebyshev iteration",
        "bounces weighted by Chebyshev polynomials; for high reflectance far fewer sweeps than jacobi"},
       makeChebyshev,
       always},
      {{"conjugate-gradient", "Conjugate gradients",
        "on pairs made symmetric; few sweeps whatever the reflectance"},
       makeConjugateGradient,
       always},
      {{"gmres", "Minimal residual (GMRES)",
        "each sweep makes what is unshot as small as any combination of the sweeps so far can"},
       makeGmres,
       always},
      {{"direct", "Direct solution", "dense factorisation; exact to rounding, for small scenes"},
       makeDirect,
       directUnavailable,
       false},
  }};
  return table;
}

}  // namespace unshot
