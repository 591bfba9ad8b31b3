#include "viewer/panels/theme.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace unshot {

/// The font's file. Defined by a source that the build writes.
std::span<const unsigned char> guiFont();

namespace {

constexpr float kFontPixels = 15;
constexpr float kSmallestFontPixels = 8;

/// The characters of assets/fonts/Roboto-Regular.ttf, in pairs; ImGui wants a null at the end, and reads them
/// when the atlas is built.
constexpr ImWchar kCharacters[] = {
    0x0020, 0x007e, 0x00a0, 0x017f, 0x0391, 0x03a1, 0x03a3, 0x03c9, 0x2010, 0x2027, 0x2030, 0x2044, 0x2070,
    0x2071, 0x2074, 0x2089, 0x20ac, 0x20ac, 0x2202, 0x2202, 0x2206, 0x2206, 0x220f, 0x220f, 0x2211, 0x2212,
    0x221a, 0x221a, 0x221e, 0x221e, 0x222b, 0x222b, 0x2248, 0x2248, 0x2260, 0x2260, 0x2264, 0x2265, 0,
};

ImVec4 grey(int value, float alpha = 1) {
  const float v = static_cast<float>(value) / 255;
  return {v, v, v, alpha};
}

/// The one colour: the amber of an incandescent lamp. `strength` darkens it.
ImVec4 amber(float strength = 1, float alpha = 1) {
  return {0.925f * strength, 0.675f * strength, 0.310f * strength, alpha};
}

struct ThemeColour {
  ImGuiCol place;
  ImVec4 value;
};

// Around the grey of the picture's background (26): panels a little lighter, fields lighter than panels, and
// amber for what is chosen, moved or measured.
void setColours(ImGuiStyle& style) {
  const ThemeColour table[] = {
      {ImGuiCol_Text, grey(226)},
      {ImGuiCol_TextDisabled, grey(146)},
      {ImGuiCol_TextSelectedBg, amber(1, 0.30f)},
      {ImGuiCol_WindowBg, grey(34)},
      {ImGuiCol_ChildBg, grey(0, 0)},
      {ImGuiCol_PopupBg, grey(40, 0.98f)},
      {ImGuiCol_ModalWindowDimBg, grey(10, 0.55f)},
      {ImGuiCol_Border, grey(255, 0.09f)},
      {ImGuiCol_BorderShadow, grey(0, 0)},
      {ImGuiCol_FrameBg, grey(49)},
      {ImGuiCol_FrameBgHovered, grey(58)},
      {ImGuiCol_FrameBgActive, grey(66)},
      {ImGuiCol_TitleBg, grey(26)},
      {ImGuiCol_TitleBgActive, grey(26)},
      {ImGuiCol_TitleBgCollapsed, grey(26, 0.8f)},
      {ImGuiCol_MenuBarBg, grey(30)},
      {ImGuiCol_ScrollbarBg, grey(0, 0)},
      {ImGuiCol_ScrollbarGrab, grey(70)},
      {ImGuiCol_ScrollbarGrabHovered, grey(88)},
      {ImGuiCol_ScrollbarGrabActive, grey(104)},
      {ImGuiCol_CheckMark, amber()},
      {ImGuiCol_SliderGrab, amber(0.50f)},  // the number over it stays readable: 6 : 1
      {ImGuiCol_SliderGrabActive, amber(0.62f)},
      {ImGuiCol_Button, grey(60)},
      {ImGuiCol_ButtonHovered, grey(72)},
      {ImGuiCol_ButtonActive, amber(0.55f)},
      {ImGuiCol_Header, grey(255, 0.075f)},
      {ImGuiCol_HeaderHovered, grey(255, 0.12f)},
      {ImGuiCol_HeaderActive, amber(1, 0.28f)},
      {ImGuiCol_Separator, grey(255, 0.09f)},
      {ImGuiCol_SeparatorHovered, amber(1, 0.5f)},
      {ImGuiCol_SeparatorActive, amber(1, 0.8f)},
      {ImGuiCol_ResizeGrip, grey(255, 0.07f)},
      {ImGuiCol_ResizeGripHovered, amber(1, 0.5f)},
      {ImGuiCol_ResizeGripActive, amber(1, 0.8f)},
      {ImGuiCol_Tab, grey(34)},
      {ImGuiCol_TabHovered, grey(66)},
      {ImGuiCol_TabActive, grey(58)},
      {ImGuiCol_TabUnfocused, grey(34)},
      {ImGuiCol_TabUnfocusedActive, grey(50)},
      {ImGuiCol_PlotLines, amber()},
      {ImGuiCol_PlotLinesHovered, amber(1.06f)},
      {ImGuiCol_PlotHistogram, amber(0.86f)},
      {ImGuiCol_PlotHistogramHovered, amber(1.06f)},
      {ImGuiCol_TableHeaderBg, grey(44)},
      {ImGuiCol_TableBorderStrong, grey(255, 0.13f)},
      {ImGuiCol_TableBorderLight, grey(255, 0.07f)},
      {ImGuiCol_TableRowBg, grey(0, 0)},
      {ImGuiCol_TableRowBgAlt, grey(255, 0.025f)},
      {ImGuiCol_DragDropTarget, amber()},
      {ImGuiCol_NavHighlight, amber(1, 0.8f)},
      {ImGuiCol_NavWindowingHighlight, amber(1, 0.7f)},
      {ImGuiCol_NavWindowingDimBg, grey(10, 0.4f)},
  };
  for (const ThemeColour& colour : table) style.Colors[colour.place] = colour.value;
}

// In pixels at scale 1.
void setSizes(ImGuiStyle& style) {
  style.WindowPadding = {12, 11};
  style.FramePadding = {8, 3};
  style.ItemSpacing = {8, 5};
  style.ItemInnerSpacing = {7, 5};
  style.CellPadding = {6, 3};
  style.IndentSpacing = 18;
  style.ScrollbarSize = 12;
  style.GrabMinSize = 11;
  style.WindowRounding = 5;
  style.ChildRounding = 5;
  style.FrameRounding = 4;
  style.PopupRounding = 5;
  style.ScrollbarRounding = 5;
  style.GrabRounding = 3;
  style.TabRounding = 4;
  style.WindowBorderSize = 1;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  style.WindowTitleAlign = {0, 0.5f};
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.DisabledAlpha = 0.45f;
}

}  // namespace

void applyTheme(ImGuiIO& io, ImGuiStyle& style, float scale) {
  style = ImGuiStyle();
  setColours(style);
  setSizes(style);
  style.ScaleAllSizes(scale);

  ImFontConfig config;
  config.OversampleH = 2;
  config.FontDataOwnedByAtlas = false;  // and so it is only read
  const std::span<const unsigned char> font = guiFont();
  io.FontDefault = nullptr;
  io.Fonts->Clear();
  io.Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(font.data()), static_cast<int>(font.size()),
                                 std::max(kSmallestFontPixels, std::round(kFontPixels * scale)), &config,
                                 kCharacters);
}

}  // namespace unshot
