// A mesh and a snapshot without reader, mesher or solver: a box room seen from inside, open to the front if
// asked, with one block on its floor and a lamp under its ceiling, and an irradiance that is a formula; or
// only a lamp over a floor, with nothing around them.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "session/snapshot.h"

namespace unshot::testing_support {

struct RoomOptions {
  double scale = 1;  ///< the room is 2 x 2 x 2 times this
  double light = 1;  ///< factor on emission and irradiance
  std::uint32_t cells = 8;
  bool open_front = true;  ///< no wall at +z
  glm::dvec3 frame_origin{0.0};
};

class RoomBuilder {
 public:
  explicit RoomBuilder(const RoomOptions& options) : options_(options), mesh_(std::make_shared<Mesh>()) {
    mesh_->frame_origin = options.frame_origin;
    mesh_->bounds_min = glm::dvec3(-1, 0, -1) * options.scale;
    mesh_->bounds_max = glm::dvec3(1, 2, 1) * options.scale;
    mesh_->materials = {{"white", glm::dvec3(0.75), glm::dvec3(0)},
                        {"red", {0.6, 0.06, 0.05}, glm::dvec3(0)},
                        {"green", {0.12, 0.45, 0.09}, glm::dvec3(0)},
                        {"lamp", glm::dvec3(0.5), glm::dvec3(10, 9, 6) * options.light}};
  }

