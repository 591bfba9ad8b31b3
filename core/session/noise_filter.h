// Evens out the noise of what vertices have gathered, and nothing that is more than noise: each vertex takes
// a mean over those around it that differ from it by no more than their noise lets them, again and again
// over wider surroundings.
//
// Source: the bilateral filter steered by variance of H. Dammertz, D. Sewtz, J. Hanika and H. P. A. Lensch,
// "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering", 2010, and C. Schied et
// al., "Spatiotemporal Variance-Guided Filtering", 2017, on the vertices of a mesh in place of pixels.
#pragma once

#include <cstdint>
#include <vector>

#include "base/workers.h"
#include "mesh/mesh.h"

namespace unshot {

/// Vertices lie beside each other along the sides of triangles, and where they are in one place and face one
/// way, of whatever surface.
class NoiseFilter {
 public:
  explicit NoiseFilter(const Mesh& mesh);

  /// `values`, one per vertex, with how well they are known: `variance`, one per vertex, of the sum over the
  /// channels, as a few random looks tell it. Where nothing comes at all, nothing comes. The same with any
  /// number of workers.
  std::vector<glm::dvec3> filtered(std::vector<glm::dvec3> values, std::vector<double> variance,
                                   Workers& workers) const;

 private:
  std::vector<std::uint32_t> start_{0};  // of each vertex' neighbours in around_
  std::vector<std::uint32_t> around_;    // vertices
};

}  // namespace unshot
