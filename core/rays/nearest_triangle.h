// The triangle nearest to a point (Embree point queries, single precision).
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

namespace unshot {

class NearestTriangle {
 public:
  struct Hit {
    std::uint32_t triangle = 0;
    glm::vec3 weights{0.0f};  ///< barycentric, of the nearest point of the triangle; they sum to 1
    float distance = 0;
  };

  /// `corners`: three indices into `positions` per triangle. Both are copied.
  NearestTriangle(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners);
  ~NearestTriangle();
  NearestTriangle(const NearestTriangle&) = delete;
  NearestTriangle& operator=(const NearestTriangle&) = delete;

  /// The nearest of the triangles within `radius` that `accept` lets pass; of equally near ones, the one with
  /// the lowest number. Any thread.
  std::optional<Hit> find(const glm::vec3& point, float radius,
                          const std::function<bool(std::uint32_t)>& accept) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace unshot
