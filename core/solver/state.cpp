#include "solver/state.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/colour.h"

namespace unshot {
namespace {

double sumOfChannels(const glm::dvec3& x) { return x.x + x.y + x.z; }

// The one that is not 0; -1: there are several, or none.
int onlyChannel(const glm::dvec3& x) {
  if ((x.x != 0) + (x.y != 0) + (x.z != 0) != 1) return -1;
  return x.x != 0 ? 0 : x.y != 0 ? 1 : 2;
}

}  // namespace

RadiosityState::RadiosityState(const Transport& transport, std::vector<glm::dvec3> emission,
                               std::vector<glm::dvec3> reflectance)
    : transport_(transport),
      emission_(std::move(emission)),
      reflectance_(std::move(reflectance)),
      area_(transport.patchArea()) {
  for (const PatchShare& share : transport.receivers().shares)
    share_of_area_.push_back(share.area / area_[share.patch]);
  for (std::size_t q = 0; q < emission_.size(); ++q) emitted_power_ += area_[q] * sumOfChannels(emission_[q]);
  reset();
}

void RadiosityState::allowFewerChannels(bool allowed) {
  fewer_channels_ = allowed;
  grey_reflectance_ = std::all_of(reflectance_.begin(), reflectance_.end(), isGrey);
}

void RadiosityState::reset() {
  values_ = {};
  values_.shot.assign(emission_.size(), glm::dvec3(0.0));
  values_.unshot = values_.emission_left = emission_;
  values_.irradiance.assign(transport_.receiverCount(), glm::dvec3(0.0));
  values_.direct = values_.irradiance;
}

bool RadiosityState::setValues(Values values) {
  const auto like = [](const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    return a.size() == b.size();
  };
  if (!like(values.shot, values_.shot) || !like(values.unshot, values_.unshot) ||
      !like(values.emission_left, values_.emission_left) || !like(values.irradiance, values_.irradiance) ||
      !like(values.direct, values_.direct))
    return false;
  values_ = std::move(values);
  return true;
}

void RadiosityState::setFormerEmission(const std::vector<glm::dvec3>& emission) {
  for (std::size_t q = 0; q < emission_.size(); ++q) values_.emission_left[q] += emission_[q] - emission[q];
}

glm::dvec3 RadiosityState::emissionInShot(std::uint32_t q) const {
  return glm::clamp(values_.shot[q], glm::dvec3(0.0), emission_[q]);
}

bool RadiosityState::isMislabelled(std::uint32_t q) const {
  return values_.emission_left[q] != emission_[q] - emissionInShot(q);
}

void RadiosityState::relabelEmission(std::uint32_t q, const Column& before, const Column& after) {
  const glm::dvec3 was = emission_[q] - values_.emission_left[q], is = emissionInShot(q);
  before.forEach([&](std::uint32_t v, double k) { values_.direct[v] -= k * was; });
  after.forEach([&](std::uint32_t v, double k) { values_.direct[v] += k * is; });
  values_.emission_left[q] = emission_[q] - is;
  ++values_.emission_shots;
}

void RadiosityState::relabelEmission() {
  for (std::uint32_t q = 0; q < patchCount(); ++q)
    values_.emission_left[q] = emission_[q] - emissionInShot(q);
  ++values_.emission_shots;
}

void RadiosityState::resetChannel(int channel) {
  for (std::size_t q = 0; q < values_.shot.size(); ++q) {
    values_.shot[q][channel] = 0;
    values_.unshot[q][channel] = values_.emission_left[q][channel] = emission_[q][channel];
  }
  for (auto* field : {&values_.irradiance, &values_.direct}) {
    for (glm::dvec3& h : *field) h[channel] = 0;
  }
  values_.escaped_power[channel] = values_.defect_power[channel] = 0;
}

void RadiosityState::balance() {
  values_.unshot = reflectedMeans(transport_, reflectance_, values_.irradiance);
  for (std::size_t q = 0; q < emission_.size(); ++q) values_.unshot[q] += emission_[q] - values_.shot[q];
}

glm::dvec3 RadiosityState::takeEmission(std::uint32_t q, const glm::dvec3& d) {
  const glm::dvec3 taken = glm::clamp(d, glm::dvec3(0.0), values_.emission_left[q]);
  values_.emission_left[q] -= taken;
  return taken;
}

void RadiosityState::receive(std::uint32_t q, const glm::dvec3& d, const Column& column) {
  const Receivers& receivers = transport_.receivers();
  // `of` takes from a colour what takes part, or the one channel for all of it.
  const auto receiveAll = [&](const auto& sent, auto&& of, auto&& rho_of) {
    column.forEach([&](std::uint32_t v, double k) {
      const auto received = k * sent;
      of(values_.irradiance[v]) += received;
      for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s) {
        const std::uint32_t p = receivers.shares[s].patch;
        of(values_.unshot[p]) += share_of_area_[s] * rho_of(reflectance_[p]) * received;
      }
    });
  };
  const auto all = [](auto& colour) -> auto& { return colour; };
  const int only = fewer_channels_ ? onlyChannel(d) : -1;
  if (only >= 0) {
    const auto one = [only](auto& colour) -> auto& { return colour[only]; };
    receiveAll(d[only], one, one);
  } else if (fewer_channels_ && grey_reflectance_ && isGrey(d)) {
    receiveAll(d.x, all, [](const glm::dvec3& rho) { return rho.x; });
  } else {
    receiveAll(d, all, all);
  }
  values_.escaped_power += column.escape * area_[q] * d;
  values_.defect_power += column.defect * area_[q] * d;
}

