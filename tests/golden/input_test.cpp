// Bad scenes and bad files: one clear message, the right code (3), nothing written.
#include <gmock/gmock.h>

#include "support/run_program.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using testing_support::ProgramResult;
using testing_support::roomObj;
using testing_support::runProgram;
using testing_support::TempFolder;

struct BadScene {
  const char* name;
  std::string content;
  std::string place;  ///< file:line, or the file where there is no line
};

void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

class BadSceneTest : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, IsRefusedWithOneMessage) {
  const TempFolder folder;
  folder.write("room.mtl", testing_support::kMaterials);
  folder.write("bad.obj", GetParam().content);
  const auto before = folder.names();
  const ProgramResult result =
      runProgram(folder, {"solve", "bad.obj", "--ply", "out.ply", "--report", "out.json"});
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err, StartsWith("unshot: " + GetParam().place + ": "));
  EXPECT_THAT(result.err, HasSubstr("\n  try: "));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_EQ(folder.names(), before);
  EXPECT_EQ(runProgram(folder, {"check", "bad.obj"}).code, 3);
}

std::string binaryNoise() {
  std::string bytes;
  for (unsigned k = 0; k < 4096; ++k) bytes += static_cast<char>(k * k * 2654435761u >> 13);
  return bytes;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadSceneTest,
    testing::Values(BadScene{"Empty", "", "bad.obj"},
                    BadScene{"NoFaces", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "bad.obj"},
                    BadScene{"IndexOutOfRange", roomObj() + "f 1 2 99\n", "bad.obj:18"},
                    BadScene{"IndexZero", roomObj() + "f 1 2 0\n", "bad.obj:18"},
                    BadScene{"IndexBeforeTheFirst", roomObj() + "f 1 2 -9\n", "bad.obj:18"},
                    BadScene{"IndexBeyond32Bits", roomObj() + "f 1 2 4294967297\n", "bad.obj:18"},
                    BadScene{"IndexBeyond64Bits", roomObj() + "f 1 2 99999999999999999999999\n",
                             "bad.obj:18"},
                    BadScene{"IndexIsText", roomObj() + "f 1 2 three\n", "bad.obj:18"},
                    BadScene{"VertexNaN", roomObj() + "v nan 0 0\nf 1 2 9\n", "bad.obj:19"},
                    BadScene{"VertexInfinite", roomObj() + "v 0 -inf 0\nf 1 2 9\n", "bad.obj:19"},
                    BadScene{"VertexBeyondDouble", roomObj() + "v 1e999 0 0\nf 1 2 9\n", "bad.obj:19"},
                    BadScene{"OnlyFacesWithoutArea", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "bad.obj:4"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(BadScene, BinaryFileIsRefused) {
  const TempFolder folder;
  folder.write("bad.obj", binaryNoise());
  const ProgramResult result = runProgram(folder, {"solve", "bad.obj"});
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err,
              AllOf(StartsWith("unshot: bad.obj"), HasSubstr("not text"), HasSubstr("\n  try: ")));
}

TEST(BadScene, MissingFileAndFolderAreRefused) {
  const TempFolder folder;
  EXPECT_EQ(runProgram(folder, {"solve", "none.obj"}).code, 3);
  const ProgramResult result = runProgram(folder, {"solve", "."});
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err, HasSubstr("folder"));
}

struct DoubtfulScene {
  const char* name;
  std::string content;
  std::string warning;
};

void PrintTo(const DoubtfulScene& scene, std::ostream* out) { *out << scene.name; }

class DoubtfulSceneTest : public testing::TestWithParam<DoubtfulScene> {};

TEST_P(DoubtfulSceneTest, IsSolvedWithAWarning) {
  const TempFolder folder;
  folder.write("room.mtl", testing_support::kMaterials);
  folder.write("odd.obj", GetParam().content);
  const ProgramResult result =
      runProgram(folder, {"solve", "odd.obj", "--elements", "60", "--report", "out.json"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, HasSubstr(GetParam().warning));
  EXPECT_THAT(result.err, HasSubstr("\n  try: "));
  EXPECT_THAT(folder.read("out.json"), HasSubstr("\"warning\""));
  const ProgramResult check = runProgram(folder, {"check", "odd.obj"});
  EXPECT_EQ(check.code, 0);
  // The table has place and message on lines of their own.
  const std::string said = GetParam().warning, between = ": warning: ";
  const std::size_t at = said.find(between);
  EXPECT_THAT(check.out, HasSubstr("  " + said.substr(0, at) + "\n"));
  EXPECT_THAT(check.out, HasSubstr(said.substr(at + between.size())));
}

INSTANTIATE_TEST_SUITE_P(
    All, DoubtfulSceneTest,
    testing::Values(
        DoubtfulScene{"FaceWithoutArea", roomObj() + "f 1 1 2\n", "odd.obj:18: warning: "},
        DoubtfulScene{"NoLight", roomObj("white", "white"), "odd.obj: warning: no face emits light"},
        DoubtfulScene{"TextureIndex", roomObj() + "vt 0 0\nf 1/1 2/2 3/1 4/1\n", "odd.obj:19: warning: "},
        DoubtfulScene{"ReflectanceAboveOne", roomObj("bright"), "room.mtl:7: warning: material 'bright'"},
        DoubtfulScene{"NoMaterialFile", "mtllib none.mtl\n" + roomObj(), "odd.obj:1: warning: "}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(DoubtfulScene, OfDarknessIsToldWhatLightsItAllTheSame) {
  const TempFolder folder;
  folder.write("room.mtl", testing_support::kMaterials);
  folder.write("dark.obj", roomObj("white", "white"));
  EXPECT_THAT(runProgram(folder, {"check", "dark.obj"}).out,
              AllOf(HasSubstr("try: give a material of the MTL file a Ke\n"), HasSubstr("--sky r,g,b")));
}

struct BadProbes {
  const char* name;
  std::string content;
  std::string place;
};

void PrintTo(const BadProbes& probes, std::ostream* out) { *out << probes.name; }

class BadProbesTest : public testing::TestWithParam<BadProbes> {};

TEST_P(BadProbesTest, AreRefusedBeforeTheSolve) {
  const TempFolder folder;
  testing_support::writeRoom(folder);
  folder.write("points.csv", GetParam().content);
  const auto before = folder.names();
  const ProgramResult result =
      runProgram(folder, {"solve", "room.obj", "--probe", "points.csv", "--probe-out", "out.csv"});
  EXPECT_EQ(result.code, 3);
  EXPECT_THAT(result.err, StartsWith("unshot: " + GetParam().place + ": "));
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_EQ(folder.names(), before);
}

INSTANTIATE_TEST_SUITE_P(All, BadProbesTest,
                         testing::Values(BadProbes{"Empty", "", "points.csv"},
                                         BadProbes{"NotANumber", "# a\n0,0,0,0,1,0\n0,0,zero,0,1,0\n",
                                                   "points.csv:3"},
                                         BadProbes{"TooFew", "1,2,3\n", "points.csv:1"},
                                         BadProbes{"NoNormal", "1,2,3,0,0,0\n", "points.csv:1"}),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace unshot
