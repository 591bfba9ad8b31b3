#include "mesh/kept_sides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "base/point_tree.h"
#include "mesh/lit.h"
#include "mesh/reach.h"

namespace unshot {
namespace {

// What lies in front of surfaces, of some of them.
class Fronts {
 public:
  Fronts(const Mesh& mesh, std::span<const std::uint32_t> surfaces, const CancelToken& cancel)
      : margin_(2 * mesh.weld_distance), points_(pointsOf(mesh, surfaces)), tree_(points_, cancel) {}

  bool seesSomething(const Surface& surface, bool back) const {
    return tree_.anyInFront(over(surface, back, 0));
  }

  /// The same of a wall that is slightly bent: what `others` are, surfaces that go on from it (bentWalls).
  /// What rises over its own plane by no more than they do, and is not in front of them too, is beside the
  /// wall.
  bool seesSomething(const Surface& surface, bool back, std::span<const Surface* const> others,
                     double bend) const {
    if (others.empty()) return seesSomething(surface, back);
    if (tree_.anyInFront(over(surface, back, bend))) return true;
    std::vector<PointTree::HalfSpace> all{over(surface, back, 0)};
    for (const Surface* other : others) all.push_back(over(*other, back, 0));
    return tree_.anyInFront(all);
  }

 private:
  PointTree::HalfSpace over(const Surface& surface, bool back, double height) const {
    const glm::dvec3 normal = back ? -surface.normal : surface.normal;
    return {normal, glm::dot(normal, surface.origin) + height + margin_};
  }

