#include "render/scene_view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "render/exposure.h"

namespace unshot {
namespace {

constexpr int kMeteredPixels = 144 * 108;
constexpr double kLeastDifferenceShown = 0.01;  // that the scale of differences ends at
void bindTexture(const gl::Functions& fn, const gl::Program& program, const char* name, int unit,
                 GLenum target, GLuint texture) {
  fn.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  fn.BindTexture(target, texture);
  fn.Uniform1i(program.uniform(name), unit);
}

}  // namespace

FalseColour falseColourOf(const ViewOptions& options, const DisplayMode& mode) {
  FalseColour out = options.false_colour;
  const Quantity q = mode.quantity;
  if (q == Quantity::kFormFactors || q == Quantity::kBounces || q == Quantity::kDifference)
    out.lumens_per_watt = 0;
  if (q == Quantity::kFormFactors) out.logarithmic = true;
  return out;
}

SceneView::SceneView(gl::Context& context) : context_(context), buffers_(context), no_attributes_(context) {}

const gl::Program& SceneView::madeOnce(gl::Program& program,
                                       std::initializer_list<std::string_view> shaders) {
  if (!program) program = gl::Program(context_, shaders);
  return program;
}

const gl::Program& SceneView::vertexProgram(const DisplayMode& mode) {
  if (mode.quantity == Quantity::kSides || mode.quantity == Quantity::kNormals)
    return madeOnce(sides_program_, {"display_sides.vert", "display.frag"});
  return madeOnce(display_program_, {"display.vert", "display.frag"});
}

const gl::Program& SceneView::byPixelProgram() {
  return madeOnce(by_pixel_program_, {"display_by_pixel.vert", "display_by_pixel.frag"});
}

const gl::Program& SceneView::resolveProgram(const DisplayMode& mode, const std::string& tone) {
  const std::string key = mode.diverging ? "diverging" : mode.false_colour ? "false colours" : tone;
  const auto made = resolve_programs_.find(key);
  if (made != resolve_programs_.end()) return made->second;
  gl::Program program =
      mode.diverging      ? gl::Program(context_, {"frame.vert", "resolve.frag", "resolve_diverging.frag"})
      : mode.false_colour ? gl::Program(context_, {"frame.vert", "resolve.frag", "resolve_false_colour.frag"})
                          : gl::Program(context_, {"frame.vert", "resolve.frag", "resolve_toned.frag",
                                                   toneCurve(tone).shader});
  return resolve_programs_.emplace(key, std::move(program)).first->second;
}

void SceneView::setSnapshot(const Snapshot& snapshot) {
  beginSnapshot(std::shared_ptr<const Snapshot>(std::shared_ptr<void>(), &snapshot));
  upload(uploadBytes());
}

SceneBuffers::Reading SceneView::readingOf(const ViewOptions& options) {
  const DisplayMode& mode = displayMode(options.display);
  // The ambient term is no part of any solution, so that none is compared with it.
  const bool lit = mode.quantity == Quantity::kRadiosity || mode.quantity == Quantity::kIrradiance;
  return {mode, options.light, lit && options.ambient && options.light.all(), options.reference,
          options.given(mode.quantity)};
}

const LinearTarget& SceneView::target(LinearTarget& kept, int width, int height) {
  if (kept.width() != width || kept.height() != height) {
    kept = LinearTarget();  // the old one goes first: both at once may not fit
    kept = LinearTarget(context_, width, height);
  }
  return kept;
}

SceneBuffers::Triangles SceneView::trianglesOf(const ViewOptions& options) const {
  return options.merged && buffers_.hasMerged() ? buffers_.mergedTriangles() : buffers_.triangles();
}

std::size_t SceneView::pieceCount(const ViewOptions& options, bool with_edges) {
  if (!buffers_.mesh()) return 0;
  const DisplayMode& mode = displayMode(options.display);
  const bool edges = with_edges && mode.edges;
  if (edges) buffers_.complete(readingOf(options));
  return trianglesOf(options).count + buffers_.unlitCount() + (edges ? buffers_.edgeCount() : 0);
}

void SceneView::drawLinear(const Camera& camera, double aspect, const FrameWindow& window,
                           const ViewOptions& options, bool with_edges) {
  drawPieces(camera, aspect, window, options, {0, pieceCount(options, with_edges)});
}

void SceneView::useDisplay(const gl::Program& program, const glm::mat4& matrix, const Camera& camera,
                           const ViewOptions& options, const gl::Texture& triangle_elements,
                           const gl::Texture& element_light) const {
  const gl::Functions& fn = context_.functions();
  const DisplayMode& mode = displayMode(options.display);
  program.use();
  const glm::vec4 eye = homogeneousEye(camera, buffers_.bounds());
  fn.UniformMatrix4fv(program.uniform("view_projection"), 1, GL_FALSE, glm::value_ptr(matrix));
  fn.Uniform4fv(program.uniform("eye"), 1, glm::value_ptr(eye));
  fn.Uniform1f(program.uniform("emission_weight"), options.light.oneBounce() ? 0.0f : 1.0f);
  fn.Uniform1i(program.uniform("quantity"), static_cast<int>(mode.quantity));
  fn.Uniform1i(program.uniform("per_element"), mode.per_element);
  bindTexture(fn, program, "sides", 0, GL_TEXTURE_BUFFER, buffers_.sides().id());
  bindTexture(fn, program, "triangle_elements", 1, GL_TEXTURE_BUFFER, triangle_elements.id());
  bindTexture(fn, program, "element_irradiance", 2, GL_TEXTURE_BUFFER, element_light.id());
  fn.Uniform1i(program.uniform("diverging"), mode.diverging);
  if (mode.quantity == Quantity::kDifference) {
    const double mean = buffers_.referenceMean();
    fn.Uniform1f(program.uniform("per_mean"), mean > 0 ? finiteValue(1 / mean) : 0.0f);
  }
}

DrawnPieces SceneView::drawPieces(const Camera& camera, double aspect, const FrameWindow& window,
                                  const ViewOptions& options, Pieces pieces) {
  const gl::Functions& fn = context_.functions();
  const DisplayMode& mode = displayMode(options.display);
  setPassState(fn, true);
  const DepthSetup depth(fn);
  if (pieces.first == 0) {
    const GLfloat nothing[4] = {0, 0, 0, kBackgroundPixel};
    fn.ClearBufferfv(GL_COLOR, 0, nothing);
    fn.ClearBufferfv(GL_DEPTH, 0, &depth.farthest);
  }
  DrawnPieces drawn{pieces.first, 0};
  if (!buffers_.mesh() || pieces.first >= pieces.end) return drawn;

  const SceneBuffers::Reading reading = readingOf(options);
  buffers_.complete(reading);
  const glm::mat4 matrix = viewProjection(camera, aspect, buffers_.bounds(), window, depth.range);
  const gl::Texture& element_light = buffers_.bind(reading);
  const auto draw = [&](GLenum kind, const gl::Buffer& indices, std::size_t corners, std::size_t first,
                        std::size_t end) {
    fn.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id());
    fn.DrawElements(kind, static_cast<GLsizei>(corners * (end - first)), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(corners * first * sizeof(std::uint32_t)));
  };
  const SceneBuffers::Triangles lit = trianglesOf(options);
  const std::size_t triangles = lit.count, faces = triangles + buffers_.unlitCount();
  // How many of those before `end` are still to be drawn.
  const auto left = [&](std::size_t end) {
    return std::min(pieces.most - drawn.count, std::min(end, pieces.end) - drawn.end);
  };
  if (drawn.end < triangles) {
    const bool by_pixel = mode.per_element || buffers_.hasField(mode.quantity);
    const gl::Program& program = by_pixel ? byPixelProgram() : vertexProgram(mode);
    useDisplay(program, matrix, camera, options, lit.elements, element_light);
    fn.Uniform1i(program.uniform("edges"), 0);
    const TrianglesInView seen = lit.blocks.inView(matrix, homogeneousEye(camera, buffers_.bounds()),
                                                   {drawn.end, std::min(pieces.end, triangles)}, pieces.most);
    for (const TriangleRun& run : seen.runs) {
      fn.Uniform1i(program.uniform("first_triangle"), static_cast<GLint>(run.first));
      draw(GL_TRIANGLES, lit.corners, 3, run.first, run.end);
    }
    drawn = {seen.end, seen.count};
  }
  if (drawn.end >= triangles && drawn.end < faces) {
    const std::size_t count = left(faces);
    drawUnlit(matrix, camera, options, element_light, drawn.end - triangles, count);
    drawn = {drawn.end + count, drawn.count + count};
  }
  if (drawn.end >= faces && drawn.end < pieces.end) {
    const std::size_t first = drawn.end - faces, count = left(pieces.end);
    buffers_.bind(reading);
    const gl::Program& program = byPixelProgram();
    useDisplay(program, matrix, camera, options, lit.elements, element_light);
    fn.Uniform1i(program.uniform("edges"), 1);
    fn.Enable(GL_CLIP_DISTANCE0);
    draw(GL_LINES, buffers_.edges(), 2, first, first + count);
    fn.Disable(GL_CLIP_DISTANCE0);
    drawn = {drawn.end + count, drawn.count + count};
  }
  fn.BindVertexArray(0);
  return drawn;
}

