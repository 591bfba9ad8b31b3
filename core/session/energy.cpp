#include "session/energy.h"

namespace unshot {

EnergyBalance energyOf(const Transport& transport, const RadiosityState& state) {
  EnergyBalance out;
  const Receivers& receivers = transport.receivers();
  for (std::size_t v = 0; v < receivers.size(); ++v) {
    const glm::dvec3 absorbed = receivers.area[v] * (1.0 - receivers.reflectance[v]) * state.irradiance()[v];
    out.absorbed += absorbed.x + absorbed.y + absorbed.z;
  }
  for (std::size_t q = 0; q < state.patchCount(); ++q) {
    const glm::dvec3 u = state.area()[q] * state.unshot()[q];
    out.unshot += u.x + u.y + u.z;
  }
  out.emitted = state.emittedPower();
  out.escaped = state.escapedPower();
  out.closure_defect = state.defectPower();
  return out;
}

}  // namespace unshot
