#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/parse.h"
#include "base/read_file.h"
#include "export/ply.h"

namespace unshot {
namespace {

constexpr std::size_t kTold = 4096;  // vertices between two words on how much is read

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::kInput, why, path.string(), "a PLY file written by unshot solve --ply");
}

/// A scalar property of a vertex.
struct Property {
  std::string name;
  std::string type;
  std::size_t offset = 0;
};

std::optional<std::size_t> sizeOfType(std::string_view type) {
  constexpr std::pair<std::string_view, std::size_t> kSizes[] = {
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  for (const auto& [name, size] : kSizes) {
    if (type == name) return size;
  }
  return std::nullopt;
}

struct Header {
  std::size_t length = 0;  ///< bytes
  std::size_t vertices = 0;
  std::size_t stride = 0;  ///< bytes per vertex
  std::vector<Property> properties;
  std::size_t triangles = 0;     ///< of the faces that follow the vertices
  bool faces_are_lists = false;  ///< "list uchar int vertex_indices" and nothing else
};

/// The words of a line of the header.
std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words = splitParts(line, ' ');
  std::erase(words, std::string_view{});
  return words;
}

Header readHeader(std::string_view bytes, const std::filesystem::path& path) {
  if (!bytes.starts_with("ply")) fail(path, "this is not a PLY file");
  Header header;
  bool binary = false;
  std::string element;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = bytes.find('\n', begin);
    if (end == std::string_view::npos) fail(path, "the header of the PLY file does not end");
    const std::vector<std::string_view> words = wordsOf(bytes.substr(begin, end - begin));
    begin = end + 1;
    if (words.empty()) continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format") binary = words.size() > 1 && words[1] == "binary_little_endian";
    if (words[0] == "element" && words.size() == 3) {
      // Vertices are read from the start of the data, so nothing may come before them.
      if (element.empty() && words[1] != "vertex")
        fail(path, "the first element of the PLY file is not 'vertex'");
      element = words[1];
      const std::optional<double> count = parseNumber(words[2]);
      if (!count || *count < 0) fail(path, "a count in the header of the PLY file is not a number");
      if (element == "face") header.triangles = static_cast<std::size_t>(std::min(*count, 1e12));
      if (element == "vertex") header.vertices = static_cast<std::size_t>(std::min(*count, 1e12));
    }
    if (words[0] == "property" && element == "face") {
      header.faces_are_lists = words.size() == 5 && words[1] == "list" && words[2] == "uchar" &&
                               words[3] == "int" && words[4] == "vertex_indices";
    }
    if (words[0] == "property" && element == "vertex" && words.size() == 3) {
      const std::optional<std::size_t> size = sizeOfType(words[1]);
      if (!size) fail(path, "the PLY file has a property of unknown type '" + std::string(words[1]) + "'");
      header.properties.push_back({std::string(words[2]), std::string(words[1]), header.stride});
      header.stride += *size;
    } else if (words[0] == "property" && element == "vertex") {
      fail(path, "the vertices of the PLY file hold lists");
    }
  }
  if (!binary) fail(path, "the PLY file is not binary_little_endian");
  header.length = begin;
  return header;
}

std::size_t offsetOf(const Header& header, std::string_view name, const std::filesystem::path& path) {
  const auto found = std::find_if(header.properties.begin(), header.properties.end(),
                                  [&](const Property& p) { return p.name == name; });
  if (found == header.properties.end())
    fail(path, "the PLY file has no property '" + std::string(name) + "'");
  if (found->type != "float" && found->type != "float32") {
    fail(path, "property '" + std::string(name) + "' of the PLY file is not float");
  }
  return found->offset;
}

std::vector<std::uint32_t> readTriangles(const std::string& bytes, const Header& header,
                                         const std::filesystem::path& path) {
  constexpr std::size_t kFaceBytes = 13;
  std::vector<std::uint32_t> out;
  if (!header.faces_are_lists) return out;
  const std::size_t begin = header.length + header.vertices * header.stride;
  if (header.triangles > (bytes.size() - begin) / kFaceBytes) fail(path, "the PLY file is cut short");
  out.reserve(3 * header.triangles);
  for (std::size_t t = 0; t < header.triangles; ++t) {
    const char* face = bytes.data() + begin + t * kFaceBytes;
    if (*face != 3) fail(path, "face " + std::to_string(t) + " of the PLY file is no triangle");
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t vertex = 0;
      std::memcpy(&vertex, face + 1 + 4 * k, sizeof vertex);
      if (vertex >= header.vertices)
        fail(path, "face " + std::to_string(t) + " of the PLY file has a vertex that is not there");
      out.push_back(vertex);
    }
  }
  return out;
}

}  // namespace

PlySolution readPly(const std::filesystem::path& path, const CancelToken& cancel) {
  const std::string bytes = readFile(path);
  const Header header = readHeader(bytes, path);
  const char* const names[2][3] = {{"x", "y", "z"}, {"radiosity_r", "radiosity_g", "radiosity_b"}};
  std::size_t offsets[2][3];
  for (int which = 0; which < 2; ++which) {
    for (int k = 0; k < 3; ++k) offsets[which][k] = offsetOf(header, names[which][k], path);
  }
  if (header.vertices > (bytes.size() - header.length) / header.stride)
    fail(path, "the PLY file is cut short");
  PlySolution solution;
  solution.positions.resize(header.vertices);
  solution.radiosity.resize(header.vertices);
  for (std::size_t v = 0; v < header.vertices; ++v) {
    cancel.check();
    if (v % kTold == 0) cancel.report(static_cast<double>(v) / static_cast<double>(header.vertices));
    const char* vertex = bytes.data() + header.length + v * header.stride;
    for (int which = 0; which < 2; ++which) {
      for (int k = 0; k < 3; ++k) {
        float value = 0;
        std::memcpy(&value, vertex + offsets[which][k], sizeof value);
        if (!std::isfinite(value))
          fail(path, "vertex " + std::to_string(v) + " of the PLY file is not finite");
        (which == 0 ? solution.positions : solution.radiosity)[v][k] = value;
      }
    }
  }
  solution.triangles = readTriangles(bytes, header, path);
  return solution;
}

}  // namespace unshot
