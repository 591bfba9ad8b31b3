// Ear clipping of one outline, best-shaped ear first.
//
// Source: G. H. Meisters, "Polygons have ears", 1975; D. Eberly, "Triangulation by ear clipping", 2002: only
// corners that are not convex can lie in an ear, and clipping an ear changes the state of its two neighbours
// alone, which makes the whole O(n r) for r such corners. Differences here: a corner within `tolerance` of
// the line through its neighbours is flat: it is never the tip of an ear and blocks like a reflex one, so
// that T-vertices stay corners of triangles with an area. Assumes an outline that touches itself at most
// (bridges to holes are fine). Others end too, with fewer or overlapping triangles. Known error: features
// thinner than 1e-11 of the outline's extent count as flat.
#include "scene/triangulate.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "base/cross.h"

namespace unshot {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Rounding of a chart's coordinates is about 1e-16 of its extent; five digits are left for how they came
/// about.
constexpr double kFlatness = 1e-11;

/// A later candidate has to be better by this factor: neither rounding nor the slight warp of a face that is
/// not quite planar decides, and near-ties are cut from the first corner on, as most programs do.
constexpr double kClearlyBetter = 1 + 1e-3;

/// How often all ears are looked at again when none is left: simple outlines need this never, rounding
/// rarely.
constexpr int kRescans = 8;

/// Twice the signed area of the triangle.
double orient(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) { return cross(b - a, c - a); }

double longestEdge(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
}

double extentOf(std::span<const glm::dvec2> outline) {
  glm::dvec2 low = outline[0], high = outline[0];
  for (const glm::dvec2& p : outline) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return std::max(high.x - low.x, high.y - low.y);
}

class EarClipper {
 public:
  explicit EarClipper(std::span<const glm::dvec2> outline)
      : points_(outline),
        tolerance_(kFlatness * extentOf(outline)),
        prev_(outline.size()),
        next_(outline.size()),
        height_(outline.size()),
        quality_(outline.size()),
        removed_(outline.size(), false),
        suspects_(outline.size()),
        remaining_(static_cast<std::uint32_t>(outline.size())) {
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      prev_[i] = (i + n - 1) % n;
      next_[i] = (i + 1) % n;
      suspects_[i] = i;
    }
  }

  std::vector<Triangle> run() {
    triangles_.reserve(points_.size() - 2);
    rescan();
    dropSpikes();
    int rescans_left = kRescans;
    while (remaining_ >= 3) {
      std::optional<std::uint32_t> tip = bestTip();
      if (!tip && rescans_left > 0) {
        --rescans_left;
        rescan();
        tip = bestTip();
        if (!tip) tip = bestForcedTip(true);
      }
      if (!tip) tip = bestForcedTip(false);
      if (tip) {
        triangles_.push_back({prev_[*tip], *tip, next_[*tip]});
        if (remaining_ == 3) break;
        remove(*tip);
      } else {
        remove(flattestCorner());
      }
      dropSpikes();
    }
    return std::move(triangles_);
  }

 private:
  const glm::dvec2& at(std::uint32_t i) const { return points_[i]; }

  bool coincide(std::uint32_t i, const glm::dvec2& p) const { return glm::distance(at(i), p) <= tolerance_; }

  /// Signed distance of the corner's triangle from being flat: its least height.
  void measure(std::uint32_t b) {
    const glm::dvec2 &pa = at(prev_[b]), &pb = at(b), &pc = at(next_[b]);
    const double longest = longestEdge(pa, pb, pc);
    height_[b] = longest > 0 ? orient(pa, pb, pc) / longest : 0.0;
  }

  /// Whether an edge at `q`, which lies on the ear's corner `p`, leaves it strictly between `from` and `to`.
  bool entersCone(std::uint32_t q, const glm::dvec2& from, const glm::dvec2& p, const glm::dvec2& to) const {
    const auto inside = [&](const glm::dvec2& r) {
      return orient(p, from, r) > tolerance_ * glm::distance(p, from) &&
             orient(p, r, to) > tolerance_ * glm::distance(p, to);
    };
    return inside(at(prev_[q])) || inside(at(next_[q]));
  }

