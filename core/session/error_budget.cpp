#include "session/error_budget.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"

namespace unshot {
namespace {

// Of all light: what patches send whose columns the matrix lacks, for errors to be carried by it all the
// same.
constexpr double kLacked = 0.05;

// Share of the solver's work that goes into bounds beyond the passes over patches that each step has anyway.
constexpr double kShare = 0.05;
// An operation is one entry of the matrix times a colour, some two nanoseconds. A column of K takes this many
// to compute (1 to 2 ms; a draft of one picture a quarter of a millisecond), and a shot along one at hand
// that many for each entry of its patch column (it has as many receivers on a patch, and is summed up on the
// way).
constexpr double kColumnWork = 300'000, kDraftWork = 50'000, kShotWork = 45;
// Products of a sharpening: on the way no more than this share of what may be spent pays for, but the fewest;
// at the end all.
constexpr int kFewestProducts = 2, kMostProducts = 8;
constexpr double kSpent = 0.25;
// What a refresh costs in products, before and after all columns are known.
constexpr double kTotalRefresh = 5, kWholeRefresh = 18;
constexpr int kMostRefreshes = 50;
// Between refreshes for nothing but their gain.
constexpr int kSharpenings = 3;
// Weights are lowered again when this share more of the columns is known.
constexpr double kNews = 0.03;

// Adds the time of a scope.
class Timed {
 public:
  explicit Timed(double& seconds) : seconds_(seconds) {}
  ~Timed() { seconds_ += wallSeconds() - began_; }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& seconds_;
  double began_ = wallSeconds();
};

}  // namespace

ErrorBudget::ErrorBudget(const Mesh& mesh, const Transport& transport, const RadiosityState& state,
                         std::size_t matrix_bytes, bool occlusion, std::uint64_t seed)
    : mesh_(mesh),
      transport_(transport),
      state_(state),
      occlusion_(occlusion),
      seed_(seed),
      matrix_(transport.receivers(), transport.patchArea(), matrix_bytes),
      bounds_(matrix_, state) {}

void ErrorBudget::columnComputed(std::uint32_t q, const Column& column) {
  const Timed timed(seconds_);
  matrix_.set(q, column);
  bounds_.columnChanged(q);
  if (!column.at_hand)
    credit_ += kShare * (column.quality == ColumnQuality::kFull ? kColumnWork : kDraftWork);
}

void ErrorBudget::restart() {
  shots_ = 0;
  now_ = bounds_.at();
}

const SolverBounds& ErrorBudget::update(std::uint64_t shots) {
  const Timed timed(seconds_);
  const auto entries = static_cast<double>(matrix_.entryCount());
  const double columns = std::max(1.0, static_cast<double>(matrix_.knownCount()));
  credit_ += kShare * kShotWork * static_cast<double>(shots - shots_) * entries / columns;
  shots_ = shots;
  now_ = bounds_.at();
  double cost = (kFewestProducts + 0.2) * entries;
  if (credit_ < cost) return now_;
  const bool known_more = static_cast<double>(matrix_.knownCount()) >=
                          static_cast<double>(refreshed_count_) + kNews * static_cast<double>(matrix_.size());
  const bool rested = refreshed_version_ != matrix_.version() && matrix_.version() == last_version_;
  last_version_ = matrix_.version();
  if (known_more || rested ||
      (gains_ && refreshed_version_ == matrix_.version() &&
       (sharpenings_ >= kSharpenings || !bounds_.comparable()))) {
    cost = (bounds_.complete() ? kWholeRefresh : kTotalRefresh) * entries;
    if (credit_ < cost) return now_;
    gains_ = bounds_.refresh();
    refreshed_count_ = matrix_.knownCount();
    refreshed_version_ = matrix_.version();
    sharpenings_ = 0;
    credit_ -= cost;
    now_ = bounds_.at();
    cost = (kFewestProducts + 0.2) * entries;
    if (credit_ < cost) return now_;
  }
  if (bounds_.comparable()) {
    const double affordable =
        std::clamp(kSpent * credit_ / entries, double{kFewestProducts}, double{kMostProducts});
    const int products = static_cast<int>(affordable);
    now_ = bounds_.sharpened(products);
    ++sharpenings_;
    cost = (products + 0.2) * entries;
  } else {
    return now_;
  }
  credit_ -= cost;
  return now_;
}

const SolverBounds& ErrorBudget::sharpen() {
  const Timed timed(seconds_);
  if (gains_ || refreshed_version_ != matrix_.version()) {
    for (int k = 0; k < kMostRefreshes && bounds_.refresh(); ++k) {
    }
    refreshed_count_ = matrix_.knownCount();
    refreshed_version_ = matrix_.version();
    gains_ = false;
  }
  now_ = bounds_.sharpened(kMostProducts);
  return now_;
}

const ErrorEstimates& ErrorBudget::estimate(std::size_t more_places, const MeshField& shown) {
  const Timed timed(seconds_);
  if (!residuals_) {
    residuals_.emplace(mesh_, transport_.receivers(), occlusion_, seed_);
    if (offered_.size() <= more_places) {
      more_places -= offered_.size();
      residuals_->restorePlaces(std::move(offered_));
    }
    offered_.clear();
  }
  residuals_->add(more_places, shown);
  estimates_ = residuals_->estimate(state_, matrix_, shown, matrixIsNearlyWhole());
  if (defects_version_ != matrix_.version()) {
    defects_ = matrix_.defects();
    defects_version_ = matrix_.version();
  }
  estimates_.defects = defects_;
  return estimates_;
}

bool ErrorBudget::matrixIsNearlyWhole() const {
  double all = 0, lacked = 0;
  for (std::uint32_t q = 0; q < matrix_.size(); ++q) {
    const glm::dvec3& s = state_.shot()[q];
    const double shot =
        matrix_.area(q) * (std::abs(s.x + state_.unshot()[q].x) + std::abs(s.y + state_.unshot()[q].y) +
                           std::abs(s.z + state_.unshot()[q].z));
    all += shot;
    if (!matrix_.knows(q)) lacked += shot;
  }
  return lacked <= kLacked * all;
}

void ErrorBudget::forgetPlaces() {
  offered_.clear();
  if (residuals_) residuals_->forgetPlaces();
}

std::vector<double> ErrorBudget::patchResiduals(const MeshField& shown) const {
  return residuals_ && residuals_->places() > 0 ? residuals_->patchResiduals(state_, shown)
                                                : std::vector<double>();
}

}  // namespace unshot
