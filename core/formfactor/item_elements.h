// Which element of the mesh a pixel of a hemicube sees.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formfactor/hemicube_view.h"

namespace unshot {

class ItemElements {
 public:
  /// Instead of an element: the pixel sees a side that no light can reach, by rounding only.
  static constexpr std::uint32_t kLost = kNone - 2;

  /// Keeps a reference to the mesh, which must outlive it.
  explicit ItemElements(const Mesh& mesh);

  /// The element at pixel k of the picture; kNone where it sees nothing. Where surfaces meet, rounding may
  /// let the one behind win a pixel, and light would leak through closed walls: such a pixel takes what one
  /// next to it sees, and where all are doubtful it is kLost.
  std::uint32_t at(std::span<const Item> items, HemicubeLayout layout, std::size_t k) const {
    const std::uint32_t element = elementOf(items[k]);
    return element == kTied ? elementBeside(items, layout, k) : element;
  }

 private:
  static constexpr std::uint32_t kTied = kNone - 1;  // see Item::tie

  // What the pixel loop needs of a surface, together in memory.
  struct SurfaceLookup {
    std::uint32_t nu, nv, first_cell;
    std::uint32_t first_element[2];  // kNone: that side has none
  };
  void fillCells();
  std::uint32_t elementOf(const Item& item) const;
  std::uint32_t elementBeside(std::span<const Item> items, HemicubeLayout layout, std::size_t k) const;

  const Mesh& mesh_;
  std::vector<SurfaceLookup> lookups_;
  std::vector<std::uint32_t> cell_element_;
};

}  // namespace unshot
