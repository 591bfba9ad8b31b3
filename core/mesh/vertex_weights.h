// How a display vertex takes its value from elements: weights, while they are being made.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace unshot {

struct VertexWeight {
  std::uint32_t element;
  float weight;
};

/// A row may be made of rows that were made so themselves, and would grow fourfold each time: longer ones are
/// merged. With cells as narrow as the weld distance such chains are long.
inline constexpr std::size_t kManyVertexWeights = 64;

/// Makes one entry of those of the same element.
inline void mergeEqual(std::vector<VertexWeight>& row) {
  std::sort(row.begin(), row.end(),
            [](const VertexWeight& a, const VertexWeight& b) { return a.element < b.element; });
  std::size_t kept = 0;
  for (std::size_t k = 1; k < row.size(); ++k) {
    if (row[k].element == row[kept].element) {
      row[kept].weight += row[k].weight;
    } else {
      row[++kept] = row[k];
    }
  }
  if (!row.empty()) row.resize(kept + 1);
}

}  // namespace unshot
