#include "render/scene_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "base/error.h"
#include "render/element_edges.h"
#include "render/exposure.h"

namespace unshot {
namespace {

// Linear values of the display: a neutral dark grey, sRGB 26.
constexpr float kBackground = 0.0103f;
constexpr int kMeteredPixels = 144 * 108;
// Far inside the range of float, so that sums, interpolation and scaling stay finite.
constexpr double kLargestValue = 1e36;

struct GpuVertex {
  glm::vec3 position, normal;
  std::uint32_t side;
};

float finiteValue(double v) {
  return std::isfinite(v) ? static_cast<float>(std::clamp(v, -kLargestValue, kLargestValue)) : 0.0f;
}

glm::vec4 finiteTexel(const glm::dvec3& v) {
  return {finiteValue(v.x), finiteValue(v.y), finiteValue(v.z), 0.0f};
}

void allocate(const gl::Functions& fn, const gl::Buffer& buffer, std::size_t bytes, GLenum usage) {
  // The binding point says nothing about the use; this one disturbs no vertex array.
  fn.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.id());
  fn.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, usage);
  fn.BindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

// Room for values that do not change, and their way there.
template <class T>
void sendAll(Uploads& uploads, const gl::Buffer& buffer, std::shared_ptr<const std::vector<T>> values) {
  allocate(buffer.fn(), buffer, values->size() * sizeof(T), GL_STATIC_DRAW);
  const std::size_t count = values->size();
  uploads.add<T>(buffer, count, [values = std::move(values)](std::size_t first, std::size_t n, T* out) {
    std::copy_n(values->data() + first, n, out);
  });
}

// A field of `count` values at once: what is shown on demand.
template <class Value>
void send(const gl::Buffer& buffer, std::shared_ptr<const std::vector<glm::vec3>> field, std::size_t count) {
  allocate(buffer.fn(), buffer, std::max<std::size_t>(count, 1) * sizeof(Value), GL_DYNAMIC_DRAW);
  Uploads uploads;
  uploads.add<Value>(buffer, count, finiteValues<Value>(std::move(field)));
  uploads.some(uploads.bytes());
}

void attribute(const gl::Functions& fn, GLuint location, const gl::Buffer& buffer, std::size_t stride,
               std::size_t offset) {
  fn.BindBuffer(GL_ARRAY_BUFFER, buffer.id());
  fn.EnableVertexAttribArray(location);
  fn.VertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                         reinterpret_cast<const void*>(offset));
}

void attachTexels(const gl::Functions& fn, const gl::Texture& texture, GLenum format,
                  const gl::Buffer& buffer) {
  fn.BindTexture(GL_TEXTURE_BUFFER, texture.id());
  fn.TexBuffer(GL_TEXTURE_BUFFER, format, buffer.id());
  fn.BindTexture(GL_TEXTURE_BUFFER, 0);
}

void checkTexels(const gl::Functions& fn, std::size_t texels) {
  GLint largest = 0;
  fn.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
  if (texels <= static_cast<std::size_t>(largest)) return;
  throw Error(ErrorKind::kEnvironment,
              "the mesh has " + std::to_string(texels) +
                  " triangles or elements; this OpenGL driver draws at most " + std::to_string(largest),
              {}, "fewer elements (--elements), or another provider (--gl)");
}

void bindTexture(const gl::Functions& fn, const gl::Program& program, const char* name, int unit,
                 GLenum target, GLuint texture) {
  fn.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  fn.BindTexture(target, texture);
  fn.Uniform1i(program.uniform(name), unit);
}

}  // namespace

SceneView::SceneView(gl::Context& context)
    : context_(context),
      display_program_(context, {"display.vert", "display.frag"}),
      by_pixel_program_(context, {"display_by_pixel.vert", "display_by_pixel.frag"}),
      resolve_program_(context, {"frame.vert", "resolve.frag"}),
      vertex_array_(context),
      no_attributes_(context),
      vertices_(context),
      irradiance_(context),
      direct_(context),
      ambient_(context),
      unshot_(context),
      bounces_(context),
      residual_(context),
      bounce_irradiance_(context),
      reference_(context),
      triangles_(context),
      edges_(context),
      sides_(context),
      triangle_elements_(context),
      element_irradiance_(context),
      element_direct_(context),
      element_bounce_(context),
      sides_texture_(context),
      triangle_elements_texture_(context),
      element_irradiance_texture_(context),
      element_direct_texture_(context),
      element_bounce_texture_(context) {}

