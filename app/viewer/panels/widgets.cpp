#include "viewer/panels/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/parse.h"
#include "base/text.h"

namespace unshot {

bool section(const char* title) { return ImGui::CollapsingHeader(title); }

void tooltip(std::string_view text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  // No wider than the window has room for.
  const float room = ImGui::GetIO().DisplaySize.x - 2 * ImGui::GetStyle().WindowPadding.x - 4;
  wrapped(std::string(text), std::min(20 * ImGui::GetFontSize(), room));
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
  const float start = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x;
  const float end = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + 0.5f * ImGui::GetFontSize();
  // Below the name, where both have no room.
  if (start > end) ImGui::SameLine();
  ImGui::SetCursorPosX(std::max(start, ImGui::GetCursorStartPos().x));
  ImGui::TextUnformatted(value.c_str());
  tooltip(tip);
}

std::string superscript(std::size_t number) {
  static constexpr std::array<const char*, 10> kDigits = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                          "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string out;
  for (const char digit : std::to_string(number)) out += kDigits[static_cast<std::size_t>(digit - '0')];
  return out;
}

std::string channelText(double value) {
  const double size = std::abs(value);
  if (value == 0 || (size >= 1e-3 && size < 1e5)) return figureText(value);
  char text[32];
  std::snprintf(text, sizeof text, size < 1e-9 || size >= 1e10 ? "%.1e" : "%.2e", value);
  const std::string digits(text);
  const std::size_t exponent = digits.find('e') + 1;
  if (exponent == 0) return digits;  // no number
  return digits.substr(0, exponent) + std::to_string(std::stoi(digits.substr(exponent)));
}

float channelWidth() {
  return std::max(ImGui::CalcTextSize("-0.00123").x, ImGui::CalcTextSize("-1.2e-12").x);
}

void rightAligned(const std::string& text, bool dim) {
  const float space = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (space > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + space);
  if (dim) {
    ImGui::TextDisabled("%s", text.c_str());
  } else {
    ImGui::TextUnformatted(text.c_str());
  }
}

void wrapped(const std::string& text, float width) {
  const std::string lines = brokenText(text, width > 0 ? width : ImGui::GetContentRegionAvail().x);
  ImGui::PushTextWrapPos(width > 0 ? ImGui::GetCursorPosX() + width + 1 : 0);  // for words that are wider
  ImGui::TextUnformatted(lines.c_str());
  ImGui::PopTextWrapPos();
}

void dimmed(const std::string& text, float width) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  wrapped(text, width);
  ImGui::PopStyleColor();
}

void paragraph(const char* name, std::string_view text) {
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(ImGui::GetCursorPosX() + 3.2f * ImGui::GetFontSize());
  wrapped(std::string(text));
}

namespace {

/// How much of the word is no wider than this: whole characters, one at least, up to its last slash where
/// that is not far back.
std::size_t fittingPart(std::string_view word, float width) {
  const auto begins = [&](std::size_t k) { return (static_cast<unsigned char>(word[k]) & 0xc0u) != 0x80u; };
  std::size_t fits = 0, slash = 0;
  for (std::size_t end = 1; end <= word.size(); ++end) {
    if (end < word.size() && !begins(end)) continue;
    if (fits > 0 && ImGui::CalcTextSize(word.data(), word.data() + end).x > width) break;
    fits = end;
    if (word[end - 1] == '/') slash = end;
  }
  return fits < word.size() && 2 * slash > fits ? slash : fits;
}

}  // namespace

std::string brokenText(std::string_view text, float width) {
  std::string out;
  for (const std::string_view given : splitParts(text, '\n')) {
    std::string line;
    for (std::string_view word : splitParts(given, ' ')) {
      while (ImGui::CalcTextSize(word.data(), word.data() + word.size()).x > width) {
        const std::size_t part = fittingPart(word, width);
        if (part == word.size()) break;
        if (!line.empty()) out += line + "\n";
        line.clear();
        out += std::string(word.substr(0, part)) + "\n";
        word.remove_prefix(part);
      }
      const std::string longer = line.empty() ? std::string(word) : line + " " + std::string(word);
      if (!line.empty() && ImGui::CalcTextSize(longer.c_str()).x > width) {
        out += line + "\n";
        line = word;
      } else {
        line = longer;
      }
    }
    out += line + "\n";
  }
  if (!out.empty()) out.pop_back();
  return out;
}

std::string shortened(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string out = text;
  while (!out.empty() && ImGui::CalcTextSize((out + "\u2026").c_str()).x > width) {
    // Whole characters of UTF-8.
    while (out.size() > 1 && (static_cast<unsigned char>(out.back()) & 0xc0u) == 0x80u) out.pop_back();
    out.pop_back();
  }
  return out + "\u2026";
}

bool beginCombo(const char* id, const std::string& shown) {
  const float room = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - 2 * ImGui::GetStyle().FramePadding.x;
  const std::string preview = shortened(shown, room);
  const bool open = ImGui::BeginCombo(id, preview.c_str(), ImGuiComboFlags_HeightLarge);
  if (!open && preview != shown) tooltip(shown);
  return open;
}

}  // namespace unshot
