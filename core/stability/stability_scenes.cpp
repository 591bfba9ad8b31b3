#include "stability/stability_scenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace unshot {
namespace {

constexpr glm::dvec3 kOrigin(0.0), kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

/// Of a manufactured scene: reflects `rho` and emits what makes it as bright as all else.
std::uint32_t glowing(SceneBuilder& b, const glm::dvec3& rho) {
  return b.material("glowing", rho, kManufactured * (1.0 - rho));
}

/// Six of them, from dark to bright, unlike in every channel.
BoxMaterials glowingBox(SceneBuilder& b) {
  BoxMaterials out{};
  for (std::size_t k = 0; k < 6; ++k) {
    const double t = static_cast<double>(k) / 5;
    out[k] = glowing(b, {0.2 + 0.7 * t, 0.8 - 0.6 * t, 0.5});
  }
  return out;
}

void addUnitRoom(SceneBuilder& b) { addBox(b, glowingBox(b), kOrigin, kX, kY, kZ, true); }

}  // namespace

Scene litCube(const glm::dvec3& reflectance, const glm::dvec3& emission) {
  std::array<Material, 6> materials;
  materials.fill({"wall", reflectance, glm::dvec3(0.0)});
  materials[0] = {"lit", reflectance, emission};
  materials[1].name = "opposite";
  return cubeScene(materials);
}

Scene whiteWalls(double white) {
  SceneBuilder b;
  const auto bright = glowing(b, glm::dvec3(white)), grey = glowing(b, glm::dvec3(0.5));
  addBox(b, {bright, bright, grey, grey, bright, bright}, kOrigin, kX, kY, kZ, true);
  return b.finish();
}

Scene interpenetratingBlocks() {
  SceneBuilder b;
  addUnitRoom(b);
  const auto one = glowing(b, {0.6, 0.3, 0.7}), two = glowing(b, {0.3, 0.8, 0.5});
  addBox(b, allOf(one), {0.2, 0.1, 0.3}, {0.5, 0.0, 0.1}, {0.0, 0.4, 0.0}, {-0.06, 0.0, 0.3}, false);
  // Through the first, turned about two axes.
  addBox(b, allOf(two), {0.45, 0.2, 0.25}, {0.25, 0.1, -0.05}, {-0.1, 0.5, 0.1}, {0.03, -0.05, 0.4}, false);
  return b.finish();
}

Scene finsOnOneEdge() {
  SceneBuilder b;
  addUnitRoom(b);
  for (const double turn : {0.1, 0.2, 0.9, 2.0, 3.1, 4.4, 5.6}) {
    const auto fin = glowing(b, glm::dvec3(0.15 * turn, 0.9 - 0.1 * turn, 0.5));
    b.quad(fin, {0.5, 0.15, 0.5}, {0, 0.7, 0}, {0.35 * std::cos(turn), 0, 0.35 * std::sin(turn)});
  }
  return b.finish();
}

Scene twoRoomsWithADoor() {
  SceneBuilder b;
  addBox(b, glowingBox(b), kOrigin, 2.0 * kX, kY, kZ, true);
  const auto wall = glowing(b, {0.7, 0.4, 0.6});
  b.quad(wall, {1, 0, 0}, kY, {0, 0, 0.4});
  b.quad(wall, {1, 0, 0.6}, kY, {0, 0, 0.4});
  b.quad(wall, {1, 0.7, 0.4}, {0, 0.3, 0}, {0, 0, 0.2});
  return b.finish();
}

namespace {

/// A face corner + [0, 1] u + [0, 1] v as a grid of nu x nv quads, chequered in two materials.
void addChequers(SceneBuilder& b, std::uint32_t even, std::uint32_t odd, const glm::dvec3& corner,
                 const glm::dvec3& u, const glm::dvec3& v, int nu, int nv) {
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      const glm::dvec3 at = corner + (static_cast<double>(i) / nu) * u + (static_cast<double>(j) / nv) * v;
      b.quad((i + j) % 2 ? odd : even, at, u / static_cast<double>(nu), v / static_cast<double>(nv));
    }
  }
}