void SceneView::drawUnlit(const glm::mat4& matrix, const Camera& camera, const ViewOptions& options,
                          const gl::Texture& element_light, std::size_t first, std::size_t count) {
  if (count == 0) return;
  const gl::Functions& fn = context_.functions();
  const DisplayMode& mode = displayMode(options.display);
  const gl::Program& program = buffers_.hasField(mode.quantity) ? byPixelProgram() : vertexProgram(mode);
  useDisplay(program, matrix, camera, options, buffers_.triangles().elements, element_light);
  fn.Uniform1i(program.uniform("edges"), 0);
  fn.Uniform1i(program.uniform("per_element"), 0);
  buffers_.bindUnlit();
  fn.Disable(GL_CULL_FACE);
  // One in the plane of a lit side, such as the wall of a dark room against a lit one, lies behind it.
  const float away = DepthSetup(fn).range == DepthRange::kReversed ? -1.0f : 1.0f;
  fn.Enable(GL_POLYGON_OFFSET_FILL);
  fn.PolygonOffset(away, 4 * away);
  fn.DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * first), static_cast<GLsizei>(3 * count));
  fn.PolygonOffset(0, 0);
  fn.Disable(GL_POLYGON_OFFSET_FILL);
  fn.Enable(GL_CULL_FACE);
}

