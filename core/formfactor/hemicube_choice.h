// What methods that look through hemicubes share: who draws them, and how they stand.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "formfactor/hemicube_view.h"
#include "formfactor/methods.h"

namespace unshot {

struct ChosenHemicubeView {
  std::unique_ptr<HemicubeView> view;
  bool traced = false;
  std::string note;  ///< why, where it is out of the ordinary
};

/// OpenGL draws, but where a software rasteriser would have to chew through thousands of triangles a picture:
/// its cost grows with all of them (25 ms at 210,000), a ray's with their logarithm (1 ms).
ChosenHemicubeView chooseHemicubeView(const FormFactorSetup& setup);

/// A hemicube on a side at a point of its chart, turned about the normal by an angle of its own, so that the
/// pixels' grid leaves no pattern.
HemicubeFrame turnedHemicube(const Mesh& mesh, std::uint32_t surface, const Side& side,
                             const glm::dvec2& chart, double near_distance, std::uint64_t seed);

}  // namespace unshot
