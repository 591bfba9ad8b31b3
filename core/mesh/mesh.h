// The discretisation: surfaces with charts, their subdivision trees, elements and patches per side, display
// vertices.
//
// A surface is a connected set of coplanar polygons of one material. Its chart maps (u, v) in metres of the
// scene to origin + u axis_u + v axis_v. Over the chart lies a grid of nu x nv cells, the leaves of a
// four-way tree of cell rectangles; a cell is cut by the surface's outline and by contacts with other
// surfaces into convex pieces. An element is what hangs together in a cell, or in several where it would be a
// sliver. A patch is what hangs together in an inner node of the tree: the source of light. Geometry is per
// surface; each side that light can reach has its own elements and patches, numbered over the whole mesh.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "base/diagnostic.h"
#include "scene/scene.h"

namespace unshot {

/// A range [first, first + count) of some array.
struct Range {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t end() const { return first + count; }
};

struct Surface {
  std::uint32_t material = 0;
  glm::dvec3 origin{0.0}, axis_u{1, 0, 0}, axis_v{0, 1, 0}, normal{0, 0, 1};  ///< orthonormal, right-handed
  glm::dvec2 extent{0.0};  ///< the chart covers [0, extent.x] x [0, extent.y]
  double area = 0;         ///< [m^2], of one side
  Range triangles;  ///< in Mesh::triangles: the polygons of the scene, counter-clockwise about `normal`
  std::uint32_t polygon = 0;     ///< in Scene::polygons: one of those that it consists of, for messages
  std::uint32_t nu = 1, nv = 1;  ///< cells along u and v
  std::uint32_t first_cell = 0;  ///< in Mesh::cells; cell (i, j) is first_cell + j nu + i
  bool cut = false;              ///< contacts cut cells: neighbouring cells may not share all corners
  std::uint32_t root = 0;        ///< in Mesh::nodes
  Range elements;                ///< in Mesh::shapes: the surface's elements, whatever the side
  Range patches;                 ///< in Mesh::patch_shapes
  std::uint32_t side[2] = {kNone, kNone};  ///< front, back: in Mesh::sides; kNone where no light can reach
  bool outer[2] = {false, false};          ///< front, back: whether nothing of the scene lies in front
  /// Surfaces that light reaches in one of its rooms (Side::room), or the sky, lie on either side of its
  /// plane.
  bool between = false;

  glm::dvec3 point(const glm::dvec2& uv) const { return origin + uv.x * axis_u + uv.y * axis_v; }
  glm::dvec2 chart(const glm::dvec3& p) const {
    return {glm::dot(p - origin, axis_u), glm::dot(p - origin, axis_v)};
  }
};

/// One side of a surface that light can reach.
struct Side {
  std::uint32_t surface = 0;
  bool back = false;
  glm::dvec3 normal{0.0};       ///< points away from this side
  glm::dvec3 reflectance{0.0};  ///< rho
  glm::dvec3 emission{0.0};     ///< E [W/m^2]
  std::uint32_t room = 0;       ///< from 0 on: no light goes straight from one room to another (mesh/reach.h)
  std::uint32_t first_element = 0;  ///< element of local shape k: first_element + k
  std::uint32_t first_part = 0;     ///< in Mesh::patch_parts: that of local patch k is first_part + k
};

/// A triangle of the scene in its surface's chart.
struct ChartTriangle {
  glm::dvec2 uv[3];
  std::uint32_t position[3];  ///< in Mesh::positions
  bool outline[3];            ///< whether the edge from corner k to k + 1 lies on the surface's outline
};

inline constexpr std::uint32_t kMixed = kNone - 1;

/// A leaf of the tree: a grid cell.
struct Cell {
  std::uint32_t element =
      kNone;     ///< local element (in the surface); kNone: no area here; kMixed: ask the pieces
  Range pieces;  ///< in Mesh::pieces
};

/// A corner of a piece; `outline`: the edge to the next corner lies on the surface's outline or on a contact,
/// so nothing is interpolated across it.
struct PieceCorner {
  glm::dvec2 uv{0.0};
  bool outline = false;
};

/// A convex polygon of a cell, counter-clockwise in the chart.
struct Piece {
  Range corners;  ///< in Mesh::piece_corners
  double area = 0;
  std::uint32_t element = 0;  ///< local element
};

/// A node of a subdivision tree: the cells [u0, u1) x [v0, v1).
struct Node {
  std::uint32_t surface = 0;
  std::uint32_t u0 = 0, v0 = 0, u1 = 1, v1 = 1;
  std::uint32_t first_child = kNone;
  std::uint32_t child_count = 0;
  double area = 0;  ///< inside the outline
  bool isCell() const { return u1 - u0 == 1 && v1 - v0 == 1; }
};

/// What both sides of a patch share.
struct PatchShape {
  std::uint32_t node = 0;
  bool whole = true;  ///< every piece in the node is of this patch
};

/// A local patch of one side: a patch of its own or, where small surfaces join smoothly, a part of one.
struct PatchPart {
  std::uint32_t side = 0;   ///< in Mesh::sides
  std::uint32_t patch = 0;  ///< the patch that it belongs to
};

/// What both sides of an element share.
struct ElementShape {
  double area = 0;
  glm::dvec3 centre{0.0};   ///< on the surface, inside the element
  std::uint32_t patch = 0;  ///< local patch of its surface
};

/// A display vertex of one side (shared across smooth neighbours of one material).
struct Vertex {
  glm::vec3 position{0.0f};
  glm::vec3 normal{0.0f};
  std::uint32_t material = 0;
  std::uint32_t side = 0;  ///< in Mesh::sides: one of those that use it
};

/// Rows of weights into another array, compressed: row k is weights [start[k], start[k + 1]).
struct SparseRows {
  std::vector<std::uint32_t> start{0};
  std::vector<std::uint32_t> index;
  std::vector<float> weight;
  std::size_t size() const { return start.size() - 1; }
};

/// Two surfaces that meet smoothly along an edge, so that vertices on it are shared. `flipped`: their
/// windings disagree, the front of one continues in the back of the other.
struct SmoothPair {
  std::uint32_t a = 0, b = 0;
  bool flipped = false;
};

/// Another number at each call; any thread.
inline std::uint64_t nextCut() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

struct Mesh {
  /// The same for copies: meshes that may differ in materials, and in nothing else.
  std::uint64_t cut = nextCut();

