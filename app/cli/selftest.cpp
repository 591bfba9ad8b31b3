// `unshot selftest`: scenes with exact answers, solved on this machine and with its OpenGL.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/gl_context.h"
#include "cli/interrupt.h"
#include "cli/text.h"
#include "exit_codes.h"
#include "formfactor/methods.h"
#include "gl/context.h"
#include "solver/modes.h"
#include "stability/stability_run.h"

namespace unshot {
namespace {

struct SelftestRequest {
  std::string mode = "auto", form_factors = "auto", trial = "all", mesh = "even", gl = "auto";
  bool json = false;

  bool plain() const { return mode == "auto" && form_factors == "auto" && trial == "all" && mesh == "even"; }
};

/// One solve to be made.
struct Run {
  const StabilityCase* trial;
  std::string mode, form_factors;
  Fineness fineness = Fineness::kEven;
};

/// What every form-factor method goes through, and with it this machine's OpenGL, without being asked.
constexpr std::string_view kForEveryMethod[] = {"lit-face-0.9", "blocks", "door"};
/// And what goes through a mesh that follows the light.
constexpr std::string_view kOnLight[] = {"lit-face-0.9", "lit-face-0.9999", "all-white", "blocks", "door"};

bool isAmong(std::span<const std::string_view> keys, const StabilityCase& trial) {
  return std::find(keys.begin(), keys.end(), trial.key) != keys.end();
}

constexpr std::string_view kMeshes[] = {"even", "light", "all"};

template <class Row>
std::vector<std::string> keysAsked(std::span<const Row> table, const std::string& asked) {
  if (asked != "all") return {asked};
  std::vector<std::string> keys;
  for (const Row& row : table) keys.emplace_back(row.info.key);
  return keys;
}

std::vector<Run> runsOf(const SelftestRequest& request) {
  std::vector<Run> runs;
  for (const StabilityCase& trial : stabilityCases()) {
    if (request.trial != "all" && request.trial != trial.key) continue;
    for (const std::string& mode : keysAsked(iterationModes(), request.mode)) {
      for (const std::string& method : keysAsked(formFactorMethods(), request.form_factors)) {
        for (const Fineness fineness : {Fineness::kEven, Fineness::kLight}) {
          if (request.mesh == "all" || request.mesh == nameOf(fineness))
            runs.push_back({&trial, mode, method, fineness});
        }
      }
    }
  }
  if (!request.plain()) return runs;
  for (const StabilityCase& trial : stabilityCases()) {
    if (isAmong(kOnLight, trial)) runs.push_back({&trial, "auto", "auto", Fineness::kLight});
  }
  for (const FormFactorMethodRow& row : formFactorMethods()) {
    for (const StabilityCase& trial : stabilityCases()) {
      if (isAmong(kForEveryMethod, trial)) runs.push_back({&trial, "auto", std::string(row.info.key)});
    }
  }
  return runs;
}

/// The table's columns, as wide as what the tables of choices hold.
class Table {
 public:
  Table() {
    for (const StabilityCase& trial : stabilityCases()) widen(case_, trial.key);
    for (const IterationModeRow& row : iterationModes()) widen(mode_, row.info.key);
    for (const FormFactorMethodRow& row : formFactorMethods()) widen(method_, row.info.key);
  }

  void head() const {
    line({"case", "mesh", "mode", "form factors", "figure", "expected", "got", "error", "tolerance", "s",
          "verdict"});
  }
  void row(const StabilityResult& r) const {
    const Figure& f = r.figure;
    const bool measured = std::isfinite(f.got);
    line({r.case_key, std::string(nameOf(r.fineness)), r.mode, r.form_factors, f.what,
          !measured   ? "-"
          : f.at_most ? "<= " + shortText(f.expected)
                      : shortText(f.expected),
          measured ? shortText(f.got) : "-", measured && !f.at_most ? errorText(f.error()) : "-",
          !measured || f.at_most ? "-"
          : f.tolerance > 0      ? errorText(f.tolerance)
                                 : "exact",
          shortText(std::round(100 * r.seconds) / 100), std::string(nameOf(r.verdict))});
    if (!r.note.empty()) std::cout << "  " << r.note << "\n";
    std::cout.flush();
  }

 private:
  static void widen(int& width, std::string_view text) {
    width = std::max(width, static_cast<int>(text.size()));
  }
  static std::string shortText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return text;
  }
  static std::string errorText(double value) { return value == 0 ? "0" : percentText(value); }
  void line(const std::vector<std::string>& cells) const {
    const int widths[] = {case_, 5, mode_, method_, 23, 10, 10, 11, 9, 5};
    for (std::size_t k = 0; k < std::size(widths); ++k) {
      std::cout << (k < 5 ? std::left : std::right) << std::setw(widths[k]) << cells[k] << "  ";
    }
    std::cout << cells.back() << "\n";
  }

