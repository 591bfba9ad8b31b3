#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/colour.h"
#include "base/error.h"
#include "gl/context.h"
#include "render/automatic_camera.h"
#include "render/element_edges.h"
#include "render/exposure.h"
#include "render/false_colour.h"
#include "render/picture.h"
#include "render/scene_view.h"
#include "support/pixel.h"
#include "support/synthetic_room.h"

namespace unshot {
namespace {

using testing_support::pixel;
using testing_support::RoomOptions;
using testing_support::syntheticRoom;
using testing_support::syntheticTwoPatches;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A small picture in a display mode.
PictureOptions show(const std::string& display) {
  PictureOptions options;
  options.width = 120;
  options.height = 90;
  options.display = display;
  return options;
}

class Rendering : public testing::TestWithParam<gl::Provider> {
 protected:
  void SetUp() override {
    context_ = gl::createContext(GetParam().info.key);
    context_->makeCurrent();
  }
  Picture picture(const Snapshot& snapshot, const PictureOptions& options = show("radiosity")) {
    Picture drawn = renderPicture(*context_, snapshot, options);
    EXPECT_EQ(context_->functions().GetError(), GLenum{GL_NO_ERROR});
    return drawn;
  }

  std::unique_ptr<gl::Context> context_;
};

double meanDifference(const Image8& a, const Image8& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(int(a.rgb[i]) - int(b.rgb[i]));
  return sum / static_cast<double>(a.rgb.size());
}

TEST_P(Rendering, EveryModeDrawsWithoutErrorsAndDiffersFromTheOthers) {
  const Snapshot room = syntheticRoom();
  std::vector<Image8> images;
  for (const DisplayMode& mode : displayModes())
    images.push_back(picture(room, show(std::string(mode.info.key))).srgb);
  const auto showsNothing = [](const DisplayMode& mode) {
    return mode.quantity == Quantity::kLastShot || mode.quantity == Quantity::kDifference;
  };
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      // No step was taken, and there is no light but direct light: 0 of the same scale.
      if (showsNothing(displayModes()[i]) && showsNothing(displayModes()[k])) continue;
      EXPECT_GT(meanDifference(images[i], images[k]), 0.1)
          << displayModes()[i].info.key << " and " << displayModes()[k].info.key;
    }
  }
}

// The picture's own linear values say which colour each pixel is to have; isolines and edges are others.
TEST_P(Rendering, FalseColoursAreThoseOfTheScale) {
  for (const char* mode : {"false-irradiance", "false-radiosity"}) {
    const Picture drawn = picture(syntheticRoom(), show(mode));
    const auto encoded = [](float c) {
      return 255 * (c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f);
    };
    int on_scale = 0, all = 0;
    double least = 1, most = 0;
    for (int y = 0; y < drawn.srgb.height; ++y) {
      for (int x = 0; x < drawn.srgb.width; ++x) {
        const double value = luminance(pixel(drawn.linear, x, y));
        if (value == 0) continue;
        ++all;
        const double place = falseColourPlace(value, 1 / drawn.exposure, false);
        least = std::min(least, place);
        most = std::max(most, place);
        const glm::vec3 wanted = falseColourAt(place);
        const glm::dvec3 off =
            pixel(drawn.srgb, x, y) - glm::dvec3(encoded(wanted.x), encoded(wanted.y), encoded(wanted.z));
        on_scale += glm::length(off) < 6;
      }
    }
    EXPECT_GT(all, 1000) << mode;
    EXPECT_GT(on_scale, 0.8 * all) << mode;
    EXPECT_GT(most - least, 0.2) << mode << ": one colour says nothing";
  }
}

TEST_P(Rendering, IsTheSameOnEveryProvider) {
  const Snapshot room = syntheticRoom();
  for (const DisplayMode& mode : displayModes()) {
    const Image8 mine = picture(room, show(std::string(mode.info.key))).srgb;
    for (const gl::Provider& row : gl::providers()) {
      const std::unique_ptr<gl::Context> other = gl::createContext(row.info.key);
      other->makeCurrent();
      const Image8 theirs = renderPicture(*other, room, show(std::string(mode.info.key))).srgb;
      EXPECT_LT(meanDifference(mine, theirs), 0.5) << mode.info.key << " on " << row.info.key;
    }
    context_->makeCurrent();
  }
}

