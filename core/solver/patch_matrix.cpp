#include "solver/patch_matrix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>

#include "base/colour.h"

namespace unshot {
namespace {

constexpr std::size_t kColumnsCompared = 64;
// Gaps of no more patches than another run would take space for are bridged.
constexpr std::uint32_t kBridged = 2;
// Patches that receive are put in order by going through all where they are more than one in so many.
constexpr std::size_t kFew = 16;

// Share of the known area whose patches may send more than the others do.
constexpr double kUnusual = 0.01;

// Four sums side by side, which processors take in pairs or more.
double dotOf(const float* a, const double* b, std::size_t count) {
  double sums[4] = {};
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    for (std::size_t lane = 0; lane < 4; ++lane) sums[lane] += static_cast<double>(a[k + lane]) * b[k + lane];
  }
  for (; k < count; ++k) sums[0] += static_cast<double>(a[k]) * b[k];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// The channels that sums have to be worked out for, and each of the three as a multiple of one of them.
struct OwnChannels {
  std::array<int, 3> own{0, 1, 2};
  std::size_t count = 3;
  std::array<std::size_t, 3> of{0, 1, 2};  // index in `own`
  std::array<double, 3> factor{1, 1, 1};

  glm::dvec3 colour(const std::array<double, 3>& sums) const {
    return {factor[0] * sums[of[0]], factor[1] * sums[of[1]], factor[2] * sums[of[2]]};
  }
};

// The factor of channel c over channel `own`, where the two are in proportion.
std::optional<double> proportion(std::span<const glm::dvec3> x, int c, int own) {
  const auto first = std::find_if(x.begin(), x.end(), [&](const glm::dvec3& v) { return v[own] != 0; });
  if (first == x.end()) return std::nullopt;
  const double factor = (*first)[c] / (*first)[own];
  const bool all =
      std::all_of(x.begin(), x.end(), [&](const glm::dvec3& v) { return isInProportion(v, c, factor, own); });
  return all ? std::optional(factor) : std::nullopt;
}

OwnChannels ownChannels(std::span<const glm::dvec3> x) {
  OwnChannels out;
  out.count = 0;
  for (int c = 0; c < 3; ++c) {
    if (std::all_of(x.begin(), x.end(), [c](const glm::dvec3& v) { return v[c] == 0; })) {
      out.of[c] = 0;
      out.factor[c] = 0;
      continue;
    }
    std::optional<double> factor;
    for (std::size_t k = 0; k < out.count && !factor; ++k) {
      factor = proportion(x, c, out.own[k]);
      out.of[c] = k;
    }
    out.factor[c] = factor.value_or(1);
    if (factor) continue;
    out.of[c] = out.count;
    out.own[out.count++] = c;
  }
  return out;
}

}  // namespace

PatchMatrix::PatchMatrix(const Receivers& receivers, std::span<const double> area, std::size_t budget)
    : receivers_(receivers),
      area_(area),
      budget_(budget),
      columns_(area.size()),
      known_(area.size(), 0),
      reached_(area.size(), 0),
      closure_(area.size(), 0.0),
      sent_(area.size(), 0.0),
      sum_(area.size(), 0.0) {}

void PatchMatrix::set(std::uint32_t q, const Column& column) {
  ++version_;
  if (known_[q]) {
    bytes_ -= columns_[q].bytes();
    entry_count_ -= columns_[q].values.size();
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
  putInOrder();
  store(columns_[q], q);
  closure_[q] = column.defect;
  bytes_ += columns_[q].bytes();
  entry_count_ += columns_[q].values.size();
  known_[q] = 1;
  ++known_count_;
}

void PatchMatrix::putInOrder() {
  if (touched_.size() * kFew < sum_.size()) {
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    return;
  }
  touched_.clear();
  for (std::uint32_t p = 0; p < sum_.size(); ++p) {
    if (sum_[p] != 0) touched_.push_back(p);
  }
}

// Of the sums, which are 0 again afterwards.
void PatchMatrix::store(PatchColumn& out, std::uint32_t q) {
  std::uint32_t values = 0, runs = 1;
  for (std::size_t k = 0; k < touched_.size(); ++k) {
    const std::uint32_t gap = k == 0 ? kBridged + 1 : touched_[k] - touched_[k - 1] - 1;
    if (gap > kBridged) ++runs;
    values += 1 + (gap > kBridged ? 0 : gap);
  }
  out.values.reserve(values);
  out.runs.reserve(runs);
  double sent = 0;
  for (std::size_t k = 0; k < touched_.size(); ++k) {
    const std::uint32_t p = touched_[k], gap = k == 0 ? kBridged + 1 : p - touched_[k - 1] - 1;
    if (gap > kBridged)
      out.runs.push_back({p, static_cast<std::uint32_t>(out.values.size())});
    else
      out.values.insert(out.values.end(), gap, 0.0f);
    out.values.push_back(static_cast<float>(sum_[p] / area_[p]));
    sent += sum_[p] / area_[q];
    reached_[p] = 1;
    sum_[p] = 0;
  }
  out.runs.push_back({static_cast<std::uint32_t>(sum_.size()), values});
  touched_.clear();
  sent_[q] = sent;
  largest_sent_ = std::max(largest_sent_, sent);
}

double PatchMatrix::usuallySent() const {
  std::vector<std::uint32_t> by_sent;
  double left_out = 0;
  for (std::uint32_t q = 0; q < known_.size(); ++q) {
    if (!known_[q]) continue;
    by_sent.push_back(q);
    left_out += kUnusual * area_[q];
  }
  std::sort(by_sent.begin(), by_sent.end(), [this](auto a, auto b) { return sent_[a] > sent_[b]; });
  for (const std::uint32_t q : by_sent) {
    left_out -= area_[q];
    if (left_out < 0) return std::max(sent_[q], 1.0);
  }
  return 1;
}

template <class F>
void PatchMatrix::forEachRun(std::uint32_t q, F&& f) const {
  const PatchColumn& column = columns_[q];
  for (std::size_t r = 0; r + 1 < column.runs.size(); ++r) {
    const Run& run = column.runs[r];
    f(run.patch, column.values.data() + run.at, std::size_t{column.runs[r + 1].at - run.at});
  }
}

// f(number of channels that need sums of their own, as a constant; those channels).
template <class F>
void PatchMatrix::forOwnChannels(std::span<const glm::dvec3> x, F&& f) const {
  const OwnChannels own = fewer_channels_ ? ownChannels(x) : OwnChannels();
  if (own.count <= 1) return f(std::integral_constant<std::size_t, 1>(), own);
  if (own.count == 2) return f(std::integral_constant<std::size_t, 2>(), own);
  f(std::integral_constant<std::size_t, 3>(), own);
}

void PatchMatrix::product(std::span<const glm::dvec3> x, std::span<glm::dvec3> out) const {
  forOwnChannels(x, [&](auto count_of, const OwnChannels& own) {
    constexpr std::size_t kCount = decltype(count_of)::value;
    std::array<std::vector<double>, kCount> sums;
    sums.fill(std::vector<double>(out.size(), 0.0));
    for (std::uint32_t q = 0; q < columns_.size(); ++q) {
      std::array<double, kCount> sent;
      for (std::size_t c = 0; c < kCount; ++c) sent[c] = x[q][own.own[c]];
      if (sent == std::array<double, kCount>{}) continue;
      forEachRun(q, [&](std::uint32_t first, const float* values, std::size_t count) {
        std::array<double*, kCount> sum;
        for (std::size_t c = 0; c < kCount; ++c) sum[c] = &sums[c][first];
        for (std::size_t k = 0; k < count; ++k) {
          const double value = values[k];
          for (std::size_t c = 0; c < kCount; ++c) sum[c][k] += value * sent[c];
        }
      });
    }
    std::array<double, 3> of_patch{};
    for (std::size_t p = 0; p < out.size(); ++p) {
      for (std::size_t c = 0; c < kCount; ++c) of_patch[c] = sums[c][p];
      out[p] = own.colour(of_patch);
    }
  });
}

glm::dvec3 PatchMatrix::transposed(std::uint32_t q, std::span<const glm::dvec3> x) const {
  glm::dvec3 sum(0.0);
  forEachRun(q, [&](std::uint32_t first, const float* values, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
      sum += area_[first + k] * static_cast<double>(values[k]) * x[first + k];
  });
  return sum / area_[q];
}

void PatchMatrix::transposed(std::span<const glm::dvec3> x, std::span<glm::dvec3> out) const {
  forOwnChannels(x, [&](auto count_of, const OwnChannels& own) {
    constexpr std::size_t kCount = decltype(count_of)::value;
    std::array<std::vector<double>, kCount> weighted;
    for (std::size_t c = 0; c < kCount; ++c) {
      weighted[c].reserve(x.size());
      for (std::size_t p = 0; p < x.size(); ++p) weighted[c].push_back(area_[p] * x[p][own.own[c]]);
    }
    for (std::uint32_t q = 0; q < columns_.size(); ++q) {
      std::array<double, 3> sum{};
      forEachRun(q, [&](std::uint32_t first, const float* values, std::size_t count) {
        for (std::size_t c = 0; c < kCount; ++c) sum[c] += dotOf(values, &weighted[c][first], count);
      });
      for (double& s : sum) s /= area_[q];
      out[q] = own.colour(sum);
    }
  });
}

double PatchMatrix::exchange(std::uint32_t p, std::uint32_t q) const {
  const PatchColumn& column = columns_[q];
  const auto next = std::upper_bound(column.runs.begin(), column.runs.end(), p,
                                     [](std::uint32_t patch, const Run& run) { return patch < run.patch; });
  if (next == column.runs.begin() || next == column.runs.end()) return 0;
  const std::uint32_t at = (next - 1)->at + (p - (next - 1)->patch);
  return at < next->at ? area_[p] * static_cast<double>(column.values[at]) : 0.0;
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
    forEachRun(q, [&](std::uint32_t first, const float* values, std::size_t count) {
      for (std::size_t k = 0; k < count; ++k) {
        const auto p = static_cast<std::uint32_t>(first + k);
        if (values[k] == 0 || !known_[p] || p == q) continue;
        const double there = area_[p] * static_cast<double>(values[k]), back = exchange(q, p);
        // Where nothing comes back the pair would not be met from the other side.
        const double weight = back == 0 ? 2 : 1;
        difference += weight * (there - back) * (there - back);
        size += weight * (there * there + back * back);
      }
    });
  }
  if (area > 0) out.closure = std::sqrt(lost / area);
  if (size > 0) out.reciprocity = std::sqrt(difference / size);
  return out;
}

}  // namespace unshot
