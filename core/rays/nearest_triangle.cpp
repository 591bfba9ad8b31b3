// Nearest point of a triangle: Christer Ericson, Real-Time Collision Detection (2005), section 5.1.5.
#include "rays/nearest_triangle.h"

#include <embree3/rtcore.h>

#include <glm/geometric.hpp>
#include <vector>

#include "base/error.h"
#include "rays/unit_scale.h"

namespace unshot {
namespace {

/// Barycentric weights of the point of triangle abc that is nearest to p.
glm::vec3 nearestWeights(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const float t = d1 / (d1 - d3);
    return {1 - t, t, 0};
  }
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const float t = d2 / (d2 - d6);
    return {1 - t, 0, t};
  }
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const float t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const float sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace

struct NearestTriangle::Impl {
  float scale = 1;
  std::vector<glm::vec3> positions;  // scaled
  std::vector<std::uint32_t> corners;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

struct Query {
  std::span<const glm::vec3> positions;
  std::span<const std::uint32_t> corners;
  const std::function<bool(std::uint32_t)>* accept;
  glm::vec3 point;
  std::optional<NearestTriangle::Hit> best;
};

bool visitTriangle(RTCPointQueryFunctionArguments* arguments) {
  Query& query = *static_cast<Query*>(arguments->userPtr);
  const std::uint32_t triangle = arguments->primID;
  if (!(*query.accept)(triangle)) return false;
  const glm::vec3& a = query.positions[query.corners[3 * triangle]];
  const glm::vec3& b = query.positions[query.corners[3 * triangle + 1]];
  const glm::vec3& c = query.positions[query.corners[3 * triangle + 2]];
  const glm::vec3 weights = nearestWeights(query.point, a, b, c);
  const float distance = glm::length(query.point - (weights.x * a + weights.y * b + weights.z * c));
  if (!(distance <= arguments->query->radius)) return false;
  if (query.best && (distance > query.best->distance ||
                     (distance == query.best->distance && triangle > query.best->triangle))) {
    return false;
  }
  query.best = NearestTriangle::Hit{triangle, weights, distance};
  arguments->query->radius = distance;
  return true;
}

}  // namespace

NearestTriangle::NearestTriangle(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners)
    : impl_(std::make_unique<Impl>()) {
  impl_->scale = unitScale(positions);
  for (const glm::vec3& p : positions) impl_->positions.push_back(impl_->scale * p);
  impl_->corners.assign(corners.begin(), corners.end());
  impl_->device = rtcNewDevice("threads=1");
  if (!impl_->device) throw Error(ErrorKind::kEnvironment, "Embree could not start", {}, "free some memory");
  impl_->scene = rtcNewScene(impl_->device);
  const std::size_t triangles = corners.size() / 3;
  if (triangles > 0) {
    RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree copies into its own buffers, which it pads as it needs.
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(glm::vec3), positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(std::uint32_t), triangles);
    if (vertices)
      std::copy(impl_->positions.begin(), impl_->positions.end(), static_cast<glm::vec3*>(vertices));
    if (indices) std::copy_n(corners.begin(), 3 * triangles, static_cast<std::uint32_t*>(indices));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(impl_->scene);
  if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE) {
    throw Error(ErrorKind::kEnvironment, "Embree could not build its tree of triangles", {},
                "free some memory");
  }
}

NearestTriangle::~NearestTriangle() = default;

std::optional<NearestTriangle::Hit> NearestTriangle::find(
    const glm::vec3& point, float radius, const std::function<bool(std::uint32_t)>& accept) const {
  const glm::vec3 centre = impl_->scale * point;
  Query query{impl_->positions, impl_->corners, &accept, centre, std::nullopt};
  RTCPointQuery sphere{};
  sphere.x = centre.x;
  sphere.y = centre.y;
  sphere.z = centre.z;
  sphere.radius = impl_->scale * radius;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(impl_->scene, &sphere, &context, visitTriangle, &query);
  if (query.best) query.best->distance /= impl_->scale;
  return query.best;
}

}  // namespace unshot
