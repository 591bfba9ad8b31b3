// What a hemicube sees: an item buffer with the surface, side, chart position and distance of each pixel, of
// the scene's own polygons and not of the mesh, so that refining the mesh makes no view dearer. Drawn with
// OpenGL or traced with rays.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "formfactor/delta_form_factors.h"
#include "mesh/mesh.h"

namespace unshot {

/// One pixel: what it sees.
struct Item {
  std::uint32_t code;   ///< kNone: nothing; else tie << 31 | surface << 1 | back
  std::uint32_t chart;  ///< u | v << 16, in 1/65536 of the chart's extent

  bool nothing() const { return code == kNone; }
  /// The surface's outline is so near that rounding may have let it win over the surface it ends at.
  bool tie() const { return code != kNone && (code >> 31) != 0; }
  std::uint32_t surface() const { return (code & 0x7fffffffu) >> 1; }
  std::uint32_t back() const { return code & 1; }
};

/// Where a hemicube stands. `right` and `normal` are orthonormal.
struct HemicubeFrame {
  glm::dvec3 eye{0.0}, normal{0, 0, 1}, right{1, 0, 0};
  std::uint32_t own_surface = kNone;  ///< not drawn: it lies in the horizon
  double near_distance = 0;           ///< what is nearer is not seen [m]
};

class HemicubeView {
 public:
  virtual ~HemicubeView() = default;

  /// One value per pixel of the layout; the spans stay valid until the next call.
  struct Result {
    std::span<const Item> items;
    std::span<const float> distance;  ///< in `far_distance`
    double far_distance;
  };
  virtual Result look(const HemicubeFrame& frame, HemicubeLayout layout) = 0;
};

/// Depth is the distance in single precision, so two surfaces that meet are told apart from this share of the
/// far distance on: nearer to its outline a surface is a tie.
inline constexpr double kTieMargin = 2e-6;

/// Heights of a triangle's corners over its edges [m]: out[corner][edge], edge e from corner e to e + 1. An
/// edge inside the surface is as far away as `far`.
glm::dmat3 outlineHeights(const ChartTriangle& triangle, double far);

/// The faces of a hemicube: forward directions and what is up in their pictures.
struct HemicubeFaces {
  glm::dvec3 forward[5], up[5];
  explicit HemicubeFaces(const HemicubeFrame& frame);
};

}  // namespace unshot
