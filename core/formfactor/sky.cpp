#include "formfactor/sky.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/cosine_direction.h"
#include "base/random.h"
#include "mesh/element_points.h"
#include "mesh/mesh_rays.h"

namespace unshot {
namespace {

// Strata along each side of the grid: as many as come to so many rays for all receivers, within limits.
constexpr double kRays = 500'000;
constexpr int kFewestStrata = 8, kMostStrata = 24;
// A stratum that is looked at again: rays along each side of it.
constexpr int kParts = 4;

class SkyLooks {
 public:
  SkyLooks(const Mesh& mesh, const Receivers& receivers, std::uint64_t seed)
      : mesh_(mesh), receivers_(receivers), rays_(mesh), state_(mixBits(seed ^ 0x736b79ull)) {
    const Range range = receivers.reachedBy(false);
    strata_ = std::clamp(static_cast<int>(std::sqrt(kRays / std::max(1u, range.count))), kFewestStrata,
                         kMostStrata);
    open_.resize(static_cast<std::size_t>(strata_ * strata_));
    if (receivers.kind == ReceiverKind::kElements) points_.emplace(mesh);
  }

  double seenBy(std::uint32_t v) {
    if (receivers_.kind == ReceiverKind::kElements) {
      if (points_->empty(v)) return 0;
      const glm::dvec3& normal = mesh_.sides[mesh_.element_side[v]].normal;
      return share(normal, [&] { return points_->at(v, [&] { return draw(); }); });
    }
    double sum = 0;
    for (const ReceiverView& view : receivers_.viewsOf(v))
      sum += view.weight * share(view.normal, [&] { return view.position; });
    return sum;
  }

 private:
  double draw() { return unitInterval(state_ = mixBits(state_)); }

  template <class Position>
  double share(const glm::dvec3& normal, Position&& position) {
    // Of stratum (i, j), the part of `parts` by `parts`.
    const auto isOpen = [&](int i, int j, int part, int parts) {
      const double u = (i + (part / parts + draw()) / parts) / strata_;
      const double v = (j + (part % parts + draw()) / parts) / strata_;
      return !rays_.rays().meetsAny(rays_.rays().lifted(position(), normal), cosineDirection(normal, u, v));
    };
    for (int i = 0; i < strata_; ++i) {
      for (int j = 0; j < strata_; ++j) at(i, j) = isOpen(i, j, 0, 1);
    }
    double sum = 0;
    for (int i = 0; i < strata_; ++i) {
      for (int j = 0; j < strata_; ++j) {
        const char here = at(i, j);
        const bool alike = at(std::max(i - 1, 0), j) == here && at(std::min(i + 1, strata_ - 1), j) == here &&
                           at(i, (j + 1) % strata_) == here && at(i, (j + strata_ - 1) % strata_) == here;
        if (alike) {
          sum += here;
          continue;
        }
        int open = 0;
        for (int part = 0; part < kParts * kParts; ++part) open += isOpen(i, j, part, kParts);
        sum += open / double{kParts * kParts};
      }
    }
    return sum / (strata_ * strata_);
  }

  char& at(int i, int j) { return open_[static_cast<std::size_t>(i * strata_ + j)]; }

  const Mesh& mesh_;
  const Receivers& receivers_;
  MeshRays rays_;
  std::uint64_t state_;
  int strata_ = kFewestStrata;
  std::vector<char> open_;  // a stratum's ray meets nothing; by distance from the normal, then around it
  std::optional<ElementPoints> points_;  // where receivers are elements
};

class WithSky final : public FormFactorMethod {
 public:
  WithSky(std::unique_ptr<FormFactorMethod> method, std::uint32_t patches, Column sky)
      : method_(std::move(method)), patches_(patches), sky_(std::move(sky)) {}

  ReceiverKind receiverKind() const override { return method_->receiverKind(); }
  Column column(std::uint32_t q) override { return q == patches_ ? sky_ : method_->column(q); }
  Column draft(std::uint32_t q, ColumnQuality wanted) override {
    return q == patches_ ? sky_ : method_->draft(q, wanted);
  }
  Row row(std::uint32_t v) override {
    Row out = method_->row(v);
    if (v < sky_.first || v - sky_.first >= sky_.k.size()) return out;
    out.source.push_back(patches_);
    out.k.push_back(sky_.k[v - sky_.first]);
    out.escape -= static_cast<double>(out.k.back());
    return out;
  }
  std::uint64_t drawn() const override { return method_->drawn(); }
  std::string note() const override { return method_->note(); }

 private:
  std::unique_ptr<FormFactorMethod> method_;
  std::uint32_t patches_;
  Column sky_;
};

}  // namespace

SkySource lookAtSky(const Mesh& mesh, const Receivers& receivers, std::uint64_t seed,
                    const CancelToken& cancel) {
  SkySource out;
  SkyLooks looks(mesh, receivers, seed);
  const Range range = receivers.reachedBy(false);
  out.column.first = range.first;
  for (std::uint32_t v = range.first; v < range.end(); ++v) {
    cancel.check();
    const auto k = static_cast<float>(looks.seenBy(v));
    out.column.k.push_back(k);
    out.area += receivers.area[v] * static_cast<double>(k);
  }
  return out;
}

std::unique_ptr<FormFactorMethod> withSky(std::unique_ptr<FormFactorMethod> method, std::uint32_t patches,
                                          Column sky) {
  return std::make_unique<WithSky>(std::move(method), patches, std::move(sky));
}

}  // namespace unshot
