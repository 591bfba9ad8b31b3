#include "formfactor/hemicube_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <numeric>

#include "mesh/lit.h"

namespace unshot {
namespace {

struct ItemVertex {
  glm::vec3 position;
  glm::vec2 chart;
  std::uint32_t surface;
  glm::vec3 heights;
};

// Triangles that are culled and drawn together. A software rasteriser (Mesa's) clips a whole draw the slow
// way as soon as one of its triangles crosses the frustum, so clusters are small and not merged: half the
// time of 256 in a scene of 15,000.
constexpr std::uint32_t kClusterVertices = 3 * 48;

// Spreads the low 10 bits of x to every third bit.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffu;
  x = (x | x << 8) & 0x0300f00fu;
  x = (x | x << 4) & 0x030c30c3u;
  return (x | x << 2) & 0x09249249u;
}

// Lit surfaces along a space-filling curve (Morton 1966), so that neighbours in the buffer are neighbours in
// space.
std::vector<std::uint32_t> spatialOrder(const Mesh& mesh) {
  const glm::dvec3 size = glm::max(mesh.bounds_max - mesh.bounds_min, 1e-300);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed;
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    const Surface& surface = mesh.surfaces[s];
    if (!isLit(surface)) continue;
    const glm::dvec3 t = (surface.point(surface.extent / 2.0) - mesh.bounds_min) / size;
    const glm::uvec3 q(glm::clamp(t, 0.0, 1.0) * 1023.0);
    keyed.emplace_back(spread(q.x) | spread(q.y) << 1 | spread(q.z) << 2, s);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  for (const auto& [key, s] : keyed) order.push_back(s);
  return order;
}

}  // namespace

HemicubePicture::HemicubePicture(gl::Context& context, const Mesh& mesh)
    : context_(context),
      program_(context, {"item_buffer.vert", "item_buffer.frag"}),
      vertex_array_(context),
      vertices_(context) {
  far_ = 2 * glm::length(mesh.bounds_max - mesh.bounds_min);
  // A power of two rounds nothing.
  scale_ = std::isnormal(far_) ? std::ldexp(1.0, -std::ilogb(far_)) : 1;
  upload(mesh);
}

void HemicubePicture::upload(const Mesh& mesh) {
  std::vector<ItemVertex> vertices;
  vertices.reserve(3 * litTriangles(mesh).size());
  for (const std::uint32_t s : spatialOrder(mesh)) {
    const Surface& surface = mesh.surfaces[s];
    for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
      const ChartTriangle& triangle = mesh.triangles[t];
      if (vertices.size() % kClusterVertices == 0) {
        clusters_.push_back(
            {static_cast<std::uint32_t>(vertices.size()), 0, glm::dvec3(INFINITY), glm::dvec3(-INFINITY)});
      }
      const glm::dmat3 heights = scale_ * outlineHeights(triangle, far_);
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3& p = mesh.positions[triangle.position[k]];
        vertices.push_back(
            {glm::vec3(scale_ * p), glm::vec2(triangle.uv[k] / surface.extent), s, glm::vec3(heights[k])});
        clusters_.back().low = glm::min(clusters_.back().low, p);
        clusters_.back().high = glm::max(clusters_.back().high, p);
        ++clusters_.back().count;
      }
    }
  }
  const gl::Functions& fn = context_.functions();
  fn.BindVertexArray(vertex_array_.id());
  fn.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  fn.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(ItemVertex)),
                vertices.data(), GL_STATIC_DRAW);
  const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
  fn.EnableVertexAttribArray(0);
  fn.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(ItemVertex), at(offsetof(ItemVertex, position)));
  fn.EnableVertexAttribArray(1);
  fn.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(ItemVertex), at(offsetof(ItemVertex, chart)));
  fn.EnableVertexAttribArray(2);
  fn.VertexAttribIPointer(2, 1, GL_UNSIGNED_INT, sizeof(ItemVertex), at(offsetof(ItemVertex, surface)));
  fn.EnableVertexAttribArray(3);
  fn.VertexAttribPointer(3, 3, GL_FLOAT, GL_FALSE, sizeof(ItemVertex), at(offsetof(ItemVertex, heights)));
  gl::checkErrors(fn, "uploading the scene for hemicubes");
}

HemicubePicture::Target& HemicubePicture::target(HemicubeLayout layout) {
  for (Target& t : targets_) {
    if (t.resolution == layout.resolution) return t;
  }
  const gl::Functions& fn = context_.functions();
  Target t{layout.resolution, gl::Texture(context_), gl::Texture(context_), gl::Framebuffer(context_)};
  const auto width = static_cast<GLsizei>(layout.width()), height = static_cast<GLsizei>(layout.height());
  fn.BindTexture(GL_TEXTURE_2D, t.items.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RG32UI, width, height, 0, GL_RG_INTEGER, GL_UNSIGNED_INT, nullptr);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  fn.BindTexture(GL_TEXTURE_2D, t.depth.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width, height, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                nullptr);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  fn.BindFramebuffer(GL_FRAMEBUFFER, t.framebuffer.id());
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, t.items.id(), 0);
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, t.depth.id(), 0);
  t.framebuffer.checkComplete("hemicube item buffer");
  targets_.push_back(std::move(t));
  return targets_.back();
}

