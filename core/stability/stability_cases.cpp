#include "stability/stability_cases.h"

#include "stability/stability_rows.h"

namespace unshot {

std::span<const StabilityCase> stabilityCases() {
  static const Cases table = [] {
    Cases cases;
    addFurnaces(cases);
    addChannels(cases);
    addManufactured(cases);
    addPlaces(cases);
    addEmissions(cases);
    addFarAndNear(cases);
    addEnds(cases);
    return cases;
  }();
  return table;
}

}  // namespace unshot
