// Pictures of a snapshot, without a window.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "base/image.h"
#include "render/camera.h"
#include "render/reference_light.h"
#include "session/snapshot.h"

namespace unshot {

namespace gl {
class Context;
}

/// The largest width and height of a picture [px].
inline constexpr int kLargestPicture = 16384;

struct PictureOptions {
  int width = 1280;
  int height = 960;
  // In the coordinates of the scene's file. What is not given is chosen by looking at the scene
  // (automatic_camera.h).
  std::optional<glm::dvec3> eye, at, up;
  std::optional<double> fov_deg;                    ///< vertical
  std::string display = "radiosity";                ///< key of a display mode
  double exposure_ev = 0;                           ///< stops relative to the automatic exposure
  bool ambient = false;                             ///< add the ambient term
  std::shared_ptr<const ReferenceLight> reference;  ///< as ViewOptions::reference
  bool linear = true;                               ///< fill Picture::linear too (12 bytes a pixel)
};

struct Picture {
  Image8 srgb;    ///< as displayed: exposed, tone-mapped
  ImageF linear;  ///< what the display mode shows, in its own unit (radiosity: W/m^2); 0 where nothing is
  Camera camera;  ///< that took it, in the scene's frame
  double exposure = 1;  ///< factor from linear values to the tone curve
};

/// Draws the picture in tiles, with 3 x 3 samples a pixel. On the thread where `context` is current. Throws
/// Error: kUsage for impossible options, kEnvironment where memory or the driver does not allow the size.
Picture renderPicture(gl::Context& context, const Snapshot& snapshot, const PictureOptions& options);

/// The camera that renderPicture takes.
Camera pictureCamera(gl::Context& context, const Snapshot& snapshot, const PictureOptions& options);

}  // namespace unshot
