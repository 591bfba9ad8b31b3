// Traces what a hemicube sees: one ray through the centre of each pixel.
#pragma once

#include <vector>

#include "formfactor/hemicube_view.h"
#include "rays/first_hits.h"

namespace unshot {

class HemicubeRays final : public HemicubeView {
 public:
  explicit HemicubeRays(const Mesh& mesh, const CancelToken& cancel = {});

  Result look(const HemicubeFrame& frame, HemicubeLayout layout) override;

 private:
  // What is known of a triangle: its chart position from barycentric weights, and how far its outline is.
  struct Triangle {
    std::uint32_t surface;
    glm::vec2 chart[3];    // 0..1
    float apex_height[3];  // of the corner opposite to edge e over it [m]
  };
  void traceRows(const HemicubeFrame& frame, HemicubeLayout layout, std::uint32_t first_row,
                 std::uint32_t end_row);
  Item itemOf(const FirstHits::Hit& hit, const glm::vec3& direction) const;

  const Mesh& mesh_;
  double far_ = 1;
  std::vector<Triangle> triangles_;
  FirstHits rays_;
  std::vector<glm::vec3> directions_;
  std::vector<FirstHits::Hit> hits_;
  std::vector<Item> items_;
  std::vector<float> distance_;
};

}  // namespace unshot
