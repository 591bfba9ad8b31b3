#include "mesh/shells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "base/box_tree.h"
#include "base/random.h"
#include "mesh/edge_fan.h"

namespace unshot {
namespace {

// Of the weld distance: what comes nearer to a line than this is not told to be on either side of it.
constexpr double kTooNear = 0.01;
constexpr int kTries = 8;
// Of a plane to a line, as a cosine to its normal.
constexpr double kLeastSlope = 1e-3;

std::uint32_t rootOf(std::vector<std::uint32_t>& forest, std::uint32_t k) {
  while (forest[k] != k) k = forest[k] = forest[forest[k]];
  return k;
}

// Of six directions, the one in which the scene ends soonest.
int shortestWayOut(const Mesh& mesh, const glm::dvec3& point) {
  int best = 0;
  double least = INFINITY;
  for (int k = 0; k < 6; ++k) {
    const double way = k % 2 ? point[k / 2] - mesh.bounds_min[k / 2] : mesh.bounds_max[k / 2] - point[k / 2];
    if (way >= least) continue;
    least = way;
    best = k;
  }
  return best;
}

std::array<glm::dvec3, 3> cornersOf(const Mesh& mesh, std::uint32_t triangle) {
  const std::uint32_t* v = mesh.triangles[triangle].position;
  return {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
}

}  // namespace

// Lines along the axes, and what they meet of surfaces and caps between shells.
class Shells::Lines {
 public:
  explicit Lines(Shells& shells) : mesh_(shells.mesh_), caps_(shells.caps_) {
    margin_ = kTooNear * shells.weld_distance_;
    const auto between = [&](std::uint32_t side) {
      return mixBits(shells.of(side) + 1) ^ mixBits(shells.of(side ^ 1u) + 1);
    };
    std::vector<Box> boxes;
    for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
      const Range triangles = mesh_.surfaces[s].triangles;
      for (std::uint32_t t = triangles.first; between(2 * s) != 0 && t < triangles.end(); ++t) {
        const std::array<glm::dvec3, 3> c = cornersOf(mesh_, t);
        boxes.push_back({glm::min(glm::min(c[0], c[1]), c[2]), glm::max(glm::max(c[0], c[1]), c[2])});
        walls_.push_back(t);
        between_.push_back(between(2 * s));
      }
    }
    for (const Cap& cap : caps_) {
      Box box{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
      for (const glm::dvec2& uv : {cap.low, cap.high, {cap.low.x, cap.high.y}, {cap.high.x, cap.low.y}}) {
        box.low = glm::min(box.low, mesh_.surfaces[cap.surface].point(uv));
        box.high = glm::max(box.high, mesh_.surfaces[cap.surface].point(uv));
      }
      boxes.push_back(box);
      between_.push_back(between(cap.side));
    }
    tree_.emplace(std::move(boxes), shells.cancel_);
  }

  bool empty() const { return walls_.empty(); }

  /// `direction`: one of six.
  std::optional<Place> placeOf(const glm::dvec3& point, int direction) const {
    const int axis = direction / 2;
    Box line{point, point};
    (direction % 2 ? line.low : line.high)[axis] = direction % 2 ? -INFINITY : INFINITY;
    line.low -= margin_;
    line.high += margin_;
    Place place = 0;  // outside of all
    bool sure = true;
    tree_->overlapping(line, [&](std::uint32_t k) {
      if (!sure) return;
      const std::size_t walls = walls_.size();
      const auto at = k < walls ? meets(walls_[k], point, axis) : meets(caps_[k - walls], point, axis);
      sure = at.has_value() && std::abs(*at) >= margin_;
      if (sure && std::isfinite(*at) && (*at > 0) == (direction % 2 == 0)) place ^= between_[k];
    });
    return sure ? std::optional(place) : std::nullopt;
  }

 private:
  // How far along an axis from the point the triangle is met, infinite where it is not; nothing where the
  // line is too near to an edge.
  std::optional<double> meets(std::uint32_t triangle, const glm::dvec3& point, int axis) const {
    const std::array<glm::dvec3, 3> c = cornersOf(mesh_, triangle);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    // Twice the areas that the line cuts the projected triangle into, by corner opposite.
    double part[3], sum = 0;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p = c[(k + 1) % 3] - point, q = c[(k + 2) % 3] - point;
      part[k] = p[u] * q[v] - p[v] * q[u];
      sum += part[k];
    }
    bool inside = sum != 0;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 edge = c[(k + 2) % 3] - c[(k + 1) % 3];
      const double height = (sum < 0 ? -1 : 1) * part[k] / std::max(std::hypot(edge[u], edge[v]), 1e-300);
      if (height < -margin_) return INFINITY;
      inside = inside && height > margin_;
    }
    if (!inside) return std::nullopt;
    return (part[0] * c[0][axis] + part[1] * c[1][axis] + part[2] * c[2][axis]) / sum - point[axis];
  }

