#include "session/gather.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/cosine_direction.h"
#include "base/random.h"
#include "formfactor/polygon_factor.h"
#include "mesh/grid.h"

namespace unshot {
namespace {

// Shadow rays to an emitter, a grid: where there are few emitters, and where there are many.
constexpr int kShadowStrata = 5, kFewShadowStrata = 2;
constexpr std::size_t kFewEmitters = 4;
// Of those that are not taken one by one at least this part of all is drawn.
constexpr std::size_t kLeastDrawn = 4;
// Emitters are wide from nearer than so many radii, and nearer to their plane than one.
constexpr double kNear = 3;
// Times SceneRays::lift: distances that rays tell from none.
constexpr double kTold = 10;

constexpr std::size_t kBlock = EmitterTable::kBlock;

struct Draws {
  std::uint64_t state;
  double next() { return unitInterval(state = mixBits(state)); }
};

}  // namespace

Gatherer::Gatherer(const Mesh& mesh)
    : mesh_(mesh), rays_(mesh), table_(1 / glm::distance(mesh.bounds_min, mesh.bounds_max)) {
  double strongest = 0;  // so that any strength is within the range of single precision
  for (const Side& side : mesh.sides)
    strongest = std::max(strongest, side.emission.x + side.emission.y + side.emission.z);
  strongest *= mesh.surfaces.empty() ? 1 : 1 / (table_.scale() * table_.scale());
  for (std::uint32_t s = 0; s < mesh.sides.size(); ++s) {
    const glm::dvec3& e = mesh.sides[s].emission;
    if (e == glm::dvec3(0.0)) continue;
    const Range& range = mesh.surfaces[mesh.sides[s].surface].triangles;
    for (std::uint32_t t = range.first; t < range.end(); ++t) {
      const SceneRays::Triangle& triangle = rays_.rays().triangle(t);
      const auto& p = triangle.corners;
      const glm::dvec3 centre = (p[0] + p[1] + p[2]) / 3.0;
      const double radius =
          std::max({glm::distance(p[0], centre), glm::distance(p[1], centre), glm::distance(p[2], centre)});
      emitters_.push_back({t, s});
      table_.add(centre, mesh.sides[s].normal, radius, (e.x + e.y + e.z) * triangle.area / strongest);
    }
  }
  table_.fill();
}

std::uint32_t Gatherer::elementOf(std::uint32_t surface, std::uint32_t side,
                                  const glm::dvec3& position) const {
  const Surface& s = mesh_.surfaces[surface];
  const std::uint32_t local = elementAt(mesh_, s, s.chart(position));
  return local == kNone ? kNone : mesh_.sides[side].first_element + local;
}

Gather Gatherer::lookFromAll(std::span<const glm::dvec3> positions, const glm::dvec3& normal,
                             std::uint64_t stream, const LookSize& size) const {
  Gather out;
  const int strata = size.strata;
  out.rays.reserve(static_cast<std::size_t>(strata * strata));
  std::vector<glm::dvec3> eyes;
  for (const glm::dvec3& position : positions) eyes.push_back(rays_.rays().lifted(position, normal));
  Draws draws{mixBits(stream)};
  std::vector<Reach> reaches;
  reaches.reserve(static_cast<std::size_t>(strata * strata));
  for (int i = 0; i < strata; ++i) {
    for (int j = 0; j < strata; ++j) {
      const double u = (i + draws.next()) / strata, v = (j + draws.next()) / strata;
      const glm::dvec3 direction = cosineDirection(normal, u, v);
      const auto hit = rays_.intersect(eyes[reaches.size() % eyes.size()], direction);
      reaches.push_back({direction, hit ? hit->at.distance : std::numeric_limits<double>::infinity()});
      out.rays.push_back(!hit                 ? kToSky
                         : hit->side == kNone ? kNone
                                              : elementOf(hit->surface, hit->side, hit->at.position));
    }
  }
  if (positions.size() > 1 || !size.without_bias) reaches.clear();  // of several they are of no one
  lookAtLights(positions, normal, reaches, mixBits(stream ^ 0x5bd1e995u), size.emitters, out);
  return out;
}

void Gatherer::lookAtLights(std::span<const glm::dvec3> positions, const glm::dvec3& normal,
                            const std::vector<Reach>& reaches, std::uint64_t stream, std::size_t most,
                            Gather& out) const {
  if (most == 0) return;
  if (emitters_.size() <= most) {
    const int strata = emitters_.size() <= kFewEmitters ? kShadowStrata : kFewShadowStrata;
    for (std::size_t k = 0; k < emitters_.size(); ++k)
      for (std::size_t i = 0; i < positions.size(); ++i)
        lookAtLight(emitters_[k], positions[i], normal, reaches,
                    positions.size() > 1 ? kFewShadowStrata : strata,
                    1 / static_cast<double>(positions.size()), mixBits(stream + k + (i << 32)), out);
    return;
  }
  // Of several positions: the ball around them.
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& p : positions) middle += p / static_cast<double>(positions.size());
  double spread = 0;
  for (const glm::dvec3& p : positions) spread = std::max(spread, glm::distance(p, middle));
  thread_local std::vector<float> may;
  const double all = table_.shares(middle, normal, spread, may);
  // Those that matter are taken one by one, the others drawn in strata of their sum.
  const auto matters = static_cast<float>(all / static_cast<double>(2 * most));
  std::size_t taken = 0;
  double total = 0;
  thread_local std::vector<double> sums;  // of the others of each block
  sums.assign(may.size() / kBlock, 0);
  for (std::size_t block = 0; block < sums.size(); ++block) {
    double sum = 0;
    for (std::size_t k = block * kBlock; k < (block + 1) * kBlock; ++k) {
      if (may[k] >= matters && may[k] > 0) {
        lookAtLight(emitters_[k], positions[taken++ % positions.size()], normal, reaches, kFewShadowStrata, 1,
                    mixBits(stream + most + k), out);
        may[k] = 0;
      }
      sum += static_cast<double>(may[k]);
    }
    total += sums[block] = sum;
  }
  if (!(total > 0)) return;
  const std::size_t count = std::max(most - std::min(taken, most), most / kLeastDrawn);
  Draws draws{stream};
  std::size_t block = 0;
  double before = 0;  // of the sum, the blocks before
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + draws.next()) / static_cast<double>(count) * total;
    while (block + 1 < sums.size() && before + sums[block] <= at) before += sums[block++];
    double left = at - before;
    std::size_t drawn = block * kBlock;
    for (std::size_t k = drawn; k < (block + 1) * kBlock; ++k) {
      if (may[k] <= 0) continue;
      drawn = k;
      if ((left -= static_cast<double>(may[k])) < 0) break;
    }
    if (may[drawn] <= 0) continue;  // by rounding, at the end
    const double probability = static_cast<double>(may[drawn]) / total;
    lookAtLight(emitters_[drawn], positions[(taken + i) % positions.size()], normal, reaches,
                kFewShadowStrata, 1 / (static_cast<double>(count) * probability), mixBits(stream + i), out);
  }
}

