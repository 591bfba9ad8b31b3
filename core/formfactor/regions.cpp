#include "formfactor/regions.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

namespace unshot {
namespace {

// Gathers pieces into area, centroid and the centre of the largest, which stands in where the centroid lies
// outside.
struct Gatherer {
  double area = 0, largest = 0;
  glm::dvec2 moment{0.0}, largest_centre{0.0};

  void add(std::span<const PieceCorner> polygon) {
    const double a = polygonArea(polygon);
    if (a <= 0) return;
    const glm::dvec2 centre = polygonCentroid(polygon);
    area += a;
    moment += a * centre;
    if (a > largest) {
      largest = a;
      largest_centre = centre;
    }
  }
};

// Calls f with each piece in the cell that is of the patch.
template <class F>
void forPieces(const Mesh& mesh, const Surface& s, std::uint32_t cell, std::uint32_t patch, F&& f) {
  const Range pieces = mesh.cells[cell].pieces;
  for (std::uint32_t p = pieces.first; p < pieces.end(); ++p) {
    const Piece& piece = mesh.pieces[p];
    if (patch == kNone || mesh.shapes[s.elements.first + piece.element].patch == patch)
      f(mesh.cornersOf(piece));
  }
}

template <class F>
void forPieces(const Mesh& mesh, const Surface& s, const Node& node, std::uint32_t patch, F&& f) {
  for (std::uint32_t j = node.v0; j < node.v1; ++j) {
    for (std::uint32_t i = node.u0; i < node.u1; ++i)
      forPieces(mesh, s, s.first_cell + j * s.nu + i, patch, f);
  }
}

bool isFull(const Region& region) {
  const glm::dvec2 size = region.high - region.low;
  return region.area >= (1 - 1e-9) * size.x * size.y;
}

Region regionOfPart(const Mesh& mesh, std::uint32_t part) {
  const std::uint32_t side = mesh.patch_parts[part].side, patch = mesh.localPatch(part);
  const PatchShape& shape = mesh.patch_shapes[mesh.surfaces[mesh.sides[side].surface].patches.first + patch];
  Region out = regionOfNode(mesh, shape.node, shape.whole ? kNone : patch);
  out.side = side;
  return out;
}

glm::dvec3 sampleOf(const Mesh& mesh, const Region& region) {
  return mesh.surfaces[region.surface].point(region.sample);
}

// Of several parts: as the middlemost, but for the area.
Region regionOfParts(const Mesh& mesh, std::span<const std::uint32_t> parts) {
  std::vector<Region> regions;
  double area = 0;
  glm::dvec3 moment(0.0);
  for (const std::uint32_t part : parts) {
    const Region& region = regions.emplace_back(regionOfPart(mesh, part));
    area += region.area;
    moment += region.area * sampleOf(mesh, region);
  }
  const auto fromMiddle = [&](const Region& region) {
    return glm::distance(sampleOf(mesh, region), moment / area);
  };
  Region out = *std::min_element(regions.begin(), regions.end(), [&](const Region& a, const Region& b) {
    return fromMiddle(a) < fromMiddle(b);
  });
  if (parts.size() > 1) out.parts.assign(parts.begin(), parts.end());
  out.area = area;
  return out;
}

// Halves of several parts, along the axis where they are farthest apart.
std::vector<Region> halvesOf(const Mesh& mesh, std::span<const std::uint32_t> parts) {
  std::vector<std::pair<glm::dvec3, std::uint32_t>> at;
  for (const std::uint32_t part : parts) at.emplace_back(sampleOf(mesh, regionOfPart(mesh, part)), part);
  glm::dvec3 low = at[0].first, high = low;
  for (const auto& [point, part] : at) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const glm::dvec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::stable_sort(at.begin(), at.end(),
                   [&](const auto& a, const auto& b) { return a.first[axis] < b.first[axis]; });
  std::vector<std::uint32_t> sorted;
  for (const auto& [point, part] : at) sorted.push_back(part);
  const std::span<const std::uint32_t> all(sorted);
  return {regionOfParts(mesh, all.first(all.size() / 2)), regionOfParts(mesh, all.subspan(all.size() / 2))};
}

}  // namespace

Region regionOfPatch(const Mesh& mesh, std::uint32_t q) { return regionOfParts(mesh, mesh.partsOf(q)); }

Region regionOfNode(const Mesh& mesh, std::uint32_t index, std::uint32_t patch) {
  const Node& node = mesh.nodes[index];
  const Surface& s = mesh.surfaces[node.surface];
  const glm::dvec2 step = s.extent / glm::dvec2(s.nu, s.nv);
  Region out;
  out.surface = node.surface;
  out.patch = patch;
  out.node = index;
  out.low = step * glm::dvec2(node.u0, node.v0);
  out.high = step * glm::dvec2(node.u1, node.v1);
  out.area = node.area;
  out.sample = (out.low + out.high) / 2.0;
  if (patch == kNone && isFull(out)) return out;
  Gatherer sum;
  forPieces(mesh, s, node, patch, [&](auto corners) { sum.add(corners); });
  out.area = sum.area;
  if (sum.area <= 0) return out;
  const glm::dvec2 centroid = sum.moment / sum.area;
  bool inside = false;
  forPieces(mesh, s, node, patch, [&](auto corners) { inside = inside || contains(corners, centroid); });
  out.sample = inside ? centroid : sum.largest_centre;
  return out;
}

std::vector<Region> partsOf(const Mesh& mesh, const Region& region) {
  if (!region.parts.empty()) return halvesOf(mesh, region.parts);
  std::vector<Region> out;
  const Surface& s = mesh.surfaces[region.surface];
  if (region.node != kNone && !mesh.nodes[region.node].isCell()) {
    const Node& node = mesh.nodes[region.node];
    for (std::uint32_t k = 0; k < node.child_count; ++k) {
      Region part = regionOfNode(mesh, node.first_child + k, region.patch);
      part.side = region.side;
      if (part.area > 0) out.push_back(std::move(part));
    }
    return out;
  }
  const std::uint32_t cell =
      region.node == kNone ? region.cell
                           : s.first_cell + mesh.nodes[region.node].v0 * s.nu + mesh.nodes[region.node].u0;
  const glm::dvec2 middle = (region.low + region.high) / 2.0;
  const bool full = isFull(region);
  ConvexPolygon a, b;
  for (int q = 0; q < 4; ++q) {
    Region part = region;
    part.node = kNone;
    part.cell = cell;
    (q & 1 ? part.low.x : part.high.x) = middle.x;
    (q & 2 ? part.low.y : part.high.y) = middle.y;
    part.sample = (part.low + part.high) / 2.0;
    part.area = region.area / 4;
    if (!full) {
      Gatherer sum;
      forPieces(mesh, s, cell, region.patch, [&](auto corners) {
        a.assign(corners.begin(), corners.end());
        clipAt(a, 0, part.low.x, 1, b);
        clipAt(b, 0, part.high.x, -1, a);
        clipAt(a, 1, part.low.y, 1, b);
        clipAt(b, 1, part.high.y, -1, a);
        if (!a.empty()) sum.add(a);
      });
      if (sum.area <= 0) continue;
      part.area = sum.area;
      const glm::dvec2 centroid = sum.moment / sum.area;
      // One piece is convex and holds its centroid; of several, the largest is sure to be on the surface.
      part.sample = sum.largest >= (1 - 1e-9) * sum.area ? centroid : sum.largest_centre;
    }
    out.push_back(part);
  }
  return out;
}

}  // namespace unshot
