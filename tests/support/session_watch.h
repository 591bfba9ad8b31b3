// A session and all that it publishes. Waiting is waiting for a publication; each wait has an end, at which
// the test fails.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "session/session.h"

namespace unshot::testing_support {

using StatePointer = std::shared_ptr<const SessionState>;

/// One number for all of a snapshot's fields: another where any bit of them is another.
inline std::uint64_t fingerprint(const Snapshot& snapshot) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  const auto add = [&](const std::vector<glm::vec3>& field) {
    for (const glm::vec3& v : field) {
      for (int c = 0; c < 3; ++c) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &v[c], sizeof bits);
        hash = (hash ^ bits) * 0x100000001b3ull;
      }
    }
  };
  for (const auto* field :
       {&snapshot.irradiance, &snapshot.ambient, &snapshot.unshot, &snapshot.element_irradiance,
        snapshot.direct.get(), snapshot.element_direct.get()})
    add(*field);
  return hash;
}

class SessionWatch {
 public:
  /// A publication as its wake call found it.
  struct Seen {
    double at = 0;  ///< wallSeconds()
    StatePointer state;
    std::uint64_t fields = 0;  ///< fingerprint of the snapshot, 0 where there is none
  };

  explicit SessionWatch(gl::Context* gl = nullptr) {
    owned_ = std::make_unique<Session>(SessionSetup{gl, [this] { woken(); }});
    session_ = owned_.get();
  }
  ~SessionWatch() { close(); }

  Session* operator->() { return session_; }
  void close() { owned_.reset(); }

  /// The first state published, from now on or the present one, for which `is` holds; after two minutes the
  /// test fails and the present one is returned.
  StatePointer wait(const std::string& what, const std::function<bool(const SessionState&)>& is) {
    std::unique_lock lock(mutex_);
    std::size_t next = seen_.empty() ? 0 : seen_.size() - 1;
    StatePointer found;
    const bool in_time = published_.wait_for(lock, std::chrono::minutes(2), [&] {
      for (; next < seen_.size(); ++next) {
        if (!is(*seen_[next].state)) continue;
        found = seen_[next].state;
        return true;
      }
      return false;
    });
    if (in_time) return found;
    ADD_FAILURE() << "waited in vain: " << what;
    return seen_.empty() ? std::make_shared<const SessionState>() : seen_.back().state;
  }
  /// Opens a scene and waits until it is paused with nothing shot: the pause is sent while the scene is
  /// meshed, so that it cannot come late.
  StatePointer openPaused(const std::filesystem::path& scene, const SolveOptions& options) {
    const std::uint64_t before = session_->latest()->epoch;
    pause_while_meshing_ = true;
    session_->open(scene, options);
    return wait("a scene is paused", [before](const SessionState& s) {
      return s.epoch > before && s.phase == SessionPhase::kPaused;
    });
  }
  /// Waits until all commands sent by now are carried out.
  StatePointer carriedOut() {
    const std::uint64_t sent = session_->sent();
    return wait("commands carried out", [sent](const SessionState& s) { return s.commands >= sent; });
  }
  /// Waits for the end of the running: paused, converged, stopped or failed after all commands.
  StatePointer rested() {
    const std::uint64_t sent = session_->sent();
    return wait("the solve comes to rest", [sent](const SessionState& s) {
      return s.commands >= sent && s.phase != SessionPhase::kRunning && s.phase != SessionPhase::kLoading;
    });
  }

  std::vector<Seen> seen() const {
    const std::lock_guard lock(mutex_);
    return seen_;
  }

 private:
  // On the solver thread, so that no publication is missed.
  void woken() {
    Seen now{wallSeconds(), session_->latest(), 0};
    if (now.state->task.starts_with("meshing") && pause_while_meshing_.exchange(false)) session_->pause();
    if (now.state->snapshot) now.fields = fingerprint(*now.state->snapshot);
    const std::lock_guard lock(mutex_);
    seen_.push_back(std::move(now));
    published_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable published_;
  std::atomic<bool> pause_while_meshing_{false};
  std::vector<Seen> seen_;
  std::unique_ptr<Session> owned_;
  Session* session_ = nullptr;
};

/// What holds of any session at any moment, of all that was published.
inline void checkPublications(const std::vector<SessionWatch::Seen>& seen) {
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const SessionState& s = *seen[k].state;
    ASSERT_EQ(s.version, k + 1);
    ASSERT_EQ(s.problem.has_value(), s.problems > 0);
    ASSERT_EQ(s.phase == SessionPhase::kLoading, !s.task.empty() && !s.saving && !s.editing && !s.refining);
    ASSERT_EQ(s.facts == nullptr, s.epoch == 0);
    ASSERT_EQ(s.snapshot == nullptr, s.epoch == 0);
    if (k > 0) {
      const SessionState& before = *seen[k - 1].state;
      ASSERT_GE(s.commands, before.commands);
      ASSERT_GE(s.epoch, before.epoch);
      ASSERT_GE(s.problems, before.problems);
      ASSERT_TRUE(s.epoch > before.epoch || s.measures.shots >= before.measures.shots);
    }
    if (!s.snapshot) continue;
    ASSERT_EQ(fingerprint(*s.snapshot), seen[k].fields) << "a snapshot has changed after its publication";
    ASSERT_EQ(s.snapshot->mesh->element_count, s.facts->elements);
    ASSERT_EQ(s.snapshot->irradiance.size(), s.facts->vertices);
    ASSERT_LE(s.snapshot->measures.shots, s.measures.shots);
    const bool at_rest = s.phase != SessionPhase::kRunning && s.phase != SessionPhase::kLoading;
    if (at_rest && s.phase != SessionPhase::kFailed) {
      ASSERT_EQ(s.snapshot->measures.shots, s.measures.shots);
    }
    if (s.rival) {
      ASSERT_EQ(s.rival->snapshot->mesh, s.snapshot->mesh);
    }
    ASSERT_FALSE(s.history->empty());
    ASSERT_LE(s.history->back().measures.shots, s.measures.shots);
  }
}

}  // namespace unshot::testing_support
