// What one hemicube costs, drawn and counted, at a given fineness of the mesh.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
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
  /// `elements`: 0 for the default.
  HemicubeCost(const Scene& scene, std::uint64_t elements, gl::Context& context,
               HemicubeDrawing drawing = HemicubeDrawing::kAuto)
      : mesh_(std::make_unique<Mesh>(buildMesh(scene, {countOf(elements), {}, false}))) {
    FormFactorSetup setup;
    setup.hemicube_drawing = drawing;
    setup.mesh = mesh_.get();
    setup.gl = [&context]() -> gl::Context& {
      context.makeCurrent();
      return context;
    };
    method_ = makeHemicube(setup);
  }

  const Mesh& mesh() const { return *mesh_; }
  FormFactorMethod& method() { return *method_; }

  /// A patch that does not shine (those that do are drawn finer), where such a one is soon found.
  std::uint32_t somePatch(Dice& dice) const {
    std::uint32_t patch = 0;
    for (int tries = 0; tries < 1000; ++tries) {
      patch = dice.below(mesh_->patch_count);
      if (mesh_->sides[mesh_->patch_side[patch]].emission == glm::dvec3(0.0)) break;
    }
    return patch;
  }
  /// CPU seconds, of all threads, that each hemicube of a column (of a draft: there is one) takes: drawn,
  /// read back, counted and made into the column.
  double measureOnce(std::uint32_t patch, bool draft = false) {
    const std::uint64_t drawn = method_->drawn();
    const double start = cpuSeconds(), wall_start = wallSeconds();
    draft ? method_->draft(patch, ColumnQuality::kOnePoint) : method_->column(patch);
    const auto pictures = static_cast<double>(method_->drawn() - drawn);
    seconds_.push_back((cpuSeconds() - start) / pictures);
    wall_.push_back((wallSeconds() - wall_start) / pictures);
    return seconds_.back();
  }
  double measureOnce(Dice& dice) { return measureOnce(somePatch(dice)); }

  /// Of all that were measured; CPU seconds.
  double median() const { return medianOf(seconds_); }
  double medianWall() const { return medianOf(wall_); }

 private:
  static std::optional<std::uint64_t> countOf(std::uint64_t elements) {
    return elements == 0 ? std::nullopt : std::optional(elements);
  }
  static double medianOf(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  }

  std::unique_ptr<Mesh> mesh_;
  std::unique_ptr<FormFactorMethod> method_;
  std::vector<double> seconds_, wall_;
};

}  // namespace unshot::testing_support
