#include "mesh/surfaces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <span>

#include "base/cancel.h"
#include "scene/triangulate.h"

namespace unshot {
namespace {

constexpr double kSmoothCosine = 0.8660254037844387;  // 30 degrees
// Areas and lengths that differ by no more are equal; edges run along an axis within a degree.
constexpr double kAsSmall = 0.01, kAsLong = 0.01, kAlong = 0.9998;
constexpr double kSameNormalCosine = 0.9998;  // given normals that agree within a degree

struct EdgeUse {
  std::uint32_t low, high, polygon;
  bool forward;  // the polygon runs from low to high
};

struct Plane {
  glm::dvec3 normal{0.0};
  double area = 0;
};

// Newell's method: exact for planar polygons, the best normal of others.
Plane planeOf(const WeldedScene& welded, std::span<const std::uint32_t> outline) {
  glm::dvec3 sum(0.0);
  if (outline.size() < 3) return {};
  const glm::dvec3 origin = welded.positions[outline[0]];
  for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
    sum += glm::cross(welded.positions[outline[k]] - origin, welded.positions[outline[k + 1]] - origin);
  }
  const double length = glm::length(sum);
  return length > 0 ? Plane{sum / length, length / 2} : Plane{};
}

class SurfaceMaker {
 public:
  SurfaceMaker(const Scene& scene, const WeldedScene& welded, bool join, Mesh& mesh,
               const CancelToken& cancel)
      : scene_(scene),
        welded_(welded),
        join_(join),
        mesh_(mesh),
        cancel_(cancel),
        surface_of_(scene.polygons.size(), kNone) {}

  SurfaceTopology run() {
    for (std::size_t p = 0; p < scene_.polygons.size(); ++p)
      planes_.push_back(planeOf(welded_, welded_.outline(p)));
    cancel_.check();
    collectEdges();
    cancel_.check();
    mesh_.positions = welded_.positions;
    for (std::uint32_t p = 0; p < scene_.polygons.size(); ++p) {
      if (p % kToldEvery == 0)
        cancel_.report(static_cast<double>(p) / static_cast<double>(scene_.polygons.size()));
      if (surface_of_[p] == kNone && planes_[p].area > 0) growSurface(p);
    }
    SurfaceTopology out{smoothPairs(), {}};
    for (const EdgeUse& e : edges_) {
      if (surface_of_[e.polygon] != kNone)
        out.edges.push_back({e.low, e.high, surface_of_[e.polygon], e.forward});
    }
    return out;
  }

 private:
  void collectEdges() {
    for (std::uint32_t p = 0; p < scene_.polygons.size(); ++p) {
      if (planes_[p].area <= 0) continue;
      cancel_.check();
      const auto ring = welded_.outline(p);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const std::uint32_t a = ring[k], b = ring[(k + 1) % ring.size()];
        edges_.push_back({std::min(a, b), std::max(a, b), p, a < b});
      }
    }
    std::sort(edges_.begin(), edges_.end(), cancel_.checking([](const EdgeUse& x, const EdgeUse& y) {
      return std::tie(x.low, x.high, x.polygon) < std::tie(y.low, y.high, y.polygon);
    }));
    neighbours_.resize(scene_.polygons.size());
    for (std::size_t first = 0; first < edges_.size();) {
      cancel_.check();
      std::size_t end = first;
      while (end < edges_.size() && edges_[end].low == edges_[first].low &&
             edges_[end].high == edges_[first].high)
        ++end;
      if (end - first == 2 && edges_[first].polygon != edges_[first + 1].polygon) {
        pairs_.push_back(first);
        neighbours_[edges_[first].polygon].push_back(first);
        neighbours_[edges_[first + 1].polygon].push_back(first);
      }
      first = end;
    }
  }

  bool joins(std::uint32_t seed, std::uint32_t polygon) const {
    if (!join_ || scene_.polygons[polygon].material != scene_.polygons[seed].material) return false;
    if (planes_[polygon].area <= 0 || glm::dot(planes_[polygon].normal, planes_[seed].normal) < 0.99)
      return false;
    const double tolerance = std::max(weldDistance(scene_), 1e-5 * std::sqrt(planes_[polygon].area));
    const glm::dvec3 origin = welded_.positions[welded_.outline(seed)[0]];
    for (const std::uint32_t v : welded_.outline(polygon)) {
      if (std::abs(glm::dot(welded_.positions[v] - origin, planes_[seed].normal)) > tolerance) return false;
    }
    return true;
  }

