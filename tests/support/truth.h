// Path-traced reference values at points of a scene, and the error figures held against them: of reflected
// light only, at points with E = 0.
#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/csv_table.h"
#include "export/probes.h"

namespace unshot::testing_support {

struct TruthPoint {
  Probe at;
  glm::dvec3 emission{0.0}, radiosity{0.0};
  std::string material;
};

/// Columns x,y,z,nx,ny,nz,E_r.. and B_r.. of a file of reference values.
inline std::vector<TruthPoint> readTruth(const std::filesystem::path& path) {
  const CsvTable table = readCsv(path);
  const auto vector = [&](std::size_t row, const char* x, const char* y, const char* z) {
    glm::dvec3 out;
    int k = 0;
    for (const char* name : {x, y, z}) out[k++] = table.number(row, table.column(name).value()).value();
    return out;
  };
  std::vector<TruthPoint> out;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    TruthPoint point;
    point.at = {vector(row, "x", "y", "z"), vector(row, "nx", "ny", "nz")};
    point.emission = vector(row, "E_r", "E_g", "E_b");
    point.radiosity = vector(row, "B_r", "B_g", "B_b");
    if (const auto column = table.column("mat")) point.material = table.rows[row][*column];
    out.push_back(point);
  }
  return out;
}

/// RMS(error) / RMS(truth) over points that do not shine, and channels. One value per point; a point without
/// a value counts with B = 0.
inline double reflectedError(const std::vector<TruthPoint>& truth,
                             const std::vector<std::optional<glm::dvec3>>& values) {
  double error = 0, total = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    if (truth[k].emission != glm::dvec3(0.0)) continue;
    const glm::dvec3 difference = values[k].value_or(glm::dvec3(0.0)) - truth[k].radiosity;
    for (int c = 0; c < 3; ++c) {
      error += difference[c] * difference[c];
      total += truth[k].radiosity[c] * truth[k].radiosity[c];
    }
  }
  return std::sqrt(error / total);
}

/// The check that a picture of bounced light must pass.
inline bool isFaithful(const std::vector<TruthPoint>& truth,
                       const std::vector<std::optional<glm::dvec3>>& values, double tolerance) {
  return reflectedError(truth, values) <= tolerance;
}

inline std::vector<Probe> probesOf(const std::vector<TruthPoint>& truth) {
  std::vector<Probe> out;
  for (const TruthPoint& point : truth) out.push_back(point.at);
  return out;
}

}  // namespace unshot::testing_support
