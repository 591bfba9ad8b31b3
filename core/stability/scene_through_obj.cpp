#include "stability/scene_through_obj.h"

#include <stdlib.h>

#include <filesystem>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <system_error>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/obj_reader.h"

namespace unshot {
namespace {

class Folder {
 public:
  Folder() {
    std::error_code error;
    std::string name = (std::filesystem::temp_directory_path(error) / "unshot-scene-XXXXXX").string();
    if (error || !::mkdtemp(name.data())) {
      throw Error(ErrorKind::kEnvironment, "no temporary folder can be made", name,
                  "TMPDIR=FOLDER for another place");
    }
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::ostringstream exactStream() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(std::numeric_limits<double>::max_digits10);
  return out;
}

// Names need not differ in a generated scene; in a file they must.
std::string nameOf(const Scene& scene, std::size_t m) {
  return scene.materials[m].name + "_" + std::to_string(m);
}

std::string mtlOf(const Scene& scene) {
  std::ostringstream out = exactStream();
  const auto line = [&](const char* word, const glm::dvec3& v) {
    out << word << ' ' << v.x << ' ' << v.y << ' ' << v.z << '\n';
  };
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    out << "newmtl " << nameOf(scene, m) << '\n';
    line("Kd", scene.materials[m].reflectance);
    line("Ke", scene.materials[m].emission);
  }
  return out.str();
}

std::string objOf(const Scene& scene) {
  std::ostringstream out = exactStream();
  out << "mtllib scene.mtl\n";
  for (const glm::dvec3& p : scene.positions) {
    const glm::dvec3 at = p + scene.frame_origin;
    out << "v " << at.x << ' ' << at.y << ' ' << at.z << '\n';
  }
  for (const Polygon& polygon : scene.polygons) {
    out << "usemtl " << nameOf(scene, polygon.material) << "\nf";
    for (std::uint32_t k = 0; k < polygon.corner_count; ++k)
      out << ' ' << scene.corners[polygon.first_corner + k].position + 1;
    out << '\n';
  }
  return out.str();
}

}  // namespace

std::filesystem::path writeObj(const Scene& scene, const std::filesystem::path& folder) {
  writeWholeFile(folder / "scene.mtl", mtlOf(scene));
  writeWholeFile(folder / "scene.obj", objOf(scene));
  return folder / "scene.obj";
}

Scene throughObj(const Scene& scene) {
  const Folder folder;
  return readObj(writeObj(scene, folder.path()));
}

}  // namespace unshot
