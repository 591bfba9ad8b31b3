#include "session/solve.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "base/clock.h"
#include "cli/commands.h"
#include "cli/gl_context.h"
#include "cli/interrupt.h"
#include "cli/picture.h"
#include "cli/progress.h"
#include "cli/saving_arguments.h"
#include "cli/solve_request.h"
#include "cli/summary.h"
#include "cli/text.h"
#include "exit_codes.h"
#include "report/report_json.h"
#include "scene/obj_reader.h"
#include "session/saved_solve.h"
#include "session/saver.h"

namespace unshot {
namespace {

/// Places to estimate errors at: a small part of what the solve took.
std::size_t placesFor(const Measures& measures) {
  return std::clamp<std::size_t>(measures.rows / 2, 64, 512);
}

/// Steps until the solve is over or the user interrupts it.
void runSteps(Solve& solve, const InterruptFlag& interrupted, Progress& progress, Saver& saver) {
  const double began = solve.measures().seconds;
  while (solve.state() == SolveState::kRunning) {
    if (interrupted.raised()) {
      solve.interrupt();
      break;
    }
    solve.step(Solve::kMostAtOnce);
    const Measures& m = solve.measures();
    if (solve.takesOver()) {
      progress.update(solve.progress(), solve.activity());
    } else if (solve.gathers()) {
      progress.update(solve.progress(), "final gathering");
    } else {
      progress.update({solve.progress(), m.unshot_fraction, m.solverBound(), m.shots, m.seconds - began});
    }
    if (solve.takesOver()) continue;
    if (const std::optional<Error> failed = saver.offer(solve)) {
      std::cerr << "unshot: " << failed->fullText() << "\n  the solve goes on, and is saved again later"
                << std::endl;
    }
  }
  progress.finish();
}

/// What the state leaves wrong; where that cannot be told, its results are written all the same.
void estimateErrors(Solve& solve, Progress& progress) {
  progress.phase("estimating errors");
  try {
    solve.estimate(placesFor(solve.measures()));
  } catch (...) {
    const Error error = presentError();
    printDiagnostics(std::cerr, {{Severity::kWarning,
                                  "not-estimated",
                                  std::string("errors cannot be estimated: ") + error.what(),
                                  {},
                                  error.advice()}});
  }
  progress.finish();
}

/// A file to be written, whatever it holds.
struct WriteJob {
  std::filesystem::path path;
  std::function<void()> write;
};

/// Writes every output. Where one fails, the others are written all the same, and the first Error is
/// returned. Pipes and devices come last: they may wait for a reader, and files must not wait for them.
std::optional<Error> writeAll(std::vector<WriteJob> jobs, std::vector<std::string>& written) {
  std::stable_partition(jobs.begin(), jobs.end(),
                        [](const WriteJob& job) { return !isPipeOrDevice(job.path); });
  std::optional<Error> first;
  for (const WriteJob& job : jobs) {
    try {
      job.write();
      written.push_back(job.path.string());
    } catch (const Error& error) {
      if (first) {
        std::cerr << "unshot: " << error.fullText() << std::endl;
      } else {
        first = error;
      }
    } catch (const std::exception& error) {
      const Error wrapped(ErrorKind::kInternal, std::string("could not be made: ") + error.what(),
                          job.path.string());
      if (!first) first = wrapped;
    }
  }
  return first;
}

std::string boundText(const Measures& m) {
  return m.solverBound() < kNoBound ? percentText(m.solverBound()) : std::string("not known yet");
}

/// The exit code of a solve that has ended and is written, with a word on standard error where it has not
/// converged.
int concludeSolve(const Solve& solve, const SolveOptions& options, const InterruptFlag& interrupted) {
  if (interrupted.raised() && solve.state() != SolveState::kInterrupted) {
    std::cerr << "unshot: interrupted after the solve had ended (" << solve.stoppedBy()
              << "); its result is written" << std::endl;
    return kExitInterrupted;
  }
  switch (solve.state()) {
    case SolveState::kConverged:
      return kExitDone;
    case SolveState::kInterrupted:
      std::cerr << "unshot: interrupted; what was reached is written" << std::endl;
      return kExitInterrupted;
    case SolveState::kLimit:
      std::cerr << "unshot: not converged: " << percentText(solve.measures().unshot_fraction)
                << " is unshot, and the error's bound is " << boundText(solve.measures()) << "; "
                << percentText(options.error) << " was asked for; stopped by " << solve.stoppedBy()
                << "\n  try: a higher limit, a larger --error or fewer --elements" << std::endl;
      return kExitNotConverged;
    default:
      break;
  }
  const Error& failure = *solve.failure();
  throw Error(failure.kind(), failure.what(), failure.where(),
              failure.advice() + "; what was reached is written");
}

/// Prints each diagnostic once, whichever solve it is of.
class Sayings {
 public:
  void print(const Diagnostics& all) {
    Diagnostics fresh;
    for (const Diagnostic& d : all)
      if (said_.insert(d.code + d.message + d.where).second) fresh.push_back(d);
    printDiagnostics(std::cerr, fresh);
  }

