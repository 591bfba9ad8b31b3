// Rooms divided in every way that lets light through a careless program: where none can come it is dark to
// the last bit, up to the dividing surface, and beside that surface it is as bright as it should be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "export/probes.h"
#include "support/solving.h"
#include "support/test_scenes.h"
#include "support/truth.h"

namespace unshot {
namespace {

using namespace testing_support;

constexpr double kWallAt = 1.03;  // off every line of a grid

struct Divided {
  const char* name;
  Scene (*make)();
  // Points and normals of the dark part at so small a distance from the divider, and of the lit part.
  std::vector<Probe> (*dark)(double);
  std::vector<Probe> (*lit)(double);
};

void PrintTo(const Divided& scene, std::ostream* out) { *out << scene.name; }

// A room of 2 x 1 x 1 of single faces, fronts inwards, with a lamp below the ceiling of its part x < 1.
SceneBuilder roomWithLamp(double overhang = 0) {
  SceneBuilder b;
  const auto wall = b.material("wall", glm::dvec3(0.7));
  const auto lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(5.0));
  const double o = overhang, l = 2 + 2 * o, h = 1 + 2 * o;
  b.quad(wall, {-o, 0, -o}, {0, 0, h}, {l, 0, 0});
  b.quad(wall, {-o, 1, -o}, {l, 0, 0}, {0, 0, h});
  b.quad(wall, {-o, -o, 0}, {l, 0, 0}, {0, h, 0});
  b.quad(wall, {-o, -o, 1}, {0, h, 0}, {l, 0, 0});
  b.quad(wall, {0, -o, -o}, {0, h, 0}, {0, 0, h});
  b.quad(wall, {2, -o, -o}, {0, 0, h}, {0, h, 0});
  b.quad(lamp, {0.4, 0.7, 0.4}, {0.2, 0, 0}, {0, 0, 0.2});
  return b;
}

// Floor, ceiling and both long walls at x.
std::vector<Probe> acrossAt(double x) {
  std::vector<Probe> out;
  for (const double t : {0.02, 0.3, 0.5, 0.77, 0.98}) {
    out.push_back({{x, 0, t}, {0, 1, 0}});
    out.push_back({{x, 1, t}, {0, -1, 0}});
    out.push_back({{x, t, 0}, {0, 0, 1}});
    out.push_back({{x, t, 1}, {0, 0, -1}});
  }
  return out;
}

// Floor, ceiling and walls run through under the single face.
Scene bySingleFace() {
  SceneBuilder b = roomWithLamp();
  b.quad(0, {kWallAt, 0, 0}, {0, 1, 0}, {0, 0, 1});
  return b.finish();
}

Scene byThinWall() {
  SceneBuilder b = roomWithLamp();
  b.quad(0, {kWallAt - 1e-3, 0, 0}, {0, 0, 1}, {0, 1, 0});
  b.quad(0, {kWallAt, 0, 0}, {0, 1, 0}, {0, 0, 1});
  return b.finish();
}

// Every wall, and the divider, goes on beyond those that it meets.
Scene byOverhangingFaces() {
  SceneBuilder b = roomWithLamp(0.1);
  b.quad(0, {kWallAt, -0.1, -0.1}, {0, 1.2, 0}, {0, 0, 1.2});
  return b.finish();
}

// A face that is not square to the others, and ends in the middle of them.
Scene bySlantedFace() {
  SceneBuilder b = roomWithLamp();
  b.quad(0, {kWallAt, -0.05, -0.05}, {0.3, 1.1, 0}, {0, 0, 1.1});
  return b.finish();
}

// A block without a bottom stands on the floor: it is dark below.
Scene byBlock() {
  SceneBuilder b = roomWithLamp();
  const glm::dvec3 a(1.13, 0, 0.32), u(0.4, 0, 0.1), w(-0.1, 0, 0.4), up(0, 0.3, 0);
  addBox(b, {0, 0, kNone, 0, 0, 0}, a, u, up, w, false);
  return b.finish();
}

std::vector<Probe> rightOfWall(double d) { return acrossAt(kWallAt + d); }
std::vector<Probe> leftOfWall(double d) { return acrossAt(kWallAt - d); }
std::vector<Probe> leftOfThinWall(double d) { return acrossAt(kWallAt - 1e-3 - d); }

// On floor and ceiling the slanted face stands elsewhere: 0.05 above its lower edge, and a room's height
// further.
std::vector<Probe> besideSlant(double d) {
  std::vector<Probe> out;
  const double low = kWallAt + 0.3 * 0.05 / 1.1, high = kWallAt + 0.3 * 1.05 / 1.1;
  for (const double t : {0.02, 0.3, 0.5, 0.77, 0.98}) {
    out.push_back({{low + d, 0, t}, {0, 1, 0}});
    out.push_back({{high + d, 1, t}, {0, -1, 0}});
    const double x = low + (high - low) * t;
    out.push_back({{x + d, t, 0}, {0, 0, 1}});
    out.push_back({{x + d, t, 1}, {0, 0, -1}});
  }
  return out;
}
std::vector<Probe> rightOfSlant(double d) { return besideSlant(d); }
std::vector<Probe> leftOfSlant(double d) { return besideSlant(-d); }

std::vector<Probe> besideBlock(double d) {
  const glm::dvec3 a(1.13, 0, 0.32), u(0.4, 0, 0.1), w(-0.1, 0, 0.4);
  const glm::dvec3 along = glm::normalize(u), inwards = glm::normalize(w);
  std::vector<Probe> out;
  for (const double t : {0.1, 0.35, 0.5, 0.65, 0.9}) {
    out.push_back({a + t * u + d * inwards, {0, 1, 0}});
    out.push_back({a + t * w + d * along, {0, 1, 0}});
    out.push_back({a + u + t * w - d * along, {0, 1, 0}});
    out.push_back({a + w + t * u - d * inwards, {0, 1, 0}});
  }
  return out;
}
std::vector<Probe> insideBlock(double d) { return besideBlock(std::min(d, 0.2)); }
std::vector<Probe> outsideBlock(double d) { return besideBlock(-std::min(d, 0.2)); }

const Divided kDivided[] = {
    {"SingleFace", bySingleFace, rightOfWall, leftOfWall},
    {"ThinWall", byThinWall, rightOfWall, leftOfThinWall},
    {"OverhangingFaces", byOverhangingFaces, rightOfWall, leftOfWall},
    {"SlantedFace", bySlantedFace, rightOfSlant, leftOfSlant},
    {"Block", byBlock, insideBlock, outsideBlock},
};

constexpr double kDistances[] = {1e-3, 4e-3, 0.016, 0.064, 0.25};

// Methods with elements all alike, and the mesh that follows the light.
std::vector<std::pair<std::string, SolveOptions>> solves() {
  std::vector<std::pair<std::string, SolveOptions>> out;
  for (const FormFactorMethodRow& row : occludingMethods())
    out.emplace_back(row.info.key, optionsOf(row.info.key, 1500, 0.02));
  SolveOptions follows;
  follows.form_factors = "rays";
  follows.error = 0.02;
  out.emplace_back("rays, following the light", follows);
  // What no light can reach is left out by proof: here transport has to show it.
  for (auto& [name, options] : out) options.do_anyway = {std::string(plan_keys::kDarkSides)};
  out.emplace_back("rays, following the light, without dark sides", follows);
  return out;
}

class Leaks : public testing::TestWithParam<Divided> {};

TEST_P(Leaks, NoLightWhereNoneCanCome) {
  for (const auto& [name, options] : solves()) {
    const Snapshot snapshot = solved(GetParam().make(), options)->snapshot();
    for (const double distance : kDistances) {
      SCOPED_TRACE(name + " at " + std::to_string(distance));
      const std::vector<Probe> dark = GetParam().dark(distance), lit = GetParam().lit(distance);
      std::size_t lit_in_the_dark = 0, dark_in_the_light = 0;
      for (const auto& b : answerProbes(snapshot, dark, false)) lit_in_the_dark += b && *b != glm::dvec3(0.0);
      for (const auto& b : answerProbes(snapshot, lit, false)) dark_in_the_light += !b || b->x <= 0;
      EXPECT_EQ(lit_in_the_dark, 0u) << "of " << dark.size();
      EXPECT_EQ(dark_in_the_light, 0u) << "of " << lit.size();
    }
  }
}

// Lines of points along each contact, nearer and nearer to it, against path tracing (whose own standard error
// is 1 % of a point).
TEST_P(Leaks, NoFringeAlongContacts) {
  const Scene scene = GetParam().make();
  ReferenceOptions tracing;
  tracing.relative_error = 0;
  tracing.max_samples = 4096;
  std::vector<Truth> truths;
  for (const double distance : kDistances) {
    tracing.places.clear();
    for (const Probe& p : GetParam().lit(distance)) tracing.places.push_back({p.position, p.normal});
    truths.push_back(traceReference(scene, tracing).points);
  }
  for (const auto& [name, options] : solves()) {
    SCOPED_TRACE(name);
    const Snapshot snapshot = solved(scene, options)->snapshot();
    std::vector<double> off;  // the mean of each line from the truth's
    for (const Truth& truth : truths) {
      const Values values = answerProbes(snapshot, probesOf(truth), false);
      double found = 0, meant = 0;
      for (std::size_t p = 0; p < truth.size(); ++p) {
        meant += truth[p].radiosity.x;
        found += values[p] ? values[p]->x : 0;
      }
      off.push_back(found / meant - 1);
      const double error = reflectedError(truth, values);
      measured(name + ", mean of the line", off.back());
      measured(name + ", nRMSE", error);
      EXPECT_LT(error, options.elements ? 0.22 : 0.12);
    }
    // Where the mesh follows the light a line nearer to the contact is as good as one farther off; elements
    // that are all alike, of a quarter of the room's height, are means over what they cover.
    const auto [least, most] = std::minmax_element(off.begin(), off.end());
    EXPECT_LT(*most - *least, options.elements ? 0.15 : options.do_anyway.empty() ? 0.08 : 0.05);
    EXPECT_LT(std::max(*most, -*least), options.elements ? 0.15 : 0.06);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Leaks, testing::ValuesIn(kDivided),
                         [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace unshot
