#include "viewer/value_probe.h"

#include <span>
#include <vector>

#include "base/colour.h"
#include "export/probes.h"
#include "session/pick.h"

namespace unshot {
namespace {

// Every one is looked at, twice.
constexpr std::size_t kMostTriangles = 600'000;

using Field = std::shared_ptr<const std::vector<glm::vec3>>;

std::optional<double> valueAlong(const ValueProbe::Look& look) {
  const Snapshot& s = *look.snapshot;
  const Mesh& mesh = *s.mesh;
  if (mesh.triangles.size() + mesh.triangle_element.size() > kMostTriangles) return std::nullopt;
  const std::optional<Pick> pick = pickAlong(mesh, look.from, look.along);
  if (!pick || pick->side == kNone) return std::nullopt;
  const Probe probe{pick->position + mesh.frame_origin, pick->normal};
  const std::optional<ProbePlace> place = placeProbes(mesh, std::span(&probe, 1)).front();
  if (!place) return std::nullopt;
  const auto of = [&](auto&& at) { return std::optional(luminance(place->value(at))); };
  const auto ofField = [&](const Field& field) {
    return field ? of([&](std::uint32_t v) { return (*field)[v]; }) : std::nullopt;
  };
  switch (look.quantity) {
    case Quantity::kRadiosity:
      return of([&](std::uint32_t v) { return radiosity(s, v, look.ambient); });
    case Quantity::kIrradiance:
      return of([&](std::uint32_t v) {
        return glm::dvec3(s.irradiance[v]) + (look.ambient ? glm::dvec3(s.ambient[v]) : glm::dvec3(0.0));
      });
    case Quantity::kUnshot:
      return of([&](std::uint32_t v) { return s.unshot[v]; });
    case Quantity::kBounces:
      return ofField(s.bounces);
    case Quantity::kResidual:
      return ofField(s.residual);
    default:
      return std::nullopt;
  }
}

}  // namespace

bool ValueProbe::reads(Quantity quantity) {
  return quantity == Quantity::kRadiosity || quantity == Quantity::kIrradiance ||
         quantity == Quantity::kUnshot || quantity == Quantity::kBounces || quantity == Quantity::kResidual;
}

void ValueProbe::look(const Look& look) {
  if (looked_ == look) return;
  looked_ = look;
  value_ = valueAlong(look);
}

void ValueProbe::rest() {
  looked_.reset();
  value_.reset();
}

}  // namespace unshot
