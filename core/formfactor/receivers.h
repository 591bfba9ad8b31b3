// Receivers: where irradiance H is known. Elements for methods that count (their H is a mean over the
// element), display vertices for pointwise methods. And the restriction R: the mean of a receiver field over
// each patch.
#pragma once

#include <span>
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

/// Where a vertex looks from: one view for each surface that it lies on (several where they join smoothly),
/// so that none looks behind its surface. What it receives is their mean by weight.
struct ReceiverView {
  glm::dvec3 position{0.0};  ///< on the surface, moved off edges by a tenth into the triangles around
  glm::dvec3 normal{0.0};    ///< of the surface's side
  double weight = 1;         ///< over the views of a receiver they sum to 1
  std::uint32_t side = 0;    ///< in Mesh::sides
  std::uint32_t patch = 0;   ///< one of those around it on that side
};

struct Receivers {
  ReceiverKind kind = ReceiverKind::kElements;
  std::vector<double> area;             ///< one per receiver [m^2]; sums to the lit area
  std::vector<glm::dvec3> reflectance;  ///< rho, one per receiver
  std::vector<ReceiverView> views;      ///< kVertices only, sorted by receiver
  std::vector<std::uint32_t> view_start{
      0};  ///< views of receiver v: views[view_start[v]] .. view_start[v + 1] - 1
  std::vector<std::uint32_t> start{
      0};                          ///< shares of receiver v: shares[start[v]] .. shares[start[v + 1] - 1]
  std::vector<PatchShare> shares;  ///< sorted by receiver; over a patch they sum to its area

  std::size_t size() const { return area.size(); }
  std::span<const ReceiverView> viewsOf(std::uint32_t v) const {
    return {views.data() + view_start[v], views.data() + view_start[v + 1]};
  }
};

Receivers makeReceivers(const Mesh& mesh, ReceiverKind kind, const CancelToken& cancel = {});

}  // namespace unshot
