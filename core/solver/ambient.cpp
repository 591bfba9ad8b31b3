#include "solver/ambient.h"

#include <algorithm>
#include <numeric>

namespace unshot {

AmbientTerm::AmbientTerm(std::size_t patches, std::span<const std::uint32_t> air)
    : group_(patches), noted_(patches, 0) {
  std::iota(group_.begin(), group_.end(), 0u);
  for (std::uint32_t q = 0; q < air.size(); ++q) group_[find(q)] = find(air[q]);
}

std::uint32_t AmbientTerm::find(std::uint32_t q) const {
  while (group_[q] != q) q = group_[q] = group_[group_[q]];
  return q;
}

void AmbientTerm::sees(std::uint32_t q, const Column& column, const Receivers& receivers) {
  if (noted_[q]) return;
  noted_[q] = 1;
  const std::uint32_t root = find(q);
  column.forEach([&](std::uint32_t v, double) {
    for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s) {
      const std::uint32_t p = receivers.shares[s].patch;
      if (group_[p] != root) group_[find(p)] = root;
    }
  });
}

std::vector<glm::dvec3> AmbientTerm::values(const RadiosityState& state) const {
  const std::size_t n = group_.size();
  std::vector<glm::dvec3> power(n, glm::dvec3(0.0)), reflected(n, glm::dvec3(0.0));
  std::vector<double> area(n, 0.0);
  for (std::uint32_t q = 0; q < n; ++q) {
    const std::uint32_t g = find(q);
    power[g] += state.area()[q] * state.unshot()[q];
    reflected[g] += state.area()[q] * state.reflectance()[q];
    area[g] += state.area()[q];
  }
  std::vector<glm::dvec3> out(n, glm::dvec3(0.0));
  for (std::uint32_t q = 0; q < n; ++q) {
    const std::uint32_t g = find(q);
    if (power[g].x < 0 || power[g].y < 0 || power[g].z < 0) continue;
    for (int c = 0; c < 3; ++c) {
      // Where everything reflects all light the series has no sum; a thousand bounces are as many as are
      // shown.
      const double absorbed = std::max(1 - reflected[g][c] / area[g], 1e-3);
      out[q][c] = power[g][c] / area[g] / absorbed;
    }
  }
  return out;
}

}  // namespace unshot
