// Surfaces that no light can reach: how they are drawn.
#include "render/unlit_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "gl/context.h"
#include "mesh/build.h"
#include "render/display_modes.h"
#include "render/exposure.h"
#include "render/picture.h"
#include "render/scene_view.h"
#include "render/side_pictures.h"
#include "render/targets.h"
#include "scene/analytic_scenes.h"
#include "support/pixel.h"

namespace unshot {
namespace {

using testing_support::pixel;

class UnlitSurfacesOn : public testing::TestWithParam<gl::Provider> {
 protected:
  void SetUp() override {
    context_ = gl::createContext(GetParam().info.key);
    context_->makeCurrent();
  }
  Picture picture(const Snapshot& snapshot, const PictureOptions& options) {
    Picture drawn = renderPicture(*context_, snapshot, options);
    EXPECT_EQ(context_->functions().GetError(), GLenum{GL_NO_ERROR});
    return drawn;
  }
  std::unique_ptr<gl::Context> context_;
};

// A closed room with a lamp and another one beside it without, as far away as that.
Snapshot litRoomBesideDarkOne(double gap = 1) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5)),
             lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(1.0));
  addBox(b, allOf(grey), {0, 0, 0}, {2, 2, 2}, true);
  addBox(b, allOf(grey), {3, 0, 0}, {2, 2, 2}, true);
  b.quad(lamp, {0.8, 1.9, 0.8}, {0.4, 0, 0}, {0, 0, 0.4});
  Mesh mesh = buildMesh(b.finish(), {.elements = 200, .element_size = {}});
  // Moved by hand, so that they stay unlit where they touch.
  for (glm::dvec3& p : mesh.positions) {
    if (p.x + mesh.frame_origin.x > 2.5) p += glm::dvec3(gap - 1, 0.17, 0.31);
  }
  Snapshot out;
  out.mesh = std::make_shared<Mesh>(std::move(mesh));
  out.irradiance.assign(out.mesh->vertices.size(), glm::vec3(2));
  out.ambient.assign(out.mesh->vertices.size(), glm::vec3(1));
  out.unshot.assign(out.mesh->vertices.size(), glm::vec3(3));
  out.element_irradiance.assign(out.mesh->element_count, glm::vec3(2));
  return out;
}

PictureOptions show(const std::string& display, const glm::dvec3& eye, const glm::dvec3& at) {
  PictureOptions options;
  options.width = 120;
  options.height = 90;
  options.display = display;
  options.eye = eye;
  options.at = at;
  return options;
}

TEST(UnlitSurfaces, HaveNoLitSide) {
  EXPECT_EQ(unlitSurfaces(*litRoomBesideDarkOne().mesh).surfaces.size(), 6u);
  const UnlitSurfaces none =
      unlitSurfaces(buildMesh(cubeOneFaceLit(0.5), {.elements = 100, .element_size = {}}));
  EXPECT_TRUE(none.surfaces.empty());
  EXPECT_TRUE(none.corners.empty());
}

// In the choice of a camera too, as the one beside the lit room does here.
TEST_P(UnlitSurfacesOn, HideWhatIsBehind) {
  const Snapshot rooms = litRoomBesideDarkOne();
  const auto seen = [&](double x) {
    const StateGuard guard(context_->functions());
    Camera camera;
    camera.eye = glm::dvec3(x, 1, 1) - rooms.mesh->frame_origin;
    camera.at = glm::dvec3(0, 1, 1) - rooms.mesh->frame_origin;
    camera.fov_deg = 10;
    return SidePictures(*context_, *rooms.mesh, 8, 8).look(camera)[36];
  };
  EXPECT_NE(seen(2.5), 0u) << "into the lit room";
  EXPECT_EQ(seen(12), 0u) << "at the dark one before it";
  const Picture drawn = picture(rooms, show("irradiance", {12, 1, 1}, {0, 1, 1}));
  EXPECT_EQ(pixel(drawn.linear, 60, 45), glm::dvec3(0.0));
}

