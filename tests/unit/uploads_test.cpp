// Snapshots uploaded in parts.
#include "render/uploads.h"

#include <gtest/gtest.h>

#include "gl/context.h"
#include "render/scene_view.h"
#include "support/synthetic_room.h"

namespace unshot {
namespace {

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
  parts.beginSnapshot(second);
  const std::size_t bytes = parts.uploadBytes();
  for (std::size_t given_up = 1; given_up < 2 * bytes; given_up += bytes / 7) {
    parts.beginSnapshot(second);
    parts.upload(given_up);
    parts.beginSnapshot(first);
    int calls = 0;
    for (; parts.uploadBytes() > 0; ++calls) parts.upload(100);
    EXPECT_GT(calls, 4);
    for (const DisplayMode& mode : displayModes()) {
      for (const bool indirect : {true, false}) {
        ViewOptions options;
        options.display = mode.info.key;
        options.light.indirect = indirect;
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

}  // namespace
}  // namespace unshot
