// The plan: what a solve leaves out because this scene does not need it (law 7). One place decides, says why,
// and what it saves; each decision can be switched off by its key.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/choice.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "session/residuals.h"

namespace unshot {

/// What may be left out.
struct PlanRow {
  ChoiceInfo info;
  /// How sure it is that the result is the same.
  std::string_view sure;
};

std::span<const PlanRow> planRows();

namespace plan_keys {
inline constexpr std::string_view kOuterSides = "outer-sides";
inline constexpr std::string_view kDarkSides = "dark-sides";
inline constexpr std::string_view kTriangles = "triangles";
inline constexpr std::string_view kOcclusion = "occlusion";
inline constexpr std::string_view kOccluders = "occluders";
inline constexpr std::string_view kEscape = "escape";
inline constexpr std::string_view kHemicubes = "hemicubes";
inline constexpr std::string_view kEvenLight = "even-light";
inline constexpr std::string_view kFineness = "fineness";
inline constexpr std::string_view kChannels = "channels";
inline constexpr std::string_view kShots = "shots";
inline constexpr std::string_view kShooters = "shooters";
}  // namespace plan_keys

/// Keys of what is done all the same.
using DoAnyway = std::vector<std::string>;

/// All keys but that of the shooters: what a solve prepares, not how far it iterates.
DoAnyway doAll();
/// Keys from a list with commas; throws a usage Error for one that is not in the table.
DoAnyway doAnyway(std::string_view list);
/// Whether all keys are among them.
bool doesAll(const DoAnyway& done);
bool leavesOut(const DoAnyway& done, std::string_view key);

/// Something that a solve leaves out, with the fact that it was decided by.
struct PlanDecision {
  std::string key;  ///< of its row
  std::string what;
  std::string why;
  std::string saving;
  /// nRMSE of reflected light that it may cost; 0: none but rounding.
  double bound = 0;
  /// Where it is of some patches alone: which, in order.
  std::vector<std::uint32_t> patches = {};

  std::string_view sure() const;  ///< of its row
  bool operator==(const PlanDecision&) const = default;
};

/// What is known when all but the first shot is done.
struct PlannedSolve {
  const Scene& scene;
  const Mesh& mesh;
  std::string_view form_factors;  ///< key of the method
  double error = 0.01;            ///< asked for
  bool emit_front_only = false;
  glm::dvec3 sky{0.0};  ///< its radiosity [W/m^2]
  const DoAnyway& done;
};

/// The decisions that hold for it.
std::vector<PlanDecision> makePlan(const PlannedSolve& solve);
/// That rays stand in for hemicubes.
PlanDecision withoutHemicubes(const Mesh& mesh, double error);
/// That a coarse mesh does, of which the error is estimated to be this, in place of one of `usual` elements.
PlanDecision withoutFineness(const Mesh& mesh, double error, const ErrorEstimate& found, double usual);
/// That the mesh follows the light.
PlanDecision withoutEvenLight(const Mesh& mesh, double error);
/// That bounces among patches whose columns are at hand, so many of `patches`, are summed before they are
/// sent.
PlanDecision withoutShots(std::size_t at_hand, std::size_t patches, double error);
/// That all bounces are solved for together, as this share of the light that meets a surface is reflected.
PlanDecision withoutAnyShots(std::size_t patches, double reflected, double error);
/// Of a solve that has converged: of so many patches these had to send nothing, of which so many are black,
/// and what was left unshot is this share of what was emitted.
struct IdleShooters {
  std::size_t patches = 0;
  std::vector<std::uint32_t> idle = {};  ///< in order
  std::size_t black = 0;
  double unshot_fraction = 0;
};
/// That these did not shoot; `error`: that was asked for.
PlanDecision withoutShooters(IdleShooters shooters, double error);

}  // namespace unshot
