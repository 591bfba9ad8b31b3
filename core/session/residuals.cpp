#include "session/residuals.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "session/fields.h"
#include "solver/counted.h"
#include "solver/patch_solve.h"

namespace unshot {
namespace {

// The carried residual, and then what corrects it, so often.
struct Carry {
  double tolerance;
  int products;
};
constexpr Carry kCarry{0.01, 12}, kCorrection{0.1, 4};
constexpr int kCorrections = 3;
// What is carried is known per patch. At thousands of path-traced points (the Cornell boxes, two rooms, each
// at several finenesses) errors were between 0.8 and 1.7 times what noise alone leaves open.
constexpr double kCarryFactor = 1.8;
// Half the width of a 95 % interval in standard errors, for the few dozens of places that matter of the
// hundreds.
constexpr double kIntervalErrors = 2.1;

// How many places of its own a patch needs to outweigh what is known of its side, a side what is known of
// all.
constexpr double kBelief = 1;

struct Ratio {
  double value = 0, error = 0;  // and its standard error
};

// sum t / sum s over places, with the spread of a ratio estimator; nothing where noise hides what s is.
std::optional<Ratio> ratioOf(const std::vector<double>& t, const std::vector<double>& s) {
  double top = 0, bottom = 0, squares = 0;
  bool dark = true;
  for (std::size_t k = 0; k < t.size(); ++k) {
    top += t[k];
    bottom += s[k];
    dark = dark && t[k] == 0 && s[k] == 0;
  }
  if (t.size() < 2) return std::nullopt;
  if (dark) return Ratio{};
  if (!(bottom > 0)) return std::nullopt;
  const double value = top / bottom;
  for (std::size_t k = 0; k < t.size(); ++k) squares += (t[k] - value * s[k]) * (t[k] - value * s[k]);
  const auto n = static_cast<double>(t.size());
  return Ratio{value, std::sqrt(squares * n / (n - 1)) / bottom};
}

ErrorEstimate estimateOf(const std::optional<Ratio>& square, std::size_t places) {
  if (!square) return {};
  const auto root = [](double x) { return std::sqrt(std::max(x, 0.0)); };
  // Below 0 it is by noise, which leaves room for an error all the same.
  const double value = std::max(square->value, 0.0);
  return {root(value), root(value - kIntervalErrors * square->error) / kCarryFactor,
          kCarryFactor * root(value + kIntervalErrors * square->error), places};
}

// What a look meets of light that patches send, one value per patch [W/m^2].
glm::dvec3 meets(const Gather& look, const std::vector<std::uint32_t>& element_patch,
                 const std::vector<glm::dvec3>& of_patch) {
  glm::dvec3 sum(0.0);
  for (const std::uint32_t e : look.rays)
    if (e != kNone && e != kToSky) sum += of_patch[element_patch[e]];
  if (!look.rays.empty()) sum /= static_cast<double>(look.rays.size());
  for (const Gather::Share& s : look.shares)
    sum += static_cast<double>(s.weight) * of_patch[element_patch[s.element]];
  return sum;
}

// Sums over places of weights, of values and of the light that is reflected there.
struct Shares {
  glm::dvec3 value{0.0}, light{0.0};
  double weight = 0, places = 0;

