// Pictures in files: PNG (8 bits, sRGB), Radiance HDR and, to be read, PFM (both linear). Home of stb_image
// and stb_image_write.
#pragma once

#include <filesystem>
#include <string>

#include "base/cancel.h"
#include "base/image.h"

namespace unshot {

/// The bytes of a PNG; empty where it cannot be encoded.
std::string pngBytes(const Image8& image);

/// Writes a PNG. Throws Error (kEnvironment), Cancelled: then `path` is as it was.
void writePng(const std::filesystem::path& path, const Image8& image, const CancelToken& cancel = {});

/// Writes Radiance RGBE: about 1 % precision per channel, relative to the brightest of a pixel; what is
/// negative or no number becomes 0. Throws Error (kEnvironment).
void writeHdr(const std::filesystem::path& path, const ImageF& image);

/// What a picture's file holds, as linear values: HDR and PFM as they are, PNG and others (8 or 16 bits)
/// decoded from sRGB to 0..1. Transparency is dropped.
struct PictureFile {
  ImageF image;
  bool light = false;  ///< linear light (HDR, PFM), not values of a display
};
/// Throws Error (kInput), Cancelled.
PictureFile readPicture(const std::filesystem::path& path, const CancelToken& cancel = {});
/// The picture alone.
ImageF readImage(const std::filesystem::path& path);

}  // namespace unshot
