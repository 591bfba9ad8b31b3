// How the panels look: the font, the colours and the sizes.
#pragma once

#include <imgui.h>

namespace unshot {

/// Loads the font at 15 px * scale (at least 8 px) and sets every colour and size. Again when the scale
/// changes, between frames: the fonts are built anew, so GuiRenderer::setFonts comes after it. The font holds
/// Latin and Greek letters, raised and lowered digits, punctuation and the signs of mathematics; it holds no
/// arrows.
void applyTheme(ImGuiIO& io, ImGuiStyle& style, float scale);

}  // namespace unshot
