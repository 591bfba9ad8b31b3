#include "scene/obj_line_scan.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"

namespace unshot {
namespace {

/// Statements of the format that say nothing about the faces' geometry or light.
constexpr std::array<std::string_view, 20> kPassedOver{
    "g",        "o",        "vp",         "mg",        "vw",   "t",   "usemap", "maplib", "lod",    "bevel",
    "c_interp", "d_interp", "shadow_obj", "trace_obj", "call", "csh", "ctech",  "stech",  "matlib", "xref"};

constexpr std::array<std::string_view, 20> kFreeForm{"curv", "curv2", "surf", "cstype", "deg", "bmat", "step",
                                                     "parm", "trim",  "hole", "scrv",   "sp",  "end",  "con",
                                                     "bsp",  "bzp",   "cdc",  "cdp",    "res", "cdj"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::uint32_t kLinesTold = 4096;  // lines between two words on how much is read

class LineScanner {
 public:
  LineScanner(std::string_view text, const std::filesystem::path& path, const CancelToken& cancel)
      : text_(text), path_(path), cancel_(cancel) {}

  ObjScan run() {
    refuseBinary();
    scan_.plain.reserve(text_.size());
    LineReader reader(text_);
    LogicalLine line;
    while (reader.next(line)) {
      cancel_.check();
      line_ = line.line;
      if (line_ % kLinesTold == 0)
        cancel_.report(static_cast<double>(line.text.data() - text_.data()) /
                       static_cast<double>(text_.size()));
      statement(line.text);
    }
    if (statements_ == 0) {
      throw Error(ErrorKind::kInput, "no line of this file is an OBJ statement", path_.string(),
                  "open a Wavefront OBJ file; other formats have to be converted first");
    }
    if (scan_.faces.empty()) refuseWithoutFaces();
    for (const auto& [index, face_line] : texture_ahead_) {
      if (index > texture_count_) scan_.lost_texture.add(face_line);
    }
    scan_.texture_count = texture_count_;
    return std::move(scan_);
  }

 private:
  [[noreturn]] void fail(const std::string& message, const std::string& advice) const {
    throw Error(ErrorKind::kInput, message, placeOf(path_, line_), advice);
  }

  void refuseBinary() const {
    if (text_.empty()) {
      throw Error(ErrorKind::kInput, "the file is empty", path_.string(), "export the scene again");
    }
    const std::size_t nul = text_.find('\0');
    if (nul == std::string_view::npos) return;
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
    throw Error(
        ErrorKind::kInput, "the file is not text (a NUL byte is in it)",
        placeOf(path_, static_cast<std::uint32_t>(line)),
        "open a Wavefront OBJ file in UTF-8 or ASCII; binary and UTF-16 files have to be converted first");
  }

  [[noreturn]] void refuseWithoutFaces() const {
    std::string message = "the scene has no faces (" + counted(scan_.vertex_count, "vertex", "vertices");
    if (scan_.lines_and_points.count > 0) {
      message +=
          ", " + counted(scan_.lines_and_points.count, "line or point statement", "line or point statements");
    }
    if (scan_.free_form.count > 0) {
      message += ", " + counted(scan_.free_form.count, "free-form statement", "free-form statements");
    }
    throw Error(ErrorKind::kInput, message + ")", path_.string(), "export it as polygons (`f` statements)");
  }

  void statement(std::string_view text) {
    std::string_view rest = text;
    const std::string_view keyword = takeWord(rest);
    ++statements_;
    if (keyword == "v") {
      vertex(rest);
    } else if (keyword == "f" || keyword == "fo") {
      face(rest);
    } else if (keyword == "vn") {
      normal(rest);
    } else if (keyword == "vt") {
      ++texture_count_;
    } else if (keyword == "usemtl") {
      useMaterial(withoutBlanks(rest));
    } else if (keyword == "s") {
      smoothing(rest);
    } else if (keyword == "mtllib") {
      scan_.libraries.push_back({std::string(withoutBlanks(rest)), line_});
    } else if (keyword == "l" || keyword == "p") {
      scan_.lines_and_points.add(line_);
    } else if (contains(kFreeForm, keyword)) {
      scan_.free_form.add(line_);
    } else if (!contains(kPassedOver, keyword)) {
      --statements_;
      if (scan_.unknown.count == 0) scan_.first_unknown = std::string(keyword.substr(0, 40));
      scan_.unknown.add(line_);
    }
  }

  /// tinyobjloader reads "nan" and "inf" as 0; a number that overflows reaches the caller as infinite.
  bool appendNumber(std::string_view word) {
    const NumberKind kind = numberKind(word);
    if (kind == NumberKind::kNoNumber) return false;
    scan_.plain.append(1, ' ').append(kind == NumberKind::kFinite ? word : "1e999");
    return true;
  }

  void vertex(std::string_view rest) {
    // Colours or a weight may follow; a # may stand right behind a number.
    rest = rest.substr(0, rest.find('#'));
    scan_.plain.append(1, 'v');
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = takeWord(rest);
      if (word.empty()) fail("a vertex needs three numbers", "correct the line or export the scene again");
      if (!appendNumber(word)) {
        fail("'" + std::string(word.substr(0, 40)) + "' is not a number",
             word.find(',') != std::string_view::npos ? "write decimals with a point: 0.5"
                                                      : "correct the line or export the scene again");
      }
    }
    scan_.plain.append(1, '\n');
    if (++scan_.vertex_count > std::size_t{std::numeric_limits<std::int32_t>::max()}) {
      fail("more than 2^31 vertices", "split the scene");
    }
  }

  void normal(std::string_view rest) {
    rest = rest.substr(0, rest.find('#'));
    scan_.plain.append("vn");
    for (int i = 0; i < 3; ++i) {
      // An unusable normal is a diagnostic where a face uses it, so it must reach the caller.
      if (!appendNumber(takeWord(rest))) scan_.plain.append(" 1e999");
    }
    scan_.plain.append(1, '\n');
    ++scan_.normal_count;
  }

  void face(std::string_view rest) {
    rest = rest.substr(0, rest.find('#'));
    ObjFace face{0, line_, materialOfFace(), smoothing_};
    scan_.plain.append(1, 'f');
    for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
      corner(word);
      ++face.corner_count;
    }
    // tinyobjloader says nothing about a face without corners, so none may reach it.
    if (face.corner_count == 0) {
      scan_.plain.pop_back();
    } else {
      scan_.plain.append(1, '\n');
    }
    scan_.faces.push_back(face);
  }

