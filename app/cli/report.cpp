#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/atomic_file.h"
#include "cli/commands.h"
#include "cli/gnuplot.h"
#include "cli/progress.h"
#include "cli/report_scene.h"
#include "cli/text.h"
#include "exit_codes.h"

namespace unshot {
namespace {

constexpr std::size_t kLongestFolder = 80;

/// A folder's name from a scene's: letters, digits, - _ . alone, and unlike those in use.
std::string folderName(const std::filesystem::path& scene, std::set<std::string>& used) {
  std::string name;
  for (const char c : scene.stem().string().substr(0, kLongestFolder)) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.';
    name += plain && !(c == '.' && name.empty()) ? c : '_';
  }
  if (name.empty()) name = "scene";
  std::string unique = name;
  for (int k = 2; !used.insert(unique).second; ++k) unique = name + "-" + std::to_string(k);
  return unique;
}

std::string padded(const std::string& text, std::size_t width, bool left = false) {
  const std::string blanks(width > text.size() ? width - text.size() : 0, ' ');
  return left ? text + blanks : blanks + text;
}

/// Time and rows to each level, a line per mode.
void printTable(std::ostream& out, const CurveRecord& record) {
  const ErrorMeasure error = mainMeasure(record);
  std::vector<std::vector<std::string>> lines(1);
  lines[0] = {"mode"};
  for (const char* cost : {"s to ", "rows to "}) {
    for (const double level : kErrorLevels)
      lines[0].push_back((level == kErrorLevels[0] ? cost : "") + percentText(level));
  }
  lines[0].emplace_back("memory");
  for (const ModeCurve& curve : record.curves) {
    if (curve.points.empty()) continue;
    lines.push_back({curve.mode});
    for (const PointQuantity& cost : {PointQuantity(busySecondsOf), PointQuantity(rowsOf)}) {
      const bool rows = lines.back().size() > 1;
      for (const double level : kErrorLevels) {
        const auto value = costToReach(curve.points, level, error.of, cost);
        lines.back().push_back(!value ? "-"
                               : rows ? countText(static_cast<std::uint64_t>(std::llround(*value)))
                                      : figureText(*value));
      }
    }
    lines.back().push_back(memoryText(static_cast<double>(curve.memoryBytes())));
  }
  out << record.scene_name << ": " << error.title << ", busy seconds and form-factor rows"
      << (record.hasExact() ? "; exact solution by " + record.exact.mode : "") << "\n";
  for (const auto& line : lines) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      std::size_t width = 0;
      for (const auto& other : lines) width = std::max(width, other[k].size());
      out << (k == 0 ? "  " : "  ") << padded(line[k], width, k == 0);
    }
    out << "\n";
  }
  out << std::endl;
}

class Report {
 public:
  explicit Report(const ReportRequest& request) : request_(request), draw_(hasGnuplot()), progress_(0) {}

  int run() {
    useShaderDir(request_.shader_dir);
    prepareFolder();
    if (!draw_) {
      std::cerr << "unshot: note: gnuplot is not installed; data and scripts are written, and the plots left "
                   "out\n  try: apt-get install gnuplot-nox, then gnuplot NAME.gp in the folder of a scene"
                << std::endl;
    }
    std::set<std::string> folders;
    for (std::size_t k = 0; k < request_.scenes.size() && !interrupted_.raised(); ++k)
      reportScene(k, folderName(request_.scenes[k], folders));
    progress_.finish();
    if (interrupted_.raised()) {
      std::cerr << "unshot: interrupted; "
                << (scenes_.empty() ? "there is nothing to write yet" : "what was done by then is written")
                << std::endl;
      return kExitInterrupted;
    }
    return code_;
  }

 private:
  void prepareFolder() const {
    std::error_code error;
    std::filesystem::create_directories(request_.out, error);
    if (error || !std::filesystem::is_directory(request_.out)) {
      throw Error(ErrorKind::kEnvironment,
                  "the folder cannot be made: " + (error ? error.message() : "there is a file of that name"),
                  request_.out.string(), "another --out");
    }
    checkWritable(request_.out / "index.html");
  }

