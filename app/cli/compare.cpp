#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "cli/commands.h"
#include "cli/compare_files.h"
#include "cli/text.h"
#include "exit_codes.h"
#include "export/image_files.h"
#include "report/difference.h"

namespace unshot {
namespace {

struct CompareRequest {
  std::string a, b;
  std::optional<double> tolerance;
  std::string out;
};

std::string signedText(double value) { return (value > 0 ? "+" : "") + figureText(value); }

Lines linesOf(const CompareRequest& request, const ValuePairs& pairs, const Difference& d) {
  const std::string plural = pairs.points == "vertex" ? "vertices" : pairs.points + "s";
  std::string compared = countedText(d.points, pairs.points, plural);
  if (pairs.left_out > 0) compared += ", " + countText(pairs.left_out) + " left out";
  if (!pairs.note.empty()) compared += " (" + pairs.note + ")";
  Lines lines = {{"A", request.a},
                 {"B", request.b + " (the reference)"},
                 {"compared", compared},
                 {"nRMSE", percentText(d.nrmse) + " = RMS(A - B) / RMS(B) = " + figureText(d.rms) + " / " +
                               figureText(d.reference_rms)},
                 {"max |A - B|", figureText(d.max)},
                 {"mean |A - B|", figureText(d.mean)},
                 {"median |A - B|", figureText(d.median)},
                 {"worst 5 %", "|A - B| above " + figureText(d.worst_5)},
                 {"bias", signedText(d.bias) + " = mean(A - B)"}};
  if (d.reference_mean > 0)
    lines.back().second += ", " + signedText(100 * d.bias / d.reference_mean) + " % of mean(B)";
  return lines;
}

int runCompare(const CompareRequest& request) {
  if (!request.out.empty()) checkWritable(request.out);
  const ValuePairs pairs = readPairs(request.a, request.b);
  if (!request.out.empty() && !pairs.pictures) {
    throw Error(ErrorKind::kUsage, "--out makes a picture of the difference of two pictures", request.a,
                "two PNG or HDR files, or no --out");
  }
  const Difference difference = differenceOf(pairs.a, pairs.b);
  Lines lines = linesOf(request, pairs, difference);
  if (!request.out.empty()) {
    const HeatMap map = heatMapOf(pairs.pictures->first, pairs.pictures->second);
    writePng(request.out, map.image);
    lines.emplace_back("written", request.out);
    lines.emplace_back("scale", "dark blue 0, grey " + figureText(map.top / 2) + ", yellow " +
                                    figureText(map.top) + " and above (RMS over channels, linear)");
  }
  printLines(std::cout, lines);
  if (!request.tolerance || difference.nrmse <= *request.tolerance) return kExitDone;
  std::cout.flush();
  std::cerr << "unshot: the nRMSE of " << percentText(difference.nrmse) << " is above the tolerance of "
            << percentText(*request.tolerance) << std::endl;
  return kExitDifferent;
}

}  // namespace

void setUpCompare(Command& command) {
  auto request = std::make_shared<CompareRequest>();
  command.footer(
      "Values are compared as linear light; nRMSE is RMS(A - B) / RMS(B) over points and channels.\n"
      "Pictures must have the same size, PLY files the same vertices, tables the same points in\n"
      "the same order. Where a table has columns E_r, E_g, E_b, only points with E = 0 count.\n"
      "Ends with 6 where the nRMSE is above --tolerance.");
  command.argument("A", request->a, "The file to judge");
  command.argument("B", request->b, "The reference");
  command.add("--tolerance", request->tolerance, "X", "Largest nRMSE allowed, as a fraction: 0.05 is 5 %",
              numberWithin(0, std::numeric_limits<double>::max()));
  command.add("--out", request->out, "F.png", "Write a heat map of |A - B| (pictures only)", fileName());
  command.run = [request] { return runCompare(*request); };
}

}  // namespace unshot
