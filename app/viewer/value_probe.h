// What is shown in false colours, as a number: its value at the point of the scene that the mouse is over.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "render/display_modes.h"
#include "session/snapshot.h"

namespace unshot {

class ValueProbe {
 public:
  struct Look {
    std::shared_ptr<const Snapshot> snapshot;
    Quantity quantity = Quantity::kRadiosity;
    bool ambient = false;              ///< radiosity with the ambient term
    glm::dvec3 from{0.0}, along{0.0};  ///< the sight, in the mesh's frame
    bool operator==(const Look&) const = default;
  };

  /// Quantities that have values at points.
  static bool reads(Quantity quantity);

  /// Looks anew where anything is other than the last time; takes a few milliseconds with 100,000 triangles,
  /// and with many more finds nothing.
  void look(const Look& look);
  void rest();
  /// In the legend's unit without a factor, luminance of the channels; nothing where nothing is known.
  const std::optional<double>& value() const { return value_; }

 private:
  std::optional<Look> looked_;
  std::optional<double> value_;
};

}  // namespace unshot
