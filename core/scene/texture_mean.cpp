// Mean reflectance of a texture.
//
// 8- and 16-bit images are sRGB (IEC 61966-2-1): each value is decoded to linear light before the mean is
// taken, since light adds up linearly; the mean of the encoded values would be too dark or too bright by tens
// of percent. Radiance HDR files are linear already. Alpha is not looked at. Assumes that the texture covers
// its surface evenly; 16 bits are read as 8.
#include "scene/texture_mean.h"

#include <stb_image.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

namespace unshot {
namespace {

double srgbToLinear(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::array<double, 256> decodingTable() {
  std::array<double, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = srgbToLinear(static_cast<double>(i) / 255.0);
  return table;
}

template <class Value, class Decode>
glm::dvec3 meanOf(const Value* pixels, int width, int height, Decode decode) {
  glm::dvec3 sum{0.0};
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t i = 0; i < count; ++i) {
    sum += glm::dvec3(decode(pixels[3 * i]), decode(pixels[3 * i + 1]), decode(pixels[3 * i + 2]));
  }
  return sum / static_cast<double>(count);
}

}  // namespace

std::optional<glm::dvec3> textureMean(const std::filesystem::path& path) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure)) return std::nullopt;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return std::nullopt;
  int width = 0, height = 0, channels = 0;
  if (stbi_is_hdr_from_file(file.get())) {
    const std::unique_ptr<float, void (*)(void*)> pixels(
        stbi_loadf_from_file(file.get(), &width, &height, &channels, 3), &stbi_image_free);
    if (!pixels || width < 1 || height < 1) return std::nullopt;
    return meanOf(pixels.get(), width, height, [](float value) { return static_cast<double>(value); });
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_file(file.get(), &width, &height, &channels, 3), &stbi_image_free);
  if (!pixels || width < 1 || height < 1) return std::nullopt;
  const std::array<double, 256> table = decodingTable();
  return meanOf(pixels.get(), width, height, [&table](stbi_uc value) { return table[value]; });
}

}  // namespace unshot
