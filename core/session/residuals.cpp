#include "session/residuals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.h"
#include "session/fields.h"
#include "solver/patch_solve.h"

namespace unshot {
namespace {

constexpr double kCarryTolerance = 0.01;
constexpr int kCarryProducts = 12;
// Half the width of a 95 % interval in standard errors, for the few dozens of places that matter of the
// hundreds.
constexpr double kInterval = 2.1;

// How many points of its own a patch needs to outweigh what is known of its side.
constexpr double kBelief = 2;

double fraction(double x) { return x - std::floor(x); }

// Places follow each other by the golden ratio, so that any number of them is spread evenly.
double evenly(std::uint64_t number, std::uint64_t seed) {
  return fraction(static_cast<double>(number) * 0.6180339887498949 + unitInterval(mixBits(seed)));
}

std::uint32_t chooseBy(const std::vector<double>& sums, double u) {
  const auto at = std::upper_bound(sums.begin(), sums.end(), u * sums.back());
  return static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(at - sums.begin(), std::ssize(sums) - 1));
}

glm::dvec3 barycentric(double u, double v) {
  const double r = std::sqrt(u);
  return {1 - r, r * (1 - v), r * v};
}

// H of a gather: what lights have shot of their emission, and what elements and the sky send besides.
glm::dvec3 irradianceOf(const Gather& gather, const RadiosityState& state,
                        const std::vector<glm::dvec3>& element_light, const glm::dvec3& sky) {
  glm::dvec3 sum(0.0);
  for (const std::uint32_t e : gather.rays) {
    if (e == kToSky) {
      sum += sky;
    } else if (e != kNone) {
      sum += element_light[e];
    }
  }
  sum /= static_cast<double>(gather.rays.size());
  for (const Gather::Light& light : gather.lights)
    sum +=
        static_cast<double>(light.weight) * (state.emission()[light.patch] - state.emissionLeft(light.patch));
  return sum;
}

struct Ratio {
  double value = 0, error = 0;  // and its standard error
};

// sum t / sum s over places, with the spread of a ratio estimator.
Ratio ratioOf(const std::vector<double>& t, const std::vector<double>& s) {
  double top = 0, bottom = 0, squares = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    top += t[k];
    bottom += s[k];
  }
  if (bottom <= 0) return {};
  const double value = top / bottom;
  for (std::size_t k = 0; k < t.size(); ++k) squares += (t[k] - value * s[k]) * (t[k] - value * s[k]);
  const auto n = static_cast<double>(t.size());
  return {value, std::sqrt(squares * n / std::max(n - 1, 1.0)) / bottom};
}

ErrorEstimate estimateOf(const Ratio& square, std::size_t places) {
  const auto root = [](double x) { return std::sqrt(std::max(x, 0.0)); };
  // Below 0 it is by noise, which leaves room for an error all the same.
  const double value = std::max(square.value, 0.0);
  return {root(value), root(value - kInterval * square.error), root(value + kInterval * square.error),
          places};
}

// Squared nRMSE of what the residuals cause. `residuals` has patch, of_look[2], reflected; they are spread
// over `area`.
template <class Residuals>
Ratio squaredError(const Residuals& residuals, double area, const RadiosityState& state,
                   const PatchMatrix& matrix) {
  const std::size_t n = state.patchCount();
  std::vector<glm::dvec3> carried[2];
  for (int k = 0; k < 2; ++k) {
    // M applied to the points' residuals: each stands for its share of the area, whatever its patch.
    std::vector<glm::dvec3> mean(n, glm::dvec3(0.0)), sent(n);
    const double share = area / static_cast<double>(residuals.size());
    for (const auto& r : residuals) mean[r.patch] += share / state.area()[r.patch] * r.of_look[k];
    matrix.product(mean, sent);
    for (std::size_t q = 0; q < n; ++q) sent[q] *= state.reflectance()[q];
    carried[k] = solvePatches(matrix, state.reflectance(), sent, kCarryTolerance, kCarryProducts);
  }
  std::vector<double> t, s;
  for (const auto& r : residuals) {
    t.push_back(glm::dot(r.of_look[0] + carried[0][r.patch], r.of_look[1] + carried[1][r.patch]));
    s.push_back(glm::dot(r.reflected, r.reflected));
  }
  return ratioOf(t, s);
}

}  // namespace

