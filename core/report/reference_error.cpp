#include "report/reference_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "base/text.h"
#include "report/difference.h"

namespace unshot {
namespace {

constexpr double kNoiseOfError = 1.0 / 3;
constexpr double kDimmestOfMean = 0.01;  // of points that relative errors are taken of

std::vector<double> relativeErrors(const std::vector<glm::dvec3>& values,
                                   const std::vector<glm::dvec3>& reference, double dimmest) {
  std::vector<double> errors;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const glm::dvec3& b = reference[k];
    if ((b.x + b.y + b.z) / 3 > dimmest) errors.push_back(glm::length(values[k] - b) / glm::length(b));
  }
  std::sort(errors.begin(), errors.end(), std::greater<>());
  return errors;
}

}  // namespace

ReferenceError errorAgainst(std::span<const ReferencePoint> reference,
                            std::span<const std::optional<glm::dvec3>> values) {
  const bool all_emit = std::all_of(reference.begin(), reference.end(), [](const ReferencePoint& point) {
    return point.emission != glm::dvec3(0.0);
  });
  ReferenceError error;
  std::vector<glm::dvec3> solved, exact;
  double own = 0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const ReferencePoint& point = reference[k];
    if (point.emission != glm::dvec3(0.0) && !all_emit) continue;
    error.missing += !values[k];
    solved.push_back(values[k].value_or(point.emission) - point.emission);
    exact.push_back(point.reflected());
    own += glm::dot(point.standard_error, point.standard_error);
  }
  error.points = exact.size();
  if (exact.empty()) return error;
  const Difference difference = differenceOf(solved, exact);
  own = std::sqrt(own / (3 * static_cast<double>(exact.size())));
  error.nrmse_raw = difference.nrmse;
  error.noise = own > 0 ? own / difference.reference_rms : 0;
  error.nrmse = std::sqrt(std::max(0.0, error.nrmse_raw * error.nrmse_raw - error.noise * error.noise));
  error.bias = difference.bias == 0 ? 0 : difference.bias / difference.reference_mean;
  const std::vector<double> relative =
      relativeErrors(solved, exact, kDimmestOfMean * difference.reference_mean);
  if (relative.empty()) return error;
  error.median = relative[relative.size() / 2];
  const std::size_t worst = std::max<std::size_t>(1, relative.size() / 20);
  for (std::size_t k = 0; k < worst; ++k) error.worst_5 += relative[k] / static_cast<double>(worst);
  return error;
}

bool isJudgeable(const ReferenceError& error) {
  return std::isfinite(error.noise) && error.noise <= kNoiseOfError * error.nrmse_raw;
}

std::string whyNotJudgeable(const ReferenceError& error) {
  if (isJudgeable(error)) return {};
  if (!std::isfinite(error.noise)) return "the reference has no standard error yet: give it more time";
  return "the reference's own error of " + percentText(error.noise) +
         " is too large to judge a difference of " + percentText(error.nrmse_raw) + ": the error is " +
         (error.nrmse > 0 ? "about " + percentText(error.nrmse) : "below that") +
         "; trace it to less than a third of the difference";
}

}  // namespace unshot
