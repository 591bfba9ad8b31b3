#include "cli/saver.h"

#include <algorithm>
#include <iostream>

#include "base/clock.h"
#include "base/error.h"

namespace unshot {
namespace {

// Between two saves pass so many times as long as one takes.
constexpr double kRest = 20;

}  // namespace

Saver::Saver(std::filesystem::path path, double every)
    : path_(std::move(path)), every_(every), next_(wallSeconds() + every) {}

void Saver::offer(const Solve& solve) {
  if (path_.empty() || wallSeconds() < next_) return;
  try {
    save(solve);
  } catch (const Error& error) {
    std::cerr << "unshot: " << error.fullText() << "\n  the solve goes on, and is saved again later"
              << std::endl;
    next_ = wallSeconds() + every_;
  }
}

void Saver::save(const Solve& solve) {
  const double began = wallSeconds();
  solve.save(path_);
  const double ended = wallSeconds();
  next_ = ended + std::max(every_, kRest * (ended - began));
}

}  // namespace unshot
