// What must hold for every mesh, whatever the scene.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "base/point_tree.h"
#include "mesh/grid.h"
#include "mesh/mesh.h"

namespace unshot::testing_support {

inline double displayTriangleArea(const Mesh& mesh, std::size_t t) {
  const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
  const glm::dvec3 a(mesh.vertices[corner[0]].position), b(mesh.vertices[corner[1]].position),
      c(mesh.vertices[corner[2]].position);
  return glm::length(glm::cross(b - a, c - a)) / 2;
}

/// Areas of pieces, elements and patches add up to those of the surfaces, on each side. Pieces smaller than
/// 1e-12 of a cell may be dropped, so 1e-9 of a surface is beyond what many of them make.
inline void expectAreasAddUp(const Mesh& mesh) {
  std::vector<double> elements(mesh.sides.size(), 0.0), patches(mesh.sides.size(), 0.0);
  for (std::size_t e = 0; e < mesh.element_count; ++e) {
    EXPECT_GT(mesh.element_area[e], 0);
    elements[mesh.element_side[e]] += mesh.element_area[e];
  }
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    if (!mesh.joined(q)) {
      patches[mesh.patch_side[q]] += mesh.patch_area[q];
      continue;
    }
    double area = 0;
    for (const std::uint32_t part : mesh.partsOf(q)) {
      const std::uint32_t side = mesh.patch_parts[part].side;
      area += patches[side] = mesh.surfaces[mesh.sides[side].surface].area;
    }
    EXPECT_NEAR(mesh.patch_area[q], area, 1e-9 * area) << "patch " << q;
  }
  double lit = 0;
  for (std::size_t k = 0; k < mesh.sides.size(); ++k) {
    const double area = mesh.surfaces[mesh.sides[k].surface].area;
    EXPECT_NEAR(elements[k], area, 1e-9 * area) << "side " << k;
    EXPECT_NEAR(patches[k], area, 1e-9 * area) << "side " << k;
    lit += area;
  }
  EXPECT_NEAR(mesh.lit_area, lit, 1e-12 * lit);
  for (const Surface& s : mesh.surfaces) {
    if (s.elements.count == 0) continue;
    std::vector<double> pieces(s.elements.count, 0.0);
    for (std::uint32_t c = s.first_cell; c < s.first_cell + s.nu * s.nv; ++c) {
      const Range range = mesh.cells[c].pieces;
      for (std::uint32_t p = range.first; p < range.end(); ++p) {
        ASSERT_LT(mesh.pieces[p].element, s.elements.count);
        pieces[mesh.pieces[p].element] += mesh.pieces[p].area;
      }
    }
    for (std::uint32_t e = 0; e < s.elements.count; ++e) {
      EXPECT_NEAR(pieces[e], mesh.shapes[s.elements.first + e].area, 1e-9 * pieces[e]);
    }
    EXPECT_NEAR(mesh.nodes[s.root].area, s.area, 1e-9 * s.area);
  }
}

/// What lies at an element's centre is the element.
inline void expectCentresInside(const Mesh& mesh) {
  const double size = glm::length(mesh.bounds_max - mesh.bounds_min);
  for (const Surface& s : mesh.surfaces) {
    for (std::uint32_t e = 0; e < s.elements.count; ++e) {
      const glm::dvec3 centre = mesh.shapes[s.elements.first + e].centre;
      EXPECT_EQ(elementAt(mesh, s, s.chart(centre)), e);
      EXPECT_NEAR(glm::dot(centre - s.origin, s.normal), 0, 1e-12 * size);
    }
  }
}

