// What a file's geometry becomes; materials and bad files have tests of their own.
#include "scene/obj_reader.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <locale>
#include <map>

#include "unit/obj_fixture.h"

namespace unshot {
namespace {

using ObjReader = ObjFileTest;

constexpr std::string_view kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string withSquare(std::string_view rest) { return std::string(kSquare) + std::string(rest); }

TEST_F(ObjReader, KeepsAPolygonsCornersInTheFilesWinding) {
  const Scene scene = read(withSquare("f 3 4 1 2\n"));
  ASSERT_EQ(scene.polygons.size(), 1u);
  const Polygon& polygon = scene.polygons[0];
  ASSERT_EQ(polygon.corner_count, 4u);
  expectNear(filePosition(scene, polygon, 0), {1, 1, 0});
  expectNear(filePosition(scene, polygon, 1), {0, 1, 0});
  expectNear(filePosition(scene, polygon, 2), {0, 0, 0});
  expectNear(filePosition(scene, polygon, 3), {1, 0, 0});
  EXPECT_EQ(scene.triangle_count, 2u);
  EXPECT_EQ(scene.face_count, 1u);
  EXPECT_EQ(polygon.face, 0u);
  EXPECT_EQ(polygon.line, 5u);
}

TEST_F(ObjReader, TakesNameAndPathFromTheFile) {
  const std::filesystem::path path = write("Küche 2.obj", withSquare("f 1 2 3 4"));
  const Scene scene = readObj(path);
  EXPECT_EQ(scene.name, "Küche 2");
  EXPECT_EQ(scene.path, path);
}

TEST_F(ObjReader, CentresTheFrameOnTheVerticesInUse) {
  const Scene scene = read("v 900 900 900\nv 10 0 0\nv 12 0 0\nv 12 4 6\nf 2 3 4\n");
  expectNear(scene.frame_origin, {11, 2, 3});
  expectNear(scene.bounds_min, {-1, -2, -3});
  expectNear(scene.bounds_max, {1, 2, 3});
  ASSERT_EQ(scene.positions.size(), 3u);
  expectNear(scene.positions[0], {-1, -2, -3});
}

TEST_F(ObjReader, KeepsTheDigitsOfASceneFarFromTheOrigin) {
  const Scene scene = read("v 1000000.125 0 0\nv 1000000.375 0 0\nv 1000000.375 0.25 0\nf 1 2 3\n");
  expectNear(scene.bounds_max - scene.bounds_min, {0.25, 0.25, 0}, 0);
  EXPECT_EQ(scene.triangle_count, 1u);
}

TEST_F(ObjReader, ReadsConcavePolygonsAsOnePolygon) {
  const Scene scene = read("v 0 0 0\nv 4 0 0\nv 4 3 0\nv 2 1 0\nv 0 3 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(scene.polygons.size(), 1u);
  EXPECT_EQ(scene.triangle_count, 3u);
  expectNoDiagnostic(scene, "non-planar-face");
  expectNoDiagnostic(scene, "self-intersecting-face");
}

TEST_F(ObjReader, KeepsCollinearCorners) {
  const Scene scene = read("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n");
  ASSERT_EQ(scene.polygons.size(), 1u);
  EXPECT_EQ(scene.polygons[0].corner_count, 5u);
  EXPECT_EQ(scene.triangle_count, 3u);
}

TEST_F(ObjReader, ReadsPolygonsOfMoreThan255Corners) {
  std::string obj;
  std::string face = "f";
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 1000;
    obj += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  const Scene scene = read(obj + face);
  ASSERT_EQ(scene.polygons.size(), 1u);
  EXPECT_EQ(scene.polygons[0].corner_count, 1000u);
  EXPECT_EQ(scene.triangle_count, 998u);
}

TEST_F(ObjReader, SplitsAFaceThatIsNotPlanarIntoTrianglesOfOneFace) {
  const Scene scene = read("v 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1 0\nf 1 2 3 4\nf 1 4 3\n");
  ASSERT_EQ(scene.polygons.size(), 2u);
  EXPECT_EQ(scene.polygons[0].face, 0u);
  EXPECT_EQ(scene.polygons[1].face, 0u);
  EXPECT_EQ(scene.polygons[0].corner_count, 3u);
  EXPECT_EQ(scene.triangle_count, 2u);
  EXPECT_EQ(scene.face_count, 2u);
  expectDiagnostic(scene, "non-planar-face", "1 face", "scene.obj:5");
}

TEST_F(ObjReader, JudgesPlanarityByTheSizeOfTheFace) {
  const auto polygons = [&](const std::string& size, const std::string& height) {
    return read("v 0 0 0\nv " + size + " 0 0\nv " + size + " " + size + " " + height + "\nv 0 " + size +
                " 0\nf 1 2 3 4\n")
        .polygons.size();
  };
  EXPECT_EQ(polygons("1", "1e-5"), 1u);
  EXPECT_EQ(polygons("1", "1e-4"), 2u);
  EXPECT_EQ(polygons("1e-6", "1e-11"), 1u);
  EXPECT_EQ(polygons("1e-6", "1e-10"), 2u);
  EXPECT_EQ(polygons("1e6", "10"), 1u);
  EXPECT_EQ(polygons("1e6", "100"), 2u);
}

TEST_F(ObjReader, CountsNegativeIndicesBackFromTheFace) {
  const Scene scene = read("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 7 7 7\n");
  expectNear(filePosition(scene, scene.polygons.at(0), 0), {0, 0, 0});
  expectNear(filePosition(scene, scene.polygons.at(0), 2), {0, 1, 0});
}

TEST_F(ObjReader, LetsAFaceStandBeforeItsVertices) {
  EXPECT_EQ(read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangle_count, 1u);
}

TEST_F(ObjReader, ReadsAllFormsOfACorner) {
  const std::string points = withSquare("vt 0 0\nvn 0 0 2\n");
  for (const std::string face :
       {"f 1 2 3 4", "f 1/1 2/1 3/1 4/1", "f 1//1 2//1 3//1 4//1", "f 1/1/1 2/1/1 3/1/1 4/1/1",
        "f -4/-1/-1 -3/-1/-1 -2/-1/-1 -1/-1/-1", "f\t1/ 2// 3/1/\t+4  ", "fo 1 2 3 4",
        "  f 1 2 3 4 # a comment", "f 1 2 3 4# a comment"}) {
    SCOPED_TRACE(face);
    const Scene scene = read(points + face + "\n");
    ASSERT_EQ(scene.polygons.size(), 1u);
    EXPECT_EQ(scene.polygons[0].corner_count, 4u);
  }
}

TEST_F(ObjReader, KeepsGivenNormalsAtUnitLength) {
  const Scene scene = read(withSquare("vn 0 0 1\nvn 0 0 -4\nf 1//2 2 3/7/2 4/7\n"));
  ASSERT_EQ(scene.normals.size(), 1u);
  expectNear(scene.normals[0], {0, 0, -1});
  EXPECT_EQ(scene.corners[0].normal, 0u);
  EXPECT_EQ(scene.corners[1].normal, kNone);
  EXPECT_EQ(scene.corners[2].normal, 0u);
  EXPECT_EQ(scene.corners[3].normal, kNone);
}

TEST_F(ObjReader, LeavesOutNormalsWithoutADirection) {
  const Scene scene = read(withSquare("vn 0 0 0\nvn nan 0 1\nvn oops\nvn 0 1 0\nf 1//1 2//2 3//3 4//4\n"));
  EXPECT_EQ(scene.corners[0].normal, kNone);
  EXPECT_EQ(scene.corners[1].normal, kNone);
  EXPECT_EQ(scene.corners[2].normal, kNone);
  EXPECT_EQ(scene.corners[3].normal, 0u);
  expectDiagnostic(scene, "unusable-normal", "3 corners", "scene.obj:9");
}

TEST_F(ObjReader, ReadsSmoothingGroups) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const Scene scene = read(points + "f 1 2 3\ns 7\nf 1 2 4\ns off\nf 1 3 4\ns 4294967295\nf 2 3 4\n");
  ASSERT_EQ(scene.polygons.size(), 4u);
  EXPECT_TRUE(scene.smoothing_given);
  EXPECT_EQ(scene.polygons[0].smoothing_group, 0u);
  EXPECT_EQ(scene.polygons[1].smoothing_group, 7u);
  EXPECT_EQ(scene.polygons[2].smoothing_group, 0u);
  EXPECT_NE(scene.polygons[3].smoothing_group, 0u);
  EXPECT_TRUE(read(points + "s 0\nf 1 2 3\n").smoothing_given);
  EXPECT_FALSE(read(points + "f 1 2 3\n").smoothing_given);
}

TEST_F(ObjReader, ReadsEveryKindOfLineEnd) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string obj = "# square\n\nv 0 0 0\nv 1 0 0\n\nv 1 1 0\nf 1 2 3";
    for (std::size_t at = 0; (at = obj.find('\n', at)) != std::string::npos; at += end.size())
      obj.replace(at, 1, end);
    const Scene scene = read(obj);
    EXPECT_EQ(scene.triangle_count, 1u);
    EXPECT_EQ(scene.polygons.at(0).line, 7u);
  }
}

