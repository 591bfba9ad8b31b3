// Rectangles of receivers over which a column of K is smooth unless something comes in between: what it is at
// nine of them tells whether the others follow from those.
#pragma once

#include <cstdint>
#include <vector>

#include "formfactor/receivers.h"

namespace unshot {

struct ReceiverBlock {
  std::uint32_t nu = 0, nv = 0;       ///< cells along u and v of their side
  std::vector<std::uint32_t> vertex;  ///< receivers at the cells' corners, (nu + 1) (nv + 1), rows along u

  std::uint32_t at(std::uint32_t i, std::uint32_t j) const { return vertex[j * (nu + 1) + i]; }
};

struct ReceiverBlocks {
  std::vector<ReceiverBlock> blocks;  ///< they share the receivers on common borders
  std::vector<std::uint32_t> rest;    ///< those in none
};

/// Of the receivers on the base of a refined mesh: blocks of whole cells, each of whose corners looks from
/// one side alone, without a contact between. Empty where there is one layer of receivers.
ReceiverBlocks receiverBlocks(const Mesh& mesh, const Receivers& receivers, const CancelToken& cancel = {});

}  // namespace unshot
