#include "session/final_gather.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"
#include "base/random.h"
#include "session/fields.h"

namespace unshot {
namespace {

// Small, so that two of them tell their noise; what lamps bring varies by 5 to 20 % from look to look where
// dozens are about as near (lost_empire).
constexpr LookSize kVertexLook{.strata = 6, .emitters = 8, .without_bias = false};
// What elements send is looked at by many, and with each bounce anew; straight at emitters in the first ones.
constexpr LookSize kElementLook{.strata = 5, .emitters = 8, .without_bias = false},
    kLaterElementLook{.strata = 5, .emitters = 0, .without_bias = false};
constexpr int kDirectBounces = 2;
// Bounces end when one changes less of the light's power, which is some times what is still to come, or when
// so many have been.
constexpr double kSettled = 0.004;
constexpr int kMostBounces = 6;
// As many are expected: the solve brings the first ones.
constexpr int kExpectedBounces = 4;
// Each vertex looks so often at most, or until vertices know what they receive to this share of it, in the
// mean; so many looks tell how they differ.
constexpr int kMostRounds = 16, kLeastRounds = 2;
constexpr double kLeastNoise = 0.05;
constexpr double kSeconds = 10e-3;   // of an advance
constexpr int kPositions = 8;        // of an element's look
constexpr std::uint32_t kPart = 64;  // looks
constexpr std::uint32_t kTrialRuns = 32;

std::vector<glm::dvec3> wide(const std::vector<glm::vec3>& field) { return {field.begin(), field.end()}; }

double sumOf(const glm::dvec3& v) { return v.x + v.y + v.z; }

MeshField meshFieldOf(const Mesh& mesh, const std::vector<glm::dvec3>& vertices) {
  return {{vertices.begin(), vertices.end()}, meanOverElements(mesh, vertices)};
}

}  // namespace

FinalGather::FinalGather(const Mesh& mesh, std::shared_ptr<Workers> workers, std::uint64_t seed)
    : mesh_(mesh), workers_(std::move(workers)), seed_(mixBits(seed ^ 0x676174686572ull)) {}

void FinalGather::prepare() const {
  if (gatherer_) return;
  gatherer_.emplace(mesh_);
  receivers_.emplace(makeReceivers(mesh_, ReceiverKind::kVertices));
  points_.emplace(mesh_);
}

GatherSeconds FinalGather::expectedSeconds() const {
  prepare();
  const std::size_t count = receivers_->views.size();
  if (count == 0) return {};
  // Of one look, in runs of neighbours as they come, the first ones of which find memory cold.
  const auto secondsOf = [&](const LookSize& size) {
    double seconds = 0;
    for (std::uint32_t run = 0; run < kTrialRuns; ++run) {
      const std::size_t first = mixBits(seed_ + run) % count;
      double began = wallSeconds();
      for (std::uint32_t k = 0; k < 2 * kPart; ++k) {
        if (k == kPart) began = wallSeconds();
        const ReceiverView& view = receivers_->views[(first + k) % count];
        gatherer_->look(view.position, view.normal, k, size);
      }
      seconds += wallSeconds() - began;
    }
    return seconds / (kTrialRuns * kPart);
  };
  const double elements = kExpectedBounces * static_cast<double>(mesh_.element_count);
  return {elements * secondsOf(kElementLook) / workers_->count(),
          static_cast<double>(count) * secondsOf(kVertexLook) / workers_->count()};
}

void FinalGather::begin(const RadiosityState& state, const MeshField& irradiance, const MeshField& direct) {
  prepare();
  sent_ = lightOf(mesh_, state, irradiance, true);
  reflectance_.clear();
  for (const std::uint32_t q : mesh_.element_patch) reflectance_.push_back(state.reflectance()[q]);
  next_light_.assign(mesh_.element_count, glm::dvec3(0.0));
  element_direct_ = next_light_;
  direct_ = {wide(direct.vertices), {}};
  indirect_ = {wide(irradiance.vertices), {}};
  for (std::size_t v = 0; v < indirect_.mean.size(); ++v) indirect_.mean[v] -= direct_.mean[v];
  for (Looks* looks : {&direct_, &indirect_}) looks->squares.assign(looks->mean.size(), 0);
  stage_ = Stage::kBounces;
  bounce_ = round_ = 0;
  next_ = 0;
}

double FinalGather::progress() const {
  if (!running()) return light_ ? 1 : 0;
  const double elements = kMostBounces * static_cast<double>(mesh_.element_count),
               vertices = static_cast<double>(direct_.mean.size()),
               all = elements + kExpectedRounds * vertices;
  if (stage_ == Stage::kBounces) return (bounce_ * static_cast<double>(mesh_.element_count) + next_) / all;
  return std::min((elements + round_ * vertices + next_) / all, 0.99);
}

glm::dvec3 FinalGather::lookFrom(std::span<const glm::dvec3> positions, const glm::dvec3& normal,
                                 std::uint64_t stream, const LookSize& size, glm::dvec3& direct) const {
  const Gather look = gatherer_->lookFromAll(positions, normal, stream, size);
  direct = straightOf(look, sent_);
  return irradianceOf(look, sent_, mesh_);
}

void FinalGather::lookFromElement(std::uint32_t element) {
  if (reflectance_[element] == glm::dvec3(0.0) || points_->empty(element)) return;
  std::uint64_t draws = mixBits(seed_ + (static_cast<std::uint64_t>(bounce_ + 1) << 32) + element);
  glm::dvec3 positions[kPositions];
  for (glm::dvec3& p : positions)
    p = points_->at(element, [&] { return unitInterval(draws = mixBits(draws)); });
  glm::dvec3 direct(0.0);
  const glm::dvec3 all = lookFrom(positions, mesh_.sides[mesh_.element_side[element]].normal, mixBits(draws),
                                  bounce_ < kDirectBounces ? kElementLook : kLaterElementLook, direct);
  if (bounce_ < kDirectBounces)
    element_direct_[element] += (direct - element_direct_[element]) / (bounce_ + 1.0);
  next_light_[element] = reflectance_[element] * (all - direct + element_direct_[element]);
}

void FinalGather::lookFromVertex(std::uint32_t vertex) {
  const auto views = receivers_->viewsOf(vertex);
  if (views.empty()) return;
  glm::dvec3 sum(0.0), straight(0.0);
  for (std::size_t k = 0; k < views.size(); ++k) {
    glm::dvec3 direct(0.0);
    const std::uint64_t stream = mixBits(seed_ + vertex) + k + (static_cast<std::uint64_t>(round_) << 32);
    sum += views[k].weight *
           lookFrom({&views[k].position, 1}, views[k].normal, mixBits(stream), kVertexLook, direct);
    straight += views[k].weight * direct;
  }
  if (round_ == 0) indirect_.mean[vertex] = direct_.mean[vertex] = glm::dvec3(0.0);
  indirect_.take(vertex, round_, sum - straight);
  direct_.take(vertex, round_, straight);
}

void FinalGather::endBounce() {
  double changed = 0, all = 0;
  for (std::uint32_t e = 0; e < mesh_.element_count; ++e) {
    changed += mesh_.element_area[e] * sumOf(next_light_[e] - sent_.light[e]);
    all += mesh_.element_area[e] * sumOf(next_light_[e]);
  }
  sent_.light.swap(next_light_);
  next_ = 0;
  if (++bounce_ < kMostBounces && std::abs(changed) > kSettled * all) return;
  stage_ = Stage::kVertices;
}

void FinalGather::endRound() {
  next_ = 0;
  if (++round_ >= kMostRounds || (round_ >= kLeastRounds && noise() < kLeastNoise)) return finish();
  show();
}

void FinalGather::advance() {
  const double until = wallSeconds() + kSeconds;
  while (running() && wallSeconds() < until) {
    const bool bounces = stage_ == Stage::kBounces;
    const auto end = bounces ? mesh_.element_count : static_cast<std::uint32_t>(direct_.mean.size());
    const std::uint32_t first = next_, parts = 2 * workers_->count();
    next_ = std::min(end, first + parts * kPart);
    workers_->run((next_ - first + kPart - 1) / kPart, [&](std::size_t part, unsigned) {
      const std::uint32_t from = first + static_cast<std::uint32_t>(part) * kPart,
                          to = std::min(next_, from + kPart);
      for (std::uint32_t k = from; k < to; ++k) bounces ? lookFromElement(k) : lookFromVertex(k);
    });
    if (next_ < end) continue;
    bounces ? endBounce() : endRound();
  }
}

double FinalGather::noise() const {
  double sum = 0;
  std::size_t lit = 0;
  for (std::size_t v = 0; v < direct_.mean.size(); ++v) {
    const double light = glm::length(direct_.mean[v] + indirect_.mean[v]);
    if (!(light > 0)) continue;
    sum += std::sqrt(varianceOf(direct_.squares[v] + indirect_.squares[v])) / light;
    ++lit;
  }
  return lit > 0 ? sum / static_cast<double>(lit) : 0;
}

// Straight light changes too much from vertex to vertex for its noise to be told from it: means would take
// its peaks beside lamps away.
void FinalGather::show() {
  std::vector<glm::dvec3> all = indirect_.mean;
  if (round_ >= kLeastRounds) {
    std::vector<double> variance = indirect_.squares;
    for (double& v : variance) v = varianceOf(v);
    if (!filter_) filter_.emplace(mesh_);
    all = filter_->filtered(std::move(all), std::move(variance), *workers_);
  }
  for (std::size_t v = 0; v < all.size(); ++v) all[v] += direct_.mean[v];
  light_ = std::make_shared<const GatheredLight>(
      GatheredLight{meshFieldOf(mesh_, all), meshFieldOf(mesh_, direct_.mean)});
}

void FinalGather::finish() {
  if (!running()) return;
  stage_ = Stage::kRest;
  show();
  sent_ = {};
  for (auto* field : {&reflectance_, &element_direct_, &next_light_}) *field = {};
  direct_ = indirect_ = {};
}

void FinalGather::forget() {
  abandon();
  light_ = nullptr;
}

}  // namespace unshot
