#include "formfactor/direct_light.h"

#include "formfactor/shadow_rays.h"

namespace unshot {

DirectLight::DirectLight(const Mesh& mesh, bool occlusion, std::uint64_t seed)
    : mesh_(mesh), polygons_(std::make_shared<const PatchPolygons>(mesh)) {
  if (occlusion) visibility_ = makeShadowRays(mesh, polygons_, seed);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    if (mesh.emits(q)) emitters_.push_back(q);
  }
}

glm::dvec3 DirectLight::at(const glm::dvec3& position, std::uint32_t side, double negligible) {
  const ReceiverView from{position, mesh_.sides[side].normal, 1, side, kNone};
  glm::dvec3 sum(0.0);
  for (const std::uint32_t q : emitters_) {
    if (mesh_.sides[side].surface == polygons_->surface(q) || mesh_.inOtherRooms(side, q)) continue;
    const double factor = polygons_->quickFactor(q, position, from.normal, scratch_);
    if (factor == 0) continue;
    const glm::dvec3 light = factor * mesh_.sides[mesh_.patch_side[q]].emission;
    const bool counts = light.x + light.y + light.z > negligible;
    sum += visibility_ && counts ? visibility_->seen(from, q) * light : light;
  }
  return sum;
}

}  // namespace unshot