  // The scene it belongs to, as far as drawing and transport need it.
  glm::dvec3 frame_origin{0.0};
  glm::dvec3 bounds_min{0.0}, bounds_max{0.0};
  std::vector<Material> materials;
  std::vector<glm::dvec3> positions;  ///< welded

  // Geometry, per surface.
  std::vector<Surface> surfaces;
  std::vector<ChartTriangle> triangles;
  std::vector<Cell> cells;
  std::vector<Piece> pieces;
  std::vector<PieceCorner> piece_corners;
  std::vector<Node> nodes;
  std::vector<PatchShape> patch_shapes;  ///< local patches
  std::vector<ElementShape> shapes;      ///< local elements

  // Sides, and what is numbered over all of them.
  std::vector<Side> sides;
  std::uint32_t element_count = 0;
  std::uint32_t patch_count = 0;
  std::vector<std::uint32_t> element_side;         ///< one per element
  std::vector<std::uint32_t> element_patch;        ///< one per element
  std::vector<double> element_area;                ///< one per element [m^2]
  std::vector<PatchPart> patch_parts;              ///< numbered over all sides
  std::vector<std::uint32_t> patch_part_start{0};  ///< parts of patch q: see partsOf
  std::vector<std::uint32_t> patch_part;           ///< in patch_parts; of each patch the middlemost first
  std::vector<std::uint32_t> patch_side;           ///< one per patch: of its middlemost part
  std::vector<double> patch_area;                  ///< one per patch: the sum over its elements [m^2]
  /// One per patch: equal where patches face the same air as far as the mesh shows it (mesh/air.h), an index
  /// of one of them.
  std::vector<std::uint32_t> patch_air;

  // Display: triangles of both sides, each wound counter-clockwise as seen from its side.
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> triangle_vertices;  ///< three per triangle
  std::vector<std::uint32_t> triangle_element;   ///< one per triangle
  SparseRows vertex_from_elements;               ///< interpolation: one row per vertex, weights sum to 1

  /// The mesh that this one refines (mesh/refine.h): surfaces, sides, patches and their numbers are the same.
  /// Null where there is none.
  std::shared_ptr<const Mesh> base;
  bool for_error = false;  ///< as fine as the error asked for needs, which is that of the whole then
  bool closed = false;     ///< no light leaves the scene: surfaces lie around every light (mesh/reach.h)
  /// Rays that ask what stands between two points ask it of surfaces too that can not (Surface::between).
  bool all_tested = false;
  std::vector<std::uint32_t>
      element_from_base;        ///< the base's element that each is a part of; none without base
  SparseRows vertex_from_base;  ///< interpolation from base->vertices: a row per vertex; none without base

  std::vector<SmoothPair> smooth_pairs;
  double weld_distance = 0;  ///< points closer than this are one [m]
  std::span<const PieceCorner> cornersOf(const Piece& piece) const {
    return {piece_corners.data() + piece.corners.first, piece.corners.count};
  }
  /// The parts of patch q, in patch_parts, the middlemost first.
  std::span<const std::uint32_t> partsOf(std::uint32_t q) const {
    return {patch_part.data() + patch_part_start[q], patch_part.data() + patch_part_start[q + 1]};
  }
  /// Whether patch q is made of several surfaces, with normals of their own.
  bool joined(std::uint32_t q) const { return patch_part_start[q + 1] - patch_part_start[q] > 1; }
  /// The local patch, in its surface, of one of patch_parts.
  std::uint32_t localPatch(std::uint32_t part) const {
    return part - sides[patch_parts[part].side].first_part;
  }
  /// Whether walls all around stand between this side and patch q.
  bool inOtherRooms(std::uint32_t side, std::uint32_t q) const {
    return sides[side].room != sides[patch_side[q]].room;
  }
  /// Whether patch q is an emitter.
  bool emits(std::uint32_t q) const { return sides[patch_side[q]].emission != glm::dvec3(0.0); }

  double element_size = 0;  ///< edge of a full cell aimed at [m]
  double patch_size = 0;    ///< edge of a full patch aimed at [m]
  double lit_area = 0;      ///< over sides [m^2]
  Diagnostics diagnostics;
};

/// Corners of a piece in space, counter-clockwise as seen from the side.
inline std::vector<glm::dvec3> outlineOf(const Mesh& mesh, const Side& side, const Piece& piece) {
  std::vector<glm::dvec3> out;
  for (const PieceCorner& corner : mesh.cornersOf(piece))
    out.push_back(mesh.surfaces[side.surface].point(corner.uv));
  if (side.back) std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace unshot