struct CubeFace {
  glm::dvec3 corner, u, v;  ///< u x v points into the cube
};

const std::array<CubeFace, 6> kCubeFaces = {
    {{kOrigin, kY, kZ}, {kX, kZ, kY}, {kOrigin, kZ, kX}, {kY, kX, kZ}, {kOrigin, kX, kY}, {kZ, kY, kX}}};

}  // namespace

Scene manyQuads() {
  SceneBuilder b;
  const BoxMaterials materials = glowingBox(b);
  for (std::size_t k = 0; k < 6; ++k) {
    const CubeFace& face = kCubeFaces[k];
    addChequers(b, materials[k], materials[k], face.corner, face.u, face.v, 130, 130);
  }
  return b.finish();
}

Scene concavePolygons() {
  SceneBuilder b;
  const BoxMaterials m = glowingBox(b);
  const auto inset = glowing(b, {0.3, 0.6, 0.9});
  for (const std::size_t k : {0, 1, 3, 4, 5}) {
    b.quad(m[k], kCubeFaces[k].corner, kCubeFaces[k].u, kCubeFaces[k].v);
  }
  // The floor: an L, and the square that it leaves out.
  b.polygon(m[2], {{0, 0, 0}, {0, 0, 1}, {0.4, 0, 1}, {0.4, 0, 0.4}, {1, 0, 0.4}, {1, 0, 0}});
  b.quad(inset, {0.4, 0, 0.4}, {0, 0, 0.6}, {0.6, 0, 0});
  std::vector<glm::dvec3> star;
  for (int k = 0; k < 10; ++k) {
    const double turn = std::numbers::pi * k / 5, radius = k % 2 ? 0.09 : 0.24;
    star.emplace_back(0.5 + radius * std::cos(turn), 0.75, 0.5 + radius * std::sin(turn));
  }
  b.polygon(inset, star);
  // A block over a U: its top and bottom are concave.
  const std::vector<glm::dvec3> ring{{0.2, 0.1, 0.2},  {0.8, 0.1, 0.2},  {0.8, 0.1, 0.7},  {0.65, 0.1, 0.7},
                                     {0.65, 0.1, 0.4}, {0.35, 0.1, 0.4}, {0.35, 0.1, 0.7}, {0.2, 0.1, 0.7}};
  const glm::dvec3 up(0, 0.3, 0);
  std::vector<glm::dvec3> top(ring.rbegin(), ring.rend());
  for (glm::dvec3& corner : top) corner += up;
  b.polygon(inset, ring);
  b.polygon(inset, top);
  for (std::size_t k = 0; k < ring.size(); ++k)
    b.quad(inset, ring[k], up, ring[(k + 1) % ring.size()] - ring[k]);
  return b.finish();
}

Scene sliverStrips() {
  SceneBuilder b;
  const BoxMaterials m = glowingBox(b);
  for (const std::size_t k : {0, 1, 3, 4, 5}) {
    b.quad(m[k], kCubeFaces[k].corner, kCubeFaces[k].u, kCubeFaces[k].v);
  }
  const std::uint32_t floor[] = {glowing(b, glm::dvec3(0.7)), glowing(b, glm::dvec3(0.2))};
  constexpr int kStrips = 60;
  constexpr double kWidth = 1e-4, kFrom = 0.5 - kStrips * kWidth / 2, kTo = 0.5 + kStrips * kWidth / 2;
  b.quad(floor[1], kOrigin, kZ, {kFrom, 0, 0});
  for (int k = 0; k < kStrips; ++k) b.quad(floor[k % 2], {kFrom + k * kWidth, 0, 0}, kZ, {kWidth, 0, 0});
  b.quad(floor[0], {kTo, 0, 0}, kZ, {1 - kTo, 0, 0});
  return b.finish();
}

