#include "solver/bounce_series.h"

#include <glm/common.hpp>

#include "solver/patch_sums.h"

namespace unshot {
namespace {

// A bounce with less of what is emitted than this is the last.
constexpr double kLeastBounce = 1e-5;

}  // namespace

glm::dvec3 powerOf(const RadiosityState& state, const std::vector<glm::dvec3>& x) {
  glm::dvec3 power(0.0);
  for (std::size_t q = 0; q < x.size(); ++q) power += state.area()[q] * glm::abs(x[q]);
  return power;
}

BounceSeries::BounceSeries(Transport& transport, const RadiosityState& state)
    : transport_(transport), state_(state) {}

std::vector<std::uint32_t> BounceSeries::missing() const {
  std::vector<std::uint32_t> out;
  const glm::dvec3 none(0.0);
  for (std::uint32_t q = 0; q < state_.patchCount(); ++q) {
    const bool holds =
        state_.shot()[q] != none || state_.unshot()[q] != none || (!bounce_.empty() && bounce_[q] != none);
    const bool sends = state_.emission()[q] != none || state_.reflectance()[q] != none;
    if (holds && sends && !transport_.isKept(q)) out.push_back(q);
  }
  return out;
}

bool BounceSeries::follow() {
  if (version_ == version()) return false;
  version_ = version();
  powers_.clear();
  received_.clear();
  bounce_.clear();
  product_ = {};
  return true;
}

bool BounceSeries::done() const {
  return powers_.size() > kMost ||
         (powers_.size() > 1 && sum(powers_.back()) <= kLeastBounce * sum(powers_.front()));
}

bool BounceSeries::advance() {
  follow();
  if (done()) return false;
  if (powers_.empty()) {
    bounce_ = state_.emission();
    powers_.push_back(powerOf(state_, bounce_));
    received_.assign(transport_.receiverCount(), glm::dvec3(0.0));
  }
  if (!product_.running()) {
    if (!missing().empty()) return false;
    product_.begin(transport_, bounce_);
  }
  product_.advance(transport_);
  if (product_.running()) return false;
  const std::vector<glm::dvec3>& arrived = product_.flow().irradiance;
  for (std::size_t v = 0; v < arrived.size(); ++v) received_[v] += arrived[v];
  bounce_ = reflectedMeans(transport_, state_.reflectance(), arrived);
  powers_.push_back(powerOf(state_, bounce_));
  return true;
}

}  // namespace unshot