  static std::vector<glm::dvec3> pointsOf(const Mesh& mesh, std::span<const std::uint32_t> surfaces) {
    std::vector<std::uint32_t> used;
    for (const std::uint32_t s : surfaces) {
      const Range triangles = mesh.surfaces[s].triangles;
      for (std::uint32_t t = triangles.first; t < triangles.end(); ++t) {
        const std::uint32_t* corners = mesh.triangles[t].position;
        used.insert(used.end(), corners, corners + 3);
      }
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<glm::dvec3> out;
    for (const std::uint32_t v : used) out.push_back(mesh.positions[v]);
    return out;
  }

  double margin_;
  std::vector<glm::dvec3> points_;
  PointTree tree_;
};

// Two surfaces are one bent wall where they share an edge and the angle between them is less than 2 degrees,
// and one rises over the other by no more than this share of that one's longer side.
constexpr double kStraightCosine = 0.9994, kMostBend = 0.02;

// Of each surface those that are one wall with it but for a slight bend, as the two of the red one of the
// published Cornell box, and how high they rise over its front and its back.
struct BentWall {
  std::vector<const Surface*> others;
  double height[2] = {0, 0};
};

std::vector<BentWall> bentWalls(const Mesh& mesh, const std::vector<SurfaceEdge>& edges) {
  std::vector<BentWall> out(mesh.surfaces.size());
  const auto note = [&](std::uint32_t of, std::uint32_t other) {
    const Surface &surface = mesh.surfaces[of], &beside = mesh.surfaces[other];
    BentWall& wall = out[of];
    if (of == other || glm::dot(surface.normal, beside.normal) < kStraightCosine ||
        std::find(wall.others.begin(), wall.others.end(), &beside) != wall.others.end())
      return;
    double low = 0, high = 0;
    for (std::uint32_t t = beside.triangles.first; t < beside.triangles.end(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t].position) {
        const double height = glm::dot(surface.normal, mesh.positions[v] - surface.origin);
        low = std::min(low, height);
        high = std::max(high, height);
      }
    }
    if (std::max(high, -low) > kMostBend * std::max(surface.extent.x, surface.extent.y)) return;
    wall.others.push_back(&beside);
    wall.height[0] = std::max(wall.height[0], high);
    wall.height[1] = std::max(wall.height[1], -low);
  };
  for (std::size_t k = 1; k < edges.size(); ++k) {
    const SurfaceEdge &a = edges[k - 1], &b = edges[k];
    if (a.a != b.a || a.b != b.b) continue;
    note(a.surface, b.surface);
    note(b.surface, a.surface);
  }
  return out;
}

// Of each of these sides the room; all the same where there is one, or where it is not known of each.
std::vector<std::uint32_t> roomsOf(const MeshOptions& options, const std::vector<char>& keep,
                                   std::vector<std::uint32_t> rooms) {
  bool known = !options.rooms_unknown && !rooms.empty();
  for (std::size_t k = 0; known && k < keep.size(); ++k) known = !keep[k] || rooms[k] != kNone;
  return known ? std::move(rooms) : std::vector<std::uint32_t>(keep.size(), 0);
}

}  // namespace

KeptSides sidesToKeep(const MeshOptions& options, const std::vector<SurfaceEdge>& edges,
                      std::span<const Crossing> crossings, Mesh& mesh, const CancelToken& cancel) {
  const std::size_t count = 2 * mesh.surfaces.size();
  std::vector<char> keep(count, 1), sees(count);
  const auto inOneRoom = [&] { return KeptSides{keep, std::vector<std::uint32_t>(count, 0)}; };
  if (options.sky || (options.outer_sides && options.dark_sides)) return inOneRoom();
  std::vector<std::uint32_t> all(mesh.surfaces.size());
  std::iota(all.begin(), all.end(), 0u);
  const Fronts fronts(mesh, all, cancel);
  const std::vector<BentWall> bent = bentWalls(mesh, edges);
  for (std::size_t k = 0; k < count; ++k) {
    cancel.check();
    const BentWall& wall = bent[k / 2];
    sees[k] = fronts.seesSomething(mesh.surfaces[k / 2], k % 2 != 0, wall.others, wall.height[k % 2]);
    mesh.surfaces[k / 2].outer[k % 2] = !sees[k];
  }
  // A flat sheet sees nothing at all; it is kept whole, so that it can be shown.
  if (std::find(sees.begin(), sees.end(), 1) == sees.end()) return inOneRoom();
  if (!options.outer_sides) keep = sees;
  if (options.dark_sides) return inOneRoom();
  std::vector<char> emits(count);  // what sees nothing lights nothing
  for (std::size_t k = 0; k < count; ++k) {
    const bool light = mesh.materials[mesh.surfaces[k / 2].material].emits();
    emits[k] = sees[k] && light && !(k % 2 != 0 && options.emit_front_only);
  }
  Reached reached = findReach(mesh, edges, crossings, emits, mesh.weld_distance, cancel);
  // What sides beyond emit leaves the scene.
  mesh.closed = reached.closed && !options.escape_unknown && !options.outer_sides;
  for (std::size_t k = 0; k < count; ++k) keep[k] = keep[k] && (reached.sides[k] || !sees[k]);
  return {keep, roomsOf(options, keep, std::move(reached.rooms))};
}

void findBetween(bool sky, Mesh& mesh, const CancelToken& cancel) {
  std::vector<std::vector<std::uint32_t>> rooms;  // surfaces with sides there
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    mesh.surfaces[s].between = sky && isLit(mesh.surfaces[s]);
    for (const std::uint32_t side : mesh.surfaces[s].side) {
      if (side == kNone) continue;
      const std::uint32_t room = mesh.sides[side].room;
      if (room >= rooms.size()) rooms.resize(room + 1);
      if (rooms[room].empty() || rooms[room].back() != s) rooms[room].push_back(s);
    }
  }
  std::size_t done = 0;
  for (const std::vector<std::uint32_t>& room : rooms) {
    if (sky || room.empty()) continue;
    const Fronts fronts(mesh, room, cancel);
    for (const std::uint32_t s : room) {
      cancel.check();
      cancel.report(std::min(1.0, static_cast<double>(++done) / static_cast<double>(mesh.surfaces.size())));
      Surface& surface = mesh.surfaces[s];
      surface.between =
          surface.between || (fronts.seesSomething(surface, false) && fronts.seesSomething(surface, true));
    }
  }
}

}  // namespace unshot
