#include "scene/analytic_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace unshot {

std::uint32_t SceneBuilder::material(std::string name, glm::dvec3 reflectance, glm::dvec3 emission) {
  scene_.materials.push_back({std::move(name), reflectance, emission});
  return static_cast<std::uint32_t>(scene_.materials.size()) - 1;
}

void SceneBuilder::polygon(std::uint32_t material, const std::vector<glm::dvec3>& corners) {
  Polygon p;
  p.first_corner = static_cast<std::uint32_t>(scene_.corners.size());
  p.corner_count = static_cast<std::uint32_t>(corners.size());
  p.material = material;
  p.face = static_cast<std::uint32_t>(scene_.polygons.size());
  p.line = p.face + 1;
  for (const glm::dvec3& corner : corners) {
    scene_.corners.push_back({static_cast<std::uint32_t>(scene_.positions.size()), kNone});
    scene_.positions.push_back(corner);
  }
  scene_.polygons.push_back(p);
  scene_.triangle_count += corners.size() - 2;
}

void SceneBuilder::quad(std::uint32_t material, const glm::dvec3& corner, const glm::dvec3& a,
                        const glm::dvec3& b) {
  polygon(material, {corner, corner + a, corner + a + b, corner + b});
}

Scene SceneBuilder::finish() {
  glm::dvec3 low(INFINITY), high(-INFINITY);
  for (const glm::dvec3& p : scene_.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  scene_.frame_origin = (low + high) / 2.0;
  for (glm::dvec3& p : scene_.positions) p -= scene_.frame_origin;
  scene_.bounds_min = low - scene_.frame_origin;
  scene_.bounds_max = high - scene_.frame_origin;
  scene_.face_count = scene_.polygons.size();
  scene_.name = "analytic";
  return std::move(scene_);
}

BoxMaterials allOf(std::uint32_t material) {
  return {material, material, material, material, material, material};
}

void addBox(SceneBuilder& b, const BoxMaterials& m, const glm::dvec3& corner, const glm::dvec3& x,
            const glm::dvec3& y, const glm::dvec3& z, bool inwards) {
  const auto face = [&](std::uint32_t material, const glm::dvec3& at, const glm::dvec3& u,
                        const glm::dvec3& v) {
    if (material == kNone) return;
    b.quad(material, at, inwards ? u : v, inwards ? v : u);  // u x v points into the box
  };
  face(m[0], corner, y, z);
  face(m[1], corner + x, z, y);
  face(m[2], corner, z, x);
  face(m[3], corner + y, x, z);
  face(m[4], corner, x, y);
  face(m[5], corner + z, y, x);
}

void addBox(SceneBuilder& builder, const BoxMaterials& materials, const glm::dvec3& corner,
            const glm::dvec3& edges, bool inwards) {
  addBox(builder, materials, corner, {edges.x, 0, 0}, {0, edges.y, 0}, {0, 0, edges.z}, inwards);
}

Scene cubeScene(const std::array<Material, 6>& materials) {
  SceneBuilder b;
  for (const Material& m : materials) b.material(m.name, m.reflectance, m.emission);
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0.0);
  b.quad(0, o, z, x);
  b.quad(1, y, x, z);
  b.quad(2, o, x, y);
  b.quad(3, x, z, y);
  b.quad(4, z, y, x);
  b.quad(5, o, y, z);
  return b.finish();
}

Scene furnaceScene(double reflectance, double emission) {
  std::array<Material, 6> materials;
  materials.fill({"wall", glm::dvec3(reflectance), glm::dvec3(emission)});
  return cubeScene(materials);
}

Scene cubeOneFaceLit(double reflectance) {
  std::array<Material, 6> materials;
  materials.fill({"wall", glm::dvec3(reflectance), glm::dvec3(0.0)});
  materials[0].emission = glm::dvec3(1.0);
  return cubeScene(materials);
}

namespace {

// The unit square on the floor, reflecting rho, and a black unit square that emits 1: corner + a x b.
Scene floorAndLight(double reflectance, const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b) {
  SceneBuilder builder;
  const auto floor = builder.material("floor", glm::dvec3(reflectance));
  const auto light = builder.material("light", glm::dvec3(0.0), glm::dvec3(1.0));
  builder.quad(floor, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  builder.quad(light, corner, a, b);
  return builder.finish();
}

}  // namespace

Scene parallelSquares(double reflectance) {
  return floorAndLight(reflectance, {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
}

Scene perpendicularSquares(double reflectance) {
  return floorAndLight(reflectance, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
}

namespace {

// A sphere of `rings` latitudes and 2 rings longitudes, its radius set so that the polyhedron has the
// sphere's area.
void addSphere(SceneBuilder& b, std::uint32_t material, double radius, int rings, bool inwards) {
  const auto at = [&](int ring, int turn) {
    const double polar = std::numbers::pi * ring / rings, azimuth = std::numbers::pi * turn / rings;
    return glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                      std::sin(polar) * std::sin(azimuth));
  };
  std::vector<std::vector<glm::dvec3>> faces;
  double area = 0;
  for (int ring = 0; ring < rings; ++ring) {
    for (int turn = 0; turn < 2 * rings; ++turn) {
      std::vector<glm::dvec3> face{at(ring, turn), at(ring, turn + 1), at(ring + 1, turn + 1),
                                   at(ring + 1, turn)};
      if (ring == 0) face.erase(face.begin());
      if (ring + 1 == rings) face.erase(face.begin() + 2);
      if (inwards) std::reverse(face.begin(), face.end());
      for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        area += glm::length(glm::cross(face[k] - face[0], face[k + 1] - face[0])) / 2;
      }
      faces.push_back(std::move(face));
    }
  }
  const double scale = radius * std::sqrt(4 * std::numbers::pi / area);
  for (auto& face : faces) {
    for (glm::dvec3& corner : face) corner *= scale;
    b.polygon(material, face);
  }
}

}  // namespace

Scene concentricSpheres(double rho1, double emission1, double rho2, double emission2, int rings) {
  SceneBuilder b;
  const auto inner = b.material("inner", glm::dvec3(rho1), glm::dvec3(emission1));
  const auto outer = b.material("outer", glm::dvec3(rho2), glm::dvec3(emission2));
  addSphere(b, inner, 0.5, rings, false);
  addSphere(b, outer, 1.0, rings, true);
  return b.finish();
}

Scene litAndDarkRoom() {
  SceneBuilder b;
  const auto white = b.material("white", glm::dvec3(0.8));
  const auto light = b.material("light", glm::dvec3(0.0), glm::dvec3(10.0));
  for (const double x : {0.0, 1.0}) {
    b.quad(white, {x, 0, 0}, {0, 0, 1}, {1, 0, 0});  // floor
    b.quad(white, {x, 1, 0}, {1, 0, 0}, {0, 0, 1});  // ceiling
    b.quad(white, {x, 0, 0}, {1, 0, 0}, {0, 1, 0});  // back
    b.quad(white, {x, 0, 1}, {0, 1, 0}, {1, 0, 0});  // front
  }
  for (const double x : {0.0, 1.0, 2.0}) b.quad(white, {x, 0, 0}, {0, 1, 0}, {0, 0, 1});
  b.quad(light, {0.4, 0.9, 0.4}, {0.2, 0, 0}, {0, 0, 0.2});
  return b.finish();
}

}  // namespace unshot
