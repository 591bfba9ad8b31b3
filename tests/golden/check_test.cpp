// `unshot check`: the table of remarks and its JSON.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"
#include "support/scenes.h"

namespace unshot {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing_support::ProgramResult;
using testing_support::roomObj;
using testing_support::runProgram;
using testing_support::TempFolder;

/// A room of white walls with a lamp in the plane of its ceiling, a face without an area and a line.
std::string doubtfulRoom() {
  return roomObj("white", "white") +
         "l 1 2\nf 1 1 2\nusemtl light\nv 0.4 1 0.4\nv 0.6 1 0.4\nv 0.6 1 0.6\nv 0.4 1 0.6\nf 9 10 11 12\n";
}

TEST(CheckTable, HasWarningsFirstThenByLine) {
  const TempFolder folder;
  folder.write("room.mtl", testing_support::kMaterials);
  folder.write("room.obj", doubtfulRoom());
  const ProgramResult result = runProgram(folder, {"check", "room.obj"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  const std::size_t begin = result.out.find("3 remarks:");
  ASSERT_NE(begin, std::string::npos) << result.out;
  EXPECT_EQ(
      result.out.substr(begin),
      "3 remarks:\n"
      "\n"
      "warning  degenerate-face   room.obj:19\n"
      "         1 face without an area dropped\n"
      "         try: faces need three corners that are not on one line\n"
      "\n"
      "warning  light-faces-wall  room.obj:25\n"
      "         the light of material 'light' lies in the plane of another surface, on it: which of the two\n"
      "         is seen is left to chance\n"
      "         try: move it off that surface by a hundredth of its size, or cut a hole for it\n"
      "\n"
      "note     lines-and-points  room.obj:18\n"
      "         1 line or point statement read past\n"
      "         try: only faces carry light\n"
      "\n"
      "looked for and not found: lights inside a solid, lights that see nothing, odd scale, surfaces that\n"
      "                          nearly touch, mixed winding, ways out of the scene, light that hardly\n"
      "                          fades\n");
}

TEST(CheckTable, IsTheSameInJson) {
  const TempFolder folder;
  folder.write("room.mtl", testing_support::kMaterials);
  folder.write("room.obj", doubtfulRoom());
  const ProgramResult result = runProgram(folder, {"check", "room.obj", "--json"});
  EXPECT_EQ(result.code, 0);
  const nlohmann::json json = nlohmann::json::parse(result.out);
  const nlohmann::json& remarks = json["diagnostics"];
  ASSERT_EQ(remarks.size(), 3u);
  EXPECT_EQ(remarks[0]["code"], "degenerate-face");
  EXPECT_EQ(remarks[1]["code"], "light-faces-wall");
  EXPECT_EQ(remarks[1]["severity"], "warning");
  EXPECT_EQ(remarks[1]["where"], "room.obj:25");
  EXPECT_THAT(remarks[1]["message"].get<std::string>(), HasSubstr("in the plane of another surface"));
  EXPECT_THAT(remarks[1]["advice"].get<std::string>(), HasSubstr("cut a hole"));
  EXPECT_EQ(remarks[2]["severity"], "note");
  EXPECT_EQ(json["found_nothing"].size(), 7u);
  EXPECT_THAT(json["found_nothing"], Not(Contains("light-faces-wall")));
  EXPECT_NEAR(json["spectral_radius"][0].get<double>(), 0.7, 0.03);
  EXPECT_GT(json["bounces_to_one_percent"].get<double>(), 10);
  EXPECT_EQ(json["escaped"], 0.0);
}

// What matters to a solve is said there too, once.
TEST(CheckTable, OfLightsIsPartOfASolve) {
  const TempFolder folder;
  folder.write("room.mtl", testing_support::kMaterials);
  folder.write("room.obj", doubtfulRoom());
  const ProgramResult result =
      runProgram(folder, {"solve", "room.obj", "--elements", "60", "--report", "out.json"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, HasSubstr("room.obj:25: warning: the light of material 'light' lies in the plane"));
  EXPECT_THAT(folder.read("out.json"), HasSubstr("light-faces-wall"));
}

TEST(CheckTable, KnowsOfLightsThatEmitFromTheirFrontAlone) {
  const TempFolder folder;
  folder.write("room.mtl", testing_support::kMaterials);
  folder.write("room.obj",
               roomObj("white", "white") +
                   "usemtl light\nv 0.4 0.999 0.4\nv 0.6 0.999 0.4\nv 0.6 0.999 0.6\nv 0.4 0.999 0.6\n"
                   "f 12 11 10 9\n");
  EXPECT_THAT(runProgram(folder, {"check", "room.obj"}).out, HasSubstr("Nothing is wrong"));
  EXPECT_THAT(runProgram(folder, {"check", "room.obj", "--emit", "front"}).out,
              AllOf(HasSubstr("light-faces-wall"), HasSubstr("turned around")));
  EXPECT_EQ(runProgram(folder, {"check", "room.obj", "--emit", "back"}).code, 2);
}

}  // namespace
}  // namespace unshot
