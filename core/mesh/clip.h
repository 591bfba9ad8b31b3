// Clips convex polygons against axis-parallel lines (Sutherland and Hodgman 1974), remembering which edges
// are outline.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace unshot {

using ConvexPolygon = std::vector<PieceCorner>;

/// Keeps what has sign * (uv[axis] - at) >= 0 of `in`. `out` is overwritten; empty where nothing is left.
void clipAt(const ConvexPolygon& in, int axis, double at, double sign, ConvexPolygon& out);

/// Signed area, positive counter-clockwise, and centroid of a polygon.
double polygonArea(std::span<const PieceCorner> polygon);
glm::dvec2 polygonCentroid(std::span<const PieceCorner> polygon);

/// Whether uv lies in the counter-clockwise convex polygon, its border included.
bool contains(std::span<const PieceCorner> polygon, const glm::dvec2& uv);

/// How far uv lies beyond the edge it is farthest beyond (the distance, but near corners); inside, below 0,
/// how far it lies from the nearest edge.
double distanceOutside(std::span<const PieceCorner> polygon, const glm::dvec2& uv);

}  // namespace unshot
