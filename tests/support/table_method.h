// Form factors from a table, so that the solver can be tested without geometry and without OpenGL.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "formfactor/method.h"
#include "formfactor/transport.h"
#include "support/dense.h"
#include "support/dice.h"

namespace unshot::testing_support {

/// Counts of calls, shared with the test, since Transport owns the method.
struct Calls {
  int columns = 0, rows = 0;
};

/// K as given, rounded to float. `escape_share` of what K does not account for counts as escaped, the rest as
/// defect.
class TableMethod final : public FormFactorMethod {
 public:
  TableMethod(DenseMatrix k, Receivers receivers, std::vector<double> patch_area,
              std::shared_ptr<Calls> calls, double escape_share = 0.5)
      : k_(std::move(k)),
        receivers_(std::move(receivers)),
        patch_area_(std::move(patch_area)),
        calls_(std::move(calls)),
        escape_share_(escape_share) {}

  ReceiverKind receiverKind() const override { return receivers_.kind; }

  Column column(std::uint32_t q) override {
    ++calls_->columns;
    Column out;
    double sum = 0;
    for (std::uint32_t v = 0; v < k_.size(); ++v) {
      if (k_[v][q] == 0) continue;
      out.receiver.push_back(v);
      out.k.push_back(static_cast<float>(k_[v][q]));
      sum += static_cast<double>(out.k.back()) * receivers_.area[v] / patch_area_[q];
    }
    out.escape = escape_share_ * (1 - sum);
    out.defect = 1 - sum - out.escape;
    return out;
  }

  Row row(std::uint32_t v) override {
    ++calls_->rows;
    Row out;
    out.escape = 1;
    for (std::uint32_t q = 0; q < patch_area_.size(); ++q) {
      if (k_[v][q] == 0) continue;
      out.source.push_back(q);
      out.k.push_back(static_cast<float>(k_[v][q]));
      out.escape -= k_[v][q];
    }
    return out;
  }

 private:
  DenseMatrix k_;
  Receivers receivers_;
  std::vector<double> patch_area_;
  std::shared_ptr<Calls> calls_;
  double escape_share_;
};

/// A made-up system: K in double, but exactly representable as float.
struct TableSystem {
  DenseMatrix k;  ///< receivers x patches
  Receivers receivers;
  std::vector<double> patch_area;
  std::vector<glm::dvec3> emission, reflectance;  ///< one per patch
  std::shared_ptr<Calls> calls = std::make_shared<Calls>();

  Transport transport(std::size_t kept_bytes = std::size_t{1} << 24) const {
    return Transport(std::make_unique<TableMethod>(k, receivers, patch_area, calls), receivers, patch_area,
                     kept_bytes);
  }
  /// M = R rho K of one channel, patches x patches.
  DenseMatrix transportMatrix(int channel) const {
    const std::size_t n = patch_area.size();
    DenseMatrix m(n, std::vector<double>(n, 0.0));
    for (const PatchShare& s : receivers.shares) {
      for (std::size_t q = 0; q < n; ++q) {
        m[s.patch][q] += s.area / patch_area[s.patch] * reflectance[s.patch][channel] * k[s.receiver][q];
      }
    }
    return m;
  }
  /// S of (I - M) S = E, one channel.
  std::vector<double> solution(int channel) const {
    DenseMatrix a = transportMatrix(channel);
    std::vector<double> e;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (double& x : a[i]) x = -x;
      a[i][i] += 1;
      e.push_back(emission[i][channel]);
    }
    return solveDense(a, e);
  }
};

/// `patches` patches, each of `per_patch` receivers of its own and, where `shared`, one more that it shares
/// with the next patch. K >= 0 is random and not reciprocal; each row sums to `row_sum` (in 4096ths, so that
/// floats hold it exactly). A patch does not see itself. rho and E are random unless given.
inline TableSystem randomSystem(std::uint64_t seed, std::uint32_t patches, std::uint32_t per_patch,
                                bool shared, double row_sum) {
  Dice dice(seed);
  TableSystem out;
  out.receivers.kind = shared ? ReceiverKind::kVertices : ReceiverKind::kElements;
  out.patch_area.assign(patches, 0.0);
  const auto colour = [&](double low, double high) {
    const double r = dice.between(low, high), g = dice.between(low, high), b = dice.between(low, high);
    return glm::dvec3(r, g, b);
  };
  for (std::uint32_t q = 0; q < patches; ++q) {
    out.reflectance.push_back(colour(0.1, 0.9));
    out.emission.push_back(q % 3 == 0 ? colour(0, 5) : glm::dvec3(0.0));
  }
  const auto addReceiver = [&](std::vector<std::uint32_t> of) {
    const auto v = static_cast<std::uint32_t>(out.receivers.area.size());
    glm::dvec3 reflected(0.0);
    double area = 0;
    for (const std::uint32_t q : of) {
      const double share = dice.between(0.5, 2);
      out.receivers.shares.push_back({q, v, share});
      out.patch_area[q] += share;
      reflected += share * out.reflectance[q];
      area += share;
    }
    out.receivers.start.push_back(static_cast<std::uint32_t>(out.receivers.shares.size()));
    out.receivers.area.push_back(area);
    out.receivers.reflectance.push_back(reflected / area);
    std::vector<double> weight(patches, 0.0);
    double sum = 0;
    for (std::uint32_t q = 0; q < patches; ++q) {
      const bool own = q == of.front() || q == of.back();
      weight[q] = own || dice.uniform() < 0.3 ? 0.0 : dice.uniform();
      sum += weight[q];
    }
    double left = std::floor(row_sum * 4096);
    std::uint32_t last = patches;
    for (std::uint32_t q = 0; q < patches; ++q) {
      if (weight[q] == 0) continue;
      weight[q] = std::floor(row_sum * 4096 * weight[q] / sum);
      left -= weight[q];
      last = q;
    }
    if (last < patches) weight[last] += left;
    for (double& w : weight) w /= 4096;
    out.k.push_back(std::move(weight));
  };
  for (std::uint32_t q = 0; q < patches; ++q) {
    for (std::uint32_t k = 0; k < per_patch; ++k) addReceiver({q});
    if (shared) addReceiver({q, (q + 1) % patches});
  }
  return out;
}

/// The same with pairs that are reciprocal, A_p (R K)_pq = A_q (R K)_qp (to float rounding); all receivers of
/// a patch see the same. `system` is not shared.
inline TableSystem reciprocal(TableSystem system) {
  const std::size_t n = system.patch_area.size();
  double least_area = system.patch_area[0];
  for (const double a : system.patch_area) least_area = std::min(least_area, a);
  const DenseMatrix given = system.k;
  const auto pair = [&](std::size_t p, std::size_t q) {
    double sum = 0;
    for (const PatchShare& s : system.receivers.shares) {
      if (s.patch == p) sum += given[s.receiver][q];
      if (s.patch == q) sum += given[s.receiver][p];
    }
    return sum;
  };
  const double per_patch = static_cast<double>(system.receivers.size()) / static_cast<double>(n);
  for (const PatchShare& s : system.receivers.shares) {
    // Rows of `given` sum to 1 at most, columns to less than 3; a quarter keeps the new rows below 1.
    for (std::size_t q = 0; q < n; ++q) {
      const double w = pair(s.patch, q) * least_area / (4 * per_patch * system.patch_area[s.patch]);
      system.k[s.receiver][q] = static_cast<double>(static_cast<float>(w));
    }
  }
  return system;
}

}  // namespace unshot::testing_support
