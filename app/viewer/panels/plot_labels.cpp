#include "viewer/panels/plot_labels.h"

#include <algorithm>
#include <cmath>

namespace unshot {

PlotLabels::Label PlotLabels::arranged(const std::string& text, ImVec2 at, ImVec2 align, ImU32 colour) const {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  // Whole pixels: the font is sharpest there.
  const float x = std::floor(std::max(min_.x, std::min(at.x - align.x * size.x, max_.x - size.x)));
  const float y = std::floor(std::max(min_.y, std::min(at.y - align.y * size.y, max_.y - size.y)));
  return {text, {x, y}, {x + size.x, y + size.y}, colour};
}

bool PlotLabels::place(const std::string& text, ImVec2 at, ImVec2 align, ImU32 colour) {
  if (text.empty()) return false;
  const Label label = arranged(text, at, align, colour);
  if (label.max.x > max_.x || label.max.y > max_.y) return false;
  for (const Label& other : labels_) {
    if (label.min.x < other.max.x + gap_ && other.min.x < label.max.x + gap_ && label.min.y < other.max.y &&
        other.min.y < label.max.y) {
      return false;
    }
  }
  labels_.push_back(label);
  return true;
}

void PlotLabels::draw(ImDrawList& list) const {
  // Curves that run behind a text are dimmed there.
  const ImU32 dim = ImGui::GetColorU32(ImGuiCol_WindowBg, 0.7f);
  for (const Label& label : labels_) {
    list.AddRectFilled({label.min.x - 2, label.min.y}, {label.max.x + 2, label.max.y}, dim, 3);
    list.AddText(label.min, label.colour, label.text.c_str());
  }
}

}  // namespace unshot
