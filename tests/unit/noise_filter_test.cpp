// Noise of gathered light evened out: how much of it goes, and what stays.
#include "session/noise_filter.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "mesh/build.h"
#include "scene/analytic_scenes.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

/// A floor below a lamp of its size.
Mesh floorBelowALamp() {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5));
  const auto lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(1));
  b.quad(grey, {0, 0, 0}, {0, 0, 2}, {2, 0, 0});
  b.quad(lamp, {0, 2, 0}, {2, 0, 0}, {0, 0, 2});
  MeshOptions options;
  options.elements = 1'000;
  return buildMesh(b.finish(), options);
}

struct Noisy {
  std::vector<glm::dvec3> truth, values;
  std::vector<double> variance;

  /// RMS over the vertices that are given.
  template <class Chosen>
  double error(const std::vector<glm::dvec3>& of, Chosen&& chosen) const {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < of.size(); ++v) {
      if (!chosen(v)) continue;
      const glm::dvec3 off = of[v] - truth[v];
      sum += glm::dot(off, off) / 3;
      ++count;
    }
    return std::sqrt(sum / static_cast<double>(count));
  }
};

/// `truth` with noise of standard deviation `noise` in each channel, and its variance as two looks know it.
template <class Truth>
Noisy noisy(const Mesh& mesh, double noise, Truth&& truth) {
  Noisy out;
  RandomStream random(7);
  // Of variance 1.
  const auto draw = [&] { return std::sqrt(12.0) * (random.next() - 0.5); };
  for (const Vertex& v : mesh.vertices) {
    const glm::dvec3 t = truth(glm::dvec3(v.position));
    glm::dvec3 looks[2];
    for (glm::dvec3& look : looks)
      look = t + (t == glm::dvec3(0.0) ? 0.0 : noise * std::sqrt(2.0)) * glm::dvec3(draw(), draw(), draw());
    out.truth.push_back(t);
    out.values.push_back(0.5 * (looks[0] + looks[1]));
    const glm::dvec3 half = 0.5 * (looks[0] - looks[1]);
    out.variance.push_back(glm::dot(half, half));
  }
  return out;
}

const auto kEverywhere = [](std::size_t) { return true; };

TEST(NoiseFilter, TakesMostOfTheNoiseOfEvenLight) {
  const Mesh mesh = floorBelowALamp();
  Workers workers(2);
  const Noisy field = noisy(mesh, 0.1, [](const glm::dvec3&) { return glm::dvec3(1, 0.5, 0.2); });
  const double before = field.error(field.values, kEverywhere),
               after = field.error(NoiseFilter(mesh).filtered(field.values, field.variance, workers),
                                   kEverywhere);
  EXPECT_NEAR(before, 0.1, 0.01);
  // Means over about 60 vertices would leave an eighth, were they as independent as they are alike.
  EXPECT_LT(after, 0.3 * before);
}

TEST(NoiseFilter, KeepsAShadowThatIsMoreThanNoise) {
  const Mesh mesh = floorBelowALamp();
  Workers workers(2);
  const auto lit = [&](const glm::dvec3& p) { return p.x < -0.1; };
  const Noisy field = noisy(mesh, 0.05, [&](const glm::dvec3& p) { return glm::dvec3(lit(p) ? 1.0 : 0.3); });
  const std::vector<glm::dvec3> after = NoiseFilter(mesh).filtered(field.values, field.variance, workers);
  // A step of 14 times the noise: half of it would be off by 0.35 where it is evened out.
  const auto beside = [&](std::size_t v) { return std::abs(mesh.vertices[v].position.x + 0.1) < 0.1; };
  EXPECT_LT(field.error(after, beside), 0.05);
  EXPECT_LT(field.error(after, kEverywhere), 0.5 * field.error(field.values, kEverywhere));
}

TEST(NoiseFilter, LeavesWhatIsKnownExactly) {
  const Mesh mesh = floorBelowALamp();
  Workers workers(2);
  const auto lit = [](const glm::dvec3& p) { return p.x < 0; };
  const Noisy field = noisy(mesh, 0.3, [&](const glm::dvec3& p) { return glm::dvec3(lit(p) ? 1.0 : 0.0); });
  const std::vector<glm::dvec3> after = NoiseFilter(mesh).filtered(field.values, field.variance, workers);
  std::size_t dark = 0;
  for (std::size_t v = 0; v < after.size(); ++v) {
    if (field.truth[v] != glm::dvec3(0.0)) continue;
    ASSERT_EQ(after[v], glm::dvec3(0.0)) << v;
    ++dark;
  }
  EXPECT_GT(dark, 100);
}

TEST(NoiseFilter, IsTheSameWithAnyNumberOfThreads) {
  const Mesh mesh = floorBelowALamp();
  const Noisy field = noisy(mesh, 0.1, [](const glm::dvec3& p) { return glm::dvec3(2 + p.x); });
  Workers one(1), three(3);
  const NoiseFilter filter(mesh);
  EXPECT_EQ(filter.filtered(field.values, field.variance, one),
            filter.filtered(field.values, field.variance, three));
}

}  // namespace
}  // namespace unshot
