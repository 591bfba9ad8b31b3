// Solves scenes with a GL context that all tests of a process share.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formfactor/methods.h"
#include "gl/context.h"
#include "session/solve.h"
#include "solver/modes.h"

namespace unshot::testing_support {

/// Owns the context: made when first asked for, destroyed before the process ends.
class GlEnvironment final : public testing::Environment {
 public:
  gl::Context& context() {
    if (!context_) context_ = gl::createContext("auto");
    return *context_;
  }
  void TearDown() override { context_.reset(); }

 private:
  std::unique_ptr<gl::Context> context_;
};

inline GlEnvironment* const kGlEnvironment =
    static_cast<GlEnvironment*>(testing::AddGlobalTestEnvironment(new GlEnvironment));

inline gl::Context& sharedContext() { return kGlEnvironment->context(); }

inline std::unique_ptr<Solve> begun(Scene scene, SolveOptions options) {
  return std::make_unique<Solve>(std::move(scene), std::move(options),
                                 []() -> gl::Context& { return sharedContext(); });
}

/// Solved until it stops by itself, which must be because it converged.
inline std::unique_ptr<Solve> solved(Scene scene, SolveOptions options) {
  std::unique_ptr<Solve> solve = begun(std::move(scene), std::move(options));
  while (solve->state() == SolveState::kRunning) solve->step();
  EXPECT_EQ(solve->state(), SolveState::kConverged) << solve->stoppedBy();
  return solve;
}

inline SolveOptions optionsOf(std::string_view method, std::uint64_t elements, double error) {
  SolveOptions options;
  options.form_factors = method;
  options.elements = elements;
  options.error = error;
  return options;
}

/// A method on a mesh, without a solve.
inline std::unique_ptr<FormFactorMethod> makeMethod(const FormFactorMethodRow& row, const Mesh& mesh,
                                                    std::uint32_t resolution = 0, std::uint64_t seed = 1) {
  FormFactorSetup setup;
  setup.mesh = &mesh;
  setup.seed = seed;
  setup.hemicube_resolution = resolution;
  setup.gl = []() -> gl::Context& {
    sharedContext().makeCurrent();
    return sharedContext();
  };
  return row.make(setup);
}

inline const FormFactorMethodRow& methodRow(std::string_view key) {
  return findChoice(formFactorMethods(), key, "form-factor method");
}

/// Whether the method knows that surfaces stand between others.
inline bool occludes(const FormFactorMethodRow& method) { return method.info.key != "closed-form"; }

inline std::vector<FormFactorMethodRow> occludingMethods() {
  std::vector<FormFactorMethodRow> out;
  for (const FormFactorMethodRow& row : formFactorMethods()) {
    if (occludes(row)) out.push_back(row);
  }
  return out;
}

/// For names of parametrised tests, which may hold letters and digits only.
inline std::string testName(std::string_view key) {
  std::string out;
  for (const char c : key) {
    if (std::isalnum(static_cast<unsigned char>(c))) out += c;
  }
  return out;
}

/// A figure behind a tolerance: shown with the test's output and in its XML.
inline void measured(const std::string& what, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g", value);
  testing::Test::RecordProperty(what, text);
  std::printf("[ measured ] %s: %s\n", what.c_str(), text);
}

/// Mean irradiance over each side's elements.
inline std::vector<glm::dvec3> sideMeans(const Snapshot& snapshot) {
  const Mesh& mesh = *snapshot.mesh;
  std::vector<glm::dvec3> sum(mesh.sides.size(), glm::dvec3(0.0));
  for (std::size_t e = 0; e < mesh.element_count; ++e) {
    sum[mesh.element_side[e]] += mesh.element_area[e] * glm::dvec3(snapshot.element_irradiance[e]);
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= mesh.surfaces[mesh.sides[k].surface].area;
  return sum;
}

/// The same as radiosity B = E + rho H.
inline std::vector<glm::dvec3> sideRadiosities(const Snapshot& snapshot) {
  std::vector<glm::dvec3> out = sideMeans(snapshot);
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = snapshot.mesh->sides[k].emission + snapshot.mesh->sides[k].reflectance * out[k];
  }
  return out;
}

}  // namespace unshot::testing_support
