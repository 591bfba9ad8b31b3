// The viewer's camera by actions, keys and the wheel.
#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "base/clock.h"
#include "support/live_viewer.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing_support::LiveViewer;

class ViewerCamera : public testing::Test {
 protected:
  ViewerCamera() : live_(options()) {
    EXPECT_TRUE(live_.untilPhase(SessionPhase::kConverged));
    rest();
    live_->perform("panel", "off");
    rest();
  }
  static LiveViewer::Options options() {
    LiveViewer::Options options;
    options.scene = UNSHOT_SOURCE_DIR "/assets/cornell_box.obj";
    options.solve.elements = 300;
    options.solve.error = 0.1;
    options.width = options.height = 300;
    return options;
  }
  void rest() {
    ASSERT_TRUE(live_.until([&] { return live_->nextFrame(0) > 1e30; }));
    ASSERT_FALSE(live_->error()) << live_->error()->fullText();
  }
  void act(const std::string& action, const std::string& argument = {}) {
    live_->perform(action, argument);
    live_.draw();
    ASSERT_FALSE(live_->error()) << live_->error()->fullText();
  }
  std::optional<glm::dvec2> placeOf(const glm::dvec3& in_file) {
    return placeInPicture(*live_->cameraInFile(), 1, in_file);
  }
  glm::dvec3 pickedAt(const std::string& place) {
    act("pick", place);
    EXPECT_TRUE(live_->picking().picked()) << place;
    return live_->picking().picked() ? live_->picking().picked()->probe.position : glm::dvec3(0.0);
  }
  /// A click of the wheel with the mouse at this place of the picture.
  void wheel(const glm::dvec2& at, float notches) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {static_cast<float>(300 * at.x), static_cast<float>(300 * at.y)};
    live_.draw();  // ImGui looks first at what is under the mouse
    io.MouseWheel = notches;
    live_->input();
    live_.draw();
    io.MouseWheel = 0;
  }

  LiveViewer live_;
};

TEST_F(ViewerCamera, ViewsAlongTheAxesShowAllOfTheSceneInBothProjections) {
  const Bounds bounds = *live_->boundsInFile();
  const std::map<std::string, glm::dvec3> sights{{"front", {0, 0, -1}}, {"back", {0, 0, 1}},
                                                 {"left", {1, 0, 0}},   {"right", {-1, 0, 0}},
                                                 {"top", {0, -1, 0}},   {"bottom", {0, 1, 0}}};
  for (const char* projection : {"perspective", "orthographic"}) {
    act("projection", projection);
    int key = '1';
    for (const AxisView& view : axisViews()) {
      SCOPED_TRACE(std::string(projection) + " " + std::string(view.info.key));
      live_->key(key++, true);
      const Camera camera = *live_->cameraInFile();
      EXPECT_LT(glm::distance(viewBasis(camera).forward, sights.at(std::string(view.info.key))), 2e-5);
      for (int corner = 0; corner < 8; ++corner) {
        const auto place = placeOf(bounds.corner(corner));
        ASSERT_TRUE(place);
        EXPECT_LT(std::max(std::abs(place->x - 0.5), std::abs(place->y - 0.5)), 0.5);
      }
      // x to the right, or y upwards.
      const ViewBasis basis = viewBasis(camera);
      EXPECT_NEAR(std::max(std::abs(basis.right.x), basis.up.y), 1, 1e-4);
      EXPECT_TRUE(view.up == 0 || basis.right.x > 0.9999);
    }
  }
}

TEST_F(ViewerCamera, PicksWhatIsSeenInBothProjections) {
  act("camera-preset", "cornell");
  for (const char* projection : {"perspective", "orthographic"}) {
    act("projection", projection);
    for (const glm::dvec2& at : {glm::dvec2(0.5, 0.4), glm::dvec2(0.35, 0.6), glm::dvec2(0.6, 0.75)}) {
      const glm::dvec3 found = pickedAt(std::to_string(at.x) + "," + std::to_string(at.y));
      ASSERT_TRUE(placeOf(found));
      EXPECT_LT(glm::distance(*placeOf(found), at), 1e-5);  // digits of the place, and of the point
    }
  }
  // Seen from above through the dark back of the ceiling.
  act("view", "top");
  EXPECT_NEAR(pickedAt("0.5,0.1").y, 0, 1e-9) << "not the floor";
}

TEST_F(ViewerCamera, TheWheelGoesToWhatIsUnderTheMouse) {
  act("camera-preset", "cornell");
  for (const char* projection : {"perspective", "orthographic"}) {
    SCOPED_TRACE(projection);
    act("projection", projection);
    const glm::dvec2 at(0.4, 0.7);
    const glm::dvec3 point = pickedAt("0.4,0.7");
    const double before = glm::distance(point, live_->cameraInFile()->eye);
    for (int k = 0; k < 3; ++k) {
      wheel(at, 1);
      EXPECT_LT(glm::distance(*placeOf(point), at), 1e-4);
    }
    EXPECT_LT(glm::distance(point, live_->cameraInFile()->eye), 0.75 * before);
    wheel(at, -3);
    EXPECT_LT(glm::distance(*placeOf(point), at), 1e-4);
    EXPECT_NEAR(glm::distance(point, live_->cameraInFile()->eye), before, 1e-3 * before);
  }
}

TEST_F(ViewerCamera, FramingKeepsTheProjection) {
  live_->key('O', false);
  EXPECT_TRUE(live_->camera().orthographic);
  act("frame");
  rest();
  EXPECT_TRUE(live_->camera().orthographic);
  const Bounds bounds = *live_->boundsInFile();
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec2 place = *placeOf(bounds.corner(corner));
    EXPECT_LT(std::max(std::abs(place.x - 0.5), std::abs(place.y - 0.5)), 0.5);
  }
}

