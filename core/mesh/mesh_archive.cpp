#include "mesh/mesh_archive.h"

namespace unshot {
namespace {

// For writing (constant values) and for reading.
template <class Archive, class AnyMesh>
void transferMesh(Archive& a, AnyMesh& m) {
  a.fields(m.frame_origin, m.bounds_min, m.bounds_max);
  a.list(m.materials,
         [&](auto& material) { a.fields(material.name, material.reflectance, material.emission); });
  a.fields(m.positions, m.surfaces, m.triangles, m.cells, m.pieces, m.piece_corners);
  a.fields(m.nodes, m.patch_shapes, m.shapes, m.sides);
  a.fields(m.element_count, m.patch_count);
  a.fields(m.element_side, m.element_patch, m.element_area);
  a.fields(m.patch_parts, m.patch_part_start, m.patch_part);
  a.fields(m.patch_side, m.patch_area, m.patch_air);
  a.fields(m.vertices, m.triangle_vertices, m.triangle_element);
  const auto transferRows = [&](auto& rows) { a.fields(rows.start, rows.index, rows.weight); };
  transferRows(m.vertex_from_elements);
  a.fields(m.element_from_base);
  transferRows(m.vertex_from_base);
  a.fields(m.smooth_pairs);
  a.fields(m.weld_distance, m.element_size, m.patch_size, m.lit_area, m.for_error, m.closed, m.all_tested);
  a.list(m.diagnostics, [&](auto& d) { a.fields(d.severity, d.code, d.message, d.where, d.advice); });
}

}  // namespace

void writeMesh(ArchiveWriter& archive, const Mesh& mesh) {
  transferMesh(archive, mesh);
  archive.fields(mesh.base != nullptr);
  if (mesh.base) writeMesh(archive, *mesh.base);
}

std::shared_ptr<const Mesh> readMesh(ArchiveReader& archive) {
  auto mesh = std::make_shared<Mesh>();
  transferMesh(archive, *mesh);
  bool has_base = false;
  archive.fields(has_base);
  if (has_base) mesh->base = readMesh(archive);
  return mesh;
}

}  // namespace unshot
