// Draws what a hemicube sees with OpenGL.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "formfactor/hemicube_view.h"
#include "gl/context.h"
#include "gl/objects.h"
#include "mesh/mesh.h"

namespace unshot {

/// Lives and is used on the thread where the context is current.
class HemicubePicture final : public HemicubeView {
 public:
  HemicubePicture(gl::Context& context, const Mesh& mesh);

  Result look(const HemicubeFrame& frame, HemicubeLayout layout) override;

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
  double far_ = 1;    // [m]
  double scale_ = 1;  // of all that GL sees: the products of its clipping must stay in single precision
  std::vector<Item> items_;
  std::vector<float> distance_;
};

}  // namespace unshot
