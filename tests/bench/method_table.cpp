#include "bench/method_table.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/clock.h"
#include "bench/text_table.h"
#include "export/probes.h"
#include "formfactor/methods.h"
#include "gl/context.h"
#include "session/solve.h"
#include "support/test_scenes.h"
#include "support/truth.h"

namespace unshot::bench {
namespace {

using testing_support::Truth;

// Of solver error, beside which the rest stands.
constexpr double kSolverError = 0.003;
constexpr int kRepeats = 9;

void addRow(TextTable& table, const FormFactorMethodRow& method, std::uint64_t elements, int repeats,
            const Truth& truth, gl::Context& context) {
  SolveOptions options;
  options.form_factors = method.info.key;
  options.elements = elements;
  options.error = kSolverError;
  std::vector<double> seconds;
  double first = 0;
  std::unique_ptr<Solve> solve;
  for (int k = 0; k <= repeats; ++k) {
    solve.reset();
    const double began = cpuSeconds();
    solve = std::make_unique<Solve>(testing_support::publishedCornellBox(), options,
                                    [&]() -> gl::Context& { return context; });
    while (solve->state() == SolveState::kRunning) solve->step();
    (k == 0 ? first : seconds.emplace_back()) = cpuSeconds() - began;
  }
  std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
  const double error = testing_support::reflectedError(
      truth, answerProbes(solve->snapshot(), testing_support::probesOf(truth), false));
  const Mesh& mesh = solve->mesh();
  table.add({std::string(method.info.key), std::to_string(mesh.element_count),
             std::to_string(mesh.vertices.size()), std::to_string(mesh.patch_count),
             figure("%.2f %%", 100 * error), figure("%.0f", 1e3 * seconds[repeats / 2]),
             figure("%.0f", 1e3 * first),
             figure("%.0f", static_cast<double>(solve->measures().rows) / seconds[repeats / 2]),
             figure("%.1f", static_cast<double>(solve->keptBytes()) / 1e6)});
}

}  // namespace

void printMethodTable(bool quick) {
  const std::vector<std::uint64_t> finenesses =
      quick ? std::vector<std::uint64_t>{300}
            : std::vector<std::uint64_t>{300, 600, 1'200, 2'500, 5'000, 10'000};
  const Truth truth = readReferencePoints(UNSHOT_TEST_DATA "/cornell_published.csv");
  const std::unique_ptr<gl::Context> context = gl::createContext("osmesa");
  context->makeCurrent();
  TextTable table({"method", "elements", "vertices", "patches", "nRMSE", "CPU ms", "first time",
                   "columns a second", "kept MB"});
  for (const FormFactorMethodRow& method : formFactorMethods()) {
    if (method.info.key == "closed-form") continue;  // the scene occludes
    for (const std::uint64_t elements : finenesses)
      addRow(table, method, elements, quick ? 1 : kRepeats, truth, *context);
  }
  table.print();
}

}  // namespace unshot::bench
