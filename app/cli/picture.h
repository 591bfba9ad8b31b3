// What a solve shows: its picture, made once however many files want it, and the exposure of its vertices.
#pragma once

#include <optional>

#include "cli/gl_context.h"
#include "render/picture.h"
#include "session/snapshot.h"

namespace unshot {

/// Refers to what it is made with.
class PictureMaker {
 public:
  PictureMaker(LazyContext& context, const Snapshot& snapshot, const PictureOptions& options)
      : context_(context), snapshot_(snapshot), options_(options) {}
  /// Throws what renderPicture throws.
  const Picture& get();

 private:
  LazyContext& context_;
  const Snapshot& snapshot_;
  const PictureOptions& options_;
  std::optional<Picture> picture_;
};

/// The factor from B to about 1 for white, found from the vertices as the picture's is from its pixels.
double vertexExposure(const Snapshot& snapshot, bool with_ambient);

}  // namespace unshot