HemicubeView::Result HemicubePicture::look(const HemicubeFrame& frame, HemicubeLayout layout) {
  const gl::Functions& fn = context_.functions();
  fn.BindFramebuffer(GL_FRAMEBUFFER, target(layout).framebuffer.id());
  fn.Enable(GL_DEPTH_TEST);
  fn.DepthFunc(GL_LESS);
  fn.DepthMask(GL_TRUE);
  fn.Disable(GL_CULL_FACE);
  fn.Disable(GL_BLEND);
  fn.Disable(GL_SCISSOR_TEST);
  const std::array<GLuint, 4> nothing{~0u, ~0u, ~0u, ~0u};
  const GLfloat farthest = 1;
  fn.ClearBufferuiv(GL_COLOR, 0, nothing.data());
  fn.ClearBufferfv(GL_DEPTH, 0, &farthest);
  program_.use();
  fn.BindVertexArray(vertex_array_.id());
  const glm::vec3 eye(scale_ * frame.eye);
  fn.Uniform3f(program_.uniform("eye"), eye.x, eye.y, eye.z);
  fn.Uniform1ui(program_.uniform("own_surface"), frame.own_surface);
  fn.Uniform1f(program_.uniform("inverse_far"), static_cast<float>(1 / (scale_ * far_)));
  fn.Uniform1f(program_.uniform("tie_margin"), static_cast<float>(kTieMargin * scale_ * far_));

  const HemicubeFaces faces(frame);
  for (std::uint32_t face = 0; face < 5; ++face) {
    fn.Viewport(0, static_cast<GLint>(layout.faceRow(face)), static_cast<GLsizei>(layout.width()),
                static_cast<GLsizei>(layout.faceHeight(face)));
    drawFace(frame, faces.forward[face], faces.up[face], face == 0);
  }
  const std::size_t pixels = std::size_t{layout.width()} * layout.height();
  items_.resize(pixels);
  distance_.resize(pixels);
  fn.PixelStorei(GL_PACK_ALIGNMENT, 4);
  fn.ReadPixels(0, 0, static_cast<GLsizei>(layout.width()), static_cast<GLsizei>(layout.height()),
                GL_RG_INTEGER, GL_UNSIGNED_INT, items_.data());
  fn.ReadPixels(0, 0, static_cast<GLsizei>(layout.width()), static_cast<GLsizei>(layout.height()),
                GL_DEPTH_COMPONENT, GL_FLOAT, distance_.data());
  gl::checkErrors(fn, "drawing a hemicube");  // a driver that was reset draws nothing, and would be believed
  return {items_, distance_, far_};
}

// Side faces are half as high as wide and end at the horizon (an off-centre frustum), so nothing behind the
// eye's plane needs clipping away.
void HemicubePicture::drawFace(const HemicubeFrame& frame, const glm::dvec3& forward, const glm::dvec3& up,
                               bool top) {
  const gl::Functions& fn = context_.functions();
  const double near = scale_ * frame.near_distance;
  const glm::dmat4 projection = glm::frustum(-near, near, top ? -near : 0.0, near, near, scale_ * far_);
  const glm::dmat4 view = glm::lookAt(glm::dvec3(0.0), forward, up);
  const glm::mat4 matrix(projection * view);
  fn.UniformMatrix4fv(program_.uniform("view_projection"), 1, GL_FALSE, glm::value_ptr(matrix));
  collectVisible(frame, forward, up, top);
  if (!first_.empty())
    fn.MultiDrawArrays(GL_TRIANGLES, first_.data(), count_.data(), static_cast<GLsizei>(first_.size()));
}

// Clusters that reach into the face's pyramid.
void HemicubePicture::collectVisible(const HemicubeFrame& frame, const glm::dvec3& forward,
                                     const glm::dvec3& up, bool top) {
  first_.clear();
  count_.clear();
  const glm::dvec3 side = glm::cross(forward, up);
  const std::array<glm::dvec3, 5> inward{forward + side, forward - side, top ? forward + up : up,
                                         forward - up, forward};
  for (const Cluster& cluster : clusters_) {
    const glm::dvec3 low = cluster.low - frame.eye, high = cluster.high - frame.eye;
    const bool outside = std::any_of(inward.begin(), inward.end(), [&](const glm::dvec3& n) {
      const glm::dvec3 farthest{n.x > 0 ? high.x : low.x, n.y > 0 ? high.y : low.y, n.z > 0 ? high.z : low.z};
      return glm::dot(n, farthest) < 0;
    });
    if (outside) continue;
    first_.push_back(static_cast<GLint>(cluster.first));
    count_.push_back(static_cast<GLsizei>(cluster.count));
  }
}

}  // namespace unshot
