// Texts of a plot, kept apart.
#pragma once

#include <imgui.h>

#include <span>
#include <string>
#include <vector>

namespace unshot {

/// Texts in a rectangle, none over another, none cut off: what finds no room is left out, so what matters
/// most is placed first. Uses ImGui's current font.
class PlotLabels {
 public:
  struct Label {
    std::string text;
    ImVec2 min, max;
    ImU32 colour = 0;
  };

  /// `gap` pixels at least lie between texts side by side.
  PlotLabels(ImVec2 min, ImVec2 max, float gap) : min_(min), max_(max), gap_(gap) {}

  /// Where the text would be: its point `align` (0..1 from the upper left) at `at`, moved into the rectangle.
  Label arranged(const std::string& text, ImVec2 at, ImVec2 align, ImU32 colour) const;
  /// Places it there; false where it does not fit or another is in the way.
  bool place(const std::string& text, ImVec2 at, ImVec2 align, ImU32 colour);
  std::span<const Label> placed() const { return labels_; }
  void draw(ImDrawList& list) const;

 private:
  ImVec2 min_, max_;
  float gap_;
  std::vector<Label> labels_;
};

}  // namespace unshot
