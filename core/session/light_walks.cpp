#include "session/light_walks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "base/cosine_direction.h"
#include "base/random.h"

namespace unshot {
namespace {

// By the fourth bounce light has forgotten where it came from; on the following ones its decay is measured.
constexpr std::uint32_t kWalkers = 1024, kForgotten = 4, kBounces = 16;
constexpr std::uint32_t kLightWalkers = 1024, kMostLightBounces = 32;
// Of the light that a walker began with: less is not followed.
constexpr double kNotFollowed = 0.01;
constexpr double kNearlyOne = 1 - 1e-9;

class Walks {
 public:
  Walks(const Mesh& mesh, const MeshRays& rays, const CancelToken& cancel)
      : mesh_(mesh), rays_(rays), cancel_(cancel) {}

  LightWalks run() {
    if (mesh_.sides.empty()) return out_;
    measureRadius();
    measureEscape();
    return out_;
  }

 private:
  struct Walker {
    glm::dvec3 point{0.0}, normal{0.0};
    std::uint32_t side = 0;
  };

  // Triangles of the sides with a weight, for walkers to begin on.
  struct Starts {
    std::vector<std::uint32_t> side, triangle;
    std::vector<double> until;
  };

  double random() { return unitInterval(mixBits(counter_++)); }

  template <class Weight>
  Starts startsFor(Weight weight) const {
    Starts starts;
    double sum = 0;
    for (std::uint32_t side = 0; side < mesh_.sides.size(); ++side) {
      const double w = weight(mesh_.sides[side]);
      if (!(w > 0)) continue;
      const Range& range = mesh_.surfaces[mesh_.sides[side].surface].triangles;
      for (std::uint32_t t = range.first; t < range.end(); ++t) {
        sum += w * rays_.rays().triangle(t).area;
        starts.side.push_back(side);
        starts.triangle.push_back(t);
        starts.until.push_back(sum);
      }
    }
    return starts;
  }

  Walker begin(const Starts& starts) {
    const double at = random() * starts.until.back();
    const auto found = std::upper_bound(starts.until.begin(), starts.until.end(), at);
    const auto k = static_cast<std::size_t>(std::min(found, starts.until.end() - 1) - starts.until.begin());
    const double u = random(), v = random();
    const std::uint32_t side = starts.side[k];
    return {rays_.rays().triangle(starts.triangle[k]).point(u, v), mesh_.sides[side].normal, side};
  }

  // On to where its light arrives; false where it leaves the scene.
  bool step(Walker& walker) {
    const double u = random(), v = random();
    const auto hit = rays_.intersect(rays_.rays().lifted(walker.point, walker.normal),
                                     cosineDirection(walker.normal, u, v));
    ++out_.rays;
    out_.escapes += !hit;
    if (!hit || hit->side == kNone) return false;  // it began where no light comes, such as below a block
    walker = {hit->at.position, hit->at.normal, hit->side};
    return true;
  }

  void measureRadius() {
    const Starts starts = startsFor([](const Side&) { return 1.0; });
    if (starts.until.empty() || !(starts.until.back() > 0)) return;
    std::vector<glm::dvec3> after(kBounces + 1, glm::dvec3(0.0));
    for (std::uint32_t k = 0; k < kWalkers; ++k) {
      cancel_.check();
      Walker walker = begin(starts);
      glm::dvec3 light = mesh_.sides[walker.side].reflectance;
      after[0] += light;
      for (std::uint32_t bounce = 1; bounce <= kBounces && step(walker); ++bounce) {
        light *= mesh_.sides[walker.side].reflectance;
        after[bounce] += light;
      }
    }
    for (int c = 0; c < 3; ++c) {
      std::uint32_t last = kBounces;
      while (last > kForgotten && !(after[last][c] > 0)) --last;
      if (!(after[last][c] > 0) || last == kForgotten) continue;
      out_.spectral_radius[c] = std::pow(after[last][c] / after[kForgotten][c], 1.0 / (last - kForgotten));
    }
  }

  void measureEscape() {
    const auto power = [](const Side& s) { return s.emission.x + s.emission.y + s.emission.z; };
    const Starts starts = startsFor(power);
    if (starts.until.empty() || !(starts.until.back() > 0)) return;
    double escaped = 0;
    for (std::uint32_t k = 0; k < kLightWalkers; ++k) {
      cancel_.check();
      Walker walker = begin(starts);
      glm::dvec3 light = mesh_.sides[walker.side].emission;
      light /= light.x + light.y + light.z;
      for (std::uint32_t bounce = 0; bounce < kMostLightBounces; ++bounce) {
        if (!step(walker)) {
          escaped += light.x + light.y + light.z;
          break;
        }
        light *= mesh_.sides[walker.side].reflectance;
        if (light.x + light.y + light.z < kNotFollowed) break;
      }
    }
    out_.escaped = escaped / kLightWalkers;
  }

  const Mesh& mesh_;
  const MeshRays& rays_;
  const CancelToken& cancel_;
  std::uint64_t counter_ = 0;
  LightWalks out_;
};

}  // namespace

double LightWalks::largestRadius() const {
  return std::max({spectral_radius.x, spectral_radius.y, spectral_radius.z});
}

std::optional<double> LightWalks::bouncesToOnePercent() const {
  const double radius = largestRadius();
  if (radius >= kNearlyOne) return std::nullopt;
  return radius > 0.01 ? std::ceil(std::log(0.01) / std::log(radius)) : 1.0;
}

LightWalks walkLight(const Mesh& mesh, const MeshRays& rays, const CancelToken& cancel) {
  return Walks(mesh, rays, cancel).run();
}

}  // namespace unshot
