// Arguments to try all actions with.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace unshot::testing_support {

/// For each action an argument that it must take; actions without one are not listed. Pictures and solutions
/// that are read are to be there: picture.png, solution.ply.
inline const std::map<std::string_view, std::string>& validArguments() {
  static const std::string scenes = std::string(UNSHOT_SOURCE_DIR) + "/assets/";
  static const std::map<std::string_view, std::string> arguments{
      {"open", scenes + "two_patches.obj"},
      {"pause", "on"},
      {"step", "2"},
      {"browse", scenes},
      {"actions", "bounces 2"},
      {"clean", "on"},
      {"full-screen", "off"},
      {"watch", "on"},
      {"mode", "jacobi"},
      {"race", "southwell"},
      {"form-factors", "hemicube"},
      {"elements", "300"},
      {"emit", "front"},
      {"keep", "500"},
      {"do", "triangles on"},
      {"do-all", "off"},
      {"left-out", "on"},
      {"sky", "0.5,0.5,1"},
      {"hemicube", "32"},
      {"error", "0.02"},
      {"display", "flat"},
      {"radiosity", "off"},
      {"ambient", "off"},
      {"exposure", "-1.5"},
      {"lock-exposure", "on"},
      {"camera", "278,273,-800,278,273,0,39"},
      {"view", "top"},
      {"projection", "orthographic"},
      {"fov", "50"},
      {"speed", "2"},
      {"camera-preset", "cornell"},
      {"orbit", "30,-10"},
      {"pan", "0.1,0.05"},
      {"zoom", "-2"},
      {"fly", "0.1,0,-0.2"},
      {"give-up", "2"},
      {"matrix-cell", "2,1"},
      {"hemicube-pixel", "0.5,0.25"},
      {"copy-camera", "options"},
      {"panel", "off"},
      {"help", "on"},
      {"notes", "on"},
      {"section", "messages on"},
      {"status", "off"},
      {"tone", "filmic"},
      {"histogram", "on"},
      {"reference-picture", "picture.png"},
      {"wipe", "0.25"},
      {"picture-difference", "on"},
      {"plot", "rows"},
      {"bounces", "2"},
      {"bounce-alone", "2"},
      {"reference", "solution.ply"},
      {"size", "400x300"},
      {"scale", "1.5"},
      {"screenshot", "with.png"},
      {"screenshot-scene", "without.png"},
      {"save-solve", "with.unshot"},
      {"material", "floor"},
      {"reflectance", "floor 0.5,0.25,0"},
      {"emission", "floor 1,0,0.5"},
      {"light", "floor off"},
      {"save-materials", "with.mtl"},
      {"materials", "on"},
      {"unit", "683"},
      {"isolines", "off"},
      {"logarithmic", "on"},
      {"pick", "0.5,0.6"},
      {"unpin-probe", "1"},
      {"save-probes", "with.csv"},
      {"hemicube-view", "on"},
      {"hemicube-picture", "shares"},
      {"lecture", "on"},
      {"lecture-page", "shots"},
      {"matrix-power", "7"},
      {"matrix-sums", "on"},
      {"matrix-channel", "blue"},
      {"allow-divergence", "on"},
      {"matrix-factor", "1.5"},
      {"matrix-reflectance", "1.1"},
  };
  return arguments;
}

}  // namespace unshot::testing_support
