#include "mesh/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "base/box_tree.h"
#include "base/cancel.h"
#include "base/cross.h"
#include "mesh/clip.h"
#include "mesh/lit.h"

namespace unshot {
namespace {

// The part of the line a + t d (|d| = 1) inside a convex polygon: t in [first, second]; empty where first >=
// second.
std::pair<double, double> insideRange(const ConvexPolygon& polygon, const glm::dvec2& a,
                                      const glm::dvec2& d) {
  double first = -INFINITY, second = INFINITY;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const glm::dvec2 p = polygon[k].uv, edge = polygon[(k + 1) % polygon.size()].uv - p;
    const double distance = cross(edge, a - p),
                 speed = cross(edge, d);  // inside where distance + t speed >= 0
    if (speed == 0) {
      if (distance < 0) return {0, 0};
      continue;
    }
    const double t = -distance / speed;
    if (speed > 0) {
      first = std::max(first, t);
    } else {
      second = std::min(second, t);
    }
  }
  return {first, second};
}

// Both halves of a polygon along a line, or itself; a half without area is dropped. `height` spares
// allocations.
void halve(ConvexPolygon& in, const glm::dvec2& a, const glm::dvec2& d, double tolerance,
           std::vector<double>& height, std::vector<ConvexPolygon>& out) {
  height.resize(in.size());
  double low = 0, high = 0;
  for (std::size_t k = 0; k < in.size(); ++k) {
    height[k] = cross(d, in[k].uv - a);
    if (std::abs(height[k]) <= tolerance) height[k] = 0;
    low = std::min(low, height[k]);
    high = std::max(high, height[k]);
  }
  if (low == 0 || high == 0) {
    out.push_back(std::move(in));
    return;
  }
  for (const double sign : {1.0, -1.0}) {
    ConvexPolygon half;
    for (std::size_t k = 0; k < in.size(); ++k) {
      const std::size_t next = (k + 1) % in.size();
      const double h0 = sign * height[k], h1 = sign * height[next];
      if (h0 >= 0) half.push_back({in[k].uv, h0 == 0 && h1 < 0 ? false : in[k].outline});
      if ((h0 > 0 && h1 < 0) || (h0 < 0 && h1 > 0)) {
        // The same point from either half and from the neighbour across the edge.
        const bool turned =
            in[next].uv.x < in[k].uv.x || (in[next].uv.x == in[k].uv.x && in[next].uv.y < in[k].uv.y);
        const glm::dvec2 p = turned ? in[next].uv : in[k].uv, q = turned ? in[k].uv : in[next].uv;
        const double hp = turned ? height[next] : height[k], hq = turned ? height[k] : height[next];
        half.push_back({p + hp / (hp - hq) * (q - p), h0 < 0 && in[k].outline});
      }
    }
    if (half.size() >= 3 && polygonArea(half) > 0) out.push_back(std::move(half));
  }
}

// Whether segments that lie on the edge from a to b cover all of it, one after the other.
bool isCovered(const glm::dvec2& a, const glm::dvec2& b, const std::vector<const ContactSegment*>& segments,
               double tolerance) {
  const double length = glm::distance(a, b);
  if (length == 0) return false;
  const glm::dvec2 d = (b - a) / length;
  std::vector<std::pair<double, double>> parts;
  for (const ContactSegment* s : segments) {
    const glm::dvec2 along = (s->b - s->a) / glm::distance(s->a, s->b);
    if (std::abs(cross(along, a - s->a)) > tolerance || std::abs(cross(along, b - s->a)) > tolerance)
      continue;
    const double x = glm::dot(s->a - a, d), y = glm::dot(s->b - a, d);
    parts.emplace_back(std::min(x, y), std::max(x, y));
  }
  std::sort(parts.begin(), parts.end());
  double until = 0;
  for (const auto& [low, high] : parts) {
    if (low > until + tolerance) return false;
    until = std::max(until, high);
  }
  return !parts.empty() && until >= length - tolerance;
}

// Of an element's edge: the least extent of a surface that edges above it cut, and how far above it they are.
// Farther off, what one element sees past an edge differs little from what the next one sees.
constexpr double kLarge = 2, kJustAbove = 0.25;

// The part of the segment in the triangle (counter-clockwise); nothing where it is no longer than twice
// `distance`.
std::optional<ContactSegment> partInside(const ContactSegment& s, const ChartTriangle& t, double distance) {
  const double length = glm::distance(s.a, s.b);
  if (length <= 2 * distance) return std::nullopt;
  const glm::dvec2 d = (s.b - s.a) / length;
  const ConvexPolygon corners{{t.uv[0], false}, {t.uv[1], false}, {t.uv[2], false}};
  auto [first, last] = insideRange(corners, s.a, d);
  first = std::max(first, 0.0);
  last = std::min(last, length);
  if (last - first <= 2 * distance) return std::nullopt;
  return ContactSegment{s.a + first * d, s.a + last * d};
}

// Whether the segment, inside of the triangle, lies on the outline.
bool isOnOutline(const ContactSegment& s, const ChartTriangle& t, double distance) {
  for (int k = 0; k < 3; ++k) {
    const glm::dvec2 edge = t.uv[(k + 1) % 3] - t.uv[k];
    const double reach = distance * glm::length(edge);
    if (t.outline[k] && std::abs(cross(edge, s.a - t.uv[k])) <= reach &&
        std::abs(cross(edge, s.b - t.uv[k])) <= reach)
      return true;
  }
  return false;
}

// Where a triangle passes through the surface's plane; nothing where it only reaches it.
std::optional<ContactSegment> crossingOf(const Surface& surface, const std::array<glm::dvec3, 3>& corners,
                                         double distance) {
  double height[3], low = 0, high = 0;
  for (int k = 0; k < 3; ++k) {
    height[k] = glm::dot(corners[k] - surface.origin, surface.normal);
    low = std::min(low, height[k]);
    high = std::max(high, height[k]);
    if (std::abs(height[k]) <= distance) height[k] = 0;
  }
  if (low >= -distance || high <= distance) return std::nullopt;
  glm::dvec2 points[2];
  int count = 0;
  for (int k = 0; k < 3 && count < 2; ++k) {
    const int next = (k + 1) % 3;
    if (height[k] == 0) {
      points[count++] = surface.chart(corners[k]);
    } else if (height[k] * height[next] < 0) {
      const double t = height[k] / (height[k] - height[next]);
      points[count++] = surface.chart(corners[k] + t * (corners[next] - corners[k]));
    }
  }
  return count == 2 ? std::optional(ContactSegment{points[0], points[1]}) : std::nullopt;
}

// Edges no higher above a surface than `reachOf` says that lie within its rectangle, where
// `accepts(height, length)`: of those surfaces that `counts`.
template <class Counts, class Reach, class Accept>
std::vector<Touch> edgesNear(const Mesh& mesh, const std::vector<SurfaceEdge>& edges, double distance,
                             const Counts& counts, const Reach& reachOf, const Accept& accepts,
                             const CancelToken& cancel) {
  // Each edge once, however many polygons share it; `first` is the first of its uses.
  std::vector<std::uint32_t> first;
  std::vector<Box> boxes;
  const auto same = [&](std::uint32_t k, std::uint32_t use) {
    return use < edges.size() && edges[use].a == edges[k].a && edges[use].b == edges[k].b;
  };
  for (std::uint32_t k = 0, end = 0; k < edges.size(); k = end) {
    bool of_any = false;
    for (end = k; same(k, end); ++end) of_any = of_any || counts(mesh.surfaces[edges[end].surface]);
    if (!of_any) continue;
    const glm::dvec3 &p = mesh.positions[edges[k].a], &q = mesh.positions[edges[k].b];
    first.push_back(k);
    boxes.push_back({glm::min(p, q), glm::max(p, q)});
  }
  // Whether the surface has the edge itself: then it is outline already.
  const auto owns = [&](std::uint32_t surface, std::uint32_t k) {
    for (std::uint32_t use = k; same(k, use); ++use) {
      if (edges[use].surface == surface) return true;
    }
    return false;
  };
  const BoxTree tree(std::move(boxes), cancel);
  std::vector<Touch> out;
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    cancel.check();
    if (s % kToldEvery == 0)
      cancel.report(static_cast<double>(s) / static_cast<double>(mesh.surfaces.size()));
    const Surface& surface = mesh.surfaces[s];
    if (!counts(surface)) continue;
    const double reach = reachOf(surface);
    Box box{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t].position) {
        box.low = glm::min(box.low, mesh.positions[v] - reach);
        box.high = glm::max(box.high, mesh.positions[v] + reach);
      }
    }
    tree.overlapping(box, [&](std::uint32_t index) {
      const SurfaceEdge& e = edges[first[index]];
      const glm::dvec3 p = mesh.positions[e.a] - surface.origin, q = mesh.positions[e.b] - surface.origin;
      const double height =
          std::max(std::abs(glm::dot(p, surface.normal)), std::abs(glm::dot(q, surface.normal)));
      if (height > reach || !accepts(height, glm::distance(p, q))) return;
      if (owns(s, first[index])) return;
      const ContactSegment segment{{glm::dot(p, surface.axis_u), glm::dot(p, surface.axis_v)},
                                   {glm::dot(q, surface.axis_u), glm::dot(q, surface.axis_v)}};
      const auto outside = [&](int axis) {
        return std::max(segment.a[axis], segment.b[axis]) <= distance ||
               std::min(segment.a[axis], segment.b[axis]) >= surface.extent[axis] - distance;
      };
      if (!outside(0) && !outside(1)) out.push_back({s, first[index], segment});
    });
  }
  return out;
}

}  // namespace

