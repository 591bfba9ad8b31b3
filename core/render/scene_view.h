// Draws a snapshot, for the window and for pictures alike.
//
// Two passes: the display triangles into a linear float target (values in W/m^2, whatever their scale), then
// exposure, tone curve and sRGB encoding into the framebuffer that was bound. A side without
// elements is not drawn where the other one has some: a closed room seen from outside is open like a doll's
// house. Surfaces without elements on either side are drawn black.
#pragma once

#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/tone.h"
#include "gl/objects.h"
#include "render/camera.h"
#include "render/display_modes.h"
#include "render/false_colour.h"
#include "render/reference_light.h"
#include "render/scene_buffers.h"
#include "render/targets.h"
#include "session/snapshot.h"

namespace unshot {

struct VertexField;

/// How a picture is shown; nothing here changes what is solved or uploaded.
struct ViewOptions {
  std::string display = "radiosity";  ///< key of a display mode
  double exposure_ev = 0;             ///< stops relative to the automatic exposure
  std::string tone{kUsualTone};       ///< key of a tone curve
  bool ambient = true;                ///< add the ambient term
  int supersampling = 1;              ///< samples along a pixel's side
  bool merged = false;                ///< blocks of cells as one, where that is at hand (beginMerged)
  /// Keeps this automatic exposure (what `draw` returned) instead of finding it again.
  std::optional<double> automatic_exposure;
  FalseColour false_colour;  ///< of the modes that show it
  /// Which light is shown. Where not all is, the ambient term is left out.
  LightChoice light;
  /// What the display mode `difference` compares with, where it is of the mesh that is drawn; else direct
  /// light alone.
  std::shared_ptr<const ReferenceLight> reference;
  /// What the display modes `form-factors` [1/m^2] and `last-shot` [W/m^2] show, where it is of the mesh that
  /// is drawn (session/insight.h); else nothing.
  std::shared_ptr<const VertexField> form_factors, last_shot;

  /// That of this quantity; null where it has none.
  const std::shared_ptr<const VertexField>& given(Quantity quantity) const {
    return quantity == Quantity::kFormFactors ? form_factors : last_shot;
  }
};

/// Where a picture shows nothing: a neutral dark grey, linear values of the display (sRGB 26).
inline constexpr float kBackground = 0.0103f;
/// The scale that a mode has its colours by: form factors and differences are in no unit of light, and form
/// factors go over decades.
FalseColour falseColourOf(const ViewOptions& options, const DisplayMode& mode);

/// A rectangle of the bound framebuffer [px], from its lower left.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Some of what a picture is drawn from: its triangles, in their order, then those of surfaces without a lit
/// side, then its edges.
struct Pieces {
  std::size_t first = 0, end = 0;
  std::size_t most = ~std::size_t{0};  ///< of them that may be seen
};

/// What was drawn of them: all before `end` that may be seen, which were `count`.
struct DrawnPieces {
  std::size_t end = 0, count = 0;
};

/// Draws one state of a solve. All calls on the thread where the context is current.
/// State that is changed goes back to OpenGL's defaults; the framebuffer and viewport stay.
class SceneView {
 public:
  explicit SceneView(gl::Context& context);

  /// Uploads the mesh, where it is another than before. The state stays until it is drawn: a picture uploads
  /// what it reads of the light, once. Values that are not finite are drawn as 0. Throws Error kEnvironment
  /// where the mesh is too large for the driver.
  void setSnapshot(const Snapshot& snapshot);
  /// The same in parts: begins it, giving up what is not yet done of the snapshot before. Nothing may be
  /// drawn until upload() has sent uploadBytes().
  void beginSnapshot(std::shared_ptr<const Snapshot> snapshot) { buffers_.begin(std::move(snapshot)); }
  /// Begins to upload what a picture reads of the light and is not there yet.
  void beginLight(const ViewOptions& options) { buffers_.beginFields(readingOf(options)); }
  /// About so many more bytes.
  void upload(std::size_t bytes) { buffers_.upload(bytes); }
  std::size_t uploadBytes() const { return buffers_.uploadBytes(); }
  /// Whether a picture in this display mode shows marks of the mesh that are not there yet. It finds them
  /// itself, which takes long where the mesh is large, unless beginMarks() was given them, which are then to
  /// be uploaded as the rest.
  bool lacksMarks(const DisplayMode& mode) const { return buffers_.lacksMarks(mode); }
  void beginMarks(const MeshMarks& marks) { buffers_.beginMarks(marks); }
  /// For ViewOptions::merged; to be uploaded as the rest, and not while a picture is half drawn.
  void beginMerged(const MergedTriangles& merged) { buffers_.beginMerged(merged); }

