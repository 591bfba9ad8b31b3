#include "report/path_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "base/cosine_direction.h"
#include "base/error.h"
#include "base/random.h"

namespace unshot {
namespace {

constexpr double kPi = std::numbers::pi;

// A path whose throughput falls below this lives on with the probability of their ratio: in a room of high
// reflectance paths then are long and alike, which costs less than many short ones that differ.
constexpr double kRoulette = 0.1;
// No path lives on for certain: where walls absorb nothing it would not end.
constexpr double kMostSurvival = 0.9999;

constexpr std::uint32_t kStrata = 4;      // along each axis
constexpr std::uint32_t kStratified = 2;  // vertices of a path
static_assert(kStrata * kStrata == kPathsPerBatch);

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// Weight of a sample in the power heuristic, from its density and that of the other way to draw it.
double powerHeuristic(double own, double other) {
  const double ratio = other / own;
  return 1 / (1 + ratio * ratio);
}

using Shuffle = std::array<std::uint8_t, kPathsPerBatch>;

Shuffle shuffled(RandomStream& random) {
  Shuffle order;
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<std::uint8_t>(k);
  for (std::size_t k = order.size() - 1; k > 0; --k) {
    std::swap(order[k], order[static_cast<std::size_t>(random.next() * static_cast<double>(k + 1))]);
  }
  return order;
}

}  // namespace

/// Random numbers of one path; the first pairs come from a cell of the batch's grid each.
struct PathTracer::Draws {
  RandomStream random;
  std::array<std::uint8_t, 2 * kStratified> cells;
  std::uint32_t pairs = 0;

  glm::dvec2 pair() {
    glm::dvec2 uv;
    uv.x = random.next();
    uv.y = random.next();
    if (pairs < cells.size()) {
      const std::uint8_t cell = cells[pairs++];
      uv = (uv + glm::dvec2(cell % kStrata, cell / kStrata)) / static_cast<double>(kStrata);
    }
    return uv;
  }
};

PathTracer::PathTracer(const Scene& scene, bool emit_front_only, const glm::dvec3& sky)
    : triangles_(trianglesOf(scene)),
      rays_(scene.positions, triangles_.corners),
      materials_(scene.materials),
      material_of_(triangles_.size()),
      emit_front_only_(emit_front_only),
      sky_(sky),
      density_(triangles_.size(), 0.0) {
  double sum = 0;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    material_of_[t] = scene.polygons[triangles_.polygon[t]].material;
    const glm::dvec3& e = materials_[material_of_[t]].emission;
    const double power = rays_.triangle(t).area * (e.x + e.y + e.z);
    if (!(power > 0)) continue;
    sum += power;
    emitters_.push_back(t);
    cumulative_power_.push_back(sum);
    density_[t] = e.x + e.y + e.z;
  }
  if (!(sum > 0)) {
    if (sky != glm::dvec3(0.0)) return;
    throw Error(ErrorKind::kInput, "nothing in the scene emits light, so there is no reference to trace",
                scene.path.string(), "a material with Ke above 0, or a --sky");
  }
  for (double& power : cumulative_power_) power /= sum;
  cumulative_power_.back() = 1;
  for (double& density : density_) density /= sum;
}

const glm::dvec3& PathTracer::reflectance(std::uint32_t triangle) const {
  return materials_[material_of_[triangle]].reflectance;
}

glm::dvec3 PathTracer::emission(std::uint32_t triangle, bool back) const {
  return back && emit_front_only_ ? glm::dvec3(0.0) : materials_[material_of_[triangle]].emission;
}

