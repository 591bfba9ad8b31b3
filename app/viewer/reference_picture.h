// A picture from elsewhere, such as a photograph or another renderer's, laid over that of the scene: both
// beside each other, parted by a line that can be moved, or the difference.
//
// Pictures are compared as they are displayed, in linear values from black 0 to white 1: light (HDR, PFM) in
// the scene's own exposure and tone curve, others (PNG) as they are. It fills the picture's height, in the
// middle: what the same camera with the same vertical angle of view sees.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "base/image.h"
#include "gl/objects.h"
#include "viewer/scene_area.h"

namespace unshot {

/// All calls on the thread where the context is current.
class ReferencePicture {
 public:
  /// What its file holds.
  struct Content {
    std::filesystem::path file;
    bool light = false;          ///< linear light, to be exposed
    std::vector<ImageF> levels;  ///< lowest rows first; each half as large as the one before
  };
  /// Any thread. Throws Error (kInput) where the file is no picture, Cancelled.
  static Content read(const std::filesystem::path& file, const CancelToken& cancel = {});
  /// Begins to send it to the driver. Throws Error (kEnvironment) where it is too large for that.
  ReferencePicture(gl::Context& context, Content content);
  /// Goes on with that until wallSeconds() is about `deadline`. Nothing may be drawn before it is whole.
  /// Throws Error (kEnvironment).
  void upload(double deadline);
  /// How much is there, from 0 to 1, which is whole.
  double uploaded() const;

  /// How the scene's picture is shown, and where the line is: 0 left, 1 right.
  struct Look {
    ViewOptions view;
    double exposure = 1;  ///< SceneArea::exposure
    double wipe = 0.5;
    bool difference = false;
  };
  /// Whether the display mode shows what can be compared.
  static bool comparable(const ViewOptions& view);

  const std::string& name() const { return name_; }
  /// RMS of the difference from this picture over RMS of this picture, over pixels and channels, of what
  /// measure() saw; none before, or where no pixel is in both.
  const std::optional<double>& error() const { return error_; }

  /// Copies the scene's picture to the lower left of the bound draw framebuffer, into so many columns.
  using CopyScene = std::function<void(int width)>;
  /// Draws both over the lower left of `framebuffer`, where the scene's picture is `width` x `height`.
  void draw(const CopyScene& scene, GLuint framebuffer, int width, int height, const Look& look);
  /// Finds error(), where the picture is another than before.
  void measure(const SceneArea& scene, int width, int height, const Look& look);
  /// Whether it is.
  bool unmeasured(const SceneArea& scene, int width, int height, const Look& look) const;

 private:
  struct Picture {
    gl::Texture texture;
    gl::Framebuffer framebuffer;
    int width = 0, height = 0;
  };
  void allocate(Picture& picture, int width, int height);
  void compose(GLuint framebuffer, const Look& look, double wipe, bool difference);
  void takeOurs(const CopyScene& scene, int width, int height);

  gl::Context& context_;
  std::string name_;
  bool light_;  // the file holds linear light, to be exposed
  double aspect_;
  gl::Program program_;
  std::string program_tone_;  // the tone curve in it
  gl::VertexArray no_attributes_;
  gl::Texture reference_;
  std::vector<ImageF> levels_;       // what is still to be sent
  std::size_t level_ = 0, row_ = 0;  // the first that is not sent
  std::size_t sent_ = 0, bytes_ = 0;
  Picture ours_, theirs_;
  std::optional<double> error_;
  /// What error_ is of.
  struct Measured {
    std::uint64_t version;
    int width, height;
    std::string display, tone;
    double exposure;
    bool operator==(const Measured&) const = default;
  };
  static Measured measuredOf(const SceneArea& scene, int width, int height, const Look& look);
  std::optional<Measured> measured_;
};

}  // namespace unshot
