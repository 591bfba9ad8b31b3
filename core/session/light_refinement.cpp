#include "session/light_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "base/random.h"
#include "formfactor/direct_light.h"
#include "mesh/refine.h"
#include "session/gap_refinement.h"

namespace unshot {
namespace {

// Points look from this share of a cell off the borders of a surface, where walls meet.
constexpr double kInset = 0.02;
// And this share of the way to the centre of a polygon off its corners, where blocks stand.
constexpr double kPolygonInset = 0.1;
// Of a rectangle's area: rounding.
constexpr double kAreaMargin = 1e-9;
// Of the error asked for: how far light in the middle of a part may be from what interpolation makes of it,
// over the mean. Few parts are as wrong as that, few of their points, and what is shown is fitted between
// them (linear_fit.h). On the Cornell box at --error 0.01, 600 points: 14 leaves 0.90 %, 22 0.98 %, for a
// fifth less time.
constexpr double kWorst = 18;
// Of that: what an emitter brings at least to be looked for behind others.
constexpr double kNegligible = 0.02;
// Emitting patches (of the uniform mesh) looked at, over all points: some seconds here, and about as long or,
// with narrow gaps, some times as long afterwards by the form factors.
constexpr double kMostLooks = 1e7;
// Vertices of an element, about.
constexpr double kVertices = 2;
// Elements of the mesh for each of the base, in the mean: there are as many vertices to display, and light
// from elsewhere is no better known.
constexpr double kMostParts = 8;

// Asked of each part of a cell: whether light in it is not what interpolation makes of that at its corners.
class LightQuestion {
 public:
  // `emitters`: the same surfaces in patches that are no finer than need be.
  LightQuestion(const Mesh& base, const Mesh& emitters, const LightRefinement& options,
                const CancelToken& cancel)
      : base_(base),
        options_(options),
        cancel_(cancel),
        light_(emitters, options.occlusion, options.seed),
        elements_(base.element_count) {
    if (looksFor(base.element_count) > kMostLooks) return;
    // Over what reflects: on the rest light need not be known.
    glm::dvec3 sum(0.0);
    double area = 0;
    for (std::uint32_t e = 0; e < base.element_count; ++e) {
      cancel.check();
      const Side& side = base.sides[base.element_side[e]];
      if (side.reflectance == glm::dvec3(0.0)) continue;
      const Surface& surface = base.surfaces[side.surface];
      const ElementShape& shape = base.shapes[surface.elements.first + e - side.first_element];
      area += shape.area;
      sum += shape.area * at(base.element_side[e], surface.chart(shape.centre));
    }
    if (area > 0) tolerance_ = kWorst * options.error * (sum.x + sum.y + sum.z) / area;
  }

  bool operator()(const CellPart& part) {
    cancel_.check();
    if (tolerance_ <= 0 || full_) return false;
    const Surface& surface = base_.surfaces[part.surface];
    bool split = false;
    for (const std::uint32_t side : surface.side)
      split = split || (side != kNone && base_.sides[side].reflectance != glm::dvec3(0.0) &&
                        differs(part, surface, side));
    if (split) elements_ += 3;
    full_ = static_cast<double>(elements_) > most() || looksFor(known_.size()) > kMostLooks;
    return split;
  }

  // Whether it ended before every part was asked for: then what lies behind would have less than its share.
  bool full() const { return full_; }
  // Again from the start.
  void restart() {
    elements_ = base_.element_count;
    full_ = false;
  }
  // The same, content with twice the difference; false where no more points can be looked at.
  bool relax() {
    tolerance_ *= 2;
    restart();
    return looksFor(known_.size()) <= kMostLooks;
  }

 private:
  // Elements: as many as are allowed, of the base about so many each, and no more than can be looked at.
  double most() const {
    const double looks = kMostLooks / kVertices / std::max(looksFor(1), 1.0);
    return std::max(
        std::min({static_cast<double>(options_.most_elements), kMostParts * base_.element_count, looks}),
        static_cast<double>(base_.element_count));
  }

  double looksFor(std::size_t points) const {
    return static_cast<double>(points) * static_cast<double>(light_.emitterCount());
  }

  static double size(const glm::dvec3& x) { return std::abs(x.x) + std::abs(x.y) + std::abs(x.z); }

