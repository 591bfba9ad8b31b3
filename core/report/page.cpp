#include "report/page.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "base/text.h"

namespace unshot {
namespace {

constexpr const char* kStyle = R"(
:root { --ink: #1c1c1c; --faint: #5a5a5a; --line: #d8d8d8; --best: #e3f1e6; }
* { box-sizing: border-box; }
body { font: 17px/1.5 "Segoe UI", Roboto, Helvetica, Arial, sans-serif; color: var(--ink); background: #fff;
  max-width: 1080px; margin: 0 auto; padding: 24px; }
h1 { font-size: 34px; line-height: 1.2; margin: 0 0 8px; }
h2 { font-size: 27px; margin: 56px 0 8px; padding-top: 16px; border-top: 3px solid var(--ink); }
h3 { font-size: 20px; margin: 32px 0 6px; }
p, li { max-width: 78ch; } .faint, figcaption, .note { color: var(--faint); font-size: 15px; }
nav a { margin-right: 14px; } figure { margin: 16px 0; } figure img { width: 100%; height: auto; }
.head { display: flex; gap: 24px; flex-wrap: wrap; align-items: flex-start; } .head > div { flex: 1 1 420px; }
.head figure { margin-left: 24px; } .head img { width: 400px; max-width: 100%; height: auto; border-radius: 4px; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; margin: 12px 0; font-variant-numeric: tabular-nums; }
th, td { padding: 5px 12px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th { font-weight: 600; } th:first-child, td:first-child { text-align: left; }
td.best { background: var(--best); font-weight: 700; } td.none { color: var(--faint); }
.group th { border-bottom: 0; text-align: center; color: var(--faint); font-weight: 500; }
.spread { color: var(--faint); font-size: 13px; }
.swatch { display: inline-block; width: 12px; height: 12px; border-radius: 2px; margin-right: 8px; }
.pictures th, .pictures td { border: 0; padding: 3px 5px; text-align: center; vertical-align: top; }
.pictures td:first-child { vertical-align: middle; } .pictures img { width: 200px; display: block; }
.pictures .faint { font-size: 13px; }
@media print { body { max-width: none; padding: 0; font-size: 12px; } h2 { break-before: page; }
  figure, table, tr { break-inside: avoid; } nav { display: none; } .pictures img { width: 130px; } }
)";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve(4 * (bytes.size() + 2) / 3);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8 | (k + i < bytes.size() ? static_cast<unsigned char>(bytes[k + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i)
      out += k + i > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * i) & 63];
  }
  return out;
}

std::string image(std::string_view type, std::string_view bytes, std::string_view alt) {
  return "<img alt=\"" + escaped(alt) + "\" src=\"data:image/" + std::string(type) + ";base64," +
         base64(bytes) + "\">";
}

std::string paragraph(const std::string& text, const char* style = nullptr) {
  return std::string("<p") + (style ? std::string(" class=\"") + style + "\"" : "") + ">" + escaped(text) +
         "</p>\n";
}

std::string modeName(const std::string& mode) {
  return "<span class=\"swatch\" style=\"background:" + std::string(modeColour(mode)) + "\"></span>" +
         escaped(mode);
}

/// One cell for each level; the least of a column, and those within 2 %, are marked.
struct CostCells {
  const CurveRecord& record;
  ErrorMeasure error;
  PointQuantity cost;
  std::string (*text)(double);
  bool spread;

