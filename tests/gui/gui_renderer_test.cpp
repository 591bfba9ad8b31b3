#include "viewer/gui_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "gui/support/gui_bench.h"

namespace unshot {
namespace {

using testing_support::expectOnlyInside;
using testing_support::GuiBench;
using testing_support::keepPicture;
using testing_support::pixelAt;

using Rgb = std::array<int, 3>;

constexpr ImU32 kWhite = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kColour = IM_COL32(200, 100, 50, 255);

ImDrawList& background() { return *ImGui::GetBackgroundDrawList(); }

void expectRectangle(const Image8& image, int left, int top, int right, int bottom, const Rgb& colour) {
  int wrong = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool inside = x >= left && x < right && y >= top && y < bottom;
      wrong += pixelAt(image, x, y) != (inside ? colour : Rgb{});
    }
  }
  EXPECT_EQ(wrong, 0);
}

class EveryProvider : public testing::TestWithParam<gl::Provider> {
 protected:
  GuiBench::Options options() const {
    GuiBench::Options options;
    options.provider = GetParam().info.key;
    return options;
  }
};

TEST_P(EveryProvider, ARectangleFillsItsPixels) {
  GuiBench bench(64, 48, options());
  const Image8 image = bench.frame([] { background().AddRectFilled({10, 5}, {30, 20}, kColour); });
  expectRectangle(image, 10, 5, 30, 20, {200, 100, 50});
}

TEST_P(EveryProvider, ClipsToPixels) {
  GuiBench bench(64, 48, options());
  const Image8 image = bench.frame([] {
    background().PushClipRect({12, 8}, {40, 16});
    background().AddRectFilled({0, 0}, {64, 48}, kColour);
    background().PopClipRect();
    background().PushClipRect({90, 8}, {120, 16});  // outside of the display
    background().AddRectFilled({0, 0}, {64, 48}, kWhite);
    background().PopClipRect();
  });
  expectRectangle(image, 12, 8, 40, 16, {200, 100, 50});
}

TEST_P(EveryProvider, BlendsStraightAlpha) {
  GuiBench bench(16, 16, options());
  const Image8 image = bench.frame([] {
    background().AddRectFilled({0, 0}, {16, 16}, IM_COL32(255, 255, 255, 128));
  });
  for (std::uint8_t value : image.rgb) EXPECT_NEAR(value, 128, 1);
}

TEST_P(EveryProvider, FingerprintsTellWhatLooksOtherwise) {
  GuiBench bench(64, 48, options());
  const auto of = [&](float x, ImU32 colour, float clip) {
    return fingerprint(bench.layOut([&] {
      background().PushClipRect({0, 0}, {clip, 48});
      background().AddRectFilled({x, 5}, {20, 10}, colour);
      background().PopClipRect();
    }));
  };
  const std::size_t first = of(10, kColour, 60);
  EXPECT_EQ(of(10, kColour, 60), first);
  EXPECT_NE(of(11, kColour, 60), first);
  EXPECT_NE(of(10, kWhite, 60), first);
  EXPECT_NE(of(10, kColour, 15), first);
}

TEST_P(EveryProvider, MoreVerticesThanSixteenBitsCount) {
  GuiBench bench(200, 150, options());
  const auto content = [] {
    background().Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (int i = 0; i < 200 * 150; ++i) {
      const ImVec2 at{static_cast<float>(i % 200), static_cast<float>(i / 200)};
      background().AddRectFilled(at, {at.x + 1, at.y + 1}, IM_COL32(i % 200, i / 200, 77, 255));
    }
  };
  const Image8 image = bench.frame(content);
  const ImDrawData& data = *ImGui::GetDrawData();
  EXPECT_GT(data.TotalVtxCount, 65535);
  EXPECT_GT(data.CmdLists[0]->CmdBuffer.back().VtxOffset, 0u);
  int wrong = 0;
  for (int y = 0; y < 150; ++y) {
    for (int x = 0; x < 200; ++x) wrong += pixelAt(image, x, y) != Rgb{x, y, 77};
  }
  EXPECT_EQ(wrong, 0);
}

