#include "session/sent_light.h"

#include <algorithm>

namespace unshot {

SentLight sourcesOf(const Mesh& mesh, const RadiosityState& state, bool with_unshot) {
  SentLight out;
  out.emission = state.emission();
  if (!with_unshot)
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q) out.emission[q] -= state.emissionLeft(q);
  // The source behind the patches.
  if (state.patchCount() > mesh.patch_count)
    out.sky = with_unshot ? state.emission()[mesh.patch_count] : state.shot()[mesh.patch_count];
  return out;
}

SentLight lightOf(const Mesh& mesh, const RadiosityState& state, const MeshField& irradiance,
                  bool with_unshot) {
  SentLight out = sourcesOf(mesh, state, with_unshot);
  out.light.resize(mesh.element_count);
  for (std::uint32_t e = 0; e < out.light.size(); ++e) {
    const std::uint32_t q = mesh.element_patch[e];
    out.light[e] = state.reflectance()[q] * glm::dvec3(irradiance.elements[e]);
    if (!with_unshot) out.light[e] -= state.unshot()[q] - state.emissionLeft(q);
  }
  return out;
}

glm::dvec3 irradianceOf(const Gather& gather, const SentLight& sent, const Mesh& mesh) {
  glm::dvec3 sum(0.0);
  for (const std::uint32_t e : gather.rays) {
    if (e == kToSky) {
      sum += sent.sky;
    } else if (e != kNone) {
      sum += sent.light[e];
    }
  }
  if (!gather.rays.empty()) sum /= static_cast<double>(gather.rays.size());
  for (const Gather::Light& light : gather.lights)
    sum += static_cast<double>(light.weight) * sent.emission[light.patch];
  for (const Gather::Share& s : gather.shares)
    sum += static_cast<double>(s.weight) *
           (sent.light[s.element] + sent.emission[mesh.element_patch[s.element]]);
  return sum + static_cast<double>(gather.sky) * sent.sky;
}

glm::dvec3 straightOf(const Gather& gather, const SentLight& sent) {
  const auto escaped = std::count(gather.rays.begin(), gather.rays.end(), kToSky);
  glm::dvec3 sum(0.0);
  if (escaped > 0) sum = static_cast<double>(escaped) / static_cast<double>(gather.rays.size()) * sent.sky;
  for (const Gather::Light& light : gather.lights)
    sum += static_cast<double>(light.weight) * sent.emission[light.patch];
  return sum;
}

}  // namespace unshot