std::vector<Crossing> findCrossings(const Mesh& mesh, double distance, const CancelToken& cancel) {
  std::vector<Crossing> out;
  const auto cornersOf = [&](std::uint32_t t) {
    const std::uint32_t* v = mesh.triangles[t].position;
    return std::array<glm::dvec3, 3>{mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
  };
  std::vector<Box> boxes;
  std::vector<std::uint32_t> owner(mesh.triangles.size());
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    const Range range = mesh.surfaces[s].triangles;
    std::fill_n(owner.begin() + range.first, range.count, s);
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = cornersOf(t);
    boxes.push_back({glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)});
  }
  const BoxTree tree(boxes, cancel);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    cancel.check();
    if (t % kToldEvery == 0)
      cancel.report(static_cast<double>(t) / static_cast<double>(mesh.triangles.size()));
    const Surface& surface = mesh.surfaces[owner[t]];
    tree.overlapping(boxes[t], [&](std::uint32_t other) {
      if (owner[other] == owner[t]) return;
      const auto line = crossingOf(surface, cornersOf(other), distance);
      const auto inside = line ? partInside(*line, mesh.triangles[t], distance) : std::nullopt;
      if (inside)
        out.push_back({owner[t], owner[other], *inside, isOnOutline(*inside, mesh.triangles[t], distance)});
    });
  }
  return out;
}

