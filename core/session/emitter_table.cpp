#include "session/emitter_table.h"

#include <algorithm>

namespace unshot {
namespace {

// Of the scene's size: the fourth power of less leaves the range of single precision.
constexpr float kLeastRadius = 1e-6f;

}  // namespace

void EmitterTable::add(const glm::dvec3& centre, const glm::dvec3& normal, double radius, double power) {
  for (int c = 0; c < 3; ++c) {
    centre_[c].push_back(static_cast<float>(centre[c] * scale_));
    normal_[c].push_back(static_cast<float>(normal[c]));
  }
  radius_.push_back(std::max(static_cast<float>(radius * scale_), kLeastRadius));
  power_.push_back(static_cast<float>(power));
}

void EmitterTable::fill() {
  while (power_.size() % kBlock != 0) add(glm::dvec3(0.0), glm::dvec3(0.0), 1 / scale_, 0);
}

double EmitterTable::shares(const glm::dvec3& position, const glm::dvec3& normal, double spread,
                            std::vector<float>& out) const {
  out.resize(power_.size());
  const glm::vec3 p(position * scale_), n(normal);
  const auto wide = static_cast<float>(spread * scale_);
  const float *x = centre_[0].data(), *y = centre_[1].data(), *z = centre_[2].data();
  const float *nx = normal_[0].data(), *ny = normal_[1].data(), *nz = normal_[2].data();
  const float *radii = radius_.data(), *power = power_.data();
  float* const share = out.data();
  double total = 0;
  for (std::size_t first = 0; first < out.size(); first += kBlock) {
    // As many at a time as the processor takes.
    for (std::size_t k = first; k < first + kBlock; ++k) {
      const float dx = x[k] - p.x, dy = y[k] - p.y, dz = z[k] - p.z;
      const float radius = radii[k] + wide;
      const float square = dx * dx + dy * dy + dz * dz + radius * radius;
      const float above = dx * n.x + dy * n.y + dz * n.z + radius;
      const float in_front = radius - (dx * nx[k] + dy * ny[k] + dz * nz[k]);
      share[k] = power[k] * std::max(above, 0.0f) * std::max(in_front, 0.0f) / (square * square);
    }
    float sum = 0;
    for (std::size_t k = first; k < first + kBlock; ++k) sum += share[k];
    total += static_cast<double>(sum);
  }
  return total;
}

}  // namespace unshot
