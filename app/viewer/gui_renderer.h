// Draws Dear ImGui's draw data with the function table of a context, whatever its provider, so that the
// window and pictures without a window show the same panels.
#pragma once

#include <imgui.h>

#include <cstddef>

#include "gl/objects.h"

namespace unshot {

/// Equal for draw data that looks alike, as long as the same fonts stand; user callbacks do not count.
std::size_t fingerprint(const ImDrawData& data);

/// All calls on the thread where the context is current. One ImGui context may be used with it at a time.
class GuiRenderer {
 public:
  explicit GuiRenderer(gl::Context& context);

  /// Uploads the atlas of `fonts` and sets its texture id; again whenever the fonts were built anew. Tells
  /// the current ImGui context that lists of more than 65,535 vertices can be drawn.
  void setFonts(ImFontAtlas& fonts);

  /// Draws into the lower left `width` x `height` pixels of the bound framebuffer (which hold sRGB-encoded
  /// values and take them as they are). State that is changed goes back to OpenGL's defaults; framebuffer and
  /// viewport stay. An ImTextureID other than the font's is the name of a GL texture of this context, cast. A
  /// user callback may bind and draw what it likes; ImDrawCallback_ResetRenderState after it sets the state
  /// of the panels again.
  void draw(const ImDrawData& data, int width, int height);

 private:
  void setState(const ImDrawData& data, int width, int height) const;
  void drawList(const ImDrawList& list, const ImDrawData& data, int width, int height) const;

  gl::Context& context_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
  gl::Buffer vertices_, indices_;
  gl::Texture font_;
};

}  // namespace unshot
