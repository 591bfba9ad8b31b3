#include "export/ply.h"

#include <bit>
#include <cstring>
#include <type_traits>

#include "base/srgb.h"
#include "base/tone.h"

namespace unshot {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written as the machine holds numbers");

template <class Value>
void append(std::string& bytes, Value value) {
  static_assert(std::is_trivially_copyable_v<Value>);
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

void append(std::string& bytes, const glm::dvec3& v) {
  for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(v[k]));
}

std::string headerOf(const Mesh& mesh) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment made by unshot\n";
  text += "element vertex " + std::to_string(mesh.vertices.size()) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "radiosity_r", "radiosity_g", "radiosity_b"}) {
    text += std::string("property float ") + name + "\n";
  }
  for (const char* name : {"red", "green", "blue"}) text += std::string("property uchar ") + name + "\n";
  text += "element face " + std::to_string(mesh.triangle_vertices.size() / 3) + "\n";
  text += "property list uchar int vertex_indices\nend_header\n";
  return text;
}

}  // namespace

std::string plyBytes(const Snapshot& snapshot, bool with_ambient, double exposure) {
  const Mesh& mesh = *snapshot.mesh;
  std::string bytes = headerOf(mesh);
  bytes.reserve(bytes.size() + 39 * mesh.vertices.size() + 13 * (mesh.triangle_vertices.size() / 3));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const glm::dvec3 b = radiosity(snapshot, v, with_ambient);
    append(bytes, glm::dvec3(mesh.vertices[v].position) + mesh.frame_origin);
    append(bytes, glm::dvec3(mesh.vertices[v].normal));
    append(bytes, b);
    const glm::dvec3 shown = toneMap(exposure * b);
    for (int k = 0; k < 3; ++k) append(bytes, srgb8FromLinear(shown[k]));
  }
  for (std::size_t k = 0; k + 2 < mesh.triangle_vertices.size(); k += 3) {
    append(bytes, static_cast<std::uint8_t>(3));
    for (std::size_t corner = 0; corner < 3; ++corner) {
      append(bytes, static_cast<std::int32_t>(mesh.triangle_vertices[k + corner]));
    }
  }
  return bytes;
}

}  // namespace unshot
