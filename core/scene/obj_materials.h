// MTL files: finds and checks them, and makes the scene's materials of them.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "base/diagnostic.h"
#include "scene/obj_line_scan.h"
#include "scene/scene.h"

namespace unshot {

/// The values of one material as tinyobjloader reads them.
struct MtlValues {
  glm::dvec3 diffuse{0.0};
  glm::dvec3 emission{0.0};
  std::string diffuse_texture;
};

/// Reads a plain MTL text: one entry for each newmtl, in its order.
using MtlNumberReader = std::function<std::vector<MtlValues>(const std::string& plain)>;

/// The scene's materials, and which of them each name of the scan means.
struct ObjMaterials {
  std::vector<Material> materials;
  std::vector<std::uint32_t> of_name;  ///< one per ObjScan::material_names
  std::uint32_t without_name = kNone;  ///< of faces before any usemtl; kNone where there are none
};

/// Reads all MTL files that the scan names, from the folder of `obj_path`. Never throws for what they hold:
/// doubts become diagnostics. Reflectances are Kd times the mean of map_Kd, within 0..1; emission is Ke,
/// finite and at least 0.
ObjMaterials readMaterials(const ObjScan& scan, const std::filesystem::path& obj_path,
                           const MtlNumberReader& read_numbers, Diagnostics& diagnostics,
                           const CancelToken& cancel = {});

}  // namespace unshot