Residuals::Residuals(const Mesh& mesh, const Receivers& receivers, std::uint64_t seed)
    : mesh_(mesh), receivers_(receivers), seed_(mixBits(seed ^ 0x7265736964756cull)), gatherer_(mesh) {
  for (const Side& side : mesh.sides) all_emit_ = all_emit_ && side.emission != glm::dvec3(0.0);
  double sum = 0;
  triangles_of_element_.resize(mesh.element_count);
  for (std::uint32_t t = 0; t < mesh.triangle_element.size(); ++t) {
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    const glm::dvec3 p0(mesh.vertices[corner[0]].position);
    const glm::dvec3 across = glm::cross(glm::dvec3(mesh.vertices[corner[1]].position) - p0,
                                         glm::dvec3(mesh.vertices[corner[2]].position) - p0);
    if (counts(mesh.element_patch[mesh.triangle_element[t]])) sum += glm::length(across) / 2;
    triangle_area_sum_.push_back(sum);
    triangles_of_element_[mesh.triangle_element[t]].push_back(t);
  }
  sum = 0;
  for (std::uint32_t v = 0; v < receivers.shownCount(); ++v) {
    if (counts(receivers.shares[receivers.start[v]].patch)) sum += areaOf(v);
    receiver_area_sum_.push_back(sum);
  }
}

// Of two layers those receivers count that stand in both: in between, what arrives is interpolated, and how
// well is the mesh's affair.
double Residuals::areaOf(std::uint32_t receiver) const {
  if (!receivers_.layered()) return receivers_.area[receiver];
  const SparseRows& rows = receivers_.from_base;
  const std::uint32_t first = rows.start[receiver];
  return rows.start[receiver + 1] == first + 1 ? receivers_.area[rows.index[first]] : 0.0;
}

bool Residuals::counts(std::uint32_t patch) const { return all_emit_ || !mesh_.emits(patch); }

void Residuals::add(std::size_t places) {
  if (triangle_area_sum_.empty() || triangle_area_sum_.back() <= 0 || receiver_area_sum_.back() <= 0) return;
  for (std::size_t k = 0; k < places; ++k) {
    const std::uint64_t number = points_.size();
    addPoint(number);
    addReceiver(number);
  }
}

void Residuals::addPoint(std::uint64_t number) {
  const std::uint64_t bits = mixBits(seed_ + 4 * number);
  Place place;
  place.triangle = chooseBy(triangle_area_sum_, evenly(number, seed_));
  place.weights = barycentric(unitInterval(mixBits(bits)), unitInterval(mixBits(bits + 1)));
  const std::uint32_t element = mesh_.triangle_element[place.triangle];
  place.patch = mesh_.element_patch[element];
  glm::dvec3 position(0.0);
  for (int k = 0; k < 3; ++k)
    position += place.weights[k] *
                glm::dvec3(mesh_.vertices[mesh_.triangle_vertices[3 * place.triangle + k]].position);
  const glm::dvec3& normal = mesh_.sides[mesh_.element_side[element]].normal;
  for (std::uint64_t k = 0; k < 2; ++k)
    place.looks[k] = gatherer_.look(position, normal, mixBits(bits + 2 + k));
  points_.push_back(std::move(place));
}

void Residuals::addReceiver(std::uint64_t number) {
  const std::uint64_t bits = mixBits(~seed_ + 4 * number);
  Place place;
  place.receiver = chooseBy(receiver_area_sum_, evenly(number, ~seed_));
  place.patch = receivers_.shares[receivers_.start[place.receiver]].patch;
  for (std::uint64_t k = 0; k < 2; ++k) {
    if (receivers_.kind == ReceiverKind::kVertices) {
      // From one of its views at random: what it receives is their mean.
      const std::span<const ReceiverView> views = receivers_.viewsOf(place.receiver);
      double left = unitInterval(mixBits(bits + 20 + k));
      std::size_t chosen = 0;
      while (chosen + 1 < views.size() && left >= views[chosen].weight) left -= views[chosen++].weight;
      place.looks[k] = gatherer_.look(views[chosen].position, views[chosen].normal, mixBits(bits + 2 + k));
      continue;
    }
    // Each look from a place of its own in the element: its H is a mean.
    const std::vector<std::uint32_t>& triangles = triangles_of_element_[place.receiver];
    if (triangles.empty()) return;
    double area = 0;
    std::vector<double> sums;
    for (const std::uint32_t t : triangles) {
      const std::uint32_t* corner = &mesh_.triangle_vertices[3 * t];
      const glm::dvec3 p0(mesh_.vertices[corner[0]].position);
      area += glm::length(glm::cross(glm::dvec3(mesh_.vertices[corner[1]].position) - p0,
                                     glm::dvec3(mesh_.vertices[corner[2]].position) - p0));
      sums.push_back(area);
    }
    const std::uint64_t own = mixBits(bits + 10 * k);
    const std::uint32_t t = triangles[chooseBy(sums, unitInterval(mixBits(own)))];
    const glm::dvec3 weights = barycentric(unitInterval(mixBits(own + 1)), unitInterval(mixBits(own + 2)));
    glm::dvec3 position(0.0);
    for (int c = 0; c < 3; ++c)
      position += weights[c] * glm::dvec3(mesh_.vertices[mesh_.triangle_vertices[3 * t + c]].position);
    place.looks[k] =
        gatherer_.look(position, mesh_.sides[mesh_.element_side[place.receiver]].normal, mixBits(own + 3));
  }
  elements_.push_back(std::move(place));
}

