// What a lecture shows of a solve beside its light: the form factors of one patch, the last shot by itself,
// and the matrix M gathered to a few groups of patches.
//
// With P = R K among patches, G_ij = P_ij is the share of patch i's view that patch j fills, and by
// reciprocity the share of i's light that arrives at j: B_i = E_i + R_i sum_j G_ij B_j. All of it is the
// solver's own K, as far as its columns are at hand.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "formfactor/method.h"
#include "mesh/mesh.h"

namespace unshot {

/// A field on the vertices of a mesh, for display.
struct VertexField {
  std::uint64_t cut = 0;  ///< Mesh::cut
  std::vector<glm::vec3> values;
};

/// A patch that light comes from.
struct PatchSource {
  std::uint32_t patch = 0;
  double factor = 0;          ///< G_ij
  glm::dvec3 radiosity{0.0};  ///< B_j [W/m^2]
};

/// One patch i and what it has to do with the others.
struct PatchInsight {
  std::uint64_t cut = 0;  ///< of the mesh that the numbers belong to
  std::uint32_t patch = 0;
  double area = 0;  ///< A_i [m^2]
  glm::dvec3 emission{0.0}, reflectance{0.0};
  glm::dvec3 radiosity{0.0};  ///< B_i = S_i + U_i [W/m^2]
  glm::dvec3 unshot{0.0};     ///< U_i [W/m^2]
  glm::dvec3 received{0.0};   ///< H_i, the mean over the patch of what others have shot so far [W/m^2]
  /// Column i: where the patch's light goes. Empty where it is not at hand.
  std::vector<float> sent;                       ///< G_ij by A_i G_ij = A_j G_ji, one per patch j
  std::shared_ptr<const VertexField> sent_over;  ///< G_ij per area of j [1/m^2], all channels alike
  double escape = 0, defect = 0;                 ///< as Column has them
  ColumnQuality quality = ColumnQuality::kFull;
  /// Row i, over the columns at hand.
  std::vector<float> seen;           ///< G_ij, one per patch j; 0 where column j is not at hand
  double row_sum = 0;                ///< sum_j G_ij
  glm::dvec3 gathered{0.0};          ///< sum_j G_ij B_j [W/m^2]
  std::vector<PatchSource> sources;  ///< where most of that comes from, the largest first
  std::size_t missing = 0;           ///< patches with light whose columns are not at hand
};

/// What one step did, where it was taken alone.
struct ShotInsight {
  std::uint64_t cut = 0;
  std::uint64_t shots = 0;        ///< how many there were, this one included
  std::size_t moved = 0;          ///< patches that shot in it; only where it is 1 the rest is known
  std::uint32_t patch = kNone;    ///< that shot
  double area = 0;                ///< [m^2]
  glm::dvec3 unshot_before{0.0};  ///< A |U| of it before [W]
  glm::dvec3 sent{0.0};           ///< A d [W]
  glm::dvec3 escaped{0.0};        ///< of that, met no surface [W]
  glm::dvec3 absorbed{0.0};       ///< and was absorbed where it arrived [W]
  glm::dvec3 reflected{0.0};      ///< and is unshot light of others now [W]
  glm::dvec3 defect{0.0};         ///< and was lost (negative: gained) by approximation [W]
  std::shared_ptr<const VertexField> added;  ///< rho K d, what it added to B [W/m^2]
};

/// M = R G gathered to groups of patches, all of one side as far as that goes.
struct GatheredMatrix {
  static constexpr std::size_t kMostGroups = 64;

  struct Group {
    std::uint32_t patches = 0;
    std::uint32_t side = kNone;  ///< in Mesh::sides; kNone: of several sides, or the sky
    bool sky = false;            ///< the source behind all patches, which nothing is known to arrive at
    std::uint32_t material = 0;  ///< of one of them
    bool several_materials = false;
    double area = 0;                             ///< [m^2]
    glm::dvec3 emission{0.0}, reflectance{0.0};  ///< area means
    bool sends = false;                          ///< columns of it are at hand, or it sends nothing
  };

  std::uint64_t cut = 0;
  std::vector<std::uint32_t> group;  ///< one per patch and, where there is one, the sky
  std::vector<Group> groups;
  std::vector<double> factors;        ///< G_ij = sum_p A_p sum_q P_pq / A_i, row by row
  std::vector<glm::dvec3> transport;  ///< M_ij, the same with R_p: the share of j's radiosity that i reflects
  std::size_t columns = 0;            ///< at hand, of as many as there are patches
  std::size_t missing = 0;  ///< of patches that hold light; the others that are not at hand hold none

  std::size_t size() const { return groups.size(); }
  double factor(std::size_t i, std::size_t j) const { return factors[i * size() + j]; }
  const glm::dvec3& at(std::size_t i, std::size_t j) const { return transport[i * size() + j]; }
  double rowSum(std::size_t i) const;
};

struct Insight {
  std::uint32_t next = kNone;  ///< the patch with the most unshot power; kNone: nothing is unshot
  std::shared_ptr<const PatchInsight> patch;
  std::shared_ptr<const ShotInsight> shot;
  std::shared_ptr<const GatheredMatrix> matrix;
  std::vector<glm::dvec3> group_radiosity;  ///< B of its groups, area means [W/m^2]
};

/// What of it is wanted; the last shot always is.
struct InsightWanted {
  std::uint64_t cut = 0;               ///< of the mesh that `patch` is of
  std::optional<std::uint32_t> patch;  ///< whose column is computed where it is not at hand
  bool next = false;                   ///< the patch that shoots next in its place
  bool matrix = false;                 ///< worked out when the solve rests
  bool operator==(const InsightWanted&) const = default;
};

}  // namespace unshot
