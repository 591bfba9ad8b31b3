#include "gl/objects.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "gl/shaders.h"

namespace unshot::gl {
namespace {

constexpr GLenum kContextLost = 0x0507;  // of OpenGL 4.5

std::string hexadecimal(GLenum value) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%x", value);
  return text;
}

[[noreturn]] void failWith(GLenum error, std::string_view where) {
  const std::string name = "(OpenGL error " + hexadecimal(error) + " after " + std::string(where) + ")";
  if (error == GL_OUT_OF_MEMORY) {
    throw Error(ErrorKind::kEnvironment, "there is not enough memory to draw " + name, {},
                "fewer elements, less memory for form factors (--keep) or a smaller picture");
  }
  if (error == kContextLost) {
    throw Error(ErrorKind::kEnvironment, "the graphics driver was reset, and what it held is lost " + name,
                {}, "starting it again; what was saved with --save goes on with --resume");
  }
  throw Error(ErrorKind::kInternal, "the OpenGL driver reports an error " + name);
}

GLenum stageOf(std::string_view name) {
  if (name.ends_with(".vert")) return GL_VERTEX_SHADER;
  if (name.ends_with(".geom")) return GL_GEOMETRY_SHADER;
  if (name.ends_with(".frag")) return GL_FRAGMENT_SHADER;
  throw Error(ErrorKind::kInternal, "the name of a shader ends with .vert, .geom or .frag",
              std::string(name));
}

std::string lineText(const std::string& text, std::size_t number) {
  std::istringstream lines(text);
  std::string line;
  for (std::size_t i = 0; i < number && std::getline(lines, line); ++i) {
  }
  return line;
}

// The line a driver speaks of, or 0: "0:12(5): error", "0(12) : error" and "ERROR: 0:12: ..." all mean
// line 12.
std::size_t lineOf(const std::string& log) {
  const auto digit = [&](std::size_t i) { return i < log.size() && log[i] >= '0' && log[i] <= '9'; };
  for (std::size_t i = 1; i + 1 < log.size(); ++i) {
    if ((log[i] == ':' || log[i] == '(') && digit(i - 1) && digit(i + 1))
      return std::strtoul(&log[i + 1], nullptr, 10);
  }
  return 0;
}

Error compileError(std::string_view name, const ShaderText& shader, const std::string& log) {
  const std::size_t line = lineOf(log);
  std::string where(name);
  std::string message = "the shader does not compile: " + log;
  if (line >= 1 && line <= shader.lines.size()) {
    const ShaderText::Origin& origin = shader.lines[line - 1];
    where = origin.file + ':' + std::to_string(origin.line);
    message += "\n" + std::to_string(origin.line) + ": " + lineText(shader.text, line);
  }
  return Error(ErrorKind::kInternal, message, where);
}

template <class GetIv, class GetLog>
std::string infoLog(GLuint id, GetIv get_iv, GetLog get_log) {
  GLint length = 0;
  get_iv(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  GLsizei written = 0;
  get_log(id, static_cast<GLsizei>(log.size()), &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  while (!log.empty() && (log.back() == '\n' || log.back() == ' ')) log.pop_back();
  return log;
}

// Compiles one stage and attaches it; a shader marked for deletion lives as long as it is attached.
void attach(const Functions& fn, GLuint program, std::string_view name) {
  const ShaderText shader = loadShader(name);
  const GLuint id = fn.CreateShader(stageOf(name));
  const char* text = shader.text.c_str();
  fn.ShaderSource(id, 1, &text, nullptr);
  fn.CompileShader(id);
  GLint compiled = 0;
  fn.GetShaderiv(id, GL_COMPILE_STATUS, &compiled);
  const std::string log = compiled ? std::string() : infoLog(id, fn.GetShaderiv, fn.GetShaderInfoLog);
  if (compiled) fn.AttachShader(program, id);
  fn.DeleteShader(id);
  if (!compiled) throw compileError(name, shader, log);
}

}  // namespace

void assertCurrent([[maybe_unused]] const Context& context) {
#if !defined(NDEBUG) || defined(_GLIBCXX_ASSERTIONS)
  if (context.isCurrent()) return;
  std::fputs("unshot: a GL object is used where its context is not current\n", stderr);
  std::abort();
#endif
}

void Framebuffer::checkComplete(std::string_view what) const {
  const GLenum status = fn().CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  const std::string drawing = "drawing into " + std::string(what);
  // Memory that was missing shows here first.
  if (const GLenum error = fn().GetError(); error != GL_NO_ERROR) failWith(error, drawing);
  throw Error(ErrorKind::kEnvironment,
              "the driver refuses " + drawing + " (framebuffer status " + hexadecimal(status) + ")");
}

Program::Program(Context& context, std::initializer_list<std::string_view> shaders) : Object(context) {
  std::string names;
  for (std::string_view name : shaders) {
    attach(fn(), id(), name);
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  fn().LinkProgram(id());
  GLint linked = 0;
  fn().GetProgramiv(id(), GL_LINK_STATUS, &linked);
  if (!linked) {
    throw Error(ErrorKind::kInternal,
                "the shaders do not link: " + infoLog(id(), fn().GetProgramiv, fn().GetProgramInfoLog),
                names);
  }
}

void Program::use() const { fn().UseProgram(id()); }

GLint Program::uniform(const char* name) const { return fn().GetUniformLocation(id(), name); }

void checkErrors(const Functions& fn, std::string_view where) {
  if (const GLenum error = fn.GetError(); error != GL_NO_ERROR) failWith(error, where);
}

}  // namespace unshot::gl
