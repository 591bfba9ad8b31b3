#include "formfactor/receivers.h"

#include <algorithm>
#include <glm/geometric.hpp>

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

// A third of each display triangle's area belongs to each of its corners (the trapezoidal rule).
void vertexReceivers(const Mesh& mesh, Receivers& out, const CancelToken& cancel) {
  const std::size_t n = mesh.vertices.size();
  out.area.assign(n, 0.0);
  std::vector<glm::dvec3> toward(n, glm::dvec3(0.0));
  std::vector<PatchShare> shares;
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
    cancel.check();
    const std::uint32_t element = mesh.triangle_element[t];
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    const Surface& surface = mesh.surfaces[mesh.sides[mesh.element_side[element]].surface];
    const glm::dvec3 p0(mesh.vertices[corner[0]].position), p1(mesh.vertices[corner[1]].position),
        p2(mesh.vertices[corner[2]].position);
    const double area = glm::length(glm::cross(p1 - p0, p2 - p0)) / 2;
    const ElementShape& shape =
        mesh.shapes[surface.elements.first + element - mesh.sides[mesh.element_side[element]].first_element];
    for (int k = 0; k < 3; ++k) {
      out.area[corner[k]] += area / 3;
      toward[corner[k]] += area * (shape.centre - glm::dvec3(mesh.vertices[corner[k]].position));
      shares.push_back({mesh.element_patch[element], corner[k], area / 3});
    }
  }
  for (std::size_t v = 0; v < n; ++v) {
    const Vertex& vertex = mesh.vertices[v];
    out.reflectance.push_back(mesh.sides[vertex.side].reflectance);
    const double weight = 3 * out.area[v];
    out.position.push_back(glm::dvec3(vertex.position) +
                           (weight > 0 ? kInset / weight * toward[v] : glm::dvec3(0.0)));
    out.normal.push_back(glm::normalize(glm::dvec3(vertex.normal)));
  }
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
