#include "render/display_modes.h"

#include <array>

namespace unshot {

std::span<const DisplayMode> displayModes() {
  static constexpr std::array<DisplayMode, 18> table = {{
      {.info = {"radiosity", "Radiosity", "light as it leaves the surfaces, B = E + rho H, smooth"}},
      {.info = {"flat", "Radiosity per element", "each element in its own radiosity, as the solver sees it"},
       .per_element = true},
      {.info = {"irradiance", "Irradiance", "light as it arrives, H: the picture without the materials"},
       .quantity = Quantity::kIrradiance},
      {.info = {"false-irradiance", "Irradiance in false colour",
                "light as it arrives, H, as a scale of colours with a legend and isolines"},
       .quantity = Quantity::kIrradiance,
       .false_colour = true},
      {.info = {"false-radiosity", "Radiosity in false colour",
                "light as it leaves, B, as a scale of colours with a legend and isolines"},
       .false_colour = true},
      {.info = {"unshot", "Unshot radiosity", "light still to be shot, U (where it is negative: blue)"},
       .quantity = Quantity::kUnshot},
      {.info =
           {"false-unshot", "Unshot radiosity in false colour",
            "light still to be shot, U, as a scale of colours with a legend: above 0 orange, below it blue"},
       .quantity = Quantity::kUnshot,
       .false_colour = true,
       .diverging = true},
      {.info = {"emission", "Emission", "the light sources alone, E"}, .quantity = Quantity::kEmission},
      {.info = {"reflectance", "Reflectance", "the colours of the materials, rho, from black 0 to white 1"},
       .quantity = Quantity::kReflectance,
       .tone_mapped = false,
       .exposed = false},
      {.info = {"bounces", "Expected bounces",
                "how many surfaces light from here meets on average, v of (I - M) v = 1, as a scale of "
                "colours; black until it is known"},
       .quantity = Quantity::kBounces,
       .false_colour = true},
      {.info = {"residual", "Error of the mesh",
                "where the mesh is worst: residual of the continuous equation at random points, as a scale "
                "of colours; black where it is not known"},
       .quantity = Quantity::kResidual,
       .false_colour = true},
      {.info =
           {"difference", "Difference",
            "what is shown minus what was remembered, else minus direct light: brighter is orange, darker "
            "blue"},
       .quantity = Quantity::kDifference,
       .false_colour = true,
       .diverging = true},
      {.info =
           {"form-factors", "Form factors of a patch",
            "how much each place gets of what the picked patch sends, G_ij over the area of j, as a scale "
            "of colours; black until a patch is picked"},
       .quantity = Quantity::kFormFactors,
       .false_colour = true},
      {.info = {"last-shot", "Last shot",
                "what the last single step added to B, as a scale of colours: above 0 orange, below it blue; "
                "dark until one was taken"},
       .quantity = Quantity::kLastShot,
       .false_colour = true,
       .diverging = true},
      {.info = {"mesh", "Mesh", "radiosity with the edges of the elements"}, .edges = true},
      {.info = {"patches", "Patches", "what shoots: each patch in a colour that its neighbours do not have"},
       .quantity = Quantity::kPatches,
       .per_element = true,
       .tone_mapped = false,
       .exposed = false},
      {.info =
           {"sides", "Front and back",
            "fronts blue, backs orange, by the winding in the file: where it is mixed up is seen at once"},
       .quantity = Quantity::kSides,
       .tone_mapped = false,
       .exposed = false},
      {.info = {"normals", "Normals",
                "where surfaces face: x red, y green, z blue, from dark (against it) to light (along it)"},
       .quantity = Quantity::kNormals,
       .tone_mapped = false,
       .exposed = false},
  }};
  return table;
}

const DisplayMode& displayMode(std::string_view key) {
  return findChoice(displayModes(), key, "display mode");
}

}  // namespace unshot