void RadiosityState::shoot(std::uint32_t q, const glm::dvec3& d, const Column& column) {
  values_.shot[q] += d;
  values_.unshot[q] -= d;
  receive(q, d, column);
  const glm::dvec3 emitted = takeEmission(q, d);
  if (emitted == glm::dvec3(0.0)) return;
  ++values_.emission_shots;
  column.forEach([&](std::uint32_t v, double k) { values_.direct[v] += k * emitted; });
}

void RadiosityState::add(const glm::dvec3& factor, const LightFlow& flow) {
  for (std::size_t v = 0; v < values_.irradiance.size(); ++v)
    values_.irradiance[v] += factor * flow.irradiance[v];
  const std::vector<glm::dvec3> reflected = reflectedMeans(transport_, reflectance_, flow.irradiance);
  for (std::size_t q = 0; q < values_.shot.size(); ++q) {
    values_.shot[q] += factor * flow.shot[q];
    values_.unshot[q] += factor * (reflected[q] - flow.shot[q]);
  }
  values_.escaped_power += factor * flow.escaped;
  values_.defect_power += factor * flow.defect;
}

void RadiosityState::replaceColumn(std::uint32_t q, const Column& before, const Column& after) {
  receive(q, values_.shot[q], after);
  receive(q, -values_.shot[q], before);
}

void RadiosityState::renew(Transport& transport) {
  std::fill(values_.irradiance.begin(), values_.irradiance.end(), glm::dvec3(0.0));
  std::fill(values_.direct.begin(), values_.direct.end(), glm::dvec3(0.0));
  values_.escaped_power = values_.defect_power = glm::dvec3(0.0);
  values_.unshot = emission_;
  for (std::uint32_t q = 0; q < patchCount(); ++q) {
    const glm::dvec3 d = values_.shot[q], emitted = emission_[q] - values_.emission_left[q];
    values_.unshot[q] -= d;
    if (d == glm::dvec3(0.0) && emitted == glm::dvec3(0.0)) continue;
    const Column& column = transport.column(q);
    receive(q, d, column);
    if (emitted != glm::dvec3(0.0))
      column.forEach([&](std::uint32_t v, double k) { values_.direct[v] += k * emitted; });
  }
}

glm::dvec3 RadiosityState::emittedPowers() const {
  glm::dvec3 sum(0.0);
  for (std::size_t q = 0; q < emission_.size(); ++q) sum += area_[q] * emission_[q];
  return sum;
}

double RadiosityState::escapedPower() const { return sumOfChannels(values_.escaped_power); }

double RadiosityState::defectPower() const { return sumOfChannels(values_.defect_power); }

double RadiosityState::unshotPower() const {
  double sum = 0;
  for (std::size_t q = 0; q < values_.unshot.size(); ++q) {
    const glm::dvec3 size = glm::abs(values_.unshot[q]);
    sum += area_[q] * sumOfChannels(size);
  }
  return sum;
}

}  // namespace unshot
