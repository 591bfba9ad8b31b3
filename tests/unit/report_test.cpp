#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/difference.h"
#include "report/report_json.h"

namespace unshot {
namespace {

using V = std::vector<glm::dvec3>;

TEST(Difference, FiguresOfAKnownCase) {
  const V b = {{1, 1, 1}, {2, 2, 2}}, a = {{1, 1, 1}, {2, 2, 5}};
  const Difference d = differenceOf(a, b);
  EXPECT_EQ(d.points, 2u);
  EXPECT_DOUBLE_EQ(d.rms, std::sqrt(9.0 / 6));
  EXPECT_DOUBLE_EQ(d.reference_rms, std::sqrt(15.0 / 6));
  EXPECT_DOUBLE_EQ(d.nrmse, std::sqrt(9.0 / 15));
  EXPECT_DOUBLE_EQ(d.max, 3);
  EXPECT_DOUBLE_EQ(d.mean, 0.5);
  EXPECT_DOUBLE_EQ(d.bias, 0.5);
  EXPECT_DOUBLE_EQ(d.reference_mean, 1.5);
}

TEST(Difference, BIsTheReference) {
  const V one = {{1, 1, 1}}, two = {{2, 2, 2}};
  EXPECT_DOUBLE_EQ(differenceOf(two, one).nrmse, 1);
  EXPECT_DOUBLE_EQ(differenceOf(one, two).nrmse, 0.5);
  EXPECT_LT(differenceOf(one, two).bias, 0);
}

TEST(Difference, BlackAndEmpty) {
  const V black = {{0, 0, 0}}, one = {{1, 0, 0}};
  EXPECT_EQ(differenceOf(black, black).nrmse, 0);
  EXPECT_EQ(differenceOf(one, black).nrmse, std::numeric_limits<double>::infinity());
  EXPECT_EQ(differenceOf({}, {}).nrmse, 0);
}

TEST(Difference, QuantilesOverPoints) {
  V a, b;
  for (int k = 0; k < 101; ++k) {
    a.emplace_back(k, k, k);
    b.emplace_back(0.0);
  }
  EXPECT_DOUBLE_EQ(differenceOf(a, b).median, 50);
  EXPECT_DOUBLE_EQ(differenceOf(a, b).worst_5, 95);
}

/// Relative luminance of an sRGB colour, roughly what the eye takes for lightness.
double lightness(const glm::dvec3& c) {
  return 0.2126 * std::pow(c.x, 2.2) + 0.7152 * std::pow(c.y, 2.2) + 0.0722 * std::pow(c.z, 2.2);
}

TEST(HeatMap, GetsLighterAllTheWay) {
  for (double t = 0.01; t <= 1.001; t += 0.01)
    EXPECT_GT(lightness(heatColour(t)), lightness(heatColour(t - 0.01))) << t;
}

TEST(HeatMap, ShowsWhereAndHowMuch) {
  const ImageF b{2, 1, {0, 0, 0, 0, 0, 0}}, a{2, 1, {0, 0, 0, 3, 3, 3}};
  const HeatMap map = heatMapOf(a, b);
  EXPECT_EQ(map.image.width, 2);
  EXPECT_DOUBLE_EQ(map.top, 3);
  EXPECT_LT(map.image.rgb[0], map.image.rgb[3]);
  EXPECT_EQ(heatMapOf(b, b).top, 0);
}

RunRecord someRecord() {
  RunRecord record;
  record.scene_path = "scene.obj";
  record.scene_name = std::string("caf\xe9");  // Latin 1
  record.scene.faces = 6;
  record.diagnostics = {{Severity::kWarning, "code", "message", "scene.obj:3", "advice"}};
  record.plan = {{"dark-sides", "what", "why", "saving"}};
  record.mode = "southwell";
  record.form_factors = "hemicube";
  record.counts = {1, 2, 3, 4, 5, 6, 7};
  record.seconds = {0.1, 0.2, 0.3, 0.4, 0.5};
  record.energy.emitted = 10;
  record.energy.absorbed = 9;
  record.energy.escaped = std::numeric_limits<double>::quiet_NaN();
  record.stopped_by = "solver_upper";
  record.history.resize(2);
  record.history[1].measures.unshot_fraction = 0.25;
  return record;
}

TEST(ReportJson, HasTheFieldsOfTheDesign) {
  const nlohmann::json json = nlohmann::json::parse(reportJson(someRecord()));
  for (const char* field : {"scene", "plan", "mode", "form_factors", "gl", "counts", "seconds", "errors",
                            "energy", "peak_memory_bytes", "stopped_by", "history", "unshot_fraction"}) {
    EXPECT_TRUE(json.contains(field)) << field;
  }
  for (const char* field : {"surfaces", "patches", "elements", "vertices", "rows", "shots"}) {
    EXPECT_TRUE(json["counts"].contains(field)) << field;
  }
  for (const char* field : {"load", "mesh", "plan", "solve", "cpu_solve"}) {
    EXPECT_TRUE(json["seconds"].contains(field)) << field;
  }
  for (const char* field : {"solver_lower", "solver_upper", "form_factor", "discretisation"}) {
    EXPECT_TRUE(json["errors"].contains(field)) << field;
  }
  EXPECT_TRUE(json["errors"]["solver_upper"].is_null());  // no bound is no number
  for (const char* field : {"seconds", "rows", "shots", "unshot", "bounds"}) {
    EXPECT_TRUE(json["history"][1].contains(field)) << field;
  }
  EXPECT_EQ(json["counts"]["elements"], 3);
  EXPECT_EQ(json["history"][1]["unshot"], 0.25);
  EXPECT_TRUE(json["gl"].is_null());
}

TEST(ReportJson, SurvivesBadNumbersAndBadText) {
  const nlohmann::json json = nlohmann::json::parse(reportJson(someRecord()));
  EXPECT_TRUE(json["energy"]["escaped"].is_null());
  EXPECT_FALSE(json["scene"]["name"].get<std::string>().empty());
}

TEST(ReportJson, NamesTheRenderer) {
  RunRecord record = someRecord();
  record.gl = GlRecord{"osmesa", "llvmpipe", "Mesa", "4.5", false};
  const nlohmann::json json = nlohmann::json::parse(reportJson(record));
  EXPECT_EQ(json["gl"]["renderer"], "llvmpipe");
}

/// A unit cube of six squares, or without its lid.
Scene cube(bool lid) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].emission = glm::dvec3(1.0);
  for (int k = 0; k < 8; ++k) scene.positions.emplace_back(k & 1, k >> 1 & 1, k >> 2 & 1);
  scene.bounds_max = glm::dvec3(1.0);
  const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (std::uint32_t f = 0; f < (lid ? 6u : 5u); ++f) {
    Polygon polygon;
    polygon.first_corner = static_cast<std::uint32_t>(scene.corners.size());
    polygon.corner_count = 4;
    polygon.material = f == 1 ? 1 : 0;
    for (const std::uint32_t corner : faces[f]) scene.corners.push_back({corner, kNone});
    scene.polygons.push_back(polygon);
  }
  scene.face_count = scene.polygons.size();
  return scene;
}

