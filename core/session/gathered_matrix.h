// Gathers K to a small matrix among groups of patches, a little at a time.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "formfactor/transport.h"
#include "session/insight.h"
#include "solver/state.h"

namespace unshot {

/// Groups of patches, kMostGroups at most: nodes of the surfaces' trees as fine as that allows. Where there
/// are more sides than groups, the smallest share a group by material, and at last all together.
std::vector<std::uint32_t> patchGroups(const Mesh& mesh, std::size_t most);

class MatrixGatherer {
 public:
  /// All outlive it.
  MatrixGatherer(const Mesh& mesh, const Transport& transport, const RadiosityState& state);

  /// Whether columns are at hand that are not gathered yet, and nearly all that hold light among them.
  bool hasWork() const;
  /// How much of the one under way is gathered, from 0 to 1; none where none is.
  std::optional<double> done() const;
  /// Goes on for some milliseconds. Returns whether the matrix is complete now.
  bool advance();
  /// The last one that was completed; null before.
  const std::shared_ptr<const GatheredMatrix>& matrix() const { return matrix_; }
  /// Area means over its groups of one value a patch.
  std::vector<glm::dvec3> gathered(const std::vector<glm::dvec3>& per_patch) const;

 private:
  struct Columns {
    std::size_t kept = 0;
    std::uint64_t replaced = 0;
    bool closed = false;
    bool operator==(const Columns&) const = default;
  };
  std::vector<std::uint32_t> missing() const;
  Columns columns() const;
  std::vector<std::uint32_t> groups() const;
  void begin();

  const Mesh& mesh_;
  const Transport& transport_;
  const RadiosityState& state_;
  std::shared_ptr<GatheredMatrix> growing_;
  std::uint32_t next_ = 0;  // column
  Columns of_;              // that growing_, or else matrix_, is made of
  std::shared_ptr<const GatheredMatrix> matrix_;
};

}  // namespace unshot
