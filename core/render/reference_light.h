// Light that a picture is compared with: what the display mode `difference` is the difference from.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/snapshot.h"

namespace unshot {

/// Which of a snapshot's light is meant.
struct LightChoice {
  /// All light. Without it only what comes straight from emitters, B = E + rho H_d.
  bool indirect = true;
  /// Only the light of so many bounces, or as many as are known (Snapshot::bounce_light); all light where
  /// none are. Ignored without `indirect`.
  std::optional<std::uint32_t> bounces;
  /// Of these bounces the last one by itself, B_n - B_(n-1), without the light that is emitted.
  bool alone = false;

  /// Whether that is what is meant.
  bool oneBounce() const { return indirect && bounces && alone; }
  bool all() const { return indirect && !bounces; }
  bool operator==(const LightChoice&) const = default;
};

/// The irradiance that is meant, without an ambient term; what a snapshot does not have counts as 0, bounces
/// that it does not know as all light.
struct ChosenLight {
  const std::vector<glm::vec3>* vertices = nullptr;  ///< [W/m^2], one per vertex; null: 0
  const std::vector<glm::vec3>* elements = nullptr;  ///< [W/m^2], one per element; null: 0
  std::shared_ptr<const MeshField> bounces;          ///< what these are of, where they are of bounces
};
ChosenLight chosenLight(const Snapshot& snapshot, const LightChoice& choice);

/// The bounces of the choice, or as many as are known where that are fewer; null for all light, direct light,
/// or where not. Of one bounce alone the difference of two sums, worked out anew.
std::shared_ptr<const MeshField> bounceField(const std::shared_ptr<const BounceLight>& light,
                                             const LightChoice& choice);

struct ReferenceLight {
  std::shared_ptr<const Mesh> mesh;  ///< that it belongs to
  std::string name;                  ///< such as "the state at 120 shots"
  std::vector<glm::vec3> reflected;  ///< B - E, one per vertex [W/m^2]
  double mean = 0;                   ///< luminance of B - E, area mean over sides that do not emit [W/m^2]
};

/// What is chosen of a snapshot, to be compared with later.
ReferenceLight referenceLight(const Snapshot& snapshot, const LightChoice& choice, std::string name);

/// Radiosity B [W/m^2] that was found elsewhere, one per vertex of the mesh.
ReferenceLight referenceLight(std::shared_ptr<const Mesh> mesh, const std::vector<glm::dvec3>& radiosity,
                              std::string name);

/// The colour, linear, of a relative difference on the scale of the display mode `difference`: logarithmic,
/// from dark grey at kLeastDifference to pale at 1; brighter than the reference is orange, darker blue. The
/// same as in shaders/difference.glsl.
glm::dvec3 differenceColour(double relative);
inline constexpr double kLeastDifference = 1e-3;

}  // namespace unshot
