#include "mesh/clip.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "base/cross.h"

namespace unshot {
namespace {

// Where edge p-q meets the line; computed the same way from either end, so that neighbours agree to the last
// bit.
glm::dvec2 crossing(glm::dvec2 p, glm::dvec2 q, int axis, double at) {
  if (q[axis] < p[axis]) std::swap(p, q);
  const double t = (at - p[axis]) / (q[axis] - p[axis]);
  glm::dvec2 x = p + t * (q - p);
  x[axis] = at;
  return x;
}

}  // namespace

void clipAt(const ConvexPolygon& in, int axis, double at, double sign, ConvexPolygon& out) {
  out.clear();
  for (std::size_t k = 0; k < in.size(); ++k) {
    const PieceCorner& a = in[k];
    const PieceCorner& b = in[(k + 1) % in.size()];
    const double da = sign * (a.uv[axis] - at), db = sign * (b.uv[axis] - at);
    if (da >= 0) out.push_back(a);
    if (da > 0 && db < 0) out.push_back({crossing(a.uv, b.uv, axis, at), false});
    if (da == 0 && db < 0) out.back().outline = false;  // the next edge runs along the line
    if (da < 0 && db > 0) out.push_back({crossing(a.uv, b.uv, axis, at), a.outline});
  }
  if (out.size() < 3) out.clear();
}

double polygonArea(std::span<const PieceCorner> polygon) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    twice += cross(polygon[k].uv - polygon[0].uv, polygon[k + 1].uv - polygon[0].uv);
  }
  return twice / 2;
}

glm::dvec2 polygonCentroid(std::span<const PieceCorner> polygon) {
  glm::dvec2 sum(0.0);
  double twice = 0;
  const glm::dvec2 o = polygon[0].uv;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const glm::dvec2 a = polygon[k].uv - o, b = polygon[k + 1].uv - o;
    const double c = cross(a, b);
    sum += c * (a + b) / 3.0;
    twice += c;
  }
  return twice > 0 ? o + sum / twice : o;
}

bool contains(std::span<const PieceCorner> polygon, const glm::dvec2& uv) {
  if (polygon.size() < 3) return false;
  const PieceCorner* from = &polygon.back();
  for (const PieceCorner& to : polygon) {
    if (cross(to.uv - from->uv, uv - from->uv) < 0) return false;
    from = &to;
  }
  return true;
}

double distanceOutside(std::span<const PieceCorner> polygon, const glm::dvec2& uv) {
  double most = -std::numeric_limits<double>::infinity();
  if (polygon.empty()) return most;
  const PieceCorner* from = &polygon.back();
  for (const PieceCorner& to : polygon) {
    const glm::dvec2 edge = to.uv - from->uv;
    const double length = glm::length(edge);
    if (length > 0) most = std::max(most, cross(uv - from->uv, edge) / length);
    from = &to;
  }
  return most;
}

}  // namespace unshot
