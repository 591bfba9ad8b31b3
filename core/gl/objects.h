// Owners of OpenGL objects: move-only, tied to one context, which outlives them. Every use asserts (in builds
// with assertions or sanitizers) that the context is current on the calling thread. An owner made without a
// context is empty.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "gl/context.h"

namespace unshot::gl {

/// Ends the program where `context` is not current on this thread; does nothing in release builds.
void assertCurrent(const Context& context);

/// Owner of one object name. `Kind` makes and deletes names.
template <class Kind>
class Object {
 public:
  Object() = default;
  explicit Object(Context& context) : context_(&context) {
    assertCurrent(context);
    id_ = Kind::create(context.functions());
  }
  Object(Object&& other) noexcept
      : context_(std::exchange(other.context_, nullptr)), id_(std::exchange(other.id_, 0u)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(id_, other.id_);
    return *this;
  }
  ~Object() {
    if (id_ == 0) return;
    assertCurrent(*context_);
    // Elsewhere than in its context the name means nothing, or another object.
    if (context_->isCurrent()) Kind::destroy(context_->functions(), id_);
  }

  explicit operator bool() const { return id_ != 0; }
  GLuint id() const {
    if (context_) assertCurrent(*context_);
    return id_;
  }
  /// Only for an owner that is not empty.
  const Functions& fn() const { return context_->functions(); }

 private:
  Context* context_ = nullptr;
  GLuint id_ = 0;
};

#define UNSHOT_GL_KIND(KIND, CREATE, DESTROY)                                   \
  struct KIND {                                                                 \
    static GLuint create(const Functions& fn) {                                 \
      GLuint id = 0;                                                            \
      fn.CREATE(1, &id);                                                        \
      return id;                                                                \
    }                                                                           \
    static void destroy(const Functions& fn, GLuint id) { fn.DESTROY(1, &id); } \
  }
UNSHOT_GL_KIND(BufferKind, GenBuffers, DeleteBuffers);
UNSHOT_GL_KIND(TextureKind, GenTextures, DeleteTextures);
UNSHOT_GL_KIND(RenderbufferKind, GenRenderbuffers, DeleteRenderbuffers);
UNSHOT_GL_KIND(FramebufferKind, GenFramebuffers, DeleteFramebuffers);
UNSHOT_GL_KIND(VertexArrayKind, GenVertexArrays, DeleteVertexArrays);
UNSHOT_GL_KIND(QueryKind, GenQueries, DeleteQueries);
#undef UNSHOT_GL_KIND

struct ProgramKind {
  static GLuint create(const Functions& fn) { return fn.CreateProgram(); }
  static void destroy(const Functions& fn, GLuint id) { fn.DeleteProgram(id); }
};

using Buffer = Object<BufferKind>;
using Texture = Object<TextureKind>;
using Renderbuffer = Object<RenderbufferKind>;
using VertexArray = Object<VertexArrayKind>;
using Query = Object<QueryKind>;

class Framebuffer : public Object<FramebufferKind> {
 public:
  using Object::Object;
  /// Throws Error kEnvironment where the framebuffer bound to GL_FRAMEBUFFER is not complete; `what` names
  /// it.
  void checkComplete(std::string_view what) const;
};

/// A linked program.
class Program : public Object<ProgramKind> {
 public:
  Program() = default;
  /// Compiles and links shaders by their names (see shaders.h); the stage follows from the ending: .vert,
  /// .geom, .frag. Throws Error kInternal with the driver's message, the file and the line.
  Program(Context& context, std::initializer_list<std::string_view> shaders);

  void use() const;
  /// -1 where the program has no such uniform (or does not use it); setting that does nothing.
  GLint uniform(const char* name) const;
};

/// Throws an Error where a GL error is pending (kEnvironment for memory used up and a lost context, else
/// kInternal); `where` says after what.
void checkErrors(const Functions& fn, std::string_view where);

}  // namespace unshot::gl
