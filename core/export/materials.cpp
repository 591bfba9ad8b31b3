#include "export/materials.h"

#include <locale>
#include <sstream>

#include "base/atomic_file.h"

namespace unshot {
namespace {

// More than anybody knows of a material; with all of them readers' rounding would show (0.72500000000000009).
constexpr int kDigits = 9;

}  // namespace

void writeMaterials(const std::filesystem::path& path, std::span<const Material> materials) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(kDigits);
  out << "# Kd: reflectance, with the mean of its texture; Ke: emission [W/m^2]\n";
  const auto colour = [&](const char* word, const glm::dvec3& value) {
    out << word << ' ' << value.x << ' ' << value.y << ' ' << value.z << '\n';
  };
  for (const Material& m : materials) {
    if (m.name.empty()) continue;
    out << "\nnewmtl " << m.name << '\n';
    colour("Kd", m.reflectance);
    if (m.emits()) colour("Ke", m.emission);
  }
  writeWholeFile(path, out.str());
}

}  // namespace unshot
