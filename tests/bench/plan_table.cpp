#include "bench/plan_table.h"

#include <nlohmann/json.hpp>
#include <string>

#include "bench/text_table.h"
#include "support/run_program.h"

namespace unshot::bench {
namespace {

using testing_support::TempFolder;

struct Outcome {
  double cpu = 0, memory = 0;
  int elements = 0;
  bool stopped_by_time = false;
  std::vector<std::string> keys;  // of decisions that were taken
  std::string error;              // the estimate of the whole
};

/// `done`: options that switch decisions off.
Outcome outcomeOf(const std::filesystem::path& scene, double seconds, const std::vector<std::string>& done) {
  const TempFolder work;
  std::vector<std::string> arguments{"solve",         std::filesystem::absolute(scene).string(),
                                     "--emit",        "front",
                                     "--report",      work / "report.json",
                                     "--max-seconds", figure("%g", seconds)};
  arguments.insert(arguments.end(), done.begin(), done.end());
  testing_support::runProgram(work, arguments);
  const auto report = nlohmann::json::parse(work.read("report.json"));
  Outcome out;
  out.cpu = report["seconds"]["cpu_solve"];
  out.memory = report["peak_memory_bytes"];
  out.elements = report["counts"]["elements"];
  out.stopped_by_time = report["stopped_by"] == "max_seconds";
  for (const auto& decision : report["plan"]) out.keys.push_back(decision["key"]);
  const auto& total = report["errors"]["total"];
  out.error = total.is_number() ? figure("%.2g %%", 100 * total.get<double>()) : "-";
  return out;
}

}  // namespace

void printPlanTable(const std::vector<std::filesystem::path>& scenes, double seconds) {
  std::printf("unshot solve --emit front --max-seconds %g, and with --do KEY or --do-all\n\n", seconds);
  TextTable table({"scene", "done all the same", "elements", "CPU s", "ratio", "peak MB", "error"});
  for (const std::filesystem::path& scene : scenes) {
    const Outcome lean = outcomeOf(scene, seconds, {});
    const auto add = [&](const std::string& what, const Outcome& o) {
      table.add({scene.stem().string(), what, std::to_string(o.elements),
                 (o.stopped_by_time ? "> " : "") + figure("%.3f", o.cpu), figure("%.2f", o.cpu / lean.cpu),
                 figure("%.0f", o.memory / 1e6), o.error});
    };
    add("nothing", lean);
    for (const std::string& key : lean.keys) add(key, outcomeOf(scene, seconds, {"--do", key}));
    add("everything", outcomeOf(scene, seconds, {"--do-all"}));
  }
  table.print();
}

}  // namespace unshot::bench
