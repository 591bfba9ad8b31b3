// Frames of Dear ImGui drawn into a framebuffer of the test's own.
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "base/image.h"
#include "export/image_files.h"
#include "gl/objects.h"
#include "viewer/gui_renderer.h"
#include "viewer/panels/theme.h"

namespace unshot::testing_support {

/// A context of OpenGL and one of ImGui, a framebuffer of `width` x `height` pixels, cleared to black before
/// each frame.
class GuiBench {
 public:
  struct Options {
    std::string provider = "osmesa";
    float scale = 1;              ///< of the theme
    float framebuffer_scale = 1;  ///< pixels per unit of ImGui
  };

  GuiBench(int width, int height) : GuiBench(width, height, Options{}) {}
  GuiBench(int width, int height, const Options& options)
      : width_(width), height_(height), options_(options), context_(gl::createContext(options.provider)) {
    context_->makeCurrent();
    gui_ = ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {static_cast<float>(width) / options.framebuffer_scale,
                      static_cast<float>(height) / options.framebuffer_scale};
    io.DisplayFramebufferScale = {options.framebuffer_scale, options.framebuffer_scale};
    io.MousePos = {-1000, -1000};
    applyTheme(io, ImGui::GetStyle(), options.scale);
    objects_ = std::make_unique<Objects>(*context_);
    objects_->renderer.setFonts(*io.Fonts);
    attachPicture();
  }
  ~GuiBench() {
    objects_.reset();
    ImGui::DestroyContext(gui_);
  }
  GuiBench(const GuiBench&) = delete;
  GuiBench& operator=(const GuiBench&) = delete;

  gl::Context& context() { return *context_; }
  const gl::Functions& fn() { return context_->functions(); }
  GuiRenderer& renderer() { return objects_->renderer; }
  GLuint framebuffer() const { return objects_->framebuffer.id(); }

  /// Runs `content` in a frame, without drawing it. The draw data lives until the next frame.
  ImDrawData& layOut(const std::function<void()>& content) {
    ImGui::GetIO().DeltaTime = 1.0f / 60;
    ImGui::NewFrame();
    content();
    ImGui::Render();
    return *ImGui::GetDrawData();
  }
  /// Draws what was laid out over a `background` and reads it back.
  Image8 draw(const ImDrawData& data, std::uint8_t background = 0) {
    const float grey = static_cast<float>(background) / 255;
    fn().BindFramebuffer(GL_FRAMEBUFFER, framebuffer());
    fn().ClearBufferfv(GL_COLOR, 0, std::array<GLfloat, 4>{grey, grey, grey, 1}.data());
    renderer().draw(data, width_, height_);
    gl::checkErrors(fn(), "drawing a frame of the GUI");
    return read();
  }
  /// The second frame of `content` (in the first, windows find their sizes), on black.
  Image8 frame(const std::function<void()>& content, std::uint8_t background = 0) {
    layOut(content);
    return draw(layOut(content), background);
  }

 private:
  struct Objects {
    explicit Objects(gl::Context& context) : picture(context), framebuffer(context), renderer(context) {}
    gl::Texture picture;
    gl::Framebuffer framebuffer;
    GuiRenderer renderer;
  };

  void attachPicture() {
    fn().BindTexture(GL_TEXTURE_2D, objects_->picture.id());
    fn().TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    fn().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    fn().BindFramebuffer(GL_FRAMEBUFFER, framebuffer());
    fn().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, objects_->picture.id(), 0);
    fn().BindTexture(GL_TEXTURE_2D, 0);
    objects_->framebuffer.checkComplete("a frame of the GUI");
  }

  Image8 read() {
    const std::size_t row = 3 * static_cast<std::size_t>(width_);
    std::vector<std::uint8_t> upwards(row * static_cast<std::size_t>(height_));
    fn().PixelStorei(GL_PACK_ALIGNMENT, 1);
    fn().ReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upwards.data());
    fn().PixelStorei(GL_PACK_ALIGNMENT, 4);
    Image8 image{width_, height_, {}};
    for (std::size_t y = static_cast<std::size_t>(height_); y-- > 0;) {
      image.rgb.insert(image.rgb.end(), &upwards[y * row], &upwards[y * row] + row);
    }
    return image;
  }

  int width_, height_;
  Options options_;
  std::unique_ptr<gl::Context> context_;
  ImGuiContext* gui_ = nullptr;
  std::unique_ptr<Objects> objects_;
};

/// Writes the picture to the folder that UNSHOT_KEEP_PICTURES names, if any.
inline void keepPicture(const Image8& image, const std::string& name) {
  if (const char* folder = std::getenv("UNSHOT_KEEP_PICTURES")) {
    std::filesystem::create_directories(folder);
    writePng(std::filesystem::path(folder) / (name + ".png"), image);
  }
}

/// Red, green and blue; (0, 0) is the upper left.
inline std::array<int, 3> pixelAt(const Image8& image, int x, int y) {
  const std::size_t i = 3 * static_cast<std::size_t>(y * image.width + x);
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

/// Whether every pixel outside of [left, right) x [top, bottom) has this grey.
inline void expectOnlyInside(const Image8& image, int left, int top, int right, int bottom, int grey = 0) {
  int outside = 0, inside = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (pixelAt(image, x, y) == std::array<int, 3>{grey, grey, grey}) continue;
      ++(x >= left && x < right && y >= top && y < bottom ? inside : outside);
    }
  }
  EXPECT_EQ(outside, 0);
  EXPECT_GT(inside, 0);
}

}  // namespace unshot::testing_support
