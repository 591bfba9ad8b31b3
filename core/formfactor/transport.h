// Light transport as the solver sees it: columns, rows and products of K, whatever computes them; what was
// computed is kept within a budget and computed again where it does not fit.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "formfactor/method.h"

namespace unshot {

class Transport {
 public:
  /// `receivers` are those of the method's kind on the method's mesh; `patch_area` one per patch [m^2].
  Transport(std::unique_ptr<FormFactorMethod> method, Receivers receivers, std::vector<double> patch_area,
            std::size_t kept_bytes);

  std::size_t patchCount() const { return patch_area_.size(); }
  std::size_t receiverCount() const { return receivers_.size(); }
  const Receivers& receivers() const { return receivers_; }
  const std::vector<double>& patchArea() const { return patch_area_; }

  /// Column q; valid until the next call. The last one asked for is always at hand.
  const Column& column(std::uint32_t q);
  Row row(std::uint32_t v);
  /// out = K d, channel by channel. `d` one per patch, `out` one per receiver.
  void product(std::span<const glm::dvec3> d, std::span<glm::dvec3> out);

  std::uint64_t computed() const { return computed_; }  ///< columns and rows that were not at hand
  std::uint64_t drawn() const { return method_->drawn(); }
  std::size_t keptBytes() const { return kept_bytes_; }
  std::size_t keptColumns() const { return kept_count_; }

 private:
  std::unique_ptr<FormFactorMethod> method_;
  Receivers receivers_;
  std::vector<double> patch_area_;
  std::size_t budget_;
  std::size_t kept_bytes_ = 0, kept_count_ = 0;
  std::vector<std::unique_ptr<Column>> kept_;
  Column passing_;  // the last column that found no room
  std::uint32_t passing_patch_ = kNone;
  std::uint64_t computed_ = 0;
};

}  // namespace unshot
