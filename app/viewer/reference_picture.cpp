#include "viewer/reference_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/error.h"
#include "base/srgb.h"
#include "export/image_files.h"
#include "render/display_modes.h"
#include "render/targets.h"
#include "render/uploads.h"
#include "viewer/mip_levels.h"

namespace unshot {
namespace {

constexpr double kFileShare = 0.8;               // of the time until it is in memory; the rest: levels
constexpr std::size_t kUploadPixels = 1u << 16;  // sent at a time

// OpenGL's first row is the lowest.
void turnOver(ImageF& image) {
  const auto row = 3 * static_cast<std::ptrdiff_t>(image.width);
  for (std::ptrdiff_t low = 0, high = image.height - 1; low < high; ++low, --high)
    std::swap_ranges(image.rgb.begin() + low * row, image.rgb.begin() + (low + 1) * row,
                     image.rgb.begin() + high * row);
}

double scaleOf(const ReferencePicture::Look& look) {
  return look.exposure * std::exp2(std::clamp(look.view.exposure_ev, -200.0, 200.0));
}

std::vector<std::uint8_t> pixelsOf(const gl::Functions& fn, const gl::Framebuffer& framebuffer, int width,
                                   int height) {
  std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  fn.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.id());
  fn.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  return pixels;
}

/// RMS(ours - theirs) / RMS(theirs) over the pixels that are opaque in theirs.
std::optional<double> relativeError(const std::vector<std::uint8_t>& ours,
                                    const std::vector<std::uint8_t>& theirs) {
  std::array<double, 256> linear{};
  for (std::size_t k = 0; k < linear.size(); ++k) linear[k] = linearFromSrgb(static_cast<double>(k) / 255);
  double difference = 0, reference = 0;
  for (std::size_t k = 0; k < ours.size(); k += 4) {
    if (theirs[k + 3] == 0) continue;
    for (std::size_t c = k; c < k + 3; ++c) {
      const double b = linear[theirs[c]], d = linear[ours[c]] - b;
      difference += d * d;
      reference += b * b;
    }
  }
  return reference > 0 ? std::optional(std::sqrt(difference / reference)) : std::nullopt;
}

}  // namespace

ReferencePicture::Content ReferencePicture::read(const std::filesystem::path& file,
                                                 const CancelToken& cancel) {
  PictureFile picture = readPicture(file, cancel.part(0, kFileShare));
  cancel.report(kFileShare);
  turnOver(picture.image);
  return {file, picture.light, mipLevels(std::move(picture.image), cancel)};
}

ReferencePicture::ReferencePicture(gl::Context& context, Content content)
    : context_(context),
      name_(content.file.filename().string()),
      light_(content.light),
      no_attributes_(context),
      reference_(context),
      levels_(std::move(content.levels)),
      ours_{gl::Texture(context), gl::Framebuffer(context)},
      theirs_{gl::Texture(context), gl::Framebuffer(context)} {
  const gl::Functions& fn = context.functions();
  const ImageF& image = levels_.front();
  GLint largest = 0;
  fn.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (std::max(image.width, image.height) > largest) {
    throw Error(ErrorKind::kEnvironment,
                "the picture has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                    " pixels; this OpenGL driver takes " + std::to_string(largest) + " at most along a side",
                content.file.string(), "a smaller picture");
  }
  aspect_ = static_cast<double>(image.width) / image.height;
  fn.BindTexture(GL_TEXTURE_2D, reference_.id());
  const auto last = static_cast<GLint>(levels_.size()) - 1;
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, last);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  for (GLint level = 0; level <= last; ++level) {
    const ImageF& one = levels_[static_cast<std::size_t>(level)];
    fn.TexImage2D(GL_TEXTURE_2D, level, GL_RGB32F, one.width, one.height, 0, GL_RGB, GL_FLOAT, nullptr);
    bytes_ += one.rgb.size() * sizeof(float);
  }
  fn.BindTexture(GL_TEXTURE_2D, 0);
  gl::checkErrors(fn, "making room for the picture " + name_);
}

void ReferencePicture::upload(double deadline) {
  if (levels_.empty()) return;
  const gl::Functions& fn = context_.functions();
  fn.BindTexture(GL_TEXTURE_2D, reference_.id());
  fn.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  do {
    const ImageF& image = levels_[level_];
    const std::size_t width = static_cast<std::size_t>(image.width),
                      height = static_cast<std::size_t>(image.height);
    const std::size_t rows = std::clamp<std::size_t>(kUploadPixels / width, 1, height - row_);
    fn.TexSubImage2D(GL_TEXTURE_2D, static_cast<GLint>(level_), 0, static_cast<GLint>(row_), image.width,
                     static_cast<GLsizei>(rows), GL_RGB, GL_FLOAT, &image.rgb[3 * width * row_]);
    sent_ += 3 * sizeof(float) * width * rows;
    row_ += rows;
    if (row_ < height) continue;
    row_ = 0;
    if (++level_ == levels_.size()) levels_ = {};
  } while (!levels_.empty() && wallSeconds() < deadline);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  gl::checkErrors(fn, "sending the picture " + name_ + " to the driver");
}

