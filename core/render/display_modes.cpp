#include "render/display_modes.h"

#include <array>

namespace unshot {

std::span<const DisplayMode> displayModes() {
  static constexpr std::array<DisplayMode, 7> table = {{
      {.info = {"radiosity", "Radiosity", "light as it leaves the surfaces, B = E + rho H, smooth"}},
      {.info = {"flat", "Radiosity per element", "each element in its own radiosity, as the solver sees it"},
       .per_element = true},
      {.info = {"irradiance", "Irradiance", "light as it arrives, H: the picture without the materials"},
       .quantity = Quantity::kIrradiance},
      {.info = {"unshot", "Unshot radiosity", "light still to be shot, U (where it is negative: blue)"},
       .quantity = Quantity::kUnshot},
      {.info = {"emission", "Emission", "the light sources alone, E"}, .quantity = Quantity::kEmission},
      {.info = {"reflectance", "Reflectance", "the colours of the materials, rho, from black 0 to white 1"},
       .quantity = Quantity::kReflectance,
       .tone_mapped = false},
      {.info = {"mesh", "Mesh", "radiosity with the edges of the elements"}, .edges = true},
  }};
  return table;
}

const DisplayMode& displayMode(std::string_view key) {
  return findChoice(displayModes(), key, "display mode");
}

}  // namespace unshot
