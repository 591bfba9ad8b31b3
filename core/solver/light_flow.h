// What patches shoot together and where it arrives: linear in what is shot, so that it may be worked out
// first and scaled and applied afterwards.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "formfactor/transport.h"

namespace unshot {

struct LightFlow {
  std::vector<glm::dvec3> shot;        ///< d, one per patch [W/m^2]
  std::vector<glm::dvec3> irradiance;  ///< K d, one per receiver [W/m^2]
  glm::dvec3 escaped{0.0};             ///< power that meets no surface, per channel [W]
  glm::dvec3 defect{0.0};              ///< power lost by approximation, per channel [W]

  /// this += factor * other, channel by channel.
  void add(const glm::dvec3& factor, const LightFlow& other);
};

/// Works out K d column by column.
class TransportProduct {
 public:
  /// Starts anew. `d` one per patch. Where `transposed`, gathered() is worked out in the same pass.
  void begin(const Transport& transport, std::vector<glm::dvec3> d, bool transposed = false);
  bool running() const { return running_; }
  /// Goes on: a number of columns at hand, or one that has to be computed. Returns how many columns were
  /// used; running() is false after the last one.
  std::size_t advance(Transport& transport);

  /// The result, valid once running() is false. It may be moved from.
  LightFlow& flow() { return flow_; }
  /// sum_p A_p (R K)_pq d_p, one per patch q [W], for the patches with d != 0; only where asked for.
  const std::vector<glm::dvec3>& gathered() const { return gathered_; }

 private:
  bool wanted(std::uint32_t q) const;

  LightFlow flow_;
  std::vector<glm::dvec3> weighted_, gathered_;
  std::uint32_t next_ = 0;
  bool transposed_ = false, running_ = false;
};

/// R rho f: the area mean over each patch of what it reflects of the irradiance `f` (one per receiver).
std::vector<glm::dvec3> reflectedMeans(const Transport& transport, const std::vector<glm::dvec3>& reflectance,
                                       const std::vector<glm::dvec3>& f);

}  // namespace unshot
