// The fields of a snapshot from the state of a solve: irradiance and its direct part, the ambient estimate,
// unshot radiosity.
#pragma once

#include "formfactor/transport.h"
#include "session/snapshot.h"
#include "solver/ambient.h"
#include "solver/bounds.h"
#include "solver/state.h"

namespace unshot {

/// A field on receivers (one value each) at the vertices and on the elements: where one of the two is not
/// what the receivers are, interpolated or averaged. On a mesh that was made for an error values at vertices
/// are those that fit best between them (linear_fit.h).
MeshField makeField(const Mesh& mesh, const Receivers& receivers, const std::vector<glm::dvec3>& values);

/// Mean over each element's display triangles of a field on vertices.
std::vector<glm::vec3> meanOverElements(const Mesh& mesh, const std::vector<glm::dvec3>& field);

/// Values of patches (one each) at the vertices, interpolated.
std::vector<glm::vec3> fieldOfPatches(const Mesh& mesh, const std::vector<glm::dvec3>& values);

/// All of the snapshot but its measures, direct light, bounces and residual.
Snapshot makeFields(std::shared_ptr<const Mesh> mesh, MeshField irradiance, const RadiosityState& state,
                    const AmbientTerm& ambient);

/// The fields that snapshots share as long as they do not change: direct light, expected bounces, residual.
class SharedFields {
 public:
  /// Puts them into `out`, made anew where the state or the bounds have others than at the last call.
  void addTo(Snapshot& out, const Transport& transport, const RadiosityState& state,
             const ErrorBounds& bounds);
  /// RMS residual, one per patch [W/m^2].
  void setResidual(const Mesh& mesh, const std::vector<double>& per_patch);
  /// Sums the rows of K, once the columns of all patches that have light are at hand, of whatever quality.
  /// Returns whether that is new.
  bool sumRows(const Mesh& mesh, const Transport& transport, const RadiosityState& state);
  /// The state shoots again from nothing.
  void forgetDirect() { direct_ = element_direct_ = nullptr; }

 private:
  using Field = std::shared_ptr<const std::vector<glm::vec3>>;

  Field direct_, element_direct_, bounces_, residual_, row_sums_;
  std::uint64_t emission_shots_ = 0;    // of the state that direct_ is of
  std::uint64_t bounces_revision_ = 0;  // of the bounds
  /// What the sums of rows are of.
  struct SummedColumns {
    std::size_t kept = 0;
    std::uint64_t replaced = 0;
    bool closed = false;
    bool operator==(const SummedColumns&) const = default;
  } summed_;
};

}  // namespace unshot
