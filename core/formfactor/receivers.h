// Receivers: where irradiance H is known. Elements for methods that count (their H is a mean over the
// element), display vertices for pointwise methods. And the restriction R: the mean of a receiver field over
// each patch.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

enum class ReceiverKind { kElements, kVertices };

/// One pair of patch and receiver: the area [m^2] of the patch that the receiver stands for.
struct PatchShare {
  std::uint32_t patch = 0;
  std::uint32_t receiver = 0;
  double area = 0;
};

struct Receivers {
  ReceiverKind kind = ReceiverKind::kElements;
  std::vector<double> area;             ///< one per receiver [m^2]; sums to the lit area
  std::vector<glm::dvec3> reflectance;  ///< rho, one per receiver
  std::vector<glm::dvec3> position;  ///< kVertices only: moved off edges by a thousandth towards the element
  std::vector<glm::dvec3> normal;    ///< kVertices only
  std::vector<std::uint32_t> start{
      0};                          ///< shares of receiver v: shares[start[v]] .. shares[start[v + 1] - 1]
  std::vector<PatchShare> shares;  ///< sorted by receiver; over a patch they sum to its area

  std::size_t size() const { return area.size(); }
};

Receivers makeReceivers(const Mesh& mesh, ReceiverKind kind, const CancelToken& cancel = {});

}  // namespace unshot