std::vector<Touch> findTouches(const Mesh& mesh, const std::vector<SurfaceEdge>& edges, double distance,
                               const CancelToken& cancel) {
  return edgesNear(
      mesh, edges, distance, [](const Surface&) { return true; }, [&](const Surface&) { return distance; },
      [&](double height, double) { return height <= distance; }, cancel);
}

Contacts findContacts(const Mesh& mesh, const std::vector<SurfaceEdge>& edges,
                      std::span<const Crossing> crossings, double distance, double size,
                      const CancelToken& cancel) {
  // Edges just above a surface tell its elements apart where there are several beside each other.
  const double above = std::max(kJustAbove * size, distance);
  const auto reachOf = [&](const Surface& s) {
    return std::min(s.extent.x, s.extent.y) > kLarge * size ? above : distance;
  };
  Contacts out(mesh.surfaces.size());
  const auto accepts = [&](double height, double length) { return height <= distance || length >= size; };
  for (const Touch& touch : edgesNear(mesh, edges, distance, isLit, reachOf, accepts, cancel))
    out[touch.surface].push_back(touch.line);
  for (const Crossing& c : crossings) out[c.surface].push_back(c.line);
  return out;
}

void cutByContacts(std::vector<ConvexPolygon>& polygons, const std::vector<ContactSegment>& contacts,
                   double tolerance) {
  std::vector<ConvexPolygon> next;
  std::vector<const ContactSegment*> near;
  std::vector<double> height;
  glm::dvec2 low(INFINITY), high(-INFINITY);
  for (const ConvexPolygon& p : polygons) {
    for (const PieceCorner& c : p) {
      low = glm::min(low, c.uv - 2 * tolerance);
      high = glm::max(high, c.uv + 2 * tolerance);
    }
  }
  const auto elsewhere = [&](const ContactSegment& s) {
    return std::max(s.a.x, s.b.x) < low.x || std::max(s.a.y, s.b.y) < low.y ||
           std::min(s.a.x, s.b.x) > high.x || std::min(s.a.y, s.b.y) > high.y;
  };
  for (const ContactSegment& segment : contacts) {
    if (elsewhere(segment)) continue;
    const double length = glm::distance(segment.a, segment.b);
    const glm::dvec2 d = (segment.b - segment.a) / length;
    const bool passes = std::any_of(polygons.begin(), polygons.end(), [&](const ConvexPolygon& p) {
      const auto [first, second] = insideRange(p, segment.a, d);
      return std::min(second, length + tolerance) - std::max(first, -tolerance) > 2 * tolerance;
    });
    if (!passes) continue;
    near.push_back(&segment);
    next.clear();
    for (ConvexPolygon& p : polygons) halve(p, segment.a, d, tolerance, height, next);
    polygons.swap(next);
  }
  if (near.empty()) return;
  for (ConvexPolygon& p : polygons) {
    for (std::size_t k = 0; k < p.size(); ++k) {
      const glm::dvec2 &a = p[k].uv, &b = p[(k + 1) % p.size()].uv;
      p[k].outline = p[k].outline || isCovered(a, b, near, 2 * tolerance);
    }
  }
}

}  // namespace unshot
