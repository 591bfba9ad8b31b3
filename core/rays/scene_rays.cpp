#include "rays/scene_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "base/error.h"
#include "rays/unit_scale.h"

namespace unshot {
namespace {

// In coordinates up to 1, single precision places a point within 1e-7 of a plane.
constexpr double kLift = 1.5e-6;

[[noreturn]] void failForMemory() {
  throw Error(ErrorKind::kEnvironment, "there is no memory for rays against the scene", {},
              "free some memory");
}

// One for all scenes, since to make one takes as long as to build a small scene.
RTCDevice sharedDevice() {
  static const RTCDevice device = rtcNewDevice("threads=1");
  return device;
}

RTCRay rayOf(const glm::dvec3& origin, const glm::dvec3& direction, float far_distance) {
  RTCRay ray;
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = 0;
  ray.tfar = far_distance;
  ray.time = 0;
  ray.mask = ~0u;
  ray.id = 0;
  ray.flags = 0;
  return ray;
}

}  // namespace

struct SceneRays::Impl {
  double scale = 1;  // of what Embree sees
  std::vector<Triangle> triangles;
  RTCScene scene = nullptr;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
  }

  bool meetsAny(RTCRay ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0;
  }

  // Which of the segments from `a` to `b` meet anything, as bits: `trace` takes kMost rays together.
  template <std::size_t kMost, class Rays, class Trace>
  std::uint32_t occluded(Trace trace, const glm::dvec3& a, std::span<const glm::dvec3> b) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    Rays rays;
    alignas(64) int valid[kMost];
    const glm::dvec3 origin = scale * a;
    for (std::size_t k = 0; k < kMost; ++k) {
      const glm::dvec3 way = k < b.size() ? scale * (b[k] - a) : glm::dvec3(0.0);
      valid[k] = k < b.size() ? -1 : 0;
      rays.org_x[k] = static_cast<float>(origin.x);
      rays.org_y[k] = static_cast<float>(origin.y);
      rays.org_z[k] = static_cast<float>(origin.z);
      rays.dir_x[k] = static_cast<float>(way.x);
      rays.dir_y[k] = static_cast<float>(way.y);
      rays.dir_z[k] = static_cast<float>(way.z);
      rays.tnear[k] = 0;
      rays.tfar[k] = 1;
      rays.time[k] = 0;
      rays.mask[k] = ~0u;
      rays.id[k] = 0;
      rays.flags[k] = 0;
    }
    trace(valid, scene, &context, &rays);
    std::uint32_t out = 0;
    for (std::size_t k = 0; k < b.size(); ++k) out |= static_cast<std::uint32_t>(rays.tfar[k] < 0) << k;
    return out;
  }

  void build(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners) {
    const RTCDevice device = sharedDevice();
    if (!device)
      throw Error(ErrorKind::kEnvironment, "Embree gives no device", {}, "reinstalling libembree3");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    if (corners.empty()) return rtcCommitScene(scene);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), corners.size() / 3));
    if (!vertices || !indices) {
      rtcReleaseGeometry(geometry);
      failForMemory();
    }
    std::copy(positions.begin(), positions.end(), vertices);
    std::copy(corners.begin(), corners.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) failForMemory();
  }
};

glm::dvec3 SceneRays::Triangle::point(double u, double v) const {
  const double root = std::sqrt(u);
  return (1 - root) * corners[0] + root * (1 - v) * corners[1] + root * v * corners[2];
}

SceneRays::SceneRays(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> corners)
    : impl_(std::make_unique<Impl>()) {
  std::vector<glm::vec3> scaled(positions.begin(), positions.end());
  impl_->scale = static_cast<double>(unitScale(scaled));
  for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] = glm::vec3(impl_->scale * positions[k]);
  impl_->triangles.reserve(corners.size() / 3);
  for (std::size_t t = 0; 3 * t < corners.size(); ++t) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = positions[corners[3 * t + k]];
    const glm::dvec3 cross =
        glm::cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
    const double length = glm::length(cross);
    if (length > 0) triangle.normal = cross / length;
    triangle.area = length / 2;
    impl_->triangles.push_back(triangle);
  }
  impl_->build(scaled, corners);
}

SceneRays::SceneRays(SceneRays&&) noexcept = default;
SceneRays::~SceneRays() = default;

std::optional<SceneRays::Hit> SceneRays::intersect(const glm::dvec3& origin,
                                                   const glm::dvec3& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray;
  ray.ray = rayOf(impl_->scale * origin, direction, INFINITY);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Triangle& triangle = impl_->triangles[ray.hit.primID];
  const double u = static_cast<double>(ray.hit.u), v = static_cast<double>(ray.hit.v);
  Hit hit;
  hit.triangle = ray.hit.primID;
  hit.position = (1 - u - v) * triangle.corners[0] + u * triangle.corners[1] + v * triangle.corners[2];
  hit.distance = glm::dot(hit.position - origin, direction);
  hit.back = glm::dot(direction, triangle.normal) > 0;
  hit.normal = hit.back ? -triangle.normal : triangle.normal;
  return hit;
}

bool SceneRays::occluded(const glm::dvec3& a, const glm::dvec3& b) const {
  return impl_->meetsAny(rayOf(impl_->scale * a, impl_->scale * (b - a), 1));
}

std::uint32_t SceneRays::occluded(const glm::dvec3& a, std::span<const glm::dvec3> b) const {
  static_assert(kTogether == 16);
  if (b.size() <= 4) return impl_->occluded<4, RTCRay4>(rtcOccluded4, a, b);
  if (b.size() <= 8) return impl_->occluded<8, RTCRay8>(rtcOccluded8, a, b);
  return impl_->occluded<16, RTCRay16>(rtcOccluded16, a, b);
}

bool SceneRays::meetsAny(const glm::dvec3& origin, const glm::dvec3& direction) const {
  return impl_->meetsAny(rayOf(impl_->scale * origin, direction, INFINITY));
}

glm::dvec3 SceneRays::lifted(const glm::dvec3& point, const glm::dvec3& normal) const {
  return point + lift() * normal;
}

double SceneRays::lift() const { return kLift / impl_->scale; }

const SceneRays::Triangle& SceneRays::triangle(std::uint32_t t) const { return impl_->triangles[t]; }

std::size_t SceneRays::triangleCount() const { return impl_->triangles.size(); }

}  // namespace unshot
