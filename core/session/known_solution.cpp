#include "session/known_solution.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "solver/counted.h"

namespace unshot {

void KnownSolution::learn(const RadiosityState& state, const Transport& transport) {
  radiosity_ = state.shot();
  for (std::size_t q = 0; q < radiosity_.size(); ++q) radiosity_[q] += state.unshot()[q];
  replaced_ = transport.replaced();
}

std::optional<double> KnownSolution::errorOf(const RadiosityState& state, const Transport& transport) const {
  if (!known(transport)) return std::nullopt;
  const std::vector<glm::dvec3>& e = state.emission();
  const std::vector<char> counts = whereErrorsCount(e, state.reflectance());
  double error = 0, truth = 0;
  for (std::size_t q = 0; q < radiosity_.size(); ++q) {
    if (!counts[q]) continue;
    const glm::dvec3 wrong = state.shot()[q] + state.unshot()[q] - radiosity_[q];
    const glm::dvec3 reflected = radiosity_[q] - e[q];
    error += state.area()[q] * glm::dot(wrong, wrong);
    truth += state.area()[q] * glm::dot(reflected, reflected);
  }
  return truth > 0 ? std::sqrt(error / truth) : 0;
}

}  // namespace unshot
