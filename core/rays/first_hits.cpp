#include "rays/first_hits.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "rays/unit_scale.h"

namespace unshot {

struct FirstHits::Impl {
  float scale = 1;  // of what Embree sees
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

FirstHits::FirstHits(std::span<const glm::vec3> positions, std::span<const std::uint32_t> corners,
                     const CancelToken& cancel)
    : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice("threads=1");
  if (!impl_->device)
    throw Error(ErrorKind::kEnvironment, "Embree gives no device", {}, "reinstalling libembree3");
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size()));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), corners.size() / 3));
  if (!vertices || !indices) {
    rtcReleaseGeometry(geometry);
    throw Error(ErrorKind::kEnvironment, "there is no memory for rays against the scene");
  }
  impl_->scale = unitScale(positions);
  std::transform(positions.begin(), positions.end(), vertices,
                 [&](const glm::vec3& p) { return impl_->scale * p; });
  std::copy(corners.begin(), corners.end(), indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  CancelToken asked = cancel;
  rtcSetSceneProgressMonitorFunction(
      impl_->scene, [](void* token, double) { return !static_cast<const CancelToken*>(token)->requested(); },
      &asked);
  rtcCommitScene(impl_->scene);
  cancel.check();
  rtcSetSceneProgressMonitorFunction(impl_->scene, nullptr, nullptr);
}

FirstHits::FirstHits(FirstHits&&) noexcept = default;
FirstHits::~FirstHits() = default;

void FirstHits::trace(const glm::vec3& origin, float near_distance, std::span<const glm::vec3> directions,
                      std::span<Hit> hits) const {
  constexpr std::size_t kPacket = 16;
  const glm::vec3 from = impl_->scale * origin;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t first = 0; first < directions.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, directions.size() - first);
    alignas(64) int valid[kPacket];
    alignas(64) RTCRayHit16 rays;
    for (std::size_t k = 0; k < kPacket; ++k) {
      valid[k] = k < count ? -1 : 0;
      const glm::vec3 d = directions[first + std::min(k, count - 1)];
      rays.ray.org_x[k] = from.x;
      rays.ray.org_y[k] = from.y;
      rays.ray.org_z[k] = from.z;
      rays.ray.dir_x[k] = d.x;
      rays.ray.dir_y[k] = d.y;
      rays.ray.dir_z[k] = d.z;
      rays.ray.tnear[k] = impl_->scale * near_distance;
      rays.ray.tfar[k] = INFINITY;
      rays.ray.time[k] = 0;
      rays.ray.mask[k] = ~0u;
      rays.ray.id[k] = 0;
      rays.ray.flags[k] = 0;
      rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, impl_->scene, &context, &rays);
    for (std::size_t k = 0; k < count; ++k) {
      hits[first + k] = {rays.ray.tfar[k] / impl_->scale,
                         rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID ? 0xffffffffu : rays.hit.primID[k],
                         rays.hit.u[k], rays.hit.v[k]};
    }
  }
}

}  // namespace unshot
