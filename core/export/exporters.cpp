#include "export/exporters.h"

#include <algorithm>
#include <array>

#include "base/atomic_file.h"
#include "export/image_files.h"
#include "export/ply.h"

namespace unshot {
namespace {

void writePngPicture(const ExportSource& source, const std::filesystem::path& path) {
  writePng(path, source.picture());
}

void writeHdrPicture(const ExportSource& source, const std::filesystem::path& path) {
  writeHdr(path, source.radiance());
}

void writePly(const ExportSource& source, const std::filesystem::path& path) {
  writeWholeFile(path, plyBytes(source.snapshot, source.with_ambient, source.exposure));
}

void writeProbes(const ExportSource& source, const std::filesystem::path& path) {
  const auto answers = answerProbes(source.snapshot, source.probes, source.with_ambient);
  const auto missing = std::count(answers.begin(), answers.end(), std::nullopt);
  if (missing > 0) {
    source.warn({Severity::kWarning, "probe-off-surface",
                 std::to_string(missing) + " of " + std::to_string(answers.size()) +
                     " probes lie on no surface that faces their normal; their values are left empty",
                 path.string(), "check positions and normals; both are in the file's own coordinates"});
  }
  writeWholeFile(path, probeCsv(source.probes, answers));
}

void writeReport(const ExportSource& source, const std::filesystem::path& path) {
  writeWholeFile(path, source.report());
}

}  // namespace

std::span<const Exporter> exporters() {
  static constexpr std::array<Exporter, 5> kTable = {{
      {.info = {"png", "PNG picture", "the picture as displayed, 8 bits"},
       .ending = ".png",
       .needs = PictureNeed::kDisplayed,
       .write = writePngPicture},
      {.info = {"hdr", "Radiance HDR picture", "the picture in linear values [W/m^2]"},
       .ending = ".hdr",
       .needs = PictureNeed::kLinear,
       .write = writeHdrPicture},
      {.info = {"ply", "PLY solution", "the mesh with radiosity at its vertices"},
       .ending = ".ply",
       .write = writePly},
      {.info = {"probe-out", "Probe values", "radiosity at the points of --probe, as CSV"},
       .ending = ".csv",
       .write = writeProbes},
      {.info = {"report", "JSON report", "figures: counts, times, errors, energy, history"},
       .ending = ".json",
       .write = writeReport},
  }};
  return kTable;
}

}  // namespace unshot
