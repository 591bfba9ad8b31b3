#include "formfactor/transport.h"

#include <algorithm>
#include <utility>

namespace unshot {

Transport::Transport(std::unique_ptr<FormFactorMethod> method, Receivers receivers,
                     std::vector<double> patch_area, std::size_t kept_bytes)
    : method_(std::move(method)),
      receivers_(std::move(receivers)),
      patch_area_(std::move(patch_area)),
      budget_(kept_bytes),
      kept_(patch_area_.size()),
      quality_(patch_area_.size()),
      expected_(patch_area_.size()) {}

const Column& Transport::column(std::uint32_t q) {
  if (kept_[q]) return *kept_[q];
  if (q == passing_patch_) return passing_;
  return keep(q, compute(q));
}

// A column that found no room is computed again as it was used before.
Column Transport::compute(std::uint32_t q) {
  const ColumnQuality otherwise = drafts_allowed_ ? ColumnQuality::kGroup : ColumnQuality::kFull;
  return compute(q, quality_[q].value_or(expected_[q].value_or(otherwise)));
}

Column Transport::compute(std::uint32_t q, ColumnQuality wanted) {
  Column column = wanted == ColumnQuality::kFull ? method_->column(q) : method_->draft(q, wanted);
  if (!column.at_hand) ++computed_;
  if (!closure_.scale.empty()) close(q, column);
  setQuality(q, column);
  return column;
}

void Transport::setQuality(std::uint32_t q, const Column& column) {
  if (quality_[q] == column.quality) return;
  if (quality_[q]) --counts_[static_cast<std::size_t>(*quality_[q])];
  ++counts_[static_cast<std::size_t>(column.quality)];
  quality_[q] = column.quality;
  if (watcher_) watcher_(q, column);
}

bool Transport::restore(std::uint32_t q, Column column) {
  if (kept_bytes_ + column.bytes() > budget_) return false;
  setQuality(q, keep(q, std::move(column)));
  return true;
}

// The first columns asked for are the brightest patches: they are asked for most often, so none gives way to
// a later one.
const Column& Transport::keep(std::uint32_t q, Column column) {
  if (kept_bytes_ + column.bytes() <= budget_) {
    kept_bytes_ += column.bytes();
    ++kept_count_;
    kept_[q] = std::make_unique<Column>(std::move(column));
    return *kept_[q];
  }
  if (missing_room_ == 0) {
    const double each =
        static_cast<double>(kept_bytes_ + column.bytes()) / static_cast<double>(kept_count_ + 1);
    missing_room_ = static_cast<std::size_t>(each * static_cast<double>(patchCount()));
  }
  passing_ = std::move(column);
  passing_patch_ = q;
  return passing_;
}

void Transport::release() {
  for (std::unique_ptr<Column>& column : kept_) column.reset();
  kept_bytes_ = kept_count_ = 0;
}

std::pair<Column, const Column&> Transport::refine(std::uint32_t q) {
  Column draft = column(q);
  if (kept_[q]) {
    kept_bytes_ -= kept_[q]->bytes();
    --kept_count_;
    kept_[q].reset();
  }
  if (passing_patch_ == q) passing_patch_ = kNone;
  ++replaced_;
  const bool once = *quality_[q] == ColumnQuality::kGroup;
  const Column& better = keep(q, compute(q, once ? ColumnQuality::kOnePoint : ColumnQuality::kFull));
  if (better.quality == ColumnQuality::kFull) ++refined_;
  return {std::move(draft), better};
}

// What a column brings is no longer what it was: the difference is a defect.
template <class Factor>
void Transport::scale(std::uint32_t q, Column& column, Factor&& factor) const {
  if (closure_.exact[q]) return;
  double arrives = 0;
  for (std::size_t i = 0; i < column.k.size(); ++i) {
    const std::uint32_t v =
        column.receiver.empty() ? column.first + static_cast<std::uint32_t>(i) : column.receiver[i];
    column.k[i] *= factor(v);
    arrives += receivers_.area[v] * static_cast<double>(column.k[i]);
  }
  column.defect = 1 - column.escape - arrives / patch_area_[q];
}

void Transport::close(std::uint32_t q, Column& column) const {
  scale(q, column, [this](std::uint32_t v) { return closure_.scale[v]; });
}

std::optional<Column> Transport::take(std::uint32_t q, bool opened) {
  if (!kept_[q]) return std::nullopt;
  kept_bytes_ -= kept_[q]->bytes();
  --kept_count_;
  Column column = std::move(*std::exchange(kept_[q], nullptr));
  if (opened && !closure_.scale.empty())
    scale(q, column, [&](std::uint32_t v) { return closure_.scale[v] > 0 ? 1 / closure_.scale[v] : 1; });
  return column;
}

void Transport::setClosure(RowClosure closure) {
  closure_ = std::move(closure);
  ++replaced_;
  for (std::uint32_t q = 0; q < patchCount(); ++q) {
    if (!kept_[q]) continue;
    close(q, *kept_[q]);
    if (watcher_) watcher_(q, *kept_[q]);
  }
}

Row Transport::row(std::uint32_t v) {
  ++computed_;
  return method_->row(v);
}

void Transport::product(std::span<const glm::dvec3> d, std::span<glm::dvec3> out) {
  std::fill(out.begin(), out.end(), glm::dvec3(0.0));
  for (std::uint32_t q = 0; q < patchCount(); ++q) {
    if (d[q] == glm::dvec3(0.0)) continue;
    column(q).forEach([&](std::uint32_t v, double k) { out[v] += k * d[q]; });
  }
}

}  // namespace unshot
