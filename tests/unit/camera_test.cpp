// Where points are in pictures and what is seen at places of them, in both projections.
#include "render/camera.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/dice.h"

namespace unshot {
namespace {

using testing_support::Dice;

const Bounds kBounds{{-1, -2, -3}, {4, 2, 1}};

class Projection : public testing::TestWithParam<bool> {
 protected:
  /// Anywhere in or around the bounds; parallel sights see what is behind the eye too.
  Camera camera() {
    Camera camera;
    camera.eye = 4.0 * dice_.direction();
    camera.at = dice_.direction();
    camera.fov_deg = dice_.between(5, 100);
    camera.orthographic = GetParam();
    return camera;
  }
  glm::dvec3 pointInBounds() {
    const auto part = [&] { return dice_.between(0, 1); };
    const glm::dvec3 parts(part(), part(), part());
    return kBounds.min + parts * (kBounds.max - kBounds.min);
  }
  Dice dice_{11};
};

TEST_P(Projection, PlacesAreWhereTheMatrixPutsThemAndSightsLeadBack) {
  for (int k = 0; k < 500; ++k) {
    const Camera camera = this->camera();
    const glm::dvec3 point = pointInBounds();
    const double aspect = dice_.between(0.5, 2);
    const auto place = placeInPicture(camera, aspect, point);
    const bool ahead = glm::dot(point - camera.eye, viewBasis(camera).forward) > 0;
    ASSERT_EQ(place.has_value(), ahead || camera.orthographic);
    if (!place) continue;
    const glm::dvec4 clip = glm::dmat4(viewProjection(camera, aspect, kBounds)) * glm::dvec4(point, 1.0);
    // The matrix is in single precision.
    const double off = 1e-5 * (1 + glm::length(*place)) * (1 + 10 / clip.w);
    EXPECT_NEAR(0.5 + 0.5 * clip.x / clip.w, place->x, off);
    EXPECT_NEAR(0.5 - 0.5 * clip.y / clip.w, place->y, off);
    const Sight sight = sightAt(camera, aspect, kBounds, *place);
    EXPECT_NEAR(glm::length(sight.along), 1, 1e-12);
    const double along = glm::dot(point - sight.from, sight.along);
    EXPECT_GT(along, 0) << "begins behind the point";
    EXPECT_LT(glm::distance(sight.from + along * sight.along, point), 1e-8);
  }
}

TEST_P(Projection, DepthSortsFromNearToFar) {
  for (const bool reversed : {false, true}) {
    for (int k = 0; k < 200; ++k) {
      const Camera camera = this->camera();
      const glm::dmat4 matrix(
          viewProjection(camera, 1, kBounds, {}, reversed ? DepthRange::kReversed : DepthRange::kUsual));
      const auto depthOf = [&](const glm::dvec3& p) {
        const glm::dvec4 clip = matrix * glm::dvec4(p, 1.0);
        return (reversed ? -1 : 1) * clip.z / clip.w;
      };
      const glm::dvec3 forward = viewBasis(camera).forward;
      const glm::dvec3 a = pointInBounds(), b = pointInBounds();
      const double before = glm::dot(a - camera.eye, forward), behind = glm::dot(b - camera.eye, forward);
      // What is closer together or to the eye, single precision need not tell apart.
      if (std::abs(before - behind) < 0.01) continue;
      if (!camera.orthographic && std::min(before, behind) < 0.1) continue;
      EXPECT_EQ(depthOf(a) < depthOf(b), before < behind);
      if (!camera.orthographic) continue;
      for (const double depth : {depthOf(a), depthOf(b)}) {
        EXPECT_GT(depth, -1);
        EXPECT_LT(depth, reversed ? 0 : 1);
      }
    }
  }
}

TEST_P(Projection, FramedBoundsAreInThePictureAndFillIt) {
  for (int k = 0; k < 100; ++k) {
    const double aspect = dice_.between(0.4, 2.5);
    const Camera camera = frameBounds(kBounds, dice_.direction(), {0, 1, 0}, 40, aspect, 1, GetParam());
    double reach = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const auto place = placeInPicture(camera, aspect, kBounds.corner(corner));
      ASSERT_TRUE(place);
      reach = std::max({reach, std::abs(place->x - 0.5), std::abs(place->y - 0.5)});
    }
    EXPECT_LT(reach, 0.5 + 1e-9);
    EXPECT_GT(reach, 0.49);
  }
}

TEST_P(Projection, WhatIsLookedAtKeepsItsSize) {
  Camera camera = this->camera();
  const glm::dvec3 top =
      camera.at + halfHeight(camera, glm::distance(camera.eye, camera.at)) * viewBasis(camera).up;
  EXPECT_NEAR(placeInPicture(camera, 1, top)->y, 0, 1e-9);
  camera.orthographic = !camera.orthographic;
  EXPECT_NEAR(placeInPicture(camera, 1, top)->y, 0, 1e-9);
}

TEST_P(Projection, TheHomogeneousEyeIsWhereSightsComeFrom) {
  for (int k = 0; k < 100; ++k) {
    const Camera camera = this->camera();
    const glm::dvec3 point = pointInBounds();
    const auto place = placeInPicture(camera, 1, point);
    if (!place) continue;
    const glm::dvec4 eye(homogeneousEye(camera, kBounds));
    const glm::dvec3 way = glm::normalize(glm::dvec3(eye) - eye.w * point);
    EXPECT_LT(glm::distance(-way, sightAt(camera, 1, kBounds, *place).along), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Camera, Projection, testing::Bool(),
                         [](const auto& row) { return row.param ? "Orthographic" : "Perspective"; });

}  // namespace
}  // namespace unshot
