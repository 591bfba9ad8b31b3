#include "session/residual_places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/random.h"

namespace unshot {
namespace {

double fraction(double x) { return x - std::floor(x); }

// Places follow each other by the golden ratio, so that any number of them is spread evenly.
double evenly(std::uint64_t number, std::uint64_t seed) {
  return fraction(static_cast<double>(number) * 0.6180339887498949 + unitInterval(mixBits(seed)));
}

std::uint32_t chooseBy(const std::vector<double>& sums, double u) {
  const auto at = std::upper_bound(sums.begin(), sums.end(), u * sums.back());
  return static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(at - sums.begin(), std::ssize(sums) - 1));
}

// What k itself adds to running sums.
double ownOf(const std::vector<double>& sums, std::size_t k) { return sums[k] - (k > 0 ? sums[k - 1] : 0); }

glm::dvec3 barycentric(double u, double v) {
  const double r = std::sqrt(u);
  return {1 - r, r * (1 - v), r * v};
}

}  // namespace

ResidualPlaces::ResidualPlaces(const Mesh& mesh, const Receivers& receivers, bool occlusion,
                               std::uint64_t seed)
    : mesh_(mesh),
      receivers_(receivers),
      seed_(mixBits(seed ^ 0x7265736964756cull)),
      looks_exact_(!occlusion && looksExactlySooner(mesh)) {
  if (receivers.kind == ReceiverKind::kElements) element_points_.emplace(mesh);
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_element.size(); ++t) {
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    const glm::dvec3 p0(mesh.vertices[corner[0]].position);
    const glm::dvec3 across = glm::cross(glm::dvec3(mesh.vertices[corner[1]].position) - p0,
                                         glm::dvec3(mesh.vertices[corner[2]].position) - p0);
    sum += glm::length(across) / 2;
    triangle_area_sum_.push_back(sum);
  }
  sum = 0;
  for (std::uint32_t v = 0; v < receivers.shownCount(); ++v) {
    sum += areaOf(v);
    receiver_area_sum_.push_back(sum);
  }
}

// Of two layers those receivers count that stand in both: in between, what arrives is interpolated, and how
// well is the mesh's affair.
double ResidualPlaces::areaOf(std::uint32_t receiver) const {
  if (!receivers_.layered()) return receivers_.area[receiver];
  const SparseRows& rows = receivers_.from_base;
  const std::uint32_t first = rows.start[receiver];
  return rows.start[receiver + 1] == first + 1 ? receivers_.area[rows.index[first]] : 0.0;
}

// Every other place by light, where there is any.
ResidualPlaces::Choice ResidualPlaces::choose(const std::vector<double>& area_sum,
                                              const std::vector<double>& light_sum, std::uint64_t number,
                                              std::uint64_t seed) {
  if (light_sum.back() <= 0) return {chooseBy(area_sum, evenly(number, seed)), 1};
  const double u = evenly(number / 2, seed + number % 2);
  const std::uint32_t k = chooseBy(number % 2 == 0 ? area_sum : light_sum, u);
  const auto share = [k](const std::vector<double>& sum) { return ownOf(sum, k) / sum.back(); };
  return {k, 2 / (1 + share(light_sum) / share(area_sum))};
}

// Reflected light over each triangle and at each receiver, where places may lie.
void ResidualPlaces::findLight(const MeshField& shown) {
  triangle_light_sum_.clear();
  receiver_light_sum_.clear();
  const auto lightOf = [](const glm::dvec3& rho, const glm::dvec3& h) {
    const glm::dvec3 b = rho * h;
    const double sum = b.x + b.y + b.z;
    return std::isfinite(sum * sum) ? sum * sum : 0.0;
  };
  double sum = 0;
  for (std::size_t t = 0; t < triangle_area_sum_.size(); ++t) {
    const std::uint32_t* corner = &mesh_.triangle_vertices[3 * t];
    const glm::dvec3 mean = (glm::dvec3(shown.vertices[corner[0]]) + glm::dvec3(shown.vertices[corner[1]]) +
                             glm::dvec3(shown.vertices[corner[2]])) /
                            3.0;
    const Side& side = mesh_.sides[mesh_.element_side[mesh_.triangle_element[t]]];
    triangle_light_sum_.push_back(sum += ownOf(triangle_area_sum_, t) * lightOf(side.reflectance, mean));
  }
  const std::vector<glm::vec3>& at =
      receivers_.kind == ReceiverKind::kElements ? shown.elements : shown.vertices;
  sum = 0;
  for (std::uint32_t v = 0; v < receiver_area_sum_.size(); ++v)
    receiver_light_sum_.push_back(sum += ownOf(receiver_area_sum_, v) *
                                         lightOf(receivers_.reflectance[v], glm::dvec3(at[v])));
}

