// First hits of bundles of rays from one point (Embree, single precision, watertight).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "base/cancel.h"

namespace unshot {

class FirstHits {
 public:
  struct Hit {
    float distance = 0;
    std::uint32_t triangle = 0xffffffffu;  ///< none
    float weight1 = 0, weight2 = 0;        ///< barycentric, of the triangle's second and third corner
  };

  /// `corners`: three indices into `positions` per triangle. Both are copied.
  FirstHits(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners,
            const CancelToken& cancel = {});
  ~FirstHits();
  FirstHits(FirstHits&&) noexcept;
  FirstHits(const FirstHits&) = delete;
  FirstHits& operator=(const FirstHits&) = delete;

  /// The first hit farther than `near_distance` along each direction (unit length; neighbours in the span
  /// should be neighbours in direction). One hit per direction. Any thread.
  void trace(const glm::vec3& origin, float near_distance, std::span<const glm::vec3> directions,
             std::span<Hit> hits) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace unshot
