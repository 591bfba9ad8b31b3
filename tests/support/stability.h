// Runs cases of the stability suite as tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "stability/stability_run.h"
#include "support/sanitized.h"
#include "support/solving.h"

namespace unshot::testing_support {

inline StabilityResult stabilityOf(const StabilityCase& trial, const std::string& mode,
                                   const std::string& method, Fineness fineness = Fineness::kEven) {
  StabilityCase given = trial;
  if (kSanitized) given.most_seconds *= 20;
  return runStability(
      given, mode, method, []() -> gl::Context& { return sharedContext(); }, fineness);
}

enum class Expected {
  kPass,       ///< within its tolerance, and no exception
  kNoSurprise  ///< or what the program or the table says beforehand
};

inline void expectStable(const StabilityCase& trial, const std::string& mode, const std::string& method,
                         Expected expected = Expected::kNoSurprise, Fineness fineness = Fineness::kEven) {
  const StabilityResult r = stabilityOf(trial, mode, method, fineness);
  const std::string text = r.case_key + ", " + r.mode + ", " + r.form_factors + ": " + r.figure.what + " " +
                           std::to_string(r.figure.got) + " of " + std::to_string(r.figure.expected) + ", " +
                           std::string(nameOf(r.verdict)) + (r.note.empty() ? "" : ": " + r.note);
  std::printf("[ measured ] %s, error %.3g of %.3g, %.2f s\n", text.c_str(), r.figure.error(),
              r.figure.tolerance, r.seconds);
  if (expected == Expected::kPass) {
    EXPECT_EQ(r.verdict, Verdict::kPass) << text;
  } else {
    EXPECT_NE(r.verdict, Verdict::kFail) << text;
  }
}

}  // namespace unshot::testing_support
