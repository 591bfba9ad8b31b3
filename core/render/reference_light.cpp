#include "render/reference_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/colour.h"

namespace unshot {
namespace {

double areaOf(const Mesh& mesh, std::size_t triangle) {
  const std::uint32_t* corner = &mesh.triangle_vertices[3 * triangle];
  const glm::dvec3 a(mesh.vertices[corner[0]].position), b(mesh.vertices[corner[1]].position),
      c(mesh.vertices[corner[2]].position);
  return glm::length(glm::cross(b - a, c - a)) / 2;
}

double meanOf(const Mesh& mesh, const std::vector<glm::vec3>& reflected) {
  double sum = 0, area = 0;
  for (std::size_t t = 0; t < mesh.triangle_vertices.size() / 3; ++t) {
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    if (mesh.sides[mesh.vertices[corner[0]].side].emission != glm::dvec3(0.0)) continue;
    const double a = areaOf(mesh, t);
    for (int k = 0; k < 3; ++k) sum += a / 3 * luminance(glm::dvec3(reflected[corner[k]]));
    area += a;
  }
  return area > 0 ? sum / area : 0;
}

std::vector<glm::vec3> minus(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  std::vector<glm::vec3> out(a);
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) out[k] -= b[k];
  return out;
}

}  // namespace

std::shared_ptr<const MeshField> bounceField(const std::shared_ptr<const BounceLight>& light,
                                             const LightChoice& choice) {
  if (!light || !choice.indirect || !choice.bounces || *choice.bounces == 0) return nullptr;
  const std::size_t known = std::min<std::size_t>(*choice.bounces, light->received.size());
  if (known == 0) return nullptr;
  const std::shared_ptr<const MeshField>& sum = light->received[known - 1];
  if (!choice.alone || known == 1) return sum;
  const MeshField& before = *light->received[known - 2];
  return std::make_shared<const MeshField>(
      MeshField{minus(sum->vertices, before.vertices), minus(sum->elements, before.elements)});
}

ChosenLight chosenLight(const Snapshot& snapshot, const LightChoice& choice) {
  if (!choice.indirect) return {snapshot.direct.get(), snapshot.element_direct.get(), nullptr};
  if (const auto field = bounceField(snapshot.bounce_light, choice))
    return {&field->vertices, &field->elements, field};
  return {&snapshot.irradiance, &snapshot.element_irradiance, nullptr};
}

ReferenceLight referenceLight(const Snapshot& snapshot, const LightChoice& choice, std::string name) {
  ReferenceLight out{snapshot.mesh, std::move(name), {}, 0};
  const Mesh& mesh = *snapshot.mesh;
  const ChosenLight light = chosenLight(snapshot, choice);
  out.reflected.assign(mesh.vertices.size(), glm::vec3(0.0f));
  const std::size_t given = light.vertices ? std::min(light.vertices->size(), out.reflected.size()) : 0;
  for (std::size_t v = 0; v < given; ++v)
    out.reflected[v] = glm::vec3(mesh.sides[mesh.vertices[v].side].reflectance) * (*light.vertices)[v];
  out.mean = meanOf(mesh, out.reflected);
  return out;
}

ReferenceLight referenceLight(std::shared_ptr<const Mesh> mesh, const std::vector<glm::dvec3>& radiosity,
                              std::string name) {
  ReferenceLight out{std::move(mesh), std::move(name), {}, 0};
  out.reflected.reserve(radiosity.size());
  for (std::size_t v = 0; v < radiosity.size(); ++v)
    out.reflected.emplace_back(radiosity[v] - out.mesh->sides[out.mesh->vertices[v].side].emission);
  out.mean = meanOf(*out.mesh, out.reflected);
  return out;
}

glm::dvec3 differenceColour(double relative) {
  const double decades = std::clamp(3 + std::log10(std::max(std::abs(relative), 1e-30)), 0.0, 3.0);
  const bool brighter = relative > 0;
  const glm::dvec3 dark = brighter ? glm::dvec3(0.22, 0.05, 0.01) : glm::dvec3(0.01, 0.06, 0.26);
  const glm::dvec3 full = brighter ? glm::dvec3(0.95, 0.30, 0.02) : glm::dvec3(0.04, 0.30, 1.0);
  const glm::dvec3 pale = brighter ? glm::dvec3(1.0, 0.92, 0.55) : glm::dvec3(0.68, 0.93, 1.0);
  if (decades < 1) return glm::mix(glm::dvec3(0.03), dark, decades);
  return decades < 2 ? glm::mix(dark, full, decades - 1) : glm::mix(full, pale, decades - 2);
}

}  // namespace unshot
