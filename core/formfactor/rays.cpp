// Lambert factor times shadow rays: K_vq is the Lambert factor of receiver point v and patch q (pointwise.h)
// times the share of it that rays through the true geometry find visible.
//
// As many rays as the patch is wide as seen from the point: one for a distant patch, for the error of the
// mesh hides what more would show; each weighs by its own kernel, and those that end below the point's
// horizon are left out. Patches with a good share of the scene's emission are looked at from end to end:
// where eight rays agree (sixteen, to what is no parallelogram) the exact factor counts whole or not at all,
// else it is the penumbra, with 25 rays and the edges of the shadow found between them. Of an emitter that is
// wider than it is away, most samples lie where it hardly counts: where one is hidden it is taken apart until
// each part is all visible, all hidden, small as seen from the point or brings little, and each part has five
// rays and an exact factor of its own.
//
// Known error: occluders and openings that slip between the rays (0.1 rad for an emitter taken apart); a
// shadow's edge lies where the sample of a patch says, a radius of the patch beside the truth at most.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <span>

#include "base/cosine_direction.h"
#include "base/random.h"
#include "formfactor/emitter_share.h"
#include "formfactor/methods.h"
#include "formfactor/pointwise.h"
#include "formfactor/polygon_factor.h"
#include "formfactor/shadow_rays.h"
#include "mesh/mesh_rays.h"

namespace unshot {
namespace {

// Radius of a patch over its distance, above which it takes 4 or 16 rays.
constexpr double kWide = 0.4, kVeryWide = 1.2;
// An emitter is taken apart from where its radius is so many times the distance to its plane, and it is
// nearer than so many radii.
constexpr double kFlat = 1, kNear = 2;
// Parts are looked at from where they are so wide, and taken apart further where only some of what is looked
// at is visible, until they are so narrow, bring such a share of the whole or have been halved so many times.
constexpr double kPartLook = 0.2, kPartWidth = 0.12, kPartShare = 0.001;
constexpr int kMostHalvings = 16;
// What is looked at: the middle, and points this share of the way there from the corners.
constexpr double kPartInset = 0.1;
// Where rays to an emitter begin and end: so far from its edges, of the way across.
constexpr double kRingInset = 0.02;
// And where they go first, from corner to corner: near the corners, and in four other columns and rows.
constexpr std::array<glm::dvec2, 8> kFirstLooks{{{kRingInset, kRingInset},
                                                 {1 - kRingInset, kRingInset},
                                                 {1 - kRingInset, 1 - kRingInset},
                                                 {kRingInset, 1 - kRingInset},
                                                 {0.36, 0.21},
                                                 {0.79, 0.36},
                                                 {0.64, 0.79},
                                                 {0.21, 0.64}}};
// Rows of rays to an emitter that is partly seen, as many in each, and how often the way between two of a row
// is halved where one is hidden.
constexpr std::size_t kRows = 5;
constexpr int kHalvingsOfEdges = 3;
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
      : mesh_(mesh),
        polygons_(std::move(polygons)),
        rays_(std::make_shared<const MeshRays>(mesh)),
        seed_(seed),
        samples_(mesh.patch_count) {
    const EmitterShare share(mesh);
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q)
      large_.push_back(mesh.emits(q) && share.isLarge(mesh.sides[mesh.patch_side[q]], mesh.patch_area[q]));
  }

  // Where one ray decides, those to all points begin in the middle of the patch and go together.
  void seenFrom(std::span<const ReceiverView* const> points, std::uint32_t q,
                std::span<double> shares) override {
    if (large_[q]) return Visibility::seenFrom(points, q, shares);
    const glm::dvec3& normal = mesh_.sides[mesh_.patch_side[q]].normal;
    const glm::dvec3 sample = samplesOf(q, 0)[0], start = rays_->rays().lifted(sample, normal);
    std::array<glm::dvec3, SceneRays::kTogether> ends;
    std::array<std::size_t, SceneRays::kTogether> number;
    std::size_t count = 0;
    const auto decide = [&] {
      const std::uint32_t hidden = occluded(start, {ends.data(), count});
      for (std::size_t k = 0; k < count; ++k) shares[number[k]] = hidden >> k & 1 ? 0 : 1;
      count = 0;
    };
    for (std::size_t k = 0; k < points.size(); ++k) {
      const ReceiverView& from = *points[k];
      const glm::dvec3 to = sample - from.position;
      if (isWideEmitter(from, q) || levelFor(from, q) > 0 || glm::dot(to, from.normal) <= 0 ||
          glm::dot(to, normal) >= 0) {
        shares[k] = seen(from, q);
        continue;
      }
      number[count] = k;
      ends[count++] = rays_->rays().lifted(from.position, from.normal);
      if (count == ends.size()) decide();
    }
    decide();
  }

