#include "session/gap_refinement.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <vector>

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
constexpr double kPieceInset = 0.1;

class GapQuestion {
 public:
  GapQuestion(const Mesh& base, const CancelToken& cancel) : base_(base), cancel_(cancel), rays_(base) {
    for (std::uint32_t s = 0; s < base.surfaces.size(); ++s) {
      const Surface& surface = base.surfaces[s];
      const bool emits = std::any_of(std::begin(surface.side), std::end(surface.side), [&](std::uint32_t k) {
        return k != kNone && base.sides[k].emission != glm::dvec3(0.0) && reflects(base.sides[k]);
      });
      if (emits) lamps_.push_back(boxOf(surface, glm::dvec2(0.0), surface.extent));
    }
  }

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
    if (isFarFromLamps(part, surface, gap)) return false;
    bool split = false;
    for (const std::uint32_t side : surface.side)
      split = split || (side != kNone && isNearLamp(part, surface, side, gap));
    if (split) elements_ += 3 * ((surface.side[0] != kNone) + (surface.side[1] != kNone));
    return split;
  }

  bool full() const { return static_cast<double>(elements_) > kMostTimes * base_.element_count; }

 private:
  struct Box {
    glm::dvec3 low, high;
  };
  static Box boxOf(const Surface& surface, const glm::dvec2& low, const glm::dvec2& high) {
    Box box{surface.point(low), surface.point(low)};
    for (const glm::dvec2& corner : {high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)}) {
      box.low = glm::min(box.low, surface.point(corner));
      box.high = glm::max(box.high, surface.point(corner));
    }
    return box;
  }

  bool isFarFromLamps(const CellPart& part, const Surface& surface, double gap) const {
    const Box box = boxOf(surface, part.low, part.high);
    // With room for rounding, and for a ray that begins a little above the surface.
    const glm::dvec3 room(1.01 * gap + 10 * rays_.rays().lift());
    return std::none_of(lamps_.begin(), lamps_.end(), [&](const Box& lamp) {
      return glm::all(glm::lessThanEqual(box.low, lamp.high + room)) &&
             glm::all(glm::lessThanEqual(lamp.low, box.high + room));
    });
  }

  bool isNearLamp(const CellPart& part, const Surface& surface, std::uint32_t side, double gap) const {
    for (const ConvexPolygon& polygon : part.pieces) {
      const glm::dvec2 centre = polygonCentroid(polygon);
      if (isNearLamp(surface.point(centre), side, gap)) return true;
      for (const PieceCorner& corner : polygon) {
        if (isNearLamp(surface.point(corner.uv + kPieceInset * (centre - corner.uv)), side, gap)) return true;
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
  std::vector<Box> lamps_;  // around surfaces that emit and reflect
  double gaps_ = kGaps;
  std::uint64_t elements_ = 0;
};

// Whether light can go to and fro anywhere between a lamp and what faces it.
bool hasReflectingLamp(const Mesh& mesh) {
  return std::any_of(mesh.sides.begin(), mesh.sides.end(), [](const Side& side) {
    return side.emission != glm::dvec3(0.0) && side.reflectance != glm::dvec3(0.0);
  });
}

}  // namespace

std::shared_ptr<const Mesh> refineInGaps(std::shared_ptr<const Mesh> base, const CancelToken& cancel) {
  if (!hasReflectingLamp(*base)) return base;
  GapQuestion question(*base, cancel);
  question.restart(kGaps);
  if (!asksForAny(*base, [&](const CellPart& part) { return question(part); })) return base;
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
