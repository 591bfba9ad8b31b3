#include "viewer/gui_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include "render/targets.h"

namespace unshot {
namespace {

constexpr GLenum kIndexType = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;

const void* bufferOffset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

ImTextureID textureId(GLuint name) { return reinterpret_cast<ImTextureID>(std::uintptr_t{name}); }
GLuint textureName(ImTextureID id) { return static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(id)); }

template <class T>
void upload(const gl::Functions& fn, GLenum target, const ImVector<T>& values) {
  fn.BufferData(target, static_cast<GLsizeiptr>(values.size_in_bytes()), values.Data, GL_STREAM_DRAW);
}

/// Mixes the bytes of some values into `hash`.
template <class T>
void mix(std::size_t& hash, const T* values, int count) {
  const std::string_view bytes(reinterpret_cast<const char*>(values),
                               sizeof(T) * static_cast<std::size_t>(count));
  hash = 31 * hash + std::hash<std::string_view>()(bytes);
}

/// The nearest pixel edge in [0, size].
int pixelEdge(float at, int size) {
  return static_cast<int>(std::lround(std::clamp(at, 0.0f, static_cast<float>(size))));
}

/// Sets the scissor box to a clip rectangle; false where nothing of it is left.
bool setClip(const gl::Functions& fn, const ImVec4& clip, const ImDrawData& data, int width, int height) {
  const ImVec2 scale = data.FramebufferScale;
  const int left = pixelEdge((clip.x - data.DisplayPos.x) * scale.x, width);
  const int right = pixelEdge((clip.z - data.DisplayPos.x) * scale.x, width);
  const int top = pixelEdge((clip.y - data.DisplayPos.y) * scale.y, height);
  const int bottom = pixelEdge((clip.w - data.DisplayPos.y) * scale.y, height);
  if (right <= left || bottom <= top) return false;
  fn.Scissor(left, height - bottom, right - left, bottom - top);
  return true;
}

}  // namespace

std::size_t fingerprint(const ImDrawData& data) {
  std::size_t hash = 0;
  mix(hash, &data.DisplayPos, 1);
  mix(hash, &data.DisplaySize, 1);
  mix(hash, &data.FramebufferScale, 1);
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    mix(hash, list.VtxBuffer.Data, list.VtxBuffer.Size);
    mix(hash, list.IdxBuffer.Data, list.IdxBuffer.Size);
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImTextureID texture = command.GetTexID();
      mix(hash, &command.ClipRect, 1);
      mix(hash, &texture, 1);
      mix(hash, &command.ElemCount, 1);
    }
  }
  return hash;
}

GuiRenderer::GuiRenderer(gl::Context& context)
    : context_(context),
      program_(context, {"gui.vert", "gui.frag"}),
      vertex_array_(context),
      vertices_(context),
      indices_(context),
      font_(context) {
  const gl::Functions& fn = context.functions();
  fn.BindVertexArray(vertex_array_.id());
  fn.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  fn.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  const GLsizei stride = sizeof(ImDrawVert);
  fn.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, bufferOffset(offsetof(ImDrawVert, pos)));
  fn.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, bufferOffset(offsetof(ImDrawVert, uv)));
  fn.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, bufferOffset(offsetof(ImDrawVert, col)));
  for (GLuint attribute = 0; attribute < 3; ++attribute) fn.EnableVertexAttribArray(attribute);
  fn.BindVertexArray(0);
  fn.BindBuffer(GL_ARRAY_BUFFER, 0);
}

void GuiRenderer::setFonts(ImFontAtlas& fonts) {
  unsigned char* coverage = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsAlpha8(&coverage, &width, &height);
  const gl::Functions& fn = context_.functions();
  fn.BindTexture(GL_TEXTURE_2D, font_.id());
  fn.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, coverage);
  fn.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (GLenum colour : {GL_TEXTURE_SWIZZLE_R, GL_TEXTURE_SWIZZLE_G, GL_TEXTURE_SWIZZLE_B}) {
    fn.TexParameteri(GL_TEXTURE_2D, colour, GL_ONE);
  }
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_A, GL_RED);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  fonts.SetTexID(textureId(font_.id()));
  if (ImGui::GetCurrentContext()) ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
}

void GuiRenderer::setState(const ImDrawData& data, int width, int height) const {
  const gl::Functions& fn = context_.functions();
  setPassState(fn, false);
  fn.Viewport(0, 0, width, height);
  fn.Enable(GL_SCISSOR_TEST);
  fn.Enable(GL_BLEND);
  fn.BlendEquation(GL_FUNC_ADD);
  fn.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  program_.use();
  fn.Uniform2f(program_.uniform("origin"), data.DisplayPos.x, data.DisplayPos.y);
  fn.Uniform2f(program_.uniform("scale"), 2 * data.FramebufferScale.x / static_cast<float>(width),
               -2 * data.FramebufferScale.y / static_cast<float>(height));
  fn.Uniform1i(program_.uniform("picture"), 0);
  fn.ActiveTexture(GL_TEXTURE0);
  fn.BindVertexArray(vertex_array_.id());
  fn.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
}

void GuiRenderer::drawList(const ImDrawList& list, const ImDrawData& data, int width, int height) const {
  const gl::Functions& fn = context_.functions();
  upload(fn, GL_ARRAY_BUFFER, list.VtxBuffer);
  upload(fn, GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer);
  for (const ImDrawCmd& command : list.CmdBuffer) {
    if (command.UserCallback == ImDrawCallback_ResetRenderState) {
      setState(data, width, height);
    } else if (command.UserCallback) {
      command.UserCallback(&list, &command);
    } else if (command.ElemCount > 0 && setClip(fn, command.ClipRect, data, width, height)) {
      fn.BindTexture(GL_TEXTURE_2D, textureName(command.GetTexID()));
      fn.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), kIndexType,
                                bufferOffset(command.IdxOffset * sizeof(ImDrawIdx)),
                                static_cast<GLint>(command.VtxOffset));
    }
  }
}

void GuiRenderer::draw(const ImDrawData& data, int width, int height) {
  if (!data.Valid || width <= 0 || height <= 0) return;
  const gl::Functions& fn = context_.functions();
  const StateGuard guard(fn);
  setState(data, width, height);
  for (int i = 0; i < data.CmdListsCount; ++i) drawList(*data.CmdLists[i], data, width, height);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  fn.BindBuffer(GL_ARRAY_BUFFER, 0);
  fn.Disable(GL_SCISSOR_TEST);
  fn.Disable(GL_BLEND);
  fn.BlendFunc(GL_ONE, GL_ZERO);
}

}  // namespace unshot