  std::optional<double> of(const ModeCurve& curve, double level) const {
    return costToReach(curve.points, level, error.of, cost);
  }
  bool isBest(double value, double level) const {
    for (const ModeCurve& other : record.curves) {
      const auto there = of(other, level);
      if (there && value > 1.02 * *there) return false;
    }
    return true;
  }
  std::string html(const ModeCurve& curve) const {
    std::string out;
    for (const double level : kErrorLevels) {
      const auto value = of(curve, level);
      if (!value) {
        out += "<td class=\"none\">not reached</td>";
        continue;
      }
      out += std::string("<td") + (isBest(*value, level) ? " class=\"best\"" : "") + ">" + text(*value);
      if (spread && curve.runs.size() > 1) {
        const auto side = [&](double CurvePoint::*member) {
          return costToReach(curve.points, level, error.of,
                             [member](const CurvePoint& p) { return std::optional(p.*member); });
        };
        out += "<br><span class=\"spread\">" + text(*side(&CurvePoint::cpu_seconds_min)) + " to " +
               text(*side(&CurvePoint::cpu_seconds_max)) + "</span>";
      }
      out += "</td>";
    }
    return out;
  }
};

std::string costTable(const CurveRecord& record, const ErrorMeasure& error) {
  const CostCells seconds{record, error, busySecondsOf, durationText, true};
  const CostCells rows{record, error, rowsOf, roundedCountText, false};
  std::string levels;
  for (const double level : kErrorLevels) levels += "<th>" + percentText(level) + "</th>";
  std::string out = "<h3>Time and rows until the " + std::string(error.title) +
                    " is down to ...</h3>\n<div class=\"wide\"><table>\n<tr class=\"group\"><th></th>"
                    "<th colspan=\"4\">busy time</th><th colspan=\"4\">form-factor rows</th><th></th></tr>\n"
                    "<tr><th>mode</th>" +
                    levels + levels + "<th>memory</th></tr>\n";
  for (const ModeCurve& curve : record.curves) {
    if (curve.points.empty()) continue;
    out += "<tr><td>" + modeName(curve.mode) + "</td>" + seconds.html(curve) + rows.html(curve) + "<td>" +
           memoryText(static_cast<double>(curve.memoryBytes())) + "</td></tr>\n";
  }
  return out + "</table></div>\n";
}

std::string pictureTable(const PictureTable& table) {
  std::string out = "<h3>" + escaped(table.title) + "</h3>\n" + paragraph(table.text) +
                    "<div class=\"wide\"><table class=\"pictures\">\n<tr><th></th>";
  for (const std::string& column : table.columns) out += "<th>" + escaped(column) + "</th>";
  out += "</tr>\n";
  for (const PictureTable::Row& row : table.rows) {
    out += "<tr><td>" + modeName(row.mode) + "</td>";
    for (const PictureTable::Cell& cell : row.cells) {
      out += "<td>";
      if (!cell.png.empty()) out += image("png", cell.png, row.mode + ", " + cell.caption);
      out += "<span class=\"faint\">" + escaped(cell.caption) + "</span></td>";
    }
    out += "</tr>\n";
  }
  return out + "</table></div>\n";
}

std::string factsOf(const CurveRecord& r) {
  std::string text = countedText(r.scene.triangles, "triangle") + ", solved with " +
                     countedText(r.solve.elements, "element") + " and " +
                     countedText(r.solve.patches, "patch", "patches") +
                     "; form factors: " + r.solve.form_factors + ". ";
  if (r.hasExact()) {
    text += "The exact solution of this system, which the errors are measured against, was found by " +
            r.exact.mode + ". ";
  } else {
    text += "There is no exact solution to measure against (" + r.exact.why_not +
            "); in its place stands the bound that the program knows by itself. ";
  }
  if (r.reference) {
    text += "Path-traced truth: " + countedText(r.reference->points, "point") + ", its own error " +
            percentText(r.reference->noise) + " (of the median point " +
            percentText(r.reference->median_noise) + "). ";
  }
  std::size_t least = r.curves.empty() ? 0 : ~std::size_t{0};
  for (const ModeCurve& curve : r.curves) {
    if (!curve.points.empty()) least = std::min(least, curve.runs.size());
  }
  if (least != ~std::size_t{0} && least > 0) {
    text += "Times are " +
            (least > 1 ? "medians of " + countedText(least, "run") + " or more"
                       : std::string("of a single run for some modes or all")) +
            ". ";
  }
  return text;
}

