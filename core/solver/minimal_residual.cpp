#include "solver/minimal_residual.h"

#include <algorithm>
#include <cmath>

#include "solver/inner_products.h"
#include "solver/modes.h"

namespace unshot {
namespace {

constexpr std::size_t kDirectionBytes = std::size_t{256} << 20;
constexpr std::size_t kLeastDirections = 4;
// A correction by more than this many times the emitted power, or what is unshot, leads to no solution but to
// what rounding makes of a system that has none.
constexpr double kMostBounces = 1e6;

bool isBeyondLight(const RadiosityState& state, const std::vector<glm::dvec3>& shot,
                   const glm::dvec3& factor) {
  for (int c = 0; c < 3; ++c) {
    double power = 0, emitted = 0, unshot = 0;
    for (std::size_t q = 0; q < shot.size(); ++q) {
      power += state.area()[q] * std::abs(factor[c] * shot[q][c]);
      emitted += state.area()[q] * state.emission()[q][c];
      unshot += state.area()[q] * std::abs(state.unshot()[q][c]);
    }
    if (power > kMostBounces * std::max(emitted, unshot)) return true;
  }
  return false;
}

}  // namespace

void MinimalResidual::apply(RadiosityState& state, const Transport& transport, LightFlow flow) {
  if (weight_.empty()) weight_ = symmetrisingWeight(state);
  Direction fresh;
  fresh.flow = std::move(flow);
  fresh.image = reflectedMeans(transport, state.reflectance(), fresh.flow.irradiance);
  for (std::size_t q = 0; q < fresh.image.size(); ++q) fresh.image[q] = fresh.flow.shot[q] - fresh.image[q];
  for (const Direction& old : directions_) {
    const glm::dvec3 factor = -quotient(weighted(weight_, fresh.image, old.image), old.square);
    fresh.flow.add(factor, old.flow);
    for (std::size_t q = 0; q < fresh.image.size(); ++q) fresh.image[q] += factor * old.image[q];
  }
  fresh.square = weighted(weight_, fresh.image, fresh.image);
  const glm::dvec3 factor = quotient(weighted(weight_, state.unshot(), fresh.image), fresh.square);
  if (isBeyondLight(state, fresh.flow.shot, factor)) {
    throw IterationFailure(
        ErrorKind::kInput, "no finite solution: the walls reflect all light and let none out", {},
        "a reflectance (Kd) below 1 for some wall, or --bounces N (or --max-shots N) for the light "
        "of a number of bounces");
  }
  state.add(factor, fresh.flow);
  const std::size_t most =
      std::clamp(kDirectionBytes / fresh.bytes(), std::min(kLeastDirections, most_), most_);
  if (directions_.size() >= most) directions_.pop_front();
  directions_.push_back(std::move(fresh));
}

std::size_t MinimalResidual::bytes() const {
  return directions_.empty() ? 0 : directions_.size() * directions_.front().bytes();
}

}  // namespace unshot
