// Scenes for trials of stability, beside the analytic ones: closed boxes filled with what is hard to solve.
//
// Most are *manufactured*: whatever stands in a closed box, where every side has E = b (1 - rho) the solution
// is B = b at every point, for any geometry and any reflectances rho, because all that a point sees is b. The
// box is convex and everything else inside it, so that every side that light can reach sees closed space.
#pragma once

#include <glm/vec3.hpp>

#include "scene/analytic_scenes.h"

namespace unshot {

/// b of the manufactured scenes [W/m^2]: not the same in any two channels.
inline constexpr glm::dvec3 kManufactured{1.0, 2.0, 0.5};

/// The cube [0, 1]^3 with reflectances and emissions per channel; the face y = 0 alone emits.
Scene litCube(const glm::dvec3& reflectance, const glm::dvec3& emission);

// Manufactured.
/// A cube whose walls reflect `white` (1 is allowed), floor and ceiling a half.
Scene whiteWalls(double white);
Scene interpenetratingBlocks();
/// Seven walls without thickness that share one edge.
Scene finsOnOneEdge();
Scene twoRoomsWithADoor();
/// 6 x 130 x 130 = 101,400 quads: a cube whose faces are grids, each face of one material.
Scene manyQuads();
/// A floor in the shape of an L, a plate in that of a star, a block over a U.
Scene concavePolygons();
/// Sixty strips of 1 x 0.0001 in two materials across the floor.
Scene sliverStrips();
/// A floor of 200 triangles about one point, in two materials that alternate.
Scene needleFan();
/// Faces cut into chequers, each differently, so that no corner on an edge meets another.
Scene tJunctions();
/// A box and a block whose faces are wound either way.
Scene wrongWindings();
/// Plates in the planes of ceiling and wall, and a block that stands on the floor by a face of its own.
Scene coplanarPlates();
/// Faces that are there two and three times, the same way round and the other.
Scene duplicatedFaces();
/// Two walls of reflectance 1.5, which counts as 1, or of -0.3, which counts as 0.
Scene reflectanceOutOfRange(double reflectance);

// Lit from one place.
/// The cube, closed; rho = 0.5; in the middle of its ceiling a light of a millionth of all the area, with
/// E = 1e6: 6 W in all.
Scene smallBrightLight();
/// A closed corridor of 100 x 1 x 1, reflectance rho; its end x = 0 emits 1.
Scene corridor(double reflectance);
/// Unit squares face to face at a distance of 1e-4, reflectance 0.9; the lower emits 1.
Scene narrowGap();
/// The cube with its face y = 0 lit (E = 1, rho = 0.5) and, two metres beside it, one of reflectance 0.8
/// without a light. To be solved with emission from fronts alone.
Scene litAndDarkIsland();
/// Unit squares face to face; both emit (1 and 3), the lower reflects a half. Nothing else.
Scene emittersOnly();
/// A block in a room, everything black; the room emits 1, the block 2.
Scene allBlack();
/// Emits 1.
Scene oneTriangle();
/// Nine squares in one plane, of which the middle one emits 1.
Scene flatSheet();

}  // namespace unshot
