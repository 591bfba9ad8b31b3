// P = R K among patches, as far as columns of K are known: what error bounds and estimates are worked out
// with, beside the solution and a good deal cheaper than with K itself.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "formfactor/transport.h"

namespace unshot {

/// How far form factors break the laws that exact ones keep, RMS over known columns. Exact for no light: half
/// of an error may keep both.
struct FormFactorDefects {
  /// Of what a patch sends, lost or gained: 1 - sum_p F_qp - escaped, area-weighted; none without a column.
  std::optional<double> closure;
  /// Of A_q F_qp against A_p F_pq, over their size: the relative error of one of them where both err
  /// independently; none where no two columns see each other.
  std::optional<double> reciprocity;
  std::size_t columns = 0;  ///< known
};

class PatchMatrix {
 public:
  /// `budget`: bytes that columns may take together; those beyond it stay unknown.
  PatchMatrix(const Receivers& receivers, std::span<const double> area, std::size_t budget);

  /// Column q of K, new or better than before.
  void set(std::uint32_t q, const Column& column);
  bool knows(std::uint32_t q) const { return known_[q] != 0; }
  /// Whether light of a known column arrives at patch p.
  bool reaches(std::uint32_t p) const { return reached_[p] != 0; }
  std::size_t size() const { return known_.size(); }
  std::size_t knownCount() const { return known_count_; }
  std::size_t bytes() const { return bytes_; }
  /// Those that a product goes through: with some zeros between others.
  std::size_t entryCount() const { return entry_count_; }
  /// One more at each set().
  std::uint64_t version() const { return version_; }
  /// The largest share of its light that a known patch sends to others: 1 but for approximation.
  double largestSent() const { return largest_sent_; }
  /// The same but for a few patches of a hundredth of the known area together: in narrow places the sum over
  /// receivers may be far off. At least 1.
  double usuallySent() const;

  /// Products may leave out channels of x that are 0, and take those that are in proportion to another one
  /// from it: the same to rounding, and where they are equal to the last bit.
  void allowFewerChannels(bool allowed) { fewer_channels_ = allowed; }

  /// out_p = sum_q P_pq x_q over known columns.
  void product(std::span<const glm::dvec3> x, std::span<glm::dvec3> out) const;
  /// out_q = sum_p A_p P_pq x_p / A_q: the mean of x where patch q's light arrives; 0 for unknown columns.
  void transposed(std::span<const glm::dvec3> x, std::span<glm::dvec3> out) const;
  /// The same for one known patch.
  glm::dvec3 transposed(std::uint32_t q, std::span<const glm::dvec3> x) const;
  double area(std::uint32_t q) const { return area_[q]; }
  /// Closure of all known columns, reciprocity of some of them against all.
  FormFactorDefects defects() const;

 private:
  // P_pq of one q: entries in runs of patches that follow each other, 0 where a short gap is bridged. Run r
  // is of the patches from runs[r].patch on and has the values from runs[r].at to runs[r + 1].at, a last run
  // without values.
  struct Run {
    std::uint32_t patch, at;
  };
  struct PatchColumn {
    std::vector<Run> runs;
    std::vector<float> values;
    std::size_t bytes() const { return runs.capacity() * sizeof(Run) + values.capacity() * sizeof(float); }
  };
  // f(patch, values, number) for each run of column q.
  template <class F>
  void forEachRun(std::uint32_t q, F&& f) const;
  template <class F>
  void forOwnChannels(std::span<const glm::dvec3> x, F&& f) const;
  void putInOrder();
  void store(PatchColumn& out, std::uint32_t q);
  /// A_p P_pq of known column q [m^2].
  double exchange(std::uint32_t p, std::uint32_t q) const;

  const Receivers& receivers_;
  std::span<const double> area_;
  std::size_t budget_, bytes_ = 0, entry_count_ = 0, known_count_ = 0;
  std::uint64_t version_ = 0;
  bool fewer_channels_ = false;
  double largest_sent_ = 1;
  std::vector<PatchColumn> columns_;
  std::vector<char> known_, reached_;
  std::vector<double> closure_;  // what a known column lacks
  std::vector<double> sent_;     // by it to others
  std::vector<double> sum_;
  std::vector<std::uint32_t> touched_;
};

}  // namespace unshot