void SceneView::setSnapshot(const Snapshot& snapshot) {
  // It is here for as long as the upload takes.
  beginSnapshot(std::shared_ptr<const Snapshot>(std::shared_ptr<void>(), &snapshot));
  upload(uploadBytes());
}

void SceneView::beginSnapshot(const std::shared_ptr<const Snapshot>& snapshot) {
  // Where fields were given up half way, it is not known what is there.
  bool all = !field_uploads_.done();
  field_uploads_.clear();
  if (snapshot->mesh != mesh_) {
    beginMesh(snapshot->mesh);
    bounce_field_.reset();
    reference_light_.reset();
    all = true;
  }
  const auto own = [&](const std::vector<glm::vec3>& field) {
    return std::shared_ptr<const std::vector<glm::vec3>>(snapshot, &field);
  };
  const std::size_t vertices = mesh_->vertices.size(), elements = mesh_->element_count;
  field_uploads_.add<glm::vec3>(irradiance_, vertices, finiteValues<glm::vec3>(own(snapshot->irradiance)));
  field_uploads_.add<glm::vec3>(ambient_, vertices, finiteValues<glm::vec3>(own(snapshot->ambient)));
  field_uploads_.add<glm::vec3>(unshot_, vertices, finiteValues<glm::vec3>(own(snapshot->unshot)));
  field_uploads_.add<glm::vec4>(element_irradiance_, elements,
                                finiteValues<glm::vec4>(own(snapshot->element_irradiance)));
  const auto shared = [&]<class Value>(const gl::Buffer& buffer, std::size_t count, SharedField& uploaded,
                                       const SharedField& field, Value) {
    if (all || uploaded != field) field_uploads_.add<Value>(buffer, count, finiteValues<Value>(field));
    uploaded = field;
  };
  if (all || direct_field_ != snapshot->direct) direct_reference_.reset();
  bounce_light_ = snapshot->bounce_light;
  sky_ = snapshot->sky;
  shared(direct_, vertices, direct_field_, snapshot->direct, glm::vec3());
  shared(element_direct_, elements, element_direct_field_, snapshot->element_direct, glm::vec4());
  shared(bounces_, vertices, bounces_field_, snapshot->bounces, glm::vec3());
  shared(residual_, vertices, residual_field_, snapshot->residual, glm::vec3());
}

void SceneView::upload(std::size_t bytes) {
  const std::size_t mesh_bytes = std::min(bytes, mesh_uploads_.bytes());
  mesh_uploads_.some(mesh_bytes);
  if (mesh_uploads_.done()) field_uploads_.some(bytes - mesh_bytes);
}

SceneView::LightBuffers SceneView::lightOf(const LightChoice& choice) {
  if (!choice.indirect) return {direct_, element_direct_texture_};
  const std::shared_ptr<const MeshField> field = bounceField(bounce_light_, choice);
  if (!field) return {irradiance_, element_irradiance_texture_};
  if (field != bounce_field_) {
    const gl::Functions& fn = context_.functions();
    send<glm::vec3>(bounce_irradiance_, SharedField(field, &field->vertices), mesh_->vertices.size());
    send<glm::vec4>(element_bounce_, SharedField(field, &field->elements), mesh_->element_count);
    attachTexels(fn, element_bounce_texture_, GL_RGBA32F, element_bounce_);
    bounce_field_ = field;
  }
  return {bounce_irradiance_, element_bounce_texture_};
}

void SceneView::useReference(const ViewOptions& options) {
  const bool fits = options.reference && options.reference->mesh == mesh_;
  if (!fits && !direct_reference_) {
    Snapshot direct;
    direct.mesh = mesh_;
    direct.direct = direct_field_;
    direct_reference_ =
        std::make_shared<const ReferenceLight>(referenceLight(direct, {false, {}}, "direct light alone"));
  }
  const auto& wanted = fits ? options.reference : direct_reference_;
  if (wanted == reference_light_) return;
  send<glm::vec3>(reference_, SharedField(wanted, &wanted->reflected), mesh_->vertices.size());
  reference_light_ = wanted;
}

const gl::Buffer* SceneView::extraField(Quantity quantity) const {
  if (quantity == Quantity::kUnshot) return &unshot_;
  if (quantity == Quantity::kBounces) return &bounces_;
  if (quantity == Quantity::kDifference) return &reference_;
  return quantity == Quantity::kResidual ? &residual_ : nullptr;
}

