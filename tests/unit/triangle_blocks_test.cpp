// What a view cannot see is not drawn, and all else is.
#include "render/triangle_blocks.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "mesh/build.h"
#include "render/camera.h"
#include "support/dice.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

struct View {
  Camera camera;
  glm::mat4 matrix;
};

View viewOf(const Mesh& mesh, const Camera& camera) {
  return {camera, viewProjection(camera, 1.5, {mesh.bounds_min, mesh.bounds_max}, {}, DepthRange::kReversed)};
}

// How many there are where they come in parts.
std::size_t inParts(const Mesh& mesh, const View& view) {
  const TriangleBlocks blocks(mesh);
  const std::size_t triangles = mesh.triangle_vertices.size() / 3;
  std::size_t count = 0;
  for (TrianglesInView part; part.end < triangles;) {
    part = blocks.inView(view.matrix, homogeneousEye(view.camera, {mesh.bounds_min, mesh.bounds_max}),
                         {part.end, triangles}, 700);
    EXPECT_LE(part.count, 700u);
    count += part.count;
  }
  return count;
}

std::vector<char> drawn(const Mesh& mesh, const View& view) {
  const std::size_t triangles = mesh.triangle_vertices.size() / 3;
  std::vector<char> out(triangles);
  std::size_t last = 0;
  const TrianglesInView all = TriangleBlocks(mesh).inView(
      view.matrix, homogeneousEye(view.camera, {mesh.bounds_min, mesh.bounds_max}), {0, triangles});
  EXPECT_EQ(all.end, triangles);
  EXPECT_EQ(inParts(mesh, view), all.count);
  for (const TriangleRun& run : all.runs) {
    EXPECT_LT(run.first, run.end);
    EXPECT_TRUE(run.first > last || run.first == 0) << "runs that could be one";
    last = run.end;
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(run.first),
              out.begin() + static_cast<std::ptrdiff_t>(run.end), 1);
  }
  return out;
}

glm::dvec3 wayToEye(const Mesh& mesh, const Camera& camera, const glm::dvec3& from) {
  const glm::dvec4 eye(homogeneousEye(camera, {mesh.bounds_min, mesh.bounds_max}));
  return glm::dvec3(eye) - eye.w * from;
}

bool isSeen(const glm::mat4& matrix, const glm::dvec3& p) {
  const glm::dvec4 clip = glm::dmat4(matrix) * glm::dvec4(p, 1.0);
  return clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
}

TEST(TriangleBlocks, DrawAllThatAViewCanSee) {
  Dice dice(5);
  std::size_t left_out = 0, all = 0, seen = 0;
  for (const bool ball : {false, true}) {
    const Mesh mesh =
        buildMesh(ball ? concentricSpheres(0.5, 1, 0.5, 0, 16) : publishedCornellBox(), {8000u, {}, false});
    const double size = glm::distance(mesh.bounds_min, mesh.bounds_max);
    const glm::dvec3 middle = 0.5 * (mesh.bounds_min + mesh.bounds_max);
    for (int k = 0; k < 40; ++k) {
      Camera camera;
      camera.eye = middle + size * dice.between(0, 0.7) * dice.direction();
      camera.at = middle + 0.3 * size * dice.direction();
      camera.fov_deg = dice.between(10, 100);
      camera.orthographic = k % 4 == 3;
      const View view = viewOf(mesh, camera);
      const std::vector<char> is_drawn = drawn(mesh, view);
      for (std::size_t t = 0; t < is_drawn.size(); ++t) {
        ++all;
        left_out += !is_drawn[t];
        glm::dvec3 p[3];
        for (std::size_t c = 0; c < 3; ++c)
          p[c] = glm::dvec3(mesh.vertices[mesh.triangle_vertices[3 * t + c]].position);
        if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), wayToEye(mesh, camera, p[0])) <= 0) continue;
        if (!isSeen(view.matrix, p[0]) && !isSeen(view.matrix, p[1]) &&
            !isSeen(view.matrix, (p[0] + p[1] + p[2]) / 3.0))
          continue;
        ++seen;
        ASSERT_TRUE(is_drawn[t]) << "triangle " << t << ", view " << k;
      }
    }
  }
  EXPECT_GT(seen, all / 10);
  EXPECT_GT(left_out, all / 4) << "hardly anything was left out";
}

TEST(TriangleBlocks, LeaveOutWhatLiesBehindTheEyeAndWhatFacesAway) {
  const Mesh mesh = buildMesh(furnaceScene(0.5, 0.5), {5000u, {}, false});  // seen from inside
  const double size = glm::distance(mesh.bounds_min, mesh.bounds_max);
  const glm::dvec3 middle = 0.5 * (mesh.bounds_min + mesh.bounds_max);
  Camera camera;
  camera.eye = middle + glm::dvec3(0, 0, 2 * size);
  camera.at = middle + glm::dvec3(0, 0, 3 * size);
  const auto count = [&] {
    const std::vector<char> is_drawn = drawn(mesh, viewOf(mesh, camera));
    return std::count(is_drawn.begin(), is_drawn.end(), 1);
  };
  EXPECT_EQ(count(), 0);
  camera.at = middle;
  const auto turned = count();
  EXPECT_GT(turned, 0);
  // The wall before the eye shows its outside, which has no elements.
  EXPECT_LT(turned, static_cast<std::ptrdiff_t>(mesh.triangle_vertices.size() / 3));
}

}  // namespace
}  // namespace unshot
