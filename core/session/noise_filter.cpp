#include "session/noise_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace unshot {
namespace {

// How often each takes a mean over those around it, and they over those around them.
constexpr int kTimes = 4;
// How often variances, which a few looks know badly, take the mean of those around them before.
constexpr int kVarianceTimes = 2;
// A neighbour's weight falls to 1/e where the square of the difference is so many times what noise lets
// expect.
constexpr double kMostNoise = 4;
// Of vertices in one place so many are beside each.
constexpr std::size_t kMostInPlace = 8;
constexpr std::size_t kVerticesOfPart = 1'024;

// Where a vertex is and which way it faces: normals of one plane differ by rounding from surface to surface.
std::array<float, 6> placeOf(const Vertex& v) {
  const auto coarse = [](float x) { return std::round(64 * x); };
  return {v.position.x,       v.position.y,       v.position.z,
          coarse(v.normal.x), coarse(v.normal.y), coarse(v.normal.z)};
}

}  // namespace

NoiseFilter::NoiseFilter(const Mesh& mesh) {
  const std::vector<Vertex>& vertices = mesh.vertices;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(3 * mesh.triangle_vertices.size());
  const auto link = [&](std::uint32_t a, std::uint32_t b) {
    pairs.emplace_back(a, b);
    pairs.emplace_back(b, a);
  };
  for (std::size_t t = 0; t < mesh.triangle_vertices.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k)
      link(mesh.triangle_vertices[t + k], mesh.triangle_vertices[t + (k + 1) % 3]);
  }
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return placeOf(vertices[a]) < placeOf(vertices[b]); });
  for (std::size_t k = 1; k < order.size(); ++k) {
    for (std::size_t before = k; before > 0 && k - before < kMostInPlace; --before) {
      if (placeOf(vertices[order[before - 1]]) != placeOf(vertices[order[k]])) break;
      link(order[before - 1], order[k]);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  start_.assign(vertices.size() + 1, 0);
  for (const auto& [a, b] : pairs) ++start_[a + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  around_.reserve(pairs.size());
  for (const auto& [a, b] : pairs) around_.push_back(b);
}

std::vector<glm::dvec3> NoiseFilter::filtered(std::vector<glm::dvec3> values, std::vector<double> variance,
                                              Workers& workers) const {
  std::vector<glm::dvec3> next_values(values.size());
  std::vector<double> next_variance(values.size());
  const std::size_t parts = (values.size() + kVerticesOfPart - 1) / kVerticesOfPart;
  const auto forEach = [&](auto&& work) {
    workers.run(parts, [&](std::size_t part, unsigned) {
      const std::size_t end = std::min(values.size(), (part + 1) * kVerticesOfPart);
      for (std::size_t v = part * kVerticesOfPart; v < end; ++v) work(v);
    });
  };
  const auto dark = [&](std::size_t v) { return variance[v] == 0; };
  for (int time = 0; time < kVarianceTimes; ++time) {
    forEach([&](std::size_t v) {
      if (dark(v)) return void(next_variance[v] = 0);
      double sum = variance[v];
      int count = 1;
      for (std::uint32_t k = start_[v]; k < start_[v + 1]; ++k) {
        if (dark(around_[k])) continue;
        sum += variance[around_[k]];
        ++count;
      }
      next_variance[v] = sum / count;
    });
    variance.swap(next_variance);
  }
  for (int time = 0; time < kTimes; ++time) {
    forEach([&](std::size_t v) {
      glm::dvec3 sum = values[v];
      double weights = 1, squares = variance[v];
      for (std::uint32_t k = start_[v]; k < start_[v + 1] && !dark(v); ++k) {
        const std::uint32_t w = around_[k];
        const double noise = variance[v] + variance[w];
        if (dark(w) || !(noise > 0)) continue;
        const glm::dvec3 apart = values[w] - values[v];
        const double weight = std::exp(-glm::dot(apart, apart) / (kMostNoise * noise));
        sum += weight * values[w];
        weights += weight;
        squares += weight * weight * variance[w];
      }
      next_values[v] = sum / weights;
      next_variance[v] = squares / (weights * weights);
    });
    values.swap(next_values);
    variance.swap(next_variance);
  }
  return values;
}

}  // namespace unshot
