#include "session/scene_checks.h"

#include <array>

namespace unshot {

std::span<const SceneCheckRow> sceneChecks() {
  using enum CheckTime;
  static constexpr std::array kTable = {
      SceneCheckRow{{"light-faces-wall", "lights that face a wall",
                     "a surface directly before a light, or in its plane, so that nothing of it gets out"},
                    kEverySolve,
                    checkLightsThatFaceWalls},
      SceneCheckRow{{"light-in-solid", "lights inside a solid",
                     "a light that shines on backs only, in a space that it does not leave"},
                    kEverySolve,
                    checkLightsInSolids},
      SceneCheckRow{
          {"light-sees-nothing", "lights that see nothing", "a light of which no surface receives any"},
          kEverySolve,
          checkLightsThatSeeNothing},
      SceneCheckRow{{"scale", "odd scale",
                     "a scene too small or large for metres, or so far from the origin that digits are lost"},
                    kEverySolve,
                    checkScale},
      SceneCheckRow{{"nearly-touching", "surfaces that nearly touch",
                     "parallel surfaces with a gap far below what matters to light"},
                    kOnlyCheck,
                    checkNearlyTouching},
      SceneCheckRow{{"mixed-winding", "mixed winding",
                     "neighbouring faces, one with its front where the other has its back"},
                    kOnlyCheck,
                    checkWinding},
      SceneCheckRow{
          {"closed", "ways out of the scene", "edges with an open side, and the light that escapes"},
          kOnlyCheck,
          checkClosed},
      SceneCheckRow{{"spectral-radius", "light that hardly fades",
                     "reflectances so high that the light of hundreds of bounces counts"},
                    kOnlyCheck,
                    checkSpectralRadius},
  };
  return kTable;
}

Diagnostics checkScene(CheckedScene& scene, CheckTime time) {
  Diagnostics out;
  for (const SceneCheckRow& row : sceneChecks()) {
    if (row.time != time) continue;
    scene.cancel().check();
    for (Diagnostic& found : row.look(scene)) {
      found.code = row.info.key;
      out.push_back(std::move(found));
    }
  }
  return out;
}

}  // namespace unshot
