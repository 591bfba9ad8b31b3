#include "solver/patch_matrix.h"

#include <algorithm>
#include <cmath>

namespace unshot {
namespace {

constexpr std::size_t kColumnsCompared = 64;

}  // namespace

PatchMatrix::PatchMatrix(const Receivers& receivers, std::span<const double> area, std::size_t budget)
    : receivers_(receivers),
      area_(area),
      budget_(budget),
      columns_(area.size()),
      known_(area.size(), 0),
      reached_(area.size(), 0),
      closure_(area.size(), 0.0),
      sum_(area.size(), 0.0) {}

void PatchMatrix::set(std::uint32_t q, const Column& column) {
  ++version_;
  if (known_[q]) {
    bytes_ -= columns_[q].capacity() * sizeof(Entry);
    columns_[q] = {};
    known_[q] = 0;
    --known_count_;
  }
  if (bytes_ >= budget_) return;
  column.forEach([&](std::uint32_t v, double k) {
    for (std::uint32_t s = receivers_.start[v]; s < receivers_.start[v + 1]; ++s) {
      const PatchShare& share = receivers_.shares[s];
      if (sum_[share.patch] == 0) touched_.push_back(share.patch);
      sum_[share.patch] += share.area * k;
    }
  });
  std::sort(touched_.begin(), touched_.end());
  std::vector<Entry>& out = columns_[q];
  out.reserve(touched_.size());
  double sent = 0;
  for (const std::uint32_t p : touched_) {
    sent += sum_[p] / area_[q];
    reached_[p] = 1;
    out.push_back({p, static_cast<float>(sum_[p] / area_[p])});
    sum_[p] = 0;
  }
  touched_.clear();
  closure_[q] = column.defect;
  largest_sent_ = std::max(largest_sent_, sent);
  bytes_ += out.capacity() * sizeof(Entry);
  known_[q] = 1;
  ++known_count_;
}

void PatchMatrix::product(std::span<const glm::dvec3> x, std::span<glm::dvec3> out) const {
  std::fill(out.begin(), out.end(), glm::dvec3(0.0));
  for (std::size_t q = 0; q < columns_.size(); ++q) {
    if (x[q] == glm::dvec3(0.0)) continue;
    for (const Entry& e : columns_[q]) out[e.patch] += static_cast<double>(e.value) * x[q];
  }
}

glm::dvec3 PatchMatrix::transposed(std::uint32_t q, std::span<const glm::dvec3> x) const {
  glm::dvec3 sum(0.0);
  for (const Entry& e : columns_[q]) sum += area_[e.patch] * static_cast<double>(e.value) * x[e.patch];
  return sum / area_[q];
}

void PatchMatrix::transposed(std::span<const glm::dvec3> x, std::span<glm::dvec3> out) const {
  for (std::uint32_t q = 0; q < columns_.size(); ++q) out[q] = transposed(q, x);
}

double PatchMatrix::exchange(std::uint32_t p, std::uint32_t q) const {
  const std::vector<Entry>& column = columns_[q];
  const auto at = std::lower_bound(column.begin(), column.end(), p,
                                   [](const Entry& e, std::uint32_t patch) { return e.patch < patch; });
  return at != column.end() && at->patch == p ? area_[p] * static_cast<double>(at->value) : 0.0;
}

FormFactorDefects PatchMatrix::defects() const {
  FormFactorDefects out;
  out.columns = known_count_;
  double lost = 0, area = 0, difference = 0, size = 0;
  const std::size_t stride = std::max<std::size_t>(known_count_ / kColumnsCompared, 1);
  std::size_t number = 0;
  for (std::uint32_t q = 0; q < columns_.size(); ++q) {
    if (!known_[q]) continue;
    lost += area_[q] * closure_[q] * closure_[q];
    area += area_[q];
    if (number++ % stride != 0) continue;
    for (const Entry& e : columns_[q]) {
      if (!known_[e.patch] || e.patch == q) continue;
      const double there = area_[e.patch] * static_cast<double>(e.value), back = exchange(q, e.patch);
      // Where nothing comes back the pair would not be met from the other side.
      const double weight = back == 0 ? 2 : 1;
      difference += weight * (there - back) * (there - back);
      size += weight * (there * there + back * back);
    }
  }
  if (area > 0) out.closure = std::sqrt(lost / area);
  if (size > 0) out.reciprocity = std::sqrt(difference / size);
  return out;
}

}  // namespace unshot
