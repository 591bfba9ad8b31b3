// The record of a scene as JSON.
#include <nlohmann/json.hpp>

#include "report/curve_record.h"

namespace unshot {
namespace {

using Json = nlohmann::ordered_json;

Json figureOrNull(std::optional<double> value) {
  return value && *value < kNoBound ? Json(*value) : Json(nullptr);
}

Json textOrNull(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json jsonOf(const CurvePoint& p) {
  return {{"step", p.step},
          {"shots", p.shots},
          {"rows", p.rows},
          {"cpu_seconds", p.cpu_seconds},
          {"cpu_seconds_min", p.cpu_seconds_min},
          {"cpu_seconds_max", p.cpu_seconds_max},
          {"seconds", p.seconds},
          {"unshot_fraction", p.unshot_fraction},
          {"solver_error", figureOrNull(solverErrorOf(p))},
          {"solver_lower", figureOrNull(p.bounds.lower)},
          {"solver_upper", figureOrNull(p.bounds.upper)},
          {"solver_total_error", figureOrNull(solverTotalErrorOf(p))},
          {"solver_total_upper", figureOrNull(p.bounds.total_upper)},
          {"total_error", figureOrNull(p.total_error)}};
}

Json reachedBy(const ModeCurve& curve, const CurveRecord& record) {
  Json out = Json::array();
  for (const ErrorMeasure& error : measuresOf(record)) {
    for (const double level : kErrorLevels) {
      const auto cost = [&](const PointQuantity& of) {
        return figureOrNull(costToReach(curve.points, level, error.of, of));
      };
      out.push_back({{"error", error.key},
                     {"level", level},
                     {"cpu_seconds", cost(busySecondsOf)},
                     {"rows", cost(rowsOf)},
                     {"shots", cost(shotsOf)}});
    }
  }
  return out;
}

Json jsonOf(const ModeCurve& curve, const CurveRecord& record) {
  Json points = Json::array();
  for (const CurvePoint& point : curve.points) points.push_back(jsonOf(point));
  return {{"mode", curve.mode},
          {"left_out", textOrNull(curve.left_out)},
          {"failure", curve.failure ? Json(curve.failure->what()) : Json(nullptr)},
          {"stopped_by", textOrNull(curve.stopped_by)},
          {"runs", curve.runs.size()},
          {"form_factor_cpu_seconds", curve.form_factor_seconds},
          {"kept_bytes", curve.kept_bytes},
          {"memory_bytes", curve.memoryBytes()},
          {"total_error_not_judgeable", textOrNull(curve.why_not_judgeable)},
          {"reached", reachedBy(curve, record)},
          {"points", points}};
}

Json jsonOf(const std::optional<ReferenceRecord>& reference) {
  if (!reference) return nullptr;
  return {{"points", reference->points},
          {"noise", figureOrNull(reference->noise)},
          {"median_noise", figureOrNull(reference->median_noise)},
          {"seconds", reference->seconds},
          {"from_file", reference->from_file},
          {"file", reference->file}};
}

Json exactOf(const ExactSolution& exact) {
  if (exact.radiosity.empty()) return {{"mode", nullptr}, {"why_not", exact.why_not}};
  return {{"mode", exact.mode}, {"unshot_fraction", exact.unshot_fraction}, {"seconds", exact.seconds}};
}

}  // namespace

std::string curvesJson(const CurveRecord& record) {
  Json curves = Json::array();
  for (const ModeCurve& curve : record.curves) curves.push_back(jsonOf(curve, record));
  const Json json = {
      {"program", {{"name", "unshot"}, {"version", UNSHOT_VERSION}}},
      {"scene",
       {{"path", record.scene_path.string()},
        {"name", record.scene_name},
        {"triangles", record.scene.triangles}}},
      {"form_factors", record.solve.form_factors},
      {"gl", record.gl ? Json(record.gl->provider + ", " + record.gl->renderer) : Json(nullptr)},
      {"counts",
       {{"surfaces", record.solve.surfaces},
        {"patches", record.solve.patches},
        {"elements", record.solve.elements},
        {"vertices", record.solve.vertices}}},
      {"options",
       {{"error", record.options.error},
        {"seed", record.options.seed},
        {"kept_bytes", record.options.kept_bytes},
        {"repeats", record.repeats_asked}}},
      {"exact", exactOf(record.exact)},
      {"reference", jsonOf(record.reference)},
      {"notes", record.notes},
      {"interrupted", record.interrupted},
      {"peak_memory_bytes", record.peak_memory_bytes},
      {"modes", curves},
      {"without_drafts", record.bounded.points.empty() ? Json(nullptr) : jsonOf(record.bounded, record)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace unshot