Scene needleFan() {
  SceneBuilder b;
  const BoxMaterials m = glowingBox(b);
  for (const std::size_t k : {0, 1, 3, 4, 5}) {
    b.quad(m[k], kCubeFaces[k].corner, kCubeFaces[k].u, kCubeFaces[k].v);
  }
  const std::uint32_t floor[] = {glowing(b, glm::dvec3(0.7)), glowing(b, glm::dvec3(0.2))};
  // Fifty along each edge of the floor, about a point that is not its middle.
  const auto border = [](int k) {
    const double t = (k % 50) / 50.0;
    const glm::dvec3 edges[] = {{t, 0, 0}, {1, 0, t}, {1 - t, 0, 1}, {0, 0, 1 - t}};
    return edges[(k / 50) % 4];
  };
  for (int k = 0; k < 200; ++k) b.polygon(floor[k % 2], {{0.43, 0, 0.57}, border(k + 1), border(k)});
  return b.finish();
}

Scene tJunctions() {
  SceneBuilder b;
  const BoxMaterials m = glowingBox(b);
  for (int k = 0; k < 6; ++k) {
    const CubeFace& face = kCubeFaces[static_cast<std::size_t>(k)];
    addChequers(b, m[static_cast<std::size_t>(k)], m[static_cast<std::size_t>((k + 1) % 6)], face.corner,
                face.u, face.v, 2 + k % 3, 3 + k);
  }
  return b.finish();
}

Scene wrongWindings() {
  SceneBuilder b;
  const BoxMaterials m = glowingBox(b);
  for (std::size_t k = 0; k < 6; ++k) {
    const CubeFace& face = kCubeFaces[k];
    b.quad(m[k], face.corner, k % 2 ? face.u : face.v, k % 2 ? face.v : face.u);
  }
  const auto block = glowing(b, {0.4, 0.7, 0.2});
  // Either way round within one face, too.
  addBox(b, allOf(block), {0.2, 0.1, 0.3}, {0.3, 0, 0}, {0, 0.4, 0}, {0, 0, 0.15}, false);
  addBox(b, allOf(block), {0.2, 0.1, 0.45}, {0.3, 0, 0}, {0, 0.4, 0}, {0, 0, 0.15}, true);
  return b.finish();
}

Scene coplanarPlates() {
  SceneBuilder b;
  addUnitRoom(b);
  const auto plate = glowing(b, {0.4, 0.7, 0.2});
  b.quad(plate, {0.3, 1, 0.2}, {0.4, 0, 0}, {0, 0, 0.3});
  b.quad(plate, {0, 0.23, 0.37}, {0, 0.5, 0}, {0, 0, 0.4});
  addBox(b, allOf(plate), {0.3, 0, 0.35}, {0.35, 0, 0.1}, {0, 0.4, 0}, {-0.08, 0, 0.3}, false);
  return b.finish();
}

Scene duplicatedFaces() {
  SceneBuilder b;
  const BoxMaterials m = glowingBox(b);
  for (std::size_t k = 0; k < 6; ++k) {
    const CubeFace& face = kCubeFaces[k];
    b.quad(m[k], face.corner, face.u, face.v);
    b.quad(m[k], face.corner, face.u, face.v);
    if (k % 2) b.quad(m[k], face.corner, face.v, face.u);
  }
  const auto block = glowing(b, {0.4, 0.7, 0.2});
  for (const bool inwards : {false, true})
    addBox(b, allOf(block), {0.3, 0.2, 0.3}, {0.3, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}, inwards);
  return b.finish();
}

Scene reflectanceOutOfRange(double reflectance) {
  SceneBuilder b;
  const glm::dvec3 counts(reflectance > 1 ? 1.0 : 0.0);
  const auto wrong = b.material("wrong", glm::dvec3(reflectance), kManufactured * (1.0 - counts));
  const auto right = glowing(b, glm::dvec3(0.5));
  addBox(b, {wrong, wrong, right, right, right, right}, kOrigin, kX, kY, kZ, true);
  return b.finish();
}

