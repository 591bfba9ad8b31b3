// Light transport as the solver sees it: columns, rows and products of K, whatever computes them; what was
// computed is kept within a budget and computed again where it does not fit.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "formfactor/closure.h"
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
  /// Whether column q is kept, so that asking for it costs nothing.
  bool isKept(std::uint32_t q) const { return kept_[q] != nullptr; }
  /// Column q where it is kept, else null.
  const Column* kept(std::uint32_t q) const { return kept_[q].get(); }
  /// Takes column q as it was computed before, in the place of computing it, and tells the watcher of it;
  /// false where there is no room. For columns that were not asked for yet.
  bool restore(std::uint32_t q, Column column);
  /// Gives column q away, for restore() of another transport, where `opened` as it was before closure(); none
  /// where it is not kept.
  std::optional<Column> take(std::uint32_t q, bool opened);
  /// Gives the memory of all kept columns back; they are computed again as they are asked for.
  void release();
  /// Column q, not asked for yet, is to be of this quality, drafts allowed or not.
  void expect(std::uint32_t q, ColumnQuality quality) { expected_[q] = quality; }
  bool draftsAllowed() const { return drafts_allowed_; }
  /// Called with each column as it is computed for the first time or in better quality.
  void watchColumns(std::function<void(std::uint32_t, const Column&)> watcher) {
    watcher_ = std::move(watcher);
  }
  /// Whether columns not yet at hand are drafts where the method has them (FormFactorMethod::draft); at first
  /// not.
  void allowDrafts(bool allowed) { drafts_allowed_ = allowed; }
  /// Of column q as used so far; none where it was not.
  std::optional<ColumnQuality> quality(std::uint32_t q) const { return quality_[q]; }
  bool isDraft(std::uint32_t q) const { return quality_[q] && *quality_[q] != ColumnQuality::kFull; }
  /// Columns in use of this quality.
  std::size_t count(ColumnQuality quality) const { return counts_[static_cast<std::size_t>(quality)]; }
  std::size_t draftCount() const { return count(ColumnQuality::kGroup) + count(ColumnQuality::kOnePoint); }
  std::uint64_t refined() const { return refined_; }  ///< drafts that became full columns so far
  /// Columns that gave way to better ones so far: K is the same as long as this is.
  std::uint64_t replaced() const { return replaced_; }
  /// Replaces the draft of q by the next better column: first = before, second = from now on.
  std::pair<Column, const Column&> refine(std::uint32_t q);
  /// From now on each value of K is scaled by its row's factor, in columns at hand and in those to come, and
  /// the watcher is told of the former.
  void setClosure(RowClosure closure);
  /// The same for columns that were scaled before they are restored: from now on alone.
  void restoreClosure(RowClosure closure) { closure_ = std::move(closure); }
  /// Empty scale: there is none.
  const RowClosure& closure() const { return closure_; }
  Row row(std::uint32_t v);
  /// out = K d, channel by channel. `d` one per patch, `out` one per receiver.
  void product(std::span<const glm::dvec3> d, std::span<glm::dvec3> out);

  std::uint64_t computed() const { return computed_; }  ///< columns and rows that were not at hand
  std::uint64_t drawn() const { return method_->drawn(); }
  std::size_t keptBytes() const { return kept_bytes_; }
  std::size_t keptColumns() const { return kept_count_; }
  /// Whether a column found no room: what all of them would take, from those that did [bytes]; 0 before that.
  std::size_t missingRoom() const { return missing_room_; }

 private:
  Column compute(std::uint32_t q);
  Column compute(std::uint32_t q, ColumnQuality wanted);
  const Column& keep(std::uint32_t q, Column column);
  void setQuality(std::uint32_t q, const Column& column);
  template <class Factor>
  void scale(std::uint32_t q, Column& column, Factor&& factor) const;
  void close(std::uint32_t q, Column& column) const;

  std::unique_ptr<FormFactorMethod> method_;
  Receivers receivers_;
  std::vector<double> patch_area_;
  std::size_t budget_;
  std::size_t kept_bytes_ = 0, kept_count_ = 0, missing_room_ = 0;
  std::vector<std::unique_ptr<Column>> kept_;
  Column passing_;  // the last column that found no room
  std::uint32_t passing_patch_ = kNone;
  std::uint64_t computed_ = 0, refined_ = 0, replaced_ = 0;
  std::vector<std::optional<ColumnQuality>> quality_;   // of the columns used so far
  std::vector<std::optional<ColumnQuality>> expected_;  // of others, where that is decided
  std::array<std::size_t, 3> counts_{};                 // by quality
  RowClosure closure_;
  bool drafts_allowed_ = false;
  std::function<void(std::uint32_t, const Column&)> watcher_;
};

}  // namespace unshot
