// Each decision of the plan, on and off, on the scenes that take minutes: the library that comes with the
// program, and those under $UNSHOT_SCENES, passed over where it is not set.
#include "support/plan_proof.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "scene/obj_reader.h"
#include "support/assets.h"

namespace unshot {
namespace {

using namespace testing_support;

struct LongProof {
  std::string name;
  std::filesystem::path file;  // in $UNSHOT_SCENES, or with its whole path
  double error;                // to be asked for
  double seconds;              // of each solve at most
};

class LongPlanProof : public testing::TestWithParam<LongProof> {};

TEST_P(LongPlanProof, WithinTheErrorOfBoth) {
  const LongProof& row = GetParam();
  const char* folder = std::getenv("UNSHOT_SCENES");
  if (!folder && row.file.is_relative()) GTEST_SKIP() << "UNSHOT_SCENES is not set";
  const std::filesystem::path file = row.file.is_relative() ? folder / row.file : row.file;
  expectWithinTheErrorOfBoth({row.name, [&] { return readObj(file); }, row.error, row.seconds});
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, LongPlanProof,
    testing::Values(LongProof{"library", asset("library.obj"), 0.3, 30},
                    LongProof{"cornell_published", "cornell_published/cornell_published.obj", 0.05, 60},
                    LongProof{"cornell_original", "mcguire_cornell/CornellBox-Original.obj", 0.05, 60},
                    LongProof{"cornell_empty_white", "mcguire_cornell/CornellBox-Empty-White.obj", 0.05, 60},
                    LongProof{"cornell_sphere", "mcguire_cornell/CornellBox-Sphere.obj", 0.2, 60},
                    LongProof{"teapot_box", "teapot_box/teapot_box.obj", 0.1, 40},
                    LongProof{"holodeck", "holodeck/holodeck.obj", 0.3, 25},
                    LongProof{"lost_empire", "lost_empire/lost_empire.obj", 0.5, 35}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace unshot
