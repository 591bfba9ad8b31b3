#include "formfactor/pointwise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "formfactor/emitter_share.h"

namespace unshot {
namespace {

// Receivers that are decided on together, by one thread; and so many of these parts are worth waking others.
constexpr std::uint32_t kPart = 512;
constexpr std::size_t kWorthSharing = 4;

}  // namespace

Pointwise::Pointwise(const FormFactorSetup& setup, std::shared_ptr<const PatchPolygons> polygons,
                     std::unique_ptr<Visibility> visibility)
    : mesh_(*setup.mesh),
      polygons_(std::move(polygons)),
      occludes_(visibility != nullptr),
      receivers_(setup.receivers ? setup.receivers
                                 : std::make_shared<const Receivers>(
                                       makeReceivers(*setup.mesh, ReceiverKind::kVertices, setup.cancel))) {
  hands_.emplace_back().visibility = std::move(visibility);
  for (unsigned k = 1; setup.workers && k < setup.workers->count(); ++k) {
    std::unique_ptr<Visibility> another = occludes_ ? hands_[0].visibility->another() : nullptr;
    if (occludes_ && !another) break;
    hands_.emplace_back().visibility = std::move(another);
  }
  if (setup.workers && hands_.size() == setup.workers->count()) workers_ = setup.workers;
  const EmitterShare share(mesh_);
  for (std::uint32_t q = 0; q < mesh_.patch_count; ++q)
    exact_.push_back(!occludes_ || share.isLarge(mesh_.sides[mesh_.patch_side[q]], mesh_.patch_area[q]));
}

double Pointwise::factor(std::uint32_t v, std::uint32_t q) {
  double sum = 0;
  for (const ReceiverView& view : receivers_->viewsOf(v)) {
    const double k = view.weight * lambert(view, q, hands_[0]);
    sum += k == 0 || !occludes_ ? k : k * hands_[0].visibility->seen(view, q);
  }
  return sum;
}

// The Lambert factor without occlusion.
double Pointwise::lambert(const ReceiverView& from, std::uint32_t q, Hand& hand) const {
  if (mesh_.sides[from.side].surface == polygons_->surface(q) || mesh_.inOtherRooms(from.side, q)) return 0;
  return exact_[q] ? polygons_->factor(q, from.position, from.normal, hand.scratch)
                   : polygons_->quickFactor(q, from.position, from.normal, hand.scratch);
}

// Adds to the sums of the receivers what the views see of the patch.
void Pointwise::decide(Looks& looks, std::uint32_t q, Hand& hand) {
  if (looks.count == 0) return;
  std::array<double, Looks::kMost> shares;
  hand.visibility->seenFrom({looks.views.data(), looks.count}, q, {shares.data(), looks.count});
  for (std::size_t k = 0; k < looks.count; ++k) sums_[looks.receivers[k]] += looks.unoccluded[k] * shares[k];
  looks.count = 0;
}

Column Pointwise::column(std::uint32_t q) {
  Column out;
  const Range reached = receivers_->reachedBy(mesh_.emits(q));
  out.first = reached.first;
  out.k.assign(reached.count, 0.0f);
  sums_.assign(reached.count, 0.0);
  // The same parts whoever does them, so that rays go together with the same others.
  const std::size_t parts = (std::size_t{reached.count} + kPart - 1) / kPart;
  const auto add = [&](std::size_t part, unsigned worker) {
    const auto first = static_cast<std::uint32_t>(part) * kPart;
    addSeen(q, {reached.first + first, std::min(kPart, reached.count - first)}, first, hands_[worker]);
  };
  if (workers_ && parts >= kWorthSharing) {
    workers_->run(parts, add);
  } else {
    for (std::size_t part = 0; part < parts; ++part) add(part, 0);
  }
  for (std::uint32_t n = 0; n < reached.count; ++n) out.k[n] = static_cast<float>(sums_[n]);
  double received = 0;
  for (std::uint32_t v = reached.first; v < reached.end(); ++v)
    received += static_cast<double>(out.k[v - out.first]) * receivers_->area[v];
  out.escape = escapeOf(q);
  out.defect = 1 - out.escape - received / mesh_.patch_area[q];
  return out;
}

// To the sums from number `first` on, of these receivers.
void Pointwise::addSeen(std::uint32_t q, const Range& receivers, std::uint32_t first, Hand& hand) {
  Looks looks;
  for (std::uint32_t n = 0; n < receivers.count; ++n) {
    for (const ReceiverView& view : receivers_->viewsOf(receivers.first + n)) {
      const double k = view.weight * lambert(view, q, hand);
      if (k == 0) continue;
      if (!occludes_) {
        sums_[first + n] += k;
        continue;
      }
      looks.views[looks.count] = &view;
      looks.receivers[looks.count] = first + n;
      looks.unoccluded[looks.count++] = k;
      if (looks.count == Looks::kMost) decide(looks, q, hand);
    }
  }
  decide(looks, q, hand);
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
  if (mesh_.closed) return 0;
  return occludes_ ? hands_[0].visibility->escaping(q) : escapeAlongRows(q);
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
