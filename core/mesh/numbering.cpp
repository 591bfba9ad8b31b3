#include "mesh/numbering.h"

#include <cmath>
#include <numeric>

namespace unshot {

void numberElements(Mesh& mesh, const CancelToken& cancel) {
  mesh.element_count = mesh.patch_count = 0;
  for (std::vector<std::uint32_t>* numbers :
       {&mesh.element_side, &mesh.element_patch, &mesh.patch_side, &mesh.patch_part, &mesh.patch_part_start})
    numbers->clear();
  mesh.patch_parts.clear();
  mesh.element_area.clear();
  mesh.patch_area.clear();
  for (std::uint32_t k = 0; k < mesh.sides.size(); ++k) {
    cancel.check();
    Side& side = mesh.sides[k];
    const Surface& surface = mesh.surfaces[side.surface];
    side.first_element = mesh.element_count;
    side.first_part = mesh.patch_count;
    mesh.element_count += surface.elements.count;
    mesh.patch_count += surface.patches.count;
    mesh.patch_side.resize(mesh.patch_count, k);
    for (std::uint32_t q = side.first_part; q < mesh.patch_count; ++q) mesh.patch_parts.push_back({k, q});
    mesh.patch_area.resize(mesh.patch_count, 0.0);
    for (std::uint32_t e = 0; e < surface.elements.count; ++e) {
      const ElementShape& shape = mesh.shapes[surface.elements.first + e];
      mesh.element_side.push_back(k);
      mesh.element_area.push_back(shape.area);
      mesh.element_patch.push_back(side.first_part + shape.patch);
      mesh.patch_area[side.first_part + shape.patch] += shape.area;
    }
  }
  mesh.patch_part.resize(mesh.patch_count);
  mesh.patch_part_start.resize(mesh.patch_count + 1);
  std::iota(mesh.patch_part.begin(), mesh.patch_part.end(), 0u);
  std::iota(mesh.patch_part_start.begin(), mesh.patch_part_start.end(), 0u);
  if (mesh.element_count > 0) mesh.element_size = std::sqrt(mesh.lit_area / mesh.element_count);
}

}  // namespace unshot