  Snapshot build() {
    quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0, options_.cells);  // floor
    quad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 0, options_.cells);  // ceiling
    quad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, 0, options_.cells);  // back
    quad({-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, 1, options_.cells);  // left
    quad({1, 0, -1}, {0, 0, 2}, {0, 2, 0}, 2, options_.cells);   // right
    if (!options_.open_front) quad({1, 0, 1}, {-2, 0, 0}, {0, 2, 0}, 0, options_.cells);
    quad({-0.3, 1.98, -0.3}, {0.6, 0, 0}, {0, 0, 0.6}, 3, 1);  // lamp, faces down
    quad({0.1, 0, 0.4}, {0.5, 0, 0}, {0, 0.8, 0}, 0, 4);       // block: front
    quad({0.1, 0, -0.1}, {0, 0, 0.5}, {0, 0.8, 0}, 0, 4);      // left
    quad({0.6, 0, 0.4}, {0, 0, -0.5}, {0, 0.8, 0}, 0, 4);      // right
    quad({0.6, 0, -0.1}, {-0.5, 0, 0}, {0, 0.8, 0}, 0, 4);     // back
    quad({0.1, 0.8, 0.4}, {0.5, 0, 0}, {0, 0, -0.5}, 0, 4);    // top
    snapshot_.mesh = mesh_;
    fillExtras();
    return snapshot_;
  }

  Snapshot buildTwoPatches() {
    quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0, options_.cells);  // floor
    quad({-0.5, 1.2, -0.3}, {1, 0, 0}, {0, 0, 0.6}, 3, 1);       // lamp, faces down
    mesh_->bounds_max.y = 1.2 * options_.scale;
    snapshot_.mesh = mesh_;
    fillExtras();
    return snapshot_;
  }

 private:
  // Direct light of a point lamp under the ceiling, without shadows, and a constant.
  glm::vec3 irradianceAt(const glm::dvec3& p, const glm::dvec3& normal) const {
    const glm::dvec3 to_lamp = glm::dvec3(0, 1.9, 0) - p;
    const double d = glm::length(to_lamp);
    const double direct =
        std::max(0.0, glm::dot(normal, to_lamp) / d) * std::max(0.0, to_lamp.y / d) / (d * d + 0.05);
    return glm::vec3((direct * glm::dvec3(1, 0.9, 0.6) + glm::dvec3(0.25)) * options_.light);
  }

  // origin + [0, 1] u + [0, 1] v, seen from cross(u, v).
  void quad(const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, std::uint32_t material,
            std::uint32_t n) {
    Mesh& mesh = *mesh_;
    const double s = options_.scale;
    const auto surface_index = static_cast<std::uint32_t>(mesh.surfaces.size());
    const auto side_index = static_cast<std::uint32_t>(mesh.sides.size());
    Surface surface;
    surface.material = material;
    surface.origin = origin * s;
    surface.axis_u = glm::normalize(u);
    surface.axis_v = glm::normalize(v);
    surface.normal = glm::cross(surface.axis_u, surface.axis_v);
    surface.extent = {glm::length(u) * s, glm::length(v) * s};
    surface.area = surface.extent.x * surface.extent.y;
    surface.nu = surface.nv = n;
    surface.triangles = {static_cast<std::uint32_t>(mesh.triangles.size()), 2};
    surface.side[0] = side_index;
    addTriangles(surface);
    mesh.surfaces.push_back(surface);
    mesh.sides.push_back({surface_index, false, surface.normal, mesh.materials[material].reflectance,
                          mesh.materials[material].emission, mesh.element_count, 0});
    mesh.lit_area += surface.area;

    const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (std::uint32_t i = 0; i <= n; ++i) {
        const glm::dvec3 p = origin + u * (double(i) / n) + v * (double(j) / n);
        mesh.vertices.push_back({glm::vec3(p * s), glm::vec3(surface.normal), material, side_index});
        snapshot_.irradiance.push_back(irradianceAt(p, surface.normal));
        snapshot_.ambient.push_back(glm::vec3(float(0.1 * options_.light)));
        snapshot_.unshot.push_back(glm::vec3(mesh.materials[material].reflectance * (0.1 + p.y)) *
                                   snapshot_.irradiance.back());
      }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = first_vertex + j * (n + 1) + i;
        const std::uint32_t element = mesh.element_count++;
        mesh.triangle_vertices.insert(mesh.triangle_vertices.end(),
                                      {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1});
        mesh.triangle_element.insert(mesh.triangle_element.end(), {element, element});
        mesh.element_side.push_back(side_index);
        mesh.element_area.push_back(surface.area / (n * n));
        mesh.element_patch.push_back(mesh.patch_count++);
        mesh.patch_side.push_back(side_index);
        mesh.patch_area.push_back(surface.area / (n * n));
        const glm::dvec3 p = origin + u * ((i + 0.5) / n) + v * ((j + 0.5) / n);
        snapshot_.element_irradiance.push_back(irradianceAt(p, surface.normal));
      }
    }
  }

  // Something for the displays that show neither light nor material.
  void fillExtras() {
    std::vector<glm::vec3> bounces, residual;
    for (const Vertex& v : mesh_->vertices) {
      bounces.emplace_back(1.5f + 0.2f * v.position.x);
      residual.push_back(glm::vec3(0.1f + 0.5f * v.position.y * v.position.y) * glm::vec3(1, 1, 0.5f));
    }
    snapshot_.bounces = std::make_shared<const std::vector<glm::vec3>>(std::move(bounces));
    snapshot_.residual = std::make_shared<const std::vector<glm::vec3>>(std::move(residual));
  }

  void addTriangles(const Surface& surface) {
    Mesh& mesh = *mesh_;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const std::array<glm::dvec2, 4> corners = {
        glm::dvec2(0, 0), {surface.extent.x, 0}, surface.extent, {0, surface.extent.y}};
    for (const glm::dvec2& uv : corners) mesh.positions.push_back(surface.point(uv));
    mesh.triangles.push_back({{corners[0], corners[1], corners[2]}, {first, first + 1, first + 2}, {}});
    mesh.triangles.push_back({{corners[0], corners[2], corners[3]}, {first, first + 2, first + 3}, {}});
  }

  RoomOptions options_;
  std::shared_ptr<Mesh> mesh_;
  Snapshot snapshot_;
};

inline Snapshot syntheticRoom(const RoomOptions& options = {}) { return RoomBuilder(options).build(); }
inline Snapshot syntheticTwoPatches(const RoomOptions& options = {}) {
  return RoomBuilder(options).buildTwoPatches();
}

}  // namespace unshot::testing_support
