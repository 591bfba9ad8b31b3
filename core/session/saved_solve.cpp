#include "session/saved_solve.h"

#include "base/archive.h"
#include "base/atomic_file.h"
#include "mesh/mesh_archive.h"
#include "scene/scene_hash.h"
#include "session/solve_impl.h"

namespace unshot {
namespace {

constexpr std::string_view kKind = "unshot solve";
// To be raised when the file changes, or what form-factor methods and mesh mean by the same options.
constexpr std::uint32_t kVersion = 7;

// What the file holds, for writing (constant values) and for reading.

template <class Archive, class Values>
void transferValues(Archive& a, Values& v) {
  a.fields(v.shot, v.unshot, v.emission_left, v.irradiance, v.direct);
  a.fields(v.escaped_power, v.defect_power, v.emission_shots);
}

// All but mesh and columns, which need no copy when they are written.
template <class Archive, class Saved>
void transferHead(Archive& a, Saved& s) {
  a.fields(s.scene_hash, s.form_factors, s.emit_front_only, s.sky, s.seed);
  a.fields(s.hemicube_resolution, s.hemicube_drawing, s.final_gather, s.mode, s.error);
  a.list(s.plan, [&](auto& d) { a.fields(d.key, d.what, d.why, d.saving, d.bound, d.patches); });
  a.list(s.do_anyway, [&](auto& key) { a.fields(key); });
  a.fields(s.quality, s.drafts_allowed, s.closure.scale, s.closure.exact, s.closure_pending);
  a.fields(s.seconds, s.cpu_seconds, s.mesh_seconds, s.plan_seconds);
  a.fields(s.shots, s.rows, s.drawn, s.history, s.state, s.stopped_by);
}

template <class Archive, class Light>
void transferGathered(Archive& a, Light& light) {
  a.fields(light.irradiance.vertices, light.irradiance.elements);
  a.fields(light.direct.vertices, light.direct.elements);
}

template <class Archive, class AnyColumn>
void transferColumn(Archive& a, AnyColumn& c) {
  a.fields(c.receiver, c.first, c.k, c.escape, c.defect, c.quality);
}

}  // namespace

SolveOptions SavedSolve::options(SolveOptions options) const {
  options.form_factors = form_factors;
  options.emit_front_only = emit_front_only;
  options.sky = sky;
  options.seed = seed;
  options.hemicube_resolution = hemicube_resolution;
  options.hemicube_drawing = hemicube_drawing;
  options.final_gather = final_gather;
  options.mesh = mesh;
  for (const std::string& key : do_anyway)
    if (leavesOut(options.do_anyway, key)) options.do_anyway.push_back(key);
  if (options.mode == "auto") options.mode = mode;
  return options;
}

std::shared_ptr<SavedSolve> readSavedSolve(const std::filesystem::path& path, const CancelToken& cancel) {
  auto saved = std::make_shared<SavedSolve>();
  ArchiveReader archive(path, kKind, kVersion, "a saved solve", cancel);
  saved->path = path;
  transferHead(archive, *saved);
  saved->mesh = readMesh(archive);
  transferValues(archive, saved->values);
  archive.fields(saved->local_irradiance);
  GatheredLight gathered;
  transferGathered(archive, gathered);
  if (!gathered.irradiance.vertices.empty())
    saved->gathered = std::make_shared<const GatheredLight>(std::move(gathered));
  archive.list(saved->columns, [&](auto& column) {
    cancel.check();
    archive.fields(column.first);
    transferColumn(archive, column.second);
  });
  return saved;
}

SavedSolve Solve::Impl::head() const {
  SavedSolve head;
  head.scene_hash = sceneHash(scene);
  head.form_factors = form_factors_key;
  head.emit_front_only = options.emit_front_only;
  head.sky = sky;
  head.seed = options.seed;
  head.hemicube_resolution = options.hemicube_resolution;
  head.hemicube_drawing = options.hemicube_drawing;
  head.final_gather = options.final_gather.value_or(false);
  head.mode = options.mode;
  head.error = options.error;
  head.mesh = mesh;
  head.plan = plan;
  head.do_anyway = options.do_anyway;
  for (std::uint32_t q = 0; q < transport->patchCount(); ++q) {
    const auto quality = transport->quality(q);
    head.quality.push_back(quality ? static_cast<std::uint8_t>(*quality) : SavedSolve::kUnused);
  }
  head.drafts_allowed = transport->draftsAllowed();
  head.closure = transport->closure();
  head.closure_pending = closure_pending;
  head.seconds = measures.seconds;
  head.cpu_seconds = measures.cpu_seconds;
  head.mesh_seconds = seconds.mesh;
  head.plan_seconds = seconds.plan;
  head.shots = measures.shots;
  head.rows = measures.rows;
  head.drawn = drawn_before + transport->drawn();
  head.history = history;
  head.state = progress_state;
  head.stopped_by = stopped_by;
  return head;
}

void Solve::save(const std::filesystem::path& path, const CancelToken& cancel) const {
  const Impl& s = *impl_;
  const Transport& transport = *s.transport;
  const SavedSolve head = s.head();
  writeWholeFile(path, [&](const std::function<void(std::string_view)>& sink) {
    ArchiveWriter archive(sink);
    archive.head(kKind, kVersion);
    transferHead(archive, head);
    writeMesh(archive, *s.mesh);
    transferValues(archive, s.state->values());
    archive.fields(s.local_pass ? s.local_pass->irradiance() : std::vector<glm::dvec3>());
    const bool gathered = s.final_gather && s.final_gather->light();
    transferGathered(archive, gathered ? *s.final_gather->light() : GatheredLight{});
    archive.fields(std::uint64_t{transport.keptColumns()});
    for (std::uint32_t q = 0; q < transport.patchCount(); ++q) {
      cancel.check();
      cancel.report(static_cast<double>(q) / static_cast<double>(transport.patchCount()));
      const Column* const column = transport.kept(q);
      if (!column) continue;
      archive.fields(q);
      transferColumn(archive, *column);
    }
    archive.finish();
    cancel.check();
  });
}

// In the place of a start: after the transport and the state are made, before a mode is chosen.
void Solve::Impl::restore(SavedSolve& saved) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::kInput, why, saved.path.string(), "the scene that it was saved from, unchanged");
  };
  if (saved.quality.size() != transport->patchCount() || !state->setValues(std::move(saved.values)))
    refuse("does not fit its own mesh");
  plan = std::move(saved.plan);
  std::erase_if(plan, [this](const PlanDecision& d) { return !leavesOut(options.do_anyway, d.key); });
  closure_pending = closure_pending && saved.closure_pending;
  if (!saved.closure.scale.empty() && (saved.closure.scale.size() != transport->receiverCount() ||
                                       saved.closure.exact.size() != transport->patchCount()))
    refuse("does not fit its own mesh");
  transport->restoreClosure(std::move(saved.closure));
  for (std::uint32_t q = 0; q < transport->patchCount(); ++q) {
    if (saved.quality[q] != SavedSolve::kUnused)
      transport->expect(q, static_cast<ColumnQuality>(saved.quality[q]));
  }
  for (auto& [q, column] : saved.columns) {
    if (q >= transport->patchCount()) refuse("does not fit its own mesh");
    transport->restore(q, std::move(column));
  }
  // Drafts must be known, so that they give way one day.
  for (std::uint32_t q = 0; q < transport->patchCount(); ++q) {
    const std::uint8_t quality = saved.quality[q];
    const bool draft =
        quality != SavedSolve::kUnused && quality != static_cast<std::uint8_t>(ColumnQuality::kFull);
    if (draft && !transport->quality(q)) transport->column(q);
  }
  transport->allowDrafts(saved.drafts_allowed);
  if (local_pass) local_pass->restore(std::move(saved.local_irradiance));
  if (saved.gathered && final_gather) {
    for (const MeshField* field : {&saved.gathered->irradiance, &saved.gathered->direct}) {
      if (field->vertices.size() != mesh->vertices.size() || field->elements.size() != mesh->element_count)
        refuse("does not fit its own mesh");
    }
    final_gather->restore(std::move(saved.gathered));
  }
}

// The clocks and counts go on, and what has ended well has ended still, where the error asked for is no
// smaller.
void Solve::Impl::takeUp(const SavedSolve& saved) {
  solve_start -= saved.seconds;
  cpu_start -= saved.cpu_seconds;
  seconds.mesh = saved.mesh_seconds;
  seconds.plan = saved.plan_seconds;
  measures.shots = saved.shots;
  rows_before = transport->computed() - saved.rows;
  drawn_before = saved.drawn;
  if (options.max_seconds) *options.max_seconds += saved.seconds;
  if (options.max_shots) *options.max_shots += saved.shots;
  history = saved.history;
  if (saved.state == SolveState::kConverged && options.error >= saved.error)
    stop(SolveState::kConverged, saved.stopped_by);
}

}  // namespace unshot