void ResidualPlaces::forget() {
  points_.clear();
  at_receivers_.clear();
}

std::vector<ResidualPlace> ResidualPlaces::take() {
  return looks_exact_ ? std::exchange(points_, {}) : std::vector<ResidualPlace>();
}

void ResidualPlaces::add(std::size_t places, const MeshField& shown) {
  if (places == 0 || triangle_area_sum_.empty() || triangle_area_sum_.back() <= 0 ||
      receiver_area_sum_.back() <= 0)
    return;
  findLight(shown);
  if (looks_exact_ && !exact_) exact_.emplace(mesh_);
  if (!looks_exact_ && !gatherer_) gatherer_.emplace(mesh_);
  for (std::size_t k = 0; k < places; ++k) {
    const std::uint64_t number = points_.size();
    addPoint(number);
    if (!looks_exact_) addReceiver(number);
  }
}

void ResidualPlaces::addPoint(std::uint64_t number) {
  const std::uint64_t bits = mixBits(seed_ + 4 * number);
  ResidualPlace place;
  const Choice choice = choose(triangle_area_sum_, triangle_light_sum_, number, seed_);
  place.triangle = choice.index;
  place.weight = choice.weight;
  place.weights = barycentric(unitInterval(mixBits(bits)), unitInterval(mixBits(bits + 1)));
  const std::uint32_t element = mesh_.triangle_element[place.triangle];
  place.patch = mesh_.element_patch[element];
  glm::dvec3 position(0.0);
  for (int k = 0; k < 3; ++k)
    position += place.weights[k] *
                glm::dvec3(mesh_.vertices[mesh_.triangle_vertices[3 * place.triangle + k]].position);
  const Side& side = mesh_.sides[mesh_.element_side[element]];
  if (looks_exact_) {
    place.looks[0] = exact_->at(position, side.normal, side.room);
  } else {
    for (std::uint64_t k = 0; k < 2; ++k)
      place.looks[k] = gatherer_->look(position, side.normal, mixBits(bits + 2 + k));
  }
  points_.push_back(std::move(place));
}

void ResidualPlaces::addReceiver(std::uint64_t number) {
  const std::uint64_t bits = mixBits(~seed_ + 4 * number);
  ResidualPlace place;
  const Choice choice = choose(receiver_area_sum_, receiver_light_sum_, number, ~seed_);
  place.receiver = choice.index;
  place.weight = choice.weight;
  place.patch = receivers_.shares[receivers_.start[place.receiver]].patch;
  for (std::uint64_t k = 0; k < 2; ++k) {
    if (receivers_.kind == ReceiverKind::kVertices) {
      // From one of its views at random: what it receives is their mean.
      const std::span<const ReceiverView> views = receivers_.viewsOf(place.receiver);
      double left = unitInterval(mixBits(bits + 20 + k));
      std::size_t chosen = 0;
      while (chosen + 1 < views.size() && left >= views[chosen].weight) left -= views[chosen++].weight;
      place.looks[k] = gatherer_->look(views[chosen].position, views[chosen].normal, mixBits(bits + 2 + k));
      continue;
    }
    // Each look from a place of its own in the element: its H is a mean.
    if (element_points_->empty(place.receiver)) return;
    std::uint64_t state = mixBits(bits + 10 * k);
    const glm::dvec3 position =
        element_points_->at(place.receiver, [&] { return unitInterval(state = mixBits(state)); });
    place.looks[k] =
        gatherer_->look(position, mesh_.sides[mesh_.element_side[place.receiver]].normal, mixBits(state));
  }
  at_receivers_.push_back(std::move(place));
}

}  // namespace unshot
