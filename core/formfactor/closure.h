// Closed rows: all that a receiver sees is surfaces, sky or what escapes, so that its form factors and its
// escape sum to 1.
//
// Form factors at points miss this by some thousandths to hundredths, where visibility is decided by few
// rays. A row that sums to 1 - d turns the 1 / (1 - rho) of a closed room into 1 / (1 - rho (1 - d)): at a
// reflectance of 0.99 and d = 1 % half of the light is gone, and where d < 0 there may be no solution at all.
// So the rows are scaled, once all columns are known. Columns of sources that emit a good share of the light
// are exact and stay, those of all emitters where they reflect little; the others take up the difference.
//
// Of two layers of receivers (receivers.h) it is patches that are closed in the end: they take the mean of
// the one layer over other places than that of the other, so that closed rows alone would leave them 1e-5 to
// 1e-3 open, exact form factors no less.
//
// Known error: the difference is spread over all that a receiver sees in proportion, wherever it arose.
#pragma once

#include <span>
#include <vector>

#include "formfactor/receivers.h"
#include "mesh/mesh.h"

namespace unshot {

class Transport;

struct RowClosure {
  std::vector<float> scale;         ///< one per receiver
  std::vector<std::uint8_t> exact;  ///< one per source: whether its column stays as it is
  double rms_defect = 0;            ///< of 1 - sum before, over the receivers, weighted by area
};

/// How much one error of all rows counts in the solution: sum A rho / sum A (1 - rho), of the channel where
/// that is most; infinite where nothing is absorbed.
double reflectionGain(const Mesh& mesh);

/// From all columns of the transport, which must be kept, with receivers at vertices. `escape`: the share of
/// each receiver's view that no surface fills (of two layers of receivers that of the base); empty: none.
RowClosure closeRows(const Mesh& mesh, const Transport& transport, std::span<const float> escape);
/// The same of exact form factors in a closed scene. Of one layer of receivers nothing is scaled.
RowClosure closeExactRows(const Mesh& mesh, const Transport& transport);

}  // namespace unshot
