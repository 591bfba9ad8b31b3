// Scenes that nobody would think of: boxes, reflectances, lights, winding, scale and place at random.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "scene/analytic_scenes.h"
#include "support/dice.h"

namespace unshot::testing_support {

/// The same for the same seed: a room with walls of which some may be missing, in it up to six boxes and
/// loose quadrilaterals that may stand apart, touch or pass through each other, one or a few lights among
/// them, each polygon wound either way; reflectances up to 0.99 a channel, some of them black; emission of
/// any colour; from a millimetre to ten kilometres large, away from the origin by up to a hundred of its
/// sizes.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : dice_(seed) {
    scale_ = std::pow(10.0, dice_.between(-3, 4));
    shift_ = dice_.uniform() < 0.5 ? glm::dvec3(0.0) : dice_.inCube(100 * scale_);
    turn_ = dice_.uniform() < 0.5 ? glm::dmat3(1.0) : dice_.rotation();
    const std::uint32_t count = 2 + dice_.below(5);
    for (std::uint32_t k = 0; k < count; ++k) materials_.push_back(addMaterial(k));
    const glm::dvec3 size(dice_.between(0.3, 2), dice_.between(0.3, 2), dice_.between(0.3, 2));
    const bool closed = dice_.uniform() < 0.5;
    box(-size, glm::dmat3(1.0), 2.0 * size, closed ? 0 : 0.3, kNone);
    const std::uint32_t boxes = dice_.below(7);
    for (std::uint32_t k = 0; k < boxes; ++k) {
      const glm::dmat3 turn = dice_.uniform() < 0.5 ? glm::dmat3(1.0) : dice_.rotation();
      const glm::dvec3 edges(dice_.between(0.02, 0.8), dice_.between(0.02, 0.8), dice_.between(0.02, 0.8));
      box(dice_.inCube(1) * size - edges / 2.0, turn, edges, 0.1, kNone);
    }
    const std::uint32_t lights = 1 + dice_.below(3);
    for (std::uint32_t k = 0; k < lights; ++k) {
      const glm::dvec3 emission = dice_.inCube(1) + glm::dvec3(1.0);
      const auto light = builder_.material("light" + std::to_string(k), glm::dvec3(0.5),
                                           std::pow(10.0, dice_.between(-2, 3)) * emission);
      const glm::dmat3 turn = dice_.uniform() < 0.5 ? glm::dmat3(1.0) : dice_.rotation();
      const glm::dvec3 edges(dice_.between(0.05, 0.5), dice_.between(0.05, 0.5), dice_.between(0.05, 0.5));
      if (dice_.uniform() < 0.3) {
        box(0.9 * dice_.inCube(1) * size - edges / 2.0, turn, edges, 0, light);
      } else {
        quad(light, 0.9 * dice_.inCube(1) * size, turn[0] * edges.x, turn[1] * edges.y);
      }
    }
  }

  Scene scene() { return builder_.finish(); }

 private:
  std::uint32_t addMaterial(std::uint32_t number) {
    glm::dvec3 reflectance;
    for (int c = 0; c < 3; ++c) {
      const double kind = dice_.uniform();
      reflectance[c] = kind < 0.1 ? 0.0 : kind < 0.2 ? 0.99 : dice_.between(0, 0.99);
    }
    return builder_.material("m" + std::to_string(number), reflectance);
  }

  void quad(std::uint32_t material, const glm::dvec3& corner, glm::dvec3 a, glm::dvec3 b) {
    if (dice_.uniform() < 0.5) std::swap(a, b);
    builder_.quad(material, place(corner), scale_ * (turn_ * a), scale_ * (turn_ * b));
  }

  /// `missing`: how likely each face is left out. kNone: a material of each face's own.
  void box(const glm::dvec3& corner, const glm::dmat3& turn, const glm::dvec3& edges, double missing,
           std::uint32_t material) {
    const glm::dvec3 e[3] = {turn[0] * edges.x, turn[1] * edges.y, turn[2] * edges.z};
    for (int axis = 0; axis < 3; ++axis) {
      for (const double end : {0.0, 1.0}) {
        if (dice_.uniform() < missing) continue;
        const auto number = dice_.below(static_cast<std::uint32_t>(materials_.size()));
        quad(material == kNone ? materials_[number] : material, corner + end * e[axis], e[(axis + 1) % 3],
             e[(axis + 2) % 3]);
      }
    }
  }

  glm::dvec3 place(const glm::dvec3& p) const { return scale_ * (turn_ * p) + shift_; }

  Dice dice_;
  SceneBuilder builder_;
  double scale_ = 1;
  glm::dvec3 shift_{0.0};
  glm::dmat3 turn_{1.0};
  std::vector<std::uint32_t> materials_;
};

}  // namespace unshot::testing_support
