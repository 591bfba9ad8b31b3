#include "session/light_views.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "base/cosine_direction.h"
#include "base/random.h"

namespace unshot {
namespace {

// Over all lights, and for one.
constexpr std::uint32_t kAllRays = 20'000, kFewestRays = 32, kMostRays = 256, kMostLights = 2'000;
// Of those that seem to see nothing or to be shut in, so many are looked at again, with so many rays each.
constexpr std::uint32_t kMostSecondLooks = 64, kSecondRays = 1'000;
constexpr double kNearTheLight = 0.01;  // of the light's size
// A walk of the light that is reflected, and how much of the scene's size it has to get about in.
constexpr std::uint32_t kWalks = 128, kWalkSteps = 8;
constexpr double kShutInSize = 0.6;
constexpr double kMostly = 0.95;

}  // namespace

/// Where a ray begins.
struct LightLooks::Start {
  std::uint32_t surface = 0;
  bool back = false;
  glm::dvec3 point{0.0}, normal{0.0};
};

/// Points on the sides of a light that emit, uniform by area.
struct LightLooks::Sampler {
  const Mesh& mesh;
  bool both;
  std::vector<std::uint32_t> surface, triangle;
  std::vector<double> until;  // area of all triangles up to this one

  Sampler(const Mesh& of, const std::vector<std::uint32_t>& surfaces, bool both_sides)
      : mesh(of), both(both_sides) {
    double area = 0;
    for (const std::uint32_t s : surfaces) {
      const Range& range = mesh.surfaces[s].triangles;
      for (std::uint32_t t = range.first; t < range.end(); ++t) {
        const ChartTriangle& c = mesh.triangles[t];
        const glm::dvec2 a = c.uv[1] - c.uv[0], b = c.uv[2] - c.uv[0];
        area += 0.5 * std::abs(a.x * b.y - a.y * b.x);
        surface.push_back(s);
        triangle.push_back(t);
        until.push_back(area);
      }
    }
  }

  Start start(std::uint64_t seed) const {
    const auto unit = [&](std::uint64_t k) { return unitInterval(mixBits(seed + k)); };
    const auto found = std::upper_bound(until.begin(), until.end(), unit(0) * until.back());
    const auto k = static_cast<std::size_t>(std::min(found, until.end() - 1) - until.begin());
    const Surface& s = mesh.surfaces[surface[k]];
    const ChartTriangle& t = mesh.triangles[triangle[k]];
    const double root = std::sqrt(unit(1)), v = unit(2);
    const glm::dvec2 uv = (1 - root) * t.uv[0] + root * (1 - v) * t.uv[1] + root * v * t.uv[2];
    const bool back = both && unit(3) < 0.5;
    return {surface[k], back, s.point(uv), back ? -s.normal : s.normal};
  }
  /// Two numbers for a direction.
  static glm::dvec2 direction(std::uint64_t seed) {
    return {unitInterval(mixBits(seed + 4)), unitInterval(mixBits(seed + 5))};
  }
  static std::uint64_t seed(std::uint64_t ray) { return 8 * ray; }
};

LightLooks::LightLooks(const Mesh& mesh, bool emit_front_only, const CancelToken& cancel)
    : mesh_(mesh), emit_front_only_(emit_front_only), cancel_(cancel) {
  groupLights();
}

// Emitting surfaces of one material that share a corner.
void LightLooks::groupLights() {
  light_of_.assign(mesh_.surfaces.size(), kNone);
  std::vector<std::uint32_t> root(mesh_.surfaces.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t s) {
    while (root[s] != s) s = root[s] = root[root[s]];
    return s;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> at;
  const auto emits = [&](const Surface& s) { return mesh_.materials[s.material].emits() && s.area > 0; };
  for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
    const Surface& surface = mesh_.surfaces[s];
    if (!emits(surface)) continue;
    for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
      for (const std::uint32_t v : mesh_.triangles[t].position) {
        const std::uint32_t other = at.emplace(std::pair(surface.material, v), s).first->second;
        root[std::max(find(s), find(other))] = std::min(find(s), find(other));
      }
    }
  }
  for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
    if (!emits(mesh_.surfaces[s])) continue;
    const std::uint32_t first = find(s);
    if (first == s) {
      light_of_[s] = static_cast<std::uint32_t>(lights_.size());
      lights_.emplace_back();
    }
    light_of_[s] = light_of_[first];
    lights_[light_of_[s]].push_back(s);
  }
}