  // The same for a cap: inside its outline an odd number of times.
  std::optional<double> meets(const Cap& cap, const glm::dvec3& point, int axis) const {
    const Surface& surface = mesh_.surfaces[cap.surface];
    const double slope = surface.normal[axis];
    if (std::abs(slope) < kLeastSlope) return std::nullopt;
    const double at = glm::dot(surface.origin - point, surface.normal) / slope;
    glm::dvec3 there = point;
    there[axis] += at;
    const glm::dvec2 p = surface.chart(there);
    bool inside = false;
    for (const ContactSegment& s : cap.outline) {
      const glm::dvec2 along = s.b - s.a, from = p - s.a;
      const double t = std::clamp(glm::dot(from, along) / std::max(glm::dot(along, along), 1e-300), 0.0, 1.0);
      if (glm::distance(from, t * along) < margin_) return std::nullopt;
      if ((s.a.y > p.y) == (s.b.y > p.y)) continue;
      inside = inside != (p.x < s.a.x + (p.y - s.a.y) / along.y * along.x);
    }
    return inside ? at : INFINITY;
  }

  const Mesh& mesh_;
  const std::vector<Cap>& caps_;
  double margin_ = 0;
  std::vector<std::uint32_t> walls_;  // triangles of surfaces between two shells
  std::vector<Place> between_;        // the two, of walls and then of caps
  std::optional<BoxTree> tree_;
};

Shells::Shells(const Mesh& mesh, const std::vector<SurfaceEdge>& edges, std::span<const Crossing> crossings,
               std::span<const Touch> touches, double weld_distance, const CancelToken& cancel)
    : mesh_(mesh),
      edges_(edges),
      weld_distance_(weld_distance),
      cancel_(cancel),
      shell_(2 * mesh.surfaces.size()),
      body_(mesh.surfaces.size()) {
  std::iota(shell_.begin(), shell_.end(), 0u);
  std::iota(body_.begin(), body_.end(), 0u);
  joinAtEdges();
  joinCrossing(crossings);
  closeBodies(touches, crossings);
  lines_ = std::make_unique<Lines>(*this);
}

Shells::~Shells() = default;

bool Shells::separate() { return !lines_->empty(); }

std::uint32_t Shells::of(std::uint32_t side) { return rootOf(shell_, side); }

std::optional<Shells::Place> Shells::placeOf(std::uint32_t side, double off) {
  const Surface& surface = mesh_.surfaces[side / 2];
  const glm::dvec3 away = (side % 2 == 0 ? off : -off) * surface.normal;
  std::uint64_t state = mixBits(side + 1);
  const auto random = [&] { return unitInterval(state = mixBits(state)); };
  for (int k = 0; k < kTries; ++k) {
    const auto nth = static_cast<std::uint32_t>(random() * surface.triangles.count);
    const std::array<glm::dvec3, 3> c = cornersOf(mesh_, surface.triangles.first + nth);
    // Not near an edge, where a line may meet others.
    const double a = 0.2 + 0.4 * random(), b = (0.2 + 0.6 * random()) * (1 - a);
    const glm::dvec3 point = a * c[0] + b * c[1] + (1 - a - b) * c[2] + away;
    const auto place = lines_->placeOf(point, k == 0 ? shortestWayOut(mesh_, point) : k % 6);
    if (place) return place;
  }
  return std::nullopt;
}

void Shells::joinAtEdges() {
  for (std::uint32_t first = 0; first < edges_.size();) {
    cancel_.check();
    std::uint32_t end = first + 1;
    while (end < edges_.size() && edges_[end].a == edges_[first].a && edges_[end].b == edges_[first].b) ++end;
    const std::span<const SurfaceEdge> uses(edges_.data() + first, edges_.data() + end);
    for (const SurfaceEdge& use : uses) body_[rootOf(body_, use.surface)] = rootOf(body_, uses[0].surface);
    if (uses.size() == 1) {
      free_edges_.push_back(first);
    } else if (uses.size() != 2 || uses[0].surface != uses[1].surface) {
      joinAround(uses);
    }
    first = end;
  }
}

