// What a user has made of the scene's materials, with the way back.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace unshot {

class MaterialEdits {
 public:
  using Materials = std::vector<Material>;

  /// Of a scene that was just opened.
  void begin(Materials materials);
  /// As they are meant to be.
  const Materials& materials() const { return now_; }
  bool edited() const { return now_ != opened_; }
  /// They are in a file as they are now.
  void noteSaved() { saved_ = now_; }
  /// Whether what was made of them is nowhere else.
  bool unsaved() const { return edited() && now_ != saved_; }
  bool canUndo() const { return !before_.empty(); }
  bool canRedo() const { return !after_.empty(); }
  /// Index of the material of this name. Throws a usage Error that lists them.
  std::size_t find(std::string_view name) const;

  /// What is set within one gesture (when that began; none: each by itself) is undone together.
  void setReflectance(std::size_t material, const glm::dvec3& rho, std::optional<double> gesture = {});
  void setEmission(std::size_t material, const glm::dvec3& e, std::optional<double> gesture = {});
  /// Off: no emission. On: what it last had or, where it never had any, the mean of the other lights.
  void setLight(std::size_t material, bool on);
  void undo();
  void redo();
  /// All as they were opened; can be undone.
  void reset();
  /// What the solve has, where it took an edit back.
  void adopt(Materials materials);

 private:
  void remember(std::optional<double> gesture);
  glm::dvec3 usualEmission(std::size_t material) const;

  Materials opened_, now_, saved_;
  std::vector<Materials> before_, after_;
  std::vector<glm::dvec3> last_emission_;  // one per material; 0: it had none so far
  std::optional<double> gesture_;          // of the last edit
};

}  // namespace unshot
