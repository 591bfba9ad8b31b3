#include "viewer/widgets.h"

#include <algorithm>

namespace unshot {

bool section(const char* title) { return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen); }

void tooltip(std::string_view text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(20 * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void label(const char* text, std::string_view tip) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  tooltip(tip);
  ImGui::SameLine(6.6f * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1);
}

void dot(const ImVec4& colour) {
  const float size = ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 0.35f * size, at.y + 0.55f * size}, 0.28f * size,
                                              ImGui::GetColorU32(colour));
  ImGui::Dummy({0.8f * size, size});
  ImGui::SameLine(0, 0);
}

void line(const char* name, const std::string& value, std::string_view tip) {
  ImGui::TextDisabled("%s", name);
  tooltip(tip);
  const float width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::SameLine(std::max(ImGui::GetContentRegionMax().x - width, 6.6f * ImGui::GetFontSize()));
  ImGui::TextUnformatted(value.c_str());
}

}  // namespace unshot