  void add(double w, const glm::dvec3& v, const glm::dvec3& l) {
    value += w * v;
    light += w * l;
    weight += w;
    ++places;
  }
  // Value over light of a part of the mesh that reflects `reflected` in the mean; with few places it leans on
  // what is known of a larger part.
  glm::dvec3 ratio(const glm::dvec3& reflected, const glm::dvec3& of_larger) const {
    if (places == 0) return of_larger;
    const glm::dvec3 belief = kBelief * weight / places * reflected;
    glm::dvec3 out = of_larger;
    for (int c = 0; c < 3; ++c) {
      if (light[c] + belief[c] > 0) out[c] = (value[c] + belief[c] * of_larger[c]) / (light[c] + belief[c]);
    }
    return out;
  }
};

// Means over patches of what is known at places: as a share of the light that the patch reflects, that of
// its places, its side's, the whole mesh's.
template <class Residuals>
std::vector<glm::dvec3> patchMeans(const Residuals& residuals, const std::vector<glm::dvec3>& values,
                                   const Mesh& mesh, const RadiosityState& state) {
  Shares all;
  std::vector<Shares> of_side(mesh.sides.size()), of_patch(mesh.patch_count);
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const auto& r = residuals[k];
    for (Shares* shares : {&all, &of_side[mesh.patch_side[r.patch]], &of_patch[r.patch]})
      shares->add(r.weight, values[k], r.reflected);
  }
  const auto reflected = [&](std::uint32_t q) {
    return glm::max(state.shot()[q] + state.unshot()[q] - state.emission()[q], glm::dvec3(0.0));
  };
  std::vector<glm::dvec3> side_ratio(mesh.sides.size(), glm::dvec3(0.0));
  std::vector<double> side_area(mesh.sides.size(), 0.0);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    side_ratio[mesh.patch_side[q]] += mesh.patch_area[q] * reflected(q);
    side_area[mesh.patch_side[q]] += mesh.patch_area[q];
  }
  const glm::dvec3 everywhere = all.ratio(glm::dvec3(0.0), glm::dvec3(0.0));
  for (std::size_t s = 0; s < side_ratio.size(); ++s)
    side_ratio[s] =
        side_area[s] > 0 ? of_side[s].ratio(side_ratio[s] / side_area[s], everywhere) : everywhere;
  std::vector<glm::dvec3> out(state.patchCount(), glm::dvec3(0.0));
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q)
    out[q] = of_patch[q].ratio(reflected(q), side_ratio[mesh.patch_side[q]]) * reflected(q);
  return out;
}

// Squared nRMSE of what the residuals cause, at those that count. `residuals` has patch, of_look[2],
// reflected, weight, counts, of places[k].
//
// With K the true operator, e = r + K e. M in its place leaves the error r' = (K - M) e, which is a residual
// again: the looks say what K makes of an error that is known per patch. `exact`: both looks are alike.
template <class Residuals>
std::optional<Ratio> squaredError(const std::vector<ResidualPlace>& places, const Residuals& residuals,
                                  bool exact, const Mesh& mesh, const RadiosityState& state,
                                  const PatchMatrix& matrix) {
  const std::size_t n = state.patchCount(), count = residuals.size();
  std::vector<glm::dvec3> error[2];
  for (int look = 0; look < (exact ? 1 : 2); ++look) {
    std::vector<glm::dvec3> residual, sum(count, glm::dvec3(0.0));
    for (const auto& r : residuals) residual.push_back(r.of_look[look]);
    for (int step = 0;; ++step) {
      std::vector<glm::dvec3> mean = patchMeans(residuals, residual, mesh, state), sent(n);
      matrix.product(mean, sent);
      for (std::size_t q = 0; q < n; ++q) sent[q] *= state.reflectance()[q];
      const Carry& carry = step == 0 ? kCarry : kCorrection;
      const std::vector<glm::dvec3> carried =
          solvePatches(matrix, state.reflectance(), sent, carry.tolerance, carry.products);
      for (std::size_t k = 0; k < count; ++k) sum[k] += residual[k] + carried[residuals[k].patch];
      if (step == kCorrections) break;
      for (std::size_t q = 0; q < n; ++q) mean[q] += carried[q];
      for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t q = residuals[k].patch;
        residual[k] =
            state.reflectance()[q] * meets(places[k].looks[look], mesh.element_patch, mean) - carried[q];
      }
    }
    error[look] = std::move(sum);
  }
  const std::vector<glm::dvec3>&first = error[0], &second = error[exact ? 0 : 1];
  std::vector<double> t, s;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& r = residuals[k];
    if (!r.counts) continue;
    t.push_back(r.weight * glm::dot(first[k], second[k]));
    s.push_back(r.weight * glm::dot(r.reflected + first[k], r.reflected + second[k]));
  }
  return ratioOf(t, s);
}

}  // namespace

Residuals::Residuals(const Mesh& mesh, const Receivers& receivers, bool occlusion, std::uint64_t seed)
    : mesh_(mesh), receivers_(receivers), places_(mesh, receivers, occlusion, seed) {
  std::vector<glm::dvec3> emission, reflectance;
  for (const Side& side : mesh.sides) {
    emission.push_back(side.emission);
    reflectance.push_back(side.reflectance);
  }
  counts_ = whereErrorsCount(emission, reflectance);
}

bool Residuals::counts(std::uint32_t patch) const { return counts_[mesh_.patch_side[patch]] != 0; }

