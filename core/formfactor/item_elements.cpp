#include "formfactor/item_elements.h"

#include <algorithm>

#include "mesh/grid.h"

namespace unshot {
namespace {

// Steps of an item's place on its surface: what is so near to a contact may lie beyond it.
constexpr double kDoubt = 8;

}  // namespace

ItemElements::ItemElements(const Mesh& mesh) : mesh_(mesh) {
  for (const Surface& s : mesh_.surfaces) {
    SurfaceLookup lookup{s.nu, s.nv, s.first_cell, {kNone, kNone}};
    for (int back = 0; back < 2; ++back) {
      if (s.side[back] != kNone) lookup.first_element[back] = mesh_.sides[s.side[back]].first_element;
    }
    lookups_.push_back(lookup);
  }
  fillCells();
}

// Cells without area border on the outline; rounding can put a pixel there, which then belongs to the
// nearest cell that has an element. Cells cut by contacts hold several elements; their pixels ask the
// pieces.
void ItemElements::fillCells() {
  cell_element_.resize(mesh_.cells.size());
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) cell_element_[c] = mesh_.cells[c].element;
  for (const SurfaceLookup& s : lookups_) {
    std::vector<std::uint32_t> border;
    for (std::uint32_t c = 0; c < s.nu * s.nv; ++c) {
      if (cell_element_[s.first_cell + c] != kNone) border.push_back(c);
    }
    if (border.size() == std::size_t{s.nu} * s.nv) continue;
    for (std::size_t k = 0; k < border.size(); ++k) {
      const std::uint32_t c = border[k], i = c % s.nu, j = c / s.nu;
      const auto spread = [&](bool possible, std::uint32_t other) {
        if (!possible || cell_element_[s.first_cell + other] != kNone) return;
        const std::uint32_t own = cell_element_[s.first_cell + c];
        cell_element_[s.first_cell + other] =
            own != kMixed ? own : mesh_.pieces[mesh_.cells[s.first_cell + c].pieces.first].element;
        border.push_back(other);
      };
      spread(i > 0, c - 1);
      spread(i + 1 < s.nu, c + 1);
      spread(j > 0, c - s.nu);
      spread(j + 1 < s.nv, c + s.nu);
    }
  }
}

std::uint32_t ItemElements::elementOf(const Item& item) const {
  if (item.nothing()) return kNone;
  if (item.tie()) return kTied;
  const SurfaceLookup& s = lookups_[item.surface()];
  const std::uint32_t first = s.first_element[item.back()];
  if (first == kNone) return kLost;
  const std::uint32_t u = item.chart & 0xffffu, v = item.chart >> 16;
  std::uint32_t local = cell_element_[s.first_cell + (v * s.nv >> 16) * s.nu + (u * s.nu >> 16)];
  if (local == kMixed) {
    const Surface& surface = mesh_.surfaces[item.surface()];
    const glm::dvec2 step = surface.extent / 65536.0;
    local = elementAt(mesh_, surface, glm::dvec2(u + 0.5, v + 0.5) * step, kDoubt * std::max(step.x, step.y));
    if (local == kNone) return kTied;
  }
  return first + local;
}

std::uint32_t ItemElements::elementBeside(std::span<const Item> items, HemicubeLayout layout,
                                          std::size_t k) const {
  const std::size_t width = layout.width();
  const std::size_t beside[] = {k % width > 0 ? k - 1 : k, (k + 1) % width > 0 ? k + 1 : k,
                                k >= width ? k - width : k, k + width < items.size() ? k + width : k};
  for (const std::size_t other : beside) {
    const std::uint32_t element = elementOf(items[other]);
    if (element != kTied) return element;
  }
  return kLost;
}

}  // namespace unshot
