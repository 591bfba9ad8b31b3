#include <dlfcn.h>

#include "gl/provider.h"

namespace unshot::gl {

Library::Library(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    // RTLD_LOCAL: the gl symbols of two providers must not see each other.
    handle_ = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    if (handle_) {
      name_ = name;
      problem_.clear();
      return;
    }
    const char* reason = dlerror();
    if (problem_.empty()) problem_ = reason ? reason : std::string(name) + ": cannot be opened";
  }
}

void* Library::symbol(const char* name) {
  void* found = handle_ ? dlsym(handle_, name) : nullptr;
  if (handle_ && !found) problem_ = name_ + " has no " + name;
  return found;
}

}  // namespace unshot::gl
