// Makes a Scene's polygons of an OBJ's faces: repairs, splits, drops what counts twice, and keeps what is
// used.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "base/cancel.h"
#include "scene/obj_line_scan.h"
#include "scene/obj_materials.h"
#include "scene/scene.h"

namespace unshot {

/// What tinyobjloader reads of an OBJ. Indices count from 0.
struct ObjNumbers {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<std::uint32_t> corner_positions;  ///< those of all faces, one face after the other
  std::vector<std::uint32_t> corner_normals;    ///< as many; kNone where the corner has none
};

/// Fills in everything of `scene` but path, name, materials and smoothing_given (materials have to be there
/// already), and adds diagnostics. Throws Error (kInput, with file:line) for an index beyond the last vertex
/// or normal, for a face at a vertex that is not finite, and where no face has an area.
void buildPolygons(const ObjScan& scan, const ObjNumbers& numbers, const ObjMaterials& materials,
                   Scene& scene, const CancelToken& cancel = {});

}  // namespace unshot