void Shells::joinAround(std::span<const SurfaceEdge> uses) {
  forWedges(
      mesh_.positions[uses[0].b] - mesh_.positions[uses[0].a], uses,
      [&](const SurfaceEdge& use) { return mesh_.surfaces[use.surface].normal; },
      [&](const SurfaceEdge& use, int back) { return 2 * use.surface + static_cast<std::uint32_t>(back); },
      [&](const FanLeaf& one, const FanLeaf& two, double wedge) {
        join(one.ahead, two.behind);
        if (wedge >= kNoWedge) return;  // else it is not known which of the two comes first
        join(one.ahead, one.behind);
        join(two.ahead, two.behind);
      });
}

void Shells::joinCrossing(std::span<const Crossing> crossings) {
  for (const Crossing& c : crossings) {
    if (c.at_outline) continue;
    for (const std::uint32_t side : {2 * c.surface + 1, 2 * c.by, 2 * c.by + 1}) join(2 * c.surface, side);
  }
}

// Closes the bodies that stand on one surface each; joins the sides of all other surfaces that end alone.
void Shells::closeBodies(std::span<const Touch> touches, std::span<const Crossing> crossings) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> free_edges_of;  // bodies
  for (const std::uint32_t e : free_edges_) free_edges_of[rootOf(body_, edges_[e].surface)].push_back(e);
  std::vector<std::vector<const Touch*>> touches_of(edges_.size());
  for (const Touch& t : touches) touches_of[t.edge].push_back(&t);
  for (const auto& [body, edges] : free_edges_of) {
    cancel_.check();
    std::optional<Cap> cap = capOf(edges, touches_of);
    if (cap && isWhole(*cap, crossings)) {
      caps_.push_back(std::move(*cap));
      continue;
    }
    for (const std::uint32_t e : edges) join(2 * edges_[e].surface, 2 * edges_[e].surface + 1);
  }
}

// One surface on which all free edges of a body lie, between the same two shells.
std::optional<Shells::Cap> Shells::capOf(std::span<const std::uint32_t> edges,
                                         std::span<const std::vector<const Touch*>> touches) {
  const auto shellsAt = [&](std::uint32_t e) {
    const std::uint32_t front = of(2 * edges_[e].surface), back = of(2 * edges_[e].surface + 1);
    return std::pair(std::min(front, back), std::max(front, back));
  };
  Cap cap;
  for (const std::uint32_t e : edges) {
    if (touches[e].size() != 1 || shellsAt(e) != shellsAt(edges[0])) return std::nullopt;
    const Touch& touch = *touches[e][0];
    if (e == edges[0]) cap = {touch.surface, 2 * edges_[e].surface, {}};
    if (touch.surface != cap.surface) return std::nullopt;
    if (rootOf(body_, touch.surface) == rootOf(body_, edges_[e].surface)) return std::nullopt;
    cap.outline.push_back(touch.line);
    for (const glm::dvec2& p : {touch.line.a, touch.line.b}) {
      cap.low = glm::min(cap.low, p);
      cap.high = glm::max(cap.high, p);
    }
  }
  return cap;
}

// Whether the surface fills the cap, and nothing passes through it.
bool Shells::isWhole(const Cap& cap, std::span<const Crossing> crossings) const {
  const auto near = [&](const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 low = glm::min(a, b), high = glm::max(a, b);
    return low.x <= cap.high.x && low.y <= cap.high.y && high.x >= cap.low.x && high.y >= cap.low.y;
  };
  const Surface& surface = mesh_.surfaces[cap.surface];
  const glm::dvec2 middle = (cap.low + cap.high) / 2.0;
  bool inside = false;
  for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
    const ChartTriangle& triangle = mesh_.triangles[t];
    bool here = true;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2 &a = triangle.uv[k], &b = triangle.uv[(k + 1) % 3];
      if (triangle.outline[k] && near(a, b)) return false;
      here = here && (b.x - a.x) * (middle.y - a.y) - (b.y - a.y) * (middle.x - a.x) >= 0;
    }
    inside = inside || here;
  }
  return inside && std::none_of(crossings.begin(), crossings.end(), [&](const Crossing& c) {
           return c.surface == cap.surface && !c.at_outline && near(c.line.a, c.line.b);
         });
}

}  // namespace unshot
