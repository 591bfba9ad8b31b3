// Snapshots uploaded in parts.
#include "render/uploads.h"

#include <gtest/gtest.h>

#include "gl/context.h"
#include "render/scene_view.h"
#include "support/synthetic_room.h"

namespace unshot {
namespace {

ViewOptions picture(const DisplayMode& mode, bool indirect) {
  ViewOptions options;
  options.display = mode.info.key;
  options.light.indirect = indirect;
  return options;
}

TEST(Uploads, ASnapshotInPartsAfterOneThatWasGivenUpIsDrawnWhole) {
  const std::unique_ptr<gl::Context> context = gl::createContext("osmesa");
  context->makeCurrent();
  const Snapshot room = testing_support::syntheticRoom();
  const auto lit = [&](float light) {
    auto snapshot = std::make_shared<Snapshot>(room);
    const auto field = [&](std::size_t count, float value) {
      return std::make_shared<const std::vector<glm::vec3>>(count, glm::vec3(value * light));
    };
    const std::size_t vertices = room.irradiance.size(), elements = room.element_irradiance.size();
    for (auto* values : {&snapshot->irradiance, &snapshot->ambient, &snapshot->unshot})
      for (glm::vec3& v : *values) v *= light;
    for (glm::vec3& v : snapshot->element_irradiance) v *= light;
    snapshot->direct = field(vertices, 0.3f);
    snapshot->element_direct = field(elements, 0.2f);
    snapshot->bounces = field(vertices, 1.1f);
    snapshot->residual = field(vertices, 0.1f);
    return snapshot;
  };
  const auto first = lit(1), second = lit(2);
  SceneView whole(*context), parts(*context);
  whole.setSnapshot(*first);
  const auto begin_all = [&](const std::shared_ptr<const Snapshot>& snapshot) {
    parts.beginSnapshot(snapshot);
    for (const DisplayMode& mode : displayModes()) {
      for (const bool indirect : {true, false}) parts.beginLight(picture(mode, indirect));
    }
  };
  begin_all(second);
  const std::size_t bytes = parts.uploadBytes();
  for (std::size_t given_up = 1; given_up < 2 * bytes; given_up += bytes / 7) {
    begin_all(second);
    parts.upload(given_up);
    begin_all(first);
    int calls = 0;
    for (; parts.uploadBytes() > 0; ++calls) parts.upload(100);
    EXPECT_GT(calls, 4);
    for (const DisplayMode& mode : displayModes()) {
      for (const bool indirect : {true, false}) {
        const ViewOptions options = picture(mode, indirect);
        const auto pixels = [&](SceneView& view) {
          const LinearTarget target(*context, 32, 24);
          target.bind();
          view.drawLinear({{0, 1, 3}, {0, 1, 0}, {0, 1, 0}, 40}, 4.0 / 3, {}, options);
          return target.read();
        };
        EXPECT_EQ(pixels(parts), pixels(whole)) << mode.info.key << " after " << given_up << " bytes";
      }
    }
  }
}

// Bytes: 12 for a value of a vertex, 16 for one of an element.
TEST(Uploads, APictureSendsWhatItReadsOnce) {
  const std::unique_ptr<gl::Context> context = gl::createContext("osmesa");
  context->makeCurrent();
  auto first = std::make_shared<Snapshot>(testing_support::syntheticRoom());
  first->direct = std::make_shared<const std::vector<glm::vec3>>(first->irradiance.size(), glm::vec3(0.5f));
  const auto second = std::make_shared<const Snapshot>(*first);
  const std::size_t of_vertices = 12 * first->mesh->vertices.size(),
                    of_elements = 16 * first->mesh->element_count;
  SceneView view(*context);
  view.setSnapshot(*first);
  const auto sends = [&](const char* display, bool ambient, bool indirect = true) {
    ViewOptions options = picture(displayMode(display), indirect);
    options.ambient = ambient;
    view.beginLight(options);
    const std::size_t bytes = view.uploadBytes();
    view.upload(bytes);
    return bytes;
  };
  EXPECT_EQ(sends("emission", true), 0u);
  EXPECT_EQ(sends("reflectance", true), 0u);
  EXPECT_EQ(sends("radiosity", false), of_vertices);
  EXPECT_EQ(sends("irradiance", false), 0u) << "it reads the same";
  EXPECT_EQ(sends("radiosity", true), of_vertices) << "the ambient term";
  EXPECT_EQ(sends("flat", true), of_elements);
  EXPECT_EQ(sends("unshot", true), of_vertices);
  EXPECT_EQ(sends("radiosity", true, false), of_vertices) << "direct light";
  view.beginSnapshot(second);
  EXPECT_EQ(sends("radiosity", false), of_vertices);
  EXPECT_EQ(sends("radiosity", true, false), 0u) << "direct light is that of the snapshot before";
}

}  // namespace
}  // namespace unshot
