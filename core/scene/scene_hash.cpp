#include "scene/scene_hash.h"

#include "base/archive.h"

namespace unshot {

std::uint64_t sceneHash(const Scene& scene) {
  ArchiveWriter archive;
  archive.value(scene.frame_origin);
  archive.array(scene.positions);
  archive.array(scene.normals);
  archive.array(scene.corners);
  archive.array(scene.polygons);
  archive.value(scene.smoothing_given);
  for (const Material& material : scene.materials) {
    archive.text(material.name);
    archive.value(material.reflectance);
    archive.value(material.emission);
  }
  return archive.checksum();
}

}  // namespace unshot
