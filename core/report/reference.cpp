#include "report/reference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <thread>

#include "base/clock.h"
#include "base/random.h"
#include "base/text.h"
#include "report/path_tracer.h"

namespace unshot {
namespace {

// Before that many batches the standard error is not trusted to end the work.
constexpr std::uint64_t kLeastBatches = 16;
constexpr double kMedianOfNoise = 2;
// So that limits and progress are looked at soon by every thread.
constexpr std::uint64_t kMostBatchesInARound = 32;

/// Sums of one point over its batches, of H [W/m^2] (B. P. Welford, 1962).
struct Tally {
  std::uint64_t batches = 0;
  glm::dvec3 mean{0.0};
  glm::dvec3 square_deviations{0.0};

  void add(const glm::dvec3& h) {
    ++batches;
    const glm::dvec3 before = h - mean;
    mean += before / static_cast<double>(batches);
    square_deviations += before * (h - mean);
  }
};

class Tracing {
 public:
  Tracing(const Scene& scene, const ReferenceOptions& options, Reference& reference)
      : options_(options),
        origin_(scene.frame_origin),
        tracer_(scene, options.emit_front_only, options.sky),
        points_(reference.points),
        tallies_(points_.size()),
        start_(wallSeconds()) {
    for (std::size_t k = 0; k < points_.size(); ++k) recall(points_[k], tallies_[k]);
    const unsigned machine = std::max(1u, std::thread::hardware_concurrency());
    threads_ = options.threads > 0 ? options.threads : machine;
  }

  enum class Ending { kNone, kReached, kMaxSamples, kMaxSeconds, kInterrupted };

  Ending run() {
    for (;;) {
      const std::uint64_t done = leastBatches();
      // A few bright points are soon good enough for the whole; the others are to be of use too.
      noise_ = std::max(noiseOf(points_), medianNoiseOf(points_) / kMedianOfNoise);
      if (done >= kLeastBatches && noise_ <= options_.relative_error) return Ending::kReached;
      if (done * kPathsPerBatch >= options_.max_samples) return Ending::kMaxSamples;
      traceUntil(std::min(done < 2 ? 2 : 2 * done, done + kMostBatchesInARound));
      for (std::size_t k = 0; k < points_.size(); ++k) conclude(tallies_[k], points_[k]);
      if (stop_ != Ending::kNone) return stop_;
    }
  }

 private:
  /// Tally of a point that was traced before.
  static void recall(const ReferencePoint& point, Tally& tally) {
    tally.batches = point.samples / kPathsPerBatch;
    if (tally.batches == 0) return;
    const double n = static_cast<double>(tally.batches);
    for (int c = 0; c < 3; ++c) {
      if (point.reflectance[c] == 0) continue;
      tally.mean[c] = point.reflected()[c] / point.reflectance[c];
      if (tally.batches < 2) continue;
      const double error = point.standard_error[c] / point.reflectance[c];
      tally.square_deviations[c] = error * error * n * (n - 1);
    }
  }

  static void conclude(const Tally& tally, ReferencePoint& point) {
    point.samples = tally.batches * kPathsPerBatch;
    point.radiosity = point.emission + point.reflectance * tally.mean;
    const double n = static_cast<double>(tally.batches);
    point.standard_error = tally.batches < 2
                               ? glm::dvec3(INFINITY)
                               : point.reflectance * glm::sqrt(tally.square_deviations / (n * (n - 1)));
  }

  std::uint64_t leastBatches() const {
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    for (const Tally& tally : tallies_) least = std::min(least, tally.batches);
    return tallies_.empty() ? 0 : least;
  }

  /// Adds batches to every point that has fewer, on all threads. Each point's own come in order, whoever
  /// traces them.
  void traceUntil(std::uint64_t target) {
    next_ = 0;
    std::vector<std::jthread> helpers;
    try {
      for (unsigned k = 1; k < std::min<std::size_t>(threads_, points_.size()); ++k) {
        helpers.emplace_back([&] { tracePoints(target, false); });
      }
      tracePoints(target, true);
    } catch (...) {
      stop_ = Ending::kInterrupted;
      throw;
    }
  }

  void tracePoints(std::uint64_t target, bool calling_thread) {
    for (std::size_t k = next_++; k < points_.size(); k = next_++) {
      Tally& tally = tallies_[k];
      const glm::dvec3 position = points_[k].position - origin_;
      while (tally.batches < target) {
        const double now = wallSeconds();
        if (options_.max_seconds && now - start_ >= *options_.max_seconds) stop_ = Ending::kMaxSeconds;
        if (calling_thread) tellProgress(now, target, k);
        if (stop_ != Ending::kNone) return;
        tally.add(tracer_.irradiance(position, points_[k].normal, mixBits(options_.seed) + k, tally.batches));
      }
    }
  }

