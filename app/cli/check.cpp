#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/remarks.h"
#include "cli/solver_arguments.h"
#include "cli/summary.h"
#include "cli/text.h"
#include "exit_codes.h"
#include "report/report_json.h"
#include "scene/obj_reader.h"
#include "session/preparation.h"
#include "session/scene_checks.h"

namespace unshot {
namespace {

constexpr std::size_t kLabelWidth = 11;

struct CheckRequest {
  std::string scene;
  std::string emit = "both";
  bool json = false;
};

std::string lightsText(const SceneFigures& figures) {
  if (figures.emitters == 0) return "none: everything stays black";
  return countedText(figures.emitters, "polygon") + " of " + figureText(figures.emitter_area) + " m^2";
}

/// The work ahead: how slowly light fades.
std::string bouncesText(const LightWalks& walks) {
  if (walks.largestRadius() < 0.01) return "hardly any light is reflected more than once";
  const std::string radius = "the spectral radius is about " + figureText(walks.largestRadius());
  const std::optional<double> bounces = walks.bouncesToOnePercent();
  if (!bounces) return radius + ": light does not fade";
  return radius + ": after " + countedText(static_cast<std::uint64_t>(*bounces), "bounce") +
         " 1 % of the light is left";
}

void printFigures(const Scene& scene, const CheckRecord& record, std::size_t width) {
  const SceneFigures figures = figuresOf(scene);
  Lines lines = {
      {"scene", scene.path.string()},
      {"faces", countText(figures.faces)},
      {"polygons", countText(figures.polygons)},
      {"triangles", countText(figures.triangles)},
      {"materials", countText(figures.materials) + " in use"},
      {"lights", lightsText(figures)},
      {"extent", extentText(figures.extent) + " m"},
      {"area", figureText(figures.area) + " m^2 (one side)"},
      {"closed", figures.closed() ? "yes: every edge joins an even number of polygons"
                                  : "not shown: " + countedText(figures.open_edges, "open edge") +
                                        (record.walks.escapes > 0
                                             ? ""
                                             : ", but none of " + countedText(record.walks.rays, "ray") +
                                                   " found a way out")},
      {"bounces", bouncesText(record.walks)}};
  for (const PlanDecision& decision : record.plan) lines.emplace_back("left out", planText(decision));
  std::string last;
  for (const auto& [label, value] : lines) {
    std::string first = label == last ? "" : label;
    first.resize(kLabelWidth, ' ');
    std::cout << wrapped(first, value, width);
    last = label;
  }
}

void printCheck(const Scene& scene, const CheckRecord& record) {
  const std::size_t width = outputWidth();
  printFigures(scene, record, width);
  if (record.diagnostics.empty()) {
    std::cout << "\nNothing is wrong with this scene.\n";
  } else {
    std::cout << "\n" << countedText(record.diagnostics.size(), "remark") << ":\n";
    printRemarks(std::cout, record.diagnostics, width);
  }
  std::string titles;
  for (const SceneCheckRow& row : sceneChecks()) {
    if (std::count(record.found_nothing.begin(), record.found_nothing.end(), row.info.key) > 0)
      titles += (titles.empty() ? "" : ", ") + std::string(row.info.title);
  }
  if (!titles.empty()) std::cout << "\n" << wrapped("looked for and not found: ", titles, width);
}

CheckRecord recordOf(const Scene& scene, const CheckRequest& request) {
  SolveOptions options;
  options.emit_front_only = request.emit == "front";
  options.soonest = true;  // as `unshot solve` would have it
  Preparation prepared = prepare(scene, options);
  const CancelToken never;
  CheckedScene checked(scene, *prepared.mesh, options.emit_front_only, never);
  CheckRecord record{std::move(prepared.diagnostics), std::move(prepared.plan), {}, {}};
  const Diagnostics more = checkScene(checked, CheckTime::kOnlyCheck);
  record.diagnostics.insert(record.diagnostics.end(), more.begin(), more.end());
  sortRemarks(record.diagnostics);
  record.walks = checked.walks();
  for (const SceneCheckRow& row : sceneChecks()) {
    const bool found = std::any_of(record.diagnostics.begin(), record.diagnostics.end(),
                                   [&](const Diagnostic& d) { return d.code == row.info.key; });
    if (!found) record.found_nothing.emplace_back(row.info.key);
  }
  return record;
}

int runCheck(const CheckRequest& request) {
  const Scene scene = readObj(request.scene);
  const CheckRecord record = recordOf(scene, request);
  if (request.json) {
    std::cout << checkJson(scene, record);
  } else {
    printCheck(scene, record);
  }
  return kExitDone;
}

}  // namespace

void setUpCheck(Command& command) {
  auto request = std::make_shared<CheckRequest>();
  command.footer("Ends with 0 where the scene can be read, whatever is remarked on.");
  command.argument("SCENE.obj", request->scene, "The scene: Wavefront OBJ with MTL");
  command.add("--emit", request->emit, "both|front", "Sides on which light sources emit (default both)",
              emitText());
  command.flag("--json", request->json, "Print JSON");
  command.run = [request] { return runCheck(*request); };
}

}  // namespace unshot
