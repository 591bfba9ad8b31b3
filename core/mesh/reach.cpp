#include "mesh/reach.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/cancel.h"
#include "mesh/shells.h"

namespace unshot {
namespace {

// A point off a side is so many weld distances away: beyond what counts as lying in its plane. A second one,
// nearer, tells what stands between.
constexpr double kOff = 4, kNear = 1;

// Of a surface over another one's plane.
std::pair<double, double> heights(const Mesh& mesh, std::uint32_t surface, const Surface& over) {
  double low = INFINITY, high = -INFINITY;
  const Range triangles = mesh.surfaces[surface].triangles;
  for (std::uint32_t t = triangles.first; t < triangles.end(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t].position) {
      const double height = glm::dot(mesh.positions[v] - over.origin, over.normal);
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  return {low, high};
}

// A touch has so many weld distances at least.
constexpr double kFew = 40;

/// Whether more than an end of the segment lies on one of the surface's polygons, or as near as `near`. What
/// only meets the rectangle around them, as facets around a corner do that are nearly in one plane, stands on
/// nothing.
bool liesOn(const Mesh& mesh, const Surface& surface, const ContactSegment& line, double near) {
  const double length = glm::distance(line.a, line.b);
  if (length <= kFew * near) return true;
  double covered = 0;  // over all polygons: each may hold but a short piece
  for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
    double first = 0, last = 1;  // of the way from a to b
    for (int k = 0; k < 3 && first < last; ++k) {
      const glm::dvec2 corner = mesh.triangles[t].uv[k], edge = mesh.triangles[t].uv[(k + 1) % 3] - corner;
      // Left of the edge is inside.
      const auto inside = [&](const glm::dvec2& p) {
        return edge.x * (p.y - corner.y) - edge.y * (p.x - corner.x) + near * glm::length(edge);
      };
      const double a = inside(line.a), b = inside(line.b);
      if (a < 0 && b < 0) last = first;
      if (a < 0 && b >= 0) first = std::max(first, a / (a - b));
      if (a >= 0 && b < 0) last = std::min(last, a / (a - b));
    }
    covered += std::max(last - first, 0.0) * length;
    if (covered > kFew * near) return true;
  }
  return false;
}

class Reach {
 public:
  Reach(const Mesh& mesh, const std::vector<SurfaceEdge>& edges, std::span<const Touch> touches,
        Shells& shells, double weld_distance)
      : shells_(shells),
        weld_distance_(weld_distance),
        stands_on_(2 * mesh.surfaces.size()),
        lit_(2 * mesh.surfaces.size(), 0),
        shell_lit_(lit_.size(), 0),
        shell_known_(lit_.size(), 0),
        shell_touched_(lit_.size(), 0),
        seen_(lit_.size()) {
    std::unordered_set<std::uint64_t> known;  // a surface may touch another one with many edges
    for (const Touch& t : touches) {
      if (!liesOn(mesh, mesh.surfaces[t.surface], t.line, kNear * weld_distance)) continue;
      for (std::uint32_t use = t.edge;
           use < edges.size() && edges[use].a == edges[t.edge].a && edges[use].b == edges[t.edge].b; ++use) {
        if (!known.insert(std::uint64_t{t.surface} << 32 | edges[use].surface).second) continue;
        const auto [low, high] = heights(mesh, edges[use].surface, mesh.surfaces[t.surface]);
        for (const std::uint32_t s : {t.surface, edges[use].surface})
          shell_touched_[shells.of(2 * s)] = shell_touched_[shells.of(2 * s + 1)] = 1;
        if (high > kOff * weld_distance) stands_on_[2 * t.surface].push_back(edges[use].surface);
        if (low < -kOff * weld_distance) stands_on_[2 * t.surface + 1].push_back(edges[use].surface);
      }
    }
  }

  /// Returns whether it can be told.
  bool findLight(std::span<const char> emits, const CancelToken& cancel) {
    // An emitter on which something stands shines wherever the rest of its shell is, and what stands on it.
    std::vector<char> shines(lit_.size(), 0);
    for (std::uint32_t side = 0; side < emits.size(); ++side) {
      cancel.check();
      if (!emits[side]) continue;
      if (!addPlaces(side)) return false;
      if (!isMixed(side)) continue;
      shines[shells_.of(side)] = 1;
      for (const std::uint32_t s : stands_on_[side])
        shines[shells_.of(2 * s)] = shines[shells_.of(2 * s + 1)] = 1;
    }
    for (std::uint32_t side = 0; side < lit_.size(); ++side) {
      shell_known_[shells_.of(side)] |= static_cast<char>(!isMixed(side));
      if (shines[shells_.of(side)] && !isMixed(side) && !addPlaces(side)) return false;
    }
    for (std::uint32_t side = 0; side < emits.size(); ++side) {
      if (emits[side] && isMixed(side) && !shell_known_[shells_.of(side)]) return false;
    }
    for (std::uint32_t side = 0; side < lit_.size(); ++side) {
      cancel.check();
      if (side % kToldEvery == 0) cancel.report(static_cast<double>(side) / static_cast<double>(lit_.size()));
      lit_[side] = emits[side] || seesLight(side);
      shell_lit_[shells_.of(side)] |= lit_[side];
    }
    return true;
  }

