// Small pictures of a scene's own polygons whose pixels say which side is seen.
#pragma once

#include <cstdint>
#include <vector>

#include "gl/objects.h"
#include "mesh/mesh.h"
#include "render/camera.h"

namespace unshot {

/// All calls on the thread where the context is current. It changes what is bound: see StateGuard.
class SidePictures {
 public:
  SidePictures(gl::Context& context, const Mesh& mesh, int width, int height);

  GLsizei triangles() const { return index_count_ / 3; }
  /// Side + 1, or 0 for none (where surfaces without a lit side hide others too), one per pixel, lowest row
  /// first.
  std::vector<std::uint32_t> look(const Camera& camera);

 private:
  void upload(const Mesh& mesh);

  gl::Context& context_;
  Bounds bounds_;
  gl::Program program_;
  gl::Buffer vertices_, indices_, sides_;
  gl::VertexArray vertex_array_;
  gl::Texture ids_, sides_texture_;
  gl::Renderbuffer depth_;
  gl::Framebuffer framebuffer_;
  int width_, height_;
  GLsizei index_count_ = 0;
};

}  // namespace unshot
