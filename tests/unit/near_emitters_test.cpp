// Cells beside small emitters.
#include "mesh/near_emitters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "formfactor/polygon_factor.h"
#include "mesh/build.h"
#include "scene/analytic_scenes.h"
#include "support/solving.h"

namespace unshot {
namespace {

using testing_support::solved;

constexpr double kLamp = 0.1, kLampHeight = 0.3;
constexpr double kReflectance = 0.5, kEmission = 100;

enum Surfaces : std::uint32_t { kGround, kNear, kFar, kBehind, kLampFace };

/// Slabs of 1 m and a lamp above one of them that shines down; a ground below that makes cells of 1 m usual.
Scene slabs() {
  SceneBuilder b;
  const std::uint32_t grey = b.material("grey", glm::dvec3(kReflectance));
  const std::uint32_t lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(kEmission));
  const glm::dvec3 x(1, 0, 0), z(0, 0, 1);
  b.quad(grey, {-50, -20, -50}, 100.0 * z, 100.0 * x);
  b.quad(grey, {0, 0, 0}, z, x);
  b.quad(grey, {20, 0, 0}, z, x);
  b.quad(grey, {0, kLampHeight + 0.2, 0}, z, x);
  const double at = 0.5 - kLamp / 2;
  b.quad(lamp, {at, kLampHeight, at}, kLamp * x, kLamp * z);
  return b.finish();
}

MeshOptions shinesDown() {
  MeshOptions options;
  options.emit_front_only = true;
  return options;
}

TEST(NearEmitters, OnlyWhatTheyLightIsCutFiner) {
  const Mesh mesh = buildMesh(slabs(), shinesDown());
  ASSERT_EQ(mesh.surfaces.size(), 5u);
  EXPECT_EQ(mesh.surfaces[kNear].nu, std::round(1 / (kLampHeight / 3)));
  EXPECT_EQ(mesh.surfaces[kNear].nv, mesh.surfaces[kNear].nu);
  for (const Surfaces s : {kFar, kBehind, kLampFace}) EXPECT_EQ(mesh.surfaces[s].elements.count, 1u) << s;
  EXPECT_NEAR(mesh.surfaces[kGround].nu, 100, 3) << "far below";
}

// A fineness that was asked for is kept.
TEST(NearEmitters, AFinenessThatWasAskedForIsKept) {
  MeshOptions options = shinesDown();
  options.element_size = 1.2;
  EXPECT_EQ(buildMesh(slabs(), options).surfaces[kNear].elements.count, 1u);
  options.element_size.reset();
  options.elements = 8'000;
  EXPECT_EQ(buildMesh(slabs(), options).surfaces[kNear].elements.count, 1u);
}

// Whatever is right beside it or lies in it, cells stay within their number.
TEST(NearEmitters, NeverCutWithoutEnd) {
  SceneBuilder b;
  const std::uint32_t grey = b.material("grey", glm::dvec3(kReflectance));
  const std::uint32_t lamp = b.material("lamp", glm::dvec3(kReflectance), glm::dvec3(1.0));
  b.quad(grey, {-50, 0, -50}, {0, 0, 100}, {100, 0, 0});
  b.quad(grey, {0, 10, 0}, {0, 0, 1}, {1, 0, 0});
  b.quad(lamp, {0.5, 10.01, 0.5}, {0, 0, 0.02}, {0.02, 0, 0});
  b.quad(lamp, {0.2, 9.5, 0.5}, {0, 1, 0}, {0.02, 0, 0});  // through it
  const Mesh mesh = buildMesh(b.finish(), {});
  EXPECT_LE(mesh.surfaces[1].elements.count, 2 * 300u);
  EXPECT_GE(mesh.surfaces[1].elements.count, 200u);
}

// B = rho E F at points of the slab, F exactly. Lines between vertices a third of the lamp's height apart
// leave some 6 %, elements' means at vertices and pixels of the lamp's picture the rest; of one element the
// mean of the whole slab remains.
TEST(NearEmitters, LightBesideALampIsRight) {
  const auto deviation = [](std::optional<double> size) {
    SolveOptions options;
    options.form_factors = "hemicube";
    options.emit_front_only = true;
    options.element_size = size;
    const auto solve = solved(slabs(), options);
    const Mesh& mesh = solve->mesh();
    const Snapshot snapshot = solve->snapshot();
    const double at = 0.5 - kLamp / 2, to = 0.5 + kLamp / 2;
    const std::vector<glm::dvec3> lamp{
        {at, kLampHeight, at}, {to, kLampHeight, at}, {to, kLampHeight, to}, {at, kLampHeight, to}};
    double squares = 0, of = 0;
    std::vector<glm::dvec3> scratch;
    for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
      glm::dvec3 middle(0.0);
      double b = 0;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.triangle_vertices[3 * t + k];
        middle += glm::dvec3(mesh.vertices[v].position) / 3.0;
        b += kReflectance * (snapshot.irradiance[v].x + snapshot.ambient[v].x) / 3.0;
      }
      middle += mesh.frame_origin;
      const bool on_slab = std::abs(middle.y) < 1e-6 && middle.x > 0 && middle.x < 1;
      if (!on_slab || mesh.sides[mesh.element_side[mesh.triangle_element[t]]].normal.y < 0) continue;
      const double truth = kReflectance * kEmission * pointToPolygonFactor(middle, {0, 1, 0}, lamp, scratch);
      squares += (b - truth) * (b - truth);
      of += truth * truth;
    }
    return std::sqrt(squares / of);
  };
  EXPECT_LT(deviation({}), 0.12);
  EXPECT_GT(deviation(1.2), 0.3);
}

}  // namespace
}  // namespace unshot
