// The table of iteration modes. A mode only chooses what is shot; a new mode is its own file and a row here.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/choice.h"
#include "base/error.h"
#include "formfactor/transport.h"
#include "solver/state.h"

namespace unshot {

/// A mode cannot go on; another may, from the state as it is.
class IterationFailure : public Error {
 public:
  using Error::Error;
};

/// One way of iterating. It may be created on any state (another mode's, half way), and left at any step.
class IterationMode {
 public:
  virtual ~IterationMode() = default;
  /// A step of milliseconds to a few tens of them: computes one column at most. Returns how many columns it
  /// used, or none where nothing is left to shoot. Throws IterationFailure; the state is then as good as
  /// before.
  virtual std::optional<std::size_t> step(RadiosityState& state, Transport& transport) = 0;
  /// What it is doing besides shooting, such as "factorising"; empty: it shoots.
  virtual std::string activity() const { return {}; }
  /// sum A B_k per channel [W] of the bounces that it has begun to shoot, from B_0 = E on; empty where it
  /// does not go bounce by bounce from the start.
  virtual std::vector<glm::dvec3> bouncePowers() const { return {}; }
  /// Memory that it holds beside the state, where that is more than some vectors [bytes].
  virtual std::size_t bytes() const { return 0; }
};

/// What a mode's availability depends on.
struct ModeSetup {
  std::size_t patches = 0, elements = 0;
  int channels = 3;              ///< how many of the three differ in reflectance
  std::size_t memory_bytes = 0;  ///< free on this machine
};

/// Its figures for a system; `reflectance` one per patch.
ModeSetup modeSetup(std::size_t elements, std::span<const glm::dvec3> reflectance);

struct IterationModeRow {
  ChoiceInfo info;
  std::unique_ptr<IterationMode> (*make)();
  /// Empty, or why the mode is not for this system, with what to try in parentheses.
  std::string (*unavailable)(const ModeSetup&);
  /// Whether it gains from form factors that are drafts at first: not where other ones mean to begin anew.
  bool drafts = true;
};

std::span<const IterationModeRow> iterationModes();

std::unique_ptr<IterationMode> makeSouthwell();
std::unique_ptr<IterationMode> makeKeptFirst();
std::unique_ptr<IterationMode> makeOvershoot();
std::unique_ptr<IterationMode> makeJacobi();
/// The same, with nothing left to shoot after `bounces` sweeps: from nothing shot, B is then the light of so
/// many bounces.
std::unique_ptr<IterationMode> makeBounces(std::uint64_t bounces);
std::unique_ptr<IterationMode> makeGaussSeidel();
std::unique_ptr<IterationMode> makeChebyshev();
std::unique_ptr<IterationMode> makeConjugateGradient();
std::unique_ptr<IterationMode> makeGmres();
std::unique_ptr<IterationMode> makeDirect();
std::string directUnavailable(const ModeSetup& setup);

}  // namespace unshot
