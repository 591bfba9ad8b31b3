// What surfaces keep apart: the places of a scene between which no light can pass.
//
// Around an edge the sides that face the same wedge of air belong together; followed from edge to edge they
// make shells. The surfaces that have one side in a shell and the other in another are, mod 2, a surface
// without a border, whatever passes through what: at each edge shells alternate from wedge to wedge. So a
// line from one point to another that meets it an odd number of times goes from its inside to its outside,
// and light, which passes through no surface, stays where its crossings are even (Jordan and Brouwer). A
// place is told by the shells that it is inside of.
//
// What stands on another surface without a bottom of its own is closed by that one, where its free edges lie
// within it, alone.
//
// On the safe side throughout: another edge at which a surface ends alone (a crack, a missing wall) joins its
// two sides, a surface that another passes through has its sides joined with that one's, surfaces that lie on
// each other are joined too. What is nearer than the weld distance touches.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "mesh/contacts.h"
#include "mesh/mesh.h"
#include "mesh/surfaces.h"

namespace unshot {

class Shells {
 public:
  /// A set of shells, as the sum mod 2 of random numbers of theirs: two of some thousand sets are alike by
  /// chance once in 1e12 scenes.
  using Place = std::uint64_t;
  static constexpr Place kOutside = 0;  ///< inside of none

  /// Keeps references to mesh, edges and `cancel`. `edges`: all edges of the scene's polygons, equal ones
  /// side by side; `touches`: among them those that lie on surfaces.
  Shells(const Mesh& mesh, const std::vector<SurfaceEdge>& edges, std::span<const Crossing> crossings,
         std::span<const Touch> touches, double weld_distance, const CancelToken& cancel);
  ~Shells();

  /// Whether there are several places.
  bool separate();
  /// Shell of side 2 s (front of surface s) or 2 s + 1 (its back).
  std::uint32_t of(std::uint32_t side);
  /// Where a point of the side is, moved `off` [m] along its normal. Nothing where
  /// that cannot be told, such as on a surface.
  std::optional<Place> placeOf(std::uint32_t side, double off);

 private:
  class Lines;
  void joinAtEdges();
  void joinAround(std::span<const SurfaceEdge> uses);
  void joinCrossing(std::span<const Crossing> crossings);
  void closeBodies(std::span<const Touch> touches, std::span<const Crossing> crossings);
  void join(std::uint32_t a, std::uint32_t b) { shell_[of(a)] = of(b); }

  // What another surface closes of a body that stands on it.
  struct Cap {
    std::uint32_t surface = 0;
    std::uint32_t side = 0;  // of the body, at the outline
    std::vector<ContactSegment> outline;
    glm::dvec2 low{INFINITY}, high{-INFINITY};
  };
  std::optional<Cap> capOf(std::span<const std::uint32_t> edges,
                           std::span<const std::vector<const Touch*>> touches);
  bool isWhole(const Cap& cap, std::span<const Crossing> crossings) const;

  const Mesh& mesh_;
  const std::vector<SurfaceEdge>& edges_;
  double weld_distance_;
  const CancelToken& cancel_;
  std::vector<std::uint32_t> shell_;       // of sides: a forest
  std::vector<std::uint32_t> body_;        // of surfaces: those that have edges in common; a forest
  std::vector<std::uint32_t> free_edges_;  // of one polygon
  std::vector<Cap> caps_;
  std::unique_ptr<Lines> lines_;
};

}  // namespace unshot