  /// Lights sides that may be in several places from what is around them: the rest of their shell, and what
  /// stands on them. Where all of that may be in several places too, on the safe side.
  void lightMixed() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::uint32_t side = 0; side < lit_.size(); ++side) {
        if (lit_[side] || !isMixed(side)) continue;
        bool light = shell_lit_[shells_.of(side)] != 0, known = shell_known_[shells_.of(side)] != 0;
        for (const std::uint32_t s : stands_on_[side]) {
          for (const std::uint32_t shell : {shells_.of(2 * s), shells_.of(2 * s + 1)}) {
            light = light || shell_lit_[shell];
            known = known || shell_known_[shell];
          }
        }
        if (!light && known) continue;
        lit_[side] = shell_lit_[shells_.of(side)] = 1;
        changed = true;
      }
    }
  }

  /// See Reached.
  std::vector<std::uint32_t> rooms() {
    std::vector<std::uint32_t> out;
    if (light_.size() < 2) return out;
    out.assign(lit_.size(), kNone);
    std::unordered_map<Shells::Place, std::uint32_t> numbers;
    std::vector<std::optional<std::uint32_t>> of_shell(lit_.size());
    for (std::uint32_t side = 0; side < lit_.size(); ++side) {
      if (!lit_[side] || isMixed(side)) continue;
      const std::uint32_t shell = shells_.of(side);
      if (!of_shell[shell] || shell_touched_[shell]) {
        const auto place = onePlaceOf(side);
        of_shell[shell] = place ? numbers.try_emplace(*place, numbers.size()).first->second : kNone;
      }
      out[side] = *of_shell[shell];
    }
    return out;
  }

  /// No place of light is the one outside of all shells.
  bool closed() const { return light_.count(Shells::kOutside) == 0; }
  std::vector<char> take() { return std::move(lit_); }

 private:
  bool isMixed(std::uint32_t side) const { return !stands_on_[side].empty(); }
  // Returns whether they can be told.
  bool addPlaces(std::uint32_t side) {
    for (const double off : {kOff, kNear}) {
      const auto place = shells_.placeOf(side, off * weld_distance_);
      if (!place) return false;
      light_.insert(*place);
    }
    return true;
  }
  // Nothing where something stands directly before it.
  std::optional<Shells::Place> onePlaceOf(std::uint32_t side) {
    const auto far = shells_.placeOf(side, kOff * weld_distance_);
    return far && far == shells_.placeOf(side, kNear * weld_distance_) ? far : std::nullopt;
  }
  bool seesLight(std::uint32_t side, double off) {
    const auto place = shells_.placeOf(side, off * weld_distance_);
    return !place || light_.count(*place) > 0;
  }
  // A shell that nothing touches is in one place.
  bool seesLight(std::uint32_t side) {
    const std::uint32_t shell = shells_.of(side);
    if (!shell_touched_[shell] && seen_[shell]) return *seen_[shell];
    const bool sees = seesLight(side, kOff) || seesLight(side, kNear);
    seen_[shell] = sees;
    return sees;
  }

  Shells& shells_;
  double weld_distance_;
  std::vector<std::vector<std::uint32_t>> stands_on_;  // surfaces, of sides
  std::unordered_set<Shells::Place> light_;
  std::vector<char> lit_;                      // of sides
  std::vector<char> shell_lit_, shell_known_;  // whether one of its sides is lit, or surely in one place
  std::vector<char> shell_touched_;            // whether anything touches it, or it touches anything
  std::vector<std::optional<bool>> seen_;      // whether light comes to a shell that nothing touches
};

}  // namespace

Reached findReach(const Mesh& mesh, const std::vector<SurfaceEdge>& edges,
                  std::span<const Crossing> crossings, std::span<const char> emits, double weld_distance,
                  const CancelToken& cancel) {
  const Reached everywhere{std::vector<char>(2 * mesh.surfaces.size(), 1)};
  if (std::find(emits.begin(), emits.end(), 1) == emits.end()) return everywhere;
  const std::vector<Touch> touches = findTouches(mesh, edges, 2 * kOff * weld_distance, cancel.part(0, 0.9));
  Shells shells(mesh, edges, crossings, touches, weld_distance, cancel);
  if (!shells.separate()) return everywhere;
  Reach reach(mesh, edges, touches, shells, weld_distance);
  if (!reach.findLight(emits, cancel.part(0.9, 1))) return everywhere;
  reach.lightMixed();
  std::vector<std::uint32_t> rooms = reach.rooms();
  return {reach.take(), reach.closed(), std::move(rooms)};
}

}  // namespace unshot
