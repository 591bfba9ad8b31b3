#include "solver/state.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace unshot {
namespace {

double sumOfChannels(const glm::dvec3& x) { return x.x + x.y + x.z; }

}  // namespace

RadiosityState::RadiosityState(const Transport& transport, std::vector<glm::dvec3> emission,
                               std::vector<glm::dvec3> reflectance)
    : transport_(transport),
      emission_(std::move(emission)),
      reflectance_(std::move(reflectance)),
      shot_(emission_.size(), glm::dvec3(0.0)),
      unshot_(emission_),
      irradiance_(transport.receiverCount(), glm::dvec3(0.0)),
      direct_(transport.receiverCount(), glm::dvec3(0.0)),
      emission_left_(emission_),
      area_(transport.patchArea()) {
  for (std::size_t q = 0; q < emission_.size(); ++q) emitted_power_ += area_[q] * sumOfChannels(emission_[q]);
}

void RadiosityState::reset() {
  unshot_ = emission_left_ = emission_;
  for (std::vector<glm::dvec3>* field : {&shot_, &irradiance_, &direct_})
    std::fill(field->begin(), field->end(), glm::dvec3(0.0));
  escaped_power_ = defect_power_ = 0;
  emission_shots_ = 0;
}

glm::dvec3 RadiosityState::takeEmission(std::uint32_t q, const glm::dvec3& d) {
  const glm::dvec3 taken = glm::clamp(d, glm::dvec3(0.0), emission_left_[q]);
  emission_left_[q] -= taken;
  return taken;
}

void RadiosityState::receive(std::uint32_t q, const glm::dvec3& d, const Column& column) {
  const Receivers& receivers = transport_.receivers();
  column.forEach([&](std::uint32_t v, double k) {
    const glm::dvec3 received = k * d;
    irradiance_[v] += received;
    for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s) {
      const PatchShare& share = receivers.shares[s];
      unshot_[share.patch] += share.area / area_[share.patch] * reflectance_[share.patch] * received;
    }
  });
  escaped_power_ += column.escape * area_[q] * sumOfChannels(d);
  defect_power_ += column.defect * area_[q] * sumOfChannels(d);
}

void RadiosityState::shoot(std::uint32_t q, const glm::dvec3& d, const Column& column) {
  shot_[q] += d;
  unshot_[q] -= d;
  receive(q, d, column);
  const glm::dvec3 emitted = takeEmission(q, d);
  if (emitted == glm::dvec3(0.0)) return;
  ++emission_shots_;
  column.forEach([&](std::uint32_t v, double k) { direct_[v] += k * emitted; });
}

void RadiosityState::add(const glm::dvec3& factor, const LightFlow& flow) {
  for (std::size_t v = 0; v < irradiance_.size(); ++v) irradiance_[v] += factor * flow.irradiance[v];
  const std::vector<glm::dvec3> reflected = reflectedMeans(transport_, reflectance_, flow.irradiance);
  for (std::size_t q = 0; q < shot_.size(); ++q) {
    shot_[q] += factor * flow.shot[q];
    unshot_[q] += factor * (reflected[q] - flow.shot[q]);
  }
  escaped_power_ += sumOfChannels(factor * flow.escaped);
  defect_power_ += sumOfChannels(factor * flow.defect);
}

void RadiosityState::replaceColumn(std::uint32_t q, const Column& before, const Column& after) {
  receive(q, shot_[q], after);
  receive(q, -shot_[q], before);
}

double RadiosityState::unshotPower() const {
  double sum = 0;
  for (std::size_t q = 0; q < unshot_.size(); ++q) {
    sum += area_[q] * (std::abs(unshot_[q].x) + std::abs(unshot_[q].y) + std::abs(unshot_[q].z));
  }
  return sum;
}

}  // namespace unshot
