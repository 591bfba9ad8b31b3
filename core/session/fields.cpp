#include "session/fields.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "session/linear_fit.h"

namespace unshot {
namespace {

// Values of elements, interpolated at the mesh's vertices. `at(e)` is element e's value.
template <class F>
std::vector<glm::vec3> atVertices(const Mesh& mesh, F&& at) {
  const SparseRows& rows = mesh.vertex_from_elements;
  std::vector<glm::vec3> out(mesh.vertices.size());
  for (std::size_t v = 0; v < out.size(); ++v) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t k = rows.start[v]; k < rows.start[v + 1]; ++k) {
      sum += static_cast<double>(rows.weight[k]) * at(rows.index[k]);
    }
    out[v] = glm::vec3(sum);
  }
  return out;
}

}  // namespace

std::vector<glm::vec3> meanOverElements(const Mesh& mesh, const std::vector<glm::dvec3>& field) {
  std::vector<glm::dvec3> sum(mesh.element_count, glm::dvec3(0.0));
  std::vector<double> area(mesh.element_count, 0.0);
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    const glm::dvec3 p0(mesh.vertices[corner[0]].position), p1(mesh.vertices[corner[1]].position),
        p2(mesh.vertices[corner[2]].position);
    const double a = glm::length(glm::cross(p1 - p0, p2 - p0)) / 2;
    area[mesh.triangle_element[t]] += a;
    sum[mesh.triangle_element[t]] += a / 3 * (field[corner[0]] + field[corner[1]] + field[corner[2]]);
  }
  std::vector<glm::vec3> out(mesh.element_count);
  for (std::size_t e = 0; e < out.size(); ++e)
    out[e] = area[e] > 0 ? glm::vec3(sum[e] / area[e]) : glm::vec3(0.0f);
  return out;
}

MeshField makeField(const Mesh& mesh, const Receivers& receivers, const std::vector<glm::dvec3>& values) {
  if (receivers.kind == ReceiverKind::kElements)
    return {atVertices(mesh, [&](std::uint32_t e) { return values[e]; }), {values.begin(), values.end()}};
  if (!mesh.for_error) return {{values.begin(), values.end()}, meanOverElements(mesh, values)};
  std::vector<glm::dvec3> shown;
  shown.reserve(receivers.shownCount());
  for (std::uint32_t v = 0; v < receivers.shownCount(); ++v) shown.push_back(receivers.shown(v, values));
  shown = fitBetween(mesh, std::move(shown));
  return {{shown.begin(), shown.end()}, meanOverElements(mesh, shown)};
}

std::vector<glm::vec3> fieldOfPatches(const Mesh& mesh, const std::vector<glm::dvec3>& values) {
  return atVertices(mesh, [&](std::uint32_t e) { return values[mesh.element_patch[e]]; });
}

Snapshot makeFields(std::shared_ptr<const Mesh> mesh_in, MeshField irradiance, const RadiosityState& state,
                    const AmbientTerm& ambient) {
  Snapshot out;
  out.mesh = std::move(mesh_in);
  const Mesh& mesh = *out.mesh;
  out.irradiance = std::move(irradiance.vertices);
  out.element_irradiance = std::move(irradiance.elements);
  const std::vector<glm::dvec3> estimate = ambient.values(state);
  out.ambient = atVertices(mesh, [&](std::uint32_t e) { return estimate[mesh.element_patch[e]]; });
  out.unshot = atVertices(mesh, [&](std::uint32_t e) { return state.unshot()[mesh.element_patch[e]]; });
  return out;
}

void SharedFields::addTo(Snapshot& out, const Transport& transport, const RadiosityState& state,
                         const ErrorBounds& bounds) {
  const auto shared = [](std::vector<glm::vec3> field) {
    return std::make_shared<const std::vector<glm::vec3>>(std::move(field));
  };
  if (!direct_ || emission_shots_ != state.emissionShots()) {
    MeshField direct = makeField(*out.mesh, transport.receivers(), state.direct());
    direct_ = shared(std::move(direct.vertices));
    element_direct_ = shared(std::move(direct.elements));
    emission_shots_ = state.emissionShots();
  }
  if (bounces_revision_ != bounds.revision()) {
    const std::vector<glm::dvec3>& v = bounds.expectedBounces();
    bounces_ = v.empty() ? nullptr : shared(fieldOfPatches(*out.mesh, v));
    bounces_revision_ = bounds.revision();
  }
  out.direct = direct_;
  out.element_direct = element_direct_;
  out.bounces = bounces_;
  out.residual = residual_;
  out.row_sums = row_sums_;
}

bool SharedFields::sumRows(const Mesh& mesh, const Transport& transport, const RadiosityState& state) {
  for (std::uint32_t q = 0; q < transport.patchCount(); ++q) {
    const bool dark = state.shot()[q] == glm::dvec3(0.0) && state.unshot()[q] == glm::dvec3(0.0);
    if (!dark && !transport.isKept(q)) return false;
  }
  const SummedColumns columns{transport.keptColumns(), transport.replaced(),
                              !transport.closure().scale.empty()};
  if (row_sums_ && summed_ == columns) return false;
  summed_ = columns;
  std::vector<glm::dvec3> sums(transport.receiverCount(), glm::dvec3(0.0));
  for (std::uint32_t q = 0; q < transport.patchCount(); ++q) {
    if (transport.isKept(q)) transport.kept(q)->forEach([&](std::uint32_t v, double k) { sums[v] += k; });
  }
  row_sums_ =
      std::make_shared<const std::vector<glm::vec3>>(makeField(mesh, transport.receivers(), sums).vertices);
  return true;
}

void SharedFields::setResidual(const Mesh& mesh, const std::vector<double>& per_patch) {
  if (per_patch.empty()) return;
  std::vector<glm::dvec3> values;
  for (const double r : per_patch) values.emplace_back(r);
  residual_ = std::make_shared<const std::vector<glm::vec3>>(fieldOfPatches(mesh, values));
}

}  // namespace unshot
