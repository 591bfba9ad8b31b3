// Where a reference is traced, how it ends, and what does not change it.
#include "report/reference.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "support/error_of.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

ReferenceOptions twelvePoints() {
  ReferenceOptions options;
  options.points = 12;
  options.relative_error = 0;
  options.max_samples = 256;
  return options;
}

void expectSame(const Reference& a, const Reference& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    EXPECT_EQ(a.points[k].position, b.points[k].position) << k;
    EXPECT_EQ(a.points[k].radiosity, b.points[k].radiosity) << k;
    EXPECT_EQ(a.points[k].standard_error, b.points[k].standard_error) << k;
    EXPECT_EQ(a.points[k].samples, b.points[k].samples) << k;
  }
}

TEST(ReferencePoints, LieOnReflectingSidesThatDoNotShineAndThatLightReaches) {
  const Scene scene = publishedCornellBox();
  ReferenceOptions options;
  options.points = 200;
  const std::vector<ReferencePoint> points = chooseReferencePoints(scene, options);
  ASSERT_EQ(points.size(), 200u);
  int on_blocks = 0;
  for (const ReferencePoint& p : points) {
    EXPECT_EQ(p.emission, glm::dvec3(0.0));
    EXPECT_NE(p.reflectance, glm::dvec3(0.0));
    EXPECT_EQ(p.samples, 0u);
    EXPECT_EQ(p.standard_error.x, std::numeric_limits<double>::infinity());
    // The room's middle lies before every wall.
    const glm::dvec3 inwards = glm::dvec3(278, 274, 280) - p.position;
    const bool inner = p.position.y > 1 && p.position.y < 331 && p.position.x > 1 && p.position.x < 549 &&
                       p.position.z > 1 && p.position.z < 558;
    on_blocks += inner;
    if (!inner) {
      EXPECT_GT(glm::dot(inwards, p.normal), 0) << p.position.x << " " << p.position.y << " " << p.position.z;
    }
  }
  EXPECT_GT(on_blocks, 10);
}

// A room without light behind a wall, and the outside of both: no side of theirs gets a point.
TEST(ReferencePoints, StayOutOfDarkRooms) {
  ReferenceOptions options;
  options.points = 100;
  for (const ReferencePoint& p : chooseReferencePoints(litAndDarkRoom(), options))
    EXPECT_LT(p.position.x, 1.001);
}

TEST(ReferencePoints, TakeEmittingSidesWhereThereAreNoOthers) {
  EXPECT_EQ(chooseReferencePoints(furnaceScene(0.5, 1), twelvePoints()).size(), 12u);
}

TEST(ReferencePoints, ArePutWhereTheyAreAskedFor) {
  ReferenceOptions options = twelvePoints();
  options.places = {{{0.25, 0, 0.5}, {0, 2, 0}}, {{0.25, 1, 0.5}, {0, -1, 0}}};
  const auto points = chooseReferencePoints(cubeOneFaceLit(0.5), options);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].emission, glm::dvec3(1.0));
  EXPECT_EQ(points[1].emission, glm::dvec3(0.0));
  EXPECT_NEAR(points[1].position.y, 1, 1e-6);
  EXPECT_NEAR(points[0].normal.y, 1, 1e-12);
  options.places = {{{0.25, 0.5, 0.5}, {0, 1, 0}}};
  EXPECT_EQ(errorOf([&] { chooseReferencePoints(cubeOneFaceLit(0.5), options); }).kind(), ErrorKind::kInput);
}

TEST(ReferencePoints, NeedLight) {
  const Error dark = errorOf([] { chooseReferencePoints(furnaceScene(0.5, 0), twelvePoints()); });
  EXPECT_EQ(dark.kind(), ErrorKind::kInput);
  EXPECT_THAT(dark.advice(), HasSubstr("Ke"));
  const Error black = errorOf([] { chooseReferencePoints(furnaceScene(0, 1), twelvePoints()); });
  EXPECT_EQ(black.kind(), ErrorKind::kInput);
}

TEST(TracedReference, DoesNotDependOnTheNumberOfThreads) {
  ReferenceOptions options = twelvePoints();
  const Scene scene = publishedCornellBox();
  options.threads = 1;
  const Reference one = traceReference(scene, options);
  options.threads = 3;
  expectSame(one, traceReference(scene, options));
  options.seed = 2;
  EXPECT_NE(one.points[0].position, traceReference(scene, options).points[0].position);
}

