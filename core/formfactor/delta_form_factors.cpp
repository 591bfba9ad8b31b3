#include "formfactor/delta_form_factors.h"

#include <cmath>
#include <numbers>

namespace unshot {
namespace {

// Rectangle [0, x] x [0, y] in the plane at distance 1, seen by a point below its corner that faces it.
double topCorner(double x, double y) {
  const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * std::numbers::pi);
}

// Integral of z / (pi (1 + y^2 + z^2)^2), the side face at distance 1, up to terms that cancel in
// differences.
double sideCorner(double y, double z) {
  const double p = std::sqrt(1 + z * z);
  return -std::atan(y / p) / (2 * std::numbers::pi * p);
}

template <class Corner>
double rectangle(Corner corner, double x0, double x1, double y0, double y1) {
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

}  // namespace

std::vector<double> deltaFormFactors(HemicubeLayout layout) {
  const std::uint32_t n = layout.resolution;
  const double step = 2.0 / n;
  std::vector<double> out(std::size_t{layout.width()} * layout.height());
  for (std::uint32_t face = 0; face < 5; ++face) {
    for (std::uint32_t j = 0; j < layout.faceHeight(face); ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        const double x0 = -1 + i * step, x1 = -1 + (i + 1) * step;
        double& value = out[std::size_t{layout.faceRow(face) + j} * n + i];
        value = face == 0 ? rectangle(topCorner, x0, x1, -1 + j * step, -1 + (j + 1) * step)
                          : rectangle(sideCorner, x0, x1, j * step, (j + 1) * step);
      }
    }
  }
  double sum = 0;
  for (const double value : out) sum += value;
  for (double& value : out) value /= sum;  // removes rounding only: the sum is 1 to 1e-12
  return out;
}

}  // namespace unshot
