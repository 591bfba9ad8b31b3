#include "mesh/patch_lattice.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace unshot {
namespace {

// Of a rectangle's area: rounding.
constexpr double kAreaMargin = 1e-9;

std::array<double, 3> meanWeights1(std::uint32_t n) {
  if (n == 1) return {0.5, 0.5, 0};
  return {1.0 / 6, 4.0 / 6, 1.0 / 6};
}

std::array<double, 3> weightsAt1(std::uint32_t n, double t) {
  if (n == 1) return {1 - t, t, 0};
  return {(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)};
}

std::array<double, 9> product(std::uint32_t nu, std::uint32_t nv, const std::array<double, 3>& u,
                              const std::array<double, 3>& v) {
  std::array<double, 9> out{};
  for (std::uint32_t j = 0; j <= nv; ++j) {
    for (std::uint32_t i = 0; i <= nu; ++i) out[j * (nu + 1) + i] = u[i] * v[j];
  }
  return out;
}

std::optional<PatchLattice> rectangleOf(const Mesh& mesh, std::uint32_t q) {
  const Side& side = mesh.sides[mesh.patch_side[q]];
  const Surface& surface = mesh.surfaces[side.surface];
  if (mesh.joined(q)) return std::nullopt;
  const PatchShape& shape = mesh.patch_shapes[surface.patches.first + mesh.localPatch(mesh.partsOf(q)[0])];
  const Node& node = mesh.nodes[shape.node];
  PatchLattice out;
  out.nu = node.u1 - node.u0;
  out.nv = node.v1 - node.v0;
  if (!shape.whole || out.nu > 2 || out.nv > 2) return std::nullopt;
  const glm::dvec2 step = surface.extent / glm::dvec2(surface.nu, surface.nv);
  out.low = step * glm::dvec2(node.u0, node.v0);
  out.high = step * glm::dvec2(node.u1, node.v1);
  const double rectangle = (out.high.x - out.low.x) * (out.high.y - out.low.y);
  if (std::abs(mesh.patch_area[q] - rectangle) > kAreaMargin * rectangle) return std::nullopt;
  out.vertex.fill(kNone);
  return out;
}

}  // namespace

std::array<double, 9> PatchLattice::meanWeights() const {
  return product(nu, nv, meanWeights1(nu), meanWeights1(nv));
}

std::array<double, 9> PatchLattice::weightsAt(const glm::dvec2& uv) const {
  const glm::dvec2 t = glm::clamp((uv - low) / (high - low), 0.0, 1.0);
  return product(nu, nv, weightsAt1(nu, t.x), weightsAt1(nv, t.y));
}

std::vector<std::optional<PatchLattice>> patchLattices(const Mesh& mesh, const CancelToken& cancel) {
  std::vector<std::optional<PatchLattice>> out;
  out.reserve(mesh.patch_count);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    cancel.check();
    out.push_back(rectangleOf(mesh, q));
  }
  for (std::size_t k = 0; k < mesh.triangle_vertices.size(); ++k) {
    const std::uint32_t element = mesh.triangle_element[k / 3], vertex = mesh.triangle_vertices[k];
    std::optional<PatchLattice>& lattice = out[mesh.element_patch[element]];
    if (!lattice) continue;
    const Surface& surface = mesh.surfaces[mesh.sides[mesh.element_side[element]].surface];
    const glm::dvec2 size = lattice->high - lattice->low, n(lattice->nu, lattice->nv);
    const glm::dvec2 t =
        (surface.chart(glm::dvec3(mesh.vertices[vertex].position)) - lattice->low) / size * n;
    const glm::dvec2 corner = glm::clamp(glm::round(t), glm::dvec2(0.0), n);
    if (glm::length((t - corner) / n * size) > 2 * mesh.weld_distance) continue;
    lattice->vertex[static_cast<std::size_t>(corner.y) * (lattice->nu + 1) +
                    static_cast<std::size_t>(corner.x)] = vertex;
  }
  for (std::optional<PatchLattice>& lattice : out) {
    if (!lattice) continue;
    const auto end = lattice->vertex.begin() + lattice->size();
    if (std::find(lattice->vertex.begin(), end, kNone) != end) lattice.reset();
  }
  return out;
}

}  // namespace unshot