void Gatherer::lookAtLight(const Emitter& emitter, const glm::dvec3& position, const glm::dvec3& normal,
                           const std::vector<Reach>& reaches, int strata, double weight, std::uint64_t stream,
                           Gather& out) const {
  const Side& side = mesh_.sides[emitter.side];
  const SceneRays::Triangle& t = rays_.rays().triangle(emitter.triangle);
  if (glm::dot(position - t.corners[0], side.normal) <= rays_.rays().lift()) return;
  const bool reversed = glm::dot(t.normal, side.normal) < 0;
  const glm::dvec3 ring[3] = {t.corners[0], t.corners[reversed ? 2 : 1], t.corners[reversed ? 1 : 2]};
  std::vector<glm::dvec3> scratch;
  const double factor = weight * std::max(pointToPolygonFactor(position, normal, ring, scratch), 0.0);
  if (factor <= 0) return;
  const glm::dvec3 eye = rays_.rays().lifted(position, normal);
  // Samples spread over its area say little of an emitter that is wider than it is away.
  const glm::dvec3 centre = (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0;
  const double radius = std::sqrt(t.area);
  const bool wide = !reaches.empty() && glm::dot(position - centre, side.normal) < radius &&
                    glm::length(centre - position) < kNear * radius;
  struct Sample {
    std::uint32_t element;
    double kernel;
  };
  std::vector<Sample> visible;
  double kernels = 0;
  Draws draws{stream};
  for (int i = 0; i < strata; ++i) {
    for (int j = 0; j < strata; ++j) {
      const double u = (i + draws.next()) / strata, v = (j + draws.next()) / strata;
      const glm::dvec3 at = t.point(u, v), to = at - position;
      const double square = glm::dot(to, to), from_eye = glm::dot(to, normal),
                   from_light = -glm::dot(to, side.normal);
      if (from_eye <= 0 || from_light <= 0) continue;  // below the horizon: not hidden, not there
      const double kernel = from_eye * from_light / (square * square);
      kernels += kernel;
      if (!wide && rays_.rays().occluded(eye, rays_.rays().lifted(at, side.normal))) continue;
      visible.push_back({elementOf(side.surface, emitter.side, at), kernel});
    }
  }
  for (const Sample& s : visible) {
    if (s.element == kNone) continue;
    out.lights.push_back({mesh_.element_patch[s.element], static_cast<float>(factor * s.kernel / kernels)});
  }
  if (wide) takeHidden(emitter, position, reaches, weight, out);
}

// Off the light of an emitter that counts whole: the share of the rays that point at it and end before.
void Gatherer::takeHidden(const Emitter& emitter, const glm::dvec3& position,
                          const std::vector<Reach>& reaches, double weight, Gather& out) const {
  const Side& side = mesh_.sides[emitter.side];
  const SceneRays::Triangle& t = rays_.rays().triangle(emitter.triangle);
  for (const Reach& reach : reaches) {
    const double towards = -glm::dot(reach.direction, side.normal);
    if (towards <= 0) continue;
    const double distance = glm::dot(position - t.corners[0], side.normal) / towards;
    if (reach.distance >= distance - kTold * rays_.rays().lift()) continue;
    const glm::dvec3 at = position + distance * reach.direction;
    bool inside = true;
    for (int k = 0; k < 3; ++k)
      inside = inside &&
               glm::dot(glm::cross(t.corners[(k + 1) % 3] - t.corners[k], at - t.corners[k]), t.normal) >= 0;
    if (!inside) continue;
    const std::uint32_t element = elementOf(side.surface, emitter.side, at);
    if (element != kNone)
      out.lights.push_back(
          {mesh_.element_patch[element], static_cast<float>(-weight / static_cast<double>(reaches.size()))});
  }
}

}  // namespace unshot
