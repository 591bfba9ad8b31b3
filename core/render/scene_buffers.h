// What a SceneView draws from: GPU copies of a mesh and of one state of its solve.
#pragma once

#include <memory>
#include <vector>

#include "gl/objects.h"
#include "render/camera.h"
#include "render/display_modes.h"
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
  /// another cut than before (Mesh::cut), shared fields only when they are other objects. Values that are not
  /// finite become 0. Throws Error kEnvironment where the mesh is too large for the driver.
  void begin(const std::shared_ptr<const Snapshot>& snapshot);
  /// About so many more bytes. Nothing may be drawn before all uploadBytes() are sent.
  void upload(std::size_t bytes);
  std::size_t uploadBytes() const { return mesh_uploads_.bytes() + field_uploads_.bytes(); }
  /// Whether the mode shows marks of the mesh that are not there yet.
  bool lacksMarks(const DisplayMode& mode) const;
  /// Begins to upload those of the present mesh.
  void beginMarks(const MeshMarks& marks);
  /// Finds and uploads at once those that the mode still lacks.
  void completeMarks(const DisplayMode& mode);
  /// Whether the present mesh has triangles that are merged, or on their way.
  bool hasMerged() const { return merged_count_ > 0; }
  /// Begins to upload them; of another mesh they are of no use.
  void beginMerged(const MergedTriangles& merged);

  /// Binds the vertex array with the light and the quantity that are meant, brought up to date. Returns the
  /// same light of the elements, or their colours where the quantity is that. `reference`: what kDifference
  /// compares with, where it is of this mesh; else direct light alone. `given`: the values of kFormFactors
  /// and kLastShot, 0 where it is of another mesh.
  const gl::Texture& bind(const LightChoice& light, Quantity quantity,
                          const std::shared_ptr<const ReferenceLight>& reference,
                          const std::shared_ptr<const VertexField>& given);
  /// Binds the vertex array of surfaces without a lit side: no light, nothing of any quantity.
  void bindUnlit() const;
  /// Whether this quantity has a field of its own beside the light.
  bool hasField(Quantity quantity) const { return fieldOf(quantity) != nullptr; }

  /// Null before the first snapshot.
  const Mesh* mesh() const { return mesh_.get(); }
  const Bounds& bounds() const { return bounds_; }
  const glm::dvec3& sky() const { return sky_; }
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
  /// Where the light that is meant is, brought up to date.
  struct LightBuffers {
    const gl::Buffer& vertices;
    const gl::Texture& elements;
  };
  LightBuffers lightOf(const LightChoice& choice);
  void useGiven(const std::shared_ptr<const VertexField>& given);
  void useReference(const std::shared_ptr<const ReferenceLight>& reference);
  /// The buffer with what this quantity shows besides the light; null where that is all.
  const gl::Buffer* fieldOf(Quantity quantity) const;

  gl::Context& context_;
  std::shared_ptr<const Mesh> mesh_;
  Uploads mesh_uploads_, field_uploads_;
  SharedField direct_field_, element_direct_field_, bounces_field_, residual_field_;  // as uploaded
  Bounds bounds_;
  glm::dvec3 sky_{0.0};
  gl::VertexArray vertex_array_, unlit_vertex_array_;
  std::shared_ptr<const BounceLight> bounce_light_;         // of the snapshot
  std::shared_ptr<const MeshField> bounce_field_;           // the sum that was uploaded, or
  bool bounce_alone_ = false;                               // its last term alone
  std::shared_ptr<const ReferenceLight> direct_reference_;  // where there is no other
  std::shared_ptr<const ReferenceLight> reference_light_;   // as uploaded
  std::shared_ptr<const VertexField> given_field_;          // as uploaded
  bool given_uploaded_ = false;                             // or nothing in its place
  gl::Buffer vertices_, irradiance_, direct_, ambient_, unshot_, bounces_, residual_, bounce_irradiance_,
      reference_, given_;
  TriangleBlocks triangle_blocks_, merged_blocks_;
  gl::Buffer triangles_, merged_, edges_, unlit_;
  gl::Buffer sides_, triangle_elements_, merged_elements_, element_irradiance_, element_direct_,
      element_bounce_, element_colours_;
  gl::Texture sides_texture_, triangle_elements_texture_, merged_elements_texture_,
      element_irradiance_texture_, element_direct_texture_, element_bounce_texture_, element_colours_texture_;
  GLsizei triangle_index_count_ = 0;
  GLsizei edge_index_count_ = 0;
  std::size_t merged_count_ = 0, unlit_corners_ = 0;
  bool has_edges_ = false, has_patch_colours_ = false;  // or they are on their way
};

}  // namespace unshot
