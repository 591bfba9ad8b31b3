#include "cli/compare_files.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/csv_table.h"
#include "base/error.h"
#include "base/read_file.h"
#include "export/image_files.h"
#include "export/ply.h"
#include "export/probes.h"

namespace unshot {
namespace {

constexpr double kSamePoint = 1e-5;  // of the extent of all points

[[noreturn]] void fail(const std::string& where, const std::string& message, const std::string& advice) {
  throw Error(ErrorKind::kInput, message, where, advice);
}

enum class FileKind { kPicture, kPly, kCsv };

FileKind kindOf(const std::filesystem::path& path) {
  const std::string bytes = readFile(path);
  if (bytes.starts_with("ply")) return FileKind::kPly;
  if (bytes.starts_with("#?") || bytes.find('\0') != std::string::npos) return FileKind::kPicture;
  return FileKind::kCsv;
}

std::string nameOf(FileKind kind) {
  return kind == FileKind::kPicture ? "a picture"
         : kind == FileKind::kPly   ? "a PLY solution"
                                    : "a table of probes";
}

/// The distance below which two points are the same.
double toleranceFor(const std::vector<glm::dvec3>& points) {
  if (points.empty()) return 0;
  glm::dvec3 low = points.front(), high = points.front();
  for (const glm::dvec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return kSamePoint * glm::length(high - low);
}

std::vector<glm::dvec3> valuesOf(const ImageF& image) {
  std::vector<glm::dvec3> values(image.rgb.size() / 3);
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] = {image.rgb[3 * k], image.rgb[3 * k + 1], image.rgb[3 * k + 2]};
  }
  return values;
}

std::string sizeOf(const ImageF& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

ValuePairs readPictures(const std::filesystem::path& a, const std::filesystem::path& b) {
  ImageF first = readImage(a), second = readImage(b);
  if (first.width != second.width || first.height != second.height) {
    fail(a.string(), "the picture is " + sizeOf(first) + ", but " + b.string() + " is " + sizeOf(second),
         "pictures of the same size");
  }
  ValuePairs pairs;
  pairs.points = "pixel";
  pairs.a = valuesOf(first);
  pairs.b = valuesOf(second);
  pairs.pictures.emplace(std::move(first), std::move(second));
  return pairs;
}

ValuePairs readPlys(const std::filesystem::path& a, const std::filesystem::path& b) {
  PlySolution first = readPly(a), second = readPly(b);
  if (first.positions.size() != second.positions.size()) {
    fail(a.string(),
         "the mesh has " + std::to_string(first.positions.size()) + " vertices, but " + b.string() + " has " +
             std::to_string(second.positions.size()),
         "solutions on the same mesh, or probes at the same points (--probe, --probe-out)");
  }
  const double tolerance = toleranceFor(second.positions);
  for (std::size_t v = 0; v < first.positions.size(); ++v) {
    if (glm::distance(first.positions[v], second.positions[v]) <= tolerance) continue;
    fail(a.string(), "vertex " + std::to_string(v) + " is elsewhere than in " + b.string(),
         "solutions on the same mesh, or probes at the same points (--probe, --probe-out)");
  }
  ValuePairs pairs;
  pairs.points = "vertex";
  pairs.note = "light sources count with their own light";
  pairs.a = first.radiosity;
  pairs.b = second.radiosity;
  pairs.solutions.emplace(std::move(first), std::move(second));
  return pairs;
}

/// The values of a table of probes, one per row; nothing where the file has none.
struct ProbeTable {
  CsvTable table;
  std::vector<glm::dvec3> positions;
  std::vector<std::optional<glm::dvec3>> radiosity;
  std::vector<std::optional<glm::dvec3>> emission;
};

std::optional<glm::dvec3> vectorAt(const CsvTable& table, std::size_t row, const std::size_t (&columns)[3]) {
  glm::dvec3 v{0.0};
  for (int k = 0; k < 3; ++k) {
    const std::optional<double> value = table.number(row, columns[k]);
    if (!value) return std::nullopt;
    if (!std::isfinite(*value)) fail(table.where(row), "a value is not finite", "computing the file again");
    v[k] = *value;
  }
  return v;
}

/// Columns of three names; false where one is missing.
bool findColumns(const CsvTable& table, const char* const (&names)[3], std::size_t (&columns)[3]) {
  for (int k = 0; k < 3; ++k) {
    const std::optional<std::size_t> column = table.column(names[k]);
    if (!column) return false;
    columns[k] = *column;
  }
  return true;
}

ProbeTable readProbeTable(const std::filesystem::path& path) {
  ProbeTable probes{readCsv(path), {}, {}, {}};
  const CsvTable& table = probes.table;
  std::size_t at[3] = {0, 1, 2}, b[3] = {6, 7, 8}, e[3] = {};
  bool emits = false;
  if (table.header.empty()) {
    if (table.rows.empty() || table.rows.front().size() < 9) {
      fail(path.string(), "the file has no values of probes", "a file written by unshot solve --probe-out");
    }
  } else {
    if (!findColumns(table, {"x", "y", "z"}, at) || !findColumns(table, {"B_r", "B_g", "B_b"}, b)) {
      fail(path.string(), "the table lacks a column of x, y, z, B_r, B_g, B_b",
           "a file written by unshot solve --probe-out");
    }
    emits = findColumns(table, {"E_r", "E_g", "E_b"}, e);
  }
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::optional<glm::dvec3> position = vectorAt(table, row, at);
    if (!position) fail(table.where(row), "the point has no position", "x, y and z in every line");
    probes.positions.push_back(*position);
    probes.radiosity.push_back(vectorAt(table, row, b));
    probes.emission.push_back(emits ? vectorAt(table, row, e) : std::nullopt);
  }
  return probes;
}

void requireSamePoints(const ProbeTable& a, const ProbeTable& b) {
  if (a.positions.size() != b.positions.size()) {
    fail(a.table.path.string(),
         "there are " + std::to_string(a.positions.size()) + " points, but " + b.table.path.string() +
             " has " + std::to_string(b.positions.size()),
         "the same points in the same order");
  }
  const double tolerance = toleranceFor(b.positions);
  for (std::size_t row = 0; row < a.positions.size(); ++row) {
    if (glm::distance(a.positions[row], b.positions[row]) <= tolerance) continue;
    fail(a.table.where(row), "this is another point than at " + b.table.where(row),
         "the same points in the same order");
  }
}

/// What a PLY solution has at the points of a table.
ProbeTable probesOfPly(const std::filesystem::path& ply, const std::filesystem::path& points) {
  ProbeTable probes;
  probes.table.path = ply;
  const std::vector<Probe> at = readProbes(points);
  probes.radiosity = answerProbes(readPly(ply), at);
  for (const Probe& probe : at) probes.positions.push_back(probe.position);
  probes.emission.resize(at.size());
  return probes;
}

ValuePairs probePairs(const ProbeTable& a, const ProbeTable& b) {
  requireSamePoints(a, b);
  const std::size_t rows = a.positions.size();
  std::vector<glm::dvec3> emission(rows, glm::dvec3(0.0));
  bool some_dark = false;
  std::size_t emitting = 0, empty = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    emission[row] = b.emission[row].value_or(a.emission[row].value_or(glm::dvec3(0.0)));
    const bool emits = emission[row] != glm::dvec3(0.0);
    emitting += emits;
    some_dark = some_dark || !emits;
  }
  ValuePairs pairs;
  pairs.points = "probe";
  for (std::size_t row = 0; row < rows; ++row) {
    if (some_dark && emission[row] != glm::dvec3(0.0)) continue;
    if (!a.radiosity[row] || !b.radiosity[row]) {
      ++empty;
      continue;
    }
    pairs.a.push_back(*a.radiosity[row] - emission[row]);
    pairs.b.push_back(*b.radiosity[row] - emission[row]);
  }
  pairs.left_out = rows - pairs.a.size();
  if (some_dark && emitting > 0) pairs.note = std::to_string(emitting) + " on light sources";
  if (!some_dark && emitting > 0) pairs.note = "reflected light only: B - E";
  if (empty > 0) pairs.note += (pairs.note.empty() ? "" : ", ") + std::to_string(empty) + " without a value";
  if (pairs.a.empty())
    fail(a.table.path.string(), "there is no point with values in both files",
         "probes that lie on the scene");
  return pairs;
}

}  // namespace

ValuePairs readPairs(const std::filesystem::path& a, const std::filesystem::path& b) {
  const FileKind kind = kindOf(a), other = kindOf(b);
  if (kind == FileKind::kPly && other == FileKind::kCsv)
    return probePairs(probesOfPly(a, b), readProbeTable(b));
  if (kind == FileKind::kCsv && other == FileKind::kPly)
    return probePairs(readProbeTable(a), probesOfPly(b, a));
  if (kind != other) {
    fail(a.string(), "this is " + nameOf(kind) + ", but " + b.string() + " is " + nameOf(other),
         "two files of one kind, or a PLY solution and a table of probes");
  }
  switch (kind) {
    case FileKind::kPicture:
      return readPictures(a, b);
    case FileKind::kPly:
      return readPlys(a, b);
    case FileKind::kCsv:
      break;
  }
  return probePairs(readProbeTable(a), readProbeTable(b));
}

}  // namespace unshot