  /// v, v/t, v//n, v/t/n; empty texture and normal parts are let pass. Texture coordinates are not used, so
  /// an index that leads nowhere is only counted.
  void corner(std::string_view word) {
    const std::size_t first = word.find('/');
    const std::string_view vertex = word.substr(0, first);
    checkIndex(vertex, word, scan_.vertex_count, "vertex", "vertices");
    scan_.plain.append(1, ' ').append(vertex);
    if (first == std::string_view::npos) return;
    const std::size_t second = word.find('/', first + 1);
    texture(word.substr(first + 1, second == std::string_view::npos ? second : second - first - 1));
    if (second == std::string_view::npos) return;
    const std::string_view normal = word.substr(second + 1);
    if (normal.empty()) return;
    checkIndex(normal, word, scan_.normal_count, "normal", "normals");
    scan_.plain.append("//").append(normal);
  }

  void texture(std::string_view digits) {
    if (digits.empty()) return;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    std::int64_t value = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool number = failure == std::errc() && end == digits.data() + digits.size();
    if (!number || value == 0 || value < -static_cast<std::int64_t>(texture_count_)) {
      scan_.lost_texture.add(line_);
    } else if (value > static_cast<std::int64_t>(texture_count_)) {
      texture_ahead_.emplace_back(static_cast<std::size_t>(value), line_);
    }
  }

  void checkIndex(std::string_view digits, std::string_view word, std::size_t count, std::string_view one,
                  std::string_view many) const {
    constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();
    std::int64_t value = 0;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = end == digits.data() + digits.size();
    const bool in_range = value != 0 && value <= kLargest && value >= -static_cast<std::int64_t>(count);
    if (failure == std::errc() && whole && in_range) return;

    const std::string quoted = "'" + std::string(word.substr(0, 40)) + "'";
    const std::string so_far = "; there are " + counted(count, one, many) + " so far";
    const std::string index = std::string(one) + " index ";
    if (failure == std::errc::invalid_argument || !whole) {
      fail(quoted + " is not a corner of a face", "corners are written v, v/vt, v//vn or v/vt/vn");
    }
    if (failure == std::errc::result_out_of_range || value > kLargest || value < -kLargest) {
      fail(index + std::string(digits.substr(0, 40)) + " is beyond the largest that can be, " +
               std::to_string(kLargest) + so_far,
           "export the scene again");
    }
    if (value == 0) fail(index + "0 in " + quoted + ": OBJ counts from 1" + so_far, "export the scene again");
    fail(index + std::to_string(value) + " reaches before the first one" + so_far,
         "negative indices count back from the face's line");
  }

  // What no face uses counts for nothing.
  void useMaterial(std::string_view name) {
    named_ = name;
    named_line_ = line_;
  }

  std::uint32_t materialOfFace() {
    if (named_) {
      const auto [place, fresh] = material_index_.try_emplace(
          std::string(*named_), static_cast<std::uint32_t>(scan_.material_names.size()));
      if (fresh) scan_.material_names.push_back({std::string(*named_), named_line_});
      material_ = place->second;
      named_.reset();
    }
    return material_;
  }

  void smoothing(std::string_view rest) {
    const std::string_view word = takeWord(rest);
    scan_.smoothing_given = true;
    smoothing_ = word == "on" ? 1 : 0;
    std::from_chars(word.data(), word.data() + word.size(), smoothing_);
    if (smoothing_ == kNone) smoothing_ = kNone - 1;
  }

  std::string_view text_;
  const std::filesystem::path& path_;
  const CancelToken& cancel_;
  ObjScan scan_;
  std::uint32_t line_ = 0;
  std::size_t statements_ = 0;
  std::uint32_t material_ = kNone;         // of the last face
  std::optional<std::string_view> named_;  // since then
  std::uint32_t named_line_ = 0;
  std::uint32_t smoothing_ = 0;
  std::size_t texture_count_ = 0;
  std::vector<std::pair<std::size_t, std::uint32_t>> texture_ahead_;  // index and line: not there so far
  std::unordered_map<std::string, std::uint32_t> material_index_;
};

}  // namespace

ObjScan scanObj(std::string_view text, const std::filesystem::path& path, const CancelToken& cancel) {
  return LineScanner(text, path, cancel).run();
}

}  // namespace unshot
