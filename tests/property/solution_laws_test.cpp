// Laws of solutions: linear in E; the same wherever the scene stands, however large it is and however its
// polygons are ordered; the same twice for one seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "export/probes.h"
#include "support/dice.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// A cube of six colours, two faces of which shine.
Scene colouredCube(const glm::dvec3& floor_emission, const glm::dvec3& wall_emission) {
  std::array<Material, 6> materials;
  for (std::size_t k = 0; k < 6; ++k) {
    const double x = static_cast<double>(k) / 6;
    materials[k] = {"m" + std::to_string(k), glm::dvec3(0.3 + 0.6 * x, 0.8 - 0.5 * x, 0.5), glm::dvec3(0.0)};
  }
  materials[0].emission = floor_emission;
  materials[3].emission = wall_emission;
  return cubeScene(materials);
}

Scene colouredCube() { return colouredCube({1, 2, 0.5}, {0.3, 0, 1}); }

// Mean radiosity of each material's sides.
std::vector<glm::dvec3> materialMeans(const Solve& solve) {
  const Mesh& mesh = solve.mesh();
  std::vector<glm::dvec3> sum(mesh.materials.size(), glm::dvec3(0.0));
  std::vector<double> area(sum.size(), 0.0);
  const std::vector<glm::dvec3> b = sideRadiosities(solve.snapshot());
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Surface& s = mesh.surfaces[mesh.sides[k].surface];
    sum[s.material] += s.area * b[k];
    area[s.material] += s.area;
  }
  for (std::size_t m = 0; m < sum.size(); ++m) sum[m] /= area[m];
  return sum;
}

double largestDifference(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  EXPECT_EQ(a.size(), b.size());
  double out = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (int c = 0; c < 3; ++c) {
      if (b[k][c] != 0) out = std::max(out, std::abs(a[k][c] / b[k][c] - 1));
    }
  }
  return out;
}

using Answers = std::vector<std::optional<glm::dvec3>>;

// One in the middle of each element.
std::vector<Probe> elementProbes(const Mesh& mesh) {
  std::vector<Probe> out;
  for (const Side& side : mesh.sides) {
    const Range elements = mesh.surfaces[side.surface].elements;
    for (std::uint32_t e = elements.first; e < elements.end(); ++e)
      out.push_back({mesh.frame_origin + mesh.shapes[e].centre, side.normal});
  }
  return out;
}

// What a scene scaled by `scale` answers to the same probes.
Answers probedAt(const Solve& solve, std::vector<Probe> probes, double scale) {
  for (Probe& probe : probes) probe.position *= scale;
  return answerProbes(solve.snapshot(), probes, false);
}

// RMS(a - b) / RMS(b); every probe must have an answer.
double rmsDifference(const Answers& a, const Answers& b) {
  double error = 0, total = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_TRUE(a[k] && b[k]) << "probe " << k << " lies on nothing";
    if (!a[k] || !b[k]) return INFINITY;
    const glm::dvec3 difference = *a[k] - *b[k];
    error += glm::dot(difference, difference);
    total += glm::dot(*b[k], *b[k]);
  }
  return std::sqrt(error / total);
}

// Noise of a method in means over a face of some hundred elements: each turn of the scene turns the pixels of
// a hemicube.
double noiseOf(std::string_view method) { return method == "closed-form" ? 2e-5 : 0.005; }

class Solution : public testing::TestWithParam<FormFactorMethodRow> {
 protected:
  std::unique_ptr<Solve> solve(Scene scene, std::uint64_t seed = 1) const {
    SolveOptions options = optionsOf(GetParam().info.key, 600, 1e-7);
    options.seed = seed;
    return solved(std::move(scene), options);
  }
  double noise() const { return noiseOf(GetParam().info.key); }
};

TEST_P(Solution, ScalesWithTheEmission) {
  const auto one = solve(colouredCube()),
             many = solve(colouredCube(1000.0 * glm::dvec3(1, 2, 0.5), 1000.0 * glm::dvec3(0.3, 0, 1)));
  std::vector<glm::dvec3> expected = materialMeans(*one);
  for (glm::dvec3& b : expected) b *= 1000;
  EXPECT_LT(largestDifference(materialMeans(*many), expected), 1e-5);
}

// Which patches emit decides how finely a hemicube splits them, so K itself is not quite the same in the
// three solves.
TEST_P(Solution, AddsUpOverTheEmitters) {
  const auto both = solve(colouredCube({1, 2, 0.5}, {0.3, 0.7, 1}));
  const auto floor = solve(colouredCube({1, 2, 0.5}, glm::dvec3(0.0))),
             wall = solve(colouredCube(glm::dvec3(0.0), {0.3, 0.7, 1}));
  std::vector<glm::dvec3> sum = materialMeans(*floor);
  const std::vector<glm::dvec3> other = materialMeans(*wall);
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += other[k];
  EXPECT_LT(largestDifference(sum, materialMeans(*both)), noise());
}

