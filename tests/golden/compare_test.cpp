// unshot compare: figures, the difference image, and exit code 6.
#include <gmock/gmock.h>

#include <glm/vec3.hpp>

#include "export/image_files.h"
#include "support/run_program.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing_support::ProgramResult;
using testing_support::runProgram;
using testing_support::TempFolder;

/// Two pictures of the same size: the second is 10 % brighter.
void writePictures(const TempFolder& folder) {
  ImageF a{8, 4, {}}, b{8, 4, {}};
  for (int k = 0; k < 8 * 4 * 3; ++k) {
    a.rgb.push_back(1.1f);
    b.rgb.push_back(1.0f);
  }
  writeHdr(folder / "a.hdr", a);
  writeHdr(folder / "b.hdr", b);
}

TEST(Compare, PicturesWithinAndBeyondTheTolerance) {
  const TempFolder folder;
  writePictures(folder);
  EXPECT_EQ(runProgram(folder, {"compare", "a.hdr", "b.hdr"}).code, 0);
  const ProgramResult within = runProgram(folder, {"compare", "a.hdr", "b.hdr", "--tolerance", "0.2"});
  EXPECT_EQ(within.code, 0);
  EXPECT_THAT(within.out, AllOf(HasSubstr("nRMSE"), HasSubstr("bias"), HasSubstr("32 pixels")));
  const ProgramResult beyond = runProgram(folder, {"compare", "a.hdr", "b.hdr", "--tolerance", "0.05"});
  EXPECT_EQ(beyond.code, 6);
  EXPECT_THAT(beyond.err, HasSubstr("above the tolerance of 5 %"));
  EXPECT_EQ(runProgram(folder, {"compare", "a.hdr", "a.hdr", "--tolerance", "0"}).code, 0);
}

TEST(Compare, WritesTheDifferenceWithItsScale) {
  const TempFolder folder;
  writePictures(folder);
  const ProgramResult result = runProgram(folder, {"compare", "a.hdr", "b.hdr", "--out", "d.png"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("yellow"));
  EXPECT_EQ(readImage(folder / "d.png").width, 8);
}

TEST(Compare, PngIsComparedAsLinearLight) {
  const TempFolder folder;
  writePng(folder / "a.png", {1, 1, {188, 188, 188}});  // half of white
  writePng(folder / "b.png", {1, 1, {255, 255, 255}});
  const ProgramResult result = runProgram(folder, {"compare", "a.png", "b.png"});
  EXPECT_THAT(result.out, HasSubstr("nRMSE           49.7 %"));
}

TEST(Compare, ProbesAgainstReferenceValuesOfReflectedLight) {
  const TempFolder folder;
  folder.write("a.csv", "x,y,z,nx,ny,nz,B_r,B_g,B_b\n0,0,0,0,1,0,2,2,2\n1,0,0,0,1,0,9,9,9\n0,0,1,0,1,0,,,\n");
  folder.write("b.csv",
               "# reference\nx,y,z,nx,ny,nz,E_r,E_g,E_b,B_r,B_g,B_b\n"
               "0,0,0,0,1,0,0,0,0,1,1,1\n1,0,0,0,1,0,8,8,8,80,80,80\n0,0,1,0,1,0,0,0,0,1,1,1\n");
  const ProgramResult result = runProgram(folder, {"compare", "a.csv", "b.csv"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("1 probe, 2 left out"), HasSubstr("1 on light sources"),
                                HasSubstr("1 without a value"), HasSubstr("100 %")));
}

TEST(Compare, SolutionsOnTheSameMesh) {
  const TempFolder folder;
  testing_support::writeRoom(folder);
  ASSERT_EQ(runProgram(folder, {"solve", "room.obj", "--elements", "100", "--ply", "a.ply"}).code, 0);
  ASSERT_EQ(
      runProgram(folder, {"solve", "room.obj", "--elements", "100", "--error", "1e-5", "--ply", "b.ply"})
          .code,
      0);
  ASSERT_EQ(runProgram(folder, {"solve", "room.obj", "--elements", "400", "--ply", "c.ply"}).code, 0);
  EXPECT_EQ(runProgram(folder, {"compare", "a.ply", "b.ply", "--tolerance", "0.05"}).code, 0);
  EXPECT_EQ(runProgram(folder, {"compare", "a.ply", "b.ply", "--tolerance", "0"}).code, 6);
  const ProgramResult other = runProgram(folder, {"compare", "a.ply", "c.ply"});
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr("vertices"));
}

