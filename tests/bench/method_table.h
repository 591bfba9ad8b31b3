// What each form-factor method reaches in what time.
#pragma once

namespace unshot::bench {

/// Solves the published Cornell box by each method at several finenesses until the solver adds next to
/// nothing, and prints the error of reflected light against path-traced truth beside CPU time (mesh, form
/// factors, solution; the median of `repeats` warm solves in this process, and the first beside) and memory.
void printMethodTable(bool quick);

}  // namespace unshot::bench
