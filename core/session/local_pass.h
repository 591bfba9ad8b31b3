// The local pass: one more application of the operator, nearer to the truth than the solution it starts from.
// What a receiver has from patches near to it is gathered again from their elements, each with its own
// radiosity, which changes along it (element_slopes.h), and its own visibility, where the solve has one
// radiosity and one look for the whole patch. Farther away that makes no difference.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/point_tree.h"
#include "base/workers.h"
#include "formfactor/patch_polygons.h"
#include "formfactor/transport.h"
#include "mesh/mesh.h"
#include "mesh/mesh_rays.h"
#include "session/element_slopes.h"
#include "session/snapshot.h"
#include "solver/state.h"

namespace unshot {

class LocalPass {
 public:
  /// So often it is to go: beside an edge one wall's light depends on the other's there.
  static constexpr int kPasses = 2;

  /// For receivers at vertices; all must outlive the pass. `occlusion`: whether anything can stand between
  /// two points. `workers` share it out; null: the calling thread does all. `rays` of the mesh; null: it
  /// makes its own where it needs some.
  LocalPass(const Mesh& mesh, const Receivers& receivers, bool occlusion,
            std::shared_ptr<Workers> workers = nullptr, std::shared_ptr<const MeshRays> rays = nullptr);

  /// Starts anew, from the present state and `irradiance`, H at the vertices and of each element [W/m^2].
  void begin(const RadiosityState& state, const MeshField& irradiance);
  bool running() const { return next_ < mesh_.patch_count; }
  /// Goes on for some milliseconds, along columns that are kept; what is near along others stays as it is.
  void advance(Transport& transport);
  /// What the last pass that came to its end adds to the irradiance, one per receiver [W/m^2]; empty before.
  const std::vector<glm::dvec3>& irradiance() const { return irradiance_; }
  /// One came to its end with this, as irradiance() says (or none, where it is empty).
  void restore(std::vector<glm::dvec3> irradiance) { irradiance_ = std::move(irradiance); }
  /// The pass under way, if there is one, comes to no end.
  void abandon() { next_ = kNone; }
  /// None has come to its end.
  void forget() { irradiance_.clear(); }

 private:
  struct Tile {  // a piece of an element
    FactorPolygon polygon;
    std::uint32_t element;
  };
  // An element of the base: whole, as it is looked at from afar, and in the pieces of the mesh's elements.
  struct Group {
    std::vector<Tile> whole, parts;
    glm::dvec3 middle{0.0};
    double radius = 0;
  };
  void findPlaces();
  void makeGroups();
  // What a receiver sees of an element, or of a whole group where that is far enough.
  struct Look {
    std::uint32_t of = 0;
    bool whole = false;     // of a group
    float factor = 0;       // with the weight of the receiver's view
    glm::vec3 moment{0.0};  // ElementSlopes::moment, with the same weight
  };
  struct Near {
    std::uint32_t receiver = 0;
    std::uint32_t end = 0;  // of its looks; they begin where those of the one before end
  };
  struct Looks {
    bool found = false;
    std::vector<Near> near;  // receivers that are near to the patch and see it, but for what occludes
    std::vector<Look> looks;
  };
  void gather(std::uint32_t q, const Column& column, const RowClosure& closure);
  // What one thread works with.
  struct Hand {
    Looks found;  // of the patch at hand; what is kept of it takes no more room than it needs
    std::vector<glm::dvec3> scratch;
  };
  void findAhead(const Transport& transport);
  void find(std::uint32_t q, Hand& hand) const;
  bool look(const ReceiverView& view, std::uint32_t q, std::vector<Look>& out,
            std::vector<glm::dvec3>& scratch) const;
  glm::dvec3 lightOf(const Look& look) const;

  const Mesh& mesh_;
  const Receivers& receivers_;
  const bool occlusion_;
  // From the first pass on, up to tree_:
  std::optional<PatchPolygons> polygons_;
  std::shared_ptr<const MeshRays> rays_;  // null where nothing can occlude
  std::vector<Group> groups_;             // one per element of the base
  std::vector<std::vector<std::uint32_t>> groups_of_patch_;
  std::uint32_t first_receiver_ = 0;
  std::vector<glm::dvec3> places_;  // of the receivers from first_receiver_ on
  std::optional<PointTree> tree_;
  std::vector<glm::dvec3> element_light_, group_light_, patch_light_;  // of the pass that is running
  ElementSlopes slopes_;                                               // and of its light
  std::vector<glm::dvec3> sum_, irradiance_;
  std::vector<Looks> looks_;  // one per patch
  std::size_t kept_ = 0;      // looks
  std::shared_ptr<Workers> workers_;
  std::vector<Hand> hands_;  // one per worker
  std::uint32_t next_ = kNone, found_until_ = 0;
};

}  // namespace unshot
