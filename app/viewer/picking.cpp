#include "viewer/picking.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/text.h"

namespace unshot {
namespace {

using Value = std::optional<glm::dvec3>;

/// A field of one value a vertex; null: it is not known.
Value fieldAt(const PickedPoint& point, const std::shared_ptr<const std::vector<glm::vec3>>& field) {
  if (!field || !point.place) return std::nullopt;
  return point.place->value([&](std::uint32_t v) { return (*field)[v]; });
}

const Material& materialOf(const PickedPoint& point, const Mesh& mesh) {
  return mesh.materials[mesh.surfaces[point.pick.surface].material];
}

Value reflectance(const PickedPoint& point, const Snapshot& s) {
  const std::uint32_t side = point.pick.side;
  return side != kNone ? s.mesh->sides[side].reflectance : materialOf(point, *s.mesh).reflectance;
}

Value emission(const PickedPoint& point, const Snapshot& s) {
  const std::uint32_t side = point.pick.side;
  return side != kNone ? s.mesh->sides[side].emission : glm::dvec3(0.0);
}

Value radiosityOf(const PickedPoint& point, const Snapshot& s) { return radiosityAt(point.place, s); }
Value irradianceOf(const PickedPoint& point, const Snapshot& s) { return irradianceAt(point.place, s); }
Value directOf(const PickedPoint& point, const Snapshot& s) { return fieldAt(point, s.direct); }

Value unshotOf(const PickedPoint& point, const Snapshot& s) {
  if (!point.place) return std::nullopt;
  return point.place->value([&](std::uint32_t v) { return s.unshot[v]; });
}

Value powerOf(const PickedPoint& point, const Snapshot& s) {
  if (point.pick.patch == kNone) return std::nullopt;
  const Side& side = s.mesh->sides[point.pick.side];
  glm::dvec3 sum(0.0);
  for (const std::uint32_t e : point.elements)
    sum += s.mesh->element_area[e] * (side.emission + side.reflectance * glm::dvec3(s.element_irradiance[e]));
  return sum;
}

Value bouncesOf(const PickedPoint& point, const Snapshot& s) { return fieldAt(point, s.bounces); }
Value residualOf(const PickedPoint& point, const Snapshot& s) {
  const Value value = fieldAt(point, s.residual);
  return value && value->x > 0 ? value : std::nullopt;  // not looked at there
}

Value rowSumOf(const PickedPoint& point, const Snapshot& s) { return fieldAt(point, s.row_sums); }

constexpr std::string_view kLight = "W/m\u00b2";

constexpr std::array kQuantities = {
    PickedQuantity{"Reflectance \u03c1", "",
                   "Part of the light received that is reflected, 0 to 1 (Kd of the material)", false,
                   reflectance},
    PickedQuantity{"Emission E", kLight,
                   "Radiosity that the surface has of itself (Ke of the material) [W/m\u00b2]", false,
                   emission},
    PickedQuantity{"Radiosity B", kLight,
                   "B = E + \u03c1 H [W/m\u00b2]: all light that leaves this point, interpolated between "
                   "vertices, without the ambient term. The value that probes have",
                   false, radiosityOf},
    PickedQuantity{
        "Irradiance H", kLight,
        "H = K S [W/m\u00b2]: light received here of all that was shot so far, interpolated between "
        "vertices",
        false, irradianceOf},
    PickedQuantity{"Direct", kLight,
                   "The part of H that came straight from lamps [W/m\u00b2]; the rest is indirect", false,
                   directOf},
    PickedQuantity{
        "Unshot U", kLight,
        "U = R B \u2212 S [W/m\u00b2]: what the patch has of radiosity, its mean R B, and has not shot "
        "yet; interpolated between patches",
        false, unshotOf},
    PickedQuantity{"Power [W]", "W",
                   "\u2211 A B over the elements of the patch [W], A their areas: all light that leaves it",
                   false, powerOf},
    PickedQuantity{
        "Bounces", "",
        "Expected bounces: how many surfaces light that leaves here meets, this one included; v in "
        "(I \u2212 M) v = 1",
        false, bouncesOf},
    PickedQuantity{
        "Residual", kLight,
        "By how much the light of the patch misses B = E + \u03c1 K B where that is looked at off the "
        "mesh (RMS over channels) [W/m\u00b2]",
        true, residualOf},
    PickedQuantity{"Row sum of K", "",
                   "\u2211 K over the patches that have light and the sky, K their form factors G as this "
                   "point has them, "
                   "closed where the scene is: the part of what this point sees "
                   "that is lit, 1 where "
                   "nothing escapes. Known at rest, once their form factors are at hand (below Bounces, "
                   "those missing are "
                   "computed)",
                   true, rowSumOf},
};

std::string numbers(const glm::dvec3& v) {
  return numberText(v.x) + "\t" + numberText(v.y) + "\t" + numberText(v.z);
}

}  // namespace

std::span<const PickedQuantity> pickedQuantities() { return kQuantities; }

std::optional<glm::dvec3> radiosityAt(const std::optional<ProbePlace>& place, const Snapshot& snapshot) {
  if (!place) return std::nullopt;
  return place->value([&](std::uint32_t v) { return radiosity(snapshot, v, false); });
}

std::optional<glm::dvec3> irradianceAt(const std::optional<ProbePlace>& place, const Snapshot& snapshot) {
  if (!place) return std::nullopt;
  return place->value([&](std::uint32_t v) { return snapshot.irradiance[v]; });
}

std::string surfaceText(const Pick& pick) {
  return "no. " + std::to_string(pick.surface) + (pick.back ? ", back" : ", front");
}

std::string positionText(const glm::dvec3& position) {
  char text[96];
  std::snprintf(text, sizeof text, "%.4g, %.4g, %.4g", position.x, position.y, position.z);
  return text;
}

namespace {

/// The point in so few digits as it takes to lie on its surface still, for people and files: to 1e-8 of the
/// scene's size.
glm::dvec3 rounded(const glm::dvec3& point, const Mesh& mesh) {
  const double size = glm::length(mesh.bounds_max - mesh.bounds_min);
  if (!(size > 0) || !std::isfinite(size)) return point;
  const double steps = std::pow(10.0, std::ceil(8 - std::log10(size)));
  return glm::round(point * steps) / steps + 0.0;  // no -0
}

}  // namespace

void Picking::pick(const LaneState& state, const glm::dvec3& from, const glm::dvec3& direction) {
  picked_.reset();
  if (!state.snapshot) return;
  from_ = from + state.snapshot->mesh->frame_origin;
  direction_ = direction;
  picked_.emplace();
  place(state);
}

const PickedPoint& Picking::required() const {
  if (!picked_)
    throw Error(ErrorKind::kUsage, "nothing is picked", {}, "click a surface, or the action pick X,Y");
  return *picked_;
}

void Picking::pin(const LaneState& state) {
  const PickedPoint& point = required();
  pinned_.push_back({point.probe, materialOf(point, *state.snapshot->mesh).name, point.place});
}

void Picking::unpin(std::size_t number) {
  if (number >= pinned_.size()) {
    throw Error(ErrorKind::kUsage, "there is no probe " + std::to_string(number + 1), {},
                std::to_string(pinned_.size()) + " are pinned");
  }
  pinned_.erase(pinned_.begin() + static_cast<std::ptrdiff_t>(number));
}

void Picking::follow(const LaneState& state) {
  if (!state.snapshot || !state.facts) return;
  if (facts_ && facts_->scene_path != state.facts->scene_path) {
    picked_.reset();
    pinned_.clear();
  }
  const Mesh& mesh = *state.snapshot->mesh;
  const bool another_cut = std::exchange(cut_, mesh.cut) != mesh.cut;
  const bool other_facts = std::exchange(facts_, state.facts) != state.facts;
  if (picked_ && another_cut) {
    place(state);
  } else if (picked_ && other_facts) {
    picked_->decisions = decisionsFor(mesh, picked_->pick, facts_->plan);
  }
  if (!another_cut || pinned_.empty()) return;
  std::vector<Probe> probes;
  for (const PinnedProbe& pinned : pinned_) probes.push_back(pinned.probe);
  const std::vector<std::optional<ProbePlace>> places = placeProbes(mesh, probes);
  for (std::size_t k = 0; k < pinned_.size(); ++k) pinned_[k].place = places[k];
}

/// What is picked, on the state's mesh.
void Picking::place(const LaneState& state) {
  const Mesh& mesh = *state.snapshot->mesh;
  const std::optional<Pick> found = pickAlong(mesh, from_ - mesh.frame_origin, direction_);
  if (!found) {
    picked_.reset();
    return;
  }
  PickedPoint& point = *picked_;
  point.pick = *found;
  point.probe = {rounded(found->position + mesh.frame_origin, mesh), found->normal};
  point.place = placeProbes(mesh, std::span(&point.probe, 1)).front();
  point.elements.clear();
  point.outline.clear();
  if (found->patch != kNone) {
    point.elements = elementsOf(mesh, found->patch);
    point.outline = patchOutline(mesh, found->patch);
  }
  point.decisions = decisionsFor(mesh, *found, state.facts->plan);
}

std::string Picking::csv(const LaneState& state) const {
  if (pinned_.empty())
    throw Error(ErrorKind::kUsage, "no probe is pinned", {}, "pick a point, then P or the action pin-probe");
  std::vector<Probe> probes;
  for (const PinnedProbe& pinned : pinned_) probes.push_back(pinned.probe);
  return probeCsv(probes, answerProbes(*state.snapshot, probes, false));
}

std::string Picking::text(const LaneState& state) const {
  const PickedPoint& point = required();
  const Snapshot& snapshot = *state.snapshot;
  const auto row = [](std::string_view title, std::string_view unit, const std::string& values) {
    return std::string(title) + (unit.empty() ? "" : " [" + std::string(unit) + "]") + "\t" + values + "\n";
  };
  std::string out = row("Surface", "", surfaceText(point.pick));
  out += row("Line in the file", "", std::to_string((*state.facts->surface_lines)[point.pick.surface]));
  out += row("Material", "", materialOf(point, *snapshot.mesh).name);
  out += row("Position", "", numbers(point.probe.position));
  out += row("Normal", "", numbers(point.probe.normal));
  if (point.pick.element != kNone) {
    out += row("Element", "", std::to_string(point.pick.element));
    out += row("Patch", "", std::to_string(point.pick.patch));
    out += row("Area of element", "m\u00b2", numberText(snapshot.mesh->element_area[point.pick.element]));
    out += row("Area of patch", "m\u00b2", numberText(snapshot.mesh->patch_area[point.pick.patch]));
  }
  for (const PickedQuantity& quantity : kQuantities) {
    const Value value = quantity.of(point, snapshot);
    if (value)
      out +=
          row(quantity.title, quantity.unit, quantity.one_channel ? numberText(value->x) : numbers(*value));
  }
  for (const PickedDecision& decision : point.decisions) out += row("Plan", "", decision.text);
  return out;
}

}  // namespace unshot
