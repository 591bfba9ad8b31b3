// Work beside the window, on a thread of its own: how far it is, and its result once it is there.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/clock.h"

namespace unshot {

/// Belongs to the main thread, as all its members do. What `Work` needs it holds by value.
template <class Result>
class Background {
 public:
  using Work = std::function<Result(const CancelToken& cancel)>;

  /// Begins. `wake` (may be empty) is called on the thread once the result is there.
  Background(Work work, std::function<void()> wake)
      : told_([this](double done) { done_ = done; }), result_(promise_.get_future()) {
    thread_ = std::thread([this, work = std::move(work), wake = std::move(wake)] {
      try {
        promise_.set_value(work(CancelToken(given_up_, &told_)));
      } catch (...) {
        promise_.set_exception(std::current_exception());
      }
      if (wake) wake();
    });
  }
  /// Gives it up and waits for its next look at that.
  ~Background() {
    giveUp();
    thread_.join();
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Asks it to end.
  void giveUp() { given_up_ = true; }
  bool givenUp() const { return given_up_; }
  /// How much is done, from 0 to 1; none where that is not known.
  std::optional<double> done() const {
    const double done = done_;
    return done < 0 ? std::nullopt : std::optional(done);
  }
  bool ready() const { return result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
  /// Once, waits where it is not ready. Throws what the work has thrown, such as Cancelled.
  Result take() { return result_.get(); }

 private:
  std::atomic<bool> given_up_{false};
  std::atomic<double> done_{-1};
  CancelToken::Told told_;
  std::promise<Result> promise_;
  std::future<Result> result_;
  std::thread thread_;
};

/// A file that is read beside the window; another one takes its place.
template <class Result>
class FileLoad {
 public:
  /// Begins; what is under way is given up.
  void begin(std::filesystem::path file, typename Background<Result>::Work work, std::function<void()> wake) {
    giveUp();
    file_ = std::move(file);
    began_ = wallSeconds();
    job_ = std::make_unique<Background<Result>>(std::move(work), std::move(wake));
  }
  bool underWay() const { return job_ != nullptr; }
  /// Does not wait for its end.
  void giveUp() {
    std::erase_if(given_up_, [](const auto& job) { return job->ready(); });
    if (!job_) return;
    job_->giveUp();
    given_up_.push_back(std::move(job_));
  }
  /// The result, once; none where there is none yet. Throws what the work has thrown.
  std::optional<Result> take() {
    if (!job_ || !job_->ready()) return std::nullopt;
    return std::exchange(job_, nullptr)->take();
  }
  const std::filesystem::path& file() const { return file_; }
  double began() const { return began_; }
  std::optional<double> done() const { return job_ ? job_->done() : std::nullopt; }

 private:
  std::filesystem::path file_;
  double began_ = 0;
  std::unique_ptr<Background<Result>> job_;
  std::vector<std::unique_ptr<Background<Result>>> given_up_;  // that have not noticed yet
};

}  // namespace unshot