double SceneView::exposureFor(const Camera& camera, double aspect, const ViewOptions& options) {
  if (!displayMode(options.display).tone_mapped) return 1;
  const StateGuard guard(context_.functions());
  const double height = std::clamp(std::sqrt(kMeteredPixels / aspect), 1.0, double{kMeteredPixels});
  const LinearTarget& small = target(
      small_, std::max(1, static_cast<int>(std::lround(kMeteredPixels / height))), static_cast<int>(height));
  small.bind();
  drawLinear(camera, aspect, {}, options, false);
  return meter(small.read(), options);
}

void SceneView::useFalseColour(const gl::Program& program, const FalseColour& how, double scale) const {
  const gl::Functions& fn = context_.functions();
  fn.Uniform1i(program.uniform("logarithmic"), how.logarithmic);
  fn.Uniform3fv(program.uniform("ramp"), static_cast<GLsizei>(kFalseColourRamp.size()),
                glm::value_ptr(kFalseColourRamp[0]));
  const double top = 1 / scale;
  std::vector<float> places;
  if (how.isolines) {
    for (const double value : isolines(top, how))
      places.push_back(static_cast<float>(falseColourPlace(value, top, how.logarithmic)));
  }
  places.resize(std::min(places.size(), kMostIsolines));
  fn.Uniform1i(program.uniform("isoline_count"), static_cast<GLint>(places.size()));
  if (!places.empty())
    fn.Uniform1fv(program.uniform("isolines"), static_cast<GLsizei>(places.size()), places.data());
}