  /// Whether corner `q` forbids the ear with tip `b`. A corner on the border counts unless `border_allowed`.
  bool blocks(std::uint32_t q, std::uint32_t b, bool border_allowed) const {
    const glm::dvec2 &pa = at(prev_[b]), &pb = at(b), &pc = at(next_[b]), &p = at(q);
    const double margin = border_allowed ? tolerance_ : -tolerance_;
    if (!(orient(pa, pb, p) >= margin * glm::distance(pa, pb))) return false;
    if (!(orient(pb, pc, p) >= margin * glm::distance(pb, pc))) return false;
    if (!(orient(pc, pa, p) >= margin * glm::distance(pc, pa))) return false;
    if (coincide(q, pb)) return entersCone(q, pc, pb, pa);
    if (coincide(q, pa)) return entersCone(q, pb, pa, pc);
    if (coincide(q, pc)) return entersCone(q, pa, pc, pb);
    return true;
  }

  bool isEar(std::uint32_t b, bool border_allowed) const {
    if (!(height_[b] > tolerance_)) return false;
    const glm::dvec2 &pa = at(prev_[b]), &pb = at(b), &pc = at(next_[b]);
    const glm::dvec2 low{std::min({pa.x, pb.x, pc.x}) - tolerance_,
                         std::min({pa.y, pb.y, pc.y}) - tolerance_};
    const glm::dvec2 high{std::max({pa.x, pb.x, pc.x}) + tolerance_,
                          std::max({pa.y, pb.y, pc.y}) + tolerance_};
    for (std::uint32_t q = next_[next_[b]]; q != prev_[b]; q = next_[q]) {
      const glm::dvec2& p = at(q);
      if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
      // A convex corner in the ear implies another that is not; one that coincides with a corner of the ear
      // has to be looked at all the same.
      const bool convex = height_[q] > tolerance_;
      if (convex && !coincide(q, pa) && !coincide(q, pb) && !coincide(q, pc)) continue;
      if (blocks(q, b, border_allowed)) return false;
    }
    return true;
  }

  /// 1 for an equilateral triangle, to 0 for a flat one.
  double shape(std::uint32_t b) const {
    const double longest = longestEdge(at(prev_[b]), at(b), at(next_[b]));
    return longest > 0 ? height_[b] / longest * 1.1547005383792515 : 0.0;
  }

  void assess(std::uint32_t b) { quality_[b] = isEar(b, false) ? shape(b) : -1.0; }

  void rescan() {
    std::uint32_t i = first_;
    do {
      measure(i);
      i = next_[i];
    } while (i != first_);
    do {
      assess(i);
      i = next_[i];
    } while (i != first_);
  }

  std::optional<std::uint32_t> bestTip() const {
    std::optional<std::uint32_t> best;
    double best_quality = 0.0;
    std::uint32_t i = first_;
    do {
      if (quality_[i] > best_quality * kClearlyBetter) {
        best_quality = quality_[i];
        best = i;
      }
      i = next_[i];
    } while (i != first_);
    return best;
  }

  /// For outlines that are not simple: the best convex corner whose triangle has no corner strictly inside
  /// (`checked`), or simply the best.
  std::optional<std::uint32_t> bestForcedTip(bool checked) const {
    std::optional<std::uint32_t> best;
    double best_quality = 0.0;
    std::uint32_t i = first_;
    do {
      const double quality = height_[i] > tolerance_ ? shape(i) : 0.0;
      if (quality > best_quality && (!checked || isEar(i, true))) {
        best_quality = quality;
        best = i;
      }
      i = next_[i];
    } while (i != first_);
    return best;
  }

