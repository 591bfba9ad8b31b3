// When a solve closes the rows of its form factors (formfactor/closure.h): where they are at points, once all
// columns are known, as far as what escapes is known too. A closed scene shows itself by columns of which
// nothing escapes; in others what escapes is looked for only where much is reflected.
#include "base/text.h"
#include "formfactor/sky.h"
#include "session/solve_impl.h"

namespace unshot {
namespace {

// Reflection gains (reflectionGain) below which an error of the rows counts for less than what it takes to
// mend it: in a closed scene, and in another.
constexpr double kClosedGain = 1, kOpenGain = 4;
// What an exact form factor lacks to 1 at most where nothing escapes.
constexpr double kExactRounding = 1e-6;
// Of the columns: in a closed scene so many at least are there when the rest are computed for it. With fewer
// (many small patches that matter little) that takes longer than all before.
constexpr double kMostAreThere = 2.0 / 3;
// Row sums are off by more than this before a word is said.
constexpr double kWorthAWord = 0.002;

}  // namespace

void Solve::Impl::planClosure(const CancelToken& cancel) {
  const Receivers& receivers = transport->receivers();
  const double gain = reflectionGain(*mesh);
  high_gain = gain >= kOpenGain;
  const bool exact = form_factors_key == "closed-form";
  closure_pending = receivers.kind == ReceiverKind::kVertices && (!exact || receivers.layered()) &&
                    !options.bounces && gain >= kClosedGain;
  // The sky is a source of its own, which holds what would escape.
  if (!closure_pending || !high_gain || exact || sky != glm::dvec3(0.0)) return;
  escape.assign(receivers.size(), 0.0f);
  if (mesh->closed) return;
  const SkySource openings = lookAtSky(*mesh, receivers, options.seed, cancel);
  openings.column.forEach([&](std::uint32_t v, double k) { escape[v] = static_cast<float>(k); });
}

// A patch sends so much of its light out of the scene, in which rows can be closed only where it is known
// from where.
void Solve::Impl::noteOpening(double escapes) {
  const bool exact = form_factors_key == "closed-form";
  const bool known = sky != glm::dvec3(0.0) || (exact ? escapes < kExactRounding : !escape.empty());
  if (!known) closure_pending = false;
}

// Whether nothing but columns that were not asked for stands before it.
bool Solve::Impl::closureIsDue() const { return closure_pending && transport->missingRoom() == 0; }

bool Solve::Impl::closeRows() {
  if (!closureIsDue()) return false;
  if (transport->count(ColumnQuality::kFull) < transport->patchCount() ||
      transport->keptColumns() < transport->patchCount()) {
    // All were asked for, and some do not come.
    if (next_column == transport->patchCount() && transport->draftCount() == 0) closure_pending = false;
    return false;
  }
  closure_pending = false;
  RowClosure closure = form_factors_key == "closed-form" ? closeExactRows(*mesh, *transport)
                                                         : unshot::closeRows(*mesh, *transport, escape);
  if (closure.rms_defect > kWorthAWord)
    diagnostics.push_back({Severity::kNote,
                           "rows-closed",
                           "what vertices see summed to 1 within " + figureText(100 * closure.rms_defect) +
                               " % (RMS): form factors were scaled so that it does",
                           {},
                           {}});
  mode.reset();
  transport->setClosure(std::move(closure));
  state->renew(*transport);
  return true;
}

// Where much is reflected and each patch has shot about once: what is shot along rows that are open goes to
// waste. Elsewhere they wait for the end.
bool Solve::Impl::closureIsUrgent() {
  if (!closureIsDue()) return false;
  const bool reached = measures.solverBound() <= target();
  const double known = static_cast<double>(transport->count(ColumnQuality::kFull));
  if (reached && !high_gain && !closure_hurries && form_factors_key != "closed-form" &&
      known < kMostAreThere * static_cast<double>(transport->patchCount()))
    closure_pending = false;
  return closure_pending &&
         (reached || closure_hurries || (high_gain && measures.shots > transport->patchCount()));
}

}  // namespace unshot
