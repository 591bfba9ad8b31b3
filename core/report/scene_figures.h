// What a scene consists of, in figures.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "scene/scene.h"

namespace unshot {

struct SceneFigures {
  std::size_t faces = 0;     ///< in the file
  std::size_t polygons = 0;  ///< planar ones that they became
  std::size_t triangles = 0;
  std::size_t materials = 0;   ///< in use
  std::size_t emitters = 0;    ///< polygons that emit
  glm::dvec3 extent{0.0};      ///< edges of the bounding box [m]
  double area = 0;             ///< of the polygons, one side each [m^2]
  double emitter_area = 0;     ///< of those that emit, one side each [m^2]
  std::size_t open_edges = 0;  ///< edges that an odd number of polygons have
  /// Every edge belongs to an even number of polygons. Edges are compared corner by corner, so a corner
  /// within a neighbour's edge leaves both open: "false" means not shown to be closed.
  bool closed() const { return polygons > 0 && open_edges == 0; }
};

SceneFigures figuresOf(const Scene& scene);

}  // namespace unshot
