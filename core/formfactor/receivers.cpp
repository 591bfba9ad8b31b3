#include "formfactor/receivers.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

namespace unshot {
namespace {

// On an edge the irradiance of two walls meets and Lambert's factor is undefined; a thousandth of the way to
// the element's centre it has its one-sided limit to three digits.
constexpr double kInset = 1e-3;

void elementReceivers(const Mesh& mesh, Receivers& out, const CancelToken& cancel) {
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    cancel.check();
    out.area.push_back(mesh.element_area[e]);
    out.reflectance.push_back(mesh.sides[mesh.element_side[e]].reflectance);
    out.shares.push_back({mesh.element_patch[e], e, mesh.element_area[e]});
    out.start.push_back(static_cast<std::uint32_t>(out.shares.size()));
  }
}

// What a vertex has of the elements of one side around it.
struct Corner {
  std::uint32_t vertex = 0, side = 0, patch = 0;
  double area = 0;
  glm::dvec3 toward{0.0};  // the elements' centres from the vertex, times area
};

void viewsOfVertices(const Mesh& mesh, std::vector<Corner> corners, Receivers& out,
                     const CancelToken& cancel) {
  std::stable_sort(corners.begin(), corners.end(), cancel.checking([](const Corner& a, const Corner& b) {
    return std::tie(a.vertex, a.side) < std::tie(b.vertex, b.side);
  }));
  out.view_start.assign(mesh.vertices.size() + 1, 0);
  for (std::size_t k = 0; k < corners.size();) {
    Corner sum = corners[k];
    for (++k; k < corners.size() && corners[k].vertex == sum.vertex && corners[k].side == sum.side; ++k) {
      sum.area += corners[k].area;
      sum.toward += corners[k].toward;
    }
    const Surface& surface = mesh.surfaces[mesh.sides[sum.side].surface];
    // Vertices are in single precision: onto the surface itself.
    const glm::dvec3 at = surface.point(surface.chart(glm::dvec3(mesh.vertices[sum.vertex].position)));
    const double whole = out.area[sum.vertex] * 3;
    out.views.push_back({sum.area > 0 ? at + kInset / sum.area * sum.toward : at, mesh.sides[sum.side].normal,
                         whole > 0 ? sum.area / whole : 1, sum.side, sum.patch});
    ++out.view_start[sum.vertex + 1];
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) out.view_start[v + 1] += out.view_start[v];
}

// A third of each display triangle's area belongs to each of its corners (the trapezoidal rule).
void vertexReceivers(const Mesh& mesh, Receivers& out, const CancelToken& cancel) {
  const std::size_t n = mesh.vertices.size();
  out.area.assign(n, 0.0);
  std::vector<Corner> corners;
  corners.reserve(mesh.triangle_vertices.size());
  std::vector<PatchShare> shares;
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
    cancel.check();
    const std::uint32_t element = mesh.triangle_element[t], side = mesh.element_side[element];
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    const Surface& surface = mesh.surfaces[mesh.sides[side].surface];
    const glm::dvec3 p0(mesh.vertices[corner[0]].position), p1(mesh.vertices[corner[1]].position),
        p2(mesh.vertices[corner[2]].position);
    const double area = glm::length(glm::cross(p1 - p0, p2 - p0)) / 2;
    const ElementShape& shape =
        mesh.shapes[surface.elements.first + element - mesh.sides[side].first_element];
    for (int k = 0; k < 3; ++k) {
      out.area[corner[k]] += area / 3;
      const glm::dvec3 vertex = surface.point(surface.chart(glm::dvec3(mesh.vertices[corner[k]].position)));
      corners.push_back({corner[k], side, mesh.element_patch[element], area, area * (shape.centre - vertex)});
      shares.push_back({mesh.element_patch[element], corner[k], area / 3});
    }
  }
  for (const Vertex& vertex : mesh.vertices) out.reflectance.push_back(mesh.sides[vertex.side].reflectance);
  viewsOfVertices(mesh, std::move(corners), out, cancel);
  std::sort(shares.begin(), shares.end(), cancel.checking([](const PatchShare& a, const PatchShare& b) {
    return std::tie(a.receiver, a.patch) < std::tie(b.receiver, b.patch);
  }));
  for (const PatchShare& s : shares) {
    if (!out.shares.empty() && out.shares.back().receiver == s.receiver &&
        out.shares.back().patch == s.patch) {
      out.shares.back().area += s.area;
    } else {
      out.shares.push_back(s);
    }
  }
  out.start.assign(n + 1, 0);
  for (const PatchShare& s : out.shares) ++out.start[s.receiver + 1];
  for (std::size_t v = 0; v < n; ++v) out.start[v + 1] += out.start[v];
}

}  // namespace

Receivers makeReceivers(const Mesh& mesh, ReceiverKind kind, const CancelToken& cancel) {
  Receivers out;
  out.kind = kind;
  if (kind == ReceiverKind::kElements) {
    elementReceivers(mesh, out, cancel);
  } else {
    vertexReceivers(mesh, out, cancel);
  }
  return out;
}

}  // namespace unshot
