// Actions: the camera.
#include "viewer/actions/action_groups.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "viewer/actions/action_arguments.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

void runCamera(Viewer& viewer, const std::string& text) {
  const std::vector<double> n = numbersOf(text);
  viewer.setCamera({n[0], n[1], n[2]}, {n[3], n[4], n[5]},
                   n.size() == 7 ? std::optional<double>(n[6]) : std::nullopt);
}

}  // namespace

std::span<const Action> cameraActions() {
  static constexpr auto kActions = std::to_array<Action>({
      {"frame",
       "",
       "Back to the camera chosen for the scene",
       {GLFW_KEY_F, false, "F"},
       [](Viewer& v, const std::string&) { v.frameScene(); },
       nullptr,
       true},
      {"camera",
       "EX,EY,EZ,AX,AY,AZ[,FOV]",
       "Stand at E and look at A, in the file's coordinates",
       {},
       runCamera,
       checkCamera,
       true},
  });
  return kActions;
}

}  // namespace unshot
