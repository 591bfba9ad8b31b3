#include "cli/summary.h"

#include "cli/text.h"

namespace unshot {
namespace {

std::string stopText(const RunRecord& record, const SolveOptions& options) {
  const std::string& by = record.stopped_by;
  if (by == "solver_upper") return by + ": the error's bound is below " + percentText(record.solver_target);
  if (by == "solver_total_upper")
    return by + ": the bound of the total error is below " + percentText(record.solver_target);
  if (by == "max_seconds" && options.max_seconds) return "max_seconds: " + durationText(*options.max_seconds);
  if (by == "max_shots" && options.max_shots) return "max_shots: " + countText(*options.max_shots);
  return by;
}

std::string shotsText(const Counts& counts) {
  std::string text = countText(counts.shots) + ", " + countedText(counts.rows, "column") + " computed";
  if (counts.drawn > 0) text += " from " + countedText(counts.drawn, "hemicube");
  return text;
}

std::string boundText(const SolverBounds& bounds) {
  std::string text;
  if (bounds.upper < kNoBound) {
    text = "at most " + percentText(bounds.upper) + " of the reflected light (RMS)";
    if (bounds.lower > 0) text += ", at least " + percentText(bounds.lower);
  }
  if (bounds.total_upper < kNoBound)
    text += (text.empty() ? "at most " : "; ") + percentText(bounds.total_upper) + " of its total";
  return text.empty() ? "no bound yet" : text;
}

std::string estimateText(const ErrorEstimate& e) {
  return percentText(e.value) + " (" + percentText(e.low) + " to " + percentText(e.high) + ")";
}

std::string estimatesText(const ErrorEstimates& estimates) {
  if (estimates.both.places == 0) return "not estimated";
  return "form factors " + estimateText(estimates.form_factor) + ", mesh " +
         estimateText(estimates.discretisation) + ", both " + estimateText(estimates.both);
}

std::string totalText(const ErrorEstimates& estimates) {
  if (estimates.total.places == 0) return "not estimated";
  return "about " + estimateText(estimates.total) + " of the reflected light in all, from " +
         countedText(estimates.total.places, "place");
}

std::string defectsText(const FormFactorDefects& defects) {
  if (!defects.closure) return "not examined";
  return "closure is off by " + percentText(*defects.closure) +
         (defects.reciprocity ? ", reciprocity by " + percentText(*defects.reciprocity) : "") + " (RMS of " +
         countedText(defects.columns, "column") + ")";
}

std::string rendererText(const RunRecord& record) {
  if (!record.gl) return "none needed";
  return record.gl->provider + ", " + record.gl->renderer + (record.gl->hardware ? "" : " (software)");
}

}  // namespace

std::string planText(const PlanDecision& decision) {
  const std::string sure = decision.bound > 0 ? "within " + percentText(decision.bound) : "exact";
  return decision.what + ": " + decision.why + " (" +
         (decision.saving.empty() ? "" : "saves " + decision.saving + "; ") + sure + ")";
}

void printSummary(std::ostream& out, const RunRecord& record, const SolveOptions& options,
                  const std::vector<std::string>& written) {
  const PhaseSeconds& seconds = record.seconds;
  const double total = seconds.load + seconds.mesh + seconds.plan + seconds.solve;
  Lines lines = {
      {"scene", record.scene_name + ": " + countedText(record.scene.faces, "face") + ", " +
                    countedText(record.scene.materials, "material") + ", " +
                    countedText(record.scene.emitters, "light polygon")},
      {"mesh", countedText(record.counts.elements, "element") + ", " +
                   countedText(record.counts.patches, "patch", "patches") + ", " +
                   countedText(record.counts.vertices, "vertex", "vertices")},
      {"method", record.mode + ", " + record.form_factors},
      {"renderer", rendererText(record)},
      {"shots", shotsText(record.counts)},
      {"unshot", percentText(record.measures.unshot_fraction)},
      {"error", totalText(record.estimates)},
      {"solver error", boundText(record.measures.bounds)},
      {"other errors", estimatesText(record.estimates)},
      {"form factors", defectsText(record.estimates.defects)},
      {"time", durationText(total) + " (load " + durationText(seconds.load) + ", mesh " +
                   durationText(seconds.mesh) + ", plan " + durationText(seconds.plan) + ", solve " +
                   durationText(seconds.solve) + "), CPU " + durationText(seconds.cpu_solve)},
      {"memory", memoryText(static_cast<double>(record.peak_memory_bytes)) + " at most, " +
                     memoryText(static_cast<double>(record.kept_bytes)) + " of it kept form factors"},
      {"stopped by", stopText(record, options)},
  };
  for (const PlanDecision& decision : record.plan) lines.emplace_back("left out", planText(decision));
  for (const std::string& file : written) lines.emplace_back("written", file);
  printLines(out, lines);
}

}  // namespace unshot
