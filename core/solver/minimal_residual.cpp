#include "solver/minimal_residual.h"

#include <algorithm>

#include "solver/inner_products.h"

namespace unshot {
namespace {

constexpr std::size_t kDirectionBytes = std::size_t{256} << 20;
constexpr std::size_t kLeastDirections = 4;

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
  state.add(quotient(weighted(weight_, state.unshot(), fresh.image), fresh.square), fresh.flow);
  const std::size_t most =
      std::clamp(kDirectionBytes / fresh.bytes(), std::min(kLeastDirections, most_), most_);
  if (directions_.size() >= most) directions_.pop_front();
  directions_.push_back(std::move(fresh));
}

std::size_t MinimalResidual::bytes() const {
  return directions_.empty() ? 0 : directions_.size() * directions_.front().bytes();
}

}  // namespace unshot