  double seen(const ReceiverView& from, std::uint32_t q) override {
    const glm::dvec3 eye = rays_->rays().lifted(from.position, from.normal);
    if (isWideEmitter(from, q)) return seenInParts(from, eye, q);
    if (large_[q]) return emitterSeen(from, eye, q);
    return share(from, eye, q, levelFor(from, q));
  }

  std::unique_ptr<Visibility> another() const override { return std::make_unique<ShadowRays>(*this); }

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
        missed += !rays_->rays().meetsAny(rays_->rays().lifted(from[k], side.normal), direction);
      }
    }
    return missed / double{kEscapeStrata * kEscapeStrata};
  }

 private:
  // Whether so much of it is seen at a flat angle that samples do not stand for it.
  bool isWideEmitter(const ReceiverView& from, std::uint32_t q) const {
    const double radius = polygons_->radius(q);
    return mesh_.emits(q) && glm::length(polygons_->middle(q) - from.position) < kNear * radius &&
           glm::dot(from.position - polygons_->parts(q)[0].centre(),
                    mesh_.sides[mesh_.patch_side[q]].normal) < radius / kFlat;
  }

  std::size_t levelFor(const ReceiverView& from, std::uint32_t q) const {
    const double width =
        polygons_->radius(q) / std::max(glm::length(polygons_->middle(q) - from.position), 1e-300);
    return width > kVeryWide ? 2 : width > kWide ? 1 : 0;
  }

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
        ends[count++] = rays_->rays().lifted(sample, normal);
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
    if (height < kTold * rays_->rays().lift()) return 0;
    const double inset = inside < 0 ? std::min(kInset, height / (2 * (height - inside))) : kInset;
    const glm::dvec3 near_corner = corner.at + inset * (corner.inside - corner.at);
    return rays_->rays().occluded(eye, rays_->rays().lifted(near_corner, normal)) ? 0 : 1;
  }

  std::uint32_t occluded(const glm::dvec3& eye, std::span<const glm::dvec3> ends) const {
    return ends.empty() ? 0 : rays_->occluded(eye, ends);
  }

  double emitterSeen(const ReceiverView& from, const glm::dvec3& eye, std::uint32_t q) {
    const std::span<const FactorPolygon> parts = polygons_->parts(q);
    if (parts.size() != 1 || !parts[0].isParallelogram()) {
      const double few = share(from, eye, q, 2);
      return few == 0 || few == 1 ? few : share(from, eye, q, kLevels - 1);
    }
    const std::vector<glm::dvec3>& ring = parts[0].corners();
    const std::optional<double> few = firstLook(from, eye, q, ring);
    if (!few) return share(from, eye, q, 2);
    return *few == 0 || *few == 1 ? *few : shareAcrossEdges(from, eye, q, ring);
  }

  // A place on a parallelogram, from corner to corner.
  static glm::dvec3 within(const std::vector<glm::dvec3>& ring, double u, double v) {
    return ring[0] + u * (ring[1] - ring[0]) + v * (ring[3] - ring[0]);
  }

  // The share of a parallelogram that is visible: by a grid of rays and, between those of a row, the places
  // where what is seen ends, found by halving. Rows are as long as a shadow with straight edges leaves them;
  // they run the way that crosses more of its edges.
  double shareAcrossEdges(const ReceiverView& from, const glm::dvec3& eye, std::uint32_t q,
                          const std::vector<glm::dvec3>& ring) {
    constexpr std::size_t n = kRows;
    const glm::dvec3& normal = mesh_.sides[mesh_.patch_side[q]].normal;
    const auto along = [](std::size_t place, double further = 0) {
      return kRingInset + (1 - 2 * kRingInset) * (static_cast<double>(place) + further) / (n - 1);
    };
    std::array<double, n * n> kernel{};
    std::array<char, n * n> seen{};
    std::array<glm::dvec3, SceneRays::kTogether> ends;
    std::array<std::size_t, SceneRays::kTogether> number;
    std::size_t count = 0;
    const auto look = [&](auto&& found) {
      const std::uint32_t hidden = occluded(eye, {ends.data(), count});
      for (std::size_t k = 0; k < count; ++k) found(number[k], (hidden >> k & 1) == 0);
      count = 0;
    };
    const auto mark = [&](std::size_t k, bool visible) { seen[k] = visible; };
    for (std::size_t k = 0; k < n * n; ++k) {
      const glm::dvec3 at = within(ring, along(k % n), along(k / n)), to = at - from.position;
      const double square = glm::dot(to, to), near = glm::dot(to, from.normal), far = -glm::dot(to, normal);
      if (near <= 0 || far <= 0) continue;
      kernel[k] = near * far / (square * square);
      number[count] = k;
      ends[count++] = rays_->rays().lifted(at, normal);
      if (count == ends.size()) look(mark);
    }
    look(mark);
    const auto isEdge = [&](std::size_t k, std::size_t next) {
      return kernel[k] > 0 && kernel[next] > 0 && seen[k] != seen[next];
    };
    std::size_t across_u = 0, across_v = 0;
    for (std::size_t k = 0; k < n * n; ++k) {
      across_u += k % n + 1 < n && isEdge(k, k + 1);
      across_v += k / n + 1 < n && isEdge(k, k + n);
    }
    const std::size_t step = across_u >= across_v ? 1 : n, rows = n / step;
    edges_.clear();
    double all = 0, visible = 0;
    for (std::size_t row = 0; row < n; ++row) {
      const double weight = row == 0 || row + 1 == n ? 0.5 : 1;  // trapezoidal rule
      for (std::size_t i = 0; i + 1 < n; ++i) {
        const std::size_t k = row * rows + i * step, next = k + step;
        const double whole = weight * (kernel[k] + kernel[next]) / 2;
        all += whole;
        if (isEdge(k, next)) {
          edges_.push_back({k, weight});
        } else if (kernel[k] > 0 ? seen[k] : seen[next]) {
          visible += whole;
        }
      }
    }
    if (!(all > 0)) return share(from, eye, q, 2);
    for (int halving = 0; halving < kHalvingsOfEdges; ++halving) {
      const auto narrow = [&](std::size_t e, bool visible_there) {
        ShadowEdge& edge = edges_[e];
        (visible_there == static_cast<bool>(seen[edge.k]) ? edge.low : edge.high) = edge.middle();
      };
      for (std::size_t e = 0; e < edges_.size(); ++e) {
        const std::size_t k = edges_[e].k;
        const double u = along(k % n, step == 1 ? edges_[e].middle() : 0),
                     v = along(k / n, step == 1 ? 0 : edges_[e].middle());
        number[count] = e;
        ends[count++] = rays_->rays().lifted(within(ring, u, v), normal);
        if (count == ends.size()) look(narrow);
      }
      look(narrow);
    }
    for (const ShadowEdge& edge : edges_) {
      const double t = edge.middle(), a = kernel[edge.k], b = kernel[edge.k + step];
      const double before = t * (a + t * (b - a) / 2);
      visible += edge.weight * (seen[edge.k] ? before : (a + b) / 2 - before);
    }
    return std::clamp(visible / all, 0.0, 1.0);
  }

  // The share of kFirstLooks that is visible; nothing where all are below the horizon.
  std::optional<double> firstLook(const ReceiverView& from, const glm::dvec3& eye, std::uint32_t q,
                                  const std::vector<glm::dvec3>& ring) const {
    const glm::dvec3& normal = mesh_.sides[mesh_.patch_side[q]].normal;
    std::array<glm::dvec3, kFirstLooks.size()> ends;
    std::size_t count = 0;
    for (const glm::dvec2& at : kFirstLooks) {
      const glm::dvec3 end = within(ring, at.x, at.y);
      if (glm::dot(end - from.position, from.normal) > 0) ends[count++] = rays_->rays().lifted(end, normal);
    }
    if (count == 0) return std::nullopt;
    const std::uint32_t hidden = occluded(eye, {ends.data(), count});
    return 1 - std::popcount(hidden) / static_cast<double>(count);
  }

  double seenInParts(const ReceiverView& from, const glm::dvec3& eye, std::uint32_t q) {
    const double whole = polygons_->factor(q, from.position, from.normal, scratch_);
    if (whole <= 0) return 0;
    if (share(from, eye, q, 2) == 1) return 1;
    double visible = 0;
    for (const FactorPolygon& part : polygons_->parts(q)) {
      const std::vector<glm::dvec3>& ring = part.corners();
      if (ring.size() == 4) {
        visible += visiblePart(from, eye, q, {ring[0], ring[1], ring[2], ring[3]}, kPartShare * whole, 0);
        continue;
      }
      for (std::size_t k = 2; k < ring.size(); ++k)
        visible += visiblePart(from, eye, q, {ring[0], ring[k - 1], ring[k], ring[k]}, kPartShare * whole, 0);
    }
    return std::clamp(visible / whole, 0.0, 1.0);
  }

  // The factor of what is visible of a quadrilateral of patch q; a triangle has its last corner twice.
  double visiblePart(const ReceiverView& from, const glm::dvec3& eye, std::uint32_t q,
                     const std::array<glm::dvec3, 4>& ring, double negligible, int halvings) {
    const double factor = std::max(pointToPolygonFactor(from.position, from.normal, ring, scratch_), 0.0);
    if (factor == 0) return 0;
    const glm::dvec3 centre = (ring[0] + ring[1] + ring[2] + ring[3]) / 4.0;
    double radius = 0;
    for (const glm::dvec3& corner : ring) radius = std::max(radius, glm::length(corner - centre));
    const double width = radius / std::max(glm::length(centre - from.position), 1e-300);
    const bool divisible = factor > negligible && halvings < kMostHalvings;
    if (width <= kPartLook || !divisible) {
      const double visible = visibleShare(from, eye, q, ring, centre);
      if (visible == 0 || visible == 1 || width <= kPartWidth || !divisible) return factor * visible;
    }
    // Halved across the longer pair of sides.
    const bool along = glm::length(ring[1] - ring[0]) + glm::length(ring[2] - ring[3]) >
                       glm::length(ring[3] - ring[0]) + glm::length(ring[2] - ring[1]);
    const std::array<glm::dvec3, 4> turned =
        along ? ring : std::array<glm::dvec3, 4>{ring[1], ring[2], ring[3], ring[0]};
    const glm::dvec3 a = (turned[0] + turned[1]) / 2.0, b = (turned[2] + turned[3]) / 2.0;
    return visiblePart(from, eye, q, {turned[0], a, b, turned[3]}, negligible, halvings + 1) +
           visiblePart(from, eye, q, {a, turned[1], turned[2], b}, negligible, halvings + 1);
  }

  // By rays to its middle and near its corners, as far as they are above the horizon; else to its highest
  // corner.
  double visibleShare(const ReceiverView& from, const glm::dvec3& eye, std::uint32_t q,
                      const std::array<glm::dvec3, 4>& ring, const glm::dvec3& centre) const {
    const glm::dvec3& normal = mesh_.sides[mesh_.patch_side[q]].normal;
    const auto height = [&](const glm::dvec3& p) { return glm::dot(p - from.position, from.normal); };
    std::array<glm::dvec3, 5> ends;
    std::size_t count = 0;
    const auto add = [&](const glm::dvec3& at) {
      if (height(at) > 0) ends[count++] = rays_->rays().lifted(at, normal);
    };
    add(centre);
    const std::size_t corners = ring[2] == ring[3] ? 3 : 4;
    for (std::size_t k = 0; k < corners; ++k) add(glm::mix(ring[k], centre, kPartInset));
    if (count == 0) {
      const glm::dvec3& top = *std::max_element(
          ring.begin(), ring.end(), [&](const auto& x, const auto& y) { return height(x) < height(y); });
      if (height(top) <= kTold * rays_->rays().lift()) return 0;
      add(glm::mix(centre, top, (height(top) / 2 - height(centre)) / (height(top) - height(centre))));
    }
    if (count == 0) return 0;
    const std::uint32_t hidden = occluded(eye, {ends.data(), count});
    return 1 - std::popcount(hidden) / static_cast<double>(count);
  }

  const std::vector<glm::dvec3>& samplesOf(std::uint32_t q, std::size_t level) {
    std::vector<glm::dvec3>& out = samples_[q][level];
    if (out.empty()) polygons_->spread(q, 1u << (2 * level), out);
    return out;
  }

  const Mesh& mesh_;
  std::shared_ptr<const PatchPolygons> polygons_;
  std::shared_ptr<const MeshRays> rays_;
  std::uint64_t seed_;
  std::vector<char> large_;  // one per patch: it emits so much that the edges of its shadows show
  std::vector<std::array<std::vector<glm::dvec3>, kLevels>> samples_;
  // Where what is seen along a row of an emitter ends, or begins.
  struct ShadowEdge {
    std::size_t k;             // between place k and the next of the row
    double weight;             // of the row
    double low = 0, high = 1;  // of the way there
    double middle() const { return (low + high) / 2; }
  };
  std::vector<ShadowEdge> edges_;
  std::vector<glm::dvec3> scratch_;
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
