// OpenGL contexts without a window, and the table of those who provide them.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/choice.h"
#include "gl/functions.h"

namespace unshot::gl {

/// Who draws.
struct ContextInfo {
  std::string provider;  ///< key of the provider
  std::string vendor, renderer, version;
  bool hardware = false;  ///< a GPU, not a software rasteriser
};

/// One OpenGL core context (4.5 where there is one, at least 3.3). It may be made on one thread and used on
/// another, but is current on at most one thread at a time, and a thread has at most one current context. It
/// outlives the objects made in it, and is destroyed on the thread where it is current, or where it is
/// current nowhere. Framebuffer 0 is undefined: draw into your own.
class Context {
 public:
  virtual ~Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Makes it current on the calling thread, whose present context (if another) is released first. Throws
  /// Error kEnvironment where the driver refuses.
  void makeCurrent();
  /// Releases it on the calling thread; does nothing where it is not current.
  void release();
  bool isCurrent() const { return current() == this; }
  /// The context of the calling thread, or null.
  static Context* current();

  const Functions& functions() const { return functions_; }
  const ContextInfo& info() const { return info_; }

 protected:
  Context() = default;
  /// Makes the new context current once to load functions and names, and leaves the thread as it was. A
  /// provider calls it as the last step of making a context.
  void initialise(std::string_view provider, const Loader& load);

 private:
  virtual void bind() = 0;
  virtual void unbind() = 0;

  Functions functions_;
  ContextInfo info_;
};

/// A way to a context. `create` throws Error kEnvironment that says what is missing.
struct Provider {
  ChoiceInfo info;
  /// With `hardware_only` it fails at once where there is no GPU.
  std::unique_ptr<Context> (*create)(bool hardware_only);
  /// Empty where available, else why not; opens libraries but makes no context.
  std::string (*unavailable)();
  std::string_view packages;  ///< what to install on Debian
};

/// In the order in which `auto` tries them for software rendering.
std::span<const Provider> providers();

/// A context of the provider `key`; `auto` is the first that reaches a GPU, else the first that works. The
/// context is not current anywhere. Any thread. Throws Error: kUsage for an unknown key, kEnvironment where
/// none can be made.
std::unique_ptr<Context> createContext(std::string_view key, std::span<const Provider> table = providers());

/// Whether a renderer of this name (GL_RENDERER) is a GPU.
bool isHardwareRenderer(std::string_view renderer);

}  // namespace unshot::gl