void SceneView::beginMesh(const std::shared_ptr<const Mesh>& shared_mesh) {
  const gl::Functions& fn = context_.functions();
  const Mesh& mesh = *shared_mesh;
  checkTexels(
      fn, std::max({mesh.triangle_element.size(), std::size_t{mesh.element_count}, 2 * mesh.sides.size()}));
  mesh_uploads_.clear();
  mesh_ = shared_mesh;
  bounds_ = {mesh.bounds_min, mesh.bounds_max};
  const auto own = [&]<class T>(const std::vector<T>& values) {
    return std::shared_ptr<const std::vector<T>>(shared_mesh, &values);
  };

  const std::size_t vertices = mesh.vertices.size();
  allocate(fn, vertices_, vertices * sizeof(GpuVertex), GL_STATIC_DRAW);
  mesh_uploads_.add<GpuVertex>(vertices_, vertices,
                               [shared_mesh](std::size_t first, std::size_t count, GpuVertex* out) {
                                 for (std::size_t k = 0; k < count; ++k) {
                                   const Vertex& v = shared_mesh->vertices[first + k];
                                   out[k] = {v.position, v.normal, v.side};
                                 }
                               });
  for (const gl::Buffer* field : {&irradiance_, &direct_, &ambient_, &unshot_, &bounces_, &residual_})
    allocate(fn, *field, vertices * sizeof(glm::vec3), GL_DYNAMIC_DRAW);
  sendAll(mesh_uploads_, triangles_, own(mesh.triangle_vertices));
  triangle_index_count_ = static_cast<GLsizei>(mesh.triangle_vertices.size());
  edges_uploaded_ = false;

  fn.BindVertexArray(vertex_array_.id());
  attribute(fn, 0, vertices_, sizeof(GpuVertex), offsetof(GpuVertex, position));
  attribute(fn, 1, vertices_, sizeof(GpuVertex), offsetof(GpuVertex, normal));
  fn.EnableVertexAttribArray(2);
  fn.VertexAttribIPointer(2, 1, GL_UNSIGNED_INT, sizeof(GpuVertex),
                          reinterpret_cast<const void*>(offsetof(GpuVertex, side)));
  attribute(fn, 4, ambient_, sizeof(glm::vec3), 0);
  attribute(fn, 5, unshot_, sizeof(glm::vec3), 0);
  fn.BindBuffer(GL_ARRAY_BUFFER, 0);
  fn.BindVertexArray(0);

  auto sides = std::make_shared<std::vector<glm::vec4>>(std::max<std::size_t>(2 * mesh.sides.size(), 1),
                                                        glm::vec4(0.0f));
  for (std::size_t i = 0; i < mesh.sides.size(); ++i) {
    (*sides)[2 * i] = finiteTexel(mesh.sides[i].reflectance);
    (*sides)[2 * i + 1] = finiteTexel(mesh.sides[i].emission);
  }
  sendAll<glm::vec4>(mesh_uploads_, sides_, std::move(sides));
  sendAll(mesh_uploads_, triangle_elements_, own(mesh.triangle_element));
  for (const gl::Buffer* field : {&element_irradiance_, &element_direct_}) {
    allocate(fn, *field, std::max<std::size_t>(mesh.element_count, 1) * sizeof(glm::vec4), GL_DYNAMIC_DRAW);
  }
  attachTexels(fn, sides_texture_, GL_RGBA32F, sides_);
  attachTexels(fn, triangle_elements_texture_, GL_R32UI, triangle_elements_);
  attachTexels(fn, element_irradiance_texture_, GL_RGBA32F, element_irradiance_);
  attachTexels(fn, element_direct_texture_, GL_RGBA32F, element_direct_);
}

void SceneView::uploadEdges() {
  if (edges_uploaded_) return;
  const std::vector<std::uint32_t> pairs = elementEdges(*mesh_);
  const gl::Functions& fn = context_.functions();
  fn.BindBuffer(GL_COPY_WRITE_BUFFER, edges_.id());
  fn.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(pairs.size() * sizeof(pairs[0])), pairs.data(),
                GL_STATIC_DRAW);
  fn.BindBuffer(GL_COPY_WRITE_BUFFER, 0);
  edge_index_count_ = static_cast<GLsizei>(pairs.size());
  edges_uploaded_ = true;
}