TEST_F(ObjReader, ReadsByteOrderMarkTabsAndIndentation) {
  EXPECT_EQ(read("\xEF\xBB\xBFv\t0\t0 0\n \t v 1 0 0\nv 0  1\t0 \n\tf\t1 2\t3\t").triangle_count, 1u);
}

TEST_F(ObjReader, JoinsLinesThatEndWithABackslash) {
  const Scene scene =
      read("v 0 0 0\nv 1 \\\n 0 0\nv 1 1 0\nv 0 1 0\nf 1 2\\\r\n 3 \\  \n 4\nf 1 2 3 # C:\\\nf 1 3 4\n");
  ASSERT_EQ(scene.polygons.size(), 1u) << "the triangles count twice";
  EXPECT_EQ(scene.polygons[0].corner_count, 4u);
  EXPECT_EQ(scene.polygons[0].line, 6u);
  EXPECT_EQ(scene.face_count, 3u);
}

TEST_F(ObjReader, EndsOnABackslashAtTheEndOfTheFile) {
  EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\\").triangle_count, 1u);
}

TEST_F(ObjReader, PassesOverColoursAndWeightsOfVertices) {
  const Scene scene = read("v 0 0 0 1 0.5 0\nv 1 0 0 2.0\nv 0 1 0 0.1 0.2 0.3 # red\nf 1 2 3\n");
  expectNear(filePosition(scene, scene.polygons.at(0), 1), {1, 0, 0});
}

