// PNG written and read row by row, so that both tell how far they are and can be given up at any row. Home of
// libpng.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "base/cancel.h"
#include "base/image.h"

namespace unshot {

/// Gives the bytes of a PNG (8 bits, RGB) to `sink`, some ten kilobytes at a time. The picture is not empty.
/// Throws Cancelled, std::bad_alloc and what the sink throws.
void encodePng(const Image8& image, const std::function<void(std::string_view)>& sink,
               const CancelToken& cancel = {});

/// The picture in linear values, decoded from sRGB; transparency is dropped. None where these bytes are no
/// whole PNG, or an interlaced one. Throws Cancelled.
std::optional<ImageF> decodePng(std::string_view bytes, const CancelToken& cancel = {});

}  // namespace unshot
