// Patches that need not shoot, since they are black or their light does not matter to the error asked for:
// said at the end of a solve, when it shows which they are; their columns are computed all the same where
// asked for.
#include "session/solve_impl.h"

namespace unshot {

// Where asked for, all columns come before the first shot, which would not ask for some of them.
bool Solve::Impl::computeIdle() {
  if (leavesOut(options.do_anyway, plan_keys::kShooters)) return false;
  while (next_idle < mesh->patch_count && transport->quality(next_idle)) ++next_idle;
  if (next_idle >= mesh->patch_count) return false;
  transport->column(next_idle++);
  return true;
}

// Which patches have to shoot shows at the end.
void Solve::Impl::sayIdle() {
  std::erase_if(plan, [](const PlanDecision& d) { return d.key == plan_keys::kShooters; });
  if (progress_state != SolveState::kConverged) return;
  IdleShooters shooters{.patches = mesh->patch_count, .unshot_fraction = measures.unshot_fraction};
  for (std::uint32_t q = 0; q < mesh->patch_count; ++q) {
    if (transport->quality(q)) continue;
    shooters.idle.push_back(q);
    shooters.black += state->reflectance()[q] == glm::dvec3(0.0) && !mesh->emits(q);
  }
  if (!shooters.idle.empty()) plan.push_back(withoutShooters(std::move(shooters), options.error));
}

}  // namespace unshot
