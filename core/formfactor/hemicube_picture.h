// Draws the item buffer of a hemicube with OpenGL: the scene's own polygons, not the mesh, so that refining
// the mesh makes no picture dearer.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "formfactor/delta_form_factors.h"
#include "gl/context.h"
#include "gl/objects.h"
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

/// Lives and is used on the thread where the context is current.
class HemicubePicture {
 public:
  HemicubePicture(gl::Context& context, const Mesh& mesh);

  /// Draws and reads back. The spans hold one value per pixel of the layout and stay valid until the next
  /// call.
  struct Result {
    std::span<const Item> items;
    std::span<const float> distance;  ///< in `far_distance`
    double far_distance;
  };
  Result draw(const HemicubeFrame& frame, HemicubeLayout layout);

 private:
  struct Cluster {
    std::uint32_t first, count;  // vertices
    glm::dvec3 low, high;
  };
  struct Target {
    std::uint32_t resolution = 0;
    gl::Texture items, depth;
    gl::Framebuffer framebuffer;
  };
  void upload(const Mesh& mesh);
  Target& target(HemicubeLayout layout);
  void drawFace(const HemicubeFrame& frame, const glm::dvec3& forward, const glm::dvec3& up, bool top);
  void collectVisible(const HemicubeFrame& frame, const glm::dvec3& forward, const glm::dvec3& up, bool top);

  gl::Context& context_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
  gl::Buffer vertices_;
  std::vector<Target> targets_;
  std::vector<Cluster> clusters_;
  std::vector<GLint> first_;
  std::vector<GLsizei> count_;
  double far_ = 1;
  std::vector<Item> items_;
  std::vector<float> distance_;
};

}  // namespace unshot
