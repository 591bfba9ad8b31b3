#include "formfactor/receiver_blocks.h"

#include <algorithm>
#include <cmath>

#include "mesh/patch_lattice.h"

namespace unshot {
namespace {

// Cells along each side of a block. Features between nine looks at it are found where they are wider than a
// quarter of it.
constexpr std::uint32_t kMostCells = 16;

// The cells of one side and the receivers at their corners.
class Grid {
 public:
  Grid(const Surface& surface, const Receivers& receivers)
      : receivers_(receivers),
        nu_(surface.nu),
        nv_(surface.nv),
        step_(surface.extent / glm::dvec2(surface.nu, surface.nv)),
        whole_(std::size_t{nu_} * nv_, 0),
        vertex_(std::size_t{nu_ + 1} * (nv_ + 1), kNone) {}

  void add(const PatchLattice& lattice) {
    const auto i0 = static_cast<std::uint32_t>(std::lround(lattice.low.x / step_.x)),
               j0 = static_cast<std::uint32_t>(std::lround(lattice.low.y / step_.y));
    for (std::uint32_t j = 0; j <= lattice.nv; ++j) {
      for (std::uint32_t i = 0; i <= lattice.nu; ++i) {
        if (i < lattice.nu && j < lattice.nv) whole_[(j0 + j) * nu_ + i0 + i] = 1;
        const std::uint32_t v = receivers_.base_first + lattice.vertex[j * (lattice.nu + 1) + i];
        std::uint32_t& here = vertex_[(j0 + j) * (nu_ + 1) + i0 + i];
        here = (here == kNone || here == v) && receivers_.viewsOf(v).size() == 1 ? v : kSeam;
      }
    }
  }

  void blocks(std::vector<ReceiverBlock>& out) const { split(0, nu_, 0, nv_, out); }

 private:
  // Where a contact runs along the border of cells, or where surfaces join smoothly.
  static constexpr std::uint32_t kSeam = kNone - 1;

  // Patches are of two by two cells.
  static std::uint32_t half(std::uint32_t n) { return n > 2 ? 2 * ((n + 2) / 4) : n / 2; }

  void split(std::uint32_t i0, std::uint32_t i1, std::uint32_t j0, std::uint32_t j1,
             std::vector<ReceiverBlock>& out) const {
    if (i1 - i0 <= 2 && j1 - j0 <= 2) return;
    if (i1 - i0 <= kMostCells && j1 - j0 <= kMostCells && isWhole(i0, i1, j0, j1)) {
      ReceiverBlock block{i1 - i0, j1 - j0, {}};
      for (std::uint32_t j = j0; j <= j1; ++j) {
        const auto row = vertex_.begin() + static_cast<std::ptrdiff_t>(j * (nu_ + 1));
        block.vertex.insert(block.vertex.end(), row + i0, row + i1 + 1);
      }
      out.push_back(std::move(block));
    } else if (i1 - i0 >= j1 - j0) {
      const std::uint32_t middle = i0 + half(i1 - i0);
      split(i0, middle, j0, j1, out);
      split(middle, i1, j0, j1, out);
    } else {
      const std::uint32_t middle = j0 + half(j1 - j0);
      split(i0, i1, j0, middle, out);
      split(i0, i1, middle, j1, out);
    }
  }

  bool isWhole(std::uint32_t i0, std::uint32_t i1, std::uint32_t j0, std::uint32_t j1) const {
    for (std::uint32_t j = j0; j <= j1; ++j) {
      for (std::uint32_t i = i0; i <= i1; ++i) {
        if (i < i1 && j < j1 && !whole_[j * nu_ + i]) return false;
        if (vertex_[j * (nu_ + 1) + i] >= kSeam) return false;
      }
    }
    return true;
  }

  const Receivers& receivers_;
  std::uint32_t nu_, nv_;
  glm::dvec2 step_;
  std::vector<char> whole_;
  std::vector<std::uint32_t> vertex_;
};

}  // namespace

ReceiverBlocks receiverBlocks(const Mesh& mesh, const Receivers& receivers, const CancelToken& cancel) {
  ReceiverBlocks out;
  if (!receivers.layered()) return out;
  const Mesh& base = *mesh.base;
  const std::vector<std::optional<PatchLattice>> lattices = patchLattices(base, cancel);
  for (const Side& side : base.sides) {
    cancel.check();
    const Surface& surface = base.surfaces[side.surface];
    Grid grid(surface, receivers);
    for (std::uint32_t k = 0; k < surface.patches.count; ++k) {
      const auto& lattice = lattices[base.patch_parts[side.first_part + k].patch];
      if (lattice) grid.add(*lattice);
    }
    grid.blocks(out.blocks);
  }
  const Range all = receivers.reachedBy(false);
  std::vector<char> covered(all.count, 0);
  for (const ReceiverBlock& block : out.blocks) {
    for (const std::uint32_t v : block.vertex) covered[v - all.first] = 1;
  }
  for (std::uint32_t v = all.first; v < all.end(); ++v) {
    if (!covered[v - all.first]) out.rest.push_back(v);
  }
  return out;
}

}  // namespace unshot
