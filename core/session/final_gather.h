// Final gathering: a solve's light at every vertex of the mesh, by rays through the true geometry, in place
// of what hemicubes have counted.
//
// First the light that the solve has on its elements goes on, bounce after bounce, by one look of each
// element at all others from random points of it: Jacobi's iteration with random rows, which ends when the
// light hardly changes. Then each vertex takes a look, and more as long as there is time; every time that all
// have looked it is shown. Straight from emitters light comes by their exact factors and shadow rays, so that
// shadows are as sharp as the mesh allows.
//
// Source: M. C. Reichert, "A two-pass radiosity method driven by lights and viewer position", 1992. Error:
// the mesh's, for light that is interpolated between vertices; noise of a few percent at each of them, more
// where thousands of lamps are about equally near; nothing of hemicubes is left.
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/workers.h"
#include "formfactor/receivers.h"
#include "mesh/element_points.h"
#include "session/gather.h"
#include "session/noise_filter.h"
#include "session/sent_light.h"
#include "session/snapshot.h"

namespace unshot {

/// What one came to.
struct GatheredLight {
  MeshField irradiance;  ///< H
  MeshField direct;      ///< H_d, of it what comes straight from emitters and the sky
};

/// Wall time [s] of all bounces, and of a look of every vertex.
struct GatherSeconds {
  double bounces = 0, round = 0;
};

class FinalGather {
 public:
  /// Looks of each vertex that time is kept for; there may be more, or fewer.
  static constexpr int kExpectedRounds = 4;

  /// The mesh must outlive it. `workers` share it out; the light is the same with any number of them.
  FinalGather(const Mesh& mesh, std::shared_ptr<Workers> workers, std::uint64_t seed);

  /// By the time of some looks now.
  GatherSeconds expectedSeconds() const;
  /// Starts with what the solve has: `irradiance` and `direct` as they are shown.
  void begin(const RadiosityState& state, const MeshField& irradiance, const MeshField& direct);
  bool running() const { return stage_ != Stage::kRest; }
  /// Fraction of the looks taken, were all bounces needed.
  double progress() const;
  /// Goes on for some milliseconds.
  void advance();
  /// Ends it at once: vertices that have not looked yet keep what they began with.
  void finish();
  /// What the looks of all vertices came to that were the last; null before.
  const std::shared_ptr<const GatheredLight>& light() const { return light_; }
  void restore(std::shared_ptr<const GatheredLight> light) { light_ = std::move(light); }
  /// The one under way, if there is one, comes to nothing.
  void abandon() { stage_ = Stage::kRest; }
  /// As if there had been none.
  void forget();

 private:
  enum class Stage { kRest, kBounces, kVertices };

  void prepare() const;
  glm::dvec3 lookFrom(std::span<const glm::dvec3> positions, const glm::dvec3& normal, std::uint64_t stream,
                      const LookSize& size, glm::dvec3& direct) const;
  void lookFromElement(std::uint32_t element);
  void lookFromVertex(std::uint32_t vertex);
  void endBounce();
  void endRound();
  // What vertices have seen in the rounds so far.
  struct Looks {
    std::vector<glm::dvec3> mean;  // [W/m^2]
    std::vector<double> squares;   // of the rounds' differences from it, over channels summed

    void take(std::uint32_t vertex, int rounds_before, const glm::dvec3& value) {
      const glm::dvec3 off = value - mean[vertex];
      mean[vertex] += off / (rounds_before + 1.0);
      squares[vertex] += glm::dot(off, value - mean[vertex]);
    }
  };
  // Of a mean, by the squares of the rounds' differences from it.
  double varianceOf(double squares) const { return squares / (round_ * (round_ - 1.0)); }
  double noise() const;
  void show();

  const Mesh& mesh_;
  std::shared_ptr<Workers> workers_;
  std::uint64_t seed_;
  // Made when first needed.
  mutable std::optional<Gatherer> gatherer_;
  mutable std::optional<Receivers> receivers_;  // at vertices
  mutable std::optional<ElementPoints> points_;
  std::optional<NoiseFilter> filter_;

  Stage stage_ = Stage::kRest;
  int bounce_ = 0, round_ = 0;  // of elements and of vertices
  std::uint32_t next_ = 0;      // element or vertex
  SentLight sent_;
  std::vector<glm::dvec3> reflectance_;     // one per element
  std::vector<glm::dvec3> element_direct_;  // H_d, one per element, mean of the bounces so far [W/m^2]
  std::vector<glm::dvec3> next_light_;      // one per element [W/m^2]
  Looks indirect_, direct_;
  std::shared_ptr<const GatheredLight> light_;
};

}  // namespace unshot
