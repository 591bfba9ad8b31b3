// Framebuffers to draw into, and the state that the renderer shares with nobody.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "gl/objects.h"
#include "render/camera.h"

namespace unshot {

/// Depth in this context: reversed floats where the range of depth can be chosen (OpenGL 4.5 or
/// ARB_clip_control), else 24 bits from near to far.
struct DepthSetup {
  DepthRange range = DepthRange::kUsual;
  GLenum format = GL_DEPTH_COMPONENT24;  ///< of a renderbuffer
  GLfloat farthest = 1;                  ///< to clear with

  explicit DepthSetup(const gl::Functions& fn);
};

/// Linear RGB and class (float) with depth: what is drawn before exposure.
class LinearTarget {
 public:
  LinearTarget() = default;
  LinearTarget(gl::Context& context, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  GLuint texture() const { return colour_.id(); }
  /// Binds it for drawing, with a viewport of its size.
  void bind() const;
  /// Binds it for drawing only; what is bound for reading stays.
  void bindForDrawing() const;
  /// The pixels, lowest row first. It becomes bound.
  std::vector<glm::vec4> read() const;

 private:
  gl::Texture colour_;
  gl::Renderbuffer depth_;
  gl::Framebuffer framebuffer_;
  int width_ = 0, height_ = 0;
};

/// What is bound for drawing and its viewport, restored at the end of a scope; drawing state goes back to
/// OpenGL's defaults.
class StateGuard {
 public:
  explicit StateGuard(const gl::Functions& fn);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;
  GLuint drawFramebuffer() const { return static_cast<GLuint>(draw_framebuffer_); }

 private:
  const gl::Functions& fn_;
  GLint draw_framebuffer_ = 0, read_framebuffer_ = 0;
  GLint viewport_[4] = {};
};

/// Sets all fixed-function state that a pass without blending needs; depth as DepthSetup says.
void setPassState(const gl::Functions& fn, bool depth_and_culling);

}  // namespace unshot
