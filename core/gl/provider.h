// The rows of the provider table, each made in its own file, and what they share.
#pragma once

#include <string>

#include "gl/context.h"

namespace unshot::gl {

Provider osmesaProvider();
Provider eglProvider();

/// A library opened at run time and kept open to the end of the process, since drivers leave threads and
/// thread-local data behind.
class Library {
 public:
  /// Opens the first of `names` that exists.
  explicit Library(std::initializer_list<const char*> names);
  /// Why it could not be opened, or empty.
  const std::string& problem() const { return problem_; }
  /// Sets `function` to the symbol `name`; where it is missing, to null, with a note in problem().
  template <class Function>
  void load(Function*& function, const char* name) {
    function = reinterpret_cast<Function*>(symbol(name));
  }

 private:
  void* symbol(const char* name);

  void* handle_ = nullptr;
  std::string name_;
  std::string problem_;
};

}  // namespace unshot::gl
