#include "report/reference_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <string_view>

#include "base/atomic_file.h"
#include "base/csv_table.h"
#include "base/error.h"
#include "base/parse.h"
#include "base/random.h"
#include "base/read_file.h"
#include "report/path_tracer.h"

namespace unshot {
namespace {

namespace fs = std::filesystem;

// To be raised when tracer, choice of points or file change.
constexpr std::uint64_t kVersion = 1;

using Names = std::array<const char*, 3>;
constexpr Names kPosition{"x", "y", "z"}, kNormal{"nx", "ny", "nz"}, kReflectance{"rho_r", "rho_g", "rho_b"},
    kEmission{"E_r", "E_g", "E_b"}, kRadiosity{"B_r", "B_g", "B_b"}, kError{"se_r", "se_g", "se_b"};

class Hash {
 public:
  void add(std::uint64_t bits) { state_ = mixBits(state_ ^ bits) + 0x2545f4914f6cdd1dull; }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const glm::dvec3& v) {
    for (int k = 0; k < 3; ++k) add(v[k]);
  }
  void add(std::string_view text) {
    for (const char c : text) add(std::uint64_t{static_cast<unsigned char>(c)});
  }
  std::uint64_t value() const { return mixBits(state_); }

 private:
  std::uint64_t state_ = 0;
};

std::string hexText(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

class Reader {
 public:
  explicit Reader(const CsvTable& table) : table_(table) {}

  glm::dvec3 required(std::size_t row, const Names& names) const {
    glm::dvec3 out(0.0);
    for (int k = 0; k < 3; ++k) {
      const auto column = table_.column(names[static_cast<std::size_t>(k)]);
      if (!column) {
        throw Error(ErrorKind::kInput,
                    std::string("the column ") + names[static_cast<std::size_t>(k)] + " is missing",
                    table_.path.string(), "columns x,y,z,nx,ny,nz,E_r,E_g,E_b,B_r,B_g,B_b");
      }
      const std::optional<double> value = table_.number(row, *column);
      if (!value || !std::isfinite(*value)) {
        throw Error(
            ErrorKind::kInput,
            std::string("the value of ") + names[static_cast<std::size_t>(k)] + " is missing or not finite",
            table_.where(row), "a number in every column");
      }
      out[k] = *value;
    }
    return out;
  }

  glm::dvec3 optional(std::size_t row, const Names& names) const {
    return table_.column(names[0]) ? required(row, names) : glm::dvec3(0.0);
  }

  ReferencePoint point(std::size_t row) const {
    ReferencePoint point;
    point.position = required(row, kPosition);
    point.normal = required(row, kNormal);
    const double length = glm::length(point.normal);
    if (!(length > 0)) {
      throw Error(ErrorKind::kInput, "the normal has no direction", table_.where(row),
                  "the direction that the surface faces");
    }
    // A normal that was written by this program stays what it was, bit by bit.
    if (std::abs(length - 1) > 1e-12) point.normal /= length;
    point.reflectance = optional(row, kReflectance);
    point.emission = required(row, kEmission);
    point.radiosity = required(row, kRadiosity);
    point.standard_error = optional(row, kError);
    if (const auto column = table_.column("mat")) point.material = table_.rows[row][*column];
    if (const auto column = table_.column("samples")) {
      point.samples = static_cast<std::uint64_t>(std::max(0.0, table_.number(row, *column).value_or(0)));
    }
    return point;
  }

 private:
  const CsvTable& table_;
};

std::string cellOf(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return c == ',' || c == '"' || static_cast<unsigned char>(c) < 32; }, '_');
  return text;
}

std::string headOf(std::uint64_t hash, std::string_view body) {
  Hash checksum;
  checksum.add(body);
  return "# unshot reference " + std::to_string(kVersion) + ", of " + hexText(hash) + ", checksum " +
         hexText(checksum.value()) + "\n";
}

std::string bodyOf(const Scene& scene, const ReferenceOptions& options, const Reference& reference) {
  std::string text = "# scene=" + cellOf(scene.name) +
                     " emit=" + (options.emit_front_only ? "front" : "both") +
                     " seed=" + std::to_string(options.seed) + "; B and E in the unit of Ke\n" +
                     "# seconds " + shortest(reference.seconds) + "\n";
  for (const Names& names : {kPosition, kNormal, kReflectance, kEmission, kRadiosity, kError}) {
    for (const char* name : names) text += std::string(name) + ",";
  }
  text += "mat,samples\n";
  for (const ReferencePoint& p : reference.points) {
    for (const glm::dvec3& v :
         {p.position, p.normal, p.reflectance, p.emission, p.radiosity, p.standard_error}) {
      for (int k = 0; k < 3; ++k) text += shortest(v[k]) + ",";
    }
    text += cellOf(p.material) + "," + std::to_string(p.samples) + "\n";
  }
  return text;
}

