#include "session/leap.h"

#include <cmath>
#include <utility>
#include <vector>

namespace unshot {
namespace {

constexpr std::size_t kMostEntries = 2'000'000;
// Bounces are added up until this share of what there was to be sent is left, but no more than so many.
constexpr double kLeft = 1.0 / 64;
constexpr int kMostBounces = 24;

double powerOfPatches(const RadiosityState& state, const std::vector<glm::dvec3>& x) {
  double sum = 0;
  for (std::size_t q = 0; q < x.size(); ++q)
    sum += state.area()[q] * (std::abs(x[q].x) + std::abs(x[q].y) + std::abs(x[q].z));
  return sum;
}

}  // namespace

bool canLeapBy(const PatchMatrix& matrix) { return matrix.entryCount() <= kMostEntries; }

void Leap::begin(const PatchMatrix& matrix, const RadiosityState& state, const Transport& transport) {
  std::vector<char> sends(state.patchCount());
  for (std::uint32_t q = 0; q < sends.size(); ++q)
    sends[q] = matrix.knows(q) && transport.isKept(q) && state.emissionLeft(q) == glm::dvec3(0.0);
  const auto keepSent = [&](std::vector<glm::dvec3>& x) {
    for (std::size_t q = 0; q < x.size(); ++q) x[q] = sends[q] ? x[q] : glm::dvec3(0.0);
  };
  std::vector<glm::dvec3> bounce = state.unshot(), image(sends.size());
  keepSent(bounce);
  std::vector<glm::dvec3> d = bounce;
  const double first = powerOfPatches(state, bounce);
  running_ = first > 0;
  if (!running_) return;
  for (int k = 1; k < kMostBounces; ++k) {
    matrix.product(bounce, image);
    for (std::size_t q = 0; q < image.size(); ++q) bounce[q] = state.reflectance()[q] * image[q];
    keepSent(bounce);
    if (powerOfPatches(state, bounce) <= kLeft * first) break;
    for (std::size_t q = 0; q < d.size(); ++q) d[q] += bounce[q];
  }
  product_.begin(transport, std::move(d));
}

std::size_t Leap::advance(RadiosityState& state, Transport& transport) {
  const std::size_t used = product_.advance(transport);
  if (product_.running()) return used;
  running_ = false;
  state.add(glm::dvec3(1.0), product_.flow());
  return used;
}

}  // namespace unshot
