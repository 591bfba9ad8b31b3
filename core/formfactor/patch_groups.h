// Patches that lie together on one side of a surface, a few in a node of its subdivision tree: they may shoot
// as one until each is looked at for itself.
#pragma once

#include <cstdint>
#include <vector>

#include "formfactor/regions.h"
#include "mesh/mesh.h"

namespace unshot {

class PatchGroups {
 public:
  /// Groups of the patches without emission, at most about `most` in each; all face the same air
  /// (Mesh::patch_air).
  PatchGroups(const Mesh& mesh, std::uint32_t most);

  /// Group of patch q.
  std::uint32_t of(std::uint32_t q) const { return group_[q]; }
  std::size_t size() const { return members_.size(); }
  const std::vector<std::uint32_t>& members(std::uint32_t group) const { return members_[group]; }
  /// The group as one region, of the area of its patches, to be shot from a point on one of them.
  Region region(std::uint32_t group) const;

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> group_;  // one per patch
  std::vector<std::vector<std::uint32_t>> members_;
};

}  // namespace unshot