/// Display triangles cover each element's area, face its side, and weights sum to 1. Vertices are in single
/// precision: 1e-5 of an area, and 1e-6 of the scene's size along an edge, more for a sliver.
inline void expectDisplayCovers(const Mesh& mesh) {
  std::vector<double> shown(mesh.element_count, 0.0);
  const double size = glm::length(mesh.bounds_max - mesh.bounds_min);
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
    const std::uint32_t element = mesh.triangle_element[t];
    ASSERT_LT(element, mesh.element_count);
    shown[element] += displayTriangleArea(mesh, t);
    for (int k = 0; k < 3; ++k) {
      const Vertex& v = mesh.vertices[mesh.triangle_vertices[3 * t + static_cast<std::size_t>(k)]];
      EXPECT_EQ(v.material, mesh.surfaces[mesh.sides[mesh.element_side[element]].surface].material);
      EXPECT_GT(glm::dot(glm::dvec3(v.normal), mesh.sides[mesh.element_side[element]].normal), 0);
    }
  }
  for (std::size_t e = 0; e < mesh.element_count; ++e) {
    const double area = mesh.element_area[e];
    EXPECT_NEAR(shown[e], area, 1e-5 * area + 2e-6 * size * std::sqrt(area)) << "element " << e;
  }
  const SparseRows& rows = mesh.vertex_from_elements;
  ASSERT_EQ(rows.size(), mesh.vertices.size());
  for (std::size_t v = 0; v < rows.size(); ++v) {
    double sum = 0;
    for (std::uint32_t k = rows.start[v]; k < rows.start[v + 1]; ++k) {
      EXPECT_GE(rows.weight[k], 0);
      sum += static_cast<double>(rows.weight[k]);
    }
    EXPECT_NEAR(sum, 1, 1e-5) << "vertex " << v;
  }
}

/// How often each edge of the display triangles is run through one way more than the other, by the places of
/// its ends.
using PlaceOfVertex = std::tuple<float, float, float>;
using EdgeUses = std::map<std::pair<PlaceOfVertex, PlaceOfVertex>, int>;

inline PlaceOfVertex placeOf(const Mesh& mesh, std::uint32_t vertex) {
  const glm::vec3& p = mesh.vertices[vertex].position;
  return {p.x, p.y, p.z};
}

/// Of the triangles that `counts` lets pass (given their element's side).
template <class F>
EdgeUses edgeUses(const Mesh& mesh, F&& counts) {
  EdgeUses uses;
  for (std::size_t k = 0; k < mesh.triangle_vertices.size(); ++k) {
    if (!counts(mesh.sides[mesh.element_side[mesh.triangle_element[k / 3]]])) continue;
    const std::size_t next = k % 3 == 2 ? k - 2 : k + 1;
    const PlaceOfVertex a = placeOf(mesh, mesh.triangle_vertices[k]),
                        b = placeOf(mesh, mesh.triangle_vertices[next]);
    ++uses[{a, b}];
    --uses[{b, a}];
  }
  return uses;
}

/// No vertex of the display lies within an edge where triangles end: else rounding would open a crack between
/// what meets there. Side by side, since the two sides of a sheet end at the same edges. `margin` [m]: the
/// distance below which points were made one.
inline void expectNoVertexWithinAnEdge(const Mesh& mesh, double margin) {
  std::vector<glm::dvec3> points;
  for (const Vertex& v : mesh.vertices) points.emplace_back(v.position);
  const PointTree tree(points);
  std::size_t found = 0;
  for (std::size_t s = 0; s < mesh.sides.size(); ++s) {
    for (const auto& [edge, count] :
         edgeUses(mesh, [&](const Side& side) { return &side == &mesh.sides[s]; })) {
      if (count == 0) continue;
      const auto point = [](const PlaceOfVertex& p) {
        return glm::dvec3(std::get<0>(p), std::get<1>(p), std::get<2>(p));
      };
      const glm::dvec3 a = point(edge.first), b = point(edge.second);
      const double length = glm::distance(a, b);
      tree.nearSegment(a, b, 0.5 * margin, [&](std::uint32_t v) {
        const double along = glm::dot(points[v] - a, b - a) / length;
        if (along > 3 * margin && along < length - 3 * margin) ++found;
      });
    }
  }
  EXPECT_EQ(found, 0u) << "vertices within edges of triangles";
}

/// In a scene whose sides that face inwards close a room: every edge of their triangles is run through as
/// often one way as the other. `counts`: which sides those are.
template <class F>
void expectClosed(const Mesh& mesh, F&& counts) {
  const EdgeUses uses = edgeUses(mesh, counts);
  const auto open = std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second != 0; });
  EXPECT_FALSE(uses.empty());
  EXPECT_EQ(open, 0) << "edges without a partner";
}

inline void expectSoundMesh(const Mesh& mesh) {
  expectAreasAddUp(mesh);
  expectCentresInside(mesh);
  expectDisplayCovers(mesh);
}

}  // namespace unshot::testing_support
