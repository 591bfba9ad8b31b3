#include "bench/estimate_table.h"

#include <memory>
#include <string>

#include "base/clock.h"
#include "bench/text_table.h"
#include "gl/context.h"
#include "scene/obj_reader.h"
#include "session/lane.h"
#include "solver/modes.h"

namespace unshot::bench {
namespace {

void addRow(TextTable& table, const std::string& scene, const std::string& mode, bool quick) {
  std::unique_ptr<gl::Context> context;
  SolveOptions options;
  options.mode = mode;
  options.error = quick ? 0.1 : 0.003;
  options.max_seconds = quick ? 0.2 : 20;
  if (quick) options.elements = 100;
  const auto begun = [&](const SolveOptions& wanted) {
    return std::make_unique<Solve>(readObj(UNSHOT_SOURCE_DIR "/assets/" + scene + ".obj"), wanted,
                                   [&]() -> gl::Context& {
                                     if (!context) context = gl::createContext("osmesa");
                                     return *context;
                                   });
  };
  const std::unique_ptr<Solve> solve = begun(options);
  while (solve->state() == SolveState::kRunning) solve->step(Solve::kMostAtOnce);
  // Busy time: bounds and estimates take one thread, OpenGL in software all of them.
  const double bounds = solve->errorSeconds(), seconds = solve->seconds().cpu_solve, began = wallSeconds();
  solve->estimate(256);
  const double estimate = wallSeconds() - began;
  // As the viewer solves.
  options.draft_first = true;
  Lane lane(begun(options), options, 0, [](const Error& error) { throw error; });
  while (lane.running()) lane.step();
  const double live = lane.solve().seconds().cpu_solve;
  table.add({scene, mode, figure("%.2f", seconds), figure("%.1f %%", 100 * bounds / seconds),
             figure("%.3f", estimate), figure("%.2f", live),
             figure("%.1f %%", 100 * lane.errorSeconds() / live)});
}

}  // namespace

void printEstimateTable(bool quick) {
  TextTable table({"scene", "mode", "solve, CPU s", "bounds, share of it", "256 places, s", "viewer, CPU s",
                   "bounds and estimates"});
  for (const IterationModeRow& row : iterationModes())
    addRow(table, "cornell_box", std::string(row.info.key), quick);
  if (!quick) {
    addRow(table, "two_rooms", "southwell", quick);
    addRow(table, "library", "southwell", quick);
  }
  table.print();
}

}  // namespace unshot::bench
