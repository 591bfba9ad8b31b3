#include "render/picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <new>
#include <vector>

#include "base/error.h"
#include "render/automatic_camera.h"
#include "render/scene_view.h"

namespace unshot {
namespace {

constexpr int kSamplesAlongPixel = 3;
constexpr int kTilePixels = 640;  // along a tile's side: 74 MB of samples

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void checkOptions(const PictureOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > kLargestPicture ||
      options.height > kLargestPicture) {
    throw Error(
        ErrorKind::kUsage,
        "a picture cannot be " + std::to_string(options.width) + "x" + std::to_string(options.height) +
            " pixels",
        {}, "a size from 1x1 to " + std::to_string(kLargestPicture) + "x" + std::to_string(kLargestPicture));
  }
  if (options.fov_deg && !(*options.fov_deg > 0 && *options.fov_deg < 180)) {
    throw Error(ErrorKind::kUsage, "the angle of view must lie between 0 and 180 degrees", {}, "--fov 40");
  }
  for (const auto& v : {options.eye, options.at, options.up}) {
    if (v && !finite(*v)) throw Error(ErrorKind::kUsage, "eye, at and up must be finite");
  }
  if (options.up && glm::length(*options.up) == 0) throw Error(ErrorKind::kUsage, "up must not be 0,0,0");
  if (!std::isfinite(options.exposure_ev)) throw Error(ErrorKind::kUsage, "the exposure must be finite");
  displayMode(options.display);
}

// The framebuffer of one tile: as displayed, and linear.
struct TileTarget {
  gl::Texture display, linear;
  gl::Framebuffer framebuffer;

  TileTarget(gl::Context& context, int width, int height)
      : display(context), linear(context), framebuffer(context) {
    const gl::Functions& fn = context.functions();
    fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    attach(fn, display, GL_COLOR_ATTACHMENT0, GL_RGBA8, GL_UNSIGNED_BYTE, width, height);
    attach(fn, linear, GL_COLOR_ATTACHMENT1, GL_RGBA32F, GL_FLOAT, width, height);
    const GLenum outputs[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    fn.DrawBuffers(2, outputs);
    framebuffer.checkComplete("a tile of a picture");
  }

 private:
  static void attach(const gl::Functions& fn, const gl::Texture& texture, GLenum point, GLint format,
                     GLenum type, int width, int height) {
    fn.BindTexture(GL_TEXTURE_2D, texture.id());
    fn.TexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, GL_RGBA, type, nullptr);
    fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    fn.FramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, texture.id(), 0);
    fn.BindTexture(GL_TEXTURE_2D, 0);
  }
};

// Copies a tile (lowest row first, 4 channels) to its place in a picture (highest row first, 3 channels).
template <class T>
void copyTile(const std::vector<T>& tile, const Viewport& place, int picture_width, int picture_height,
              std::vector<T>& rgb) {
  const auto width = static_cast<std::size_t>(place.width);
  for (int y = 0; y < place.height; ++y) {
    const T* from = &tile[4 * static_cast<std::size_t>(y) * width];
    const auto row = static_cast<std::size_t>(picture_height - 1 - place.y - y);
    T* to = &rgb[3 * (row * static_cast<std::size_t>(picture_width) + static_cast<std::size_t>(place.x))];
    for (std::size_t x = 0; x < width; ++x) std::copy_n(from + 4 * x, 3, to + 3 * x);
  }
}

class TiledPicture {
 public:
  TiledPicture(gl::Context& context, SceneView& view, const ViewOptions& options, Picture& picture)
      : context_(context), view_(view), options_(options), picture_(picture) {}

  // `tile` in pixels of the picture, from its lower left.
  void draw(const Viewport& tile) {
    const gl::Functions& fn = context_.functions();
    const double width = picture_.srgb.width;
    const double height = picture_.srgb.height;
    const FrameWindow window = {{tile.x / width, tile.y / height},
                                {(tile.x + tile.width) / width, (tile.y + tile.height) / height}};
    prepare(tile.width, tile.height);
    samples_.bind();
    view_.drawLinear(picture_.camera, width / height, window, options_);
    fn.BindFramebuffer(GL_FRAMEBUFFER, target_->framebuffer.id());
    view_.resolve(samples_, *options_.automatic_exposure, options_, {0, 0, tile.width, tile.height});
    read(tile, GL_COLOR_ATTACHMENT0, GL_UNSIGNED_BYTE, picture_.srgb.rgb);
    if (!picture_.linear.rgb.empty()) read(tile, GL_COLOR_ATTACHMENT1, GL_FLOAT, picture_.linear.rgb);
    gl::checkErrors(fn, "drawing a picture");
  }

