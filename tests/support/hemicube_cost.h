// What one hemicube costs, drawn and counted, at a given fineness of the mesh.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "base/clock.h"
#include "formfactor/methods.h"
#include "gl/context.h"
#include "mesh/build.h"
#include "support/dice.h"

namespace unshot::testing_support {

/// A mesh of the scene and its hemicube method.
class HemicubeCost {
 public:
  HemicubeCost(const Scene& scene, std::uint64_t elements, gl::Context& context)
      : mesh_(std::make_unique<Mesh>(buildMesh(scene, {elements, {}, false}))) {
    FormFactorSetup setup;
    setup.mesh = mesh_.get();
    setup.gl = [&context]() -> gl::Context& {
      context.makeCurrent();
      return context;
    };
    method_ = makeHemicube(setup);
  }

  const Mesh& mesh() const { return *mesh_; }
  FormFactorMethod& method() { return *method_; }

  /// CPU seconds, of all threads, that each hemicube of a column takes: drawn, read back, counted and made
  /// into the column. Of a patch that does not shine, since those that do are drawn finer.
  double measureOnce(Dice& dice) {
    std::uint32_t patch = 0;
    do {
      patch = dice.below(mesh_->patch_count);
    } while (mesh_->sides[mesh_->patch_side[patch]].emission != glm::dvec3(0.0));
    const std::uint64_t drawn = method_->drawn();
    const double start = cpuSeconds();
    method_->column(patch);
    seconds_.push_back((cpuSeconds() - start) / static_cast<double>(method_->drawn() - drawn));
    return seconds_.back();
  }

  /// Of all that were measured; CPU seconds.
  double median() const {
    std::vector<double> sorted = seconds_;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    return sorted[sorted.size() / 2];
  }

 private:
  std::unique_ptr<Mesh> mesh_;
  std::unique_ptr<FormFactorMethod> method_;
  std::vector<double> seconds_;
};

}  // namespace unshot::testing_support