TEST_P(Solution, DoesNotDependOnWhereTheSceneStands) {
  const std::vector<glm::dvec3> expected = materialMeans(*solve(colouredCube()));
  Dice dice(21);
  for (int k = 0; k < 2; ++k) {
    const double difference =
        largestDifference(materialMeans(*solve(moved(colouredCube(), dice.rotation()))), expected);
    measured("turned", difference);
    // A square's chart starts at any of its corners, and display triangles, over which means are taken,
    // follow it.
    EXPECT_LT(difference, std::max(noise(), 0.002));
  }
  // Coordinates of 1e5 in double keep eleven digits of a cube of 1.
  const auto far = solve(moved(colouredCube(), unturned(), 1, glm::dvec3(1e5, -1e5, 1e5)));
  const double difference = largestDifference(materialMeans(*far), expected);
  measured("shifted by 1e5", difference);
  EXPECT_LT(difference, noise());
}

// Extreme ones too: no step may hold lengths or areas against a fixed number, or overflow.
const double kScales[] = {1e-12, 1e-6, 1e-3, 1e4, 1e6, 1e12};

std::string scaledBy(double scale) {
  char text[32];
  std::snprintf(text, sizeof text, "scaled by %g", scale);
  return text;
}

TEST_P(Solution, DoesNotDependOnTheUnitOfLength) {
  const auto plain = solve(colouredCube());
  const std::vector<glm::dvec3> expected = materialMeans(*plain);
  const std::vector<Probe> probes = elementProbes(plain->mesh());
  const Answers answers = answerProbes(plain->snapshot(), probes, false);
  for (const double scale : kScales) {
    const auto scaled = solve(moved(colouredCube(), unturned(), scale));
    const double difference = largestDifference(materialMeans(*scaled), expected);
    measured(scaledBy(scale), difference);
    EXPECT_LT(difference, noise());
    const double probed = rmsDifference(probedAt(*scaled, probes, scale), answers);
    measured(scaledBy(scale) + ", RMS of probes", probed);
    EXPECT_LT(probed, 4 * noise());
  }
}

TEST_P(Solution, DoesNotDependOnTheOrderOfThePolygons) {
  const std::vector<glm::dvec3> expected = materialMeans(*solve(colouredCube()));
  const auto shuffled = solve(moved(colouredCube(), unturned(), 1, glm::dvec3(0.0), {4, 2, 5, 0, 3, 1}));
  const double difference = largestDifference(materialMeans(*shuffled), expected);
  measured("shuffled", difference);
  EXPECT_LT(difference, noise());
}

TEST_P(Solution, IsTheSameTwiceForOneSeed) {
  const Snapshot one = solve(colouredCube(), 5)->snapshot(), two = solve(colouredCube(), 5)->snapshot();
  EXPECT_EQ(one.irradiance, two.irradiance);
  EXPECT_EQ(one.element_irradiance, two.element_irradiance);
  EXPECT_EQ(one.ambient, two.ambient);
  const auto other = solve(colouredCube(), 6);
  EXPECT_LT(largestDifference(materialMeans(*other), materialMeans(*solve(colouredCube(), 5))), noise());
}

INSTANTIATE_TEST_SUITE_P(Methods, Solution,
                         testing::ValuesIn(formFactorMethods().begin(), formFactorMethods().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

// With blocks and shadows, and materials whose polygons are apart.
TEST(CornellBoxSolution, DoesNotDependOnPlaceScaleOrOrder) {
  const auto solve = [](Scene scene) {
    return materialMeans(*solved(std::move(scene), optionsOf("hemicube", 1000, 1e-4)));
  };
  const Scene scene = publishedCornellBox();
  const std::vector<glm::dvec3> expected = solve(scene);
  Dice dice(22);
  std::vector<std::uint32_t> order(scene.polygons.size());
  for (std::uint32_t k = 0; k < order.size(); ++k)
    order[k] = static_cast<std::uint32_t>(order.size()) - 1 - k;
  const double shuffled =
      largestDifference(solve(moved(scene, unturned(), 1, glm::dvec3(0.0), order)), expected);
  const double turned =
      largestDifference(solve(moved(scene, dice.rotation(), 1e-3, glm::dvec3(5.0))), expected);
  measured("shuffled", shuffled);
  measured("turned, in metres", turned);
  EXPECT_LT(shuffled, 0.02);
  EXPECT_LT(turned, 0.02);
}

TEST(CornellBoxSolution, DoesNotDependOnTheUnitOfLength) {
  const Scene scene = publishedCornellBox();
  const SolveOptions options = optionsOf("hemicube", 1000, 1e-3);
  const auto plain = solved(scene, options);
  const std::vector<Probe> probes = elementProbes(plain->mesh());
  const Answers answers = answerProbes(plain->snapshot(), probes, false);
  for (const double scale : kScales) {
    const auto scaled = solved(moved(scene, unturned(), scale), options);
    EXPECT_EQ(scaled->mesh().element_count, plain->mesh().element_count);
    const double difference = rmsDifference(probedAt(*scaled, probes, scale), answers);
    measured(scaledBy(scale) + ", RMS of probes", difference);
    EXPECT_LT(difference, 0.02);
  }
}

}  // namespace
}  // namespace unshot
