// GPU copies of a snapshot's light, field by field: each is uploaded when the first picture reads it.
#pragma once

#include <bitset>
#include <cstddef>
#include <memory>
#include <vector>

#include "gl/objects.h"
#include "render/uploads.h"
#include "session/snapshot.h"

namespace unshot {

/// Fields of Snapshot: those of vertices, then those of elements.
enum class LightField {
  kIrradiance,
  kDirect,
  kAmbient,
  kUnshot,
  kBounces,
  kResidual,
  kElementIrradiance,
  kElementDirect
};
inline constexpr std::size_t kLightFields = 8;

/// Some of them.
class LightFieldSet {
 public:
  void add(LightField field) { set_.set(static_cast<std::size_t>(field)); }
  bool has(LightField field) const { return set_.test(static_cast<std::size_t>(field)); }

 private:
  std::bitset<kLightFields> set_;
};

/// All calls on the thread where the context is current.
class LightFields {
 public:
  explicit LightFields(gl::Context& context);

  /// From now on the copies are of this one; of those before only what both share stays, and that only on a
  /// mesh of the same cut (Mesh::cut). Gives up what is not yet uploaded.
  void setSnapshot(std::shared_ptr<const Snapshot> snapshot);
  /// Null before the first.
  const std::shared_ptr<const Snapshot>& snapshot() const { return snapshot_; }
  /// Begins to upload those of `wanted` that are neither there nor on their way. Values that are not finite,
  /// or not in the snapshot, become 0.
  void begin(const LightFieldSet& wanted);
  /// Of them, what is left to upload.
  std::size_t bytes() const { return uploads_.bytes(); }
  /// About so many more bytes.
  void upload(std::size_t bytes) { uploads_.some(bytes); }

  /// One value for each vertex: three floats.
  const gl::Buffer& vertices(LightField field) const { return copy(field).buffer; }
  /// One value for each element: four floats, the last of no meaning.
  const gl::Texture& elements(LightField field) const { return copy(field).texture; }

 private:
  using Values = std::shared_ptr<const std::vector<glm::vec3>>;
  struct Copy {
    gl::Buffer buffer;
    gl::Texture texture;    // of a field of elements, to read the buffer by; else empty
    bool begun = false;     // it is there, or on its way
    bool has_room = false;  // for the mesh
    Values of;              // what it was begun with, where snapshots share that
  };

  const Copy& copy(LightField field) const { return copies_[static_cast<std::size_t>(field)]; }
  /// Where they are in a snapshot; null where it has none.
  static Values valuesOf(const std::shared_ptr<const Snapshot>& snapshot, LightField field);

  std::shared_ptr<const Snapshot> snapshot_;
  std::vector<Copy> copies_;
  Uploads uploads_;
};

}  // namespace unshot