/// The reference in a file made by bodyOf. Throws Error where it is not whole or of something else.
Reference readCached(const fs::path& path, std::uint64_t hash) {
  const auto fail = [&](const std::string& why) { throw Error(ErrorKind::kInput, why, path.string()); };
  const std::string bytes = readFile(path);
  const std::size_t end = bytes.find('\n');
  const std::string_view body =
      std::string_view(bytes).substr(end == std::string::npos ? bytes.size() : end + 1);
  if (std::string_view(bytes).substr(0, bytes.size() - body.size()) != headOf(hash, body))
    fail("its first line does not fit what follows");
  Reference reference;
  reference.points = readReferencePoints(path);
  for (const ReferencePoint& point : reference.points) {
    if (point.samples < 2 * kPathsPerBatch || point.samples % kPathsPerBatch != 0)
      fail("its numbers of samples are impossible");
  }
  constexpr std::string_view kSeconds = "\n# seconds ";
  const std::size_t seconds = body.find(kSeconds);
  if (seconds != std::string_view::npos) {
    const std::string_view rest = body.substr(seconds + kSeconds.size());
    reference.seconds = parseNumber(trimmed(rest.substr(0, rest.find('\n')))).value_or(0);
  }
  return reference;
}

}  // namespace

std::vector<ReferencePoint> readReferencePoints(const fs::path& path) {
  const CsvTable table = readCsv(path);
  const Reader reader(table);
  std::vector<ReferencePoint> points;
  for (std::size_t row = 0; row < table.rows.size(); ++row) points.push_back(reader.point(row));
  if (points.empty())
    throw Error(ErrorKind::kInput, "the file has no points", path.string(), "a line for each point");
  return points;
}

std::uint64_t referenceHash(const Scene& scene, const ReferenceOptions& options) {
  Hash hash;
  hash.add(kVersion);
  hash.add(std::uint64_t{options.emit_front_only});
  if (options.sky != glm::dvec3(0.0)) hash.add(options.sky);
  hash.add(options.seed);
  hash.add(std::uint64_t{options.places.empty() ? options.points : 0});
  for (const ReferencePlace& place : options.places) {
    hash.add(place.position);
    hash.add(place.normal);
  }
  hash.add(scene.frame_origin);
  for (const Polygon& polygon : scene.polygons) {
    hash.add(std::uint64_t{polygon.corner_count});
    for (std::uint32_t k = 0; k < polygon.corner_count; ++k) hash.add(scene.position(polygon, k));
    hash.add(scene.materials[polygon.material].reflectance);
    hash.add(scene.materials[polygon.material].emission);
  }
  return hash.value();
}

fs::path referencePath(const fs::path& folder, const Scene& scene, const ReferenceOptions& options) {
  return folder / ("reference-" + hexText(referenceHash(scene, options)) + ".csv");
}

Reference cachedReference(const Scene& scene, const ReferenceOptions& options, const fs::path& folder) {
  const std::uint64_t hash = referenceHash(scene, options);
  const fs::path path = referencePath(folder, scene, options);
  Diagnostics diagnostics;
  const auto warn = [&](const std::string& message, const std::string& advice) {
    diagnostics.push_back({Severity::kWarning, "reference-cache", message, path.string(), advice});
  };
  Reference reference;
  std::error_code error;
  if (fs::exists(path, error)) {
    try {
      reference = readCached(path, hash);
    } catch (const Error& damage) {
      warn(std::string("the reference kept here is damaged (") + damage.what() + "); it was traced again",
           {});
      reference = {};
    }
  }
  std::uint64_t samples = 0;
  for (const ReferencePoint& point : reference.points) samples += point.samples;
  if (reference.points.empty()) {
    reference = traceReference(scene, options);
  } else {
    continueReference(scene, options, reference);
  }
  std::uint64_t samples_now = 0;
  for (const ReferencePoint& point : reference.points) samples_now += point.samples;
  reference.from_file = samples_now == samples;
  if (!reference.from_file && std::isfinite(noiseOf(reference.points))) {
    try {
      const std::string body = bodyOf(scene, options, reference);
      writeWholeFile(path, headOf(hash, body) + body);
    } catch (const Error& failure) {
      warn(std::string("the reference could not be kept: it ") + failure.what(), failure.advice());
    }
  }
  reference.diagnostics.insert(reference.diagnostics.end(), diagnostics.begin(), diagnostics.end());
  return reference;
}

}  // namespace unshot
