// What is picked in the scene, and the probes that are pinned: points that stay where they are while the
// light changes, placed anew when the mesh does.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "export/probes.h"
#include "session/pick.h"
#include "session/session.h"

namespace unshot {

/// The point that was picked, on the present mesh.
struct PickedPoint {
  Pick pick;
  Probe probe;  ///< the same point in the file's coordinates
  std::optional<ProbePlace> place;
  std::vector<std::uint32_t> elements;                   ///< of its patch
  std::vector<std::pair<glm::vec3, glm::vec3>> outline;  ///< of its patch
  std::vector<PickedDecision> decisions;
};

struct PinnedProbe {
  Probe probe;
  std::string material;
  std::optional<ProbePlace> place;
};

/// A quantity at the picked point: its name and symbol, its unit, what it is.
struct PickedQuantity {
  std::string_view title, unit, tip;
  bool one_channel = false;  ///< all three are the same
  /// Nothing where it is not known.
  std::optional<glm::dvec3> (*of)(const PickedPoint& point, const Snapshot& snapshot);
};
std::span<const PickedQuantity> pickedQuantities();

/// Of a probe that is pinned [W/m^2]: B and H. Nothing where it has no place.
std::optional<glm::dvec3> radiosityAt(const std::optional<ProbePlace>& place, const Snapshot& snapshot);
std::optional<glm::dvec3> irradianceAt(const std::optional<ProbePlace>& place, const Snapshot& snapshot);

/// "no. 12, front".
std::string surfaceText(const Pick& pick);
/// "1.5, 0, 2.25", in the file's coordinates.
std::string positionText(const glm::dvec3& position);

/// All of one thread.
class Picking {
 public:
  /// Picks what the state's mesh has along the ray (in its frame; `direction` of unit length); nothing is
  /// picked where there is nothing.
  void pick(const LaneState& state, const glm::dvec3& from, const glm::dvec3& direction);
  void unpick() { picked_.reset(); }
  const std::optional<PickedPoint>& picked() const { return picked_; }
  /// Throws Error (kUsage) where nothing is.
  const PickedPoint& required() const;

  /// Pins what is picked. Throws Error (kUsage) where nothing is.
  void pin(const LaneState& state);
  /// Throws Error (kUsage) where there are not so many. From 0 on.
  void unpin(std::size_t number);
  void clearProbes() { pinned_.clear(); }
  const std::vector<PinnedProbe>& pinned() const { return pinned_; }

  /// To be called with each new state: the same points on another mesh of the scene, none of another scene.
  void follow(const LaneState& state);

  /// The probes with their B, as `unshot solve --probe-out` writes them. Throws Error (kUsage) where none is
  /// pinned.
  std::string csv(const LaneState& state) const;
  /// What is picked, a quantity a line, with tabs. Throws Error (kUsage) where nothing is.
  std::string text(const LaneState& state) const;

 private:
  void place(const LaneState& state);

  std::optional<PickedPoint> picked_;
  glm::dvec3 from_{0.0}, direction_{0.0};  // in the file's coordinates
  std::vector<PinnedProbe> pinned_;
  // What the points are placed on.
  std::uint64_t cut_ = 0;  // of the mesh
  std::shared_ptr<const SolveFacts> facts_;
};

}  // namespace unshot
