// Minimal residual: GMRES in a form that has the solution at hand after every sweep (minimal_residual.h);
// each sweep's direction is what is unshot. Asks nothing of K.
#include "solver/first_pass.h"
#include "solver/minimal_residual.h"
#include "solver/modes.h"

namespace unshot {
namespace {

class Gmres final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    if (first_pass_.step(state, transport)) return 1;
    if (!product_.running()) {
      if (state.onlyRoundingUnshot()) return std::nullopt;
      product_.begin(transport, state.unshot());
    }
    const std::size_t used = product_.advance(transport);
    if (!product_.running()) minimal_.apply(state, transport, std::move(product_.flow()));
    return used;
  }

  std::size_t bytes() const override { return minimal_.bytes(); }

 private:
  FirstPass first_pass_;
  TransportProduct product_;
  MinimalResidual minimal_;
};

}  // namespace

std::unique_ptr<IterationMode> makeGmres() { return std::make_unique<Gmres>(); }

}  // namespace unshot
