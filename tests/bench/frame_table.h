// Third table: what frames of the viewer cost while it solves, and how soon a picture stands.
#pragma once

#include <cstdint>
#include <vector>

namespace unshot::bench {

/// Prints one line per number of elements of the Cornell box: times of frames that draw the scene, and what
/// the solver keeps of its rate. `seconds`: length of each measurement [s].
void printFrameTable(const std::vector<std::uint64_t>& elements, double seconds);

/// Prints when the first picture of the Cornell box stands, when it looks right, and when it has converged.
void printOpeningTable(const std::vector<std::uint64_t>& elements);

}  // namespace unshot::bench
