#include "formfactor/transport.h"

#include <algorithm>

namespace unshot {

Transport::Transport(std::unique_ptr<FormFactorMethod> method, Receivers receivers,
                     std::vector<double> patch_area, std::size_t kept_bytes)
    : method_(std::move(method)),
      receivers_(std::move(receivers)),
      patch_area_(std::move(patch_area)),
      budget_(kept_bytes),
      kept_(patch_area_.size()) {}

const Column& Transport::column(std::uint32_t q) {
  if (kept_[q]) return *kept_[q];
  if (q == passing_patch_) return passing_;
  ++computed_;
  Column fresh = method_->column(q);
  // The first columns asked for are the brightest patches: they are asked for most often, so none gives way
  // to a later one.
  if (kept_bytes_ + fresh.bytes() <= budget_) {
    kept_bytes_ += fresh.bytes();
    ++kept_count_;
    kept_[q] = std::make_unique<Column>(std::move(fresh));
    return *kept_[q];
  }
  passing_ = std::move(fresh);
  passing_patch_ = q;
  return passing_;
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
