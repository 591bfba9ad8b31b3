#include "gl/functions.h"

#include <string>

#include "base/error.h"

namespace unshot::gl {

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
  return functions;
}

}  // namespace unshot::gl
