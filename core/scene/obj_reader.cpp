// OBJ and MTL by way of tinyobjloader, which reads the numbers. Structure, line numbers and checks are the
// line scans': left to itself tinyobjloader reads "nan" and words as 0, cuts faces at 255 corners, takes one
// of several MTL files, fails at a comment behind a face and overflows on long indices. So it is given a
// plain text without any of these.
#include "scene/obj_reader.h"

#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>

#include "base/cancel.h"
#include "base/error.h"
#include "scene/mtl_scan.h"
#include "scene/obj_faces.h"
#include "scene/obj_line_scan.h"
#include "scene/obj_materials.h"
#include "scene/obj_text.h"
#include "scene/sky.h"

namespace unshot {
namespace {

/// From OBJ's counting to 0, 1, 2...: relative to the `count` entries so far where negative; 0 stands for
/// "not given".
std::uint32_t absoluteIndex(int index, std::size_t count) {
  if (index == 0) return kNone;
  return static_cast<std::uint32_t>(index > 0 ? index - 1 : static_cast<std::int64_t>(count) + index);
}

struct NumberSink {
  ObjNumbers numbers;
  const CancelToken& cancel;
  std::size_t all = 1, read = 0;  // statements

  static ObjNumbers& of(void* user) {
    auto& sink = *static_cast<NumberSink*>(user);
    sink.cancel.check();
    if (++sink.read % kToldEvery == 0)
      sink.cancel.report(static_cast<double>(sink.read) / static_cast<double>(sink.all));
    return sink.numbers;
  }
};

ObjNumbers readNumbers(std::string plain, const ObjScan& scan, const CancelToken& cancel) {
  NumberSink sink{{}, cancel, scan.vertex_count + scan.normal_count + scan.faces.size() + 1};
  ObjNumbers& numbers = sink.numbers;
  numbers.positions.reserve(scan.vertex_count);
  numbers.normals.reserve(scan.normal_count);
  tinyobj::callback_t callback;
  callback.vertex_cb = [](void* user, double x, double y, double z, double) {
    NumberSink::of(user).positions.emplace_back(x, y, z);
  };
  callback.normal_cb = [](void* user, double x, double y, double z) {
    NumberSink::of(user).normals.emplace_back(x, y, z);
  };
  callback.index_cb = [](void* user, tinyobj::index_t* indices, int count) {
    ObjNumbers& target = NumberSink::of(user);
    for (int i = 0; i < count; ++i) {
      target.corner_positions.push_back(absoluteIndex(indices[i].vertex_index, target.positions.size()));
      target.corner_normals.push_back(absoluteIndex(indices[i].normal_index, target.normals.size()));
    }
  };
  std::istringstream stream(std::move(plain));
  std::string warning, error;
  const bool done = tinyobj::LoadObjWithCallback(stream, callback, &sink, nullptr, &warning, &error);
  std::size_t corners = 0;
  for (const ObjFace& face : scan.faces) corners += face.corner_count;
  if (!done || numbers.positions.size() != scan.vertex_count || numbers.normals.size() != scan.normal_count ||
      numbers.corner_positions.size() != corners) {
    throw Error(ErrorKind::kInternal, "tinyobjloader and the line scan disagree about this file " + error);
  }
  return std::move(sink.numbers);
}

std::vector<MtlValues> readMtlNumbers(const std::string& plain) {
  std::istringstream stream(plain);
  std::map<std::string, int> index;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  tinyobj::LoadMtl(&index, &materials, &stream, &warning, &error);
  std::vector<MtlValues> values;
  for (const tinyobj::material_t& m : materials) {
    values.push_back({{m.diffuse[0], m.diffuse[1], m.diffuse[2]},
                      {m.emission[0], m.emission[1], m.emission[2]},
                      m.diffuse_texname});
  }
  return values;
}

void reportStatements(const ObjScan& scan, Scene& scene) {
  const auto place = [&](const Tally& tally) { return placeOf(scene.path, tally.first_line); };
  if (const Tally& t = scan.lines_and_points; t.count > 0) {
    scene.diagnostics.push_back(
        {Severity::kNote, "lines-and-points",
         counted(t.count, "line or point statement", "line or point statements") + " read past", place(t),
         "only faces carry light"});
  }
  if (const Tally& t = scan.free_form; t.count > 0) {
    scene.diagnostics.push_back(
        {Severity::kWarning, "free-form",
         counted(t.count, "free-form statement", "free-form statements") + " read past", place(t),
         "convert curves and surfaces to polygons"});
  }
  if (const Tally& t = scan.lost_texture; t.count > 0) {
    scene.diagnostics.push_back(
        {Severity::kWarning, "texture-index",
         counted(t.count, "corner", "corners") + " with a texture index that leads nowhere (there are " +
             counted(scan.texture_count, "texture coordinate", "texture coordinates") + "); it is not needed",
         place(t), "export the scene again if its textures matter elsewhere"});
  }
  if (const Tally& t = scan.unknown; t.count > 0) {
    scene.diagnostics.push_back(
        {Severity::kWarning, "unknown-statement",
         counted(t.count, "line", "lines") + " read past, the first with '" + scan.first_unknown + "'",
         place(t), "this is no statement of the OBJ format"});
  }
}

void reportNoLight(Scene& scene) {
  if (emitsLight(scene)) return;
  scene.diagnostics.push_back({Severity::kWarning, "no-light",
                               "no face emits light: all that there is comes from the sky",
                               scene.path.string(), "give a material of the MTL file a Ke"});
}

}  // namespace

Scene readObj(const std::filesystem::path& path, const CancelToken& cancel) {
  Scene scene;
  scene.path = path;
  scene.name = path.stem().string();
  // Shares of the time that a large file takes.
  const std::string text = readTextFile(path, cancel.part(0, 0.05));
  ObjScan scan = scanObj(text, path, cancel.part(0.05, 0.3));
  scene.smoothing_given = scan.smoothing_given;
  reportStatements(scan, scene);
  ObjMaterials materials = readMaterials(scan, path, readMtlNumbers, scene.diagnostics, cancel);
  scene.materials = materials.materials;
  const ObjNumbers numbers = readNumbers(std::move(scan.plain), scan, cancel.part(0.3, 0.55));
  buildPolygons(scan, numbers, materials, scene, cancel.part(0.55, 1));
  reportNoLight(scene);
  return scene;
}

}  // namespace unshot
