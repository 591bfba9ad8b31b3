// Fifth table: what knowing the error costs.
#pragma once

namespace unshot::bench {

/// The bundled Cornell box by every iteration mode, two_rooms and library for a while by progressive
/// refinement: the solve, its bounds as a share of it, and an estimate from 256 places afterwards. `quick`:
/// small meshes.
void printEstimateTable(bool quick);

}  // namespace unshot::bench