TEST_F(ViewerCamera, IsCopiedAsItIsTaken) {
  act("camera", "1,2,3,4,5.25,6,50");
  act("projection", "orthographic");
  act("copy-camera");
  EXPECT_STREQ(ImGui::GetClipboardText(), "camera 1,2,3,4,5.25,6,50\nprojection orthographic\n");
  act("copy-camera", "options");
  EXPECT_STREQ(ImGui::GetClipboardText(), "--eye 1,2,3 --at 4,5.25,6 --up 0,1,0 --fov 50");
  act("fov", "33");
  EXPECT_EQ(live_->camera().fov_deg, 33);
  act("speed", "3");
  act("camera", "1,2,3,4,5,6");
  EXPECT_EQ(live_->navigator().speedFactor(), 3) << "lost when the camera is placed";
}

TEST_F(ViewerCamera, PresetsAreOfferedWhereTheyFit) {
  ASSERT_EQ(cameraPresets().size(), 1u);
  const CameraPreset& cornell = cameraPresets().front();
  EXPECT_TRUE(fits(cornell, *live_->boundsInFile()));
  EXPECT_FALSE(fits(cornell, {{0, 0, 0}, {1, 1, 1}}));
  EXPECT_FALSE(fits(cornell, {{-278, 0, 0}, {278, 548, 559}}));
  act("camera-preset", "cornell");
  // The published film is square, and the box's front edge is in it.
  EXPECT_GT(placeOf({0, 0, 0})->x, 0.95);
  EXPECT_LT(placeOf({0, 0, 0})->x, 1);
}

// As long as it is the one that was found.
TEST(CameraPreset, WithoutASceneChangesNothing) {
  LiveViewer live(LiveViewer::Options{});
  live->perform("projection", "orthographic");
  live->perform("camera-preset", "cornell");
  EXPECT_TRUE(live->error());
  EXPECT_TRUE(live->camera().orthographic);
}

TEST_F(ViewerCamera, KeepsALockedExposure) {
  live_->perform("lock-exposure", "on");
  rest();
  const double exposure = live_->exposure();
  live_->perform("exposure", "2");
  for (const char* display : {"normals", "false-radiosity", "mesh", "radiosity"}) {
    act("display", display);
    rest();
  }
  EXPECT_EQ(live_->exposure(), exposure);
  live_->navigator().orbit({100, 0}, 300);
  act("frame");
  rest();
  EXPECT_EQ(live_->exposure(), exposure);
  act("display", "normals");
  rest();
  EXPECT_EQ(live_->exposure(), 1) << "of what has none";
  act("display", "radiosity");
  act("lock-exposure", "off");
  live_->navigator().zoom(8);
  live_->input();
  rest();
  EXPECT_NE(live_->exposure(), exposure);
}

TEST_F(ViewerCamera, IsFoundAgainForAWindowOfAnotherShape) {
  const auto resize = [&](const std::string& size) {
    act("size", size);
    const double later = wallSeconds() + 1;
    ASSERT_TRUE(live_.until([&] { return wallSeconds() > later; }));
    rest();
  };
  const Camera square = live_->camera();
  resize("600x200");
  const Camera wide = live_->camera();
  EXPECT_NE(wide, square);
  act("frame");
  rest();
  EXPECT_EQ(live_->camera(), wide) << "F finds another one";
  resize("900x300");
  EXPECT_EQ(live_->camera(), wide) << "its shape is the same";
  live_->navigator().orbit({40, 10}, 240);
  rest();
  const Camera moved = live_->camera();
  resize("300x300");
  EXPECT_EQ(live_->camera(), moved) << "the user has moved it";
  act("frame");
  rest();
  EXPECT_EQ(live_->camera(), square);
}

/// What the mouse does, for scripts.
TEST(CameraActions, MoveItAsTheySay) {
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 200;
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
  const Camera start = live->camera();
  const ViewBasis basis = viewBasis(start);
  const double distance = glm::length(start.at - start.eye);
  /// In camera axes.
  const auto moved = [&](const char* action, const char* by) {
    live->setCamera(live->state().snapshot->mesh->frame_origin + start.eye,
                    live->state().snapshot->mesh->frame_origin + start.at, start.fov_deg);
    live->perform(action, by);
    EXPECT_FALSE(live->error()) << action;
    const glm::dvec3 d = live->camera().eye - start.eye;
    return glm::dvec3(glm::dot(d, basis.right), glm::dot(d, basis.up), glm::dot(d, basis.forward));
  };
  const glm::dvec3 right = moved("orbit", "90,0");
  EXPECT_GT(right.x, 0.5 * distance);
  EXPECT_NEAR(glm::length(live->camera().at - start.at), 0, 1e-9 * distance);
  EXPECT_GT(moved("orbit", "0,20").y, 0.1 * distance);
  const double height = 2 * distance * std::tan(glm::radians(start.fov_deg) / 2);
  const glm::dvec3 panned = moved("pan", "0.5,0.25");
  EXPECT_NEAR(panned.x, 0.5 * height, 1e-6 * height);
  EXPECT_NEAR(panned.y, 0.25 * height, 1e-6 * height);
  EXPECT_GT(moved("zoom", "1").z, 0.05 * distance);
  EXPECT_LT(moved("zoom", "-1").z, -0.05 * distance);
  const glm::dvec3 flown = moved("fly", "1,2,-3");
  EXPECT_NEAR(glm::length(flown - glm::dvec3(1, 2, -3)), 0, 1e-9 * distance);
}

}  // namespace
}  // namespace unshot
