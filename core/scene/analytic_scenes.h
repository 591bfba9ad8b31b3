// Scenes whose radiosity is known exactly, for tests and the self-test.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace unshot {

/// Builds scenes from values; positions in metres. finish() computes the frame and bounds.
class SceneBuilder {
 public:
  std::uint32_t material(std::string name, glm::dvec3 reflectance, glm::dvec3 emission = glm::dvec3(0.0));
  /// Corners counter-clockwise seen from the front.
  void polygon(std::uint32_t material, const std::vector<glm::dvec3>& corners);
  /// A parallelogram corner, corner + a, corner + a + b, corner + b; its front is where a x b points.
  void quad(std::uint32_t material, const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b);
  Scene finish();

 private:
  Scene scene_;
};

/// Materials of a box's faces: low and high along x, along y, along z. kNone: there is no such face.
using BoxMaterials = std::array<std::uint32_t, 6>;
BoxMaterials allOf(std::uint32_t material);

/// A parallelepiped of corner + [0, 1] x + [0, 1] y + [0, 1] z (right-handed), fronts inwards or outwards.
void addBox(SceneBuilder& builder, const BoxMaterials& materials, const glm::dvec3& corner,
            const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, bool inwards);
/// The same along the axes.
void addBox(SceneBuilder& builder, const BoxMaterials& materials, const glm::dvec3& corner,
            const glm::dvec3& edges, bool inwards);

/// Inside of the cube [0, 1]^3, fronts inwards. `materials`: floor y = 0, ceiling y = 1, walls z = 0, x = 1,
/// z = 1, x = 0.
Scene cubeScene(const std::array<Material, 6>& materials);

/// Closed cube, every face alike: B = E / (1 - rho).
Scene furnaceScene(double reflectance, double emission);

/// Closed cube of reflectance rho, the face y = 0 with E = 1.
Scene cubeOneFaceLit(double reflectance);

/// Unit squares face to face at distance 1; the upper emits 1 downwards and is black, the lower reflects rho.
Scene parallelSquares(double reflectance);

/// Unit squares along a common edge at a right angle; one emits 1 and is black, the other reflects rho.
Scene perpendicularSquares(double reflectance);

/// Spheres about the origin of radii 0.5 (E1, rho1, seen from outside) and 1 (E2, rho2, seen from inside), as
/// polyhedra of 2 rings^2 quadrilaterals and triangles each, scaled to the area of the true sphere.
Scene concentricSpheres(double rho1, double emission1, double rho2, double emission2, int rings);

/// Two rooms of 1 x 1 x 1 side by side with a wall between; every polygon ends at the wall. A light in the
/// room x < 1.
Scene litAndDarkRoom();

}  // namespace unshot
