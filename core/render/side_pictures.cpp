#include "render/side_pictures.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>

#include "render/targets.h"

namespace unshot {

SidePictures::SidePictures(gl::Context& context, const Mesh& mesh, int width, int height)
    : context_(context),
      bounds_{mesh.bounds_min, mesh.bounds_max},
      program_(context, {"side_id.vert", "side_id.frag"}),
      vertices_(context),
      indices_(context),
      sides_(context),
      vertex_array_(context),
      ids_(context),
      sides_texture_(context),
      depth_(context),
      framebuffer_(context),
      width_(width),
      height_(height) {
  upload(mesh);
  const gl::Functions& fn = context.functions();
  fn.BindTexture(GL_TEXTURE_2D, ids_.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_R32UI, width, height, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  fn.BindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  fn.RenderbufferStorage(GL_RENDERBUFFER, DepthSetup(fn).format, width, height);
  fn.BindRenderbuffer(GL_RENDERBUFFER, 0);
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, ids_.id(), 0);
  fn.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  framebuffer_.checkComplete("a picture of ids");
}

std::vector<std::uint32_t> SidePictures::look(const Camera& camera) {
  const gl::Functions& fn = context_.functions();
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  fn.Viewport(0, 0, width_, height_);
  setPassState(fn, true);
  fn.Disable(GL_CULL_FACE);  // each triangle stands for both of its sides
  const GLuint nothing[4] = {};
  const DepthSetup depth(fn);
  fn.ClearBufferuiv(GL_COLOR, 0, nothing);
  fn.ClearBufferfv(GL_DEPTH, 0, &depth.farthest);
  program_.use();
  const double aspect = static_cast<double>(width_) / height_;
  const glm::mat4 matrix = viewProjection(camera, aspect, bounds_, {}, depth.range);
  fn.UniformMatrix4fv(program_.uniform("view_projection"), 1, GL_FALSE, glm::value_ptr(matrix));
  fn.ActiveTexture(GL_TEXTURE0);
  fn.BindTexture(GL_TEXTURE_BUFFER, sides_texture_.id());
  fn.Uniform1i(program_.uniform("triangle_sides"), 0);
  fn.BindVertexArray(vertex_array_.id());
  fn.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  fn.BindVertexArray(0);
  std::vector<std::uint32_t> ids(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  fn.ReadPixels(0, 0, width_, height_, GL_RED_INTEGER, GL_UNSIGNED_INT, ids.data());
  return ids;
}

void SidePictures::upload(const Mesh& mesh) {
  std::vector<glm::vec3> positions(mesh.positions.begin(), mesh.positions.end());
  std::vector<std::uint32_t> indices;
  std::vector<glm::uvec2> sides;
  for (const Surface& surface : mesh.surfaces) {
    for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
      for (const std::uint32_t corner : mesh.triangles[t].position) indices.push_back(corner);
      const bool unlit = surface.side[0] == kNone && surface.side[1] == kNone;
      // kNone + 1 is 0.
      sides.push_back(unlit ? glm::uvec2(kNone) : glm::uvec2(surface.side[0] + 1, surface.side[1] + 1));
    }
  }
  index_count_ = static_cast<GLsizei>(indices.size());
  const gl::Functions& fn = context_.functions();
  const auto fill = [&](GLenum target, const gl::Buffer& buffer, const auto& values) {
    fn.BindBuffer(target, buffer.id());
    fn.BufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(values[0])), values.data(),
                  GL_STATIC_DRAW);
  };
  fn.BindVertexArray(vertex_array_.id());
  fill(GL_ARRAY_BUFFER, vertices_, positions);
  fn.EnableVertexAttribArray(0);
  fn.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  fill(GL_ELEMENT_ARRAY_BUFFER, indices_, indices);
  fn.BindVertexArray(0);
  fn.BindBuffer(GL_ARRAY_BUFFER, 0);
  fill(GL_TEXTURE_BUFFER, sides_, sides);
  fn.BindBuffer(GL_TEXTURE_BUFFER, 0);
  fn.BindTexture(GL_TEXTURE_BUFFER, sides_texture_.id());
  fn.TexBuffer(GL_TEXTURE_BUFFER, GL_RG32UI, sides_.id());
  fn.BindTexture(GL_TEXTURE_BUFFER, 0);
}

}  // namespace unshot
