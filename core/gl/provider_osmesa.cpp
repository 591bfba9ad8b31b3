// OSMesa: Mesa's software renderer without any window system. The library is opened at run time, and since it
// left Mesa with 25.1 its header is not needed either: the few types and numbers of its interface stand here.
#include <array>
#include <cstdint>

#include "base/error.h"
#include "gl/provider.h"

namespace unshot::gl {
namespace {

constexpr int kFormat = 0x22;
constexpr int kDepthBits = 0x30;
constexpr int kProfile = 0x33;
constexpr int kCoreProfile = 0x34;
constexpr int kMajorVersion = 0x36;
constexpr int kMinorVersion = 0x37;

using OsmesaContext = struct OsmesaContextTag*;

struct Osmesa {
  Library library{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  OsmesaContext (*create)(const int*, OsmesaContext) = nullptr;
  void (*destroy)(OsmesaContext) = nullptr;
  unsigned char (*make_current)(OsmesaContext, void*, GLenum, GLsizei, GLsizei) = nullptr;
  void* (*get_proc_address)(const char*) = nullptr;

  Osmesa() {
    library.load(create, "OSMesaCreateContextAttribs");
    library.load(destroy, "OSMesaDestroyContext");
    library.load(make_current, "OSMesaMakeCurrent");
    library.load(get_proc_address, "OSMesaGetProcAddress");
  }
};

const Osmesa& osmesa() {
  static const Osmesa library;
  return library;
}

class OsmesaProviderContext final : public Context {
 public:
  OsmesaProviderContext() {
    for (const auto& [major, minor] : {std::pair{4, 5}, std::pair{3, 3}}) {
      const std::array<int, 11> attributes = {kFormat, GL_RGBA,       kProfile, kCoreProfile,  kDepthBits,
                                              0,       kMajorVersion, major,    kMinorVersion, minor,
                                              0};
      context_ = osmesa().create(attributes.data(), nullptr);
      if (context_) break;
    }
    if (!context_) throw Error(ErrorKind::kEnvironment, "OSMesa refuses an OpenGL 3.3 core context");
    try {
      initialise("osmesa", osmesa().get_proc_address);
    } catch (...) {
      release();
      osmesa().destroy(context_);
      throw;
    }
  }
  ~OsmesaProviderContext() override {
    release();
    osmesa().destroy(context_);
  }

 private:
  void bind() override {
    if (!osmesa().make_current(context_, buffer_.data(), GL_UNSIGNED_BYTE, kBufferSize, kBufferSize)) {
      throw Error(ErrorKind::kEnvironment, "OSMesa cannot make its context current");
    }
  }
  void unbind() override { osmesa().make_current(nullptr, nullptr, 0, 0, 0); }

  // OSMesa wants a window's pixels; nothing is drawn there.
  static constexpr int kBufferSize = 4;
  std::array<std::uint32_t, kBufferSize * kBufferSize> buffer_{};
  OsmesaContext context_ = nullptr;
};

std::string osmesaProblem() { return osmesa().library.problem(); }

std::unique_ptr<Context> createOsmesa(bool hardware_only) {
  if (hardware_only) throw Error(ErrorKind::kEnvironment, "OSMesa draws in software");
  const std::string problem = osmesaProblem();
  if (!problem.empty()) throw Error(ErrorKind::kEnvironment, problem);
  return std::make_unique<OsmesaProviderContext>();
}

}  // namespace

Provider osmesaProvider() {
  return {{"osmesa", "OSMesa", "Mesa's software renderer; needs neither a display nor a GPU"},
          createOsmesa,
          osmesaProblem,
          "libosmesa6"};
}

}  // namespace unshot::gl