TEST_P(Rendering, LinearValuesAreTheQuantityThatTheModeShows) {
  Snapshot room = syntheticRoom();
  // Constant fields: every pixel inside a surface is known exactly.
  std::fill(room.irradiance.begin(), room.irradiance.end(), glm::vec3(2, 3, 4));
  std::fill(room.element_irradiance.begin(), room.element_irradiance.end(), glm::vec3(1, 2, 3));
  std::fill(room.ambient.begin(), room.ambient.end(), glm::vec3(0.5f));
  std::fill(room.unshot.begin(), room.unshot.end(), glm::vec3(7, 8, 9));
  const glm::dvec3 white(0.75);
  const struct {
    const char* display;
    bool ambient;
    glm::dvec3 expected;
  } cases[] = {{"radiosity", false, white * glm::dvec3(2, 3, 4)},
               {"radiosity", true, white * glm::dvec3(2.5, 3.5, 4.5)},
               {"flat", false, white * glm::dvec3(1, 2, 3)},
               {"flat", true, white * glm::dvec3(1.5, 2.5, 3.5)},
               {"irradiance", false, {2, 3, 4}},
               {"unshot", false, {7, 8, 9}},
               {"emission", false, {0, 0, 0}},
               {"reflectance", false, white},
               {"mesh", false, white * glm::dvec3(2, 3, 4)}};
  for (const auto& c : cases) {
    PictureOptions options = show(c.display);
    options.ambient = c.ambient;
    options.eye = {-0.5, 1, 3};  // at the back wall, beside the block
    options.at = {-0.5, 1, 0};
    const Picture drawn = picture(room, options);
    EXPECT_LT(glm::length(pixel(drawn.linear, 60, 45) - c.expected), 1e-5) << c.display;
  }
}

TEST_P(Rendering, LampsShowTheirEmission) {
  PictureOptions options = show("emission");
  options.eye = {0, 1, 0.9};
  options.at = {0, 1.98, 0};
  const Snapshot room = syntheticRoom();
  EXPECT_LT(glm::length(pixel(picture(room, options).linear, 60, 45) - glm::dvec3(10, 9, 6)), 1e-5);
  options.display = "radiosity";
  const glm::dvec3 shown = pixel(picture(room, options).srgb, 60, 45);
  EXPECT_GT(std::min({shown.x, shown.y, shown.z}), 235) << "a lamp goes to white";
}

TEST_P(Rendering, FlatIsConstantOverAnElementAndSmoothIsNot) {
  const Snapshot room = syntheticRoom({.cells = 2});
  PictureOptions options = show("flat");
  options.eye = {-0.5, 1.5, 1.0};  // at one cell of the back wall
  options.at = {-0.5, 1.5, -1};
  options.fov_deg = 20;
  const Picture flat = picture(room, options);
  options.display = "radiosity";
  const Picture smooth = picture(room, options);
  const auto spread = [](const Picture& p) {
    return glm::length(pixel(p.linear, 20, 10) - pixel(p.linear, 100, 80));
  };
  EXPECT_EQ(spread(flat), 0);
  EXPECT_GT(spread(smooth), 1e-3);
}

TEST_P(Rendering, AnyScaleOfLightGivesTheSamePicture) {
  const Image8 normal = picture(syntheticRoom()).srgb;
  for (double light : {1e-30, 1e-20, 1e-3, 1e5, 1e20, 1e30}) {
    EXPECT_LT(meanDifference(normal, picture(syntheticRoom({.light = light})).srgb), 0.5) << light;
  }
}

TEST_P(Rendering, AnyScaleOfLengthGivesTheSamePicture) {
  const Picture normal = picture(syntheticRoom());
  for (double scale : {1e-3, 1e4, 1e7}) {
    const Picture scaled = picture(syntheticRoom({.scale = scale}));
    EXPECT_LT(meanDifference(normal.srgb, scaled.srgb), 0.5) << scale;
    EXPECT_LT(glm::length(scaled.camera.eye / scale - normal.camera.eye), 1e-6) << scale;
  }
}

