#include "cli/report_scene.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "base/atomic_file.h"
#include "base/clock.h"
#include "base/read_file.h"
#include "cli/gl_context.h"
#include "cli/gnuplot.h"
#include "cli/text.h"
#include "export/probes.h"
#include "report/reference.h"
#include "report/reference_error.h"
#include "report/reference_file.h"
#include "scene/obj_reader.h"
#include "scene/sky.h"

namespace unshot {
namespace {

// Shares of a scene's time: a run besides form factors, and all pictures.
constexpr double kRunShare = 0.12, kPictureShare = 0.4;
// Total errors of a percent are to be judged by it.
constexpr double kReferenceError = 0.003;
// Work done by then, for the progress: reference, exact solution, first runs, repeats, pictures.
constexpr double kDone[] = {0, 0.1, 0.4, 0.65, 0.9, 1};

class SceneRun {
 public:
  SceneRun(const ReportRequest& request, const std::filesystem::path& path, const std::string& folder,
           const InterruptFlag& interrupted, const SceneProgress& progress)
      : request_(request),
        interrupted_(interrupted),
        progress_(progress),
        began_(wallSeconds()),
        scene_(readObj(path, interrupted.token())),
        context_(request.gl),
        runs_(scene_, request.options, [this]() -> gl::Context& { return context_.get(); }) {
    CurveRecord& r = out_.record;
    r.scene_path = path;
    r.scene_name = scene_.name;
    r.folder = folder;
    r.scene = figuresOf(scene_);
    r.options = request.options;
    r.repeats_asked = request.repeats;
  }

  MeasuredScene run() {
    printDiagnostics(std::cerr, scene_.diagnostics);
    trace();
    if (!stopped()) solveExactly();
    if (!stopped()) firstRuns();
    if (!stopped()) runBounded();
    if (!stopped()) repeats();
    if (!stopped() && request_.pictures) takePictures();
    CurveRecord& r = out_.record;
    r.interrupted = stopped();
    r.gl = context_.record();
    r.peak_memory_bytes = peakMemoryBytes();
    if (runs_.columns().full()) {
      r.notes.push_back("The form factors do not all fit into the " +
                        memoryText(static_cast<double>(request_.options.kept_bytes)) +
                        " they may take (--keep): those beyond are computed again for every shot.");
    }
    return std::move(out_);
  }

 private:
  bool stopped() const { return interrupted_.raised(); }
  double elapsed() const { return wallSeconds() - began_; }

  /// Tells of a phase of which a part is done.
  RunWatch watch(std::size_t phase, double from, double to, std::string what) {
    return [this, phase, from, to, what = std::move(what)](double fraction) {
      const double of_phase = from + (to - from) * std::clamp(fraction, 0.0, 1.0);
      progress_(kDone[phase] + (kDone[phase + 1] - kDone[phase]) * of_phase, what);
      return !stopped();
    };
  }

  void note(const std::string& text) {
    out_.record.notes.push_back(text);
    std::cerr << out_.record.scene_name << ": note: " << text << std::endl;
  }

  void trace() {
    if (!request_.reference) return;
    ReferenceOptions options;
    options.seed = request_.options.seed;
    options.emit_front_only = request_.options.emit_front_only;
    options.sky = skyOver(scene_, request_.options.sky);
    options.relative_error = kReferenceError;
    options.max_seconds = request_.reference_seconds;
    options.progress = watch(0, 0, 1, "tracing the reference");
    reference_ = cachedReference(scene_, options, request_.out);
    printDiagnostics(std::cerr, reference_.diagnostics);
    for (const ReferencePoint& p : reference_.points) probes_.push_back({p.position, p.normal});
    out_.record.reference = {
        reference_.points.size(), noiseOf(reference_.points), medianNoiseOf(reference_.points),
        reference_.seconds,       reference_.from_file,       referencePath({}, scene_, options).string()};
    began_ = wallSeconds();
  }

  void solveExactly() {
    out_.record.exact =
        runs_.solveExactly(request_.max_seconds, watch(1, 0, 1, "solving exactly, to measure against"));
    out_.record.solve = runs_.figures();
    const ExactSolution& exact = out_.record.exact;
    if (exact.radiosity.empty() && !exact.interrupted) {
      note("there is no exact solution to measure against: " + exact.why_not +
           "; bounds stand in its place (try --max-seconds or fewer --elements)");
    }
  }

  TotalError totalError(const Solve& solve) const {
    const ReferenceError error =
        errorAgainst(reference_.points, answerProbes(solve.snapshot(), probes_, false));
    return {error.nrmse, whyNotJudgeable(error)};
  }

