// Everything that is said about a solve, as plain values: what the JSON report and the summary are made from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report/scene_figures.h"
#include "session/solve.h"

namespace unshot {

/// The GL context that a run used.
struct GlRecord {
  std::string provider, renderer, vendor, version;
  bool hardware = false;
};

/// Sizes of a solve.
struct Counts {
  std::size_t surfaces = 0;
  std::size_t patches = 0;
  std::size_t elements = 0;
  std::size_t vertices = 0;
  std::uint64_t rows = 0;
  std::uint64_t shots = 0;
  std::uint64_t drawn = 0;  ///< hemicubes
};

struct RunRecord {
  std::filesystem::path scene_path;
  std::string scene_name;
  SceneFigures scene;
  Diagnostics diagnostics;
  std::vector<PlanDecision> plan;
  glm::dvec3 sky{0.0};  ///< its radiosity [W/m^2]; 0 where none is seen
  std::string mode;
  std::string form_factors;
  std::optional<GlRecord> gl;  ///< nothing where no GL was needed
  Counts counts;
  PhaseSeconds seconds;
  double solver_target = 0;  ///< Solve::solverTarget
  Measures measures;
  ErrorEstimates estimates;
  EnergyBalance energy;
  std::size_t peak_memory_bytes = 0;
  std::size_t kept_bytes = 0;
  std::string stopped_by;
  std::vector<HistoryEntry> history;
};

/// The record of a solve as it stands; `gl` stays to be filled in by those who made the context.
RunRecord recordOf(const Solve& solve);

}  // namespace unshot
