#include "render/triangle_blocks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace unshot {
namespace {

// Normals of a flat block differ by no more, and an eye has to be twice as far behind its plane, of its
// distance.
constexpr float kFlat = 1e-4f;
constexpr float kRounding = 1e-5f;

glm::vec3 normalOf(const Mesh& mesh, const std::uint32_t* corner) {
  const glm::dvec3 p(mesh.vertices[corner[0]].position), q(mesh.vertices[corner[1]].position),
      r(mesh.vertices[corner[2]].position);
  const glm::dvec3 n = glm::cross(q - p, r - p);
  const double length = glm::length(n);
  return length > 0 ? glm::vec3(n / length) : glm::vec3(0.0f);
}

}  // namespace

TriangleBlocks::TriangleBlocks(const Mesh& mesh, std::span<const std::uint32_t> corners) {
  const std::size_t triangles = corners.size() / 3;
  blocks_.reserve(triangles / kTriangles + 1);
  for (std::size_t first = 0; first < triangles; first += kTriangles) {
    Block block{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(-std::numeric_limits<float>::max()),
                normalOf(mesh, &corners[3 * first])};
    for (std::size_t t = first; t < std::min(first + kTriangles, triangles); ++t) {
      for (int k = 0; k < 3; ++k) {
        const glm::vec3& p = mesh.vertices[corners[3 * t + static_cast<std::size_t>(k)]].position;
        block.least = glm::min(block.least, p);
        block.most = glm::max(block.most, p);
      }
      if (block.normal != glm::vec3(0.0f) &&
          glm::distance(normalOf(mesh, &corners[3 * t]), block.normal) > kFlat)
        block.normal = glm::vec3(0.0f);
    }
    blocks_.push_back(block);
  }
}

bool TriangleBlocks::isInView(const Block& block, const glm::mat4& view_projection, const glm::vec4& eye) {
  bool left = true, right = true, below = true, above = true, behind = true, away = true;
  for (int k = 0; k < 8; ++k) {
    const glm::vec3 p = block.corner(k), to_eye = glm::vec3(eye) - eye.w * p;
    const glm::vec4 clip = view_projection * glm::vec4(p, 1.0f);
    const float margin = kRounding * (std::abs(clip.x) + std::abs(clip.y) + std::abs(clip.w));
    left = left && clip.x + clip.w < -margin;
    right = right && clip.w - clip.x < -margin;
    below = below && clip.y + clip.w < -margin;
    above = above && clip.w - clip.y < -margin;
    behind = behind && clip.w <= 0;
    away = away && glm::dot(block.normal, to_eye) < -2 * kFlat * glm::length(to_eye);
  }
  return !(left || right || below || above || behind || away);
}

TrianglesInView TriangleBlocks::inView(const glm::mat4& view_projection, const glm::vec4& eye,
                                       const TriangleRun& among, std::size_t most) const {
  TrianglesInView out{{}, among.first, 0};
  while (out.end < among.end && out.count < most) {
    const std::size_t block = out.end / kTriangles;
    std::size_t stop = std::min(among.end, (block + 1) * kTriangles);
    if (isInView(blocks_[block], view_projection, eye)) {
      stop = out.end + std::min(stop - out.end, most - out.count);
      if (!out.runs.empty() && out.runs.back().end == out.end)
        out.runs.back().end = stop;
      else
        out.runs.push_back({out.end, stop});
      out.count += stop - out.end;
    }
    out.end = stop;
  }
  return out;
}

}  // namespace unshot
