#include "viewer/reference_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/srgb.h"
#include "export/image_files.h"
#include "render/display_modes.h"
#include "render/targets.h"
#include "render/uploads.h"

namespace unshot {
namespace {

// OpenGL's first row is the lowest.
std::vector<float> upwards(const ImageF& image) {
  std::vector<float> out;
  out.reserve(image.rgb.size());
  const auto row = 3 * static_cast<std::ptrdiff_t>(image.width);
  for (std::ptrdiff_t y = image.height - 1; y >= 0; --y)
    out.insert(out.end(), image.rgb.begin() + y * row, image.rgb.begin() + (y + 1) * row);
  return out;
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
  const bool light = holdsLight(file);
  cancel.check();
  const ImageF image = readImage(file);
  cancel.check();
  return {file, light, image.width, image.height, upwards(image)};
}

ReferencePicture::ReferencePicture(gl::Context& context, const Content& image)
    : context_(context),
      name_(image.file.filename().string()),
      light_(image.light),
      no_attributes_(context),
      reference_(context),
      ours_{gl::Texture(context), gl::Framebuffer(context)},
      theirs_{gl::Texture(context), gl::Framebuffer(context)} {
  const gl::Functions& fn = context.functions();
  GLint largest = 0;
  fn.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (std::max(image.width, image.height) > largest) {
    throw Error(ErrorKind::kEnvironment,
                "the picture has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                    " pixels; this OpenGL driver takes " + std::to_string(largest) + " at most along a side",
                image.file.string(), "a smaller picture");
  }
  aspect_ = static_cast<double>(image.width) / image.height;
  fn.BindTexture(GL_TEXTURE_2D, reference_.id());
  fn.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, image.width, image.height, 0, GL_RGB, GL_FLOAT,
                image.rgb.data());
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  fn.GenerateMipmap(GL_TEXTURE_2D);
  fn.BindTexture(GL_TEXTURE_2D, 0);
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

void ReferencePicture::measure(const SceneArea& scene, int width, int height, const Look& look) {
  if (width <= 0 || height <= 0 || !comparable(look.view)) return;
  const Measured now{scene.version(), width, height, look.view.display, look.view.tone, scaleOf(look)};
  if (measured_ == now) return;
  measured_ = now;
  const gl::Functions& fn = context_.functions();
  const StateGuard guard(fn);
  takeOurs([&](int columns) { scene.copyTo(columns); }, width, height);
  allocate(theirs_, width, height);
  compose(theirs_.framebuffer.id(), look, 0, false);
  error_ = relativeError(pixelsOf(fn, ours_.framebuffer, width, height),
                         pixelsOf(fn, theirs_.framebuffer, width, height));
}

}  // namespace unshot
