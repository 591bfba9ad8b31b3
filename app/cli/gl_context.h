// The GL context of a command, made when it is first needed.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gl/context.h"
#include "report/run_record.h"

namespace unshot {

/// Stays on the thread that first needs the context. Outlives everything that was made in it.
class LazyContext {
 public:
  explicit LazyContext(std::string key) : key_(std::move(key)) {}
  /// The context, current on this thread. Throws Error (kEnvironment) where there is none.
  gl::Context& get();
  /// Nothing while no context was needed.
  std::optional<GlRecord> record() const;

 private:
  std::string key_;
  std::unique_ptr<gl::Context> context_;
};

}  // namespace unshot