TEST_P(EveryProvider, DrawsIntoTheLowerLeftOfALargerFramebuffer) {
  GuiBench bench(64, 48, options());
  ImGui::GetIO().DisplaySize = {40, 30};
  ImDrawData& data = bench.layOut([] { background().AddRectFilled({10, 5}, {20, 10}, kColour); });
  bench.draw(data);
  bench.fn().ClearBufferfv(GL_COLOR, 0, std::array<GLfloat, 4>{0, 0, 0, 1}.data());
  bench.renderer().draw(data, 40, 30);
  std::array<std::uint8_t, 4> pixel{};
  bench.fn().ReadPixels(10, 30 - 1 - 5, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
  EXPECT_EQ(pixel, (std::array<std::uint8_t, 4>{200, 100, 50, 255}));
  bench.fn().ReadPixels(10, 30 - 1 - 4, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
  EXPECT_EQ(pixel[0], 0);
}

TEST_P(EveryProvider, FramebufferScaleAndDisplayPosition) {
  GuiBench::Options twice = options();
  twice.framebuffer_scale = 2;
  GuiBench bench(64, 48, twice);
  ImDrawData& data = bench.layOut([] {
    background().PushClipRect({5, 3}, {12, 9});
    background().AddRectFilled({0, 0}, {32, 24}, kColour);
    background().PopClipRect();
  });
  expectRectangle(bench.draw(data), 10, 6, 24, 18, {200, 100, 50});
  data.DisplayPos = {2, 1};
  expectRectangle(bench.draw(data), 6, 4, 20, 16, {200, 100, 50});
}

TEST_P(EveryProvider, LeavesFramebufferAndViewportAndDefaults) {
  GuiBench bench(64, 48, options());
  const gl::Functions& fn = bench.fn();
  ImDrawData& data = bench.layOut([] { background().AddRectFilled({10, 5}, {30, 20}, kColour); });
  fn.BindFramebuffer(GL_FRAMEBUFFER, bench.framebuffer());
  fn.Viewport(3, 4, 20, 30);
  fn.Enable(GL_DEPTH_TEST);
  fn.ColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  bench.renderer().draw(data, 64, 48);
  GLint viewport[4], framebuffer = 0, value = -1;
  fn.GetIntegerv(GL_VIEWPORT, viewport);
  fn.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  EXPECT_EQ((std::array{viewport[0], viewport[1], viewport[2], viewport[3]}), (std::array{3, 4, 20, 30}));
  EXPECT_EQ(static_cast<GLuint>(framebuffer), bench.framebuffer());
  for (GLenum state : {GL_BLEND, GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_CULL_FACE}) {
    EXPECT_FALSE(fn.IsEnabled(state)) << state;
  }
  for (GLenum binding : {GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_TEXTURE_BINDING_2D,
                         GL_ARRAY_BUFFER_BINDING, GL_BLEND_DST}) {
    fn.GetIntegerv(binding, &value);
    EXPECT_EQ(value, 0) << binding;
  }
  EXPECT_NO_THROW(gl::checkErrors(fn, "a frame"));
}

struct Callback {
  const gl::Functions* fn;
  int calls = 0;
};

TEST_P(EveryProvider, CallbacksAndOtherTextures) {
  GuiBench bench(64, 48, options());
  const gl::Functions& fn = bench.fn();
  gl::Texture picture(bench.context());
  const std::array<std::uint8_t, 4> texel{10, 20, 30, 255};
  fn.BindTexture(GL_TEXTURE_2D, picture.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel.data());
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  Callback callback{&fn};
  ImDrawData& data = bench.layOut([&] {
    background().AddCallback(
        [](const ImDrawList*, const ImDrawCmd* command) {
          Callback& called = *static_cast<Callback*>(command->UserCallbackData);
          ++called.calls;
          called.fn->UseProgram(0);
          called.fn->BindVertexArray(0);
          called.fn->Disable(GL_BLEND);
        },
        &callback);
    background().AddCallback(ImDrawCallback_ResetRenderState, nullptr);
    background().AddImage(reinterpret_cast<ImTextureID>(std::uintptr_t{picture.id()}), {4, 4}, {8, 8});
  });
  expectRectangle(bench.draw(data), 4, 4, 8, 8, {10, 20, 30});
  EXPECT_EQ(callback.calls, 1);
}

TEST_P(EveryProvider, NothingToDrawIsNoError) {
  GuiBench bench(16, 16, options());
  EXPECT_NO_THROW(bench.draw(ImDrawData()));
  ImDrawData& data = bench.layOut([] {});
  EXPECT_NO_THROW(bench.draw(data));
  bench.renderer().draw(data, 0, 0);
  EXPECT_NO_THROW(gl::checkErrors(bench.fn(), "a frame without pixels"));
}

INSTANTIATE_TEST_SUITE_P(Gui, EveryProvider,
                         testing::ValuesIn(gl::providers().begin(), gl::providers().end()),
                         [](const auto& row) { return std::string(row.param.info.key); });

void windowWithText() {
  float value = 0.3f;
  bool on = true;
  ImGui::SetNextWindowPos({20, 10});
  ImGui::SetNextWindowSize({200, 170});
  ImGui::Begin("Window");
  ImGui::TextUnformatted("ρ = 0.75 ± 10⁻³, ∑ F ≤ 1 …");
  ImGui::SliderFloat("value", &value, 0, 1);
  ImGui::Checkbox("on", &on);
  ImGui::BeginChild("clipped", {150, 40}, true);
  for (int i = 0; i < 6; ++i) ImGui::Text("line %d", i);
  ImGui::EndChild();
  ImGui::End();
  ImGui::GetForegroundDrawList()->AddCircle({190, 150}, 40, kColour, 0, 2.5f);
}

TEST(GuiRenderer, EveryProviderDrawsTheSame) {
  std::vector<Image8> images;
  for (const gl::Provider& provider : gl::providers()) {
    GuiBench::Options options;
    options.provider = provider.info.key;
    GuiBench bench(240, 200, options);
    images.push_back(bench.frame(windowWithText));
    keepPicture(images.back(), "window_" + options.provider);
    int bright = 0;
    for (std::uint8_t v : images.back().rgb) bright += v > 150;
    EXPECT_GT(bright, 500) << "no text";
  }
  ASSERT_GE(images.size(), 2u);
  int largest = 0;
  for (std::size_t i = 0; i < images[0].rgb.size(); ++i) {
    largest = std::max(largest, std::abs(int{images[0].rgb[i]} - int{images[1].rgb[i]}));
  }
  EXPECT_LE(largest, 1);
}

TEST(GuiRenderer, AWindowStaysInItsRectangle) {
  GuiBench bench(240, 200);
  const Image8 image = bench.frame([] {
    ImGui::SetNextWindowPos({20, 10});
    ImGui::SetNextWindowSize({200, 170});
    ImGui::Begin("Window");
    for (int i = 0; i < 40; ++i) ImGui::TextUnformatted("a line that is longer than the window is wide");
    ImGui::End();
  });
  expectOnlyInside(image, 20, 10, 220, 180);
}

TEST(Theme, CanBeAppliedAgainAtAnotherScale) {
  GuiBench bench(64, 48);
  const auto text = [] { background().AddText({2, 2}, kWhite, "Ωj"); };
  bench.frame(text);
  EXPECT_EQ(ImGui::GetFontSize(), 15);
  const float padding = ImGui::GetStyle().FramePadding.x;
  applyTheme(ImGui::GetIO(), ImGui::GetStyle(), 2);
  bench.renderer().setFonts(*ImGui::GetIO().Fonts);
  expectOnlyInside(bench.frame(text), 2, 2, 60, 40);
  EXPECT_EQ(ImGui::GetFontSize(), 30);
  EXPECT_EQ(ImGui::GetStyle().FramePadding.x, 2 * padding);
}

TEST(Theme, TheFontHasTheSignsOfTheField) {
  GuiBench bench(16, 16);
  bench.layOut([] {});
  for (unsigned sign : {0x20u, 0xb2u, 0xd7u, 0x3c1u, 0x3a3u, 0x2026u, 0x2074u, 0x207bu, 0x2082u, 0x2211u,
                        0x2212u, 0x221eu, 0x2248u, 0x2264u}) {
    EXPECT_TRUE(ImGui::GetFont()->FindGlyphNoFallback(static_cast<ImWchar>(sign))) << std::hex << sign;
  }
}

}  // namespace
}  // namespace unshot
