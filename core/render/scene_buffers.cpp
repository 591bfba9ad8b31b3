#include "render/scene_buffers.h"

#include <algorithm>
#include <cstddef>
#include <glm/vec4.hpp>

#include "base/error.h"
#include "render/patch_colours.h"
#include "session/insight.h"

namespace unshot {
namespace {

struct GpuVertex {
  glm::vec3 position, normal;
  std::uint32_t side;
};

// Which side of its surface is seen, as shaders/display_sides.vert has it: of a surface without a lit side,
// the one that faces the eye.
constexpr float kFrontSide = 0, kBackSide = 1, kEitherSide = 2;

glm::vec4 finiteTexel(const glm::dvec3& v) {
  return {finiteValue(v.x), finiteValue(v.y), finiteValue(v.z), 0.0f};
}

// Room for values that do not change, and their way there.
template <class T>
void sendAll(Uploads& uploads, const gl::Buffer& buffer, std::shared_ptr<const std::vector<T>> values) {
  allocate(buffer, values->size() * sizeof(T), GL_STATIC_DRAW);
  const std::size_t count = values->size();
  uploads.add<T>(buffer, count, [values = std::move(values)](std::size_t first, std::size_t n, T* out) {
    std::copy_n(values->data() + first, n, out);
  });
}

// A field of `count` values at once: what is shown on demand.
template <class Value>
void send(const gl::Buffer& buffer, std::shared_ptr<const std::vector<glm::vec3>> field, std::size_t count) {
  allocate(buffer, std::max<std::size_t>(count, 1) * sizeof(Value), GL_DYNAMIC_DRAW);
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

// Position, normal and side, for the vertex array that is bound.
void attachVertices(const gl::Functions& fn, const gl::Buffer& vertices) {
  attribute(fn, 0, vertices, sizeof(GpuVertex), offsetof(GpuVertex, position));
  attribute(fn, 1, vertices, sizeof(GpuVertex), offsetof(GpuVertex, normal));
  fn.EnableVertexAttribArray(2);
  fn.VertexAttribIPointer(2, 1, GL_UNSIGNED_INT, sizeof(GpuVertex),
                          reinterpret_cast<const void*>(offsetof(GpuVertex, side)));
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

}  // namespace

SceneBuffers::SceneBuffers(gl::Context& context)
    : context_(context),
      fields_(context),
      vertex_array_(context),
      unlit_vertex_array_(context),
      vertices_(context),
      bounce_irradiance_(context),
      reference_(context),
      given_(context),
      triangles_(context),
      merged_(context),
      edges_(context),
      unlit_(context),
      sides_(context),
      triangle_elements_(context),
      merged_elements_(context),
      element_bounce_(context),
      element_colours_(context),
      sides_texture_(context),
      triangle_elements_texture_(context),
      merged_elements_texture_(context),
      element_bounce_texture_(context),
      element_colours_texture_(context) {}

void SceneBuffers::begin(std::shared_ptr<const Snapshot> snapshot) {
  const bool same_direct = fields_.snapshot() && fields_.snapshot()->direct == snapshot->direct;
  if (mesh_ && snapshot->mesh->cut == mesh_->cut) {
    if (snapshot->mesh != mesh_ || !same_direct) direct_reference_.reset();
    if (snapshot->mesh != mesh_) beginSides(snapshot->mesh, unlitSurfaces(*snapshot->mesh));
  } else {
    beginMesh(snapshot->mesh);
    bounce_field_.reset();
    direct_reference_.reset();
    reference_light_.reset();
    given_uploaded_ = false;
  }
  fields_.setSnapshot(std::move(snapshot));
}

std::optional<LightField> SceneBuffers::fieldOf(Quantity quantity) {
  if (quantity == Quantity::kUnshot) return LightField::kUnshot;
  if (quantity == Quantity::kBounces) return LightField::kBounces;
  if (quantity == Quantity::kResidual) return LightField::kResidual;
  return std::nullopt;
}

bool SceneBuffers::readsLight(Quantity quantity) {
  return quantity == Quantity::kRadiosity || quantity == Quantity::kIrradiance ||
         quantity == Quantity::kDifference;
}

void SceneBuffers::beginFields(const Reading& reading) {
  if (!mesh_) return;
  LightFieldSet wanted;
  if (const auto field = fieldOf(reading.mode.quantity)) wanted.add(*field);
  if (reading.ambient) wanted.add(LightField::kAmbient);
  if (readsLight(reading.mode.quantity) && !bounceSum(reading.light)) {
    const bool direct = !reading.light.indirect;
    if (reading.mode.per_element) {
      wanted.add(direct ? LightField::kElementDirect : LightField::kElementIrradiance);
    } else {
      wanted.add(direct ? LightField::kDirect : LightField::kIrradiance);
    }
  }
  fields_.begin(wanted);
}

void SceneBuffers::upload(std::size_t bytes) {
  const std::size_t mesh_bytes = std::min(bytes, mesh_uploads_.bytes());
  mesh_uploads_.some(mesh_bytes);
  if (mesh_uploads_.done()) fields_.upload(bytes - mesh_bytes);
}

void SceneBuffers::complete(const Reading& reading) {
  if (!mesh_) return;
  if (lacksMarks(reading.mode)) beginMarks(findMeshMarks(*mesh_, reading.mode));
  beginFields(reading);
  upload(uploadBytes());
}

/// The light of the bounces that are meant and all before; null where all light is, or none of them is known.
std::shared_ptr<const MeshField> SceneBuffers::bounceSum(const LightChoice& choice) const {
  if (!choice.indirect) return nullptr;
  return bounceField(fields_.snapshot()->bounce_light, {true, choice.bounces, false});
}

/// What is read in place of the fields of the snapshot.
void SceneBuffers::useBounces(const LightChoice& choice, const std::shared_ptr<const MeshField>& sum) {
  if (sum == bounce_field_ && choice.alone == bounce_alone_) return;
  const std::shared_ptr<const MeshField> field =
      choice.alone ? bounceField(fields_.snapshot()->bounce_light, choice) : sum;
  send<glm::vec3>(bounce_irradiance_, SharedField(field, &field->vertices), mesh_->vertices.size());
  send<glm::vec4>(element_bounce_, SharedField(field, &field->elements), mesh_->element_count);
  attachTexels(element_bounce_texture_, GL_RGBA32F, element_bounce_);
  bounce_field_ = sum;
  bounce_alone_ = choice.alone;
}

void SceneBuffers::useReference(const std::shared_ptr<const ReferenceLight>& reference) {
  const bool fits = reference && reference->mesh->cut == mesh_->cut;
  if (!fits && !direct_reference_) {
    Snapshot direct;
    direct.mesh = mesh_;
    direct.direct = fields_.snapshot()->direct;
    direct_reference_ = std::make_shared<const ReferenceLight>(
        referenceLight(direct, {false, {}, false}, "direct light alone"));
  }
  const auto& wanted = fits ? reference : direct_reference_;
  if (wanted == reference_light_) return;
  send<glm::vec3>(reference_, SharedField(wanted, &wanted->reflected), mesh_->vertices.size());
  reference_light_ = wanted;
}

void SceneBuffers::useGiven(const std::shared_ptr<const VertexField>& given) {
  const bool fits = given && given->cut == mesh_->cut;
  const std::shared_ptr<const VertexField> wanted = fits ? given : nullptr;
  if (given_uploaded_ && wanted == given_field_) return;
  send<glm::vec3>(given_, wanted ? SharedField(wanted, &wanted->values) : nullptr, mesh_->vertices.size());
  given_field_ = wanted;
  given_uploaded_ = true;
}

/// What the quantity shows besides the light; null where that is all.
const gl::Buffer* SceneBuffers::extraOf(Quantity quantity) const {
  if (const auto field = fieldOf(quantity)) return &fields_.vertices(*field);
  if (quantity == Quantity::kDifference) return &reference_;
  return quantity == Quantity::kFormFactors || quantity == Quantity::kLastShot ? &given_ : nullptr;
}

// What is shown is a matter of which buffer is read; what is not read is 0.
const gl::Texture& SceneBuffers::bind(const Reading& reading) {
  const gl::Functions& fn = context_.functions();
  const Quantity quantity = reading.mode.quantity;
  const std::shared_ptr<const MeshField> bounces = readsLight(quantity) ? bounceSum(reading.light) : nullptr;
  if (bounces) useBounces(reading.light, bounces);
  if (quantity == Quantity::kDifference) useReference(reading.reference);
  if (extraOf(quantity) == &given_) useGiven(reading.given);
  const bool direct = !reading.light.indirect;
  fn.BindVertexArray(vertex_array_.id());
  const auto attach = [&](GLuint location, const gl::Buffer* buffer) {
    if (buffer) return attribute(fn, location, *buffer, sizeof(glm::vec3), 0);
    fn.DisableVertexAttribArray(location);
  };
  const gl::Buffer& light =
      bounces ? bounce_irradiance_ : fields_.vertices(direct ? LightField::kDirect : LightField::kIrradiance);
  attach(3, readsLight(quantity) && !reading.mode.per_element ? &light : nullptr);
  attach(4, reading.ambient ? &fields_.vertices(LightField::kAmbient) : nullptr);
  attach(5, extraOf(quantity));
  fn.BindBuffer(GL_ARRAY_BUFFER, 0);
  if (quantity == Quantity::kPatches) return element_colours_texture_;
  if (bounces) return element_bounce_texture_;
  return fields_.elements(direct ? LightField::kElementDirect : LightField::kElementIrradiance);
}

void SceneBuffers::beginMesh(const std::shared_ptr<const Mesh>& shared_mesh) {
  const gl::Functions& fn = context_.functions();
  const Mesh& mesh = *shared_mesh;
  const UnlitSurfaces unlit = unlitSurfaces(mesh);
  const std::size_t sides_shown = mesh.sides.size() + unlit.surfaces.size();
  checkTexels(fn, std::max({mesh.triangle_element.size(), std::size_t{mesh.element_count}, 2 * sides_shown}));
  mesh_uploads_.clear();
  mesh_ = shared_mesh;
  bounds_ = {mesh.bounds_min, mesh.bounds_max};
  const auto own = [&]<class T>(const std::vector<T>& values) {
    return std::shared_ptr<const std::vector<T>>(shared_mesh, &values);
  };

  beginVertices(shared_mesh);
  beginUnlit(unlit);
  sendAll(mesh_uploads_, triangles_, own(mesh.triangle_vertices));
  triangle_index_count_ = static_cast<GLsizei>(mesh.triangle_vertices.size());
  triangle_blocks_ = TriangleBlocks(mesh);
  merged_count_ = 0;
  has_edges_ = has_patch_colours_ = false;

  beginSides(shared_mesh, unlit);
  sendAll(mesh_uploads_, triangle_elements_, own(mesh.triangle_element));
  attachTexels(sides_texture_, GL_RGBA32F, sides_);
  attachTexels(triangle_elements_texture_, GL_R32UI, triangle_elements_);
}

// All that materials are to the picture.
void SceneBuffers::beginSides(const std::shared_ptr<const Mesh>& shared_mesh, const UnlitSurfaces& unlit) {
  mesh_ = shared_mesh;
  const Mesh& mesh = *mesh_;
  const std::size_t shown = mesh.sides.size() + unlit.surfaces.size();
  auto sides = std::make_shared<std::vector<glm::vec4>>(std::max<std::size_t>(2 * shown, 1), glm::vec4(0.0f));
  for (std::size_t i = 0; i < mesh.sides.size(); ++i) {
    (*sides)[2 * i] = finiteTexel(mesh.sides[i].reflectance);
    (*sides)[2 * i].w = mesh.sides[i].back ? kBackSide : kFrontSide;
    (*sides)[2 * i + 1] = finiteTexel(mesh.sides[i].emission);
  }
  for (std::size_t i = 0; i < unlit.surfaces.size(); ++i) {
    const Material& material = mesh.materials[mesh.surfaces[unlit.surfaces[i]].material];
    (*sides)[2 * (mesh.sides.size() + i)] = finiteTexel(material.reflectance);
    (*sides)[2 * (mesh.sides.size() + i)].w = kEitherSide;
  }
  sendAll<glm::vec4>(mesh_uploads_, sides_, std::move(sides));
}

void SceneBuffers::beginVertices(const std::shared_ptr<const Mesh>& shared_mesh) {
  const gl::Functions& fn = context_.functions();
  const std::size_t vertices = shared_mesh->vertices.size();
  allocate(vertices_, vertices * sizeof(GpuVertex), GL_STATIC_DRAW);
  mesh_uploads_.add<GpuVertex>(vertices_, vertices,
                               [shared_mesh](std::size_t first, std::size_t count, GpuVertex* out) {
                                 for (std::size_t k = 0; k < count; ++k) {
                                   const Vertex& v = shared_mesh->vertices[first + k];
                                   out[k] = {v.position, v.normal, v.side};
                                 }
                               });
  fn.BindVertexArray(vertex_array_.id());
  attachVertices(fn, vertices_);
  fn.BindBuffer(GL_ARRAY_BUFFER, 0);
  fn.BindVertexArray(0);
}

/// In three attributes of vertices; those of the light stay OpenGL's default, which is 0.
void SceneBuffers::beginUnlit(const UnlitSurfaces& unlit) {
  const gl::Functions& fn = context_.functions();
  unlit_corners_ = unlit.corners.size();
  if (unlit_corners_ == 0) return;
  auto corners = std::make_shared<std::vector<GpuVertex>>();
  corners->reserve(unlit_corners_);
  for (std::size_t k = 0; k < unlit_corners_; ++k) {
    const Surface& surface = mesh_->surfaces[unlit.surfaces[unlit.of[k]]];
    corners->push_back({unlit.corners[k], glm::vec3(surface.normal),
                        static_cast<std::uint32_t>(mesh_->sides.size()) + unlit.of[k]});
  }
  sendAll<GpuVertex>(mesh_uploads_, unlit_, std::move(corners));
  fn.BindVertexArray(unlit_vertex_array_.id());
  attachVertices(fn, unlit_);
  fn.BindBuffer(GL_ARRAY_BUFFER, 0);
  fn.BindVertexArray(0);
}

void SceneBuffers::bindUnlit() const { context_.functions().BindVertexArray(unlit_vertex_array_.id()); }

bool SceneBuffers::lacksMarks(const DisplayMode& mode) const {
  return mesh_ &&
         ((mode.edges && !has_edges_) || (mode.quantity == Quantity::kPatches && !has_patch_colours_));
}

void SceneBuffers::beginMarks(const MeshMarks& marks) {
  if (marks.edges && !has_edges_) {
    sendAll(mesh_uploads_, edges_, marks.edges);
    edge_index_count_ = static_cast<GLsizei>(marks.edges->size());
    has_edges_ = true;
  }
  if (marks.patch_colours && !has_patch_colours_) {
    const std::size_t elements = mesh_->element_count;
    allocate(element_colours_, std::max<std::size_t>(elements, 1) * sizeof(glm::vec4), GL_STATIC_DRAW);
    mesh_uploads_.add<glm::vec4>(
        element_colours_, elements,
        [mesh = mesh_, colours = marks.patch_colours](std::size_t first, std::size_t count, glm::vec4* out) {
          for (std::size_t k = 0; k < count; ++k)
            out[k] = glm::vec4(kPatchPalette[(*colours)[mesh->element_patch[first + k]]], 0.0f);
        });
    attachTexels(element_colours_texture_, GL_RGBA32F, element_colours_);
    has_patch_colours_ = true;
  }
}

void SceneBuffers::beginMerged(const MergedTriangles& merged) {
  if (!mesh_ || merged.cut != mesh_->cut || !merged.corners || hasMerged()) return;
  sendAll(mesh_uploads_, merged_, merged.corners);
  sendAll(mesh_uploads_, merged_elements_, merged.elements);
  attachTexels(merged_elements_texture_, GL_R32UI, merged_elements_);
  merged_blocks_ = merged.blocks;
  merged_count_ = merged.corners->size() / 3;
}

}  // namespace unshot
