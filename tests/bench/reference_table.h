// Fourth table: what a path-traced reference costs.
#pragma once

#include <cstddef>

namespace unshot::bench {

/// Traces references of so many points to a relative standard error: the Cornell box and closed cubes of
/// reflectance 0.5, 0.9 and 0.99 with one face lit.
void printReferenceTable(std::size_t points, double relative_error);

}  // namespace unshot::bench