  /// Draws into `viewport` of the bound framebuffer, in one rendering, and returns the automatic exposure:
  /// the factor from linear values to about 1 for white, without exposure_ev.
  double draw(const Camera& camera, const ViewOptions& options, const Viewport& viewport);

  // The two passes by themselves, for pictures in tiles or over several frames.

  /// Automatic exposure of the picture that `camera` takes, from a small copy of it; 1 for modes that are not
  /// tone-mapped.
  double exposureFor(const Camera& camera, double aspect, const ViewOptions& options);
  /// Clears the bound linear target and draws a part of the picture, over all of its viewport.
  void drawLinear(const Camera& camera, double aspect, const FrameWindow& window, const ViewOptions& options,
                  bool with_edges = true);
  /// How many pieces the picture has.
  std::size_t pieceCount(const ViewOptions& options, bool with_edges = true);
  /// The same for some of its pieces; the first one clears. Those that the view cannot see are passed over.
  DrawnPieces drawPieces(const Camera& camera, double aspect, const FrameWindow& window,
                         const ViewOptions& options, Pieces pieces);
  /// A small copy of `samples`, which become bound: what meter() looks at.
  std::vector<glm::vec4> smallCopy(const LinearTarget& samples);
  /// Automatic exposure by a small copy; 1 for modes that are not tone-mapped.
  static double meter(std::span<const glm::vec4> small, const ViewOptions& options);
  /// Shows `samples` (options.supersampling along a pixel's side), from their pixel row `first_row` on, in
  /// `viewport` of the bound framebuffer.
  void resolve(const LinearTarget& samples, double automatic_exposure, const ViewOptions& options,
               const Viewport& viewport, int first_row = 0);

 private:
  static SceneBuffers::Reading readingOf(const ViewOptions& options);
  void useDisplay(const gl::Program& program, const glm::mat4& matrix, const Camera& camera,
                  const ViewOptions& options, const gl::Texture& triangle_elements,
                  const gl::Texture& element_light) const;
  /// Triangles of surfaces without a lit side.
  void drawUnlit(const glm::mat4& matrix, const Camera& camera, const ViewOptions& options,
                 const gl::Texture& element_light, std::size_t first, std::size_t count);
  void useFalseColour(const gl::Program& program, const FalseColour& how, double scale) const;
  const LinearTarget& target(LinearTarget& kept, int width, int height);
  /// Those that the picture is drawn from.
  SceneBuffers::Triangles trianglesOf(const ViewOptions& options) const;

  gl::Context& context_;
  SceneBuffers buffers_;
  // Programs, each made when the first picture needs it.
  const gl::Program& madeOnce(gl::Program& program, std::initializer_list<std::string_view> shaders);
  /// For what is worked out per pixel: light by element, signed light, lines.
  const gl::Program& byPixelProgram();
  /// For the triangles of a mode that is worked out at vertices.
  const gl::Program& vertexProgram(const DisplayMode& mode);
  const gl::Program& resolveProgram(const DisplayMode& mode, const std::string& tone);

  gl::Program display_program_, by_pixel_program_, sides_program_;
  std::map<std::string, gl::Program, std::less<>>
      resolve_programs_;  // by tone curve or "false colours", as they were wanted
  gl::VertexArray no_attributes_;
  LinearTarget samples_, small_;
};

}  // namespace unshot
