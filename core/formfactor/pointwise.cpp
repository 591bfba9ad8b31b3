#include "formfactor/pointwise.h"

#include <algorithm>

namespace unshot {

Pointwise::Pointwise(const FormFactorSetup& setup, std::shared_ptr<const PatchPolygons> polygons,
                     std::unique_ptr<Visibility> visibility)
    : mesh_(*setup.mesh),
      polygons_(std::move(polygons)),
      visibility_(std::move(visibility)),
      receivers_(setup.receivers ? setup.receivers
                                 : std::make_shared<const Receivers>(
                                       makeReceivers(*setup.mesh, ReceiverKind::kVertices, setup.cancel))) {}

double Pointwise::factor(std::uint32_t v, std::uint32_t q) {
  double sum = 0;
  for (const ReceiverView& view : receivers_->viewsOf(v)) sum += view.weight * factor(view, q);
  return sum;
}

double Pointwise::factor(const ReceiverView& from, std::uint32_t q) {
  if (mesh_.sides[from.side].surface == polygons_->surface(q)) return 0;
  // Without occlusion the factors are exact; beside what shadow rays leave open the rest does not show.
  if (!visibility_) return polygons_->factor(q, from.position, from.normal, scratch_);
  const double lambert = mesh_.emits(q) ? polygons_->factor(q, from.position, from.normal, scratch_)
                                        : polygons_->quickFactor(q, from.position, from.normal, scratch_);
  return lambert == 0 ? 0 : lambert * visibility_->seen(from, q);
}

Column Pointwise::column(std::uint32_t q) {
  Column out;
  const Range reached = receivers_->reachedBy(mesh_.emits(q));
  out.first = reached.first;
  out.k.reserve(reached.count);
  double received = 0;
  for (std::uint32_t v = reached.first; v < reached.end(); ++v) {
    out.k.push_back(static_cast<float>(factor(v, q)));
    received += static_cast<double>(out.k.back()) * receivers_->area[v];
  }
  out.escape = escapeOf(q);
  out.defect = 1 - out.escape - received / mesh_.patch_area[q];
  return out;
}

Row Pointwise::row(std::uint32_t v) {
  Row out;
  double sum = 0;
  for (std::uint32_t q = 0; q < mesh_.patch_count; ++q) {
    const double k = factor(v, q);
    if (k == 0) continue;
    out.source.push_back(q);
    out.k.push_back(static_cast<float>(k));
    sum += static_cast<double>(out.k.back());
  }
  out.escape = 1 - sum;
  return out;
}

double Pointwise::escapeOf(std::uint32_t q) {
  return visibility_ ? visibility_->escaping(q) : escapeAlongRows(q);
}

// What leaves is found by gathering back along the rows of the patch's own receivers, so that the error of
// the mean over vertices shows as the column's defect and not as light that escapes.
double Pointwise::escapeAlongRows(std::uint32_t q) {
  if (share_start_.empty()) groupShares();
  if (row_escape_.empty()) row_escape_.assign(receivers_->size(), -1.0);
  double sum = 0;
  for (std::uint32_t k = share_start_[q]; k < share_start_[q + 1]; ++k) {
    const PatchShare& share = by_patch_[k];
    double& escape = row_escape_[share.receiver];
    if (escape < 0) {
      double seen = 0;
      for (std::uint32_t p = 0; p < mesh_.patch_count; ++p) seen += factor(share.receiver, p);
      escape = std::max(1 - seen, 0.0);
    }
    sum += share.area * escape;
  }
  return sum / mesh_.patch_area[q];
}

void Pointwise::groupShares() {
  const auto first = static_cast<std::ptrdiff_t>(receivers_->start[receivers_->base_first]);
  by_patch_.assign(receivers_->shares.begin() + first, receivers_->shares.end());
  std::stable_sort(by_patch_.begin(), by_patch_.end(),
                   [](const auto& a, const auto& b) { return a.patch < b.patch; });
  share_start_.assign(mesh_.patch_count + 1, 0);
  for (const PatchShare& s : by_patch_) ++share_start_[s.patch + 1];
  for (std::uint32_t q = 0; q < mesh_.patch_count; ++q) share_start_[q + 1] += share_start_[q];
}

}  // namespace unshot