  void growSurface(std::uint32_t seed) {
    const auto index = static_cast<std::uint32_t>(mesh_.surfaces.size());
    std::vector<std::uint32_t> members{seed};
    surface_of_[seed] = index;
    for (std::size_t k = 0; k < members.size(); ++k) {
      cancel_.check();
      for (const std::size_t edge : neighbours_[members[k]]) {
        const EdgeUse& one = edges_[edge];
        const EdgeUse& two = edges_[edge + 1];
        if (one.forward == two.forward) continue;  // windings disagree: sides would be mixed up
        const std::uint32_t other = one.polygon == members[k] ? two.polygon : one.polygon;
        if (surface_of_[other] != kNone || !joins(seed, other)) continue;
        surface_of_[other] = index;
        members.push_back(other);
      }
    }
    Surface surface;
    surface.material = scene_.polygons[seed].material;
    surface.polygon = seed;
    surface.normal = planes_[seed].normal;
    makeChart(members, surface);
    addTriangles(members, index, surface);
    if (surface.area > 0) {
      mesh_.surfaces.push_back(surface);
      return;
    }
    // So narrow that welding left nothing of them.
    for (const std::uint32_t p : members) {
      surface_of_[p] = kNone;
      planes_[p].area = 0;
    }
  }

  // Axes along the outline edge that gives the smallest bounding rectangle: cells then follow walls and
  // floors. Of rectangles that are as small the one that most of the outline runs along, as that of a right
  // triangle along its legs.
  void makeChart(const std::vector<std::uint32_t>& members, Surface& surface) const {
    std::vector<std::pair<double, glm::dvec3>> candidates;
    for (const std::uint32_t p : members) {
      const auto ring = welded_.outline(p);
      for (std::size_t k = 0; k < ring.size(); ++k) {
        glm::dvec3 d = welded_.positions[ring[(k + 1) % ring.size()]] - welded_.positions[ring[k]];
        d -= glm::dot(d, surface.normal) * surface.normal;
        const double length = glm::length(d);
        if (length > 0) candidates.emplace_back(-length, d / length);
      }
    }
    const std::size_t tried = std::min<std::size_t>(candidates.size(), 16);
    std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(tried),
                      candidates.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    double best = INFINITY, best_along = 0;
    for (std::size_t k = 0; k < tried; ++k) {
      cancel_.check();
      const glm::dvec3 u = candidates[k].second, v = glm::cross(surface.normal, u);
      glm::dvec2 low(INFINITY), high(-INFINITY);
      for (const std::uint32_t p : members) {
        for (const std::uint32_t corner : welded_.outline(p)) {
          const glm::dvec2 uv{glm::dot(welded_.positions[corner], u), glm::dot(welded_.positions[corner], v)};
          low = glm::min(low, uv);
          high = glm::max(high, uv);
        }
      }
      const glm::dvec2 size = high - low;
      const double area = size.x * size.y;
      double along = 0;
      for (const auto& [minus_length, d] : std::span(candidates).first(tried)) {
        if (std::abs(glm::dot(d, u)) > kAlong || std::abs(glm::dot(d, v)) > kAlong) along -= minus_length;
      }
      const bool as_small = std::abs(area - best) <= kAsSmall * area,
                 as_long = std::abs(along - best_along) <= kAsLong * along;
      if (as_small && !as_long ? along < best_along : area >= best * (1 - 1e-9)) continue;
      best = area;
      best_along = along;
      const double w = glm::dot(welded_.positions[welded_.outline(members[0])[0]], surface.normal);
      surface.axis_u = u;
      surface.axis_v = v;
      surface.extent = size;
      surface.origin = low.x * u + low.y * v + w * surface.normal;
    }
  }

  bool onOutline(std::uint32_t a, std::uint32_t b, std::uint32_t surface) const {
    const EdgeUse key{std::min(a, b), std::max(a, b), 0, false};
    const auto found = std::lower_bound(
        edges_.begin(), edges_.end(), key,
        [](const EdgeUse& x, const EdgeUse& y) { return std::tie(x.low, x.high) < std::tie(y.low, y.high); });
    std::size_t uses = 0, own = 0;
    for (auto e = found; e != edges_.end() && e->low == key.low && e->high == key.high; ++e) {
      ++uses;
      own += surface_of_[e->polygon] == surface;
    }
    return uses > 0 && !(uses == 2 && own == 2);  // no polygon's edge: a diagonal inside a polygon
  }