TEST(TracedReference, EndsAtTheErrorAskedForAndSaysWhenItCannot) {
  ReferenceOptions options = twelvePoints();
  options.relative_error = 0.1;
  options.max_samples = 1u << 20;
  const Reference reached = traceReference(cubeOneFaceLit(0.5), options);
  EXPECT_LE(noiseOf(reached.points), 0.1);
  EXPECT_LE(medianNoiseOf(reached.points), 0.2);
  EXPECT_TRUE(reached.diagnostics.empty());
  EXPECT_GT(reached.seconds, 0);
  options.relative_error = 1e-6;
  options.max_samples = 512;
  const Reference limited = traceReference(cubeOneFaceLit(0.5), options);
  EXPECT_EQ(limited.points[0].samples, 512u);
  EXPECT_THAT(limited.diagnostics, Contains(Field(&Diagnostic::code, "reference-noise")));
}

TEST(TracedReference, HasTwoFiguresOfItsNoise) {
  std::vector<ReferencePoint> points(3);
  const double reflected[] = {1, 2, 100}, error[] = {0.5, 0.2, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    points[k].emission = glm::dvec3(7);
    points[k].radiosity = glm::dvec3(7 + reflected[k]);
    points[k].standard_error = glm::dvec3(error[k]);
  }
  EXPECT_NEAR(noiseOf(points), std::sqrt((0.25 + 0.04 + 1) / 10'005), 1e-12);
  EXPECT_NEAR(medianNoiseOf(points), 0.1, 1e-12);
  EXPECT_EQ(noiseOf({}), 0);
  EXPECT_EQ(medianNoiseOf({}), 0);
}

TEST(TracedReference, ReturnsWhatWasReachedWhenStopped) {
  ReferenceOptions options = twelvePoints();
  options.relative_error = 0;
  options.max_samples = std::uint64_t{1} << 40;
  int calls = 0;
  double last = 0;
  options.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return ++calls < 4;
  };
  const Reference stopped = traceReference(cubeOneFaceLit(0.5), options);
  EXPECT_EQ(calls, 4);
  EXPECT_LT(noiseOf(stopped.points), 0.5);
  EXPECT_THAT(stopped.diagnostics, Contains(Field(&Diagnostic::message, HasSubstr("interruption"))));

  options.progress = nullptr;
  options.max_seconds = 0;
  const Reference none = traceReference(cubeOneFaceLit(0.5), options);
  EXPECT_EQ(noiseOf(none.points), std::numeric_limits<double>::infinity());
  EXPECT_THAT(none.diagnostics, Contains(Field(&Diagnostic::message, HasSubstr("limit of time"))));
}

TEST(TracedReference, LetsExceptionsOfTheCallerThrough) {
  ReferenceOptions options = twelvePoints();
  options.max_samples = std::uint64_t{1} << 40;
  options.progress = [](double) -> bool { throw std::runtime_error("enough"); };
  EXPECT_THROW(traceReference(cubeOneFaceLit(0.5), options), std::runtime_error);
}

TEST(TracedReference, GoesOnAsIfItHadNotStopped) {
  const Scene scene = publishedCornellBox();
  ReferenceOptions options = twelvePoints();
  const Reference whole = traceReference(scene, options);
  options.max_samples = 64;
  Reference parts = traceReference(scene, options);
  options.max_samples = 256;
  continueReference(scene, options, parts);
  for (std::size_t k = 0; k < whole.points.size(); ++k) {
    EXPECT_EQ(parts.points[k].samples, 256u);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(parts.points[k].radiosity[c], whole.points[k].radiosity[c], 1e-12);
      EXPECT_NEAR(parts.points[k].standard_error[c], whole.points[k].standard_error[c], 1e-12);
    }
  }
}

TEST(TracedReference, SeesTheBackOfLightsOnlyWhereItShines) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5));
  const auto light = b.material("light", glm::dvec3(0.0), glm::dvec3(1.0));
  b.quad(grey, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  b.quad(light, {0, 1, 0}, {0, 0, 1}, {1, 0, 0});  // its front is up
  const Scene scene = b.finish();
  ReferenceOptions options = twelvePoints();
  options.places = {{{0.5, 0, 0.5}, {0, 1, 0}}};
  // The factor of a unit square centred at distance 1.
  EXPECT_NEAR(traceReference(scene, options).points[0].radiosity.x, 0.5 * 0.239456470, 0.005);
  options.emit_front_only = true;
  EXPECT_EQ(traceReference(scene, options).points[0].radiosity.x, 0);
}

}  // namespace
}  // namespace unshot