  void firstRuns() {
    const auto total = [this](const Solve& solve) { return totalError(solve); };
    const auto& modes = request_.modes;
    for (std::size_t k = 0; k < modes.size() && !stopped(); ++k) {
      const double n = static_cast<double>(modes.size()), at = static_cast<double>(k);
      const double began = wallSeconds();
      ModeCurve curve = runs_.run(modes[k], out_.record.exact.radiosity, kRunShare * request_.max_seconds,
                                  probes_.empty() ? std::function<TotalError(const Solve&)>() : total,
                                  watch(2, at / n, (at + 1) / n, modes[k]));
      if (!curve.left_out.empty()) note(curve.mode + " is left out: " + curve.left_out);
      if (curve.failure) {
        const Error said(curve.failure->kind(), curve.mode + ": " + curve.failure->what(),
                         scene_.path.string(), curve.failure->advice());
        std::cerr << "unshot: " << said.fullText() << std::endl;
        if (!out_.failure) out_.failure = curve.failure;
      }
      // Each has a first point at least, and more than that unless it was interrupted at once.
      const bool whole = curve.points.size() > 1 || !curve.left_out.empty() || curve.failure;
      if (whole) out_.record.curves.push_back(std::move(curve));
      run_seconds_.push_back(wallSeconds() - began);
    }
    judgeReference();
  }

  /// For the plot of bounds: the first curve again, where its form factors were drafts on the way.
  void runBounded() {
    const auto& curves = out_.record.curves;
    const auto first =
        std::find_if(curves.begin(), curves.end(), [](const ModeCurve& c) { return c.points.size() > 1; });
    if (first == curves.end() || !first->drafts) return;
    ModeCurve curve =
        runs_.runBounded(first->mode, out_.record.exact.radiosity, kRunShare * request_.max_seconds,
                         watch(2, 1, 1, first->mode + " without drafts, for its bounds"));
    if (!stopped() && !curve.failure) out_.record.bounded = std::move(curve);
  }

  void judgeReference() {
    std::string why;
    for (const ModeCurve& curve : out_.record.curves) {
      if (!curve.why_not_judgeable.empty()) why = curve.why_not_judgeable;
    }
    if (!why.empty()) note("total errors as small as this cannot be judged: " + why);
  }

  /// Rounds over all modes, each with form factors computed anew, as long as there is time.
  void repeats() {
    auto& curves = out_.record.curves;
    const double form_factors = longestFormFactors();
    for (std::size_t round = 1; round < request_.repeats && !stopped(); ++round) {
      double expected = form_factors;
      for (const double s : run_seconds_) expected += s;
      if (elapsed() + expected > request_.max_seconds) {
        note("times are from " + countedText(round, "run") + " of each mode instead of " +
             countText(request_.repeats) + ": more would not fit into the " +
             durationText(request_.max_seconds) + " for a scene (--max-seconds)");
        return;
      }
      runs_.columns().measureAnew();
      for (std::size_t k = 0; k < curves.size() && !stopped(); ++k) {
        const double n = static_cast<double>(curves.size() * (request_.repeats - 1));
        const double at = static_cast<double>((round - 1) * curves.size() + k);
        runs_.repeat(curves[k], watch(3, at / n, (at + 1) / n,
                                      curves[k].mode + ", run " + std::to_string(round + 1) + " of " +
                                          std::to_string(request_.repeats)));
      }
    }
  }

  double longestFormFactors() const {
    double longest = 0;
    for (const ModeCurve& curve : out_.record.curves) longest = std::max(longest, curve.form_factor_seconds);
    return longest;
  }

  void takePictures() {
    out_.pictures = makePictures(out_.record, runs_, context_, kPictureShare * request_.max_seconds,
                                 watch(4, 0, 1, "pictures"));
    if (!out_.pictures.why_not.empty() && !stopped())
      note((out_.pictures.tables.empty() ? "there are no pictures: " : "not all pictures are there: ") +
           out_.pictures.why_not);
  }

  const ReportRequest& request_;
  const InterruptFlag& interrupted_;
  const SceneProgress& progress_;
  double began_;
  Scene scene_;
  LazyContext context_;
  CurveRuns runs_;
  Reference reference_;
  std::vector<Probe> probes_;
  std::vector<double> run_seconds_;
  MeasuredScene out_;
};

}  // namespace

MeasuredScene measureScene(const ReportRequest& request, const std::filesystem::path& scene,
                           const std::string& folder, const InterruptFlag& interrupted,
                           const SceneProgress& progress) {
  return SceneRun(request, scene, folder, interrupted, progress).run();
}

void writeScene(const ReportRequest& request, MeasuredScene& scene, bool draw) {
  const CurveRecord& record = scene.record;
  const std::filesystem::path folder = request.out / record.folder;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(ErrorKind::kEnvironment, "the folder cannot be made: " + error.message(), folder.string(),
                "another --out");
  }
  writeWholeFile(folder / "curves.csv", curvesCsv(record));
  if (const std::string bounds = boundsCsv(record); !bounds.empty())
    writeWholeFile(folder / "bounds.csv", bounds);
  writeWholeFile(folder / "table.csv", tableCsv(record));
  writeWholeFile(folder / "report.json", curvesJson(record));
  std::string failed;
  for (const CurvePlot& plot : plotsOf(record)) {
    writeWholeFile(folder / (plot.name + ".gp"), plot.script);
    if (!draw) continue;
    const std::string wrong = runGnuplot(folder, plot.name + ".gp");
    if (wrong.empty()) {
      scene.svg[plot.name] = readFile(folder / (plot.name + ".svg"));
    } else if (failed.empty()) {
      failed = wrong;
    }
  }
  if (!failed.empty())
    throw Error(ErrorKind::kEnvironment, "plots could not be drawn: " + failed, folder.string(),
                "room on the disk; the scripts are there: gnuplot NAME.gp in this folder");
}

}  // namespace unshot
