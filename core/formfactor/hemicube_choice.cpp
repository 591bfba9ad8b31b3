#include "formfactor/hemicube_choice.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "formfactor/hemicube_picture.h"
#include "formfactor/hemicube_rays.h"
#include "mesh/lit.h"

namespace unshot {

ChosenHemicubeView chooseHemicubeView(const FormFactorSetup& setup) {
  const Mesh& mesh = *setup.mesh;
  const std::size_t triangles = litTriangles(mesh).size();
  HemicubeDrawing drawing = setup.hemicube_drawing;
  if (drawing == HemicubeDrawing::kAuto || drawing == HemicubeDrawing::kClassic) {
    const bool many =
        triangles > (drawing == HemicubeDrawing::kAuto ? kDrawnTrianglesAuto : kDrawnTrianglesClassic);
    drawing = many && !setup.gl().info().hardware ? HemicubeDrawing::kRays : HemicubeDrawing::kOpenGl;
  }
  if (drawing != HemicubeDrawing::kRays)
    return {std::make_unique<HemicubePicture>(setup.gl(), mesh), false, {}};
  return {std::make_unique<HemicubeRays>(mesh, setup.cancel), true,
          "hemicubes are traced with rays: " + std::to_string(triangles) +
              " triangles are too many a picture for a software renderer"};
}

HemicubeFrame turnedHemicube(const Mesh& mesh, std::uint32_t surface_index, const Side& side,
                             const glm::dvec2& chart, double near_distance, std::uint64_t seed) {
  const Surface& surface = mesh.surfaces[surface_index];
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  const std::uint64_t hash =
      mixBits(mixBits(mixBits(seed ^ (surface_index * 2 + side.back)) ^ bits(chart.x)) ^ bits(chart.y));
  const double angle = unitInterval(hash) * std::numbers::pi / 2;
  HemicubeFrame frame;
  frame.eye = surface.point(chart);
  frame.normal = side.normal;
  frame.right = std::cos(angle) * surface.axis_u + std::sin(angle) * surface.axis_v;
  frame.own_surface = surface_index;
  frame.near_distance = near_distance;
  return frame;
}

}  // namespace unshot
