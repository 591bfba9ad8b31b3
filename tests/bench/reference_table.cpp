#include "bench/reference_table.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "bench/text_table.h"
#include "report/reference.h"
#include "support/test_scenes.h"

namespace unshot::bench {
namespace {

namespace fs = std::filesystem;

std::vector<std::pair<std::string, Scene>> scenes() {
  std::vector<std::pair<std::string, Scene>> out;
  out.emplace_back("Cornell box, published", testing_support::publishedCornellBox());
  for (const double rho : {0.5, 0.9, 0.99}) {
    out.emplace_back("closed cube, one face lit, " + figure("%g", rho), cubeOneFaceLit(rho));
  }
  return out;
}

}  // namespace

void printReferenceTable(std::size_t points, double relative_error) {
  TextTable table(
      {"scene", "points", "noise", "median", "paths a point", "seconds", "CPU s", "paths a second"});
  for (const auto& [name, scene] : scenes()) {
    ReferenceOptions options;
    options.points = points;
    options.relative_error = relative_error;
    options.max_seconds = 120;
    const double cpu = cpuSeconds();
    const Reference reference = traceReference(scene, options);
    const double samples = static_cast<double>(reference.points[0].samples);
    table.add({name, std::to_string(reference.points.size()),
               figure("%.2f %%", 100 * noiseOf(reference.points)),
               figure("%.2f %%", 100 * medianNoiseOf(reference.points)), figure("%.0f", samples),
               figure("%.2f", reference.seconds), figure("%.2f", cpuSeconds() - cpu),
               figure("%.0f", samples * static_cast<double>(points) / reference.seconds)});
  }
  table.print();
}

}  // namespace unshot::bench
