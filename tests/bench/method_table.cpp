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

struct Measured {
  double median = 0, first = 0;  // CPU [s]
  double error = 0;              // nRMSE of reflected light
  std::unique_ptr<Solve> solve;
};

Measured measure(const SolveOptions& options, int repeats, const Truth& truth, gl::Context& context) {
  Measured out;
  std::vector<double> seconds;
  for (int k = 0; k <= repeats; ++k) {
    out.solve.reset();
    const double began = cpuSeconds();
    out.solve = std::make_unique<Solve>(testing_support::publishedCornellBox(), options,
                                        [&]() -> gl::Context& { return context; });
    while (out.solve->state() == SolveState::kRunning) out.solve->step();
    (k == 0 ? out.first : seconds.emplace_back()) = cpuSeconds() - began;
  }
  std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
  out.median = seconds[static_cast<std::size_t>(repeats / 2)];
  out.error = testing_support::reflectedError(
      truth, answerProbes(out.solve->snapshot(), testing_support::probesOf(truth), false));
  return out;
}

void addRow(TextTable& table, const std::string& name, const Measured& m) {
  const Mesh& mesh = m.solve->mesh();
  table.add({name, std::to_string(mesh.element_count), std::to_string(mesh.vertices.size()),
             std::to_string(mesh.patch_count), figure("%.2f %%", 100 * m.error),
             figure("%.0f", 1e3 * m.median), figure("%.0f", 1e3 * m.first),
             figure("%.0f", static_cast<double>(m.solve->measures().rows) / m.median),
             figure("%.1f", static_cast<double>(m.solve->keptBytes()) / 1e6)});
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
  const int repeats = quick ? 1 : kRepeats;
  for (const FormFactorMethodRow& method : formFactorMethods()) {
    if (method.info.key == "closed-form") continue;  // the scene occludes
    for (const std::uint64_t elements : finenesses) {
      SolveOptions options;
      options.form_factors = method.info.key;
      options.elements = elements;
      options.error = kSolverError;
      addRow(table, std::string(method.info.key), measure(options, repeats, truth, *context));
    }
  }
  // The mesh follows the light, as fine as the error asked for.
  for (const double error :
       quick ? std::vector<double>{0.1} : std::vector<double>{0.1, 0.05, 0.02, 0.01, 0.005}) {
    SolveOptions options;
    options.form_factors = "rays";
    options.error = error;
    addRow(table, figure("rays, --error %g", error), measure(options, repeats, truth, *context));
  }
  table.print();
}

}  // namespace unshot::bench