 private:
  std::set<std::string> said_;
};

/// Goes on on the mesh for the error asked for; what was reached before stays where that comes to nothing.
/// Returns whether it did not for want of time.
bool refineMesh(std::unique_ptr<Solve>& solve, LazyContext& context, const InterruptFlag& interrupted,
                Progress& progress, Saver& saver) {
  progress.phase("refining the mesh");
  std::unique_ptr<Solve> finer;
  try {
    finer = std::make_unique<Solve>(
        *solve, [&]() -> gl::Context& { return context.get(); }, interrupted.token());
  } catch (const Cancelled&) {
  }
  progress.finish();
  if (!finer) return false;
  runSteps(*finer, interrupted, progress, saver);
  if (finer->takesOver() || finer->state() == SolveState::kFailed)
    return finer->state() == SolveState::kLimit;
  solve = std::move(finer);
  estimateErrors(*solve, progress);
  return false;
}

/// Writes and says what was reached; returns the exit code. `written`, `failure`: what was written before,
/// and what could not be. `mesh_too_coarse`: for the error asked for, as there was no time to refine it.
int finishSolve(const SolveRequest& request, const Solve& solve, LazyContext& context,
                std::span<const Probe> probes, double load_seconds, const InterruptFlag& interrupted,
                bool mesh_too_coarse, std::vector<std::string> written, std::optional<Error> failure) {
  const Snapshot snapshot = solve.snapshot();
  const auto record = [&] {
    RunRecord r = recordOf(solve);
    r.gl = context.record();
    r.seconds.load = load_seconds;
    return r;
  };
  PictureMaker pictures(context, snapshot, request.picture);
  ExportSource source{.snapshot = snapshot,
                      .with_ambient = request.picture.ambient,
                      .exposure = vertexExposure(snapshot, request.picture.ambient),
                      .picture = [&]() -> const Image8& { return pictures.get().srgb; },
                      .radiance = [&]() -> const ImageF& { return pictures.get().linear; },
                      .report = [&] { return reportJson(record()); },
                      .probes = probes,
                      .warn = [](const Diagnostic& d) { printDiagnostics(std::cerr, {d}); }};
  std::vector<WriteJob> jobs;
  for (const Output& output : request.outputs)
    jobs.push_back({output.path, [&] { output.exporter->write(source, output.path); }});
  const std::optional<Error> other_failure = writeAll(std::move(jobs), written);
  if (!failure) failure = other_failure;
  printSummary(std::cout, record(), solve.options(), written);
  std::cout.flush();
  if (failure) throw *failure;
  if (mesh_too_coarse) {
    std::cerr << "unshot: not converged: the time was up before the mesh was as fine as "
              << percentText(solve.options().error) << " asks for\n  try: a larger --max-seconds or --error"
              << std::endl;
    return kExitNotConverged;
  }
  return concludeSolve(solve, solve.options(), interrupted);
}

/// Saves it where that is asked for.
std::optional<Error> save(const Solve& solve, const SolveRequest& request, Saver& saver,
                          std::vector<std::string>& written) {
  std::vector<WriteJob> jobs;
  if (!request.save.empty()) jobs.push_back({request.save, [&] { saver.save(solve); }});
  return writeAll(std::move(jobs), written);
}

int solveScene(const SolveRequest& request, const InterruptFlag& interrupted) {
  checkOutputs(request);
  printDiagnostics(std::cerr, endingNotes(request));
  useShaderDir(request.shader_dir);
  std::vector<Probe> probes;
  if (!request.probe.empty()) probes = readProbes(request.probe);
  SolveOptions options = request.options;
  std::shared_ptr<SavedSolve> saved = readResumed(request.resume, request.error_given, options);
  Progress progress(options.max_seconds.value_or(0));
  LazyContext context(request.gl);
  // A picture needs GL: where there is none, that is said before the solve.
  if (request.needsPicture()) context.get();
  progress.phase("reading " + request.scene.string());
  const double load_began = wallSeconds();
  Scene scene = readObj(request.scene, interrupted.token());
  const double load_seconds = wallSeconds() - load_began;
  progress.finish();
  Sayings sayings;
  sayings.print(scene.diagnostics);
  interrupted.token().check();
  progress.phase("meshing");
  auto solve = std::make_unique<Solve>(
      std::move(scene), options, [&]() -> gl::Context& { return context.get(); }, interrupted.token(),
      std::move(saved));
  progress.finish();
  interrupted.token().check();
  sayings.print(solve->diagnostics());
  Saver saver(request.save, request.save_every);
  runSteps(*solve, interrupted, progress, saver);
  // First, since it takes no memory, of which there may be none left.
  std::vector<std::string> written;
  std::optional<Error> failure = save(*solve, request, saver, written);
  bool mesh_too_coarse = false;
  if (!interrupted.raised() && solve->state() != SolveState::kFailed) {
    estimateErrors(*solve, progress);
    if (solve->finerMeshError()) {
      mesh_too_coarse = refineMesh(solve, context, interrupted, progress, saver);
      written.clear();
      failure = save(*solve, request, saver, written);
    }
  }
  sayings.print(solve->diagnostics());
  return finishSolve(request, *solve, context, probes, load_seconds, interrupted, mesh_too_coarse,
                     std::move(written), std::move(failure));
}

int runSolve(const SolveRequest& request) {
  const InterruptFlag interrupted;
  try {
    return solveScene(request, interrupted);
  } catch (const Cancelled&) {
    std::cerr << "unshot: interrupted before the solve began; there is no result to write" << std::endl;
    return kExitInterrupted;
  }
}

}  // namespace

void setUpSolve(Command& command) {
  command.footer(
      "Lengths are in the scene's unit, taken as metres. Ctrl-C ends the solve between two steps and\n"
      "writes what was reached; a second one ends the program at once.\n"
      "Every file is written in its option's format, whatever its name ends with.\n"
      "\n"
      "Example: unshot solve scene.obj --elements 20000 --png picture.png --report figures.json");
  auto arguments = std::make_shared<SolveArguments>(command);
  command.run = [arguments] { return runSolve(arguments->request()); };
}

}  // namespace unshot