std::vector<Residuals::Residual> Residuals::pointResiduals(const RadiosityState& state,
                                                           const MeshField& shown_field,
                                                           bool with_unshot) const {
  const SentLight sent = lightOf(mesh_, state, shown_field, with_unshot);
  std::vector<Residual> out;
  for (const ResidualPlace& place : places_.points()) {
    glm::dvec3 shown(0.0);
    for (int k = 0; k < 3; ++k)
      shown += place.weights[k] *
               glm::dvec3(shown_field.vertices[mesh_.triangle_vertices[3 * place.triangle + k]]);
    out.push_back(residualOf(place, state.reflectance()[place.patch], sent, shown));
  }
  return out;
}

// The same of patches as the solver has them.
std::vector<Residuals::Residual> Residuals::receiverResiduals(const RadiosityState& state) const {
  SentLight sent = sourcesOf(mesh_, state, false);
  sent.light.resize(mesh_.element_count);
  for (std::uint32_t e = 0; e < sent.light.size(); ++e) {
    const std::uint32_t q = mesh_.element_patch[e];
    sent.light[e] = state.shot()[q] - (state.emission()[q] - state.emissionLeft(q));
  }
  std::vector<Residual> out;
  for (const ResidualPlace& place : places_.receivers())
    out.push_back(residualOf(place, state.reflectance()[place.patch], sent,
                             receivers_.shown(place.receiver, state.irradiance())));
  return out;
}

Residuals::Residual Residuals::residualOf(const ResidualPlace& place, const glm::dvec3& rho,
                                          const SentLight& sent, const glm::dvec3& shown) const {
  const glm::dvec3 first = rho * (irradianceOf(place.looks[0], sent, mesh_) - shown);
  const glm::dvec3 second =
      places_.exact() ? first : rho * (irradianceOf(place.looks[1], sent, mesh_) - shown);
  return {place.patch, {first, second}, rho * shown, place.weight, counts(place.patch)};
}

ErrorEstimates Residuals::estimate(const RadiosityState& state, const PatchMatrix& matrix,
                                   const MeshField& shown, bool with_total) const {
  ErrorEstimates out;
  const std::vector<ResidualPlace>&points = places_.points(), &receivers = places_.receivers();
  if (points.empty() || (receivers.empty() && !places_.exact())) return out;
  const auto squared = [&](const std::vector<ResidualPlace>& places, const std::vector<Residual>& residuals) {
    return squaredError(places, residuals, places_.exact(), mesh_, state, matrix);
  };
  const std::optional<Ratio> both = squared(points, pointResiduals(state, shown, false));
  // Exact looks are by the factors themselves.
  const std::optional<Ratio> factors =
      places_.exact() ? Ratio{} : squared(receivers, receiverResiduals(state));
  out.both = estimateOf(both, points.size());
  out.form_factor = estimateOf(factors, places_.exact() ? points.size() : receivers.size());
  if (both && factors)
    out.discretisation = estimateOf(Ratio{std::max(both->value, 0.0) - std::max(factors->value, 0.0),
                                          std::hypot(both->error, factors->error)},
                                    points.size());
  if (with_total) out.total = estimateOf(squared(points, pointResiduals(state, shown, true)), points.size());
  return out;
}

std::vector<double> Residuals::patchResiduals(const RadiosityState& state, const MeshField& shown) const {
  struct Square {
    double sum = 0, weight = 0, places = 0;
    void add(double w, double square) {
      sum += w * square;
      weight += w;
      ++places;
    }
    double mean() const { return weight > 0 ? sum / weight : 0; }
  };
  std::vector<Square> of_patch(mesh_.patch_count), of_side(mesh_.sides.size());
  for (const Residual& r : pointResiduals(state, shown, false)) {
    const double square = glm::dot(r.of_look[0], r.of_look[1]) / 3;
    of_patch[r.patch].add(r.weight, square);
    of_side[mesh_.patch_side[r.patch]].add(r.weight, square);
  }
  // With few points of its own a patch is taken to be like its side.
  std::vector<double> out(mesh_.patch_count);
  for (std::uint32_t q = 0; q < mesh_.patch_count; ++q) {
    const double side = of_side[mesh_.patch_side[q]].mean(), places = of_patch[q].places;
    out[q] = std::sqrt(std::max(0.0, (places * of_patch[q].mean() + kBelief * side) / (places + kBelief)));
  }
  return out;
}

}  // namespace unshot
