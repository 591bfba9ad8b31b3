#include "session/saver.h"

#include <algorithm>

#include "base/clock.h"

namespace unshot {
namespace {

// Between two saves pass so many times as long as one takes.
constexpr double kRest = 20;

}  // namespace

Saver::Saver(std::filesystem::path path, double every)
    : path_(std::move(path)), every_(every), next_(wallSeconds() + every) {}

bool Saver::due(bool at_rest) const {
  return !path_.empty() && wallSeconds() >= (at_rest ? next_at_rest_ : next_);
}

std::optional<Error> Saver::offer(const Solve& solve, bool at_rest, const CancelToken& cancel) {
  if (!due(at_rest)) return std::nullopt;
  try {
    save(solve, cancel);
  } catch (const Cancelled&) {
    next_ = next_at_rest_ = wallSeconds() + every_;
  } catch (...) {
    next_ = next_at_rest_ = wallSeconds() + every_;
    return presentError();
  }
  return std::nullopt;
}

void Saver::save(const Solve& solve, const CancelToken& cancel) {
  const double began = wallSeconds();
  solve.save(path_, cancel);
  const double ended = wallSeconds();
  next_at_rest_ = ended + kRest * (ended - began);
  next_ = std::max(ended + every_, next_at_rest_);
}

}  // namespace unshot