void SceneView::resolve(const LinearTarget& samples, double automatic_exposure, const ViewOptions& options,
                        const Viewport& viewport, int first_row) {
  const gl::Functions& fn = context_.functions();
  const DisplayMode& mode = displayMode(options.display);
  const double stops = mode.exposed ? std::clamp(options.exposure_ev, -200.0, 200.0) : 0;
  const double scale = automatic_exposure * std::exp2(stops);
  const gl::Program& program = resolveProgram(mode, options.tone);
  setPassState(fn, false);
  fn.Viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  program.use();
  bindTexture(fn, program, "samples", 0, GL_TEXTURE_2D, samples.texture());
  fn.Uniform1i(program.uniform("factor"), options.supersampling);
  fn.Uniform2i(program.uniform("origin"), viewport.x, viewport.y - first_row);
  fn.Uniform1f(program.uniform("exposure"), finiteValue(scale));
  fn.Uniform1i(program.uniform("tone_mapped"), mode.tone_mapped);
  if (mode.diverging) {
    fn.Uniform1i(program.uniform("logarithmic"), falseColourOf(options, mode).logarithmic);
    fn.Uniform3fv(program.uniform("ramps"), static_cast<GLsizei>(kDivergingRamps.size()),
                  glm::value_ptr(kDivergingRamps[0]));
  } else if (mode.false_colour) {
    useFalseColour(program, falseColourOf(options, mode), scale);
  }
  fn.Uniform3f(program.uniform("background"), kBackground, kBackground, kBackground);
  const bool shows_light = (mode.quantity == Quantity::kRadiosity && !options.light.oneBounce()) ||
                           mode.quantity == Quantity::kEmission;
  const glm::vec3 sky = shows_light ? glm::vec3(buffers_.sky()) : glm::vec3(0.0f);
  fn.Uniform3f(program.uniform("sky"), sky.x, sky.y, sky.z);
  // A line is one sample wide: where it covers part of a pixel it is drawn the stronger.
  fn.Uniform1f(program.uniform("edge_strength"),
               std::min(1.0f, 0.35f * static_cast<float>(options.supersampling)));
  fn.BindVertexArray(no_attributes_.id());
  fn.DrawArrays(GL_TRIANGLES, 0, 3);
  fn.BindVertexArray(0);
}

double SceneView::meter(std::span<const glm::vec4> small, const ViewOptions& options) {
  const DisplayMode& mode = displayMode(options.display);
  if (!mode.tone_mapped) return 1;
  if (!mode.false_colour) return automaticExposure(small);
  const double scale = scaleExposure(small);
  // What is the same but for rounding is not to look as if it differed.
  return mode.quantity == Quantity::kDifference ? std::min(scale, 1 / kLeastDifferenceShown) : scale;
}

std::vector<glm::vec4> SceneView::smallCopy(const LinearTarget& samples) {
  const gl::Functions& fn = context_.functions();
  const double aspect = static_cast<double>(samples.width()) / samples.height();
  const double height = std::clamp(std::sqrt(kMeteredPixels / aspect), 1.0, double{kMeteredPixels});
  const int width = std::max(1, static_cast<int>(std::lround(kMeteredPixels / height)));
  const LinearTarget& small = target(small_, width, static_cast<int>(height));
  samples.bind();  // for reading too
  small.bindForDrawing();
  fn.BlitFramebuffer(0, 0, samples.width(), samples.height(), 0, 0, small.width(), small.height(),
                     GL_COLOR_BUFFER_BIT, GL_NEAREST);
  return small.read();
}

double SceneView::draw(const Camera& camera, const ViewOptions& options, const Viewport& viewport) {
  if (viewport.width <= 0 || viewport.height <= 0) return options.automatic_exposure.value_or(1);
  const StateGuard guard(context_.functions());
  const LinearTarget& samples =
      target(samples_, viewport.width * options.supersampling, viewport.height * options.supersampling);
  samples.bind();
  drawLinear(camera, static_cast<double>(viewport.width) / viewport.height, {}, options);
  const double exposure =
      options.automatic_exposure ? *options.automatic_exposure : meter(smallCopy(samples), options);
  context_.functions().BindFramebuffer(GL_FRAMEBUFFER, guard.drawFramebuffer());
  resolve(samples, exposure, options, viewport);
  return exposure;
}

}  // namespace unshot
