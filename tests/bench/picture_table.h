// First table: what a hemicube and a column of the Cornell box cost, and how exact a column is.
#pragma once

#include <cstdint>
#include <vector>

namespace unshot::bench {

/// Prints one line per number of elements. `pictures`: hemicubes timed; `columns`: columns compared with a
/// dense reference.
void printPictureTable(const std::vector<std::uint64_t>& elements, int pictures, int columns);

}  // namespace unshot::bench
