// A scene of as many triangles as are wanted, none of which join: it takes long to load.
#pragma once

#include <cmath>
#include <string>

namespace unshot::testing_support {

/// To be written as land.mtl beside it.
inline constexpr const char* kLandscapeMaterials =
    "newmtl ground\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n";

/// A wavy ground of 2 n^2 triangles under a lamp.
inline std::string landscape(int n) {
  std::string text = "mtllib land.mtl\nusemtl ground\n";
  const auto number = [](double x) { return " " + std::to_string(x); };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = 10.0 * i / n, z = 10.0 * j / n;
      text += "v" + number(x) + number(std::sin(3 * x) * std::cos(2 * z)) + number(z) + "\n";
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const std::string a = " " + std::to_string(j * (n + 1) + i + 1),
                        b = " " + std::to_string(j * (n + 1) + i + 2),
                        c = " " + std::to_string((j + 1) * (n + 1) + i + 1),
                        d = " " + std::to_string((j + 1) * (n + 1) + i + 2);
      text.append("f").append(a).append(c).append(b).append("\nf").append(b).append(c).append(d).append("\n");
    }
  }
  return text + "v 4 3 4\nv 6 3 4\nv 6 3 6\nv 4 3 6\nusemtl lamp\nf -4 -3 -2 -1\n";
}

}  // namespace unshot::testing_support
