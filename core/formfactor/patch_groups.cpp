#include "formfactor/patch_groups.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "mesh/lit.h"

namespace unshot {
namespace {

constexpr double kNoPlace = std::numeric_limits<double>::infinity();

// For each node of a patch the topmost node around it that holds at most `most` of them.
void climb(const Mesh& mesh, std::uint32_t index, std::uint32_t most,
           const std::vector<std::uint32_t>& patches_in, std::uint32_t top,
           std::vector<std::uint32_t>& top_of) {
  if (top == kNone && patches_in[index] <= most) top = index;
  top_of[index] = top;
  const Node& node = mesh.nodes[index];
  if (patches_in[index] == 0 || node.first_child == kNone) return;
  for (std::uint32_t k = 0; k < node.child_count; ++k)
    climb(mesh, node.first_child + k, most, patches_in, top, top_of);
}

}  // namespace

PatchGroups::PatchGroups(const Mesh& mesh, std::uint32_t most)
    : mesh_(mesh), group_(mesh.patch_count, kNone) {
  // How many patches lie in each node; children follow their parent.
  std::vector<std::uint32_t> patches_in(mesh.nodes.size(), 0), top_of(mesh.nodes.size(), kNone);
  for (const PatchShape& shape : mesh.patch_shapes) ++patches_in[shape.node];
  for (std::size_t n = mesh.nodes.size(); n-- > 0;) {
    const Node& node = mesh.nodes[n];
    for (std::uint32_t k = 0; node.first_child != kNone && k < node.child_count; ++k)
      patches_in[n] += patches_in[node.first_child + k];
  }
  for (const Surface& s : mesh.surfaces) {
    if (isLit(s)) climb(mesh, s.root, most, patches_in, kNone, top_of);
  }
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> found;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const Side& side = mesh.sides[mesh.patch_side[q]];
    const Surface& surface = mesh.surfaces[side.surface];
    const std::uint32_t local = mesh.localPatch(mesh.partsOf(q)[0]);
    const std::uint32_t node = mesh.patch_shapes[surface.patches.first + local].node;
    const auto fresh = static_cast<std::uint32_t>(members_.size());
    group_[q] = fresh;
    if (side.emission == glm::dvec3(0.0) && !mesh.joined(q)) {
      const std::uint32_t top = top_of[node] == kNone ? node : top_of[node];
      group_[q] = found.try_emplace({mesh.patch_side[q], top, mesh.patch_air[q]}, fresh).first->second;
    }
    if (group_[q] == fresh) members_.emplace_back();
    members_[group_[q]].push_back(q);
  }
}

Region PatchGroups::region(std::uint32_t group) const {
  const std::vector<std::uint32_t>& members = members_[group];
  std::vector<Region> parts;
  glm::dvec2 moment(0.0);
  double area = 0;
  for (const std::uint32_t q : members) {
    parts.push_back(regionOfPatch(mesh_, q));
    area += mesh_.patch_area[q];
    moment += mesh_.patch_area[q] * parts.back().sample;
  }
  // The middle of them all may be none of theirs (a hole, another room); the middle of the nearest is.
  const glm::dvec2 middle = moment / area;
  double nearest = kNoPlace;
  Region out;
  for (const Region& part : parts) {
    const glm::dvec2 off = part.sample - middle;
    if (glm::dot(off, off) >= nearest) continue;
    nearest = glm::dot(off, off);
    out = part;
  }
  const bool inside =
      glm::all(glm::greaterThanEqual(middle, out.low)) && glm::all(glm::lessThanEqual(middle, out.high));
  if (inside && out.patch == kNone &&
      out.area >= (1 - 1e-9) * (out.high.x - out.low.x) * (out.high.y - out.low.y))
    out.sample = middle;
  out.area = area;
  return out;
}

}  // namespace unshot