const LinearTarget& SceneView::target(LinearTarget& kept, int width, int height) {
  if (kept.width() != width || kept.height() != height) {
    kept = LinearTarget();  // the old one goes first: both at once may not fit
    kept = LinearTarget(context_, width, height);
  }
  return kept;
}

std::size_t SceneView::pieceCount(const ViewOptions& options, bool with_edges) {
  if (!mesh_) return 0;
  const bool edges = with_edges && displayMode(options.display).edges;
  if (edges) uploadEdges();
  return static_cast<std::size_t>(triangle_index_count_) / 3 +
         (edges ? static_cast<std::size_t>(edge_index_count_) / 2 : 0);
}

void SceneView::drawLinear(const Camera& camera, double aspect, const FrameWindow& window,
                           const ViewOptions& options, bool with_edges) {
  drawPieces(camera, aspect, window, options, {0, pieceCount(options, with_edges)});
}

void SceneView::useDisplay(const gl::Program& program, const glm::mat4& matrix, const Camera& camera,
                           const ViewOptions& options, const gl::Texture& element_light) const {
  const gl::Functions& fn = context_.functions();
  const DisplayMode& mode = displayMode(options.display);
  program.use();
  const glm::vec3 eye(camera.eye);
  // The ambient term is no part of any solution, so that none is compared with it.
  const bool with_ambient = options.ambient && options.light.all() && mode.quantity != Quantity::kDifference;
  fn.UniformMatrix4fv(program.uniform("view_projection"), 1, GL_FALSE, glm::value_ptr(matrix));
  fn.Uniform3fv(program.uniform("eye"), 1, glm::value_ptr(eye));
  fn.Uniform1f(program.uniform("ambient_weight"), with_ambient ? 1.0f : 0.0f);
  fn.Uniform1i(program.uniform("quantity"), static_cast<int>(mode.quantity));
  fn.Uniform1i(program.uniform("per_element"), mode.per_element);
  bindTexture(fn, program, "sides", 0, GL_TEXTURE_BUFFER, sides_texture_.id());
  bindTexture(fn, program, "triangle_elements", 1, GL_TEXTURE_BUFFER, triangle_elements_texture_.id());
  bindTexture(fn, program, "element_irradiance", 2, GL_TEXTURE_BUFFER, element_light.id());
  if (mode.quantity == Quantity::kDifference && reference_light_) {
    const double mean = reference_light_->mean;
    fn.Uniform1f(program.uniform("per_mean"), mean > 0 ? finiteValue(1 / mean) : 0.0f);
  }
}

void SceneView::drawPieces(const Camera& camera, double aspect, const FrameWindow& window,
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
  if (!mesh_ || pieces.count == 0) return;

  const glm::mat4 matrix = viewProjection(camera, aspect, bounds_, window, depth.range);
  fn.BindVertexArray(vertex_array_.id());
  // The light that is shown is a matter of which buffer is read.
  const LightBuffers light = lightOf(options.light);
  attribute(fn, 3, light.vertices, sizeof(glm::vec3), 0);
  if (mode.quantity == Quantity::kDifference) useReference(options);
  if (const gl::Buffer* extra = extraField(mode.quantity)) attribute(fn, 5, *extra, sizeof(glm::vec3), 0);
  fn.BindBuffer(GL_ARRAY_BUFFER, 0);
  const auto draw = [&](GLenum kind, const gl::Buffer& indices, std::size_t corners, std::size_t first,
                        std::size_t end) {
    fn.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id());
    fn.DrawElements(kind, static_cast<GLsizei>(corners * (end - first)), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(corners * first * sizeof(std::uint32_t)));
  };
  const std::size_t triangles = static_cast<std::size_t>(triangle_index_count_) / 3;
  const std::size_t end = pieces.first + pieces.count;
  if (pieces.first < triangles) {
    const bool by_pixel = mode.per_element || extraField(mode.quantity);
    const gl::Program& program = by_pixel ? by_pixel_program_ : display_program_;
    useDisplay(program, matrix, camera, options, light.elements);
    fn.Uniform1i(program.uniform("edges"), 0);
    fn.Uniform1i(program.uniform("first_triangle"), static_cast<GLint>(pieces.first));
    draw(GL_TRIANGLES, triangles_, 3, pieces.first, std::min(end, triangles));
  }
  if (end > triangles) {
    useDisplay(by_pixel_program_, matrix, camera, options, light.elements);
    fn.Uniform1i(by_pixel_program_.uniform("edges"), 1);
    fn.Enable(GL_CLIP_DISTANCE0);
    draw(GL_LINES, edges_, 2, std::max(pieces.first, triangles) - triangles, end - triangles);
    fn.Disable(GL_CLIP_DISTANCE0);
  }
  fn.BindVertexArray(0);
}

