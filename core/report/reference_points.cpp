// Where a reference is traced.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/random.h"
#include "rays/nearest_triangle.h"
#include "report/path_tracer.h"
#include "report/reference.h"

namespace unshot {
namespace {

constexpr std::uint64_t kPilotBatches = 32;  // that may find light before a side counts as dark
// A ray that meets a wall in its very edge may end up on the other side, once in some million.
constexpr int kBatchesThatFindLight = 2;
constexpr std::size_t kCandidatesPerPoint = 100;  // before the search is given up
constexpr double kLeastCosine = 0.5;              // between the normals of a place and of its side
constexpr double kReachOfDiagonal = 2e-3;         // of a place to its side
constexpr int kWalk = 10'000;                     // bounces without a way out

glm::dvec3 sideNormal(const SceneRays::Triangle& triangle, bool back) {
  return back ? -triangle.normal : triangle.normal;
}

class PointChooser {
 public:
  PointChooser(const Scene& scene, const ReferenceOptions& options)
      : scene_(scene), options_(options), tracer_(scene, options.emit_front_only, options.sky) {}

  std::vector<ReferencePoint> run() {
    std::vector<ReferencePoint> points = options_.places.empty() ? randomPoints() : givenPoints();
    refuseEndlessLight(points);
    return points;
  }

 private:
  ReferencePoint pointOn(std::uint32_t triangle, bool back, const glm::dvec3& position) const {
    ReferencePoint point;
    point.position = scene_.frame_origin + position;
    point.normal = sideNormal(tracer_.rays().triangle(triangle), back);
    point.reflectance = tracer_.reflectance(triangle);
    point.emission = tracer_.emission(triangle, back);
    point.radiosity = point.emission;
    point.standard_error = glm::dvec3(INFINITY);
    point.material = scene_.materials[scene_.polygons[tracer_.polygonOf(triangle)].material].name;
    return point;
  }

  bool isReached(const ReferencePoint& point, std::uint64_t stream) const {
    const glm::dvec3 position = point.position - scene_.frame_origin;
    int found = 0;
    for (std::uint64_t batch = 0; batch < kPilotBatches; ++batch) {
      const glm::dvec3 h = tracer_.irradiance(position, point.normal, stream, batch);
      if (point.reflectance * h != glm::dvec3(0.0) && ++found == kBatchesThatFindLight) return true;
    }
    return false;
  }

  /// Sides (2 triangle + back) that a point may lie on, and the running sum of their areas.
  void collectSides(bool emitting) {
    sides_.clear();
    cumulative_area_.clear();
    double sum = 0;
    for (std::uint32_t t = 0; t < tracer_.rays().triangleCount(); ++t) {
      if (tracer_.reflectance(t) == glm::dvec3(0.0)) continue;
      for (const bool back : {false, true}) {
        if ((tracer_.emission(t, back) != glm::dvec3(0.0)) != emitting) continue;
        sum += tracer_.rays().triangle(t).area;
        sides_.push_back(2 * t + back);
        cumulative_area_.push_back(sum);
      }
    }
  }

  std::vector<ReferencePoint> randomPoints() {
    collectSides(false);
    std::vector<ReferencePoint> points = drawPoints();
    if (points.empty() && options_.points > 0) {
      collectSides(true);
      points = drawPoints();
    }
    if (points.empty()) {
      throw Error(ErrorKind::kInput, "no light reaches a surface that reflects, so there is nothing to trace",
                  scene_.path.string(), "unshot check on the scene; do the lights face it?");
    }
    return points;
  }

  std::vector<ReferencePoint> drawPoints() const {
    std::vector<ReferencePoint> points;
    if (sides_.empty()) return points;
    const std::uint64_t stream = mixBits(options_.seed ^ 0x706f696e7473ull);
    const std::size_t candidates = kCandidatesPerPoint * std::max<std::size_t>(options_.points, 10);
    for (std::uint64_t k = 0; k < candidates && points.size() < options_.points; ++k) {
      const auto draw = [&](std::uint64_t which) { return unitInterval(mixBits(stream + 4 * k + which)); };
      const auto found = std::upper_bound(cumulative_area_.begin(), cumulative_area_.end() - 1,
                                          draw(0) * cumulative_area_.back());
      const std::uint32_t side = sides_[static_cast<std::size_t>(found - cumulative_area_.begin())];
      const glm::dvec3 position = tracer_.rays().triangle(side / 2).point(draw(1), draw(2));
      const ReferencePoint point = pointOn(side / 2, side % 2 != 0, position);
      if (isReached(point, mixBits(stream + 4 * k + 3))) points.push_back(point);
    }
    return points;
  }

  std::vector<ReferencePoint> givenPoints() const {
    const SceneRays& rays = tracer_.rays();
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> corners;
    for (std::uint32_t t = 0; t < rays.triangleCount(); ++t) {
      for (const glm::dvec3& corner : rays.triangle(t).corners) {
        corners.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.emplace_back(corner);
      }
    }
    const NearestTriangle nearest(positions, corners);
    const auto reach =
        static_cast<float>(kReachOfDiagonal * glm::length(scene_.bounds_max - scene_.bounds_min));
    std::vector<ReferencePoint> points;
    for (const ReferencePlace& place : options_.places) {
      const glm::dvec3 normal = glm::normalize(place.normal);
      const auto faces = [&](std::uint32_t t) {
        return std::abs(glm::dot(rays.triangle(t).normal, normal)) >= kLeastCosine;
      };
      const auto hit = nearest.find(glm::vec3(place.position - scene_.frame_origin), reach, faces);
      if (!hit) {
        throw Error(ErrorKind::kInput, "a point of the reference lies on no surface that faces its normal",
                    scene_.path.string(), "points that belong to this scene, in the file's coordinates");
      }
      const SceneRays::Triangle& triangle = rays.triangle(hit->triangle);
      glm::dvec3 position(0.0);
      for (int k = 0; k < 3; ++k) position += static_cast<double>(hit->weights[k]) * triangle.corners[k];
      points.push_back(pointOn(hit->triangle, glm::dot(triangle.normal, normal) < 0, position));
    }
    return points;
  }

  /// A channel that no surface absorbs needs a way out.
  void refuseEndlessLight(const std::vector<ReferencePoint>& points) const {
    glm::dvec3 least(1.0);
    for (std::uint32_t t = 0; t < tracer_.rays().triangleCount(); ++t) {
      least = glm::min(least, tracer_.reflectance(t));
    }
    if (points.empty() || std::max({least.x, least.y, least.z}) < 1) return;
    if (tracer_.findsWayOut(points[0].position - scene_.frame_origin, points[0].normal, kWalk)) return;
    throw Error(ErrorKind::kInput, "walls that absorb nothing and let nothing out have no finite solution",
                scene_.path.string(), "reflectance (Kd) below 1 on some surface");
  }

  const Scene& scene_;
  const ReferenceOptions& options_;
  PathTracer tracer_;
  std::vector<std::uint32_t> sides_;
  std::vector<double> cumulative_area_;
};

}  // namespace

std::vector<ReferencePoint> chooseReferencePoints(const Scene& scene, const ReferenceOptions& options) {
  return PointChooser(scene, options).run();
}

}  // namespace unshot
