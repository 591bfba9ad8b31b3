// Scenes and options of the session tests: form factors in closed form, so that no OpenGL is loaded.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "scene/obj_reader.h"
#include "session/solve.h"
#include "support/assets.h"
#include "support/session_watch.h"

namespace unshot::testing_support {

inline SolveOptions closedForm(std::uint64_t elements, double error, const std::string& mode = "auto") {
  SolveOptions options;
  options.form_factors = "closed-form";
  options.elements = elements;
  options.error = error;
  options.mode = mode;
  return options;
}

/// Options with which no solve of these tests comes to an end in its time.
inline SolveOptions endless(std::uint64_t elements = 600) { return closedForm(elements, 1e-300); }

/// A solve without a thread, to its end.
inline std::unique_ptr<Solve> plainSolve(const std::filesystem::path& scene, const SolveOptions& options) {
  auto solve = std::make_unique<Solve>(readObj(scene), options, [&]() -> gl::Context& {
    throw Error(ErrorKind::kInternal, "closed forms do not draw");
  });
  while (solve->state() == SolveState::kRunning) solve->step(Solve::kMostAtOnce);
  return solve;
}

/// The largest difference of two fields, over the largest value.
inline double relativeDifference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  if (a.size() != b.size()) return 1e300;
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      difference = std::max(difference, std::abs(double{a[i][c]} - double{b[i][c]}));
      largest = std::max(largest, std::abs(double{b[i][c]}));
    }
  }
  return difference / largest;
}

inline bool hasShot(const SessionState& s) { return s.measures.shots > 0; }

}  // namespace unshot::testing_support
