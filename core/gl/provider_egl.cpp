// EGL without a surface: reaches a GPU on a machine without a display (EGL_EXT_platform_device), and Mesa's
// software renderer where there is none (EGL_MESA_platform_surfaceless). libEGL is opened at run time.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/error.h"
#include "gl/provider.h"

namespace unshot::gl {
namespace {

bool hasExtension(const char* list, std::string_view name) {
  std::string_view rest = list ? list : "";
  while (!rest.empty()) {
    const std::size_t space = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, space) == name) return true;
    rest.remove_prefix(std::min(space + 1, rest.size()));
  }
  return false;
}

struct Egl {
  static void quieten() { setenv("EGL_LOG_LEVEL", "fatal", 0); }

  // Mesa warns on stderr about every GPU it fails to open; failures are reported by Error instead.
  bool quiet = (quieten(), true);
  Library library{"libEGL.so.1", "libEGL.so"};
  decltype(&eglGetProcAddress) get_proc_address = nullptr;
  decltype(&eglQueryString) query_string = nullptr;
  decltype(&eglInitialize) initialise = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglChooseConfig) choose_config = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
  decltype(&eglGetError) get_error = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
  PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;
  bool surfaceless = false;

  Egl() {
    library.load(get_proc_address, "eglGetProcAddress");
    library.load(query_string, "eglQueryString");
    library.load(initialise, "eglInitialize");
    library.load(bind_api, "eglBindAPI");
    library.load(choose_config, "eglChooseConfig");
    library.load(create_context, "eglCreateContext");
    library.load(destroy_context, "eglDestroyContext");
    library.load(make_current, "eglMakeCurrent");
    library.load(get_error, "eglGetError");
    if (!library.problem().empty()) return;
    const char* client = query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const bool devices = hasExtension(client, "EGL_EXT_platform_device");
    surfaceless = hasExtension(client, "EGL_MESA_platform_surfaceless");
    extension(get_platform_display, "eglGetPlatformDisplayEXT");
    if (devices) {
      extension(query_devices, "eglQueryDevicesEXT");
      extension(query_device_string, "eglQueryDeviceStringEXT");
    }
  }

 private:
  template <class Function>
  void extension(Function& function, const char* name) {
    function = reinterpret_cast<Function>(get_proc_address(name));
  }
};

const Egl& egl() {
  static const Egl library;
  return library;
}

// A way to a display: a device of EGL_EXT_platform_device, or null for Mesa's surfaceless platform.
struct Route {
  EGLDeviceEXT device = EGL_NO_DEVICE_EXT;
  bool software = false;
};

// GPUs first.
std::vector<Route> routes() {
  std::vector<Route> found;
  if (egl().get_platform_display && egl().query_devices && egl().query_device_string) {
    EGLint count = 0;
    egl().query_devices(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(std::max(count, 0)));
    if (!devices.empty() && egl().query_devices(count, devices.data(), &count)) {
      for (EGLDeviceEXT device : devices) {
        const char* extensions = egl().query_device_string(device, EGL_EXTENSIONS);
        found.push_back({device, hasExtension(extensions, "EGL_MESA_device_software")});
      }
    }
  }
  std::stable_partition(found.begin(), found.end(), [](const Route& r) { return !r.software; });
  if (egl().get_platform_display && egl().surfaceless) {
    const auto first_software =
        std::find_if(found.begin(), found.end(), [](const Route& r) { return r.software; });
    found.insert(first_software, Route{EGL_NO_DEVICE_EXT, true});
  }
  return found;
}

class EglProviderContext final : public Context {
 public:
  explicit EglProviderContext(const Route& route) {
    // Displays are never terminated: that would end every context of the display, and EGL shares displays.
    display_ = route.device == EGL_NO_DEVICE_EXT
                   ? egl().get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr)
                   : egl().get_platform_display(EGL_PLATFORM_DEVICE_EXT, route.device, nullptr);
    if (display_ == EGL_NO_DISPLAY || !egl().initialise(display_, nullptr, nullptr))
      fail("no display can be opened");
    const char* extensions = egl().query_string(display_, EGL_EXTENSIONS);
    if (!hasExtension(extensions, "EGL_KHR_surfaceless_context"))
      fail("EGL_KHR_surfaceless_context is missing");
    egl().bind_api(EGL_OPENGL_API);
    const EGLConfig config = chooseConfig(extensions);
    for (const auto& [major, minor] : {std::pair{4, 5}, std::pair{3, 3}}) {
      const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   major,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   minor,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                   EGL_NONE};
      context_ = egl().create_context(display_, config, EGL_NO_CONTEXT, attributes);
      if (context_ != EGL_NO_CONTEXT) break;
    }
    if (context_ == EGL_NO_CONTEXT) fail("no OpenGL 3.3 core context");
    try {
      initialise("egl",
                 [](const char* name) { return reinterpret_cast<void*>(egl().get_proc_address(name)); });
    } catch (...) {
      release();
      egl().destroy_context(display_, context_);
      throw;
    }
  }
  ~EglProviderContext() override {
    release();
    egl().destroy_context(display_, context_);
  }

 private:
  void bind() override {
    egl().bind_api(EGL_OPENGL_API);  // per thread
    if (!egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      fail("cannot make a context current");
  }
  void unbind() override {
    egl().bind_api(EGL_OPENGL_API);
    egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

  EGLConfig chooseConfig(const char* extensions) const {
    if (hasExtension(extensions, "EGL_KHR_no_config_context")) return EGL_NO_CONFIG_KHR;
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!egl().choose_config(display_, wanted, &config, 1, &count) || count == 0)
      fail("no OpenGL configuration");
    return config;
  }

  [[noreturn]] static void fail(const std::string& what) {
    char code[16];
    std::snprintf(code, sizeof code, "0x%x", static_cast<unsigned>(egl().get_error()));
    throw Error(ErrorKind::kEnvironment, "EGL: " + what + " (EGL error " + code + ")");
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

std::string eglProblem() {
  if (!egl().library.problem().empty()) return egl().library.problem();
  if (routes().empty())
    return "libEGL knows neither EGL_EXT_platform_device nor EGL_MESA_platform_surfaceless";
  return {};
}

std::unique_ptr<Context> createEgl(bool hardware_only) {
  const std::string problem = eglProblem();
  if (!problem.empty()) throw Error(ErrorKind::kEnvironment, problem);
  std::string first_failure = "EGL: no GPU";
  bool failed = false;
  for (const Route& route : routes()) {
    if (hardware_only && route.software) continue;
    try {
      auto context = std::make_unique<EglProviderContext>(route);
      if (!hardware_only || context->info().hardware) return context;
    } catch (const Error& error) {
      if (!failed) first_failure = error.what();
      failed = true;
    }
  }
  throw Error(ErrorKind::kEnvironment, first_failure);
}

}  // namespace

Provider eglProvider() {
  return {{"egl", "EGL", "a GPU without a display, or Mesa's software renderer"},
          createEgl,
          eglProblem,
          "libegl1 libgl1-mesa-dri"};
}

}  // namespace unshot::gl