  std::uint32_t flattestCorner() const {
    std::uint32_t best = first_;
    for (std::uint32_t i = next_[first_]; i != first_; i = next_[i]) {
      if (std::abs(height_[i]) < std::abs(height_[best])) best = i;
    }
    return best;
  }

  void remove(std::uint32_t b) {
    const std::uint32_t a = prev_[b], c = next_[b];
    next_[a] = c;
    prev_[c] = a;
    if (first_ == b) first_ = c;
    --remaining_;
    if (remaining_ < 3) return;
    measure(a);
    measure(c);
    assess(a);
    assess(c);
    suspects_.push_back(a);
    suspects_.push_back(c);
    removed_[b] = true;
  }

  /// A corner on the one before it, or where the outline goes back on itself: it encloses nothing, yet
  /// triangles beside it would have an area.
  bool isSpike(std::uint32_t b) const {
    const glm::dvec2 &pa = at(prev_[b]), &pb = at(b), &pc = at(next_[b]);
    if (coincide(prev_[b], pb)) return true;
    return std::abs(height_[b]) <= tolerance_ && glm::dot(pa - pb, pc - pb) > 0;
  }

  /// Removes spikes among the corners that have new neighbours. A simple outline has none.
  void dropSpikes() {
    while (!suspects_.empty() && remaining_ >= 3) {
      const std::uint32_t b = suspects_.back();
      suspects_.pop_back();
      if (!removed_[b] && isSpike(b)) remove(b);
    }
  }

  std::span<const glm::dvec2> points_;
  double tolerance_;  ///< distances up to this are zero
  std::vector<std::uint32_t> prev_, next_;
  std::vector<double> height_;   ///< of each corner's triangle, negative where reflex
  std::vector<double> quality_;  ///< of each ear, -1 where the corner is none
  std::vector<bool> removed_;
  std::vector<std::uint32_t> suspects_;  ///< corners whose neighbours are new
  std::uint32_t first_ = 0;
  std::uint32_t remaining_;
  std::vector<Triangle> triangles_;
};

/// Least height of a triangle over its longest edge; not positive where it is flat or turned over.
double shapeOf(std::span<const glm::dvec2> outline, const Triangle& t, double tolerance) {
  const glm::dvec2 &a = outline[t[0]], &b = outline[t[1]], &c = outline[t[2]];
  const double longest = longestEdge(a, b, c);
  const double height = longest > 0 ? orient(a, b, c) / longest : 0.0;
  return height > tolerance ? height / longest : 0.0;
}

/// Two triangles along the diagonal that gives the better worst triangle; nothing where neither is inside.
std::vector<Triangle> splitQuad(std::span<const glm::dvec2> outline) {
  const double tolerance = kFlatness * extentOf(outline);
  const std::array<Triangle, 2> even{Triangle{0, 1, 2}, Triangle{0, 2, 3}};
  const std::array<Triangle, 2> odd{Triangle{0, 1, 3}, Triangle{1, 2, 3}};
  const auto worst = [&](const std::array<Triangle, 2>& pair) {
    return std::min(shapeOf(outline, pair[0], tolerance), shapeOf(outline, pair[1], tolerance));
  };
  const double even_quality = worst(even), odd_quality = worst(odd);
  if (!(even_quality > 0) && !(odd_quality > 0)) return {};
  const auto& best = odd_quality > even_quality * kClearlyBetter ? odd : even;
  return {best.begin(), best.end()};
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec2> outline) {
  if (outline.size() < 3) return {};
  if (outline.size() == 3) {
    const Triangle whole{0, 1, 2};
    if (!(shapeOf(outline, whole, kFlatness * extentOf(outline)) > 0)) return {};
    return {whole};
  }
  if (outline.size() == 4) {
    if (std::vector<Triangle> pair = splitQuad(outline); !pair.empty()) return pair;
  }
  return EarClipper(outline).run();
}

}  // namespace unshot