// What the sky, the source behind the patches, has shot.
glm::dvec3 Residuals::skyOf(const RadiosityState& state) const {
  return state.patchCount() > mesh_.patch_count ? state.shot()[mesh_.patch_count] : glm::dvec3(0.0);
}

// Light that elements send, besides emission: rho H as it is known on them, without what is unshot of it.
std::vector<Residuals::Residual> Residuals::pointResiduals(const RadiosityState& state,
                                                           const std::vector<glm::dvec3>& shown_field) const {
  const MeshField h = makeField(mesh_, receivers_, shown_field);
  std::vector<glm::dvec3> light(mesh_.element_count);
  for (std::uint32_t e = 0; e < light.size(); ++e) {
    const std::uint32_t q = mesh_.element_patch[e];
    light[e] =
        state.reflectance()[q] * glm::dvec3(h.elements[e]) - (state.unshot()[q] - state.emissionLeft(q));
  }
  const glm::dvec3 sky = skyOf(state);
  std::vector<Residual> out;
  for (const Place& place : points_) {
    glm::dvec3 shown(0.0);
    for (int k = 0; k < 3; ++k)
      shown += place.weights[k] * glm::dvec3(h.vertices[mesh_.triangle_vertices[3 * place.triangle + k]]);
    const glm::dvec3& rho = state.reflectance()[place.patch];
    out.push_back({place.patch,
                   {rho * (irradianceOf(place.looks[0], state, light, sky) - shown),
                    rho * (irradianceOf(place.looks[1], state, light, sky) - shown)},
                   rho * shown});
  }
  return out;
}

// The same of patches as the solver has them.
std::vector<Residuals::Residual> Residuals::receiverResiduals(const RadiosityState& state) const {
  std::vector<glm::dvec3> light(mesh_.element_count);
  for (std::uint32_t e = 0; e < light.size(); ++e) {
    const std::uint32_t q = mesh_.element_patch[e];
    light[e] = state.shot()[q] - (state.emission()[q] - state.emissionLeft(q));
  }
  const glm::dvec3 sky = skyOf(state);
  std::vector<Residual> out;
  for (const Place& place : elements_) {
    const glm::dvec3 h = receivers_.shown(place.receiver, state.irradiance());
    const glm::dvec3& rho = state.reflectance()[place.patch];
    out.push_back({place.patch,
                   {rho * (irradianceOf(place.looks[0], state, light, sky) - h),
                    rho * (irradianceOf(place.looks[1], state, light, sky) - h)},
                   rho * h});
  }
  return out;
}

ErrorEstimates Residuals::estimate(const RadiosityState& state, const PatchMatrix& matrix,
                                   const std::vector<glm::dvec3>& shown) const {
  ErrorEstimates out;
  if (points_.empty() || elements_.empty()) return out;
  const Ratio both = squaredError(pointResiduals(state, shown), triangle_area_sum_.back(), state, matrix);
  const Ratio factors = squaredError(receiverResiduals(state), receiver_area_sum_.back(), state, matrix);
  out.both = estimateOf(both, points_.size());
  out.form_factor = estimateOf(factors, elements_.size());
  out.discretisation = estimateOf(
      {std::max(both.value, 0.0) - std::max(factors.value, 0.0), std::hypot(both.error, factors.error)},
      points_.size());
  return out;
}

std::vector<double> Residuals::patchResiduals(const RadiosityState& state,
                                              const std::vector<glm::dvec3>& shown) const {
  std::vector<double> sum(mesh_.patch_count, 0), count(mesh_.patch_count, 0), side_sum(mesh_.sides.size(), 0),
      side_count(mesh_.sides.size(), 0);
  for (const Residual& r : pointResiduals(state, shown)) {
    const double square = glm::dot(r.of_look[0], r.of_look[1]) / 3;
    sum[r.patch] += square;
    ++count[r.patch];
    side_sum[mesh_.patch_side[r.patch]] += square;
    ++side_count[mesh_.patch_side[r.patch]];
  }
  // With few points of its own a patch is taken to be like its side.
  for (std::uint32_t q = 0; q < mesh_.patch_count; ++q) {
    const std::uint32_t s = mesh_.patch_side[q];
    const double of_side = side_count[s] > 0 ? side_sum[s] / side_count[s] : 0;
    sum[q] = std::sqrt(std::max(0.0, (sum[q] + kBelief * of_side) / (count[q] + kBelief)));
  }
  return sum;
}

}  // namespace unshot
