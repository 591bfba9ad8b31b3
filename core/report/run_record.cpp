#include "report/run_record.h"

#include "base/clock.h"

namespace unshot {

RunRecord recordOf(const Solve& solve) {
  const Mesh& mesh = solve.mesh();
  RunRecord record;
  record.scene_path = solve.scene().path;
  record.scene_name = solve.scene().name;
  record.scene = figuresOf(solve.scene());
  record.diagnostics = solve.diagnostics();
  record.plan = solve.plan();
  record.sky = solve.sky();
  record.mode = solve.modeKey();
  record.form_factors = solve.formFactorsKey();
  record.solver_target = solve.solverTarget();
  record.measures = solve.measures();
  record.counts = {mesh.surfaces.size(), mesh.patch_count,      mesh.element_count, mesh.vertices.size(),
                   record.measures.rows, record.measures.shots, solve.drawn()};
  record.seconds = solve.seconds();
  record.estimates = solve.estimates();
  record.energy = solve.energy();
  record.peak_memory_bytes = peakMemoryBytes();
  record.kept_bytes = solve.keptBytes();
  record.stopped_by = solve.stoppedBy();
  record.history = solve.history();
  return record;
}

}  // namespace unshot
