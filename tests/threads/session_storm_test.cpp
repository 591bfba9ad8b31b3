// Commands from several threads at random, and closing at any moment.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "solver/modes.h"
#include "support/dice.h"
#include "support/temp_folder.h"
#include "threads/session_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

const char* const kScenes[] = {"furnace.obj", "two_patches.obj", "cornell_box.obj", "missing.obj"};

// Of the scene that is there now, or of another: materials are lit, painted, and wrong at times.
void editSomething(Session& session, Dice& dice) {
  std::vector<Material> materials;
  if (const StatePointer state = session.latest(); state->snapshot)
    materials = state->snapshot->mesh->materials;
  if (materials.empty() || dice.below(10) == 0) materials.emplace_back();
  Material& m = materials[dice.below(static_cast<std::uint32_t>(materials.size()))];
  if (dice.below(2) == 0)
    m.reflectance = {dice.between(-0.02, 1), dice.between(0, 1), dice.between(0, 1.02)};
  else
    m.emission = dice.below(3) == 0 ? glm::dvec3(0.0) : glm::dvec3(dice.between(0, 20));
  session.edit(std::move(materials));
}

void sendSomething(Session& session, Dice& dice) {
  const std::uint32_t kind = dice.below(30);
  if (kind < 2) {
    session.open(asset(kScenes[dice.below(4)]), closedForm(20 + dice.below(60), dice.between(0, 0.1)));
  } else if (kind < 3) {
    session.restart(closedForm(20 + dice.below(60), dice.between(-0.05, 0.1)));
  } else if (kind < 7) {
    session.pause();
  } else if (kind < 11) {
    session.resume();
  } else if (kind < 15) {
    session.step(dice.below(5));
  } else if (kind < 17) {
    const std::uint32_t mode = dice.below(static_cast<std::uint32_t>(iterationModes().size()) + 1);
    session.setMode(mode < iterationModes().size() ? std::string(iterationModes()[mode].info.key) : "none");
  } else if (kind < 19) {
    session.setError(dice.between(-0.01, 0.1));
  } else if (kind < 21) {
    session.completeBounces();
  } else if (kind < 23) {
    session.shootAgain();
  } else if (kind < 24) {
    session.race(std::string(iterationModes()[dice.below(2)].info.key));
  } else if (kind < 25) {
    session.endRace();
  } else if (kind < 29) {
    editSomething(session, dice);
  } else {
    session.setPublishInterval(dice.between(0, 0.1));
  }
}

/// `count` random commands from each of `threads` threads, which also look at the session all the time.
void storm(SessionWatch& watch, std::uint64_t seed, int threads, int count) {
  std::vector<std::thread> senders;
  for (int t = 0; t < threads; ++t) {
    senders.emplace_back([&watch, seed, t, count] {
      Dice dice(seed * 1000 + static_cast<std::uint64_t>(t));
      std::uint64_t version = 0;
      for (int k = 0; k < count; ++k) {
        sendSomething(*watch.operator->(), dice);
        const StatePointer state = watch->latest();
        EXPECT_GE(state->version, version);
        EXPECT_LE(state->commands, watch->sent());
        version = state->version;
      }
    });
  }
  for (std::thread& sender : senders) sender.join();
}

TEST(SessionStorm, LeavesASessionThatSolvesAsEver) {
  const SolveOptions options = closedForm(60, 1e-4);
  const Snapshot expected = plainSolve(asset("cornell_box.obj"), options)->snapshot();
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SessionWatch watch;
    storm(watch, seed, 4, 40);
    const StatePointer calm = watch.carriedOut();
    EXPECT_EQ(calm->commands, watch->sent());
    watch->open(asset("cornell_box.obj"), options);
    watch->resume();
    const StatePointer end = watch.rested();
    ASSERT_EQ(end->phase, SessionPhase::kConverged) << "seed " << seed;
    EXPECT_LE(relativeDifference(end->snapshot->irradiance, expected.irradiance), 1e-12) << "seed " << seed;
    watch.close();
    checkPublications(watch.seen());
  }
}

TEST(SessionStorm, ASessionClosesInTheMiddleOfIt) {
  for (std::uint64_t seed = 101; seed <= 120; ++seed) {
    SessionWatch watch;
    storm(watch, seed, 3, 10);
    watch.close();
    checkPublications(watch.seen());
  }
}

// Whatever is published, a session may be closed right then: while reading, while meshing, before the first
// shot, during it, and after any other.
TEST(SessionStorm, ClosesAtEveryMoment) {
  for (const char* scene : {"furnace.obj", "two_patches.obj", "cornell_box.obj", "missing.obj"}) {
    for (std::uint64_t version = 0; version <= 8; ++version) {
      SessionWatch watch;
      watch->open(asset(scene), endless(200));
      watch->step(2);
      watch->step(1);
      watch->resume();
      // A scene that is missing is soon done with: two publications, and those of the other commands; the
      // furnace converges in the end.
      const std::uint64_t last = std::string(scene) == "missing.obj" ? 5 : 7;
      watch.wait("publication", [&](const SessionState& s) { return s.version >= std::min(version, last); });
      watch.close();
      checkPublications(watch.seen());
    }
  }
}

TEST(SessionStorm, AStateOutlivesItsSession) {
  StatePointer state;
  {
    SessionWatch watch;
    watch->open(asset("two_patches.obj"), closedForm(60, 0.01));
    state = watch.rested();
  }
  EXPECT_EQ(state->phase, SessionPhase::kConverged);
  EXPECT_EQ(state->snapshot->irradiance.size(), state->snapshot->mesh->vertices.size());
}

// Commands sent from the wake call itself, on the solver thread.
TEST(SessionStorm, WakeMaySendCommands) {
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  Session* session = nullptr;
  std::uint64_t shots = 0;
  Session owner({nullptr, [&] {
                   const StatePointer state = session->latest();
                   if (state->phase == SessionPhase::kPaused && state->measures.shots < 10) session->step(1);
                   const std::lock_guard lock(mutex);
                   shots = state->measures.shots;
                   done = state->phase == SessionPhase::kPaused && shots >= 10;
                   changed.notify_all();
                 }});
  session = &owner;
  owner.open(asset("cornell_box.obj"), endless(100));
  owner.pause();
  std::unique_lock lock(mutex);
  EXPECT_TRUE(changed.wait_for(lock, std::chrono::minutes(2), [&] { return done; }));
  EXPECT_GE(shots, 10u);
}

}  // namespace
}  // namespace unshot