TEST_P(UnlitSurfacesOn, AreBlack) {
  const Snapshot rooms = litRoomBesideDarkOne();
  for (const DisplayMode& mode : displayModes()) {
    SCOPED_TRACE(mode.info.key);
    const std::string display(mode.info.key);
    // From outside and from inside; the lit room is open from there.
    for (const glm::dvec3& eye : {glm::dvec3(4, 1, 8), glm::dvec3(4, 1, 1.5)}) {
      const Picture drawn = picture(rooms, show(display, eye, {4, 1, 0}));
      if (mode.quantity == Quantity::kSides || mode.quantity == Quantity::kNormals) continue;
      const bool black = mode.quantity != Quantity::kReflectance && mode.quantity != Quantity::kDifference;
      if (mode.quantity != Quantity::kDifference) {
        EXPECT_EQ(pixel(drawn.linear, 60, 45), glm::dvec3(black ? 0.0 : 0.5));
      }
      // The low end of a scale of false colours is no black, nor the background.
      const glm::dvec3 shown = pixel(drawn.srgb, 60, 45);
      if (mode.diverging) {
        EXPECT_LT(glm::length(shown - glm::dvec3(48)), 3) << "0 of a scale to both sides";
      } else if (mode.false_colour) {
        EXPECT_LT(glm::length(shown - glm::dvec3(13, 7, 39)), 3)
            << shown.x << " " << shown.y << " " << shown.z;
      } else {
        EXPECT_EQ(shown == glm::dvec3(0.0), black) << "the background is no black";
      }
    }
  }
}

TEST_P(UnlitSurfacesOn, LeaveTheBacksOfLitOnesOpen) {
  const Snapshot rooms = litRoomBesideDarkOne();
  const Picture drawn = picture(rooms, show("irradiance", {1, 1, 8}, {1, 1, 0}));
  EXPECT_LT(glm::length(pixel(drawn.linear, 60, 45) - glm::dvec3(2.0)), 1e-5);
}

TEST_P(UnlitSurfacesOn, LieBehindLitOnesInTheSamePlane) {
  const Snapshot rooms = litRoomBesideDarkOne(0);
  for (const glm::dvec3& eye : {glm::dvec3(0.1, 1, 1), glm::dvec3(1.5, 0.3, 0.1)}) {
    const Picture wall = picture(rooms, show("irradiance", eye, {2, 1, 1}));
    for (int y = 20; y < 70; ++y) {
      for (int x = 30; x < 90; ++x)
        ASSERT_LT(glm::length(pixel(wall.linear, x, y) - glm::dvec3(2.0)), 1e-5) << x << " " << y;
    }
  }
}

TEST_P(UnlitSurfacesOn, DoNotChangeTheExposure) {
  const Snapshot rooms = litRoomBesideDarkOne();
  const auto exposure = [&](const glm::dvec3& eye, const glm::dvec3& at) {
    return picture(rooms, show("radiosity", eye, at)).exposure;
  };
  EXPECT_EQ(exposure({1, 1, 1.9}, {1, 1, 0}), exposure({2.5, 1, 12}, {2.5, 1, 0}));
}

// As a window does it, that goes on living meanwhile.
TEST_P(UnlitSurfacesOn, AreDrawnInAnyPieces) {
  const Snapshot rooms = litRoomBesideDarkOne();
  const StateGuard guard(context_->functions());
  SceneView view(*context_);
  view.setSnapshot(rooms);
  const LinearTarget target(*context_, 80, 60);
  Camera camera;
  camera.eye = glm::dvec3(2.5, 4, 9) - rooms.mesh->frame_origin;
  camera.at = glm::dvec3(2.5, 1, 1) - rooms.mesh->frame_origin;
  ViewOptions options;
  for (const char* display : {"radiosity", "flat", "mesh"}) {
    options.display = display;
    const std::size_t all = view.pieceCount(options);
    const auto drawn = [&](std::size_t at_once) {
      target.bind();
      for (std::size_t first = 0; first < all;) {
        const DrawnPieces some = view.drawPieces(camera, 4.0 / 3, {}, options, {first, all, at_once});
        EXPECT_LE(some.count, at_once);
        EXPECT_GT(some.end, first);
        first = some.end;
      }
      return target.read();
    };
    const std::vector<glm::vec4> whole = drawn(all);
    EXPECT_TRUE(std::any_of(whole.begin(), whole.end(), [](const glm::vec4& p) {
      return p == glm::vec4(0, 0, 0, kSurfacePixel);
    })) << display;
    EXPECT_EQ(whole, drawn(5)) << display;
  }
}

INSTANTIATE_TEST_SUITE_P(Render, UnlitSurfacesOn,
                         testing::ValuesIn(gl::providers().begin(), gl::providers().end()),
                         [](const auto& row) { return std::string(row.param.info.key); });

}  // namespace
}  // namespace unshot