double ReferencePicture::uploaded() const {
  return levels_.empty() ? 1 : static_cast<double>(sent_) / static_cast<double>(bytes_);
}

bool ReferencePicture::comparable(const ViewOptions& view) {
  const DisplayMode& mode = displayMode(view.display);
  return mode.tone_mapped && !mode.false_colour;
}

void ReferencePicture::allocate(Picture& picture, int width, int height) {
  if (width == picture.width && height == picture.height) return;
  const gl::Functions& fn = context_.functions();
  fn.BindTexture(GL_TEXTURE_2D, picture.texture.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  fn.BindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer.id());
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.texture.id(), 0);
  picture.framebuffer.checkComplete("a picture beside a reference");
  picture.width = width;
  picture.height = height;
}

void ReferencePicture::takeOurs(const CopyScene& scene, int width, int height) {
  const gl::Functions& fn = context_.functions();
  allocate(ours_, width, height);
  fn.BindFramebuffer(GL_FRAMEBUFFER, ours_.framebuffer.id());
  fn.ClearColor(0, 0, 0, 1);
  fn.Clear(GL_COLOR_BUFFER_BIT);
  scene(width);
}

void ReferencePicture::compose(GLuint framebuffer, const Look& look, double wipe, bool difference) {
  const gl::Functions& fn = context_.functions();
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  setPassState(fn, false);
  fn.Viewport(0, 0, ours_.width, ours_.height);
  if (program_tone_ != look.view.tone) {
    program_ =
        gl::Program(context_, {"frame.vert", "reference_picture.frag", toneCurve(look.view.tone).shader});
    program_tone_ = look.view.tone;
  }
  program_.use();
  const std::array<GLuint, 2> textures = {ours_.texture.id(), reference_.id()};
  for (GLint unit = 0; unit < 2; ++unit) {
    fn.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    fn.BindTexture(GL_TEXTURE_2D, textures[static_cast<std::size_t>(unit)]);
    fn.Uniform1i(program_.uniform(unit == 0 ? "ours" : "reference"), unit);
  }
  const double aspect = static_cast<double>(ours_.width) / ours_.height;
  fn.Uniform2f(program_.uniform("size"), static_cast<GLfloat>(ours_.width),
               static_cast<GLfloat>(ours_.height));
  fn.Uniform1f(program_.uniform("across"), static_cast<GLfloat>(aspect / aspect_));
  const auto background = static_cast<GLfloat>(srgbFromLinear(kBackground));
  fn.Uniform3f(program_.uniform("background"), background, background, background);
  fn.Uniform1f(program_.uniform("exposure"), finiteValue(scaleOf(look)));
  fn.Uniform1i(program_.uniform("light"), light_);
  fn.Uniform1f(program_.uniform("wipe"), static_cast<GLfloat>(wipe * ours_.width));
  fn.Uniform1i(program_.uniform("difference"), difference);
  fn.BindVertexArray(no_attributes_.id());
  fn.DrawArrays(GL_TRIANGLES, 0, 3);
}

void ReferencePicture::draw(const CopyScene& scene, GLuint framebuffer, int width, int height,
                            const Look& look) {
  if (width <= 0 || height <= 0 || !comparable(look.view)) return;
  const StateGuard guard(context_.functions());
  takeOurs(scene, width, height);
  compose(framebuffer, look, look.wipe, look.difference);
}

ReferencePicture::Measured ReferencePicture::measuredOf(const SceneArea& scene, int width, int height,
                                                        const Look& look) {
  return {scene.version(), width, height, look.view.display, look.view.tone, scaleOf(look)};
}

bool ReferencePicture::unmeasured(const SceneArea& scene, int width, int height, const Look& look) const {
  return width > 0 && height > 0 && comparable(look.view) &&
         measured_ != measuredOf(scene, width, height, look);
}

void ReferencePicture::measure(const SceneArea& scene, int width, int height, const Look& look) {
  if (!unmeasured(scene, width, height, look)) return;
  measured_ = measuredOf(scene, width, height, look);
  const gl::Functions& fn = context_.functions();
  const StateGuard guard(fn);
  takeOurs([&](int columns) { scene.copyTo(columns); }, width, height);
  allocate(theirs_, width, height);
  compose(theirs_.framebuffer.id(), look, 0, false);
  error_ = relativeError(pixelsOf(fn, ours_.framebuffer, width, height),
                         pixelsOf(fn, theirs_.framebuffer, width, height));
}

}  // namespace unshot
