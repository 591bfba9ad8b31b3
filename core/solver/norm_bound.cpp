#include "solver/norm_bound.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <limits>

#include "solver/patch_sums.h"

namespace unshot {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
// Times 0 it is 0, unlike infinity.
constexpr double kHuge = 1e300;
constexpr int kStepsAtOnce = 3;
// So much of x stays, that it never comes near 0 where little light goes.
constexpr double kStays = 0.1;

}  // namespace

NormBound::NormBound(const PatchMatrix& matrix, const RadiosityState& state)
    : matrix_(matrix), state_(state), norm_(kUnknown) {
  for (std::size_t q = 0; q < state.patchCount(); ++q) {
    const glm::dvec3& rho = state.reflectance()[q];
    most_reflectance_ = glm::max(most_reflectance_, rho);
    weights_.emplace_back(kHuge);
    for (int c = 0; c < 3; ++c) {
      if (rho[c] > 0) weights_[q][c] = state.area()[q] / rho[c];
    }
  }
}

void NormBound::refresh() {
  const std::vector<glm::dvec3>& rho = state_.reflectance();
  const std::size_t n = rho.size();
  if (version_ != matrix_.version()) norm_ = glm::dvec3(kUnknown);
  version_ = matrix_.version();
  if (x_.empty()) {
    for (std::size_t q = 0; q < n; ++q) x_.push_back(glm::sqrt(state_.area()[q] * rho[q]));
  }
  std::vector<glm::dvec3> scaled(n), image(n);
  for (int k = 0; k < kStepsAtOnce; ++k) {
    // N = sqrt(A rho) P sqrt(rho / A), with P = R K.
    for (std::size_t q = 0; q < n; ++q) scaled[q] = glm::sqrt(rho[q] / state_.area()[q]) * x_[q];
    matrix_.product(scaled, image);
    for (std::size_t q = 0; q < n; ++q) image[q] *= rho[q];
    matrix_.transposed(image, scaled);
    glm::dvec3 ratio(0.0), most(0.0);
    for (std::size_t q = 0; q < n; ++q) {
      scaled[q] *= glm::sqrt(rho[q] * state_.area()[q]);
      most = glm::max(most, scaled[q]);
      for (int c = 0; c < 3; ++c) {
        if (scaled[q][c] > 0)
          ratio[c] = std::max(ratio[c], x_[q][c] > 0 ? scaled[q][c] / x_[q][c] : kUnknown);
      }
    }
    norm_ = glm::min(norm_, glm::sqrt(ratio) * (1 + kRounding));
    glm::dvec3 largest(0.0);
    for (const glm::dvec3& x : x_) largest = glm::max(largest, x);
    for (std::size_t q = 0; q < n; ++q) {
      for (int c = 0; c < 3; ++c) {
        if (most[c] > 0 && largest[c] > 0) x_[q][c] = scaled[q][c] / most[c] + kStays * x_[q][c] / largest[c];
      }
    }
  }
}

double NormBound::squaresAfter(const glm::dvec3& squares) const {
  if (version_ != matrix_.version()) return kUnknown;
  double out = 0;
  for (int c = 0; c < 3; ++c) {
    if (squares[c] == 0) continue;
    if (!(norm_[c] < 1)) return kUnknown;
    const double grown = norm_[c] / (1 - norm_[c]);
    out += most_reflectance_[c] * grown * grown * squares[c];
  }
  return out;
}

}  // namespace unshot
