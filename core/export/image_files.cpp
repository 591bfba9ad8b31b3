#include "export/image_files.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/read_file.h"
#include "base/srgb.h"
#include "export/png_rows.h"

namespace unshot {
namespace {

void appendTo(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

struct FreeStb {
  void operator()(void* p) const { stbi_image_free(p); }
};

template <class Value>
using StbPixels = std::unique_ptr<Value[], FreeStb>;

[[noreturn]] void failEncoding(const std::filesystem::path& path) {
  throw Error(ErrorKind::kEnvironment, "the picture could not be encoded", path.string(),
              "a smaller picture");
}

template <class Value>
void requireDecoded(const StbPixels<Value>& pixels, const std::filesystem::path& path,
                    const CancelToken& cancel) {
  cancel.check();
  if (pixels) return;
  throw Error(ErrorKind::kInput,
              std::string("this is not a picture that can be read (") + stbi_failure_reason() + ")",
              path.string(), "a PNG, JPEG, Radiance HDR or PFM file");
}

/// Bytes as stb_image reads them; they end where reading is given up.
struct Source {
  std::string_view bytes;
  const CancelToken& cancel;
  // The reader of Radiance's format goes round for ever where bytes end within a row; it is given ends of
  // lines then, as long as it asks: they end a head, and are runs of ten in a row.
  bool padded = false;
  bool ran_out = false;
  std::size_t at = 0;

  static int read(void* user, char* data, int size) {
    auto& source = *static_cast<Source*>(user);
    if (source.cancel.requested() || source.at == source.bytes.size()) {
      source.ran_out = true;
      if (!source.padded) return 0;
      std::fill_n(data, size, '\n');
      return size;
    }
    const std::string_view piece = source.bytes.substr(source.at, static_cast<std::size_t>(size));
    std::copy(piece.begin(), piece.end(), data);
    source.at += piece.size();
    source.cancel.report(static_cast<double>(source.at) / static_cast<double>(source.bytes.size()));
    return static_cast<int>(piece.size());
  }
  static void skip(void* user, int count) {
    auto& source = *static_cast<Source*>(user);
    const auto at = static_cast<std::ptrdiff_t>(source.at) + count;  // stb steps back, too
    source.at = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(at, 0)), source.bytes.size());
  }
  static int ended(void* user) {
    const auto& source = *static_cast<Source*>(user);
    return source.at == source.bytes.size() || source.cancel.requested();
  }
};
constexpr stbi_io_callbacks kSource = {Source::read, Source::skip, Source::ended};

bool isPfm(const std::string& bytes) { return bytes.starts_with("PF") || bytes.starts_with("Pf"); }

/// Portable float map: "PF" (three channels) or "Pf" (one), width, height, scale (below 0: lowest byte
/// first), one white space, then floats, lowest row first.
ImageF pfmImage(const std::string& bytes, const std::filesystem::path& path, const CancelToken& cancel) {
  std::istringstream head(bytes.substr(0, 200));
  std::string magic;
  ImageF image;
  double scale = 0;
  head >> magic >> image.width >> image.height >> scale;
  const bool fits =
      head && image.width > 0 && image.height > 0 && image.width <= 1 << 16 && image.height <= 1 << 16;
  const std::size_t channels = magic == "PF" ? 3 : 1,
                    begin = fits ? static_cast<std::size_t>(head.tellg()) + 1 : 0;
  const std::size_t row = fits ? channels * static_cast<std::size_t>(image.width) : 0;
  if (!fits || bytes.size() != begin + 4 * row * static_cast<std::size_t>(image.height))
    throw Error(ErrorKind::kInput, "this portable float map is broken or cut short", path.string(),
                "another file");
  image.rgb.reserve(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (auto y = static_cast<std::size_t>(image.height); y-- > 0;) {
    cancel.check();
    cancel.report(1 - static_cast<double>(y + 1) / image.height);
    for (std::size_t k = 0; k < 3 * static_cast<std::size_t>(image.width); ++k) {
      const char* from = &bytes[begin + 4 * (y * row + (channels == 3 ? k : k / 3))];
      std::array<char, 4> value = {from[0], from[1], from[2], from[3]};
      if ((scale < 0) != (std::endian::native == std::endian::little))
        std::reverse(value.begin(), value.end());
      image.rgb.push_back(std::bit_cast<float>(value));
    }
  }
  return image;
}

}  // namespace

std::string pngBytes(const Image8& image) {
  std::string bytes;
  if (image.width <= 0 || image.height <= 0) return bytes;
  encodePng(image, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

void writePng(const std::filesystem::path& path, const Image8& image, const CancelToken& cancel) {
  if (image.width <= 0 || image.height <= 0) failEncoding(path);
  writeWholeFile(path,
                 [&](const std::function<void(std::string_view)>& sink) { encodePng(image, sink, cancel); });
}

void writeHdr(const std::filesystem::path& path, const ImageF& image) {
  // stb converts negative values to unsigned bytes, which is undefined.
  std::vector<float> values = image.rgb;
  for (float& value : values) {
    if (!(value > 0)) value = 0;
  }
  std::string bytes;
  if (!stbi_write_hdr_to_func(appendTo, &bytes, image.width, image.height, 3, values.data()))
    failEncoding(path);
  writeWholeFile(path, bytes);
}

PictureFile readPicture(const std::filesystem::path& path, const CancelToken& cancel) {
  const std::string bytes = readFile(path);
  cancel.check();
  if (isPfm(bytes)) return {pfmImage(bytes, path, cancel), true};
  if (std::optional<ImageF> png = decodePng(bytes, cancel)) return {std::move(*png), false};
  Source source{bytes, cancel};
  ImageF image;
  int channels = 0;
  const auto size = [&] { return 3 * std::size_t(image.width) * std::size_t(image.height); };
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  if (stbi_is_hdr_from_memory(data, static_cast<int>(bytes.size()))) {
    source.padded = true;
    const StbPixels<float> pixels(
        stbi_loadf_from_callbacks(&kSource, &source, &image.width, &image.height, &channels, 3));
    requireDecoded(pixels, path, cancel);
    if (source.ran_out)
      throw Error(ErrorKind::kInput, "this picture is cut short", path.string(), "another file");
    image.rgb.assign(pixels.get(), pixels.get() + size());
    return {std::move(image), true};
  }
  const StbPixels<stbi_us> pixels(
      stbi_load_16_from_callbacks(&kSource, &source, &image.width, &image.height, &channels, 3));
  requireDecoded(pixels, path, cancel);
  image.rgb.resize(size());
  for (std::size_t k = 0; k < image.rgb.size(); ++k) {
    if (k % 4096 == 0) cancel.check();
    image.rgb[k] = static_cast<float>(linearFromSrgb(pixels[k] / 65535.0));
  }
  return {std::move(image), false};
}

ImageF readImage(const std::filesystem::path& path) { return readPicture(path).image; }

}  // namespace unshot
