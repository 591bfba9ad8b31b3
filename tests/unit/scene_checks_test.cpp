// Each check of a scene as a whole: where it must speak, with its place, and where it must not.
#include "session/scene_checks.h"

#include <gmock/gmock.h>

#include <set>

#include "mesh/build.h"
#include "unit/obj_fixture.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kMaterials =
    "newmtl white\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 5 5 5\n"
    "newmtl bright\nKd 0.995 0.995 0.995\nnewmtl perfect\nKd 1 1 1\n";

/// A closed room, 2 x 2 x 2, of the material; lines 1 to 16, the first vertex after it is 9.
std::string roomText(const std::string& material = "white") {
  return "mtllib a.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\nusemtl " +
         material + "\nf 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\n";
}

/// A square at a height, its front down; five lines, then the face on the sixth.
std::string square(double height, double half = 0.3, const std::string& material = "lamp", bool down = true) {
  const auto corner = [&](double x, double z) {
    return "v " + std::to_string(1 + x * half) + " " + std::to_string(height) + " " +
           std::to_string(1 + z * half) + "\n";
  };
  return "usemtl " + material + "\n" + corner(-1, -1) + corner(1, -1) + corner(1, 1) + corner(-1, 1) +
         (down ? "f -4 -3 -2 -1\n" : "f -1 -2 -3 -4\n");
}

/// A small box around (1, 1, 1), its fronts outwards.
std::string box(double half, const std::string& material = "white") {
  std::string text = "usemtl " + material + "\n";
  for (const double z : {1 - half, 1 + half}) {
    for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
      text += "v " + std::to_string(1 + x * half) + " " + std::to_string(1 + y * half) + " " +
              std::to_string(z) + "\n";
  }
  return text + "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -6 -5 -1 -2\nf -8 -4 -1 -5\nf -7 -6 -2 -3\n";
}

class SceneChecks : public ObjFileTest {
 protected:
  /// What all checks find.
  Diagnostics remarks(const std::string& obj, bool emit_front_only = false) const {
    write("a.mtl", kMaterials);
    const Scene scene = read(obj);
    MeshOptions options;
    options.elements = 100;
    options.emit_front_only = emit_front_only;
    const Mesh mesh = buildMesh(scene, options);
    const CancelToken never;
    CheckedScene checked(scene, mesh, emit_front_only, never);
    Diagnostics found = checkScene(checked, CheckTime::kEverySolve);
    const Diagnostics more = checkScene(checked, CheckTime::kOnlyCheck);
    found.insert(found.end(), more.begin(), more.end());
    return found;
  }

  static std::vector<std::string> codes(const Diagnostics& found) {
    std::vector<std::string> out;
    for (const Diagnostic& d : found) out.push_back(d.code);
    return out;
  }

  /// That it is the one remark, and where.
  void expectOnly(const Diagnostics& found, const std::string& code, const std::string& message,
                  const std::string& line, Severity severity = Severity::kWarning) const {
    ASSERT_THAT(codes(found), testing::ElementsAre(code));
    EXPECT_THAT(found[0].message, HasSubstr(message));
    EXPECT_EQ(found[0].where, (folder_ / "scene.obj").string() + line);
    EXPECT_EQ(found[0].severity, severity);
    EXPECT_FALSE(found[0].advice.empty());
  }
};

TEST_F(SceneChecks, FindNothingInARoomWithALampBelowItsCeiling) {
  EXPECT_THAT(codes(remarks(roomText() + square(1.99))), IsEmpty());
  EXPECT_THAT(codes(remarks(roomText() + square(1.99), true)), IsEmpty());
  EXPECT_THAT(codes(remarks(roomText() + square(1.9999))), IsEmpty())
      << "its back faces the ceiling, its front the room";
  EXPECT_THAT(codes(remarks(roomText() + square(1.5) + box(0.2))), IsEmpty());
}

TEST_F(SceneChecks, FindALightThatFacesTheCeiling) {
  expectOnly(remarks(roomText() + square(1.999, 0.3, "lamp", false), true), "light-faces-wall",
             "'lamp' faces a surface directly before it", ":22");
}

TEST_F(SceneChecks, FindALightHiddenAboveTheCeiling) {
  const auto aboveIt = [&](const std::string& lights) {
    Diagnostics found = remarks(roomText() + lights);
    std::erase_if(found, [](const Diagnostic& d) { return d.code == "closed"; });
    return found;
  };
  expectOnly(aboveIt(square(2.001)), "light-faces-wall", "nothing of its light gets any further", ":22");
  expectOnly(aboveIt(square(2.001) + square(-0.001)), "light-faces-wall", "2 lights, the first of", ":22");
}

TEST_F(SceneChecks, FindALightInThePlaneOfTheCeiling) {
  expectOnly(remarks(roomText() + square(2)), "light-faces-wall", "lies in the plane of another surface",
             ":22");
}

TEST_F(SceneChecks, FindALightInASolid) {
  expectOnly(remarks(roomText() + box(0.3) + square(1, 0.1)), "light-in-solid", "is shut into a solid",
             ":37");
  // The room itself may be wound outwards: then every light shines on backs.
  std::string outwards = roomText();
  for (const auto& [from, to] : {std::pair("f 1 2 3 4", "f 4 3 2 1"),
                                 {"f 8 7 6 5", "f 5 6 7 8"},
                                 {"f 1 5 6 2", "f 2 6 5 1"},
                                 {"f 4 3 7 8", "f 8 7 3 4"},
                                 {"f 1 4 8 5", "f 5 8 4 1"},
                                 {"f 2 6 7 3", "f 3 7 6 2"}})
    outwards.replace(outwards.find(from), 9, to);
  EXPECT_THAT(codes(remarks(outwards + square(1.5))), IsEmpty());
}

