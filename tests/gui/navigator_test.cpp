#include "viewer/navigator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec4.hpp>

namespace unshot {
namespace {

constexpr double kWindowHeight = 720;
constexpr double kFrame = 1.0 / 60;

// A scene of this size around the origin, seen from the front and a little above, in a frame turned so that
// `up` is upwards.
struct Place {
  double size = 1;
  glm::dvec3 up{0, 1, 0};
};

void PrintTo(const Place& place, std::ostream* out) {
  *out << "size " << place.size << ", up " << place.up.x << "," << place.up.y << "," << place.up.z;
}

glm::dvec3 sideOf(const glm::dvec3& up) {
  return glm::normalize(glm::cross(up, std::abs(up.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

Bounds boundsOf(double size) {
  const glm::dvec3 half(size / 2);
  return {-half, half};
}

Navigator navigatorAt(const Place& place) {
  Camera camera;
  camera.up = place.up;
  const glm::dvec3 up = glm::normalize(place.up);
  camera.at = 0.1 * place.size * glm::dvec3(1, -1, 0.5);
  camera.eye = camera.at + place.size * (2.0 * sideOf(up) + 0.5 * up);
  Navigator navigator;
  navigator.reset(camera, boundsOf(place.size));
  return navigator;
}

double distance(const Camera& camera) { return glm::length(camera.at - camera.eye); }
glm::dvec3 forward(const Camera& camera) { return glm::normalize(camera.at - camera.eye); }
double sineOfPitch(const Camera& camera) { return glm::dot(forward(camera), glm::normalize(camera.up)); }

/// Where a point is seen, in pixels from the middle, y downwards.
glm::dvec2 seenAt(const Camera& camera, const glm::dvec3& point) {
  const ViewBasis basis = viewBasis(camera);
  const glm::dvec3 sight = point - camera.eye;
  const double depth = glm::dot(sight, basis.forward);
  const double pixels = kWindowHeight / 2 / std::tan(camera.fov_deg * glm::pi<double>() / 360);
  return {pixels * glm::dot(sight, basis.right) / depth, -pixels * glm::dot(sight, basis.up) / depth};
}

class EveryPlace : public testing::TestWithParam<Place> {
 protected:
  double size() const { return GetParam().size; }
  Navigator navigator_ = navigatorAt(GetParam());
};

TEST_P(EveryPlace, OrbitKeepsTargetAndDistance) {
  const Camera before = navigator_.camera();
  for (int i = 0; i < 200; ++i) navigator_.orbit({7.0 * (i % 5 - 1), 5.0 * (i % 3 - 1)}, kWindowHeight);
  const Camera& after = navigator_.camera();
  EXPECT_EQ(after.at, before.at);
  EXPECT_NEAR(distance(after), distance(before), 1e-9 * size());
  EXPECT_GT(glm::length(after.eye - before.eye), 0.1 * size());
}

TEST_P(EveryPlace, OrbitAcrossTheHeightIsHalfATurnAndSidewaysKeepsThePitch) {
  const Camera before = navigator_.camera();
  navigator_.orbit({kWindowHeight, 0}, kWindowHeight);
  EXPECT_NEAR(sineOfPitch(navigator_.camera()), sineOfPitch(before), 1e-12);
  const glm::dvec3 up = glm::normalize(before.up);
  const auto level = [&](const glm::dvec3& v) { return glm::normalize(v - glm::dot(v, up) * up); };
  EXPECT_NEAR(glm::dot(level(forward(navigator_.camera())), level(forward(before))), -1, 1e-9);
  navigator_.orbit({kWindowHeight, 0}, kWindowHeight);
  EXPECT_LT(glm::length(navigator_.camera().eye - before.eye), 1e-9 * size());
}

TEST_P(EveryPlace, OrbitAndLookStopShortOfThePoles) {
  for (const bool around : {true, false}) {
    for (const double way : {1.0, -1.0}) {
      Navigator navigator = navigatorAt(GetParam());
      const glm::dvec3 right = viewBasis(navigator.camera()).right;
      for (int i = 0; i < 60; ++i) {
        const glm::dvec2 motion(0, way * 40);
        around ? navigator.orbit(motion, kWindowHeight) : navigator.look(motion, kWindowHeight);
        ASSERT_GT(glm::dot(viewBasis(navigator.camera()).right, right), 0.999) << "flipped over the pole";
      }
      const double steep = std::abs(sineOfPitch(navigator.camera()));
      EXPECT_GT(steep, 0.999);
      EXPECT_LT(steep, 1 - 1e-9);
    }
  }
}

TEST_P(EveryPlace, LookKeepsTheEyeAndTheDistance) {
  const Camera before = navigator_.camera();
  for (int i = 0; i < 100; ++i) navigator_.look({3.0 * (i % 7 - 2), 2.0 * (i % 3 - 1)}, kWindowHeight);
  const Camera& after = navigator_.camera();
  EXPECT_EQ(after.eye, before.eye);
  EXPECT_NEAR(distance(after), distance(before), 1e-9 * size());
  EXPECT_LT(glm::dot(forward(after), forward(before)), 0.99);
}

TEST_P(EveryPlace, PanKeepsTheTargetUnderTheMouse) {
  const Camera before = navigator_.camera();
  glm::dvec2 moved(0.0);
  for (const glm::dvec2& motion : {glm::dvec2(100, 0), glm::dvec2(-30, 55), glm::dvec2(13, -170)}) {
    navigator_.pan(motion, kWindowHeight);
    moved += motion;
    const glm::dvec2 seen = seenAt(navigator_.camera(), before.at);
    EXPECT_NEAR(seen.x, moved.x, 1);
    EXPECT_NEAR(seen.y, moved.y, 1);
  }
  EXPECT_LT(glm::length(forward(navigator_.camera()) - forward(before)), 1e-9);
}

TEST_P(EveryPlace, ZoomGoesOnThroughTheTarget) {
  const Camera before = navigator_.camera();
  double travelled = 0;
  for (int i = 0; i < 200; ++i) {
    navigator_.zoom(1);
    const Camera& now = navigator_.camera();
    ASSERT_GT(glm::dot(forward(now), forward(before)), 1 - 1e-9) << "flipped";
    const double along = glm::dot(now.eye - before.eye, forward(before));
    ASSERT_GT(along - travelled, 0.005 * size()) << "stopped at notch " << i;
    ASSERT_GE(distance(now), 0.0199 * size());
    travelled = along;
  }
  EXPECT_GT(travelled, 1.5 * distance(before));
}

TEST_P(EveryPlace, ZoomIsASeventhOfTheWayAndGoesBack) {
  const Camera before = navigator_.camera();
  navigator_.zoom(1);
  EXPECT_NEAR(distance(navigator_.camera()), distance(before) * 6 / 7, 1e-9 * size());
  EXPECT_LT(glm::length(navigator_.camera().at - before.at), 1e-9 * size());
  navigator_.zoom(-1);
  EXPECT_LT(glm::length(navigator_.camera().eye - before.eye), 1e-9 * size());
  for (int i = 0; i < 20; ++i) navigator_.zoom(-1);
  EXPECT_GT(distance(navigator_.camera()), 10 * distance(before));
  EXPECT_LT(glm::length(forward(navigator_.camera()) - forward(before)), 1e-9);
}

TEST_P(EveryPlace, ZoomKeepsThePointUnderTheMouse) {
  for (const bool parallel : {false, true}) {
    Navigator navigator = navigatorAt(GetParam());
    navigator.setOrthographic(parallel);
    const glm::dvec3 point = navigator.camera().at + 0.2 * size() * viewBasis(navigator.camera()).right +
                             0.3 * size() * viewBasis(navigator.camera()).up +
                             0.4 * size() * viewBasis(navigator.camera()).forward;
    const glm::dvec2 place = *placeInPicture(navigator.camera(), 1, point);
    const glm::dvec3 sight = forward(navigator.camera());
    for (const double notches : {1.0, 2.0, 4.0, -3.0, 7.0, -14.0}) {
      navigator.zoom(notches, point);
      EXPECT_LT(glm::length(*placeInPicture(navigator.camera(), 1, point) - place), 1e-9);
      EXPECT_LT(glm::length(forward(navigator.camera()) - sight), 1e-9);
    }
  }
}

TEST_P(EveryPlace, ParallelSightsAreZoomedByFlyingAhead) {
  navigator_.setOrthographic(true);
  const Camera before = navigator_.camera();
  navigator_.fly({0, 0, 1}, false);
  for (int i = 0; i < 60; ++i) navigator_.advance(kFrame);
  EXPECT_EQ(navigator_.camera().at, before.at);
  EXPECT_LT(distance(navigator_.camera()), 0.9 * distance(before));
  for (int i = 0; i < 6000; ++i) navigator_.advance(kFrame);
  EXPECT_GT(distance(navigator_.camera()), 0.9e-4 * size());
}

TEST_P(EveryPlace, SpeedFollowsTheSceneAndStaysWithinReason) {
  EXPECT_NEAR(navigator_.speed(), std::sqrt(3.0) * size() / 5, 1e-9 * size());
  const double usual = navigator_.speed();
  for (int i = 0; i < 200; ++i) navigator_.scaleSpeed(1.25);
  EXPECT_NEAR(navigator_.speed(), 100 * usual, 1e-6 * usual);
  for (int i = 0; i < 400; ++i) navigator_.scaleSpeed(0.8);
  EXPECT_NEAR(navigator_.speed(), usual / 100, 1e-6 * usual);
}

TEST_P(EveryPlace, FlyReachesItsSpeedAndComesToRest) {
  struct Flight {
    glm::dvec3 direction;
    bool fast;
    double speed;  // of the navigator's
  };
  for (const Flight& flight : {Flight{{0, 0, 1}, false, 1}, Flight{{-1, 0, 0}, true, 4},
                               Flight{{1, 1, 1}, false, 1}, Flight{{0, 0.5, 0}, false, 0.5}}) {
    Navigator navigator = navigatorAt(GetParam());
    const Camera start = navigator.camera();
    EXPECT_FALSE(navigator.moving());
    navigator.fly(flight.direction, flight.fast);
    EXPECT_TRUE(navigator.moving());
    double step = 0;
    for (int i = 0; i < 60; ++i) {
      const glm::dvec3 eye = navigator.camera().eye;
      navigator.advance(kFrame);
      const double now = glm::length(navigator.camera().eye - eye);
      EXPECT_GE(now, step - 1e-9 * size()) << "slower while it should gain speed";
      step = now;
    }
    EXPECT_NEAR(step / kFrame, flight.speed * navigator.speed(), 1e-3 * navigator.speed());
    const ViewBasis basis = viewBasis(start);
    const glm::dvec3 way =
        flight.direction.x * basis.right + flight.direction.y * basis.up + flight.direction.z * basis.forward;
    EXPECT_GT(glm::dot(glm::normalize(navigator.camera().eye - start.eye), glm::normalize(way)), 1 - 1e-9);
    EXPECT_LT(glm::length(forward(navigator.camera()) - forward(start)), 1e-9);
    navigator.fly(glm::dvec3(0.0), false);
    int frames = 0;
    while (navigator.moving() && ++frames < 120) navigator.advance(kFrame);
    EXPECT_LT(frames, 90) << "rolls on for more than one and a half seconds";
    const Camera rest = navigator.camera();
    navigator.advance(kFrame);
    EXPECT_EQ(navigator.camera().eye, rest.eye);
  }
}

INSTANTIATE_TEST_SUITE_P(Navigator, EveryPlace,
                         testing::Values(Place{1e-3, {0, 1, 0}}, Place{1, {0, 1, 0}}, Place{1e4, {0, 1, 0}},
                                         Place{5, {0, 0, 1}}, Place{5, {0, -1, 0}}, Place{5, {3, 0, 0}},
                                         Place{2, {1, 2, -3}}));

TEST(Navigator, CopesWithNonsense) {
  Navigator navigator;
  Camera camera;
  camera.up = glm::dvec3(0.0);
  navigator.reset(camera, {});
  EXPECT_EQ(navigator.camera().up, glm::dvec3(0, 1, 0));
  EXPECT_GT(navigator.speed(), 0);
  navigator.orbit({10, 10}, 0);
  navigator.pan({10, 10}, 0);
  navigator.advance(0);
  navigator.advance(-1);
  camera.at = camera.eye;
  navigator.reset(camera, boundsOf(1));
  navigator.zoom(3);
  navigator.pan({10, 10}, kWindowHeight);
  const glm::dvec3 eye = navigator.camera().eye;
  EXPECT_TRUE(std::isfinite(eye.x) && std::isfinite(eye.y) && std::isfinite(eye.z));
}

TEST(Navigator, ANewCameraStandsAtRest) {
  Navigator navigator = navigatorAt({});
  navigator.fly({0, 0, 1}, true);
  navigator.advance(0.5);
  navigator.reset(Camera(), boundsOf(1));
  EXPECT_FALSE(navigator.moving());
}

}  // namespace
}  // namespace unshot