std::vector<LightView> LightLooks::look(const MeshRays& rays, const ParallelSurfaces& parallels) const {
  const auto count = static_cast<std::uint32_t>(lights_.size());
  const std::uint32_t each = std::clamp(kAllRays / std::max(count, 1u), kFewestRays, kMostRays);
  const std::uint32_t stride = 1 + count / kMostLights;
  std::vector<LightView> views;
  std::uint32_t second_looks = 0;
  for (std::uint32_t k = 0; k < count; k += stride) {
    cancel_.check();
    LightView view = lookAt(lights_[k], each, rays, parallels);
    const bool nothing = view.lost == view.rays;
    const bool shut =
        view.lost == 0 && view.backs > 0 && view.backs >= kMostly * (view.arrived() + view.near);
    if ((nothing || shut) && second_looks++ < kMostSecondLooks) {
      const Sampler sampler(mesh_, lights_[k], !emit_front_only_);
      if (nothing && seesAnything(sampler, rays)) {
        --view.lost;
        ++view.fronts;
      }
      view.shut_in = shut && shutIn(sampler, rays);
    }
    views.push_back(std::move(view));
  }
  return views;
}

LightView LightLooks::lookAt(const std::vector<std::uint32_t>& surfaces, std::uint32_t count,
                             const MeshRays& rays, const ParallelSurfaces& parallels) const {
  LightView view;
  view.surfaces = surfaces;
  const Sampler sampler(mesh_, surfaces, !emit_front_only_);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint64_t seed = Sampler::seed(k);
    follow(sampler, sampler.start(seed), Sampler::direction(seed), rays, parallels, view);
  }
  return view;
}

void LightLooks::follow(const Sampler& sampler, const Start& start, const glm::dvec2& direction,
                        const MeshRays& rays, const ParallelSurfaces& parallels, LightView& view) const {
  ++view.rays;
  const std::uint32_t light = light_of_[start.surface];
  const double near = kNearTheLight * std::sqrt(sampler.until.back());
  bool covered = false, flush = false;
  for (const ParallelSurfaces::Found& found : parallels.around(start.point, start.surface, near)) {
    if (light_of_[found.surface] == light) continue;
    flush = flush || std::abs(found.height) <= mesh_.weld_distance;
    covered = covered || (start.back ? found.height < 0 : found.height > 0);
  }
  if (flush) {
    ++view.flush;
    return;
  }
  if (covered) {
    ++view.near;
    return;
  }
  const glm::dvec3 d = cosineDirection(start.normal, direction.x, direction.y);
  const auto hit = rays.intersect(rays.rays().lifted(start.point, start.normal), d);
  if (!hit) {
    ++view.lost;
  } else if (light_of_[hit->surface] == light) {
    ++view.own;
  } else if (glm::dot(hit->at.position - start.point, start.normal) < near && hit->at.distance < 100 * near) {
    ++view.near;
  } else {
    ++(hit->at.back ? view.backs : view.fronts);
  }
}

// Whether more rays, half of them towards what there is, find a surface that the light falls on.
bool LightLooks::seesAnything(const Sampler& sampler, const MeshRays& rays) const {
  const std::uint32_t light = light_of_[sampler.surface[0]];
  for (std::uint32_t k = 0; k < kSecondRays; ++k) {
    cancel_.check();
    const std::uint64_t seed = Sampler::seed(kMostRays + k);
    const Start start = sampler.start(seed);
    const glm::dvec3 from = rays.rays().lifted(start.point, start.normal);
    const glm::dvec2 random = Sampler::direction(seed);
    const auto hit = rays.intersect(from, cosineDirection(start.normal, random.x, random.y));
    if (hit && light_of_[hit->surface] != light) return true;
    const auto t = static_cast<std::uint32_t>(random.x * static_cast<double>(rays.rays().triangleCount()));
    if (light_of_[rays.surfaceOf(t)] == light) continue;
    const SceneRays::Triangle& triangle = rays.rays().triangle(t);
    const glm::dvec3 way = triangle.point(random.y, unitInterval(mixBits(seed + 6))) - from;
    const double length = glm::length(way);
    if (!(glm::dot(way, start.normal) > 0) || !(length > 0)) continue;
    const auto aimed = rays.intersect(from, way / length);
    if (aimed && light_of_[aimed->surface] != light) return true;
  }
  return false;
}

bool LightLooks::shutIn(const Sampler& sampler, const MeshRays& rays) const {
  glm::dvec3 low(INFINITY), high(-INFINITY);
  for (std::uint32_t walk = 0; walk < kWalks; ++walk) {
    cancel_.check();
    const std::uint64_t seed = Sampler::seed(kMostRays + kSecondRays + walk * kWalkSteps);
    const Start start = sampler.start(seed);
    glm::dvec3 point = start.point, normal = start.normal;
    for (std::uint32_t step = 0; step < kWalkSteps; ++step) {
      const glm::dvec2 random = Sampler::direction(seed + Sampler::seed(step));
      const auto hit =
          rays.intersect(rays.rays().lifted(point, normal), cosineDirection(normal, random.x, random.y));
      if (!hit) return false;
      point = hit->at.position;
      normal = hit->at.normal;
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  return glm::length(high - low) < kShutInSize * glm::length(mesh_.bounds_max - mesh_.bounds_min);
}

}  // namespace unshot