std::string sceneHtml(const PageScene& scene) {
  const CurveRecord& r = *scene.record;
  std::string out = "<section id=\"" + escaped(r.folder) + "\">\n<h2>" + escaped(r.scene_name) +
                    "</h2>\n<div class=\"head\"><div>" + paragraph(factsOf(r)) + "<ul>\n";
  for (const std::string& sentence : whoWins(r)) out += "<li>" + escaped(sentence) + "</li>\n";
  out += "</ul>";
  for (const std::string& note : r.notes) out += paragraph(note, "note");
  if (r.interrupted) out += paragraph("The report was interrupted: what follows is what was done by then.");
  out += "</div>";
  if (!scene.picture.empty()) {
    out += "<figure>" + image("png", scene.picture, "the solution of " + r.scene_name) +
           "<figcaption>The solution</figcaption></figure>";
  }
  out += "</div>\n";
  for (const ErrorMeasure& error : measuresOf(r)) {
    if (error.key != "bound" || !r.hasExact()) out += costTable(r, error);
  }
  for (const CurvePlot& plot : plotsOf(r)) {
    const auto svg = scene.svg.find(plot.name);
    out += "<figure>";
    if (svg != scene.svg.end()) {
      out += image("svg+xml", svg->second, plot.title);
    } else {
      out += paragraph("The plot is not drawn: gnuplot is missing or failed. Its script: " + r.folder + "/" +
                           plot.name + ".gp",
                       "note");
    }
    out += "<figcaption>" + escaped(plot.caption) + "</figcaption></figure>\n";
  }
  for (const PictureTable& table : scene.pictures) out += pictureTable(table);
  return out +
         paragraph("Data: " + r.folder + "/curves.csv, " + (r.bounded.points.empty() ? "" : "bounds.csv, ") +
                       "table.csv, report.json",
                   "faint") +
         "</section>\n";
}

constexpr const char* kIntroduction = R"(<p>Radiosity finds out how much light every piece of wall sends on,
when light goes from wall to wall until it has died out. There are several ways of getting there, and all
arrive at the same picture. This page shows how soon.</p>
<h3>How to read it</h3>
<ul>
<li><b>The error</b> is that of the reflected light, as a share of all reflected light (root of the mean square
over area and colours). Lamps do not count: a picture that shows nothing but the bare lamps is 100 % wrong.
At 10 % the picture looks right at a glance, at 3 % side by side, and at 1 % no difference can be seen.</li>
<li><b>The solver error</b> is the distance to the exact solution on this mesh with these form factors: what
more iterations can still improve. <b>The total error</b>, where it is shown, is the distance to the truth.</li>
<li><b>Busy time</b> is computing time (CPU) since meshing began, with that of the form factors. A column of
form factors is computed once and its time charged to every mode that asks for it, so that all pay the same.</li>
<li><b>A row</b> is what one patch exchanges with all the others. Rows are what radiosity mostly pays for, and
counting them gives the same answer on any machine.</li>
</ul>
)";

}  // namespace

std::string pageHtml(std::span<const PageScene> scenes, const PageTexts& texts) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>Unshot: error against time</title>\n<style>" +
      std::string(kStyle) + "</style>\n</head>\n<body>\n<h1>How soon is the light right?</h1>\n" +
      kIntroduction;
  if (scenes.size() > 1) {
    out += "<nav>";
    for (const PageScene& scene : scenes) {
      out +=
          "<a href=\"#" + escaped(scene.record->folder) + "\">" + escaped(scene.record->scene_name) + "</a>";
    }
    out += "</nav>\n";
  }
  for (const PageScene& scene : scenes) out += sceneHtml(scene);
  return out + "<hr>\n" +
         paragraph(
             "Made by unshot " UNSHOT_VERSION ": " + texts.command + ". Measured on " + texts.machine + ".",
             "faint") +
         "</body>\n</html>\n";
}

}  // namespace unshot
