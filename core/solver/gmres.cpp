// Minimal residual: GMRES in the form of generalised conjugate residuals (Eisenstat, Elman and Schultz 1983),
// which has the solution at hand after every sweep. Per channel; it asks nothing of K.
//
// A sweep adds the direction d = U, made orthogonal in (I - M) d to those before, times the factor that
// leaves the least. Lengths are measured with the weight A / rho, in which (I - M) of a reciprocal K is
// symmetric and positive, so that a sweep never stands still. The oldest directions go when there is no room.
#include <algorithm>
#include <deque>

#include "solver/first_pass.h"
#include "solver/inner_products.h"
#include "solver/modes.h"

namespace unshot {
namespace {

constexpr std::size_t kDirectionBytes = std::size_t{256} << 20;
constexpr std::size_t kLeastDirections = 4, kMostDirections = 40;

class Gmres final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    if (first_pass_.step(state, transport)) return 1;
    if (!product_.running()) {
      if (state.onlyRoundingUnshot()) return std::nullopt;
      if (weight_.empty()) weight_ = symmetrisingWeight(state);
      product_.begin(transport, state.unshot());
    }
    const std::size_t used = product_.advance(transport);
    if (!product_.running()) finishSweep(state, transport);
    return used;
  }

  std::size_t bytes() const override {
    return directions_.empty() ? 0 : directions_.size() * bytesOf(directions_.front());
  }

 private:
  struct Direction {
    LightFlow flow;
    std::vector<glm::dvec3> image;  // (I - M) d
    glm::dvec3 square;              // of the image
  };

  static std::size_t bytesOf(const Direction& direction) {
    return (direction.flow.irradiance.size() + 2 * direction.image.size()) * sizeof(glm::dvec3);
  }

  void finishSweep(RadiosityState& state, const Transport& transport) {
    Direction fresh;
    fresh.flow = std::move(product_.flow());
    fresh.image = reflectedMeans(transport, state.reflectance(), fresh.flow.irradiance);
    for (std::size_t q = 0; q < fresh.image.size(); ++q) fresh.image[q] = fresh.flow.shot[q] - fresh.image[q];
    for (const Direction& old : directions_) {
      const glm::dvec3 factor = -quotient(weighted(weight_, fresh.image, old.image), old.square);
      fresh.flow.add(factor, old.flow);
      for (std::size_t q = 0; q < fresh.image.size(); ++q) fresh.image[q] += factor * old.image[q];
    }
    fresh.square = weighted(weight_, fresh.image, fresh.image);
    const glm::dvec3 factor = quotient(weighted(weight_, state.unshot(), fresh.image), fresh.square);
    state.add(factor, fresh.flow);
    const std::size_t most = std::clamp(kDirectionBytes / bytesOf(fresh), kLeastDirections, kMostDirections);
    if (directions_.size() >= most) directions_.pop_front();
    directions_.push_back(std::move(fresh));
  }

  FirstPass first_pass_;
  TransportProduct product_;
  std::vector<glm::dvec3> weight_;
  std::deque<Direction> directions_;
};

}  // namespace

std::unique_ptr<IterationMode> makeGmres() { return std::make_unique<Gmres>(); }

}  // namespace unshot
