#include "mesh/patch_parts.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace unshot {
namespace {

// Between the normals of a joined patch and of the part it grows from: 20 degrees.
constexpr double kOneWay = 0.94;
// Of the largest area: parts above it stay alone.
constexpr double kSmall = 0.5;

class PatchJoiner {
 public:
  PatchJoiner(Mesh& mesh, const CancelToken& cancel)
      : mesh_(mesh),
        cancel_(cancel),
        most_area_(mesh.patch_size * mesh.patch_size),
        patch_(mesh.patch_parts.size(), kNone),
        centre_(mesh.patch_parts.size()) {}

  // The parts of each patch, the middlemost first.
  std::vector<std::vector<std::uint32_t>> run() {
    findNeighbours();
    std::vector<std::vector<std::uint32_t>> patches;
    for (std::uint32_t part = 0; part < patch_.size(); ++part) {
      cancel_.check();
      if (patch_[part] == kNone) patches.push_back(grow(part, static_cast<std::uint32_t>(patches.size())));
    }
    return patches;
  }

 private:
  // The only part of a side that may be joined; kNone for others.
  std::uint32_t smallPart(std::uint32_t side_index) {
    if (side_index == kNone) return kNone;
    const Side& side = mesh_.sides[side_index];
    const Surface& surface = mesh_.surfaces[side.surface];
    if (surface.patches.count != 1 || surface.area > kSmall * most_area_ || side.emission != glm::dvec3(0.0))
      return kNone;
    glm::dvec3 moment(0.0);
    for (std::uint32_t e = surface.elements.first; e < surface.elements.end(); ++e)
      moment += mesh_.shapes[e].area * mesh_.shapes[e].centre;
    centre_[side.first_part] = moment / mesh_.patch_area[side.first_part];
    return side.first_part;
  }

  void findNeighbours() {
    for (const SmoothPair& pair : mesh_.smooth_pairs) {
      for (int back = 0; back < 2; ++back) {
        const std::uint32_t a = smallPart(mesh_.surfaces[pair.a].side[back]),
                            b = smallPart(mesh_.surfaces[pair.b].side[back ^ int{pair.flipped}]);
        if (a == kNone || b == kNone || mesh_.patch_air[a] != mesh_.patch_air[b]) continue;
        neighbours_.emplace_back(a, b);
        neighbours_.emplace_back(b, a);
      }
    }
    std::sort(neighbours_.begin(), neighbours_.end());
  }

  const glm::dvec3& normal(std::uint32_t part) const {
    return mesh_.sides[mesh_.patch_parts[part].side].normal;
  }

  std::vector<std::uint32_t> grow(std::uint32_t first, std::uint32_t patch) {
    std::vector<std::uint32_t> parts{first};
    patch_[first] = patch;
    double area = mesh_.patch_area[first];
    glm::dvec3 moment = area * centre_[first];
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::pair<std::uint32_t, std::uint32_t> from(parts[k], 0);
      for (auto n = std::lower_bound(neighbours_.begin(), neighbours_.end(), from);
           n != neighbours_.end() && n->first == parts[k]; ++n) {
        const std::uint32_t part = n->second;
        const glm::dvec3 off = centre_[part] - centre_[first];
        if (patch_[part] != kNone || area + mesh_.patch_area[part] > most_area_ ||
            glm::dot(normal(part), normal(first)) < kOneWay || glm::dot(off, off) > most_area_)
          continue;
        patch_[part] = patch;
        parts.push_back(part);
        area += mesh_.patch_area[part];
        moment += mesh_.patch_area[part] * centre_[part];
      }
    }
    const auto fromMiddle = [&](std::uint32_t part) {
      const glm::dvec3 off = centre_[part] - moment / area;
      return glm::dot(off, off);
    };
    if (parts.size() > 1) {
      std::iter_swap(parts.begin(), std::min_element(parts.begin(), parts.end(), [&](auto a, auto b) {
                       return fromMiddle(a) < fromMiddle(b);
                     }));
    }
    return parts;
  }

  Mesh& mesh_;
  const CancelToken& cancel_;
  double most_area_;                  // [m^2]
  std::vector<std::uint32_t> patch_;  // one per part; kNone: not yet known
  std::vector<glm::dvec3> centre_;    // one per part, of those that may be joined
  std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_;
};

// Numbers the mesh's patches, which are one part each, as these.
void setPatches(const std::vector<std::vector<std::uint32_t>>& patches, Mesh& mesh) {
  std::vector<double> area;
  std::vector<std::uint32_t> air, first_with(mesh.patch_count, kNone);
  mesh.patch_part_start.assign(1, 0);
  mesh.patch_part.clear();
  mesh.patch_side.clear();
  for (const std::vector<std::uint32_t>& parts : patches) {
    const auto q = static_cast<std::uint32_t>(area.size());
    area.push_back(0);
    for (const std::uint32_t part : parts) {
      mesh.patch_parts[part].patch = q;
      mesh.patch_part.push_back(part);
      area.back() += mesh.patch_area[part];
    }
    mesh.patch_part_start.push_back(static_cast<std::uint32_t>(mesh.patch_part.size()));
    mesh.patch_side.push_back(mesh.patch_parts[parts[0]].side);
    std::uint32_t& first = first_with[mesh.patch_air[parts[0]]];
    if (first == kNone) first = q;
    air.push_back(first);
  }
  for (std::uint32_t& patch : mesh.element_patch) patch = mesh.patch_parts[patch].patch;
  mesh.patch_count = static_cast<std::uint32_t>(area.size());
  mesh.patch_area = std::move(area);
  mesh.patch_air = std::move(air);
}

}  // namespace

void joinSmallPatches(Mesh& mesh, const CancelToken& cancel) {
  const std::vector<std::vector<std::uint32_t>> patches = PatchJoiner(mesh, cancel).run();
  if (patches.size() < mesh.patch_count) setPatches(patches, mesh);
}

void joinPatchesAs(const Mesh& base, Mesh& mesh) {
  if (base.patch_count == mesh.patch_count) return;
  std::vector<std::vector<std::uint32_t>> patches;
  for (std::uint32_t q = 0; q < base.patch_count; ++q) {
    const std::span<const std::uint32_t> parts = base.partsOf(q);
    patches.emplace_back(parts.begin(), parts.end());
  }
  setPatches(patches, mesh);
}

}  // namespace unshot
