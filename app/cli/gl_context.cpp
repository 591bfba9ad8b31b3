#include "cli/gl_context.h"

namespace unshot {

gl::Context& LazyContext::get() {
  if (!context_) {
    context_ = gl::createContext(key_);
    context_->makeCurrent();
  }
  return *context_;
}

std::optional<GlRecord> LazyContext::record() const {
  if (!context_) return std::nullopt;
  const gl::ContextInfo& info = context_->info();
  return GlRecord{info.provider, info.renderer, info.vendor, info.version, info.hardware};
}

}  // namespace unshot