  bool differs(const CellPart& part, const Surface& surface, std::uint32_t side) {
    const glm::dvec2 size = part.high - part.low;
    double area = 0;
    for (const ConvexPolygon& polygon : part.pieces) area += polygonArea(polygon);
    // What is small in area may be wrong by more.
    const double fineness = std::sqrt(base_.lit_area / base_.element_count / (size.x * size.y));
    const double tolerance = tolerance_ * std::max(1.0, fineness / 4);
    if (area > (1 - kAreaMargin) * size.x * size.y) return differsInRectangle(part, surface, side, tolerance);
    return std::any_of(part.pieces.begin(), part.pieces.end(), [&](const ConvexPolygon& polygon) {
      return differsInPolygon(polygon, side, tolerance);
    });
  }

  // Light in the middle of edges and of the whole, against the mean of that at the corners.
  bool differsInRectangle(const CellPart& part, const Surface& surface, std::uint32_t side,
                          double tolerance) {
    std::array<glm::dvec3, 9> light;
    const glm::dvec2 inset = kInset * surface.extent / glm::dvec2(surface.nu, surface.nv);
    for (std::size_t k = 0; k < 9; ++k) {
      const glm::dvec2 uv = part.low + (part.high - part.low) * glm::dvec2(k % 3, k / 3) / 2.0;
      light[k] = at(side, glm::clamp(uv, inset, surface.extent - inset));
    }
    const auto off = [&](std::size_t k, std::size_t a, std::size_t b) {
      return size(light[k] - (light[a] + light[b]) / 2.0) > tolerance;
    };
    return off(1, 0, 2) || off(3, 0, 6) || off(5, 2, 8) || off(7, 6, 8) ||
           size(light[4] - (light[0] + light[2] + light[6] + light[8]) / 4.0) > tolerance;
  }

  bool differsInPolygon(const ConvexPolygon& polygon, std::uint32_t side, double tolerance) {
    const glm::dvec2 centre = polygonCentroid(polygon);
    const auto inside = [&](const glm::dvec2& uv) { return uv + kPolygonInset * (centre - uv); };
    std::vector<glm::dvec3> corner;
    glm::dvec3 sum(0.0);
    for (const PieceCorner& c : polygon) sum += corner.emplace_back(at(side, inside(c.uv)));
    const glm::dvec3 inner = at(side, centre);
    if (size(inner - sum / static_cast<double>(polygon.size())) > tolerance) return true;
    // One that is small and has hardly any change from corner to corner is not looked at along its edges.
    const bool even = std::all_of(corner.begin(), corner.end(),
                                  [&](const glm::dvec3& light) { return size(light - inner) <= tolerance; });
    if (even && tolerance > tolerance_) return false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const std::size_t next = (k + 1) % polygon.size();
      const glm::dvec3 middle = at(side, inside((polygon[k].uv + polygon[next].uv) / 2.0));
      if (size(middle - (corner[k] + corner[next]) / 2.0) > tolerance) return true;
    }
    return false;
  }

  glm::dvec3 at(std::uint32_t side, const glm::dvec2& uv) {
    const Surface& surface = base_.surfaces[base_.sides[side].surface];
    const auto lattice = [&](int axis) {
      return static_cast<std::uint64_t>(std::llround(uv[axis] / surface.extent[axis] * (1 << 24)));
    };
    const std::uint64_t key = mixBits(mixBits(lattice(0) << 25 | lattice(1)) + side);
    const auto [found, made] = known_.try_emplace(key);
    if (made) found->second = light_.at(surface.point(uv), side, kNegligible * tolerance_);
    return found->second;
  }

  const Mesh& base_;
  const LightRefinement& options_;
  const CancelToken& cancel_;
  DirectLight light_;
  std::uint64_t elements_;
  bool full_ = false;
  double tolerance_ = 0;  // [W/m^2], channels summed; 0: nothing is asked for
  std::unordered_map<std::uint64_t, glm::dvec3> known_;
};

}  // namespace

std::shared_ptr<const Mesh> refineForLight(std::shared_ptr<const Mesh> uniform,
                                           const LightRefinement& options, const CancelToken& cancel) {
  const std::shared_ptr<const Mesh> base = refineInGaps(uniform, cancel);
  LightQuestion question(*base, options.emitters ? *options.emitters : *uniform, options, cancel);
  const auto split = [&](const CellPart& part) { return question(part); };
  if (!asksForAny(*base, split) && !question.full()) return base;
  question.restart();
  for (;;) {
    auto mesh = std::make_shared<Mesh>(refineMesh(base, split, cancel));
    if (!question.full()) return mesh->element_count > base->element_count ? mesh : base;
    if (!question.relax()) return base;
  }
}

}  // namespace unshot
