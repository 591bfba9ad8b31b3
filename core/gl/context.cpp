#include "gl/context.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "gl/provider.h"

namespace unshot::gl {
namespace {

// OSMesa and EGL share Mesa's dispatch table of a thread, so a context must be released before one of the
// other kind is made current. Only this file knows who is current.
thread_local Context* t_current = nullptr;

std::string text(const Functions& fn, GLenum name) {
  const GLubyte* s = fn.GetString(name);
  return s ? reinterpret_cast<const char*>(s) : "";
}

std::unique_ptr<Context> createAutomatic(std::span<const Provider> table) {
  for (const Provider& row : table) {
    try {
      return row.create(true);
    } catch (const Error&) {  // The reason is found again below, where it counts.
    }
  }
  std::string reasons;
  std::string packages;
  for (const Provider& row : table) {
    try {
      return row.create(false);
    } catch (const Error& error) {
      reasons += "\n  " + std::string(row.info.key) + ": " + error.what();
      packages += (packages.empty() ? "" : ", or ") + std::string(row.packages);
    }
  }
  throw Error(ErrorKind::kEnvironment, "no OpenGL 3.3 context can be made here:" + reasons, {},
              "apt-get install " + packages);
}

}  // namespace

Context* Context::current() { return t_current; }

void Context::makeCurrent() {
  if (t_current == this) return;
  if (t_current) t_current->release();
  bind();
  t_current = this;
}

void Context::release() {
  if (t_current != this) return;
  t_current = nullptr;
  unbind();
}

void Context::initialise(std::string_view provider, const Loader& load) {
  Context* before = t_current;
  makeCurrent();
  functions_ = loadFunctions(load);
  info_.provider = provider;
  info_.vendor = text(functions_, GL_VENDOR);
  info_.renderer = text(functions_, GL_RENDERER);
  info_.version = text(functions_, GL_VERSION);
  info_.hardware = isHardwareRenderer(info_.renderer);
  release();
  if (before) before->makeCurrent();
}

bool isHardwareRenderer(std::string_view renderer) {
  static constexpr std::array<std::string_view, 5> kSoftware = {"llvmpipe", "softpipe", "swrast",
                                                                "software rasterizer", "swiftshader"};
  std::string lower(renderer);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return !lower.empty() && std::none_of(kSoftware.begin(), kSoftware.end(), [&](std::string_view name) {
    return lower.find(name) != std::string::npos;
  });
}

std::span<const Provider> providers() {
  static const std::array<Provider, 2> table = {osmesaProvider(), eglProvider()};
  return table;
}

std::unique_ptr<Context> createContext(std::string_view key, std::span<const Provider> table) {
  if (key == "auto") return createAutomatic(table);
  if (key == "glfw") {
    throw Error(ErrorKind::kUsage, "the GL provider 'glfw' opens a window: only `unshot view` has one", {},
                "--gl auto");
  }
  const Provider& row = findChoice(table, key, "GL provider");
  try {
    return row.create(false);
  } catch (const Error& error) {
    std::string others = "auto";
    for (const Provider& other : table) {
      if (other.info.key != key) others += ", " + std::string(other.info.key);
    }
    throw Error(error.kind(), "the GL provider '" + std::string(key) + "' gives no context: " + error.what(),
                {},
                "another provider (--gl " + others + "), or apt-get install " + std::string(row.packages));
  }
}

}  // namespace unshot::gl