glm::dvec3 PathTracer::sampleEmitter(const glm::dvec3& point, const glm::dvec3& normal, double u,
                                     double v) const {
  if (emitters_.empty()) return glm::dvec3(0.0);
  const auto found = std::upper_bound(cumulative_power_.begin(), cumulative_power_.end() - 1, u);
  const auto index = static_cast<std::size_t>(found - cumulative_power_.begin());
  const double below = index > 0 ? cumulative_power_[index - 1] : 0;
  const std::uint32_t t = emitters_[index];
  const SceneRays::Triangle& triangle = rays_.triangle(t);
  // What chose the triangle is uniform within it again.
  const glm::dvec3 sample = triangle.point((u - below) / (*found - below), v);
  const glm::dvec3 way = sample - point;
  const double square = glm::dot(way, way);
  const double along = glm::dot(way, normal), across = -glm::dot(way, triangle.normal);
  if (!(along > 0) || !(square > 0) || across == 0) return glm::dvec3(0.0);
  const bool back = across < 0;
  const glm::dvec3 e = emission(t, back);
  if (e == glm::dvec3(0.0)) return e;
  const glm::dvec3 emitter_normal = back ? -triangle.normal : triangle.normal;
  if (rays_.occluded(rays_.lifted(point, normal), rays_.lifted(sample, emitter_normal))) {
    return glm::dvec3(0.0);
  }
  const double distance = std::sqrt(square);
  const double of_direction = along / distance / kPi;  // densities over solid angle [1/sr]
  const double of_emitter = density_[t] * square * distance / std::abs(across);
  return e * (of_direction / of_emitter * powerHeuristic(of_emitter, of_direction));
}

glm::dvec3 PathTracer::path(glm::dvec3 point, glm::dvec3 normal, Draws& draws) const {
  glm::dvec3 irradiance(0.0), throughput(1.0);
  for (;;) {
    const glm::dvec2 on_emitter = draws.pair(), on_disk = draws.pair();
    irradiance += throughput * sampleEmitter(point, normal, on_emitter.x, on_emitter.y);
    const glm::dvec3 direction = cosineDirection(normal, on_disk.x, on_disk.y);
    const auto hit = rays_.intersect(rays_.lifted(point, normal), direction);
    if (!hit) {
      irradiance += throughput * sky_;
      break;
    }
    if (density_[hit->triangle] > 0) {
      const double of_direction = glm::dot(direction, normal) / kPi;
      const double cosine = -glm::dot(direction, hit->normal);
      const double of_emitter = density_[hit->triangle] * hit->distance * hit->distance / cosine;
      if (of_direction > 0 && cosine > 0) {
        irradiance +=
            throughput * emission(hit->triangle, hit->back) * powerHeuristic(of_direction, of_emitter);
      }
    }
    throughput *= reflectance(hit->triangle);
    const double survival = std::min(largest(throughput) / kRoulette, kMostSurvival);
    if (draws.random.next() >= survival) break;
    throughput /= survival;
    point = hit->position;
    normal = hit->normal;
  }
  return irradiance;
}

bool PathTracer::findsWayOut(glm::dvec3 point, glm::dvec3 normal, int bounces) const {
  RandomStream random(0);
  for (int k = 0; k < bounces; ++k) {
    const double u = random.next(), v = random.next();
    const auto hit = rays_.intersect(rays_.lifted(point, normal), cosineDirection(normal, u, v));
    if (!hit) return true;
    point = hit->position;
    normal = hit->normal;
  }
  return false;
}

glm::dvec3 PathTracer::irradiance(const glm::dvec3& point, const glm::dvec3& normal, std::uint64_t stream,
                                  std::uint64_t batch) const {
  RandomStream random(mixBits(mixBits(stream) ^ batch));
  std::array<Shuffle, 2 * kStratified> grids;
  for (Shuffle& grid : grids) grid = shuffled(random);
  glm::dvec3 sum(0.0);
  for (std::uint32_t k = 0; k < kPathsPerBatch; ++k) {
    Draws draws{RandomStream(mixBits(mixBits(stream ^ (k + 1) * 0xd1342543de82ef95ull) ^ batch)), {}, 0};
    for (std::size_t pair = 0; pair < grids.size(); ++pair) draws.cells[pair] = grids[pair][k];
    sum += path(point, normal, draws);
  }
  return sum / static_cast<double>(kPathsPerBatch);
}

}  // namespace unshot
