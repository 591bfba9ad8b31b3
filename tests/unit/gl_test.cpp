#include <gtest/gtest.h>

#include <array>
#include <barrier>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "gl/context.h"
#include "gl/objects.h"
#include "gl/shaders.h"

namespace unshot::gl {
namespace {

using testing::Test;

// An R32UI framebuffer cleared to `value`, as read back.
std::array<GLuint, 16> clearAndRead(Context& context, GLuint value) {
  const Functions& fn = context.functions();
  Texture texture(context);
  fn.BindTexture(GL_TEXTURE_2D, texture.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_R32UI, 4, 4, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  Framebuffer framebuffer(context);
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  framebuffer.checkComplete("an integer texture");
  fn.ClearBufferuiv(GL_COLOR, 0, std::array<GLuint, 4>{value, 0, 0, 0}.data());
  std::array<GLuint, 16> pixels{};
  fn.ReadPixels(0, 0, 4, 4, GL_RED_INTEGER, GL_UNSIGNED_INT, pixels.data());
  checkErrors(fn, "reading back");
  return pixels;
}

void expectAll(const std::array<GLuint, 16>& pixels, GLuint value) {
  for (GLuint p : pixels) EXPECT_EQ(p, value);
}

class EveryProvider : public testing::TestWithParam<Provider> {};

TEST_P(EveryProvider, ClearsAndReadsBackAnIntegerFramebuffer) {
  const std::unique_ptr<Context> context = createContext(GetParam().info.key);
  EXPECT_EQ(context->info().provider, GetParam().info.key);
  EXPECT_FALSE(context->info().renderer.empty());
  EXPECT_FALSE(context->isCurrent());
  context->makeCurrent();
  EXPECT_TRUE(context->isCurrent());
  expectAll(clearAndRead(*context, 0xfedcba98u), 0xfedcba98u);
}

TEST_P(EveryProvider, IsMadeOnOneThreadAndUsedOnAnother) {
  const std::unique_ptr<Context> context = createContext(GetParam().info.key);
  std::array<GLuint, 16> pixels{};
  std::thread([&] {
    context->makeCurrent();
    pixels = clearAndRead(*context, 7);
    context->release();
  }).join();
  expectAll(pixels, 7);
}

TEST_P(EveryProvider, WorksBesideEveryOtherOnTwoThreads) {
  for (const Provider& other : providers()) {
    std::barrier both(2);
    const auto work = [&both](std::string_view key, GLuint value) {
      const std::unique_ptr<Context> context = createContext(key);
      context->makeCurrent();
      both.arrive_and_wait();
      for (GLuint i = 0; i < 20; ++i) expectAll(clearAndRead(*context, value + i), value + i);
      both.arrive_and_wait();
    };
    std::thread first(work, GetParam().info.key, 100);
    std::thread second(work, other.info.key, 200);
    first.join();
    second.join();
  }
}

TEST_P(EveryProvider, GivesWayToAnotherOnTheSameThread) {
  const std::unique_ptr<Context> mine = createContext(GetParam().info.key);
  mine->makeCurrent();
  for (const Provider& row : providers()) {
    const std::unique_ptr<Context> other = createContext(row.info.key);
    EXPECT_TRUE(mine->isCurrent()) << "making a context leaves the thread as it was";
    other->makeCurrent();
    EXPECT_FALSE(mine->isCurrent());
    expectAll(clearAndRead(*other, 5), 5);
    mine->makeCurrent();
    expectAll(clearAndRead(*mine, 6), 6);
  }
}

TEST_P(EveryProvider, CompilesEveryShader) {
  const std::unique_ptr<Context> context = createContext(GetParam().info.key);
  context->makeCurrent();
  const Functions& fn = context->functions();
  for (const EmbeddedShader& shader : embeddedShaders()) {
    const GLenum stage = shader.name.ends_with(".vert")   ? GL_VERTEX_SHADER
                         : shader.name.ends_with(".frag") ? GL_FRAGMENT_SHADER
                         : shader.name.ends_with(".geom") ? GL_GEOMETRY_SHADER
                                                          : GLenum{0};
    if (stage == 0) continue;  // included by others
    const std::string source = shaderSource(shader.name);
    const char* text = source.c_str();
    const GLuint id = fn.CreateShader(stage);
    fn.ShaderSource(id, 1, &text, nullptr);
    fn.CompileShader(id);
    GLint compiled = 0;
    fn.GetShaderiv(id, GL_COMPILE_STATUS, &compiled);
    std::array<char, 1000> log{};
    fn.GetShaderInfoLog(id, log.size(), nullptr, log.data());
    EXPECT_TRUE(compiled) << shader.name << ": " << log.data();
    fn.DeleteShader(id);
  }
}

TEST_P(EveryProvider, MovesObjects) {
  const std::unique_ptr<Context> context = createContext(GetParam().info.key);
  context->makeCurrent();
  Buffer a(*context);
  const GLuint id = a.id();
  EXPECT_NE(id, 0u);
  Buffer b(std::move(a));
  EXPECT_FALSE(a);
  EXPECT_EQ(b.id(), id);
  Buffer c;
  EXPECT_FALSE(c);
  c = std::move(b);
  EXPECT_EQ(c.id(), id);
  static_assert(!std::is_copy_constructible_v<Buffer> && !std::is_copy_assignable_v<Program>);
}

INSTANTIATE_TEST_SUITE_P(Gl, EveryProvider, testing::ValuesIn(providers().begin(), providers().end()),
                         [](const auto& row) { return std::string(row.param.info.key); });

class ShaderFolder : public Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(testing::TempDir()) /
        ("unshot_shaders_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
    setShaderDir(folder_);
  }
  void TearDown() override {
    setShaderDir({});
    std::filesystem::remove_all(folder_);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  std::filesystem::path folder_;
};

TEST_F(ShaderFolder, ReplacesIncludesOnce) {
  write("a.glsl", "float a() { return 1.0; }\n#include \"b.glsl\"\n");
  write("b.glsl", "#include \"a.glsl\"\nfloat b[2];");
  write("main.frag", "#version 330 core\n#include \"a.glsl\"\n#include \"b.glsl\"\nvoid main() {}\n");
  EXPECT_EQ(shaderSource("main.frag"),
            "#version 330 core\nfloat a() { return 1.0; }\nfloat b[2];\nvoid main() {}\n");
}

TEST_F(ShaderFolder, NamesWhoIncludesAMissingFile) {
  write("main.frag", "#version 330 core\n#include \"missing.glsl\"\n");
  try {
    shaderSource("main.frag");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "main.frag:2");
  }
}

TEST_F(ShaderFolder, AnErrorNamesFileAndLine) {
  write("part.glsl", "float half_of(float x) {\n  return 0.5 * y;\n}\n");
  write("main.vert",
        "#version 330 core\n\n#include \"part.glsl\"\nvoid main() { gl_Position = vec4(half_of(1.0)); }\n");
  const std::unique_ptr<Context> context = createContext("auto");
  context->makeCurrent();
  try {
    Program program(*context, {"main.vert"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "part.glsl:2");
    EXPECT_NE(std::string(error.what()).find("2:   return 0.5 * y;"), std::string::npos) << error.what();
  }
  EXPECT_EQ(context->functions().GetError(), GLenum{GL_NO_ERROR});
}

TEST(Shaders, EmbeddedTextIsTheFile) {
  for (const EmbeddedShader& shader : embeddedShaders()) {
    std::ifstream file(std::filesystem::path(UNSHOT_SOURCE_DIR) / "shaders" / shader.name, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_EQ(shader.source, text) << shader.name;
  }
}

TEST(Providers, AnUnknownKeyIsAUsageError) {
  for (const char* key : {"no-such", "glfw", ""}) {
    try {
      createContext(key);
      FAIL() << key;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage) << key;
    }
  }
}

std::unique_ptr<Context> createNothing(bool) {
  throw Error(ErrorKind::kEnvironment, "libNothing.so is not there");
}
std::string nothing() { return "libNothing.so is not there"; }

TEST(Providers, AutoSaysWhatIsMissingAndWhatToInstall) {
  const std::array<Provider, 2> table = {Provider{{"first", "", ""}, createNothing, nothing, "libfirst"},
                                         Provider{{"second", "", ""}, createNothing, nothing, "libsecond"}};
  try {
    createContext("auto", table);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kEnvironment);
    const std::string text = error.fullText();
    for (const char* part :
         {"first: libNothing.so is not there", "second: libNothing", "libfirst", "libsecond"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
    }
  }
}

TEST(Providers, OneThatFailsNamesTheOthers) {
  const std::array<Provider, 2> table = {Provider{{"first", "", ""}, createNothing, nothing, "libfirst"},
                                         Provider{{"second", "", ""}, createNothing, nothing, "libsecond"}};
  try {
    createContext("first", table);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kEnvironment);
    EXPECT_NE(error.fullText().find("second"), std::string::npos) << error.fullText();
    EXPECT_NE(error.fullText().find("libNothing.so"), std::string::npos) << error.fullText();
  }
}

TEST(Providers, AutoPassesOverTheOnesThatFail) {
  const std::array<Provider, 2> table = {Provider{{"first", "", ""}, createNothing, nothing, "libfirst"},
                                         providers().front()};
  EXPECT_EQ(createContext("auto", table)->info().provider, providers().front().info.key);
}

TEST(Providers, KnowSoftwareRenderersByName) {
  EXPECT_FALSE(isHardwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_FALSE(isHardwareRenderer("softpipe"));
  EXPECT_FALSE(isHardwareRenderer("Software Rasterizer"));
  EXPECT_FALSE(isHardwareRenderer(""));
  EXPECT_TRUE(isHardwareRenderer("NVIDIA H100 PCIe/PCIe/SSE2"));
  EXPECT_TRUE(isHardwareRenderer("Mesa Intel(R) UHD Graphics 620"));
}

}  // namespace
}  // namespace unshot::gl
