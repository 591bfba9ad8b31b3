// A driver that is reset: no software renderer here does that, so its answer is put in its place.
#include <gmock/gmock.h>

#include "gui/support/own_folder.h"
#include "session/saved_solve.h"
#include "support/live_viewer.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing_support::LiveViewer;

constexpr GLenum kLost = 0x0507;  // GL_CONTEXT_LOST

class ContextLoss : public testing_support::InOwnFolder {
 protected:
  static LiveViewer::Options cornellBox() {
    LiveViewer::Options options;
    options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
    options.solve.elements = 300;
    options.solve.form_factors = "hemicube";
    options.solve.error = 1e-6;
    return options;
  }
};

/// From now on the driver answers that it was reset.
void lose(const gl::Functions& fn) {
  const_cast<gl::Functions&>(fn).GetError = []() -> GLenum { return kLost; };
}

TEST_F(ContextLoss, OfTheWindowLosesNothingOfTheSolve) {
  std::optional<Error> told;
  std::uint64_t shots = 0;
  {
    LiveViewer live(cornellBox());
    ASSERT_TRUE(live.until([&] { return live->state().measures.shots > 20; }));
    lose(live.fn());
    try {
      live->input();
      live.until([] { return false; }, 60);
    } catch (const Error& error) {
      shots = live->state().measures.shots;
      told = live->rescue(error);
    }
  }
  ASSERT_TRUE(told) << "went on in the dark";
  EXPECT_EQ(told->kind(), ErrorKind::kEnvironment);
  EXPECT_THAT(told->what(), HasSubstr("was reset"));
  EXPECT_THAT(told->advice(), HasSubstr("--resume"));
  ASSERT_TRUE(folder_.has("unshot-cornell_box-001.unshot"));
  EXPECT_THAT(told->advice(), HasSubstr("unshot-cornell_box-001.unshot"));
  EXPECT_GE(readSavedSolve("unshot-cornell_box-001.unshot")->shots, shots);
}

TEST_F(ContextLoss, OfTheSolverEndsTheSolveWithWhatItHasAndIsSaid) {
  LiveViewer live(cornellBox());
  ASSERT_TRUE(live.until([&] { return live->state().measures.shots > 20; }));
  lose(live.solverFunctions());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kFailed));
  ASSERT_TRUE(live->error());
  EXPECT_THAT(live->error()->fullText(), HasSubstr("was reset"));
  const std::uint64_t shots = live->state().measures.shots;
  live->perform("save-solve", "kept.unshot");
  ASSERT_TRUE(live.until([&] { return live->state().saves == 1; }));
  EXPECT_EQ(readSavedSolve("kept.unshot")->shots, shots);
  // Without drawing it goes on.
  live->perform("form-factors", "rays");
  EXPECT_TRUE(live.untilPhase(SessionPhase::kConverged));
}

}  // namespace
}  // namespace unshot
