// Smaller and smaller copies of a picture, for a texture.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "base/image.h"

namespace unshot {

/// The picture and its copies, each half as wide and high (rounded down) as the one before, down to one
/// pixel: means over the area that a pixel covers. Throws Cancelled.
std::vector<ImageF> mipLevels(ImageF image, const CancelToken& cancel = {});

}  // namespace unshot
