// Blocks of a mesh's display triangles, so that those that a view cannot see are not drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace unshot {

/// Triangles [first, end).
struct TriangleRun {
  std::size_t first = 0, end = 0;
  bool operator==(const TriangleRun&) const = default;
};

struct TrianglesInView {
  std::vector<TriangleRun> runs;  ///< in their order, as few as it takes
  std::size_t end = 0;            ///< all that may be seen and are before it are in them ...
  std::size_t count = 0;          ///< ... so many
};

class TriangleBlocks {
 public:
  static constexpr std::size_t kTriangles = 512;  ///< of a block

  TriangleBlocks() = default;
  explicit TriangleBlocks(const Mesh& mesh) : TriangleBlocks(mesh, mesh.triangle_vertices) {}
  /// Of other triangles over its vertices, three `corners` each.
  TriangleBlocks(const Mesh& mesh, std::span<const std::uint32_t> corners);

  /// Those of `among` that may be seen, at most so many: all but blocks that lie beside the view or behind
  /// the eye (homogeneousEye of the camera), and flat ones that face away.
  TrianglesInView inView(const glm::mat4& view_projection, const glm::vec4& eye, const TriangleRun& among,
                         std::size_t most = ~std::size_t{0}) const;

 private:
  struct Block {
    glm::vec3 least, most;
    glm::vec3 normal{0.0f};  ///< of all its triangles; 0: they differ
    glm::vec3 corner(int k) const {
      return {k & 1 ? most.x : least.x, k & 2 ? most.y : least.y, k & 4 ? most.z : least.z};
    }
  };
  static bool isInView(const Block& block, const glm::mat4& view_projection, const glm::vec4& eye);

  std::vector<Block> blocks_;
};

}  // namespace unshot
