#include "export/png_rows.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "base/srgb.h"

namespace unshot {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t kPiece = 1 << 16;                               // bytes of compressed rows in a chunk
constexpr std::uint32_t kLongest = 1u << 24, kMostPixels = 1u << 30;  // as stb_image has it
constexpr int kFilters = 5;

using Bytes = std::vector<std::uint8_t>;

/// What filter `kind` says about a byte, from the one to its left, the one above and the one left of that.
int predicted(int kind, int left, int above, int corner) {
  switch (kind) {
    case 1:
      return left;
    case 2:
      return above;
    case 3:
      return (left + above) / 2;
    case 4: {
      const int p = left + above - corner;
      const int to_left = std::abs(p - left), to_above = std::abs(p - above),
                to_corner = std::abs(p - corner);
      if (to_left <= to_above && to_left <= to_corner) return left;
      return to_above <= to_corner ? above : corner;
    }
    default:
      return 0;
  }
}

// Writing.

void appendNumber(std::string& out, std::uint32_t n) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(n >> shift & 255));
}

std::string chunk(std::string_view type, std::string_view data) {
  std::string out;
  appendNumber(out, static_cast<std::uint32_t>(data.size()));
  out.append(type).append(data);
  const auto* checked = reinterpret_cast<const Bytef*>(out.data() + 4);
  appendNumber(out, static_cast<std::uint32_t>(crc32(0, checked, static_cast<uInt>(out.size() - 4))));
  return out;
}

/// A row as it is compressed: the number of the filter that leaves the least, and what it leaves.
class RowFilter {
 public:
  explicit RowFilter(std::size_t bytes) : above_(bytes, 0) {
    for (Bytes& row : tried_) row.resize(bytes + 1);
  }
  const Bytes& filtered(const std::uint8_t* row) {
    constexpr std::size_t kPixel = 3;
    std::size_t best = 0, least = SIZE_MAX;
    for (int kind = 0; kind < kFilters; ++kind) {
      Bytes& out = tried_[static_cast<std::size_t>(kind)];
      out[0] = static_cast<std::uint8_t>(kind);
      std::size_t sum = 0;
      for (std::size_t k = 0; k < above_.size(); ++k) {
        const int left = k < kPixel ? 0 : row[k - kPixel], corner = k < kPixel ? 0 : above_[k - kPixel];
        out[k + 1] = static_cast<std::uint8_t>(row[k] - predicted(kind, left, above_[k], corner));
        sum += static_cast<std::size_t>(std::abs(static_cast<std::int8_t>(out[k + 1])));
      }
      if (sum >= least) continue;
      least = sum;
      best = static_cast<std::size_t>(kind);
    }
    std::copy_n(row, above_.size(), above_.begin());
    return tried_[best];
  }

 private:
  Bytes above_;
  std::array<Bytes, kFilters> tried_;
};

