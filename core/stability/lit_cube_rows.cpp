// Closed cubes: furnaces, evenly lit and from one face, channel by channel, at any brightness.
#include "scene/analytic_scenes.h"
#include "stability/stability_rows.h"
#include "stability/stability_scenes.h"

namespace unshot {

SolveOptions evenMesh(std::uint64_t elements, double error) {
  SolveOptions options;
  options.elements = elements;
  options.error = error;
  return options;
}

/// Faces of a lit cube, each channel on its own, for emission E in every channel.
std::vector<Figure> litCubeFigures(const Solve& solve, const std::array<const LitCubeTruth*, 3>& truth,
                                   const glm::dvec3& emission, double tolerance) {
  std::vector<Figure> out;
  const auto face = [&](const char* name, double LitCubeTruth::*member) {
    glm::dvec3 expected;
    for (int c = 0; c < 3; ++c) expected[c] = emission[c] * (truth[static_cast<std::size_t>(c)]->*member);
    append(out, meanFigures(solve, std::string(name) + " face", frontOf(name), expected, tolerance));
  };
  face("lit", &LitCubeTruth::lit);
  face("opposite", &LitCubeTruth::opposite);
  face("wall", &LitCubeTruth::side);
  return out;
}

namespace {

/// Tolerances say how much of the light a bounce may lose: 2 % at a reflectance of 0.9999 is two millionths.
/// Fewer elements at a reflectance that takes tens of thousands of sweeps: there light is so even that the
/// mesh has no part in the error.
struct Furnace {
  double reflectance, tolerance;
  std::uint64_t elements;
  double error;
  bool slow = false;
};

// Over single elements: counted pixels leave 1 %, most of it along the edges of the cube.
constexpr double kScatter = 0.02;
constexpr double kMostReflectance = 0.9999;
constexpr Furnace kFurnaces[] = {{0.5, 0.005, 294, 1e-5},
                                 {0.9, 0.005, 294, 1e-5},
                                 {0.99, 0.01, 150, 1e-4},
                                 {0.999, 0.01, 96, 1e-3, true},
                                 {kMostReflectance, 0.02, 54, 5e-3, true}};

}  // namespace

void addFurnaces(Cases& cases) {
  for (const Furnace& f : kFurnaces) {
    const double rho = f.reflectance, tolerance = f.tolerance;
    cases.push_back(
        {.key = "furnace-" + numberText(rho),
         .title = "closed cube, reflectance " + numberText(rho) + ", E = 1 on every wall",
         .expected = "B = 1 / (1 - rho) = " + numberText(1 / (1 - rho)),
         .make = [=] { return furnaceScene(rho, 1.0); },
         .options = evenMesh(f.elements, f.error),
         .measure =
             [=](const Solve& s) { return evenFigures(s, glm::dvec3(1 / (1 - rho)), tolerance, kScatter); },
         .slow = f.slow});
    cases.push_back({.key = "lit-face-" + numberText(rho),
                     .title = "closed cube, reflectance " + numberText(rho) + ", one face lit",
                     .expected = "B of the lit, the opposite and the other faces",
                     .make = [=] { return litCube(glm::dvec3(rho), glm::dvec3(1.0)); },
                     .options = evenMesh(f.elements, f.error),
                     .measure =
                         [=, t = &litCubeTruth(rho)](const Solve& s) {
                           return litCubeFigures(s, {t, t, t}, glm::dvec3(1.0), tolerance);
                         },
                     .slow = f.slow});
  }
}

void addChannels(Cases& cases) {
  const auto half = &litCubeTruth(0.5), nine = &litCubeTruth(0.9), most = &litCubeTruth(0.999);
  cases.push_back({.key = "one-channel",
                   .title = "closed cube, reflectance 0.9, one face lit in red alone",
                   .expected = "red as with all three; green and blue exactly 0",
                   .make =
                       [] {
                         return litCube(glm::dvec3(0.9), {1, 0, 0});
                       },
                   .options = evenMesh(300, 1e-5),
                   .measure =
                       [=](const Solve& s) {
                         return litCubeFigures(s, {nine, nine, nine}, {1, 0, 0}, 0.01);
                       }});
  cases.push_back({.key = "channels-apart",
                   .title = "closed cube of reflectance 0.5, 0.9, 0.999, one face lit",
                   .expected = "each channel as in a cube of its reflectance",
                   .make =
                       [] {
                         return litCube({0.5, 0.9, 0.999}, glm::dvec3(1.0));
                       },
                   .options = evenMesh(150, 1e-4),
                   .measure =
                       [=](const Solve& s) {
                         return litCubeFigures(s, {half, nine, most}, glm::dvec3(1.0), 0.01);
                       },
                   .slow = true});
  cases.push_back({.key = "channel-dark",
                   .title = "closed cube of reflectance 0.5, 0.9, 0.999, one face lit, not in blue",
                   .expected = "red and green as ever, blue exactly 0",
                   .make =
                       [] {
                         return litCube({0.5, 0.9, 0.999}, {1, 1, 0});
                       },
                   .options = evenMesh(300, 1e-5),
                   .measure =
                       [=](const Solve& s) {
                         return litCubeFigures(s, {half, nine, most}, {1, 1, 0}, 0.01);
                       }});
}

void addEmissions(Cases& cases) {
  const LitCubeTruth* half = &litCubeTruth(0.5);
  const struct {
    const char* key;
    glm::dvec3 emission;
  } emissions[] = {{"emission-1e-30", glm::dvec3(1e-30)},
                   {"emission-1e30", glm::dvec3(1e30)},
                   {"emission-apart", {1e-30, 1, 1e30}}};
  for (const auto& e : emissions) {
    const glm::dvec3 emission = e.emission;
    cases.push_back(
        {.key = e.key,
         .title = "closed cube, reflectance 0.5, one face lit with E = " + numberText(emission.x) +
                  (emission.x == emission.z ? "" : ", 1, " + numberText(emission.z)),
         .expected = "B / E as with E = 1",
         .make = [=] { return litCube(glm::dvec3(0.5), emission); },
         .options = evenMesh(294, 1e-5),
         .measure =
             [=](const Solve& s) {
               return litCubeFigures(s, {half, half, half}, emission, 0.01);
             }});
  }
}

}  // namespace unshot
