// Pictures of whole runs against those of pictures/, and the same picture from two providers of OpenGL.
//
// The reference pictures are drawn again when UNSHOT_RENEW_PICTURES is set (tests/README.md).
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace unshot {
namespace {

using testing_support::ProgramResult;
using testing_support::runProgram;
using testing_support::TempFolder;

namespace fs = std::filesystem;

// Of the light of the picture (nRMSE as `unshot compare` prints it). The same renderer draws the same bytes:
// 0. What another driver may change stays below 0.6 %: on the Cornell box, hemicubes of another size move the
// picture by 0.46 %, shots in another order by 0.53 %. What must be noticed lies above: 0.05 stops of
// exposure 2.4 %, a solve that ends at 5 % unshot 3.7 %, an eye 0.6 % farther away 7.5 %.
constexpr const char* kTolerance = "0.02";

// Two providers rasterise the same triangles, with the same Mesa to the last bit. A graphics card rounds
// otherwise at edges: less than other hemicubes would change.
constexpr const char* kProviderTolerance = "0.01";

struct GoldenPicture {
  const char* name;  ///< of pictures/NAME.png
  const char* scene;
  const char* display;
  const char* form_factors;
  bool follows_light = false;  ///< no number of elements is asked for
};

void PrintTo(const GoldenPicture& picture, std::ostream* out) { *out << picture.name; }

const fs::path kReferences = fs::path(UNSHOT_SOURCE_DIR) / "tests/golden/pictures";
// Beside the program; a folder NAME for each picture that failed.
const fs::path kFailures = fs::path(UNSHOT_PROGRAM).parent_path() / "picture_failures";

/// Solves and draws PROVIDER.png; returns the "gl" part of the run's report.
nlohmann::json draw(const TempFolder& folder, const GoldenPicture& picture, const std::string& provider) {
  const std::string scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/" + picture.scene + ".obj";
  std::vector<std::string> words = {"solve",          scene,
                                    "--form-factors", picture.form_factors,
                                    "--gl",           provider,
                                    "--size",         "480x360",
                                    "--display",      picture.display,
                                    "--png",          provider + ".png",
                                    "--report",       provider + ".json"};
  if (!picture.follows_light) words.insert(words.end(), {"--elements", "2000"});
  const ProgramResult run = runProgram(folder, words);
  EXPECT_EQ(run.code, 0) << run.err;
  if (run.code != 0) return {};
  return nlohmann::json::parse(folder.read(provider + ".json")).at("gl");
}

/// Compares two pictures; where they differ, they and their difference go to picture_failures/NAME.
void expectSame(const TempFolder& folder, const fs::path& picture, const fs::path& reference,
                const char* tolerance, const std::string& name) {
  const fs::path kept = kFailures / name;
  fs::remove_all(kept);
  const ProgramResult result = runProgram(folder, {"compare", picture.string(), reference.string(),
                                                   "--tolerance", tolerance, "--out", "difference.png"});
  if (result.code == 0) return;
  fs::create_directories(kept);
  const auto keep = [&](const fs::path& from, const char* as) {
    std::error_code missing;
    fs::copy_file(from, kept / as, missing);
  };
  keep(picture, "picture.png");
  keep(reference, "reference.png");
  keep(folder.path() / "difference.png", "difference.png");
  ADD_FAILURE() << result.out << result.err
                << "picture.png, reference.png and difference.png: " << kept.string();
}

class PictureTest : public testing::TestWithParam<GoldenPicture> {};

TEST_P(PictureTest, IsTheReference) {
  const GoldenPicture& golden = GetParam();
  const TempFolder folder;
  const nlohmann::json gl = draw(folder, golden, "osmesa");
  ASSERT_TRUE(gl.is_object());
  const fs::path reference = kReferences / (std::string(golden.name) + ".png");
  const std::string drawn_by =
      gl.at("renderer").get<std::string>() + ", OpenGL " + gl.at("version").get<std::string>();
  if (std::getenv("UNSHOT_RENEW_PICTURES")) {
    fs::copy_file(folder.path() / "osmesa.png", reference, fs::copy_options::overwrite_existing);
    GTEST_SKIP() << "renewed " << reference.string() << ", drawn by " << drawn_by;
  }
  SCOPED_TRACE("drawn by " + drawn_by + "; the reference's renderer stands in " +
               (kReferences / "README.md").string());
  expectSame(folder, folder.path() / "osmesa.png", reference, kTolerance, golden.name);
}

INSTANTIATE_TEST_SUITE_P(
    Golden, PictureTest,
    testing::Values(GoldenPicture{"cornell_box", "cornell_box", "radiosity", "hemicube"},
                    GoldenPicture{"cornell_box_flat", "cornell_box", "flat", "hemicube"},
                    GoldenPicture{"cornell_box_irradiance", "cornell_box", "irradiance", "hemicube"},
                    GoldenPicture{"cornell_box_mesh", "cornell_box", "mesh", "hemicube"},
                    GoldenPicture{"cornell_box_fine_mesh", "cornell_box", "mesh", "auto", true},
                    GoldenPicture{"two_patches", "two_patches", "radiosity", "auto"},
                    GoldenPicture{"furnace", "furnace", "radiosity", "auto"},
                    GoldenPicture{"two_rooms", "two_rooms", "radiosity", "hemicube"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(PictureProviders, OsmesaAndEglDrawTheSameSolve) {
  const TempFolder folder;
  const GoldenPicture cornell_box{"", "cornell_box", "radiosity", "hemicube"};
  for (const char* provider : {"osmesa", "egl"}) {
    const nlohmann::json gl = draw(folder, cornell_box, provider);
    ASSERT_TRUE(gl.is_object());
    EXPECT_EQ(gl.at("provider"), provider);
    EXPECT_NE(gl.at("renderer"), "");
  }
  expectSame(folder, folder.path() / "egl.png", folder.path() / "osmesa.png", kProviderTolerance,
             "osmesa_and_egl");
}

}  // namespace
}  // namespace unshot