TEST_P(Rendering, BlackNanAndInfinityNeverReachThePictureAsGarbage) {
  Snapshot room = syntheticRoom();
  const Image8 good = picture(room).srgb;
  std::vector<glm::vec3> field = room.irradiance;
  for (float bad : {0.0f, kNan, kInfinity, -kInfinity}) {
    for (std::size_t i = 0; i < field.size(); i += 50) room.irradiance[i] = glm::vec3(bad);
    const Picture drawn = picture(room);
    for (float v : drawn.linear.rgb) ASSERT_TRUE(std::isfinite(v)) << bad;
    EXPECT_LT(meanDifference(good, drawn.srgb), 40) << bad;
  }
  for (float all : {0.0f, kNan, kInfinity}) {
    std::fill(room.irradiance.begin(), room.irradiance.end(), glm::vec3(all));
    const Picture drawn = picture(room);
    EXPECT_TRUE(std::isfinite(drawn.exposure) && drawn.exposure > 0) << all;
  }
}

TEST_P(Rendering, ExposureIsInStops) {
  const Snapshot room = syntheticRoom();
  PictureOptions options = show("radiosity");
  const Picture normal = picture(room, options);
  options.exposure_ev = 1;
  const Picture brighter = picture(room, options);
  EXPECT_NEAR(brighter.exposure, 2 * normal.exposure, 1e-9 * normal.exposure);
  EXPECT_GT(pixel(brighter.srgb, 60, 20).x, pixel(normal.srgb, 60, 20).x);
  EXPECT_EQ(brighter.linear.rgb, normal.linear.rgb);
}

TEST_P(Rendering, TilesMakeThePictureThatOneTileMakes) {
  const Snapshot room = syntheticRoom();
  PictureOptions options = show("radiosity");
  options.eye = {0.1, 1, 0.95};
  options.at = {0, 1, -1};
  options.width = 640;
  options.height = 50;
  const Picture one = picture(room, options);
  options.width = 1280;
  options.height = 100;
  const Picture two = picture(room, options);
  int differing = 0;
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 640; ++x) {
      const glm::dvec3 mean =
          0.25 * (pixel(two.linear, 2 * x, 2 * y) + pixel(two.linear, 2 * x + 1, 2 * y) +
                  pixel(two.linear, 2 * x, 2 * y + 1) + pixel(two.linear, 2 * x + 1, 2 * y + 1));
      const double difference = glm::length(mean - pixel(one.linear, x, y));
      differing += difference > 0.02;
      EXPECT_LT(difference, 3) << x << ", " << y << ": more than the edge of the lamp";
    }
  }
  EXPECT_LT(differing, 100);
}

TEST_P(Rendering, PointsAreInTheCoordinatesOfTheFile) {
  PictureOptions options = show("radiosity");
  options.eye = {0, 1, 3};
  options.at = {0, 1, 0};
  const Image8 here = picture(syntheticRoom(), options).srgb;
  const glm::dvec3 origin(1000, -200, 5e5);
  options.eye = *options.eye + origin;
  options.at = *options.at + origin;
  EXPECT_LT(meanDifference(here, picture(syntheticRoom({.frame_origin = origin}), options).srgb), 0.1);
}

TEST_P(Rendering, LooksThroughTheOpenSideByItself) {
  const Picture drawn = picture(syntheticRoom());
  EXPECT_GT(drawn.camera.eye.z, 2);
  EXPECT_NEAR(drawn.camera.eye.x, 0, 1e-6);
  EXPECT_NEAR(drawn.camera.eye.y, 1, 1e-6);
  EXPECT_LT(std::abs(drawn.camera.at.x), 1e-6);
}

TEST_P(Rendering, ShowsALampAndAFloorWithNothingAroundThemWhole) {
  const Snapshot patches = syntheticTwoPatches();
  const Mesh& mesh = *patches.mesh;
  for (const double aspect : {1.0, 4.0 / 3.0, 16.0 / 9.0}) {
    const Camera camera = automaticCamera(*context_, patches, {.aspect = aspect, .fov_deg = {}});
    const glm::mat4 matrix = viewProjection(camera, aspect, {mesh.bounds_min, mesh.bounds_max});
    for (const glm::dvec3& corner : mesh.positions) {
      const glm::vec4 clip = matrix * glm::vec4(glm::vec3(corner), 1.0f);
      ASSERT_GT(clip.w, 0);
      EXPECT_LE(std::abs(clip.x), clip.w) << aspect;
      EXPECT_LE(std::abs(clip.y), clip.w) << aspect;
    }
    for (const Surface& surface : mesh.surfaces) {
      EXPECT_GT(glm::dot(camera.eye - surface.origin, surface.normal), 0.1) << "seen from its dark side";
    }
  }
}