  void tellProgress(double now, std::uint64_t target, std::size_t point) {
    if (!options_.progress || now - told_ < 0.05) return;
    told_ = now;
    const double round = static_cast<double>(point) / static_cast<double>(points_.size());
    double done = round * static_cast<double>(target * kPathsPerBatch) /
                  static_cast<double>(std::max<std::uint64_t>(options_.max_samples, 1));
    if (options_.max_seconds) done = std::max(done, (now - start_) / *options_.max_seconds);
    // Errors fall with the root of the work.
    if (std::isfinite(noise_) && noise_ > 0)
      done = std::max(done, options_.relative_error * options_.relative_error / (noise_ * noise_));
    fraction_ = std::max(fraction_, std::min(done, 1.0));
    if (!options_.progress(fraction_)) stop_ = Ending::kInterrupted;
  }

  const ReferenceOptions& options_;
  glm::dvec3 origin_;
  PathTracer tracer_;
  std::vector<ReferencePoint>& points_;
  std::vector<Tally> tallies_;
  double start_ = 0, told_ = 0, noise_ = INFINITY, fraction_ = 0;
  unsigned threads_ = 1;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<Ending> stop_ = Ending::kNone;
};

void sayHowItEnded(Tracing::Ending ending, const ReferenceOptions& options, Reference& reference) {
  using Ending = Tracing::Ending;
  if (reference.points.size() < options.points && options.places.empty()) {
    reference.diagnostics.push_back({Severity::kNote,
                                     "reference-points",
                                     "the reference has " + countedText(reference.points.size(), "point") +
                                         " of " + countText(options.points) +
                                         ": light reaches too little of the surfaces' area for more",
                                     {},
                                     {}});
  }
  if (ending == Ending::kReached) return;
  const char* limit = ending == Ending::kMaxSamples   ? "its limit of paths"
                      : ending == Ending::kMaxSeconds ? "its limit of time"
                                                      : "an interruption";
  const double noise = noiseOf(reference.points), median = medianNoiseOf(reference.points);
  reference.diagnostics.push_back(
      {Severity::kWarning,
       "reference-noise",
       "the reference was ended by " + std::string(limit) + " with " +
           (std::isfinite(noise) ? "a standard error of " + percentText(noise) + " (of the median point " +
                                       percentText(median) + ")"
                                 : "no standard error yet") +
           "; asked for: " + percentText(options.relative_error) + " (and " +
           percentText(kMedianOfNoise * options.relative_error) + ")",
       {},
       "more time"});
}

}  // namespace

double noiseOf(std::span<const ReferencePoint> points) {
  double error = 0, total = 0;
  for (const ReferencePoint& point : points) {
    error += glm::dot(point.standard_error, point.standard_error);
    total += glm::dot(point.reflected(), point.reflected());
  }
  if (error == 0) return 0;
  return total > 0 && std::isfinite(error) ? std::sqrt(error / total) : INFINITY;
}

double medianNoiseOf(std::span<const ReferencePoint> points) {
  std::vector<double> noise;
  for (const ReferencePoint& point : points) {
    const double error = glm::length(point.standard_error), reflected = glm::length(point.reflected());
    if (!std::isfinite(error)) return INFINITY;
    if (reflected > 0) noise.push_back(error / reflected);
  }
  if (noise.empty()) return 0;
  const auto middle = noise.begin() + static_cast<std::ptrdiff_t>(noise.size() / 2);
  std::nth_element(noise.begin(), middle, noise.end());
  return *middle;
}

Reference traceReference(const Scene& scene, const ReferenceOptions& options) {
  const double start = wallSeconds();
  Reference reference;
  reference.points = chooseReferencePoints(scene, options);
  reference.seconds = wallSeconds() - start;
  continueReference(scene, options, reference);
  return reference;
}

void continueReference(const Scene& scene, const ReferenceOptions& options, Reference& reference) {
  const double start = wallSeconds();
  reference.diagnostics.clear();
  reference.from_file = false;
  const Tracing::Ending ending = Tracing(scene, options, reference).run();
  reference.seconds += wallSeconds() - start;
  sayHowItEnded(ending, options, reference);
}

}  // namespace unshot
