// Pictures that the program wrote, compared as a person would: by their bytes, by light, by pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "export/image_files.h"
#include "support/run_program.h"

namespace unshot::testing_support {

/// RMS(a - b) / RMS(b) of linear light, as `unshot compare` has it; infinite where sizes differ.
inline double lightDifference(const ImageF& a, const ImageF& b) {
  if (a.width != b.width || a.height != b.height) return INFINITY;
  double difference = 0, light = 0;
  for (std::size_t k = 0; k < b.rgb.size(); ++k) {
    const double x = a.rgb[k], y = b.rgb[k];
    difference += (x - y) * (x - y);
    light += y * y;
  }
  return light > 0 ? std::sqrt(difference / light) : difference > 0 ? INFINITY : 0;
}

/// Runs `unshot view --gl osmesa` with a script of these lines and further arguments.
inline ProgramResult runScript(const TempFolder& folder, const std::string& lines,
                               const std::vector<std::string>& arguments) {
  folder.write("script.txt", lines);
  std::vector<std::string> all{"view", "--gl", "osmesa", "--script", "script.txt"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return runProgram(folder, all);
}

inline ImageF picture(const TempFolder& folder, const std::string& name) {
  return readImage(folder.path() / name);
}

/// Over all pixels and channels; tells a darker exposure from other noise.
inline double meanLight(const ImageF& image) {
  double sum = 0;
  for (const float v : image.rgb) sum += v;
  return sum / static_cast<double>(std::max<std::size_t>(image.rgb.size(), 1));
}

/// Not one even colour.
inline bool showsSomething(const ImageF& image) {
  for (std::size_t k = 3; k < image.rgb.size(); ++k) {
    if (image.rgb[k] != image.rgb[k % 3]) return true;
  }
  return false;
}

}  // namespace unshot::testing_support