TEST(SceneFigures, OfACube) {
  const SceneFigures figures = figuresOf(cube(true));
  EXPECT_EQ(figures.polygons, 6u);
  EXPECT_EQ(figures.materials, 2u);
  EXPECT_EQ(figures.emitters, 1u);
  EXPECT_DOUBLE_EQ(figures.area, 6);
  EXPECT_DOUBLE_EQ(figures.emitter_area, 1);
  EXPECT_TRUE(figures.closed());
}

TEST(SceneFigures, AMissingLidLeavesFourOpenEdges) {
  EXPECT_EQ(figuresOf(cube(false)).open_edges, 4u);
  EXPECT_FALSE(figuresOf(cube(false)).closed());
  EXPECT_FALSE(figuresOf(Scene{}).closed());
}

TEST(SceneFigures, CornersAtTheSamePlaceAreOne) {
  Scene scene = cube(true);
  // Every polygon with positions of its own.
  const std::vector<glm::dvec3> shared = scene.positions;
  scene.positions.clear();
  for (Corner& corner : scene.corners) {
    scene.positions.push_back(shared[corner.position]);
    corner.position = static_cast<std::uint32_t>(scene.positions.size() - 1);
  }
  EXPECT_TRUE(figuresOf(scene).closed());
}

}  // namespace
}  // namespace unshot