 private:
  void prepare(int width, int height) {
    const int samples_width = width * options_.supersampling;
    const int samples_height = height * options_.supersampling;
    if (target_ && samples_.width() == samples_width && samples_.height() == samples_height) return;
    target_.reset();
    samples_ = LinearTarget();
    samples_ = LinearTarget(context_, samples_width, samples_height);
    target_.emplace(context_, width, height);
  }

  template <class T>
  void read(const Viewport& tile, GLenum attachment, GLenum type, std::vector<T>& rgb) {
    const gl::Functions& fn = context_.functions();
    std::vector<T> pixels(4 * static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height));
    fn.ReadBuffer(attachment);
    fn.PixelStorei(GL_PACK_ALIGNMENT, 1);
    fn.ReadPixels(0, 0, tile.width, tile.height, GL_RGBA, type, pixels.data());
    fn.PixelStorei(GL_PACK_ALIGNMENT, 4);
    copyTile(pixels, tile, picture_.srgb.width, picture_.srgb.height, rgb);
  }

  gl::Context& context_;
  SceneView& view_;
  const ViewOptions& options_;
  Picture& picture_;
  LinearTarget samples_;
  std::optional<TileTarget> target_;
};

Picture drawPicture(gl::Context& context, const Snapshot& snapshot, const PictureOptions& options) {
  const std::size_t values =
      3 * static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  Picture picture;
  picture.srgb = {options.width, options.height, std::vector<std::uint8_t>(values)};
  if (options.linear) picture.linear = {options.width, options.height, std::vector<float>(values)};
  picture.camera = pictureCamera(context, snapshot, options);

  const StateGuard guard(context.functions());
  SceneView view(context);
  view.setSnapshot(snapshot);
  ViewOptions how;
  how.display = options.display;
  how.exposure_ev = options.exposure_ev;
  how.ambient = options.ambient;
  how.supersampling = kSamplesAlongPixel;
  how.reference = options.reference;
  how.automatic_exposure =
      view.exposureFor(picture.camera, static_cast<double>(options.width) / options.height, how);
  picture.exposure = *how.automatic_exposure * std::exp2(options.exposure_ev);
  TiledPicture tiles(context, view, how, picture);
  for (int y = 0; y < options.height; y += kTilePixels) {
    for (int x = 0; x < options.width; x += kTilePixels) {
      tiles.draw({x, y, std::min(kTilePixels, options.width - x), std::min(kTilePixels, options.height - y)});
    }
  }
  return picture;
}

}  // namespace

Picture renderPicture(gl::Context& context, const Snapshot& snapshot, const PictureOptions& options) {
  checkOptions(options);
  try {
    return drawPicture(context, snapshot, options);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::kEnvironment,
                "there is not enough memory for a picture of " + std::to_string(options.width) + "x" +
                    std::to_string(options.height) + " pixels",
                {}, "a smaller --size");
  }
}

Camera pictureCamera(gl::Context& context, const Snapshot& snapshot, const PictureOptions& options) {
  checkOptions(options);
  const glm::dvec3 origin = snapshot.mesh->frame_origin;
  const Bounds bounds{snapshot.mesh->bounds_min, snapshot.mesh->bounds_max};
  const glm::dvec3 up = options.up.value_or(glm::dvec3(0, 1, 0));
  Camera camera;
  if (options.eye) {
    camera.eye = *options.eye - origin;
    camera.at = bounds.centre();
    camera.fov_deg = options.fov_deg.value_or(camera.fov_deg);
  } else {
    const double aspect = static_cast<double>(options.width) / options.height;
    camera = automaticCamera(context, snapshot, {aspect, options.fov_deg, up});
  }
  if (options.at) camera.at = *options.at - origin;
  camera.up = up;
  if (camera.eye == camera.at) {
    throw Error(ErrorKind::kUsage, "the eye is at the point that it looks at", {}, "another --eye or --at");
  }
  return camera;
}

}  // namespace unshot
