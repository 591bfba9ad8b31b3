// A mesh whose elements are as fine as somebody asks, from a coarser one: cells are quartered, and quartered
// again. Surfaces, sides and patches stay what they are, and the coarser mesh stays beside it, for what needs
// no more than its vertices; or the quarters become patches too.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "base/cancel.h"
#include "mesh/clip.h"
#include "mesh/mesh.h"

namespace unshot {

/// A cell, or a quarter of one, of a quarter ...
struct CellPart {
  std::uint32_t surface = 0;
  glm::dvec2 low{0.0}, high{0.0};         ///< rectangle in the chart
  std::uint32_t depth = 0;                ///< 0: the cell itself
  std::span<const ConvexPolygon> pieces;  ///< what lies in it of the surface, parted where contacts are
};

/// Quarters of quarters at most.
inline constexpr std::uint32_t kMostRefined = 6;

/// Whether it is to be so for any whole cell.
bool asksForAny(const Mesh& base, const std::function<bool(const CellPart&)>& split);

/// The mesh with each part of a cell quartered for which `split` says so; an element of the base that is not
/// quartered stays as it is. Throws Cancelled.
Mesh refineMesh(std::shared_ptr<const Mesh> base, const std::function<bool(const CellPart&)>& split,
                const CancelToken& cancel = {});

/// The same from a uniform mesh, but as a mesh of its own: the quarters of a part are patches of their own,
/// as far as they are not quartered again. Throws Cancelled.
Mesh gradedMesh(const Mesh& uniform, const std::function<bool(const CellPart&)>& split,
                const CancelToken& cancel = {});

}  // namespace unshot
