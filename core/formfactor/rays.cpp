// Lambert factor times shadow rays: K_vq is the exact Lambert factor of receiver point v and patch q times
// the share of it that rays through the true geometry find visible.
//
// As many rays as the patch is wide as seen from the point: one for a distant patch, for the error of the
// mesh hides what more would show; each weighs by its own kernel, and those that end below the point's
// horizon are left out. Patches with a good share of the scene's emission are looked at from end to end:
// where sixteen rays agree the exact factor counts whole or not at all, else it is the penumbra, with 64
// rays.
//
// Known error: occluders that slip between the rays; a shadow's edge lies where the sample of a patch says,
// a radius of the patch beside the truth at most.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "base/cosine_direction.h"
#include "base/random.h"
#include "formfactor/emitter_share.h"
#include "formfactor/methods.h"
#include "formfactor/pointwise.h"
#include "formfactor/shadow_rays.h"
#include "mesh/mesh_rays.h"

namespace unshot {
namespace {

// Radius of a patch over its distance, above which it takes 4 or 16 rays.
constexpr double kWide = 0.4, kVeryWide = 1.2;
// The levels of samples: 1, 4, 16, 64.
constexpr std::size_t kLevels = 4;
// How far from the corner towards the middle a ray goes that looks for a corner.
constexpr double kInset = 1e-3;
// Times SceneRays::lift: heights that rays tell from none.
constexpr double kTold = 10;
// Rays that find what escapes of a patch's light: a grid of strata, this many along each side.
constexpr int kEscapeStrata = 12;

class ShadowRays final : public Visibility {
 public:
  ShadowRays(const Mesh& mesh, std::shared_ptr<const PatchPolygons> polygons, std::uint64_t seed)
      : mesh_(mesh), polygons_(std::move(polygons)), rays_(mesh), seed_(seed), samples_(mesh.patch_count) {
    const EmitterShare share(mesh);
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q)
      large_.push_back(mesh.emits(q) && share.isLarge(mesh.sides[mesh.patch_side[q]], mesh.patch_area[q]));
  }

  double seen(const ReceiverView& from, std::uint32_t q) override {
    const glm::dvec3 eye = rays_.rays().lifted(from.position, from.normal);
    if (large_[q]) return emitterSeen(from, eye, q);
    const double distance = glm::length(polygons_->middle(q) - from.position);
    const double width = polygons_->radius(q) / std::max(distance, 1e-300);
    return share(from, eye, q, width > kVeryWide ? 2 : width > kWide ? 1 : 0);
  }

  double escaping(std::uint32_t q) override {
    const Side& side = mesh_.sides[mesh_.patch_side[q]];
    const std::vector<glm::dvec3>& from = samplesOf(q, 2);
    std::uint64_t state = mixBits(seed_ ^ q);
    const auto draw = [&] { return unitInterval(state = mixBits(state)); };
    int missed = 0;
    for (int i = 0; i < kEscapeStrata; ++i) {
      for (int j = 0; j < kEscapeStrata; ++j) {
        const double u = (i + draw()) / kEscapeStrata, v = (j + draw()) / kEscapeStrata;
        const glm::dvec3 direction = cosineDirection(side.normal, u, v);
        const std::size_t k = static_cast<std::size_t>(7 * i + j) % from.size();
        missed += !rays_.intersect(rays_.rays().lifted(from[k], side.normal), direction);
      }
    }
    return missed / double{kEscapeStrata * kEscapeStrata};
  }

 private:
  // The share that samples of this level find visible.
  double share(const ReceiverView& from, const glm::dvec3& eye, std::uint32_t q, std::size_t level) {
    const glm::dvec3& normal = mesh_.sides[mesh_.patch_side[q]].normal;
    double all = 0, visible = 0;
    const std::span<const glm::dvec3> samples = samplesOf(q, level);
    for (std::size_t first = 0; first < samples.size(); first += SceneRays::kTogether) {
      std::array<glm::dvec3, SceneRays::kTogether> ends;
      std::array<double, SceneRays::kTogether> kernels;
      std::size_t count = 0;
      for (const glm::dvec3& sample :
           samples.subspan(first, std::min(SceneRays::kTogether, samples.size() - first))) {
        const glm::dvec3 to = sample - from.position;
        const double square = glm::dot(to, to), near = glm::dot(to, from.normal), far = -glm::dot(to, normal);
        if (near <= 0 || far <= 0) continue;  // below the horizon: not hidden, not there
        all += kernels[count] = near * far / (square * square);
        ends[count++] = rays_.rays().lifted(sample, normal);
      }
      const std::uint32_t hidden = occluded(eye, {ends.data(), count});
      for (std::size_t k = 0; k < count; ++k) visible += hidden >> k & 1 ? 0 : kernels[k];
    }
    if (all > 0) return visible / all;
    if (level + 1 < kLevels) return share(from, eye, q, level + 1);
    // What is above the horizon lies beyond all samples, near one corner: so little of it that rays can not
    // tell it from what it touches does not count.
    const PatchPolygons::Corner corner = polygons_->highest(q, from.normal);
    const double height = glm::dot(corner.at - from.position, from.normal),
                 inside = glm::dot(corner.inside - from.position, from.normal);
    if (height < kTold * rays_.rays().lift()) return 0;
    const double inset = inside < 0 ? std::min(kInset, height / (2 * (height - inside))) : kInset;
    const glm::dvec3 near_corner = corner.at + inset * (corner.inside - corner.at);
    return rays_.rays().occluded(eye, rays_.rays().lifted(near_corner, normal)) ? 0 : 1;
  }

  std::uint32_t occluded(const glm::dvec3& eye, std::span<const glm::dvec3> ends) const {
    if (ends.size() > 1) return rays_.rays().occluded(eye, ends);
    return !ends.empty() && rays_.rays().occluded(eye, ends[0]);
  }

  double emitterSeen(const ReceiverView& from, const glm::dvec3& eye, std::uint32_t q) {
    const double few = share(from, eye, q, 2);
    return few == 0 || few == 1 ? few : share(from, eye, q, kLevels - 1);
  }

  const std::vector<glm::dvec3>& samplesOf(std::uint32_t q, std::size_t level) {
    std::vector<glm::dvec3>& out = samples_[q][level];
    if (out.empty()) polygons_->spread(q, 1u << (2 * level), out);
    return out;
  }

  const Mesh& mesh_;
  std::shared_ptr<const PatchPolygons> polygons_;
  MeshRays rays_;
  std::uint64_t seed_;
  std::vector<char> large_;  // one per patch: it emits so much that the edges of its shadows show
  std::vector<std::array<std::vector<glm::dvec3>, kLevels>> samples_;
};

}  // namespace

std::unique_ptr<Visibility> makeShadowRays(const Mesh& mesh, std::shared_ptr<const PatchPolygons> polygons,
                                           std::uint64_t seed) {
  return std::make_unique<ShadowRays>(mesh, std::move(polygons), seed);
}

std::unique_ptr<FormFactorMethod> makeRays(const FormFactorSetup& setup) {
  auto polygons = std::make_shared<const PatchPolygons>(*setup.mesh, setup.cancel);
  auto visibility = makeShadowRays(*setup.mesh, polygons, setup.seed);
  return std::make_unique<Pointwise>(setup, std::move(polygons), std::move(visibility));
}

}  // namespace unshot
