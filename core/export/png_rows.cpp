#include "export/png_rows.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "base/srgb.h"

namespace unshot {
namespace {

// libpng jumps over what it was called from when something is wrong: between a call of setjmp and the last of
// libpng that it is for, nothing may be made that needs to be destroyed, and no callback may throw.

constexpr std::uint32_t kLongest = 1u << 24, kMostPixels = 1u << 30;  // as stb_image has it
constexpr std::size_t kPiece = 1 << 16;                               // bytes given on at once

void ignore(png_structp, png_const_charp) {}
[[noreturn]] void jump(png_structp png, png_const_charp) { png_longjmp(png, 1); }

// Writing.

class Encoder {
 public:
  Encoder() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, jump, ignore)) {
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) {
      png_destroy_write_struct(&png_, &info_);
      throw std::bad_alloc();
    }
    png_set_write_fn(png_, this, append, nullptr);
  }
  ~Encoder() { png_destroy_write_struct(&png_, &info_); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  void begin(int width, int height) {
    if (setjmp(png_jmpbuf(png_))) throw std::bad_alloc();
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png_, info_);
  }
  void add(const std::uint8_t* row) {
    if (setjmp(png_jmpbuf(png_))) throw std::bad_alloc();
    png_write_row(png_, row);
  }
  void end() {
    if (setjmp(png_jmpbuf(png_))) throw std::bad_alloc();
    png_write_end(png_, info_);
  }
  /// What was written since; to be emptied by whoever takes it.
  std::string bytes;

 private:
  static void append(png_structp png, png_bytep data, std::size_t size) {
    auto& self = *static_cast<Encoder*>(png_get_io_ptr(png));
    bool fits = true;
    try {
      self.bytes.append(reinterpret_cast<const char*>(data), size);
    } catch (const std::bad_alloc&) {
      fits = false;
    }
    if (!fits) png_error(png, "no memory");
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

// Reading.

class Decoder {
 public:
  explicit Decoder(std::string_view bytes)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, jump, ignore)), bytes_(bytes) {
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, this, take);
    png_set_user_limits(png_, kLongest, kLongest);
  }
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  /// Whether this is a picture whose rows follow each other, as RGB of 8 or 16 bits then.
  bool begin() {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_read_info(png_, info_);
    if (png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE || width() > kMostPixels / height())
      return false;
    png_set_expand(png_);
    png_set_strip_alpha(png_);
    png_set_gray_to_rgb(png_);
    png_read_update_info(png_, info_);
    return png_get_channels(png_, info_) == 3;
  }
  png_uint_32 width() const { return png_get_image_width(png_, info_); }
  png_uint_32 height() const { return png_get_image_height(png_, info_); }
  bool deep() const { return png_get_bit_depth(png_, info_) == 16; }
  std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }

  bool read(std::uint8_t* row) {
    if (setjmp(png_jmpbuf(png_))) return false;
    png_read_row(png_, row, nullptr);
    return true;
  }

 private:
  static void take(png_structp png, png_bytep data, std::size_t size) {
    auto& self = *static_cast<Decoder*>(png_get_io_ptr(png));
    if (size > self.bytes_.size()) png_error(png, "cut short");
    std::memcpy(data, self.bytes_.data(), size);
    self.bytes_.remove_prefix(size);
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::string_view bytes_;  // that are left
};

std::vector<float> linearValues(bool deep) {
  std::vector<float> out(deep ? 65536 : 256);
  const double most = static_cast<double>(out.size() - 1);
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = static_cast<float>(linearFromSrgb(static_cast<double>(k) / most));
  return out;
}

}  // namespace

void encodePng(const Image8& image, const std::function<void(std::string_view)>& sink,
               const CancelToken& cancel) {
  const auto row = 3 * static_cast<std::size_t>(image.width);
  Encoder encoder;
  encoder.begin(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    cancel.check();
    cancel.report(static_cast<double>(y) / image.height);
    encoder.add(&image.rgb[static_cast<std::size_t>(y) * row]);
    if (encoder.bytes.size() < kPiece) continue;
    sink(encoder.bytes);
    encoder.bytes.clear();
  }
  encoder.end();
  cancel.check();
  sink(encoder.bytes);
}

std::optional<ImageF> decodePng(std::string_view bytes, const CancelToken& cancel) {
  constexpr std::size_t kSignature = 8;
  if (bytes.size() < kSignature ||
      png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, kSignature) != 0)
    return std::nullopt;
  Decoder decoder(bytes);
  if (!decoder.begin()) return std::nullopt;
  const bool deep = decoder.deep();
  const std::vector<float> linear = linearValues(deep);
  ImageF image{static_cast<int>(decoder.width()), static_cast<int>(decoder.height()), {}};
  std::vector<std::uint8_t> row(decoder.rowBytes());
  const std::size_t samples = 3 * static_cast<std::size_t>(image.width);
  for (int y = 0; y < image.height; ++y) {
    cancel.check();
    cancel.report(static_cast<double>(y) / image.height);
    if (!decoder.read(row.data())) return std::nullopt;
    // Not before there is a row: a broken head may ask for any size.
    if (y == 0) image.rgb.reserve(samples * static_cast<std::size_t>(image.height));
    for (std::size_t k = 0; k < samples; ++k)
      image.rgb.push_back(linear[deep ? row[2 * k] << 8 | row[2 * k + 1] : row[k]]);
  }
  return image;
}

}  // namespace unshot
