#include "session/gap_refinement.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "mesh/mesh_rays.h"
#include "mesh/refine.h"

namespace unshot {
namespace {

// Cells may be so many gaps wide; where that makes too many, twice as wide, and so on.
constexpr double kGaps = 2.5;
constexpr double kMostTimes = 2;
constexpr int kMostAttempts = 6;
// Walls face each other where the angle between them is less than 60 degrees.
constexpr double kFacing = 0.5;
// Points look from this share of the way to the centre of a piece off its corners.
constexpr double kInset = 0.1;

class GapQuestion {
 public:
  GapQuestion(const Mesh& base, const CancelToken& cancel) : base_(base), cancel_(cancel), rays_(base) {}

  void restart(double gaps) {
    gaps_ = gaps;
    elements_ = base_.element_count;
  }

  bool operator()(const CellPart& part) {
    cancel_.check();
    if (full()) return false;
    const Surface& surface = base_.surfaces[part.surface];
    const glm::dvec2 size = part.high - part.low;
    const double gap = std::max(size.x, size.y) / gaps_;
    bool split = false;
    for (const std::uint32_t side : surface.side)
      split = split || (side != kNone && isNearLamp(part, surface, side, gap));
    if (split) elements_ += 3 * ((surface.side[0] != kNone) + (surface.side[1] != kNone));
    return split;
  }

  bool full() const { return static_cast<double>(elements_) > kMostTimes * base_.element_count; }

 private:
  bool isNearLamp(const CellPart& part, const Surface& surface, std::uint32_t side, double gap) const {
    for (const ConvexPolygon& polygon : part.pieces) {
      const glm::dvec2 centre = polygonCentroid(polygon);
      if (isNearLamp(surface.point(centre), side, gap)) return true;
      for (const PieceCorner& corner : polygon) {
        if (isNearLamp(surface.point(corner.uv + kInset * (centre - corner.uv)), side, gap)) return true;
      }
    }
    return false;
  }

  bool isNearLamp(const glm::dvec3& point, std::uint32_t side, double gap) const {
    const glm::dvec3& normal = base_.sides[side].normal;
    const auto hit = rays_.intersect(rays_.rays().lifted(point, normal), normal);
    if (!hit || hit->side == kNone || hit->at.distance > gap) return false;
    const Side &near = base_.sides[side], &far = base_.sides[hit->side];
    return glm::dot(far.normal, normal) < -kFacing && reflects(near) && reflects(far) &&
           (near.emission != glm::dvec3(0.0) || far.emission != glm::dvec3(0.0));
  }

  // Else light does not go to and fro.
  static bool reflects(const Side& side) { return side.reflectance != glm::dvec3(0.0); }

  const Mesh& base_;
  const CancelToken& cancel_;
  MeshRays rays_;
  double gaps_ = kGaps;
  std::uint64_t elements_ = 0;
};

}  // namespace

std::shared_ptr<const Mesh> refineInGaps(std::shared_ptr<const Mesh> base, const CancelToken& cancel) {
  GapQuestion question(*base, cancel);
  double gaps = kGaps;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt, gaps *= 2) {
    question.restart(gaps);
    auto mesh = std::make_shared<const Mesh>(gradedMesh(
        *base, [&](const CellPart& part) { return question(part); }, cancel));
    if (mesh->element_count == base->element_count) break;
    if (!question.full()) return mesh;
  }
  return base;
}

}  // namespace unshot
