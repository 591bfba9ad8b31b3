// What a SceneView draws from: GPU copies of a mesh and of one state of its solve.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gl/objects.h"
#include "render/camera.h"
#include "render/display_modes.h"
#include "render/light_fields.h"
#include "render/merged_triangles.h"
#include "render/mesh_marks.h"
#include "render/reference_light.h"
#include "render/triangle_blocks.h"
#include "render/unlit_surfaces.h"
#include "render/uploads.h"
#include "session/snapshot.h"

namespace unshot {

struct VertexField;

/// All calls on the thread where the context is current.
class SceneBuffers {
 public:
  explicit SceneBuffers(gl::Context& context);

  /// Begins an upload, giving up what is not yet done of the one before: geometry only when the mesh is
  /// another cut than before (Mesh::cut), light when a picture reads it. Throws Error kEnvironment where the
  /// mesh is too large for the driver.
  void begin(std::shared_ptr<const Snapshot> snapshot);
  /// What a picture reads.
  struct Reading {
    const DisplayMode& mode;
    const LightChoice& light;
    bool ambient;  ///< it is added to the light
    /// What kDifference compares with, where it is of this mesh; else direct light alone.
    const std::shared_ptr<const ReferenceLight>& reference;
    /// The values of kFormFactors and kLastShot, 0 where it is of another mesh.
    const std::shared_ptr<const VertexField>& given;
  };
  /// Begins to upload fields of the snapshot that such a picture reads and that are not there yet.
  void beginFields(const Reading& reading);
  /// About so many more bytes. Nothing may be drawn before all uploadBytes() are sent.
  void upload(std::size_t bytes);
  std::size_t uploadBytes() const { return mesh_uploads_.bytes() + fields_.bytes(); }
  /// Whether the mode shows marks of the mesh that are not there yet.
  bool lacksMarks(const DisplayMode& mode) const;
  /// Begins to upload those of the present mesh.
  void beginMarks(const MeshMarks& marks);
  /// Finds and uploads at once all that such a picture still lacks.
  void complete(const Reading& reading);
  /// Whether the present mesh has triangles that are merged, or on their way.
  bool hasMerged() const { return merged_count_ > 0; }
  /// Begins to upload them; of another mesh they are of no use.
  void beginMerged(const MergedTriangles& merged);

  /// Binds the vertex array with what a picture reads, which is there. Returns the same light of the
  /// elements, or their colours where those are shown.
  const gl::Texture& bind(const Reading& reading);
  /// Binds the vertex array of surfaces without a lit side: no light, nothing of any quantity.
  void bindUnlit() const;
  /// Whether this quantity has a field of its own beside the light.
  bool hasField(Quantity quantity) const { return extraOf(quantity) != nullptr; }

  /// Null before the first snapshot.
  const Mesh* mesh() const { return mesh_.get(); }
  const Bounds& bounds() const { return bounds_; }
  /// Its radiosity [W/m^2].
  glm::dvec3 sky() const { return fields_.snapshot() ? fields_.snapshot()->sky : glm::dvec3(0.0); }
  /// Of what was compared with last.
  double referenceMean() const { return reference_light_ ? reference_light_->mean : 0; }
  struct Triangles {
    const gl::Buffer& corners;
    const gl::Texture& elements;
    const TriangleBlocks& blocks;
    std::size_t count;
  };
  Triangles triangles() const {
    return {triangles_, triangle_elements_texture_, triangle_blocks_,
            static_cast<std::size_t>(triangle_index_count_) / 3};
  }
  Triangles mergedTriangles() const {
    return {merged_, merged_elements_texture_, merged_blocks_, merged_count_};
  }
  const gl::Buffer& edges() const { return edges_; }
  std::size_t unlitCount() const { return unlit_corners_ / 3; }  ///< triangles of bindUnlit()
  std::size_t edgeCount() const { return static_cast<std::size_t>(edge_index_count_) / 2; }
  const gl::Texture& sides() const { return sides_texture_; }

 private:
  using SharedField = std::shared_ptr<const std::vector<glm::vec3>>;

  void beginMesh(const std::shared_ptr<const Mesh>& mesh);
  void beginSides(const std::shared_ptr<const Mesh>& mesh, const UnlitSurfaces& unlit);
  void beginVertices(const std::shared_ptr<const Mesh>& mesh);
  void beginUnlit(const UnlitSurfaces& unlit);
  std::shared_ptr<const MeshField> bounceSum(const LightChoice& choice) const;
  void useBounces(const LightChoice& choice, const std::shared_ptr<const MeshField>& sum);
  void useGiven(const std::shared_ptr<const VertexField>& given);
  void useReference(const std::shared_ptr<const ReferenceLight>& reference);
  /// The field of the snapshot that the quantity is.
  static std::optional<LightField> fieldOf(Quantity quantity);
  /// Whether it follows from irradiance.
  static bool readsLight(Quantity quantity);
  const gl::Buffer* extraOf(Quantity quantity) const;

  gl::Context& context_;
  std::shared_ptr<const Mesh> mesh_;
  Uploads mesh_uploads_;
  LightFields fields_;
  Bounds bounds_;
  gl::VertexArray vertex_array_, unlit_vertex_array_;
  std::shared_ptr<const MeshField> bounce_field_;           // the sum that was uploaded, or
  bool bounce_alone_ = false;                               // its last term alone
  std::shared_ptr<const ReferenceLight> direct_reference_;  // where there is no other
  std::shared_ptr<const ReferenceLight> reference_light_;   // as uploaded
  std::shared_ptr<const VertexField> given_field_;          // as uploaded
  bool given_uploaded_ = false;                             // or nothing in its place
  gl::Buffer vertices_, bounce_irradiance_, reference_, given_;
  TriangleBlocks triangle_blocks_, merged_blocks_;
  gl::Buffer triangles_, merged_, edges_, unlit_;
  gl::Buffer sides_, triangle_elements_, merged_elements_, element_bounce_, element_colours_;
  gl::Texture sides_texture_, triangle_elements_texture_, merged_elements_texture_, element_bounce_texture_,
      element_colours_texture_;
  GLsizei triangle_index_count_ = 0;
  GLsizei edge_index_count_ = 0;
  std::size_t merged_count_ = 0, unlit_corners_ = 0;
  bool has_edges_ = false, has_patch_colours_ = false;  // or they are on their way
};

}  // namespace unshot