TEST_F(ObjReader, ReadsEveryFormOfANumber) {
  const Scene scene = read("v -.5 +1e1 0\nv 1. 2.5E+0 0.\nv 1e-3 -25e-2 00.125\nf 1 2 3\n");
  expectNear(filePosition(scene, scene.polygons.at(0), 0), {-0.5, 10, 0});
  expectNear(filePosition(scene, scene.polygons.at(0), 1), {1, 2.5, 0});
  expectNear(filePosition(scene, scene.polygons.at(0), 2), {0.001, -0.25, 0.125});
}

TEST_F(ObjReader, ReadsNumbersTheSameInEveryLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // where it is installed
  write("scene.mtl", "newmtl half\nKd 0.5 0.25 0.75\n");
  const Scene scene = read("mtllib scene.mtl\nusemtl half\nv 0.5 0 0\nv 1.5 0 0\nv 0.5 1.25 0\nf 1 2 3\n");
  std::setlocale(LC_ALL, c_before.c_str());
  std::locale::global(before);
  expectNear(filePosition(scene, scene.polygons.at(0), 2), {0.5, 1.25, 0});
  expectNear(scene.materials.at(0).reflectance, {0.5, 0.25, 0.75});
}

TEST_F(ObjReader, RemovesCornersThatRepeatTheOneBefore) {
  const Scene scene = read(withSquare("v 1 1 0\nf 1 2 2 3 5 4 1\n"));
  ASSERT_EQ(scene.polygons.size(), 1u);
  EXPECT_EQ(scene.polygons[0].corner_count, 4u);
  expectDiagnostic(scene, "repeated-corner", "1 face", "scene.obj:6");
}

TEST_F(ObjReader, DropsFacesWithoutAnAreaWithOneDiagnostic) {
  const Scene scene =
      read(withSquare("v 0.3 0.3 0\nv 0.1 0.1 0\nf 1 2\nf 1 2 1\nf 1 5 6\nf\nf 2 2 2 2\nf 1 2 3\n"));
  EXPECT_EQ(scene.triangle_count, 1u);
  EXPECT_EQ(scene.face_count, 6u);
  EXPECT_EQ(scene.polygons.at(0).face, 5u);
  EXPECT_EQ(scene.positions.size(), 3u);
  expectDiagnostic(scene, "degenerate-face", "5 faces", "scene.obj:7");
}

TEST_F(ObjReader, KeepsThinAndTinyFaces) {
  EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv 1 1e-8 0\nf 1 2 3\n").triangle_count, 1u);
  EXPECT_EQ(read("v 0 0 0\nv 1e-9 0 0\nv 0 1e-9 0\nf 1 2 3\n").triangle_count, 1u);
  EXPECT_EQ(read("v 0 0 0\nv 1e9 0 0\nv 0 1e9 0\nf 1 2 3\n").triangle_count, 1u);
}

