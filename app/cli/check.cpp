#include <iostream>
#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/summary.h"
#include "cli/text.h"
#include "exit_codes.h"
#include "report/report_json.h"
#include "scene/obj_reader.h"
#include "session/plan.h"

namespace unshot {
namespace {

struct CheckRequest {
  std::string scene;
  bool json = false;
};

void printCheck(const Scene& scene, const Diagnostics& diagnostics, const std::vector<PlanDecision>& plan) {
  const SceneFigures figures = figuresOf(scene);
  std::string lights = "none: everything stays black";
  if (figures.emitters > 0) {
    lights = countedText(figures.emitters, "polygon") + " of " + figureText(figures.emitter_area) + " m^2";
  }
  Lines lines = {{"scene", scene.path.string()},
                 {"faces", countText(figures.faces)},
                 {"polygons", countText(figures.polygons)},
                 {"triangles", countText(figures.triangles)},
                 {"materials", countText(figures.materials) + " in use"},
                 {"lights", lights},
                 {"extent", extentText(figures.extent) + " m"},
                 {"area", figureText(figures.area) + " m^2 (one side)"},
                 {"closed", figures.closed() ? "yes: every edge joins an even number of polygons"
                                             : "not shown: " + countedText(figures.open_edges, "open edge")}};
  for (const PlanDecision& decision : plan) lines.emplace_back("left out", planText(decision));
  printLines(std::cout, lines);
  if (diagnostics.empty()) {
    std::cout << "\nNothing is wrong with this scene.\n";
    return;
  }
  std::cout << "\n" << countedText(diagnostics.size(), "remark") << ":\n";
  printDiagnostics(std::cout, diagnostics);
}

int runCheck(const CheckRequest& request) {
  const Scene scene = readObj(request.scene);
  const Preparation prepared = prepare(scene, SolveOptions{});
  if (request.json) {
    std::cout << checkJson(scene, prepared.diagnostics, prepared.plan);
  } else {
    printCheck(scene, prepared.diagnostics, prepared.plan);
  }
  return kExitDone;
}

}  // namespace

void setUpCheck(Command& command) {
  auto request = std::make_shared<CheckRequest>();
  command.footer("Ends with 0 where the scene can be read, whatever is remarked on.");
  command.argument("SCENE.obj", request->scene, "The scene: Wavefront OBJ with MTL");
  command.flag("--json", request->json, "Print JSON");
  command.run = [request] { return runCheck(*request); };
}

}  // namespace unshot
