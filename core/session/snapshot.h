// The state of a solve at one moment, immutable once made: what is drawn, probed and exported.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "mesh/mesh.h"
#include "solver/bounds.h"

namespace unshot {

/// Figures of a solve at one moment.
struct Measures {
  double seconds = 0;          ///< wall time since the solve began, without its rests (Solve::rest)
  double cpu_seconds = 0;      ///< CPU time since meshing began, without rests
  std::uint64_t shots = 0;     ///< columns used
  std::uint64_t rows = 0;      ///< columns and rows computed (not taken from those kept)
  std::uint64_t drafts = 0;    ///< columns in use that are still drafts (SolveOptions::draft_first)
  std::uint64_t refined = 0;   ///< drafts that were replaced
  double unshot_fraction = 1;  ///< sum A |U| / sum A E over patches and channels
  SolverBounds bounds;         ///< of the solver's error
  /// That error itself, as bounds.upper counts it: once the mode `direct` has solved this system.
  std::optional<double> true_error;
  /// The figure that is held against Solve::solverTarget: bounds.upper where there is one, else
  /// bounds.total_upper.
  double solverBound() const { return bounds.upper < kNoBound ? bounds.upper : bounds.total_upper; }
  /// What the same error is at least; 0 where nothing is known.
  double solverLowerBound() const { return bounds.upper < kNoBound ? bounds.lower : bounds.total_lower; }
};

/// A field on a mesh [W/m^2].
struct MeshField {
  std::vector<glm::vec3> vertices;  ///< one per vertex
  std::vector<glm::vec3> elements;  ///< one per element
};

/// Light by bounces, B = B_0 + B_1 + ... with B_0 = E.
struct BounceLight {
  std::vector<glm::dvec3> power;  ///< sum A B_k per channel [W], of E and each bounce that is known
  /// H with the light of the first 1, 2, ... bounces: E + rho H is what they show. May be shorter than
  /// `power`: only the first bounces have the room.
  std::vector<std::shared_ptr<const MeshField>> received;
};

/// What light by bounces still waits for.
struct BounceWait {
  std::size_t columns = 0;  ///< of form factors that light needs and that are not kept
  bool no_room = false;     ///< and cannot be: they do not fit into SolveOptions::kept_bytes
};

/// One state of a solve. Fields are per display vertex of `mesh`; radiosity is B = E + rho (irradiance +
/// ambient), with rho and E of the vertex's material and side (mesh->sides[vertex.side]). Indirect light is
/// irradiance - direct.
struct Snapshot {
  std::shared_ptr<const Mesh> mesh;
  glm::dvec3 sky{0.0};                        ///< its radiosity [W/m^2]; 0 where none is seen
  std::vector<glm::vec3> irradiance;          ///< H [W/m^2], one per vertex
  std::vector<glm::vec3> ambient;             ///< estimate of what unshot light will add to H; one per vertex
  std::vector<glm::vec3> unshot;              ///< U [W/m^2] of the vertex's patch, one per vertex
  std::vector<glm::vec3> element_irradiance;  ///< H [W/m^2], one per element
  /// H_d [W/m^2], one per vertex: the part of `irradiance` that came straight from emitters, complete once
  /// every emitter has shot; null counts as 0. Snapshots share it as long as it does not change.
  std::shared_ptr<const std::vector<glm::vec3>> direct;
  /// H_d [W/m^2], one per element; null counts as 0.
  std::shared_ptr<const std::vector<glm::vec3>> element_direct;
  /// Expected number of surfaces that light leaving here meets, this one included, per channel, one per
  /// vertex (ErrorBounds::expectedBounces); null where it is not known.
  std::shared_ptr<const std::vector<glm::vec3>> bounces;
  /// Where the mesh is worst: RMS residual of the continuous equation [W/m^2], one per vertex (all channels
  /// alike); null where it is not known.
  std::shared_ptr<const std::vector<glm::vec3>> residual;
  /// sum_q K_vq over the patches that have light and the sky, one per vertex (all channels alike): 1 where
  /// nothing else is seen. Null where it is not known: while their columns are missing, or before the solve
  /// rests.
  std::shared_ptr<const std::vector<glm::vec3>> row_sums;
  /// Light by bounces; null where it is not known (yet).
  std::shared_ptr<const BounceLight> bounce_light;
  BounceWait bounce_wait;
  Measures measures;
};

/// B [W/m^2] at vertex v of the snapshot; with the ambient term where `with_ambient`.
inline glm::dvec3 radiosity(const Snapshot& s, std::size_t v, bool with_ambient) {
  const Side& side = s.mesh->sides[s.mesh->vertices[v].side];
  glm::dvec3 h(s.irradiance[v]);
  if (with_ambient) h += glm::dvec3(s.ambient[v]);
  return side.emission + side.reflectance * h;
}

}  // namespace unshot
