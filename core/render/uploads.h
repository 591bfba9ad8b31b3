// Values on their way to buffers of OpenGL, some at a time, so that a window can go on living meanwhile.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "gl/objects.h"

namespace unshot {

/// Room for so many bytes, of which nothing is known yet.
void allocate(const gl::Buffer& buffer, std::size_t bytes, GLenum usage);
/// From now on the texture reads the buffer as texels of this format.
void attachTexels(const gl::Texture& texture, GLenum format, const gl::Buffer& buffer);

/// A line of uploads, done in the order in which they were added. All calls on the thread where the context
/// of the buffers is current.
class Uploads {
 public:
  /// Writes values [first, first + count) to `out`; what it reads from it keeps alive.
  template <class T>
  using Fill = std::function<void(std::size_t first, std::size_t count, T* out)>;

  /// `count` values for the beginning of the buffer, which has room for them and outlives the upload.
  template <class T>
  void add(const gl::Buffer& buffer, std::size_t count, Fill<T> fill) {
    if (count == 0) return;
    upload_.push_back({&buffer, sizeof(T), count, 0,
                       [fill = std::move(fill)](std::size_t first, std::size_t n, std::byte* out) {
                         fill(first, n, reinterpret_cast<T*>(out));
                       }});
  }
  bool done() const { return upload_.empty(); }
  /// What is left [bytes].
  std::size_t bytes() const;
  /// About so many more bytes.
  void some(std::size_t bytes);
  /// Gives up what is left.
  void clear() { upload_.clear(); }

 private:
  struct Upload {
    const gl::Buffer* buffer;
    std::size_t stride, count, sent;  // bytes; values
    Fill<std::byte> fill;
  };

  std::deque<Upload> upload_;
  std::vector<std::byte> scratch_;
};

/// The value, or 0 where it is not finite; far inside the range of float, so that sums, interpolation and
/// scaling stay finite.
float finiteValue(double value);
glm::vec3 finiteValue(const glm::vec3& value);

/// Fields of a snapshot, whatever they hold: values that are not there or not finite are 0. `Value` is
/// glm::vec3 or, for a texture, glm::vec4.
template <class Value>
Uploads::Fill<Value> finiteValues(std::shared_ptr<const std::vector<glm::vec3>> field) {
  return [field = std::move(field)](std::size_t first, std::size_t count, Value* out) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = first + k;
      out[k] = Value(0.0f);
      if (!field || i >= field->size()) continue;
      const glm::vec3 v = finiteValue((*field)[i]);
      for (int c = 0; c < 3; ++c) out[k][c] = v[c];
    }
  };
}

}  // namespace unshot
