#include "gl/functions.h"

#include <string>
#include <string_view>

#include "base/error.h"

namespace unshot::gl {
namespace {

// `version`: 45 for 4.5.
bool promises(const Functions& fn, int version, std::string_view extension) {
  GLint major = 0, minor = 0, count = 0;
  fn.GetIntegerv(GL_MAJOR_VERSION, &major);
  fn.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (10 * major + minor >= version) return true;
  fn.GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint k = 0; k < count; ++k) {
    const GLubyte* name = fn.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(k));
    if (name && extension == reinterpret_cast<const char*>(name)) return true;
  }
  return false;
}

}  // namespace

Functions loadFunctions(const Loader& load) {
  Functions functions;
  std::string missing;
#define UNSHOT_GL_LOAD(TYPE, NAME)                                        \
  functions.NAME = reinterpret_cast<PFNGL##TYPE##PROC>(load("gl" #NAME)); \
  if (!functions.NAME) missing += " gl" #NAME;
  UNSHOT_GL_FUNCTIONS(UNSHOT_GL_LOAD)
#undef UNSHOT_GL_LOAD
  if (!missing.empty()) {
    throw Error(ErrorKind::kEnvironment, "the OpenGL driver lacks functions of OpenGL 3.3:" + missing, {},
                "another provider with --gl, or a newer driver");
  }
#define UNSHOT_GL_LOAD(TYPE, NAME, VERSION, EXTENSION) \
  if (promises(functions, VERSION, EXTENSION))         \
    functions.NAME = reinterpret_cast<PFNGL##TYPE##PROC>(load("gl" #NAME));
  UNSHOT_GL_OPTIONAL_FUNCTIONS(UNSHOT_GL_LOAD)
#undef UNSHOT_GL_LOAD
  return functions;
}

}  // namespace unshot::gl