class Deflater {
 public:
  explicit Deflater(const std::function<void(std::string_view)>& sink) : sink_(sink), out_(kPiece, '\0') {
    if (deflateInit(&stream_, Z_DEFAULT_COMPRESSION) != Z_OK) throw std::bad_alloc();
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  void add(const Bytes& row) {
    stream_.next_in = const_cast<Bytef*>(row.data());
    stream_.avail_in = static_cast<uInt>(row.size());
    while (stream_.avail_in > 0) pass(Z_NO_FLUSH);
  }
  void finish() {
    while (pass(Z_FINISH) != Z_STREAM_END) {
    }
    if (filled_ > 0) sink_(chunk("IDAT", {out_.data(), filled_}));
  }

 private:
  int pass(int flush) {
    stream_.next_out = reinterpret_cast<Bytef*>(out_.data() + filled_);
    stream_.avail_out = static_cast<uInt>(out_.size() - filled_);
    const int result = deflate(&stream_, flush);
    filled_ = out_.size() - stream_.avail_out;
    if (filled_ == out_.size()) {
      sink_(chunk("IDAT", out_));
      filled_ = 0;
    }
    return result;
  }

  const std::function<void(std::string_view)>& sink_;
  z_stream stream_{};
  std::string out_;
  std::size_t filled_ = 0;
};

// Reading.

std::uint32_t numberAt(std::string_view bytes, std::size_t at) {
  std::uint32_t n = 0;
  for (std::size_t k = 0; k < 4; ++k) n = n << 8 | static_cast<std::uint8_t>(bytes[at + k]);
  return n;
}

struct Layout {
  std::uint32_t width = 0, height = 0;
  std::size_t channels = 0, sample = 0;  // bytes of a sample: 1 or 2
  std::size_t pixel() const { return channels * sample; }
  std::size_t row() const { return width * pixel(); }
};

/// Of the kinds that are read here.
std::optional<Layout> layoutOf(std::string_view bytes) {
  constexpr std::size_t kHead = 8 + 8 + 13 + 4;
  if (bytes.size() < kHead || !bytes.starts_with(kSignature) || numberAt(bytes, 8) != 13 ||
      bytes.substr(12, 4) != "IHDR")
    return std::nullopt;
  const std::string_view rest = bytes.substr(24, 5);  // depth, colour type, compression, filters, interlacing
  Layout out{numberAt(bytes, 16), numberAt(bytes, 20), 0, 0};
  constexpr std::array<std::size_t, 7> kChannels = {1, 0, 3, 0, 2, 0, 4};
  const auto depth = static_cast<std::uint8_t>(rest[0]), colour = static_cast<std::uint8_t>(rest[1]);
  if (colour < kChannels.size()) out.channels = kChannels[colour];
  if (depth == 8 || depth == 16) out.sample = depth / 8u;
  const bool usual = out.channels > 0 && out.sample > 0 && rest.substr(2) == std::string_view("\0\0\0", 3);
  const bool fits = out.width > 0 && out.height > 0 && std::max(out.width, out.height) <= kLongest &&
                    out.width <= kMostPixels / out.height;
  return usual && fits ? std::optional(out) : std::nullopt;
}

/// The data of all IDAT chunks, as one stream.
class Inflater {
 public:
  explicit Inflater(std::string_view bytes) : bytes_(bytes), at_(kSignature.size()) {
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Whether there were so many more bytes.
  bool fill(Bytes& out) {
    stream_.next_out = out.data();
    stream_.avail_out = static_cast<uInt>(out.size());
    while (stream_.avail_out > 0) {
      if (stream_.avail_in == 0 && !nextChunk()) return false;
      const int result = inflate(&stream_, Z_NO_FLUSH);
      if (result == Z_STREAM_END) return stream_.avail_out == 0;
      if (result != Z_OK && !(result == Z_BUF_ERROR && stream_.avail_in == 0)) return false;
    }
    return true;
  }

 private:
  bool nextChunk() {
    while (bytes_.size() - at_ >= 12) {
      const std::uint32_t length = numberAt(bytes_, at_);
      const std::string_view type = bytes_.substr(at_ + 4, 4);
      if (length > bytes_.size() - at_ - 12 || type == "IEND") return false;
      const std::string_view data = bytes_.substr(at_ + 8, length);
      at_ += 12 + std::size_t{length};
      if (type != "IDAT" || length == 0) continue;
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
      stream_.avail_in = length;
      return true;
    }
    return false;
  }

  std::string_view bytes_;
  std::size_t at_;
  z_stream stream_{};
};

/// Takes the filter off a row, the first byte of which names it.
bool restore(Bytes& row, const Bytes& above, std::size_t pixel) {
  const int kind = row[0];
  if (kind >= kFilters) return false;
  for (std::size_t k = 1; k < row.size(); ++k) {
    const int left = k <= pixel ? 0 : row[k - pixel], corner = k <= pixel ? 0 : above[k - pixel];
    row[k] = static_cast<std::uint8_t>(row[k] + predicted(kind, left, above[k], corner));
  }
  return true;
}

std::vector<float> linearValues(std::size_t sample) {
  std::vector<float> out(sample == 1 ? 256 : 65536);
  const double most = static_cast<double>(out.size() - 1);
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = static_cast<float>(linearFromSrgb(static_cast<double>(k) / most));
  return out;
}

}  // namespace

void encodePng(const Image8& image, const std::function<void(std::string_view)>& sink,
               const CancelToken& cancel) {
  std::string header;
  appendNumber(header, static_cast<std::uint32_t>(image.width));
  appendNumber(header, static_cast<std::uint32_t>(image.height));
  header.append("\x08\x02\0\0\0", 5);  // 8 bits, RGB, the one compression, the usual filters, not interlaced
  sink(std::string(kSignature) + chunk("IHDR", header));
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  RowFilter filter(row);
  Deflater deflater(sink);
  for (int y = 0; y < image.height; ++y) {
    cancel.check();
    cancel.report(static_cast<double>(y) / image.height);
    deflater.add(filter.filtered(&image.rgb[static_cast<std::size_t>(y) * row]));
  }
  deflater.finish();
  cancel.check();
  sink(chunk("IEND", {}));
}

std::optional<ImageF> decodePng(std::string_view bytes, const CancelToken& cancel) {
  const std::optional<Layout> layout = layoutOf(bytes);
  if (!layout) return std::nullopt;
  const std::vector<float> linear = linearValues(layout->sample);
  ImageF image{static_cast<int>(layout->width), static_cast<int>(layout->height), {}};
  Inflater inflater(bytes);
  Bytes row(layout->row() + 1), above(layout->row() + 1, 0);
  for (std::uint32_t y = 0; y < layout->height; ++y) {
    cancel.check();
    cancel.report(static_cast<double>(y) / layout->height);
    if (!inflater.fill(row) || !restore(row, above, layout->pixel())) return std::nullopt;
    // Not before there is a row: a broken head may ask for any size.
    if (y == 0) image.rgb.reserve(3 * std::size_t{layout->width} * layout->height);
    for (std::uint32_t x = 0; x < layout->width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t k = 1 + x * layout->pixel() + (layout->channels < 3 ? 0 : c) * layout->sample;
        image.rgb.push_back(linear[layout->sample == 1 ? row[k] : row[k] << 8 | row[k + 1]]);
      }
    }
    row.swap(above);
  }
  return image;
}

}  // namespace unshot
