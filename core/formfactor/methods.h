// The table of form-factor methods. A new method is its own file and a row here.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "base/cancel.h"
#include "base/choice.h"
#include "base/workers.h"
#include "formfactor/method.h"
#include "mesh/mesh.h"

namespace unshot {

namespace gl {
class Context;
}

/// How hemicubes are drawn. With kAuto and kClassic by OpenGL, but on a software renderer by rays where a
/// scene has more triangles than kDrawnTriangles say.
enum class HemicubeDrawing { kAuto, kClassic, kOpenGl, kRays };

/// kAuto is the faster one: 15,000 triangles take 2.8 ms drawn and 1.1 ms traced, 4,000 take 1.6 and 1.3
/// (unshot_bench --only drawings, in software on one core). kClassic draws while it can keep up.
inline constexpr std::size_t kDrawnTrianglesAuto = 5'000, kDrawnTrianglesClassic = 20'000;

/// What a method is made with. `gl` gives the context, current on the calling thread; called only by methods
/// that draw.
struct FormFactorSetup {
  const Mesh* mesh = nullptr;
  std::function<gl::Context&()> gl;
  std::uint64_t seed = 1;
  std::uint32_t hemicube_resolution = 0;  ///< pixels; 0: the method's own choice
  HemicubeDrawing hemicube_drawing = HemicubeDrawing::kAuto;
  /// Of the mesh at its vertices, for methods that have theirs there; null: they make them.
  std::shared_ptr<const Receivers> receivers = nullptr;
  /// That share out large columns; null: the calling thread does all. The values are the same.
  std::shared_ptr<Workers> workers = nullptr;
  CancelToken cancel = {};  ///< of setting up
};

struct FormFactorMethodRow {
  ChoiceInfo info;
  bool needs_gl = false;
  ReceiverKind receivers = ReceiverKind::kElements;
  std::unique_ptr<FormFactorMethod> (*make)(const FormFactorSetup&);
  /// Empty where the method is right for the scene, else why its result would be wrong there.
  std::string (*unsuited)(const Mesh&);
};

std::span<const FormFactorMethodRow> formFactorMethods();

std::unique_ptr<FormFactorMethod> makeHemicube(const FormFactorSetup& setup);
std::unique_ptr<FormFactorMethod> makeHemicubeVisibility(const FormFactorSetup& setup);
std::unique_ptr<FormFactorMethod> makeRays(const FormFactorSetup& setup);
std::unique_ptr<FormFactorMethod> makeClosedForm(const FormFactorSetup& setup);

/// Whether nothing can stand between any two points of lit sides of one room (Side::room): every surface has
/// all of its room on one side of its plane.
bool nothingCanOcclude(const Mesh& mesh);

}  // namespace unshot