TEST_F(ObjReader, CountsACopyOfAFaceOnceWhicheverWayRound) {
  const std::string copies = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  for (const std::string face : {"f 5 6 7 8", "f 6 7 8 5", "f 8 7 6 5", "f 7 6 5 8", "f 2 3 4 1"}) {
    SCOPED_TRACE(face);
    const Scene scene = read(withSquare(copies + "f 1 2 3 4\n" + face + "\n"));
    ASSERT_EQ(scene.polygons.size(), 1u);
    EXPECT_EQ(scene.polygons[0].line, 9u);
    EXPECT_EQ(scene.positions.size(), 4u);
    expectDiagnostic(scene, "duplicate-face", "2 triangles", "scene.obj:10");
    expectNoDiagnostic(scene, "duplicate-face-material");
  }
}

TEST_F(ObjReader, KeepsTheRestOfAFaceThatIsPartlyACopy) {
  const Scene scene = read(withSquare("f 1 2 3\nf 1 2 3 4\n"));
  ASSERT_EQ(scene.polygons.size(), 2u);
  EXPECT_EQ(scene.triangle_count, 2u);
  EXPECT_EQ(scene.polygons[1].corner_count, 3u);
  EXPECT_EQ(scene.polygons[1].face, 1u);
  expectDiagnostic(scene, "duplicate-face", "1 triangle", "scene.obj:6");
}

TEST_F(ObjReader, LetsTheFirstMaterialOfACopyWin) {
  const Scene scene = read(withSquare("usemtl a\nf 1 2 3 4\nusemtl b\nf 4 3 2 1\n"));
  ASSERT_EQ(scene.polygons.size(), 1u);
  EXPECT_EQ(scene.materials[scene.polygons[0].material].name, "a");
  expectDiagnostic(scene, "duplicate-face-material", "2 triangles", "scene.obj:8");
  expectNoDiagnostic(scene, "duplicate-face");
}

TEST_F(ObjReader, SaysThatAFaceCrossesItself) {
  const Scene scene = read("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 1 -1 0\nv 0 4 0\nf 1 2 3 4 5\n");
  expectDiagnostic(scene, "self-intersecting-face", "1 face", "scene.obj:6");
  for (const Polygon& polygon : scene.polygons) EXPECT_EQ(polygon.corner_count, 3u);
}

TEST_F(ObjReader, ReadsAHoleThatABridgeJoins) {
  const Scene scene =
      read("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\nf 1 2 3 4 1 5 6 7 8 5\n");
  ASSERT_EQ(scene.polygons.size(), 1u);
  EXPECT_EQ(scene.triangle_count, 8u);
  expectNoDiagnostic(scene, "self-intersecting-face");
}

TEST_F(ObjReader, ReadsPastLinesPointsCurvesAndWhatItDoesNotKnow) {
  const Scene scene =
      read(withSquare("l 1 2 3\np 1\nl 99 98\ncstype bezier\ncurv 0 1 1 2\nbogus 3\ng a b\no c\nf 1 2 3\n"));
  EXPECT_EQ(scene.triangle_count, 1u);
  expectDiagnostic(scene, "lines-and-points", "3 line or point statements", "scene.obj:5");
  expectDiagnostic(scene, "free-form", "2 free-form statements", "scene.obj:8");
  expectDiagnostic(scene, "unknown-statement", "'bogus'", "scene.obj:10");
  EXPECT_EQ(findDiagnostic(scene, "lines-and-points")->severity, Severity::kNote);
}

TEST_F(ObjReader, KeepsThePublishedCornellBox) {
  const Scene scene = readObj(std::filesystem::path(UNSHOT_TEST_DATA) / "cornell_published.obj");
  EXPECT_EQ(scene.triangle_count, 52u);
  EXPECT_EQ(scene.face_count, 23u);
  expectNoDiagnostic(scene, "no-light");
}

/// Opens every OBJ below $UNSHOT_SCENES, and knows how many triangles some of them have (exact copies counted
/// once).
TEST_F(ObjReader, OpensEverySceneOfTheCollection) {
  const std::map<std::string, std::size_t> known{{"cornell_published", 52},      {"CornellBox-Original", 32},
                                                 {"CornellBox-Empty-White", 12}, {"CornellBox-Sphere", 2188},
                                                 {"teapot_box", 15730},          {"holodeck", 4007},
                                                 {"lost_empire", 209758}};
  std::vector<std::filesystem::path> scenes;
  if (const char* folder = std::getenv("UNSHOT_SCENES")) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.path().extension() == ".obj") scenes.push_back(entry.path());
    }
  } else {
    std::cout << "UNSHOT_SCENES is not set: no scene opened\n";
  }
  for (const std::filesystem::path& path : scenes) {
    const Scene scene = readObj(path);
    const auto expected = known.find(scene.name);
    std::cout << scene.name << ": " << scene.triangle_count << " triangles\n";
    if (expected == known.end()) continue;
    EXPECT_EQ(scene.triangle_count, expected->second) << path;
  }
}

}  // namespace
}  // namespace unshot
