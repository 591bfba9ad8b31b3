// A scene under its checks, with what several of them need: each made when it is first asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "mesh/mesh_rays.h"
#include "mesh/parallel_surfaces.h"
#include "scene/polygon_edges.h"
#include "scene/scene.h"
#include "session/light_views.h"
#include "session/light_walks.h"

namespace unshot {

/// For one thread. Keeps references: scene, mesh and token must outlive it.
class CheckedScene {
 public:
  CheckedScene(const Scene& scene, const Mesh& mesh, bool emit_front_only, const CancelToken& cancel)
      : scene_(scene), mesh_(mesh), emit_front_only_(emit_front_only), cancel_(cancel) {}

  const Scene& scene() const { return scene_; }
  const Mesh& mesh() const { return mesh_; }
  bool emitFrontOnly() const { return emit_front_only_; }
  const CancelToken& cancel() const { return cancel_; }

  const MeshRays& rays();
  /// The same, for others; null where no check has asked for them.
  const std::shared_ptr<const MeshRays>& raysAtHand() const { return rays_; }
  const ParallelSurfaces& parallels();
  const std::vector<LightView>& lights();
  const LightWalks& walks();
  std::span<const PolygonEdge> edges();

  /// "file:line" of a polygon; the file alone where it has no line.
  std::string placeOfPolygon(std::uint32_t polygon) const;
  /// Length of the diagonal of the scene's bounds [m].
  double size() const;

 private:
  const Scene& scene_;
  const Mesh& mesh_;
  bool emit_front_only_;
  const CancelToken& cancel_;
  std::shared_ptr<const MeshRays> rays_;
  std::optional<ParallelSurfaces> parallels_;
  std::optional<std::vector<LightView>> lights_;
  std::optional<LightWalks> walks_;
  std::optional<std::vector<PolygonEdge>> edges_;
};

}  // namespace unshot