TEST_F(SceneChecks, FindALightThatSeesNothing) {
  // Its front looks away from the only other surface.
  const std::string floor = "mtllib a.mtl\n" + square(0, 1, "white", false);
  Diagnostics found = remarks(floor + square(1, 0.3, "lamp", false), true);
  std::erase_if(found, [](const Diagnostic& d) { return d.code == "closed"; });
  expectOnly(found, "light-sees-nothing", "no surface receives its light", ":13");
  EXPECT_THAT(found[0].advice, HasSubstr("turn it around"));
  EXPECT_THAT(codes(remarks(floor + square(1), true)), Not(testing::Contains("light-sees-nothing")));
  // A room that is all light sees itself.
  EXPECT_THAT(codes(remarks(roomText("lamp"))), IsEmpty());
}

TEST_F(SceneChecks, FindSurfacesThatNearlyTouch) {
  expectOnly(remarks(roomText() + square(1.5) + square(0.00002, 0.5, "white", false)), "nearly-touching",
             "1 pair of parallel surfaces nearly touch, with gaps from 2e-05 m", ":13", Severity::kNote);
  // On it, or as far above it as a carpet.
  EXPECT_THAT(codes(remarks(roomText() + square(1.5) + square(0, 0.5, "white", false))), IsEmpty());
  EXPECT_THAT(codes(remarks(roomText() + square(1.5) + square(0.005, 0.5, "white", false))), IsEmpty());
}

TEST_F(SceneChecks, FindOddScale) {
  const auto scaled = [](const char* unit) {
    const std::string u = unit;
    return "v 0 0 0\nv " + u + " 0 0\nv " + u + " " + u + " 0\nv 0 0 " + u + "\nf 1 2 3\nf 1 2 4\n";
  };
  const auto said = [&](const std::string& obj) {
    Diagnostics found = remarks(obj);
    std::erase_if(found, [](const Diagnostic& d) { return d.code != "scale"; });
    return found;
  };
  expectOnly(said(scaled("1e-4")), "scale", "m across", "");
  expectOnly(said(scaled("1e6")), "scale", "m across", "");
  EXPECT_THAT(said(scaled("0.1")), IsEmpty());
  EXPECT_THAT(said(scaled("1000")), IsEmpty());
  expectOnly(said("v 1000000 0 0\nv 1000001 0 0\nv 1000001 1 0\nv 1000000 0 1\nf 1 2 3\nf 1 2 4\n"), "scale",
             "1 digit left", "");
  EXPECT_THAT(said("v 1000 0 0\nv 1001 0 0\nv 1001 1 0\nv 1000 0 1\nf 1 2 3\nf 1 2 4\n"), IsEmpty());
}

TEST_F(SceneChecks, FindMixedWinding) {
  std::string turned = roomText();
  turned.replace(turned.find("f 1 5 6 2"), 9, "f 2 6 5 1");
  expectOnly(remarks(turned + square(1.5)), "mixed-winding", "across 4 edges", ":11", Severity::kNote);
  // Two halves of a lamp: the front of the one beside the back of the other.
  const std::string lamp =
      "usemtl lamp\nv 0.5 1.5 0.5\nv 1 1.5 0.5\nv 1 1.5 1\nv 0.5 1.5 1\nv 1.5 1.5 0.5\nv 1.5 1.5 1\n"
      "f 9 10 11 12\nf 11 13 10\nf 11 14 13\n";
  expectOnly(remarks(roomText() + lamp, true), "mixed-winding", "of which only fronts emit", ":24");
}

TEST_F(SceneChecks, FindWaysOut) {
  std::string open = roomText();
  open.erase(open.find("f 2 6 7 3"), 10);
  const Diagnostics found = remarks(open + square(1.5));
  expectOnly(found, "closed", "(4 edges without a neighbour, the first here)", ":11", Severity::kNote);
  EXPECT_THAT(found[0].message, HasSubstr("% of the light escapes"));
  // A face that ends within a neighbour's edge leaves edges open, but no way out.
  std::string halves = roomText();
  halves.replace(halves.find("f 2 6 7 3\n"), 10, "v 2 1 0\nv 2 1 2\nf 2 6 10 9\nf 9 10 7 3\n");
  EXPECT_THAT(codes(remarks(halves + square(1.5))), IsEmpty());
}

TEST_F(SceneChecks, FindLightThatHardlyFades) {
  expectOnly(remarks(roomText("bright") + square(1.5, 0.01)), "spectral-radius", "about 99.5 %", "");
  expectOnly(remarks(roomText("perfect")), "spectral-radius", "no finite solution", "");
}

TEST_F(SceneChecks, KnowHowLightFades) {
  write("a.mtl", kMaterials);
  const Scene scene = read(roomText() + square(1.5, 0.01));
  const Mesh mesh = buildMesh(scene, MeshOptions{});
  const LightWalks walks = walkLight(mesh, MeshRays(mesh));
  EXPECT_NEAR(walks.largestRadius(), 0.5, 0.005) << "a closed room of one reflectance";
  EXPECT_EQ(walks.escapes, 0u);
  EXPECT_EQ(walks.escaped, 0.0);
  EXPECT_EQ(walks.bouncesToOnePercent(), 7.0);
}

TEST(SceneCheckTable, HasAKeyATitleAndHelpForEach) {
  std::set<std::string_view> keys;
  for (const SceneCheckRow& row : sceneChecks()) {
    EXPECT_TRUE(keys.insert(row.info.key).second) << row.info.key;
    EXPECT_FALSE(row.info.title.empty());
    EXPECT_FALSE(row.info.help.empty());
    EXPECT_NE(row.look, nullptr);
  }
  EXPECT_EQ(keys.size(), 8u);
}

}  // namespace
}  // namespace unshot
