// A solve in a file, so that it can go on later: what it was asked for, its mesh, its state S, H and U, and
// the form factors at hand.
//
// It is bound to its scene by a hash of what that holds. Not in the file: what an iteration mode holds
// between two steps (any mode can go on from S, H and U) and estimates of the error, which are made again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/final_gather.h"
#include "session/solve.h"
#include "solver/state.h"

namespace unshot {

struct SavedSolve {
  std::filesystem::path path;  ///< where it was read from
  std::uint64_t scene_hash = 0;

  // What it was asked for, as far as mesh and form factors hang on it, and what can be changed since.
  std::string form_factors;  ///< key: what `auto` became
  bool emit_front_only = false;
  glm::dvec3 sky{0.0};
  std::uint64_t seed = 1;
  std::uint32_t hemicube_resolution = 0;
  HemicubeDrawing hemicube_drawing = HemicubeDrawing::kAuto;
  std::string mode;  ///< key, as asked for
  double error = 0.01;

  std::shared_ptr<const Mesh> mesh;
  std::vector<PlanDecision> plan;
  DoAnyway do_anyway;  ///< what the plan was not to leave out

  RadiosityState::Values values;
  std::vector<std::uint8_t> quality;  ///< ColumnQuality, one per source; kUnused where a column is not in use
  std::vector<std::pair<std::uint32_t, Column>> columns;  ///< those at hand
  bool drafts_allowed = false;
  RowClosure closure;  ///< that the columns have been scaled by; no scale: they have not
  bool closure_pending = false;
  std::vector<glm::dvec3> local_irradiance;       ///< LocalPass::irradiance
  bool final_gather = false;                      ///< SolveOptions::final_gather
  std::shared_ptr<const GatheredLight> gathered;  ///< FinalGather::light, or null

  double seconds = 0, cpu_seconds = 0, mesh_seconds = 0, plan_seconds = 0;
  std::uint64_t shots = 0, rows = 0, drawn = 0;
  std::vector<HistoryEntry> history;
  SolveState state = SolveState::kRunning;
  std::string stopped_by;

  static constexpr std::uint8_t kUnused = 255;

  /// The options that the file decides on, in place of those of `options`; the mode too where that is auto.
  SolveOptions options(SolveOptions options) const;
};

/// What Solve::save has written. Throws Error (kInput: no such file, not a saved solve, of another version,
/// damaged), Cancelled.
std::shared_ptr<SavedSolve> readSavedSolve(const std::filesystem::path& path, const CancelToken& cancel = {});

}  // namespace unshot