  void addTriangles(const std::vector<std::uint32_t>& members, std::uint32_t index, Surface& surface) {
    surface.triangles.first = static_cast<std::uint32_t>(mesh_.triangles.size());
    std::vector<glm::dvec2> outline;
    for (const std::uint32_t p : members) {
      cancel_.check();
      const auto ring = welded_.outline(p);
      outline.clear();
      for (const std::uint32_t v : ring) {
        const glm::dvec3 d = welded_.positions[v] - surface.origin;
        outline.emplace_back(glm::dot(d, surface.axis_u), glm::dot(d, surface.axis_v));
      }
      for (const auto& corner : triangulate(outline)) {
        ChartTriangle triangle{};
        for (int k = 0; k < 3; ++k) {
          triangle.uv[k] = outline[corner[k]];
          triangle.position[k] = ring[corner[k]];
          triangle.outline[k] = onOutline(ring[corner[k]], ring[corner[(k + 1) % 3]], index);
        }
        const glm::dvec2 e1 = triangle.uv[1] - triangle.uv[0], e2 = triangle.uv[2] - triangle.uv[0];
        const double area = (e1.x * e2.y - e1.y * e2.x) / 2;
        if (area <= 0) continue;
        surface.area += area;
        mesh_.triangles.push_back(triangle);
      }
    }
    surface.triangles.count = static_cast<std::uint32_t>(mesh_.triangles.size()) - surface.triangles.first;
  }

  // The file's normal of polygon p at welded vertex v, or 0 where it gives none.
  glm::dvec3 givenNormal(std::uint32_t p, std::uint32_t v) const {
    const Polygon& polygon = scene_.polygons[p];
    for (std::uint32_t k = 0; k < polygon.corner_count; ++k) {
      const Corner& corner = scene_.corners[polygon.first_corner + k];
      if (welded_.from_scene[corner.position] == v) {
        return corner.normal == kNone ? glm::dvec3(0.0) : scene_.normals[corner.normal];
      }
    }
    return glm::dvec3(0.0);
  }

  bool smooth(const EdgeUse& a, const EdgeUse& b, bool flipped) const {
    const double sign = flipped ? -1 : 1;
    bool given = true, agree = true;
    for (const std::uint32_t v : {a.low, a.high}) {
      const glm::dvec3 na = givenNormal(a.polygon, v), nb = givenNormal(b.polygon, v);
      given = given && na != glm::dvec3(0.0) && nb != glm::dvec3(0.0);
      agree = agree && sign * glm::dot(na, nb) > kSameNormalCosine;
    }
    if (given) return agree;
    const Polygon& pa = scene_.polygons[a.polygon];
    const Polygon& pb = scene_.polygons[b.polygon];
    if (scene_.smoothing_given) return pa.smoothing_group != 0 && pa.smoothing_group == pb.smoothing_group;
    return sign * glm::dot(planes_[a.polygon].normal, planes_[b.polygon].normal) > kSmoothCosine;
  }

  std::vector<SmoothPair> smoothPairs() const {
    std::set<std::pair<std::uint32_t, std::uint32_t>> known;
    std::vector<SmoothPair> out;
    for (const std::size_t edge : pairs_) {
      cancel_.check();
      const EdgeUse& one = edges_[edge];
      const EdgeUse& two = edges_[edge + 1];
      const std::uint32_t a = surface_of_[one.polygon], b = surface_of_[two.polygon];
      if (a == b || a == kNone || b == kNone || mesh_.surfaces[a].material != mesh_.surfaces[b].material)
        continue;
      const bool flipped = one.forward == two.forward;
      if (!smooth(one, two, flipped) || !known.emplace(std::min(a, b), std::max(a, b)).second) continue;
      out.push_back({a, b, flipped});
    }
    return out;
  }

  const Scene& scene_;
  const WeldedScene& welded_;
  bool join_;
  Mesh& mesh_;
  const CancelToken& cancel_;
  std::vector<Plane> planes_;
  std::vector<EdgeUse> edges_;                        // sorted by (low, high)
  std::vector<std::size_t> pairs_;                    // first of two uses of an edge that two polygons share
  std::vector<std::vector<std::size_t>> neighbours_;  // per polygon: entries of pairs_
  std::vector<std::uint32_t> surface_of_;
};

}  // namespace

SurfaceTopology makeSurfaces(const Scene& scene, const WeldedScene& welded, bool join, Mesh& mesh,
                             const CancelToken& cancel) {
  return SurfaceMaker(scene, welded, join, mesh, cancel).run();
}

}  // namespace unshot
