#include "scene/scene_hash.h"

#include "base/archive.h"

namespace unshot {

std::uint64_t sceneHash(const Scene& scene) {
  if (scene.hash_as_read) return *scene.hash_as_read;
  ArchiveWriter archive;
  archive.fields(scene.frame_origin, scene.positions, scene.normals, scene.corners, scene.polygons);
  archive.fields(scene.smoothing_given);
  for (const Material& m : scene.materials) archive.fields(m.name, m.reflectance, m.emission);
  return archive.checksum();
}

}  // namespace unshot
