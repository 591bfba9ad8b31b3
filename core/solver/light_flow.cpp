#include "solver/light_flow.h"

namespace unshot {
namespace {

// So many columns at hand take less than a few milliseconds together.
constexpr int kColumnsOfAdvance = 64;

}  // namespace

void LightFlow::add(const glm::dvec3& factor, const LightFlow& other) {
  for (std::size_t q = 0; q < shot.size(); ++q) shot[q] += factor * other.shot[q];
  for (std::size_t v = 0; v < irradiance.size(); ++v) irradiance[v] += factor * other.irradiance[v];
  escaped += factor * other.escaped;
  defect += factor * other.defect;
}

void TransportProduct::begin(const Transport& transport, std::vector<glm::dvec3> d, bool transposed) {
  flow_.shot = std::move(d);
  flow_.irradiance.assign(transport.receiverCount(), glm::dvec3(0.0));
  flow_.escaped = flow_.defect = glm::dvec3(0.0);
  next_ = 0;
  transposed_ = transposed;
  running_ = true;
  if (!transposed) return;
  gathered_.assign(transport.patchCount(), glm::dvec3(0.0));
  weighted_.assign(transport.receiverCount(), glm::dvec3(0.0));
  for (const PatchShare& share : transport.receivers().shares) {
    weighted_[share.receiver] += share.area * flow_.shot[share.patch];
  }
}

bool TransportProduct::wanted(std::uint32_t q) const { return flow_.shot[q] != glm::dvec3(0.0); }

std::size_t TransportProduct::advance(Transport& transport) {
  std::size_t used = 0;
  const auto n = static_cast<std::uint32_t>(flow_.shot.size());
  for (; next_ < n && used < kColumnsOfAdvance; ++next_) {
    if (!wanted(next_)) continue;
    const bool at_hand = transport.isKept(next_);
    if (!at_hand && used > 0) break;
    const Column& column = transport.column(next_);
    const glm::dvec3 d = flow_.shot[next_];
    if (transposed_) {
      glm::dvec3 sum(0.0);
      column.forEach([&](std::uint32_t v, double k) {
        flow_.irradiance[v] += k * d;
        sum += k * weighted_[v];
      });
      gathered_[next_] = sum;
    } else {
      column.forEach([&](std::uint32_t v, double k) { flow_.irradiance[v] += k * d; });
    }
    const glm::dvec3 power = transport.patchArea()[next_] * d;
    flow_.escaped += column.escape * power;
    flow_.defect += column.defect * power;
    ++used;
    if (!at_hand) {
      ++next_;
      break;
    }
  }
  running_ = next_ < n;
  while (running_ && !wanted(next_)) running_ = ++next_ < n;
  return used;
}

std::vector<glm::dvec3> reflectedMeans(const Transport& transport, const std::vector<glm::dvec3>& reflectance,
                                       const std::vector<glm::dvec3>& f) {
  std::vector<glm::dvec3> out(transport.patchCount(), glm::dvec3(0.0));
  for (const PatchShare& share : transport.receivers().shares)
    out[share.patch] += share.area * f[share.receiver];
  for (std::size_t q = 0; q < out.size(); ++q) out[q] *= reflectance[q] / transport.patchArea()[q];
  return out;
}

}  // namespace unshot
