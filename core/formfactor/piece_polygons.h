// The pieces of a mesh as polygons to be looked at.
#pragma once

#include <cstdint>

#include "formfactor/polygon_factor.h"
#include "mesh/mesh.h"

namespace unshot {

/// Calls f(side, element, polygon) for each piece of each element.
template <class F>
void forEachPiece(const Mesh& mesh, F&& f) {
  for (const Side& side : mesh.sides) {
    const Surface& surface = mesh.surfaces[side.surface];
    const std::uint32_t end = surface.first_cell + surface.nu * surface.nv;
    for (std::uint32_t c = surface.first_cell; c < end; ++c) {
      const Range pieces = mesh.cells[c].pieces;
      for (std::uint32_t p = pieces.first; p < pieces.end(); ++p) {
        const Piece& piece = mesh.pieces[p];
        f(side, side.first_element + piece.element, FactorPolygon(outlineOf(mesh, side, piece)));
      }
    }
  }
}

}  // namespace unshot
