#include "mesh/mesh_archive.h"

#include <type_traits>

namespace unshot {
namespace {

// One list of what there is, for writing (constant values) and for reading.

template <class Archive, class Rows>
void transferRows(Archive& a, Rows& rows) {
  a.array(rows.start);
  a.array(rows.index);
  a.array(rows.weight);
}

template <class Archive, class Materials>
void transferMaterials(Archive& a, Materials& materials) {
  std::uint64_t count = materials.size();
  a.value(count);
  if constexpr (!std::is_const_v<Materials>) materials.resize(count);
  for (auto& m : materials) {
    a.text(m.name);
    a.value(m.reflectance);
    a.value(m.emission);
  }
}

template <class Archive, class Remarks>
void transferDiagnostics(Archive& a, Remarks& diagnostics) {
  std::uint64_t count = diagnostics.size();
  a.value(count);
  if constexpr (!std::is_const_v<Remarks>) diagnostics.resize(count);
  for (auto& d : diagnostics) {
    a.value(d.severity);
    a.text(d.code);
    a.text(d.message);
    a.text(d.where);
    a.text(d.advice);
  }
}

template <class Archive, class AnyMesh>
void transferMesh(Archive& a, AnyMesh& m) {
  a.value(m.frame_origin);
  a.value(m.bounds_min);
  a.value(m.bounds_max);
  transferMaterials(a, m.materials);
  a.array(m.positions);
  a.array(m.surfaces);
  a.array(m.triangles);
  a.array(m.cells);
  a.array(m.pieces);
  a.array(m.piece_corners);
  a.array(m.nodes);
  a.array(m.patch_shapes);
  a.array(m.shapes);
  a.array(m.sides);
  a.value(m.element_count);
  a.value(m.patch_count);
  a.array(m.element_side);
  a.array(m.element_patch);
  a.array(m.element_area);
  a.array(m.patch_side);
  a.array(m.patch_area);
  a.array(m.patch_air);
  a.array(m.vertices);
  a.array(m.triangle_vertices);
  a.array(m.triangle_element);
  transferRows(a, m.vertex_from_elements);
  a.array(m.element_from_base);
  transferRows(a, m.vertex_from_base);
  a.array(m.smooth_pairs);
  a.value(m.weld_distance);
  a.value(m.element_size);
  a.value(m.lit_area);
  transferDiagnostics(a, m.diagnostics);
}

}  // namespace

void writeMesh(ArchiveWriter& archive, const Mesh& mesh) {
  transferMesh(archive, mesh);
  archive.value(mesh.base != nullptr);
  if (mesh.base) writeMesh(archive, *mesh.base);
}

std::shared_ptr<const Mesh> readMesh(ArchiveReader& archive) {
  auto mesh = std::make_shared<Mesh>();
  transferMesh(archive, *mesh);
  bool has_base = false;
  archive.value(has_base);
  if (has_base) mesh->base = readMesh(archive);
  return mesh;
}

}  // namespace unshot
