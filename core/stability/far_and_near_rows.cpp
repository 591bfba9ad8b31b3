// Light far from where it began and near to what it touches; and scenes with next to nothing in them.
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "scene/analytic_scenes.h"
#include "stability/stability_rows.h"
#include "stability/stability_scenes.h"

namespace unshot {
namespace {

// Form factors of equal rectangles: aligned, of a x b at distance c; and of unit squares.
double alignedFactor(double a, double b, double c) {
  const double x = a / c, y = b / c, x1 = std::sqrt(1 + x * x), y1 = std::sqrt(1 + y * y);
  return 2 / (std::numbers::pi * x * y) *
         (std::log(x1 * y1 / std::sqrt(1 + x * x + y * y)) + x * y1 * std::atan(x / y1) +
          y * x1 * std::atan(y / x1) - x * std::atan(x) - y * std::atan(y));
}
constexpr double kParallel = 0.199824895698, kPerpendicular = 0.200043776075;
// Of a point and a unit square at distance 1, over the point.
constexpr double kPointBelow = 0.239456470;

/// Of a corridor 100 times as long as wide, one of whose ends emits 1: B of its walls' first metre, of the
/// last, and of the far end. Solved apart like the cube (lit_cube_truth.h), with 2, 4 and 8 squares across,
/// and extrapolated: differences fall by 2.7 to 3.4 at each halving, and three digits stand. With two squares
/// across, about as many as the elements here, that solution is 8 % short at the far end, since a cell's mean
/// stands for light that falls off within it: hence the tolerance.
struct CorridorTruth {
  double reflectance, first, last, far;
};
constexpr CorridorTruth kCorridors[] = {{0.8, 0.4901, 1.844e-5, 5.059e-5}, {0.99, 3.779, 7.364e-4, 8.816e-4}};
constexpr double kCorridorTolerance = 0.15;

}  // namespace

void addFarAndNear(Cases& cases) {
  cases.push_back(
      {.key = "small-light",
       .title = "a light of a millionth of the area with E = 1e6, in a closed cube of reflectance 0.5",
       .expected = "mean irradiance 2; straight from the light, the floor's 1.437",
       .make = smallBrightLight,
       .options = evenMesh(1200, 1e-4),
       .measure = [](const Solve& s) {
         return std::vector<Figure>{
             {"mean irradiance", meanIrradiance(s, everySide()).x, 2, 0.01},
             {"direct, floor", meanDirectIrradiance(s, ofMaterial("floor")).x, 6 * kPointBelow, 0.01}};
       }});
  for (const CorridorTruth& t : kCorridors) {
    cases.push_back(
        {.key = "corridor-" + numberText(t.reflectance),
         .title = "a closed corridor 100:1 of reflectance " + numberText(t.reflectance) + ", lit at one end",
         .expected = "the far end's B is " + figureText(t.far) + ", the first metre's " + figureText(t.first),
         .make = [rho = t.reflectance] { return corridor(rho); },
         .options = evenMesh(1200, 1e-5),
         .measure =
             [t](const Solve& s) {
               std::vector<Figure> out;
               const auto part = [&](const char* name, double expected) {
                 out.push_back({std::string("B, ") + name, meanRadiosity(s, ofMaterial(name)).x, expected,
                                kCorridorTolerance});
               };
               part("first", t.first);
               part("last", t.last);
               part("far", t.far);
               return out;
             },
         .exceptions = {{"hemicube",
                         "few pixels look along a corridor, and what they miss adds up over its length", 3}},
         .slow = t.reflectance > 0.9});
  }
  // Two patches of one radiosity each: what leaves between them does so within 1e-4 of their edges.
  const double f = alignedFactor(1, 1, 1e-4), lit = 1 / (1 - 0.81 * f * f);
  cases.push_back({.key = "narrow-gap",
                   .title = "unit squares face to face at 1e-4, reflectance 0.9, one emits 1",
                   .expected = "B of both: " + figureText(lit) + ", " + figureText(0.9 * f * lit),
                   .make = narrowGap,
                   .options = evenMesh(400, 1e-5),
                   .measure = [=](const Solve& s) {
                     return std::vector<Figure>{
                         {"B, lit", meanRadiosity(s, ofMaterial("lit")).x, lit, 0.01},
                         {"B, other", meanRadiosity(s, ofMaterial("other")).x, 0.9 * f * lit, 0.01}};
                   }});
  cases.push_back({.key = "light-touches",
                   .title = "a light that touches a floor of reflectance 0.5 along an edge",
                   .expected = "mean B of the floor 0.1000",
                   .make = [] { return perpendicularSquares(0.5); },
                   .options = evenMesh(400, 1e-5),
                   .measure =
                       [](const Solve& s) {
                         return std::vector<Figure>{{"B, floor", meanRadiosity(s, ofMaterial("floor")).x,
                                                     0.5 * kPerpendicular, 0.01}};
                       }});
}

namespace {

Figure exactly(const Solve& s, const char* material, double expected) {
  return exactFigure(s, std::string("B, ") + material, ofMaterial(material), glm::dvec3(expected));
}

}  // namespace

void addEnds(Cases& cases) {
  cases.push_back({.key = "all-white",
                   .title = "closed cube of reflectance exactly 1, lit",
                   .expected = "no finite solution: it says so",
                   .make = [] { return litCube(glm::dvec3(1.0), glm::dvec3(1.0)); },
                   .options = evenMesh(96, 1e-3),
                   .no_solution = true});
  for (const bool solved : {false, true}) {
    SolveOptions options = evenMesh(600, 1e-5);
    options.emit_front_only = true;
    if (solved) options.do_anyway = {std::string(plan_keys::kDarkSides)};
    cases.push_back(
        {.key = solved ? "dark-island-solved" : "dark-island",
         .title = std::string("two closed cubes apart, one with a face lit, the other of reflectance 0.8 and "
                              "without light") +
                  (solved ? ", solved all the same" : ""),
         .expected = std::string("the lit one as by itself; the other ") +
                     (solved ? "exactly 0" : "without elements"),
         .make = litAndDarkIsland,
         .options = options,
         .measure = [solved, t = &litCubeTruth(0.5)](const Solve& s) {
           const auto& half = *t;
           std::vector<Figure> out;
           if (solved) out.push_back(exactly(s, "dark", 0));
           if (!solved) out.push_back({"sides, dark", sidesOf(s, ofMaterial("dark")), 0, 0});
           append(out, litCubeFigures(s, {&half, &half, &half}, glm::dvec3(1.0), 0.01));
           return out;
         }});
  }
  cases.push_back({.key = "all-black",
                   .title = "a block in a room, everything black, everything emits",
                   .expected = "B = E exactly",
                   .make = allBlack,
                   .options = evenMesh(300, 1e-3),
                   .measure = [](const Solve& s) {
                     return std::vector<Figure>{exactly(s, "room", 1), exactly(s, "block", 2)};
                   }});
  cases.push_back({.key = "emitters-only",
                   .title = "unit squares face to face, both emit (1 and 3), one reflects 0.5",
                   .expected = "B = 1 + 1.5 F of the one, 3 exactly of the other",
                   .make = emittersOnly,
                   .options = evenMesh(400, 1e-5),
                   .measure = [](const Solve& s) {
                     return std::vector<Figure>{
                         {"B - E, lower", meanRadiosity(s, ofMaterial("lower")).x - 1, 1.5 * kParallel, 0.01},
                         exactly(s, "upper", 3)};
                   }});
  cases.push_back({.key = "one-triangle",
                   .title = "one triangle that emits, and nothing else",
                   .expected = "B = E exactly",
                   .make = oneTriangle,
                   .options = evenMesh(100, 1e-3),
                   .measure = [](const Solve& s) { return std::vector<Figure>{exactly(s, "lit", 1)}; }});
  cases.push_back({.key = "flat-sheet",
                   .title = "nine squares in one plane, the middle one emits",
                   .expected = "B = E exactly, and exactly 0 beside it",
                   .make = flatSheet,
                   .options = evenMesh(200, 1e-3),
                   .measure = [](const Solve& s) {
                     return std::vector<Figure>{exactly(s, "lit", 1), exactly(s, "grey", 0)};
                   }});
}
}  // namespace unshot
