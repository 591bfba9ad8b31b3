#include "session/checked_scene.h"

#include <glm/geometric.hpp>

#include "scene/obj_text.h"

namespace unshot {

const MeshRays& CheckedScene::rays() {
  if (!rays_) rays_ = std::make_shared<const MeshRays>(mesh_);
  return *rays_;
}

const ParallelSurfaces& CheckedScene::parallels() {
  if (!parallels_) parallels_.emplace(mesh_, cancel_);
  return *parallels_;
}

const std::vector<LightView>& CheckedScene::lights() {
  if (!lights_) {
    LightLooks looks(mesh_, emit_front_only_, cancel_);
    lights_ = looks.empty() ? std::vector<LightView>{} : looks.look(rays(), parallels());
  }
  return *lights_;
}

const LightWalks& CheckedScene::walks() {
  if (!walks_) walks_ = walkLight(mesh_, rays(), cancel_);
  return *walks_;
}

std::span<const PolygonEdge> CheckedScene::edges() {
  if (!edges_) edges_ = polygonEdges(scene_);
  return *edges_;
}

std::string CheckedScene::placeOfPolygon(std::uint32_t polygon) const {
  const std::uint32_t line = scene_.polygons[polygon].line;
  return line == 0 ? scene_.path.string() : placeOf(scene_.path, line);
}

double CheckedScene::size() const { return glm::length(scene_.bounds_max - scene_.bounds_min); }

}  // namespace unshot
