// The state of a solve: S, H, U, in double, per channel.
//
// S_q is the radiosity that patch q has shot so far, H = K S the irradiance received, B = E + rho H, and U =
// R B - S what is unshot, R the area mean over a patch. U is the residual of S = R (E + rho K S), so U = 0 is
// the solution; every mode only chooses what to shoot next.
//
// H_d = K E is the part of H that came straight from emitters. Of what a patch shoots, its emission goes
// first: once it has shot E in all, its light is in H_d, and what it shoots from then on was reflected.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "formfactor/transport.h"
#include "mesh/mesh.h"
#include "solver/light_flow.h"

namespace unshot {

class RadiosityState {
 public:
  /// Nothing shot yet: S = 0, H = 0, U = E. `emission` and `reflectance` one per patch.
  RadiosityState(const Transport& transport, std::vector<glm::dvec3> emission,
                 std::vector<glm::dvec3> reflectance);

  /// What is shot may go by one channel: for all three where it is grey and all reflectances are, the same to
  /// the last bit, and alone where the other two are 0.
  void allowFewerChannels(bool allowed);
  /// Nothing shot again.
  void reset();

  /// All that changes while it solves.
  struct Values {
    std::vector<glm::dvec3> shot, unshot;              ///< S and U, one per patch [W/m^2]
    std::vector<glm::dvec3> emission_left;             ///< E not yet shot, one per patch [W/m^2]
    std::vector<glm::dvec3> irradiance, direct;        ///< H and H_d, one per receiver [W/m^2]
    glm::dvec3 escaped_power{0.0}, defect_power{0.0};  ///< per channel [W]
    std::uint64_t emission_shots = 0;
  };
  const Values& values() const { return values_; }
  /// Goes on from values of a state of the same patches and receivers; false, and nothing done, where they
  /// are of others.
  bool setValues(Values values);
  /// The values are of a state whose E was this, one per patch. To be called after setValues(), before
  /// relabelEmission() and balance().
  void setFormerEmission(const std::vector<glm::dvec3>& emission);
  /// Whether q has shot more emission than it has, or as reflected light what is emission.
  bool isMislabelled(std::uint32_t q) const;
  /// Of what q has shot its emission goes first again, and H_d follows. `before` and `after` are column q as
  /// it was and as it is.
  void relabelEmission(std::uint32_t q, const Column& before, const Column& after);
  /// relabelEmission() for all, but that H_d stays: to be followed by renew().
  void relabelEmission();
  /// Nothing shot again in this channel, 0 to 2.
  void resetChannel(int channel);
  /// U = R B - S from S and H.
  void balance();

  std::size_t patchCount() const { return values_.shot.size(); }

  /// S_q += d, H += K d; H_d += K of the emission in d: per channel, as much of d as is emission not yet shot
  /// (a negative d holds none). `column` is column q of the transport the state was made with.
  void shoot(std::uint32_t q, const glm::dvec3& d, const Column& column);
  /// S += factor d, H += factor K d, channel by channel. All emission must have been shot before (shoot), so
  /// that the flow adds nothing to H_d.
  void add(const glm::dvec3& factor, const LightFlow& flow);
  /// Better form factors for what q has shot: H += (K' - K) S_q, and U with it; S stays. `before` and `after`
  /// are column q as it was and as it is. Not for emitters, whose direct light has no second form.
  void replaceColumn(std::uint32_t q, const Column& before, const Column& after);

  /// Better form factors for all: H, H_d and U follow from S and the columns of `transport`, which is that of
  /// the state; S stays.
  void renew(Transport& transport);

  const std::vector<glm::dvec3>& emission() const { return emission_; }        ///< E, one per patch [W/m^2]
  const std::vector<glm::dvec3>& reflectance() const { return reflectance_; }  ///< rho, one per patch
  const std::vector<glm::dvec3>& shot() const { return values_.shot; }         ///< S, one per patch [W/m^2]
  const std::vector<glm::dvec3>& unshot() const { return values_.unshot; }     ///< U, one per patch [W/m^2]
  const std::vector<glm::dvec3>& irradiance() const {
    return values_.irradiance;
  }  ///< H, one per receiver [W/m^2]
  /// H_d: irradiance straight from emitters, one per receiver [W/m^2]; all of it once every emitter has shot.
  const std::vector<glm::dvec3>& direct() const { return values_.direct; }
  /// How many shots carried emission: direct() is as before where this is.
  std::uint64_t emissionShots() const { return values_.emission_shots; }
  const std::vector<double>& area() const { return area_; }  ///< one per patch [m^2]
  /// Emission of patch q that it has not shot yet [W/m^2].
  const glm::dvec3& emissionLeft(std::uint32_t q) const { return values_.emission_left[q]; }

  double emittedPower() const { return emitted_power_; }  ///< sum A E over patches and channels [W]
  glm::dvec3 emittedPowers() const;                       ///< sum A E over patches, per channel [W]
  double unshotPower() const;                             ///< sum A |U| over patches and channels [W]
  /// Whether U is no more than what rounding leaves of what was emitted.
  bool onlyRoundingUnshot() const { return unshotPower() <= 1e-15 * emitted_power_; }
  double escapedPower() const;  ///< shot into nothing so far, over channels [W]
  double defectPower() const;   ///< shot and lost by approximation so far, over channels [W]

 private:
  void receive(std::uint32_t q, const glm::dvec3& d, const Column& column);
  glm::dvec3 emissionInShot(std::uint32_t q) const;
  glm::dvec3 takeEmission(std::uint32_t q, const glm::dvec3& d);

  const Transport& transport_;
  std::vector<glm::dvec3> emission_, reflectance_;
  std::vector<double> area_;
  std::vector<double> share_of_area_;  // of its patch, one per PatchShare of the receivers
  double emitted_power_ = 0;
  bool fewer_channels_ = false, grey_reflectance_ = false;
  Values values_;
};

}  // namespace unshot
