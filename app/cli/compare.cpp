#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parse.h"
#include "cli/commands.h"
#include "cli/compare_files.h"
#include "cli/gl_context.h"
#include "cli/solution_picture.h"
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
  // Of the picture of two solutions.
  std::string gl = "auto", size, eye, at, up;
  std::optional<double> fov_deg;
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

PictureOptions pictureOf(const CompareRequest& request) {
  PictureOptions picture;
  if (!request.size.empty()) {
    const std::vector<std::string_view> parts = splitParts(request.size, 'x');
    picture.width = static_cast<int>(*parseNumber(parts[0]));
    picture.height = static_cast<int>(*parseNumber(parts[1]));
  }
  const auto vectorOf = [](const std::string& text) {
    return text.empty() ? std::nullopt : parseVector(text);
  };
  picture.eye = vectorOf(request.eye);
  picture.at = vectorOf(request.at);
  picture.up = vectorOf(request.up);
  picture.fov_deg = request.fov_deg;
  return picture;
}

/// Writes the picture of the difference, and says what its colours mean.
std::string writeDifference(const CompareRequest& request, const ValuePairs& pairs) {
  if (pairs.pictures) {
    const HeatMap map = heatMapOf(pairs.pictures->first, pairs.pictures->second);
    writePng(request.out, map.image);
    return "dark blue 0, grey " + figureText(map.top / 2) + ", yellow " + figureText(map.top) +
           " and above (RMS over channels, linear)";
  }
  LazyContext context(request.gl);
  const SolutionDifference picture =
      drawDifference(context.get(), pairs.solutions->first, pairs.solutions->second, pictureOf(request));
  writePng(request.out, picture.image);
  return "luminance of A - B, logarithmic: orange where A is brighter, blue where it is darker; dark below " +
         figureText(kLeastDifference * picture.full) + ", full colour at " + figureText(picture.full / 10) +
         ", pale from " + figureText(picture.full) + " on (the median of B over the surfaces)";
}

int runCompare(const CompareRequest& request) {
  if (!request.out.empty()) checkWritable(request.out);
  const ValuePairs pairs = readPairs(request.a, request.b);
  if (!request.out.empty() && !pairs.pictures && !pairs.solutions) {
    throw Error(ErrorKind::kUsage, "--out makes a picture of the difference of two pictures or solutions",
                request.a, "two PNG, HDR or PLY files, or no --out");
  }
  const Difference difference = differenceOf(pairs.a, pairs.b);
  Lines lines = linesOf(request, pairs, difference);
  if (!request.out.empty()) {
    const std::string scale = writeDifference(request, pairs);
    lines.emplace_back("written", request.out);
    lines.emplace_back("scale", scale);
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
      "the same order. A PLY file is also compared with a table, at the table's points. Where a\n"
      "table has columns E_r, E_g, E_b, only points with E = 0 count.\n"
      "Ends with 6 where the nRMSE is above --tolerance.");
  command.argument("A", request->a, "The file to judge");
  command.argument("B", request->b, "The reference");
  command.add("--tolerance", request->tolerance, "X", "Largest nRMSE allowed, as a fraction: 0.05 is 5 %",
              numberWithin(0, std::numeric_limits<double>::max()));
  command.add("--out", request->out, "F.png",
              "Write a picture of the difference: of pictures a heat map of |A - B|, of PLY solutions A - B "
              "in the scene",
              fileName());
  command.group("The picture of two PLY solutions");
  command.add("--size", request->size, "WxH", "Size in pixels (default 1280x960)", sizeText(kLargestPicture));
  command.add("--eye", request->eye, "x,y,z", "Where the viewer stands (default: chosen)", vectorText());
  command.add("--at", request->at, "x,y,z", "What the viewer looks at (default: chosen)", vectorText());
  command.add("--up", request->up, "x,y,z", "What is upwards (default 0,1,0)", vectorText());
  command.add("--fov", request->fov_deg, "D", "Vertical angle of view, 1 to 170 degrees (default: chosen)",
              numberWithin(1, 170, "degrees"));
  command.add("--gl", request->gl, "P", "Provider of OpenGL: " + keysOf(gl::providers(), true),
              keyOf(gl::providers(), true));
  command.run = [request] { return runCompare(*request); };
}

}  // namespace unshot