  void fail(const Error& error) {
    progress_.finish();
    std::cerr << "unshot: " << error.fullText() << std::endl;
    failed(error.kind());
  }

  void failed(ErrorKind kind) {
    if (code_ == kExitDone) code_ = exitCodeOf(kind);
  }

  void reportScene(std::size_t k, const std::string& folder) {
    const std::filesystem::path& path = request_.scenes[k];
    const double n = static_cast<double>(request_.scenes.size());
    const SceneProgress progress = [&](double done, const std::string& what) {
      progress_.update((static_cast<double>(k) + done) / n, folder + ": " + what);
    };
    try {
      MeasuredScene scene = measureScene(request_, path, folder, interrupted_, progress);
      progress_.finish();
      if (scene.failure) failed(scene.failure->kind());
      if (scene.record.curves.empty()) return;
      printTable(std::cout, scene.record);
      scenes_.push_back(std::make_unique<MeasuredScene>(std::move(scene)));
      requireCurves(scenes_.back()->record);
      writeScene(request_, *scenes_.back(), draw_);
    } catch (const Error& error) {
      fail(error);
    } catch (const Cancelled&) {
      return;
    } catch (const std::bad_alloc&) {
      fail(Error(ErrorKind::kEnvironment, "out of memory", path.string(), "a coarser mesh (--elements)"));
    }
    writePage();
  }

  static void requireCurves(const CurveRecord& record) {
    const bool any = std::any_of(record.curves.begin(), record.curves.end(),
                                 [](const ModeCurve& curve) { return !curve.points.empty(); });
    if (any || record.interrupted) return;
    throw Error(ErrorKind::kEnvironment, "none of the modes asked for can solve this scene",
                record.scene_path.string(), "other --modes, or fewer --elements");
  }

  /// After every scene: what is done stays whatever comes.
  void writePage() {
    if (scenes_.empty()) return;
    try {
      std::vector<PageScene> pages;
      for (const auto& scene : scenes_)
        pages.push_back({&scene->record, scene->svg, scene->pictures.solution, scene->pictures.tables});
      writeWholeFile(request_.out / "index.html", pageHtml(pages, {machineText(), commandText()}));
    } catch (const Error& error) {
      fail(error);
    }
  }

  std::string commandText() const {
    std::string text = "unshot report";
    for (const auto& scene : scenes_) text += " " + scene->record.scene_path.filename().string();
    return text + " --error " + figureText(request_.options.error) + " --repeats " +
           std::to_string(request_.repeats) + (request_.reference ? " --reference" : "");
  }

  std::string machineText() const {
    std::string text = countedText(std::max(1u, std::thread::hardware_concurrency()), "processor core");
    for (const auto& scene : scenes_) {
      const std::optional<GlRecord>& gl = scene->record.gl;
      if (gl) return text + ", OpenGL by " + gl->renderer + (gl->hardware ? "" : " (software)");
    }
    return text;
  }

  const ReportRequest& request_;
  InterruptFlag interrupted_;
  bool draw_;
  Progress progress_;
  std::vector<std::unique_ptr<MeasuredScene>> scenes_;
  int code_ = kExitDone;
};

}  // namespace

void setUpReport(Command& command) {
  command.footer(
      "DIR gets index.html, a page that stands for itself, and for every scene a folder with curves.csv,\n"
      "table.csv, report.json and the plots (SVG and PNG) with their gnuplot scripts. Errors are measured\n"
      "against the exact solution of the same discrete system, and with --reference against the truth.\n"
      "Ctrl-C ends the run under way and writes what was done.\n"
      "\n"
      "Example: unshot report assets --out report --modes southwell,jacobi,gmres");
  auto arguments = std::make_shared<ReportArguments>(command);
  command.run = [arguments] {
    const ReportRequest request = arguments->request();
    return Report(request).run();
  };
}

}  // namespace unshot
