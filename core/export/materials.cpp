#include "export/materials.h"

#include <limits>
#include <locale>
#include <sstream>

#include "base/atomic_file.h"

namespace unshot {

void writeMaterials(const std::filesystem::path& path, std::span<const Material> materials) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
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
