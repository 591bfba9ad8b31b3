#include "stability/lit_cube_truth.h"

#include <algorithm>
#include <array>

namespace unshot {

std::span<const LitCubeTruth> litCubeTruths() {
  static constexpr std::array<LitCubeTruth, 6> kTable{{{0.5, 1.104363, 0.171213, 0.181106},
                                                       {0.8, 1.587505, 0.660974, 0.687880},
                                                       {0.9, 2.419365, 1.487882, 1.523188},
                                                       {0.99, 17.420237, 16.480327, 16.524859},
                                                       {0.999, 167.420324, 166.479517, 166.525040},
                                                       {0.9999, 1667.420333, 1666.479437, 1666.525058}}};
  return kTable;
}

const LitCubeTruth& litCubeTruth(double reflectance) {
  const auto table = litCubeTruths();
  return *std::find_if(table.begin(), table.end(),
                       [&](const LitCubeTruth& row) { return row.reflectance == reflectance; });
}

}  // namespace unshot