  int case_ = 4, mode_ = 4, method_ = 12;
};

nlohmann::ordered_json jsonOf(const StabilityResult& r) {
  const Figure& f = r.figure;
  const auto number = [&](double value) {
    return std::isfinite(f.got) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  };
  return {{"case", r.case_key},
          {"mesh", nameOf(r.fineness)},
          {"mode", r.mode},
          {"form_factors", r.form_factors},
          {"figure", f.what},
          {"expected", number(f.expected)},
          {"at_most", f.at_most},
          {"got", number(f.got)},
          {"error", number(f.error())},
          {"tolerance", number(f.tolerance)},
          {"seconds", r.seconds},
          {"verdict", nameOf(r.verdict)},
          {"note", r.note}};
}

/// "52 passed, 3 exceptions, 0 failed ..."
std::string summaryOf(const std::vector<StabilityResult>& results, const LazyContext& context) {
  const auto count = [&](Verdict verdict) {
    return static_cast<std::uint64_t>(
        std::count_if(results.begin(), results.end(), [&](const auto& r) { return r.verdict == verdict; }));
  };
  std::string text = countText(count(Verdict::kPass)) + " of " + countedText(results.size(), "solve") +
                     " within tolerance, " + countedText(count(Verdict::kException), "known exception") +
                     ", " + countText(count(Verdict::kRefused)) + " refused, " +
                     countText(count(Verdict::kFail)) + " failed";
  if (const auto gl = context.record())
    text += "; OpenGL by " + gl->renderer + (gl->hardware ? "" : " (software)");
  return text;
}

int runSelftest(const SelftestRequest& request) {
  const InterruptFlag interrupted;
  LazyContext context(request.gl);
  const Table table;
  std::vector<StabilityResult> results;
  if (!request.json) table.head();
  try {
    for (const Run& run : runsOf(request)) {
      results.push_back(runStability(
          *run.trial, run.mode, run.form_factors, [&]() -> gl::Context& { return context.get(); },
          run.fineness, interrupted.token()));
      if (!request.json) table.row(results.back());
    }
  } catch (const Cancelled&) {
  }
  if (request.json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const StabilityResult& result : results) rows.push_back(jsonOf(result));
    std::cout << nlohmann::ordered_json{{"results", rows}, {"summary", summaryOf(results, context)}}.dump(2)
              << "\n";
  } else {
    std::cout << "\n" << summaryOf(results, context) << "\n";
  }
  if (interrupted.raised()) {
    std::cout.flush();
    std::cerr << "unshot: interrupted; what was solved by then is above" << std::endl;
    return kExitInterrupted;
  }
  const bool failed = std::any_of(results.begin(), results.end(),
                                  [](const StabilityResult& r) { return r.verdict == Verdict::kFail; });
  return failed ? kExitDifferent : kExitDone;
}

std::string caseKeys() {
  std::string keys;
  for (const StabilityCase& trial : stabilityCases()) keys += (keys.empty() ? "" : ", ") + trial.key;
  return keys;
}

Check caseKey() {
  return [](const std::string& key) -> std::string {
    for (const StabilityCase& trial : stabilityCases()) {
      if (key == "all" || key == trial.key) return {};
    }
    return "there is no '" + key + "'; it is one of all, " + caseKeys();
  };
}

template <class Row>
Check keyOrAll(std::span<const Row> table) {
  return [table](const std::string& key) { return key == "all" ? std::string() : keyOf(table, true)(key); };
}

}  // namespace

void setUpSelftest(Command& command) {
  auto request = std::make_shared<SelftestRequest>();
  const auto modes = iterationModes();
  const auto methods = formFactorMethods();
  command.footer(
      "Solves scenes whose answer is known exactly, and prints for each the figure that is farthest\n"
      "into its tolerance. Without options: every case with the default mode and method, then a\n"
      "few on a mesh that follows the light and with every form-factor method, so that OpenGL is tried too. "
      "A mode or method that is\n"
      "known not to keep a tolerance is an exception, and the reason stands below its line;\n"
      "`refused` is what the program itself says is not for a scene.\n"
      "Ends with 6 where a case is outside its tolerance.\n\nCases: " +
      caseKeys());
  command.add("--case", request->trial, "KEY", "One case, or all (default)", caseKey());
  command.add("--mode", request->mode, "M", "Iteration: all, " + keysOf(modes, true) + " (default auto)",
              keyOrAll(modes));
  command.add("--form-factors", request->form_factors, "F",
              "Form factors: all, " + keysOf(methods, true) + " (default auto)", keyOrAll(methods));
  command.add("--mesh", request->mesh, "M",
              "even (default): as fine as a case asks for; light: one that follows the light, as without "
              "options; or all",
              [](const std::string& key) -> std::string {
                const bool known =
                    std::find(std::begin(kMeshes), std::end(kMeshes), key) != std::end(kMeshes);
                return known ? std::string() : "there is no '" + key + "'; it is one of even, light, all";
              });
  command.add("--gl", request->gl, "P", "Provider of OpenGL: " + keysOf(gl::providers(), true),
              keyOf(gl::providers(), true));
  command.flag("--json", request->json, "Print JSON");
  command.run = [request] { return runSelftest(*request); };
}

}  // namespace unshot