double SceneView::exposureFor(const Camera& camera, double aspect, const ViewOptions& options) {
  if (!displayMode(options.display).tone_mapped) return 1;
  const StateGuard guard(context_.functions());
  const double height = std::clamp(std::sqrt(kMeteredPixels / aspect), 1.0, double{kMeteredPixels});
  const LinearTarget& small = target(
      small_, std::max(1, static_cast<int>(std::lround(kMeteredPixels / height))), static_cast<int>(height));
  small.bind();
  drawLinear(camera, aspect, {}, options, false);
  return automaticExposure(small.read());
}

void SceneView::resolve(const LinearTarget& samples, double automatic_exposure, const ViewOptions& options,
                        const Viewport& viewport, int first_row) {
  const gl::Functions& fn = context_.functions();
  const DisplayMode& mode = displayMode(options.display);
  const double stops = mode.exposed ? std::clamp(options.exposure_ev, -200.0, 200.0) : 0;
  const double scale = automatic_exposure * std::exp2(stops);
  const gl::Program& program = resolve_program_;
  setPassState(fn, false);
  fn.Viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  program.use();
  bindTexture(fn, program, "samples", 0, GL_TEXTURE_2D, samples.texture());
  fn.Uniform1i(program.uniform("factor"), options.supersampling);
  fn.Uniform2i(program.uniform("origin"), viewport.x, viewport.y - first_row);
  fn.Uniform1f(program.uniform("exposure"), finiteValue(scale));
  fn.Uniform1i(program.uniform("tone_mapped"), mode.tone_mapped);
  fn.Uniform3f(program.uniform("background"), kBackground, kBackground, kBackground);
  const bool shows_light = mode.quantity == Quantity::kRadiosity || mode.quantity == Quantity::kEmission;
  const glm::vec3 sky = shows_light ? glm::vec3(sky_) : glm::vec3(0.0f);
  fn.Uniform3f(program.uniform("sky"), sky.x, sky.y, sky.z);
  // A line is one sample wide: where it covers part of a pixel it is drawn the stronger.
  fn.Uniform1f(program.uniform("edge_strength"),
               std::min(1.0f, 0.35f * static_cast<float>(options.supersampling)));
  fn.BindVertexArray(no_attributes_.id());
  fn.DrawArrays(GL_TRIANGLES, 0, 3);
  fn.BindVertexArray(0);
}

double SceneView::meter(const LinearTarget& samples, const ViewOptions& options) {
  if (!displayMode(options.display).tone_mapped) return 1;
  const gl::Functions& fn = context_.functions();
  const double aspect = static_cast<double>(samples.width()) / samples.height();
  const double height = std::clamp(std::sqrt(kMeteredPixels / aspect), 1.0, double{kMeteredPixels});
  const int width = std::max(1, static_cast<int>(std::lround(kMeteredPixels / height)));
  const LinearTarget& small = target(small_, width, static_cast<int>(height));
  samples.bind();  // for reading too
  small.bindForDrawing();
  fn.BlitFramebuffer(0, 0, samples.width(), samples.height(), 0, 0, small.width(), small.height(),
                     GL_COLOR_BUFFER_BIT, GL_NEAREST);
  return automaticExposure(small.read());
}

double SceneView::draw(const Camera& camera, const ViewOptions& options, const Viewport& viewport) {
  if (viewport.width <= 0 || viewport.height <= 0) return options.automatic_exposure.value_or(1);
  const StateGuard guard(context_.functions());
  const LinearTarget& samples =
      target(samples_, viewport.width * options.supersampling, viewport.height * options.supersampling);
  samples.bind();
  drawLinear(camera, static_cast<double>(viewport.width) / viewport.height, {}, options);
  const double exposure = options.automatic_exposure ? *options.automatic_exposure : meter(samples, options);
  context_.functions().BindFramebuffer(GL_FRAMEBUFFER, guard.drawFramebuffer());
  resolve(samples, exposure, options, viewport);
  return exposure;
}

}  // namespace unshot