TEST_P(Rendering, SeesTheInsideOfAClosedRoomByItself) {
  const Picture drawn = picture(syntheticRoom({.open_front = false}));
  int dark = 0;
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 120; ++x) dark += pixel(drawn.linear, x, y) == glm::dvec3(0);
  }
  EXPECT_LT(dark, 120 * 90 * 35 / 100);
}

TEST_P(Rendering, DrawsIntoThePartOfTheBoundFramebufferThatItIsGiven) {
  const gl::Functions& fn = context_->functions();
  gl::Texture texture(*context_);
  fn.BindTexture(GL_TEXTURE_2D, texture.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 64, 64, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl::Framebuffer framebuffer(*context_);
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  const std::array<GLfloat, 4> magenta = {1, 0, 1, 1};
  fn.ClearBufferfv(GL_COLOR, 0, magenta.data());
  SceneView view(*context_);
  const Snapshot room = syntheticRoom();
  view.setSnapshot(room);
  const Camera camera{{0, 1, 3}, {0, 1, 0}, {0, 1, 0}, 40};
  const double exposure = view.draw(camera, {}, {16, 8, 32, 32});
  EXPECT_GT(exposure, 0);
  const auto at = [&](int x, int y) {
    std::array<GLubyte, 4> rgba{};
    fn.ReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    return rgba;
  };
  const std::array<GLubyte, 4> untouched = {255, 0, 255, 255};
  for (const auto& [x, y] : {std::pair{15, 8}, {48, 20}, {30, 7}, {30, 40}}) EXPECT_EQ(at(x, y), untouched);
  for (const auto& [x, y] : {std::pair{16, 8}, {47, 39}, {32, 24}}) EXPECT_NE(at(x, y), untouched);
  ViewOptions kept;
  kept.automatic_exposure = exposure;
  EXPECT_EQ(view.draw(camera, kept, {0, 0, 64, 64}), exposure);
  EXPECT_EQ(fn.GetError(), GLenum{GL_NO_ERROR});
}

TEST_P(Rendering, AMeshWithoutTrianglesIsBackground) {
  Snapshot nothing;
  nothing.mesh = std::make_shared<Mesh>();
  const Picture drawn = picture(nothing);
  for (float v : drawn.linear.rgb) ASSERT_EQ(v, 0);
  EXPECT_EQ(pixel(drawn.srgb, 5, 5), pixel(drawn.srgb, 100, 80));
}

// Where light is shown, and nothing stands before it.
TEST_P(Rendering, TheSkyIsBehindEverything) {
  Snapshot room = syntheticRoom();
  room.sky = {0.25, 0.5, 4};
  for (const char* display : {"radiosity", "emission", "reflectance"}) {
    PictureOptions options = show(display);
    options.eye = {0, 1, 20};
    options.at = {0, 1, 40};
    const Picture drawn = picture(room, options);
    const bool light = display != std::string("reflectance");
    EXPECT_EQ(pixel(drawn.linear, 60, 45), light ? room.sky : glm::dvec3(0.0)) << display;
    const glm::dvec3 shown = pixel(drawn.srgb, 60, 45);
    EXPECT_EQ(shown.x < shown.z, light) << display;
  }
}

TEST_P(Rendering, ImpossibleOptionsAreUsageErrors) {
  const Snapshot room = syntheticRoom();
  PictureOptions options = show("radiosity");
  const auto expectUsage = [&](const PictureOptions& o) {
    try {
      renderPicture(*context_, room, o);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    }
  };
  options.width = 0;
  expectUsage(options);
  options.width = kLargestPicture + 1;
  expectUsage(options);
  expectUsage(show("no-such-mode"));
  options = show("radiosity");
  options.fov_deg = 180;
  expectUsage(options);
  options = show("radiosity");
  options.eye = options.at = glm::dvec3(0, 1, 0);
  expectUsage(options);
  options = show("radiosity");
  options.up = glm::dvec3(0.0);
  expectUsage(options);
}

INSTANTIATE_TEST_SUITE_P(Render, Rendering, testing::ValuesIn(gl::providers().begin(), gl::providers().end()),
                         [](const auto& row) { return std::string(row.param.info.key); });

TEST(ElementEdges, LeaveOutTheDiagonalsOfElements) {
  // n x n cells on 6 quads, 4 x 4 on 5 and 1 on the lamp: 2 n (n + 1) edges each.
  const Snapshot room = syntheticRoom({.cells = 3, .open_front = false});
  EXPECT_EQ(elementEdges(*room.mesh).size() / 2, 6 * 24 + 5 * 40 + 4);
}

TEST(Exposure, IsFiniteAndPositiveForAnyPicture) {
  const std::vector<std::vector<glm::vec4>> pictures = {
      {},
      {{0, 0, 0, kBackgroundPixel}},
      {{0, 0, 0, kSurfacePixel}},
      {{kNan, kNan, kNan, kSurfacePixel}},
      {{kInfinity, 1, 1, kSurfacePixel}, {1, 1, 1, kSurfacePixel}},
      {{-1, -1, -1, kSurfacePixel}},
      {{1e-38f, 1e-38f, 1e-38f, kSurfacePixel}},
      {{3e38f, 3e38f, 3e38f, kSurfacePixel}}};
  for (const auto& pixels : pictures) {
    const double scale = automaticExposure(pixels);
    EXPECT_TRUE(std::isfinite(scale) && scale > 0);
    EXPECT_TRUE(std::isfinite(float(scale)) && float(scale) > 0);
  }
}

TEST(Exposure, IgnoresLampsUnlessThereIsNothingElse) {
  const glm::vec4 wall(0.5, 0.5, 0.5, kSurfacePixel);
  const glm::vec4 lamp(100, 100, 100, kEmitterPixel);
  EXPECT_EQ(automaticExposure(std::vector{wall}), automaticExposure(std::vector{wall, lamp}));
  EXPECT_NEAR(automaticExposure(std::vector{wall}) / automaticExposure(std::vector{lamp}), 200, 1e-3);
}

TEST(CameraMatrix, HoldsTheBoundsAtAnyScale) {
  for (double scale : {1e-3, 1.0, 1e6}) {
    const Bounds bounds{glm::dvec3(-1, 0, -1) * scale, glm::dvec3(1, 2, 1) * scale};
    const Camera camera = frameBounds(bounds, {0.3, -0.4, -1}, {0, 1, 0}, 40, 1.5, 1.0);
    const glm::mat4 matrix = viewProjection(camera, 1.5, bounds);
    double largest = 0;
    for (int k = 0; k < 8; ++k) {
      const glm::vec4 clip = matrix * glm::vec4(glm::vec3(bounds.corner(k)), 1.0f);
      ASSERT_GT(clip.w, 0);
      for (int i = 0; i < 3; ++i) EXPECT_LE(std::abs(clip[i] / clip.w), 1.001) << i;
      largest = std::max({largest, double(std::abs(clip.x / clip.w)), double(std::abs(clip.y / clip.w))});
    }
    EXPECT_GT(largest, 0.98) << "the bounds fill the frame";
  }
}

TEST(CameraMatrix, AWindowIsAPartOfTheFrame) {
  const Bounds bounds{glm::dvec3(-1), glm::dvec3(1)};
  const Camera camera{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40};
  const glm::vec4 p(0.3f, 0.2f, 0.1f, 1.0f);
  const glm::vec4 whole = viewProjection(camera, 1, bounds) * p;
  const glm::vec4 part = viewProjection(camera, 1, bounds, {{0.5, 0.25}, {1.0, 0.75}}) * p;
  // Screen position in 0..1 of the frame, then of the window.
  const glm::vec2 frame = 0.5f * glm::vec2(whole) / whole.w + 0.5f;
  const glm::vec2 window = 0.5f * glm::vec2(part) / part.w + 0.5f;
  EXPECT_NEAR(window.x, (frame.x - 0.5f) / 0.5f, 1e-5);
  EXPECT_NEAR(window.y, (frame.y - 0.25f) / 0.5f, 1e-5);
}

TEST(CameraBasis, SurvivesAnUpAlongTheLineOfSight) {
  for (const glm::dvec3& up : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(0)}) {
    const ViewBasis basis = viewBasis({{0, 2, 0}, {0, 0, 0}, up, 40});
    EXPECT_NEAR(glm::length(basis.right), 1, 1e-12);
    EXPECT_NEAR(glm::length(basis.up), 1, 1e-12);
    EXPECT_NEAR(glm::dot(basis.right, basis.forward), 0, 1e-12);
  }
}

}  // namespace
}  // namespace unshot
