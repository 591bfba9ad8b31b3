#include "solver/patch_solve.h"

#include <deque>

namespace unshot {
namespace {

using Field = std::vector<glm::dvec3>;

constexpr std::size_t kKeptDirections = 8;

struct Direction {
  Field x, image;
  glm::dvec3 square;
};

glm::dvec3 dot(const PatchMatrix& matrix, const Field& a, const Field& b) {
  glm::dvec3 sum(0.0);
  for (std::uint32_t q = 0; q < a.size(); ++q) sum += matrix.area(q) * a[q] * b[q];
  return sum;
}

void addScaled(Field& to, const glm::dvec3& factor, const Field& x) {
  for (std::size_t q = 0; q < to.size(); ++q) to[q] += factor * x[q];
}

glm::dvec3 ratio(const glm::dvec3& a, const glm::dvec3& b) {
  glm::dvec3 out(0.0);
  for (int c = 0; c < 3; ++c) out[c] = b[c] != 0 ? a[c] / b[c] : 0.0;
  return out;
}

}  // namespace

std::vector<glm::dvec3> solvePatches(const PatchMatrix& matrix, const std::vector<glm::dvec3>& reflectance,
                                     const std::vector<glm::dvec3>& b, double tolerance, int most) {
  Field x(b.size(), glm::dvec3(0.0)), residual = b;
  const glm::dvec3 whole = dot(matrix, b, b);
  std::deque<Direction> directions;
  for (int k = 0; k < most; ++k) {
    Direction d{residual, Field(b.size()), glm::dvec3(0.0)};
    matrix.product(d.x, d.image);
    for (std::size_t q = 0; q < b.size(); ++q) d.image[q] = d.x[q] - reflectance[q] * d.image[q];
    for (const Direction& old : directions) {
      const glm::dvec3 factor = -ratio(dot(matrix, d.image, old.image), old.square);
      addScaled(d.x, factor, old.x);
      addScaled(d.image, factor, old.image);
    }
    d.square = dot(matrix, d.image, d.image);
    const glm::dvec3 factor = ratio(dot(matrix, residual, d.image), d.square);
    addScaled(x, factor, d.x);
    addScaled(residual, -factor, d.image);
    const glm::dvec3 left = dot(matrix, residual, residual);
    bool done = true;
    for (int c = 0; c < 3; ++c) done = done && left[c] <= tolerance * tolerance * whole[c];
    if (done) break;
    if (directions.size() >= kKeptDirections) directions.pop_front();
    directions.push_back(std::move(d));
  }
  return x;
}

}  // namespace unshot