Scene smallBrightLight() {
  SceneBuilder b;
  const auto wall = b.material("wall", glm::dvec3(0.5)),
             light = b.material("light", glm::dvec3(0.5), glm::dvec3(1e6)),
             floor = b.material("floor", glm::dvec3(0.5));
  for (const std::size_t k : {0, 1, 4, 5})
    b.quad(wall, kCubeFaces[k].corner, kCubeFaces[k].u, kCubeFaces[k].v);
  b.quad(floor, kOrigin, kZ, kX);
  const double edge = std::sqrt(6e-6), near = (1 - edge) / 2, far = (1 + edge) / 2;
  b.quad(light, {near, 1, near}, {edge, 0, 0}, {0, 0, edge});
  b.quad(wall, kY, kX, {0, 0, near});
  b.quad(wall, {0, 1, far}, kX, {0, 0, near});
  b.quad(wall, {0, 1, near}, {near, 0, 0}, {0, 0, edge});
  b.quad(wall, {far, 1, near}, {near, 0, 0}, {0, 0, edge});
  return b.finish();
}

Scene corridor(double reflectance) {
  SceneBuilder b;
  const glm::dvec3 rho(reflectance);
  const auto lit = b.material("lit", rho, glm::dvec3(1.0)), far = b.material("far", rho),
             wall = b.material("wall", rho);
  // The walls' first and last metres are of materials of their own, to be looked at.
  const auto first = b.material("first", rho), last = b.material("last", rho);
  b.quad(lit, kOrigin, kY, kZ);
  b.quad(far, 100.0 * kX, kZ, kY);
  const struct {
    std::uint32_t material;
    double from, to;
  } parts[] = {{first, 0, 1}, {wall, 1, 99}, {last, 99, 100}};
  for (const auto& part : parts) {
    const glm::dvec3 at = part.from * kX, along = (part.to - part.from) * kX;
    b.quad(part.material, at, kZ, along);
    b.quad(part.material, at + kY, along, kZ);
    b.quad(part.material, at, along, kY);
    b.quad(part.material, at + kZ, kY, along);
  }
  return b.finish();
}

Scene narrowGap() {
  SceneBuilder b;
  const auto lit = b.material("lit", glm::dvec3(0.9), glm::dvec3(1.0)),
             other = b.material("other", glm::dvec3(0.9));
  b.quad(lit, kOrigin, kZ, kX);
  b.quad(other, {0, 1e-4, 0}, kX, kZ);
  return b.finish();
}

Scene litAndDarkIsland() {
  SceneBuilder b;
  const glm::dvec3 half(0.5);
  const auto lit = b.material("lit", half, glm::dvec3(1.0)), opposite = b.material("opposite", half),
             wall = b.material("wall", half), dark = b.material("dark", glm::dvec3(0.8));
  addBox(b, {wall, wall, lit, opposite, wall, wall}, kOrigin, kX, kY, kZ, true);
  addBox(b, allOf(dark), 3.0 * kX, kX, kY, kZ, true);
  return b.finish();
}

Scene emittersOnly() {
  SceneBuilder b;
  const auto lower = b.material("lower", glm::dvec3(0.5), glm::dvec3(1.0)),
             upper = b.material("upper", glm::dvec3(0.0), glm::dvec3(3.0));
  b.quad(lower, kOrigin, kZ, kX);
  b.quad(upper, kY, kX, kZ);
  return b.finish();
}

Scene allBlack() {
  SceneBuilder b;
  const auto room = b.material("room", glm::dvec3(0.0), glm::dvec3(1.0)),
             block = b.material("block", glm::dvec3(0.0), glm::dvec3(2.0));
  addBox(b, allOf(room), kOrigin, kX, kY, kZ, true);
  addBox(b, allOf(block), {0.3, 0, 0.3}, 0.3 * kX, 0.5 * kY, 0.3 * kZ, false);
  return b.finish();
}

Scene oneTriangle() {
  SceneBuilder b;
  b.polygon(b.material("lit", glm::dvec3(0.5), glm::dvec3(1.0)), {kOrigin, kX, kY});
  return b.finish();
}

Scene flatSheet() {
  SceneBuilder b;
  const auto lit = b.material("lit", glm::dvec3(0.5), glm::dvec3(1.0)),
             grey = b.material("grey", glm::dvec3(0.5));
  for (int k = 0; k < 9; ++k) b.quad(k == 4 ? lit : grey, {k % 3, 0, k / 3}, kZ, kX);
  return b.finish();
}

}  // namespace unshot