TEST(Compare, DrawsTheDifferenceOfSolutions) {
  const TempFolder folder;
  testing_support::writeRoom(folder);
  const auto solve = [&](const char* bounces, const char* ply) {
    return runProgram(folder, {"solve", "room.obj", "--elements", "300", "--bounces", bounces, "--ply", ply});
  };
  ASSERT_EQ(solve("1", "direct.ply").code, 0);
  const ProgramResult two = solve("2", "two.ply");
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_THAT(two.out, HasSubstr("bounces"));
  const auto meanOf = [&](const char* a, const char* b) {
    const ProgramResult result = runProgram(folder, {"compare", a, b, "--out", "d.png", "--size", "64x48"});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("orange where A is brighter"));
    const ImageF image = readImage(folder / "d.png");
    EXPECT_EQ(image.width, 64);
    glm::dvec3 mean(0.0);
    for (std::size_t k = 0; k < image.rgb.size(); ++k) mean[static_cast<int>(k % 3)] += image.rgb[k];
    return mean / (64.0 * 48);
  };
  const glm::dvec3 brighter = meanOf("two.ply", "direct.ply"), darker = meanOf("direct.ply", "two.ply"),
                   same = meanOf("two.ply", "two.ply");
  EXPECT_GT(brighter.x, 2 * brighter.z);
  EXPECT_GT(darker.z, 2 * darker.x);
  EXPECT_LT(same.x, 0.05);
  EXPECT_NEAR(same.x, same.z, 0.01);
}

TEST(Compare, ASolutionAgainstReferenceValuesAtPoints) {
  const TempFolder folder;
  const std::string data = std::string(UNSHOT_SOURCE_DIR) + "/tests/data/";
  ASSERT_EQ(runProgram(folder, {"solve", data + "cornell_published.obj", "--elements", "2000", "--bounces",
                                "1", "--ply", "direct.ply"})
                .code,
            0);
  const ProgramResult direct = runProgram(
      folder, {"compare", "direct.ply", data + "cornell_published_direct.csv", "--tolerance", "0.06"});
  EXPECT_EQ(direct.code, 0) << direct.out;
  EXPECT_THAT(direct.out, AllOf(HasSubstr("198 probes"), HasSubstr("2 on light sources")));
  EXPECT_EQ(
      runProgram(folder, {"compare", "direct.ply", data + "cornell_published.csv", "--tolerance", "0.3"})
          .code,
      6);
  EXPECT_EQ(runProgram(folder, {"compare", data + "cornell_published.csv", "direct.ply"}).code, 0);
}

TEST(Compare, RefusesWhatCannotBeCompared) {
  const TempFolder folder;
  writePictures(folder);
  writePng(folder / "small.png", {1, 1, {1, 2, 3}});
  folder.write("a.csv", "0,0,0,0,1,0,2,2,2\n");
  folder.write("b.csv", "0,5,0,0,1,0,2,2,2\n1,0,0,0,1,0,2,2,2\n");
  folder.write("empty", "");
  const auto before = folder.names();
  const auto refused = [&](const char* a, const char* b, const char* message) {
    const ProgramResult result = runProgram(folder, {"compare", a, b, "--out", "d.png"});
    EXPECT_EQ(result.code, 3) << a << " " << b;
    EXPECT_THAT(result.err, AllOf(HasSubstr(message), HasSubstr("\n  try: ")));
  };
  refused("a.hdr", "small.png", "8x4");
  refused("a.hdr", "a.csv", "two files of one kind");
  refused("a.csv", "b.csv", "1 points");
  refused("a.hdr", "none.hdr", "no such file");
  refused("a.hdr", ".", "folder");
  refused("empty", "a.hdr", "empty");
  EXPECT_EQ(runProgram(folder, {"compare", "a.csv", "a.csv", "--out", "d.png"}).code, 2);
  EXPECT_EQ(runProgram(folder, {"compare", "a.hdr", "b.hdr", "--out", "no/d.png"}).code, 4);
  EXPECT_EQ(folder.names(), before);
}

}  // namespace
}  // namespace unshot
