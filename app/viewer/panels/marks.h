// Marks over the pictures of the scene: bright with a dark rim, to be seen on anything.
#pragma once

#include <imgui.h>

#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "viewer/viewer.h"

namespace unshot {

/// One of the pictures that marks are drawn over.
struct MarkedPicture {
  Camera camera;
  float left = 0, width = 0, height = 0;

  /// Where a point of the scene is, in pixels of the window.
  std::optional<ImVec2> at(const glm::dvec3& point) const {
    const auto place = placeInPicture(camera, static_cast<double>(width / height), point);
    // What is far outside would be no number of pixels.
    if (!place || std::abs(place->x) > 100 || std::abs(place->y) > 100) return std::nullopt;
    return ImVec2(left + width * static_cast<float>(place->x), height * static_cast<float>(place->y));
  }
};

/// Calls `draw` for each picture, its part of the window being the clip rectangle.
void forEachMarkedPicture(const Viewer& viewer, int scene_width,
                          const std::function<void(ImDrawList&, const MarkedPicture&)>& draw);

/// Fills triangles, three corners each, so that what lies below is still seen.
void markFilled(ImDrawList& list, const MarkedPicture& picture, std::span<const glm::vec3> corners,
                ImU32 colour);

void markOutline(ImDrawList& list, const MarkedPicture& picture,
                 std::span<const std::pair<glm::vec3, glm::vec3>> edges, ImU32 colour);

}  // namespace unshot
