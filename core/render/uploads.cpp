#include "render/uploads.h"

#include <algorithm>
#include <cmath>

namespace unshot {
namespace {

constexpr std::size_t kScratchBytes = 1 << 18;  // stays in the cache
constexpr double kLargestValue = 1e36;

}  // namespace

void allocate(const gl::Buffer& buffer, std::size_t bytes, GLenum usage) {
  const gl::Functions& fn = buffer.fn();
  // The binding point says nothing about the use; this one disturbs no vertex array.
  fn.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.id());
  fn.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, usage);
  fn.BindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

void attachTexels(const gl::Texture& texture, GLenum format, const gl::Buffer& buffer) {
  const gl::Functions& fn = texture.fn();
  fn.BindTexture(GL_TEXTURE_BUFFER, texture.id());
  fn.TexBuffer(GL_TEXTURE_BUFFER, format, buffer.id());
  fn.BindTexture(GL_TEXTURE_BUFFER, 0);
}

float finiteValue(double v) {
  return std::isfinite(v) ? static_cast<float>(std::clamp(v, -kLargestValue, kLargestValue)) : 0.0f;
}

glm::vec3 finiteValue(const glm::vec3& value) {
  return {finiteValue(value.x), finiteValue(value.y), finiteValue(value.z)};
}

std::size_t Uploads::bytes() const {
  std::size_t sum = 0;
  for (const Upload& u : upload_) sum += u.stride * (u.count - u.sent);
  return sum;
}

void Uploads::some(std::size_t bytes) {
  scratch_.resize(kScratchBytes);
  for (std::size_t sent = 0; !upload_.empty() && sent < bytes;) {
    Upload& u = upload_.front();
    const std::size_t most = std::min(bytes - sent, kScratchBytes) / u.stride;
    const std::size_t count = std::min(std::max<std::size_t>(most, 1), u.count - u.sent);
    u.fill(u.sent, count, scratch_.data());
    const gl::Functions& fn = u.buffer->fn();
    // The binding point says nothing about the use; this one disturbs no vertex array.
    fn.BindBuffer(GL_COPY_WRITE_BUFFER, u.buffer->id());
    fn.BufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(u.stride * u.sent),
                     static_cast<GLsizeiptr>(u.stride * count), scratch_.data());
    fn.BindBuffer(GL_COPY_WRITE_BUFFER, 0);
    u.sent += count;
    sent += u.stride * count;
    if (u.sent == u.count) upload_.pop_front();
  }
}

}  // namespace unshot
