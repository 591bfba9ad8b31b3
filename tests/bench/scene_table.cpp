#include "bench/scene_table.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/csv_table.h"
#include "bench/text_table.h"
#include "support/run_program.h"
#include "support/truth.h"

namespace unshot::bench {
namespace {

namespace fs = std::filesystem;
using testing_support::TempFolder;

// The word after `key` in the comments of a file of reference values; empty where there is none.
std::string commentValue(const fs::path& file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line) && line.starts_with("#");) {
    const std::size_t at = line.find(key + "=");
    if (at == std::string::npos) continue;
    const std::size_t start = at + key.size() + 1;
    return line.substr(start, line.find_first_of(" ;", start) - start);
  }
  return {};
}

struct Job {
  fs::path scene;
  std::string name, emit = "both";
  fs::path truth;  // may be empty
};

std::vector<fs::path> filesOf(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> out;
  if (!fs::is_directory(folder)) return out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == extension) out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

// One job per scene and one more per further reference of it (other sides emit).
std::vector<Job> jobsOf(const fs::path& folder) {
  std::vector<Job> out;
  const std::vector<fs::path> references = filesOf(folder / "truth", ".csv");
  for (const fs::path& scene : filesOf(folder, ".obj")) {
    const std::string name = fs::relative(scene, folder).replace_extension().string();
    bool referred = false;
    for (const fs::path& truth : references) {
      if (commentValue(truth, "bounces") != "-1" || folder / commentValue(truth, "scene") != scene) continue;
      const std::string emit = commentValue(truth, "emit");
      out.push_back({scene, emit == "front" ? name + " (front emits)" : name,
                     emit == "front" ? "front" : "both", truth});
      referred = true;
    }
    if (!referred) out.push_back({scene, name, "both", {}});
  }
  return out;
}

std::string errorOf(const Job& job, const fs::path& answers) {
  if (job.truth.empty() || !fs::exists(answers)) return "-";
  const testing_support::Truth truth = readReferencePoints(job.truth);
  const CsvTable table = readCsv(answers);
  std::vector<std::optional<glm::dvec3>> values;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto r = table.number(row, 6), g = table.number(row, 7), b = table.number(row, 8);
    values.push_back(r && g && b ? std::optional(glm::dvec3(*r, *g, *b)) : std::nullopt);
  }
  if (values.size() != truth.size()) return "?";
  return figure("%.1f %%", 100 * testing_support::reflectedError(truth, values));
}

}  // namespace

void printSceneTable(const std::vector<fs::path>& folders, double seconds) {
  std::printf("unshot solve --max-seconds %g, a process for each scene\n", seconds);
  std::printf("(nRMSE of reflected light where there are reference values.)\n\n");
  TextTable table({"scene", "triangles", "elements", "mesh s", "solve s", "CPU s", "shots", "unshot", "nRMSE",
                   "peak MB"});
  for (const fs::path& folder : folders) {
    for (const Job& job : jobsOf(folder)) {
      const TempFolder work;
      std::vector<std::string> arguments{"solve",         fs::absolute(job.scene).string(),
                                         "--emit",        job.emit,
                                         "--report",      work / "report.json",
                                         "--max-seconds", figure("%g", seconds)};
      if (!job.truth.empty()) {
        for (const std::string& word : {std::string("--probe"), fs::absolute(job.truth).string(),
                                        std::string("--probe-out"), work / "answers.csv"}) {
          arguments.push_back(word);
        }
      }
      const auto result = testing_support::runProgram(work, arguments);
      const auto report = nlohmann::json::parse(work.read("report.json"), nullptr, false);
      if (report.is_discarded()) {
        table.add(
            {job.name, "-", "-", "-", "-", "-", "-", "failed with " + std::to_string(result.code), "-", "-"});
        continue;
      }
      const auto& times = report["seconds"];
      table.add({job.name, std::to_string(report["scene"]["triangles"].get<int>()),
                 std::to_string(report["counts"]["elements"].get<int>()),
                 figure("%.2f", times["mesh"].get<double>()), figure("%.2f", times["solve"].get<double>()),
                 figure("%.2f", times["cpu_solve"].get<double>()),
                 std::to_string(report["counts"]["shots"].get<int>()),
                 figure("%.4f", report["unshot_fraction"].get<double>()), errorOf(job, work / "answers.csv"),
                 figure("%.0f", report["peak_memory_bytes"].get<double>() / 1e6)});
    }
  }
  table.print();
}

}  // namespace unshot::bench
