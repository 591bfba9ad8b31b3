#include "render/targets.h"

namespace unshot {

DepthSetup::DepthSetup(const gl::Functions& fn) {
  if (!fn.ClipControl) return;
  range = DepthRange::kReversed;
  format = GL_DEPTH_COMPONENT32F;
  farthest = 0;
}

LinearTarget::LinearTarget(gl::Context& context, int width, int height)
    : colour_(context), depth_(context), framebuffer_(context), width_(width), height_(height) {
  const gl::Functions& fn = context.functions();
  const StateGuard guard(fn);
  fn.BindTexture(GL_TEXTURE_2D, colour_.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  fn.BindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  fn.RenderbufferStorage(GL_RENDERBUFFER, DepthSetup(fn).format, width, height);
  fn.BindRenderbuffer(GL_RENDERBUFFER, 0);
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.id(), 0);
  fn.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  framebuffer_.checkComplete("a picture of floats");
}

void LinearTarget::bind() const {
  framebuffer_.fn().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  framebuffer_.fn().Viewport(0, 0, width_, height_);
}

void LinearTarget::bindForDrawing() const {
  framebuffer_.fn().BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.id());
  framebuffer_.fn().Viewport(0, 0, width_, height_);
}

std::vector<glm::vec4> LinearTarget::read() const {
  bind();
  std::vector<glm::vec4> pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  framebuffer_.fn().ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, pixels.data());
  return pixels;
}

StateGuard::StateGuard(const gl::Functions& fn) : fn_(fn) {
  fn.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_framebuffer_);
  fn.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_framebuffer_);
  fn.GetIntegerv(GL_VIEWPORT, viewport_);
}

StateGuard::~StateGuard() {
  fn_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_framebuffer_));
  fn_.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_framebuffer_));
  fn_.Viewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  fn_.Disable(GL_DEPTH_TEST);
  fn_.DepthFunc(GL_LESS);
  if (fn_.ClipControl) fn_.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  fn_.Disable(GL_CULL_FACE);
  fn_.Disable(GL_CLIP_DISTANCE0);
  fn_.BindVertexArray(0);
  fn_.UseProgram(0);
  fn_.ActiveTexture(GL_TEXTURE0);
}

void setPassState(const gl::Functions& fn, bool depth_and_culling) {
  for (GLenum off : {GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_CLIP_DISTANCE0, GL_RASTERIZER_DISCARD,
                     GL_POLYGON_OFFSET_FILL, GL_FRAMEBUFFER_SRGB}) {
    fn.Disable(off);
  }
  fn.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  fn.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  if (!depth_and_culling) {
    fn.Disable(GL_DEPTH_TEST);
    fn.Disable(GL_CULL_FACE);
    return;
  }
  fn.Enable(GL_DEPTH_TEST);
  const bool reversed = DepthSetup(fn).range == DepthRange::kReversed;
  if (reversed) fn.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  fn.DepthFunc(reversed ? GL_GEQUAL : GL_LEQUAL);
  fn.DepthMask(GL_TRUE);
  fn.DepthRange(0, 1);
  fn.Enable(GL_CULL_FACE);
  fn.CullFace(GL_BACK);
  fn.FrontFace(GL_CCW);
}

}  // namespace unshot
