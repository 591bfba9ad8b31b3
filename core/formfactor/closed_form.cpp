// Closed-form factors: K_vq is the exact Lambert factor of receiver point v and patch q, without occlusion.
//
// In a convex enclosure rows then sum to 1 to rounding wherever the receiver stands. Assumes that nothing
// lies between (methods.h says how that is decided); known error: none in K but rounding, so what is left of
// a solution's error comes from the patches' constant radiosity and the trapezoidal mean over a patch's
// vertices.
#include <algorithm>
#include <glm/geometric.hpp>

#include "formfactor/methods.h"
#include "formfactor/polygon_factor.h"
#include "formfactor/regions.h"

namespace unshot {
namespace {

class ClosedForm final : public FormFactorMethod {
 public:
  explicit ClosedForm(const FormFactorSetup& setup)
      : mesh_(*setup.mesh), receivers_(makeReceivers(mesh_, ReceiverKind::kVertices, setup.cancel)) {
    polygons_.resize(mesh_.patch_count);
    for (std::uint32_t q = 0; q < mesh_.patch_count; ++q) {
      setup.cancel.check();
      collectPolygons(q);
    }
  }

  ReceiverKind receiverKind() const override { return ReceiverKind::kVertices; }

  Column column(std::uint32_t q) override {
    Column out;
    out.k.resize(receivers_.size());
    double received = 0;
    for (std::uint32_t v = 0; v < receivers_.size(); ++v) {
      out.k[v] = static_cast<float>(factor(v, q));
      received += static_cast<double>(out.k[v]) * receivers_.area[v];
    }
    // What leaves is found by gathering back along the rows of the patch's own receivers, so that the error
    // of the mean over vertices shows as the column's defect and not as light that escapes.
    out.escape = escapeOf(q);
    out.defect = 1 - out.escape - received / mesh_.patch_area[q];
    return out;
  }

  Row row(std::uint32_t v) override {
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

 private:
  using Ring = std::vector<glm::dvec3>;

  // A whole rectangle where the patch is one, else the pieces of its elements.
  void collectPolygons(std::uint32_t q) {
    const Side& side = mesh_.sides[mesh_.patch_side[q]];
    const Surface& surface = mesh_.surfaces[side.surface];
    const std::uint32_t local = q - side.first_patch;
    const Region region = regionOfPatch(mesh_, side.surface, local);
    const glm::dvec2 size = region.high - region.low;
    const auto add = [&](Ring ring) {
      if (side.back) std::reverse(ring.begin(), ring.end());
      polygons_[q].push_back(std::move(ring));
    };
    const double rectangle = size.x * size.y;
    if (std::abs(region.area - rectangle) <= 1e-9 * rectangle &&
        std::abs(mesh_.patch_area[q] - rectangle) <= 1e-9 * rectangle) {
      add({surface.point(region.low), surface.point({region.high.x, region.low.y}),
           surface.point(region.high), surface.point({region.low.x, region.high.y})});
      return;
    }
    for (std::uint32_t c = surface.first_cell; c < surface.first_cell + surface.nu * surface.nv; ++c) {
      const Range pieces = mesh_.cells[c].pieces;
      for (std::uint32_t p = pieces.first; p < pieces.end(); ++p) {
        if (mesh_.shapes[surface.elements.first + mesh_.pieces[p].element].patch != local) continue;
        Ring ring;
        const Range corners = mesh_.pieces[p].corners;
        for (std::uint32_t k = corners.first; k < corners.end(); ++k)
          ring.push_back(surface.point(mesh_.piece_corners[k].uv));
        add(std::move(ring));
      }
    }
  }

  double factor(std::uint32_t v, std::uint32_t q) {
    const Side& side = mesh_.sides[mesh_.patch_side[q]];
    const glm::dvec3& point = receivers_.position[v];
    if (side.surface == mesh_.sides[mesh_.vertices[v].side].surface) return 0;
    if (glm::dot(side.normal, point - mesh_.surfaces[side.surface].origin) <= 0) return 0;
    double sum = 0;
    for (const Ring& ring : polygons_[q])
      sum += pointToPolygonFactor(point, receivers_.normal[v], ring, scratch_);
    return std::max(sum, 0.0);
  }

  double escapeOf(std::uint32_t q) {
    if (share_start_.empty()) groupShares();
    if (row_escape_.empty()) row_escape_.assign(receivers_.size(), -1.0);
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

  void groupShares() {
    by_patch_ = receivers_.shares;
    std::stable_sort(by_patch_.begin(), by_patch_.end(),
                     [](const auto& a, const auto& b) { return a.patch < b.patch; });
    share_start_.assign(mesh_.patch_count + 1, 0);
    for (const PatchShare& s : by_patch_) ++share_start_[s.patch + 1];
    for (std::uint32_t q = 0; q < mesh_.patch_count; ++q) share_start_[q + 1] += share_start_[q];
  }

  const Mesh& mesh_;
  Receivers receivers_;
  std::vector<std::vector<Ring>> polygons_;  // per patch
  std::vector<glm::dvec3> scratch_;
  std::vector<PatchShare> by_patch_;
  std::vector<std::uint32_t> share_start_;
  std::vector<double> row_escape_;  // per receiver; below 0: not known yet
};

}  // namespace

std::unique_ptr<FormFactorMethod> makeClosedForm(const FormFactorSetup& setup) {
  return std::make_unique<ClosedForm>(setup);
}

}  // namespace unshot
