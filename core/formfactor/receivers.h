// Receivers: where irradiance H is known. Elements for methods that count (their H is a mean over the
// element), display vertices for pointwise methods. And the restriction R: the mean of a receiver field over
// each patch.
//
// On a refined mesh (Mesh::base) light straight from emitters, which has shadows, arrives at all vertices,
// and light from other patches, which is smooth, at those of the base alone: there are two layers of
// receivers, one after the other, and what a vertex receives is its own and what the base's vertices around
// it have.
#pragma once

#include <glm/common.hpp>
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
/// so that none looks behind its surface, but one for those that are one patch. What it receives is their
/// mean by weight.
struct ReceiverView {
  glm::dvec3 position{0.0};  ///< on the surface, moved off edges by a tenth into the triangles around
  glm::dvec3 normal{0.0};    ///< of the surface's side; of several the mean
  double weight = 1;         ///< over the views of a receiver they sum to 1
  std::uint32_t side = 0;    ///< in Mesh::sides
  std::uint32_t patch = 0;   ///< one of those around it on that side
};

struct Receivers {
  ReceiverKind kind = ReceiverKind::kElements;
  std::vector<double> area;             ///< one per receiver [m^2]; over a layer they sum to the lit area
  std::vector<glm::dvec3> reflectance;  ///< rho, one per receiver
  std::vector<ReceiverView> views;      ///< kVertices only, sorted by receiver
  std::vector<std::uint32_t> view_start{
      0};  ///< views of receiver v: views[view_start[v]] .. view_start[v + 1] - 1
  std::vector<std::uint32_t> start{
      0};                          ///< shares of receiver v: shares[start[v]] .. shares[start[v + 1] - 1]
  std::vector<PatchShare> shares;  ///< sorted by receiver; over a patch they sum to its area in each layer

  std::uint32_t base_first = 0;  ///< of the receivers on the base; 0 where there is one layer
  SparseRows from_base;          ///< of each vertex: indices are receivers; empty where there is one layer

  std::size_t size() const { return area.size(); }
  bool layered() const { return base_first > 0; }
  /// Receivers that show: elements or vertices of the mesh.
  std::size_t shownCount() const { return layered() ? base_first : size(); }
  /// Those on which light of a patch arrives.
  Range reachedBy(bool emitter) const {
    const auto n = static_cast<std::uint32_t>(size());
    return !layered() ? Range{0, n} : emitter ? Range{0, base_first} : Range{base_first, n - base_first};
  }
  /// What shown receiver v has of a field on receivers: its own value, and what is interpolated of the base's
  /// values around it, which it does not go beyond.
  glm::dvec3 shown(std::uint32_t v, const std::vector<glm::dvec3>& field) const {
    if (!layered() || from_base.start[v] == from_base.start[v + 1]) return field[v];
    glm::dvec3 sum(0.0), least = field[from_base.index[from_base.start[v]]], most = least;
    for (std::uint32_t k = from_base.start[v]; k < from_base.start[v + 1]; ++k) {
      const glm::dvec3& value = field[from_base.index[k]];
      sum += static_cast<double>(from_base.weight[k]) * value;
      least = glm::min(least, value);
      most = glm::max(most, value);
    }
    return field[v] + glm::clamp(sum, least, most);
  }
  std::span<const ReceiverView> viewsOf(std::uint32_t v) const {
    return {views.data() + view_start[v], views.data() + view_start[v + 1]};
  }
};

Receivers makeReceivers(const Mesh& mesh, ReceiverKind kind, const CancelToken& cancel = {});

}  // namespace unshot
