// The random places at which errors are estimated (residuals.h), and two looks from each through the true
// geometry.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "formfactor/receivers.h"
#include "mesh/element_points.h"
#include "session/exact_look.h"
#include "session/gather.h"
#include "session/snapshot.h"

namespace unshot {

/// A point of the mesh's display triangles, or a receiver.
struct ResidualPlace {
  std::uint32_t patch = 0;
  std::uint32_t triangle = 0;  ///< of a point
  glm::dvec3 weights{0.0};     ///< of a point: barycentric in it
  std::uint32_t receiver = 0;  ///< of a receiver
  double weight = 1;           ///< density of even places over that of these
  Gather looks[2];             ///< where looks are exact the first alone, as another would be the same
};

class ResidualPlaces {
 public:
  /// All outlive the places. `occlusion`: whether anything can stand between two points.
  ResidualPlaces(const Mesh& mesh, const Receivers& receivers, bool occlusion, std::uint64_t seed);

  /// Takes `places` more points and as many receivers; a place costs some 700 rays, or, where nothing can
  /// occlude and elements are few, a factor for each of them, and no receivers are taken then. Half of the
  /// places are spread evenly over the area, half by the square of the light that is reflected there, of
  /// which `shown` is H as it is shown: a few bright places can hold most of an error. Surfaces that emit
  /// have places too, for what goes on from there.
  void add(std::size_t places, const MeshField& shown);
  /// Whether looks are exact (exact_look.h).
  bool exact() const { return looks_exact_; }
  /// Gives the points away, for restore() of other places of this mesh, seed and occlusion; none where looks
  /// are not exact.
  std::vector<ResidualPlace> take();
  /// Has these points as if they had been added. Before any other.
  void restore(std::vector<ResidualPlace> points) { points_ = std::move(points); }
  /// Those that follow are chosen by the light as it is then.
  void forget();
  const std::vector<ResidualPlace>& points() const { return points_; }
  const std::vector<ResidualPlace>& receivers() const { return at_receivers_; }

 private:
  struct Choice {
    std::uint32_t index;
    double weight;
  };
  static Choice choose(const std::vector<double>& area_sum, const std::vector<double>& light_sum,
                       std::uint64_t number, std::uint64_t seed);
  void findLight(const MeshField& shown);
  void addPoint(std::uint64_t number);
  void addReceiver(std::uint64_t number);
  double areaOf(std::uint32_t receiver) const;

  const Mesh& mesh_;
  const Receivers& receivers_;
  std::uint64_t seed_;
  bool looks_exact_;
  std::optional<Gatherer> gatherer_;  // one of the two, from the first look on
  std::optional<ExactLook> exact_;
  // Running sums over triangles and receivers: of the area where places may lie, and of the square of the
  // light there.
  std::vector<double> triangle_area_sum_, receiver_area_sum_;
  std::vector<double> triangle_light_sum_, receiver_light_sum_;
  std::optional<ElementPoints> element_points_;  // where receivers are elements
  std::vector<ResidualPlace> points_, at_receivers_;
};

}  // namespace unshot
