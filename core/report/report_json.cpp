#include "report/report_json.h"

#include <nlohmann/json.hpp>

namespace unshot {
namespace {

// Keeps the fields in the order in which they are written here.
using Json = nlohmann::ordered_json;

Json jsonOf(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json jsonOf(const SceneFigures& figures, const std::filesystem::path& path, const std::string& name) {
  return {{"path", path.string()},          {"name", name},
          {"faces", figures.faces},         {"polygons", figures.polygons},
          {"triangles", figures.triangles}, {"materials", figures.materials},
          {"emitters", figures.emitters},   {"extent", jsonOf(figures.extent)},
          {"area", figures.area},           {"emitter_area", figures.emitter_area},
          {"closed", figures.closed()},     {"open_edges", figures.open_edges}};
}

Json jsonOf(const Diagnostics& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& d : diagnostics) {
    list.push_back({{"severity", d.severity == Severity::kWarning ? "warning" : "note"},
                    {"code", d.code},
                    {"message", d.message},
                    {"where", d.where},
                    {"advice", d.advice}});
  }
  return list;
}

Json jsonOf(const std::vector<PlanDecision>& plan) {
  Json list = Json::array();
  for (const PlanDecision& decision : plan) {
    list.push_back({{"key", decision.key},
                    {"what", decision.what},
                    {"why", decision.why},
                    {"saving", decision.saving},
                    {"sure", decision.sure()},
                    {"bound", decision.bound}});
  }
  return list;
}

Json jsonOf(const std::optional<GlRecord>& gl) {
  if (!gl) return nullptr;
  return {{"provider", gl->provider},
          {"renderer", gl->renderer},
          {"vendor", gl->vendor},
          {"version", gl->version},
          {"hardware", gl->hardware}};
}

Json jsonOf(const EnergyBalance& energy) {
  return {{"emitted", energy.emitted},
          {"absorbed", energy.absorbed},
          {"escaped", energy.escaped},
          {"unshot", energy.unshot},
          {"closure_defect", energy.closure_defect},
          {"residual", energy.residual()}};
}

/// Where there is no bound: null.
Json numberOrNull(double value) { return value < kNoBound ? Json(value) : Json(nullptr); }

Json valueOf(const ErrorEstimate& estimate) {
  return estimate.places > 0 ? Json(estimate.value) : Json(nullptr);
}

Json valueOf(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// 95 %.
Json intervalOf(const ErrorEstimate& estimate) {
  return estimate.places > 0 ? Json({estimate.low, estimate.high}) : Json(nullptr);
}

Json jsonOf(const SolverBounds& bounds) {
  return {{"lower", numberOrNull(bounds.lower)},
          {"upper", numberOrNull(bounds.upper)},
          {"total_upper", numberOrNull(bounds.total_upper)}};
}

Json jsonOf(const std::vector<HistoryEntry>& history) {
  Json list = Json::array();
  for (const HistoryEntry& entry : history) {
    const Measures& m = entry.measures;
    list.push_back({{"seconds", m.seconds},
                    {"cpu_seconds", m.cpu_seconds},
                    {"rows", m.rows},
                    {"shots", m.shots},
                    {"unshot", m.unshot_fraction},
                    {"bounds", jsonOf(m.bounds)}});
  }
  return list;
}

std::string textOf(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string reportJson(const RunRecord& record) {
  const Counts& counts = record.counts;
  const PhaseSeconds& seconds = record.seconds;
  return textOf({{"program", {{"name", "unshot"}, {"version", UNSHOT_VERSION}}},
                 {"scene", jsonOf(record.scene, record.scene_path, record.scene_name)},
                 {"diagnostics", jsonOf(record.diagnostics)},
                 {"plan", jsonOf(record.plan)},
                 {"sky", jsonOf(record.sky)},
                 {"mode", record.mode},
                 {"form_factors", record.form_factors},
                 {"gl", jsonOf(record.gl)},
                 {"counts",
                  {{"surfaces", counts.surfaces},
                   {"patches", counts.patches},
                   {"elements", counts.elements},
                   {"vertices", counts.vertices},
                   {"rows", counts.rows},
                   {"shots", counts.shots},
                   {"drawn", counts.drawn}}},
                 {"seconds",
                  {{"load", seconds.load},
                   {"mesh", seconds.mesh},
                   {"plan", seconds.plan},
                   {"solve", seconds.solve},
                   {"cpu_solve", seconds.cpu_solve}}},
                 {"unshot_fraction", record.measures.unshot_fraction},
                 {"errors",
                  {{"solver_lower", numberOrNull(record.measures.bounds.lower)},
                   {"solver_upper", numberOrNull(record.measures.bounds.upper)},
                   {"solver_total_upper", numberOrNull(record.measures.bounds.total_upper)},
                   {"form_factor", valueOf(record.estimates.form_factor)},
                   {"form_factor_interval", intervalOf(record.estimates.form_factor)},
                   {"discretisation", valueOf(record.estimates.discretisation)},
                   {"discretisation_interval", intervalOf(record.estimates.discretisation)},
                   {"total", valueOf(record.estimates.total)},
                   {"total_interval", intervalOf(record.estimates.total)},
                   {"places", record.estimates.both.places},
                   {"closure_defect", valueOf(record.estimates.defects.closure)},
                   {"reciprocity_defect", valueOf(record.estimates.defects.reciprocity)}}},
                 {"energy", jsonOf(record.energy)},
                 {"peak_memory_bytes", record.peak_memory_bytes},
                 {"kept_bytes", record.kept_bytes},
                 {"stopped_by", record.stopped_by},
                 {"history", jsonOf(record.history)}});
}

std::string checkJson(const Scene& scene, const CheckRecord& record) {
  const LightWalks& walks = record.walks;
  return textOf({{"scene", jsonOf(figuresOf(scene), scene.path, scene.name)},
                 {"spectral_radius", jsonOf(walks.spectral_radius)},
                 {"bounces_to_one_percent", valueOf(walks.bouncesToOnePercent())},
                 {"escaped", valueOf(walks.escaped)},
                 {"diagnostics", jsonOf(record.diagnostics)},
                 {"found_nothing", record.found_nothing},
                 {"plan", jsonOf(record.plan)}});
}

}  // namespace unshot
