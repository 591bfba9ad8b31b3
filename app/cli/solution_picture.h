// Pictures of solutions that were read from files, as far as such a file tells what they are of.
#pragma once

#include "base/image.h"
#include "export/ply.h"
#include "render/picture.h"

namespace unshot {

struct SolutionDifference {
  Image8 image;
  double full = 0;  ///< the difference that has the full colour: median of B's luminance over the surfaces
};

/// A - B of two solutions on the same mesh, in the colours of the display mode `difference`. A PLY file does
/// not tell E, so that light sources count with their own light. On the thread where `context` is current.
/// Throws Error: kInput where a file has no triangles, and what renderPicture throws.
SolutionDifference drawDifference(gl::Context& context, const PlySolution& a, const PlySolution& b,
                                  PictureOptions options);

}  // namespace unshot
