// From a scene to its mesh: weld, surfaces, lit sides, fineness, grids, display.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/cancel.h"
#include "mesh/contacts.h"
#include "mesh/mesh.h"
#include "mesh/surfaces.h"
#include "scene/scene.h"

namespace unshot {

struct MeshOptions {
  std::optional<std::uint64_t> elements;  ///< over all lit sides, aimed at within 10 %
  std::optional<double>
      element_size;  ///< [m]; without both, the size that would cut the lit area into 10,000 squares
  bool emit_front_only = false;
  /// Patches of two by two cells, over which light is taken to be quadratic, not of as many as give about a
  /// thousand patches: for meshes that are refined afterwards.
  /// `elements` then counts those beyond one a side: small things must not leave large walls without.
  bool paired_cells = false;
  /// Sides that nothing of the scene lies in front of have elements too.
  bool outer_sides = false;
  /// And so have sides that closed surfaces keep from all light (mesh/reach.h).
  bool dark_sides = false;
  /// Whether light leaves the scene is not looked for in its surfaces (Mesh::closed stays false).
  bool escape_unknown = false;
  bool all_tested = false;     ///< Mesh::all_tested
  bool rooms_unknown = false;  ///< All is one room (Side::room).
  /// Polygons of one material in one plane are one surface where they join.
  bool join_polygons = true;
  /// Light comes from outside the scene too: no side is left out.
  bool sky = false;
};

inline constexpr std::uint64_t kDefaultElements = 10'000;
inline constexpr std::uint64_t kMostElements = 20'000'000;

/// What a mesh begins with, however fine it becomes.
struct SurfacesOfScene {
  Mesh mesh;  ///< surfaces, the triangles of lit ones first (mesh/lit.h), and sides; no elements
  std::vector<SurfaceEdge> edges;
  std::vector<Crossing> crossings;
  double plan_seconds = 0;  ///< wall time it took to find out which sides light reaches
};

/// Throws Error (kInput) where no polygon has area; Cancelled where `cancel` asks for it.
SurfacesOfScene findSurfaces(const Scene& scene, const MeshOptions& options, const CancelToken& cancel = {});

/// `options`: those that the surfaces were found with, but for the fineness. Throws Error (kUsage) for
/// impossible options or a fineness beyond kMostElements; Cancelled where `cancel` asks for it.
Mesh meshSurfaces(SurfacesOfScene surfaces, const MeshOptions& options, const CancelToken& cancel = {});

/// Both, and throws what they throw.
Mesh buildMesh(const Scene& scene, const MeshOptions& options, const CancelToken& cancel = {});

}  // namespace unshot
