// One input is an OBJ text and, behind a line "mtl:", the text of a.mtl beside it. It is read, checked and
// meshed as by `unshot check`. An Error is what bad input should end with; anything else that goes wrong
// stops the process: a crash, a sanitizer's report, another exception, a mesh that breaks a law below. Time
// and memory are libFuzzer's to watch.
#include <stdlib.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>

#include "base/error.h"
#include "scene/obj_reader.h"
#include "session/preparation.h"

namespace unshot {
namespace {

constexpr std::string_view kSeparator = "\nmtl:\n";
/// Of the lit area: what rounding may change.
constexpr double kAreaTolerance = 1e-6;

[[noreturn]] void fail(const std::string& message) {
  std::fprintf(stderr, "scene_fuzzer: %s\n", message.c_str());
  std::abort();
}

void require(bool holds, const char* law) {
  if (!holds) fail(law);
}

/// In memory where there is such a place: a disk would be the slowest part of a run.
class Folder {
 public:
  Folder() {
    const std::filesystem::path memory = "/dev/shm";
    const bool there = std::filesystem::is_directory(memory);
    std::string name =
        ((there ? memory : std::filesystem::temp_directory_path()) / "unshot-fuzz-XXXXXX").string();
    if (!::mkdtemp(name.data())) fail("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const char* name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

bool within(const glm::dvec3& v, double low, double high) {
  return v.x >= low && v.x <= high && v.y >= low && v.y <= high && v.z >= low && v.z <= high;
}

bool says(const Diagnostics& diagnostics, std::string_view code) {
  for (const Diagnostic& d : diagnostics) {
    if (d.code == code) return true;
  }
  return false;
}

void checkScene(const Scene& scene) {
  const double most = std::numeric_limits<double>::max();
  for (const Material& m : scene.materials) {
    require(within(m.reflectance, 0, 1), "a reflectance outside 0 to 1");
    require(within(m.emission, 0, most), "an emission that is negative or not finite");
  }
  require(!scene.polygons.empty(), "a scene without polygons");
  for (const Polygon& p : scene.polygons) {
    require(p.corner_count >= 3 && p.material < scene.materials.size(), "a polygon of nothing");
    for (std::uint32_t k = 0; k < p.corner_count; ++k)
      require(within(scene.position(p, k), -most, most), "a corner that is not finite");
  }
}

/// Length of the outlines of all pieces on both sides [m]: what lies within the weld distance of one may
/// count to either.
double outlines(const Mesh& mesh) {
  double length = 0;
  for (const Piece& piece : mesh.pieces) {
    const auto corners = mesh.cornersOf(piece);
    for (std::size_t k = 0; k < corners.size(); ++k)
      length += 2 * glm::distance(corners[k].uv, corners[(k + 1) % corners.size()].uv);
  }
  return length;
}

void checkMesh(const Preparation& prepared) {
  const Mesh& mesh = *prepared.mesh;
  double sum = 0;
  for (const double area : mesh.element_area) {
    require(std::isfinite(area) && area >= 0, "an element's area is negative or not finite");
    sum += area;
  }
  require(std::isfinite(mesh.lit_area), "a lit area that is not finite");
  // Beyond single precision a scene is told not to be relied on.
  if (says(prepared.diagnostics, "extreme-size")) return;
  if (std::abs(sum - mesh.lit_area) > kAreaTolerance * mesh.lit_area + mesh.weld_distance * outlines(mesh))
    fail("elements have " + std::to_string(sum / mesh.lit_area) + " of the lit area");
  for (const Vertex& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis)
      require(std::isfinite(v.position[axis]) && std::isfinite(v.normal[axis]),
              "a vertex that is not finite");
  }
  const SparseRows& rows = mesh.vertex_from_elements;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double weights =
        std::accumulate(rows.weight.begin() + rows.start[k], rows.weight.begin() + rows.start[k + 1], 0.0);
    require(std::abs(weights - 1) < 1e-3, "a vertex whose weights are not one in all");
  }
  for (const std::uint32_t element : mesh.triangle_element)
    require(element < mesh.element_count, "a triangle of no element");
}

/// The same input always takes the same options.
SolveOptions optionsFor(std::string_view text, const Scene& scene) {
  SolveOptions options;
  std::uint32_t hash = 2166136261u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  hash >>= 7;
  options.emit_front_only = hash % 5 == 0;
  if (hash % 4 == 1) {
    // Of many large faces that lie on each other few elements each, so that a run stays short.
    options.element_size =
        glm::length(scene.bounds_max - scene.bounds_min) / (scene.polygons.size() < 15 ? 8 : 2);
  } else {
    options.elements = hash % 4 == 2 ? 20 : 200;
  }
  return options;
}

void runOne(std::string_view text) {
  static const Folder folder;
  const std::size_t cut = text.find(kSeparator);
  const std::string_view mtl =
      cut == std::string_view::npos ? std::string_view{} : text.substr(cut + kSeparator.size());
  folder.write("a.mtl", mtl);
  const std::filesystem::path path =
      folder.write("scene.obj", text.substr(0, cut == std::string_view::npos ? cut : cut + 1));
  try {
    const Scene scene = readObj(path);
    checkScene(scene);
    checkMesh(prepare(scene, optionsFor(text, scene)));
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInternal) fail(std::string("an internal error: ") + error.what());
  } catch (const std::exception& error) {
    fail(std::string("an exception that is no Error: ") + error.what());
  }
}

}  // namespace
}  // namespace unshot

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  unshot::runOne({reinterpret_cast<const char*>(data), size});
  return 0;
}
