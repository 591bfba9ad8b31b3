// Files that are no scene: each gives an input Error that says where and what to try, and nothing crashes or
// hangs.
#include <random>

#include "unit/obj_fixture.h"

namespace unshot {
namespace {

using ObjErrors = ObjFileTest;

constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";

std::string withTriangle(std::string_view rest) { return std::string(kTriangle) + std::string(rest); }

TEST_F(ObjErrors, NamesAFileThatIsNotThere) {
  expectInput(failureOfFile(folder_ / "gone.obj"), "no such file", "gone.obj");
}

TEST_F(ObjErrors, RefusesAFolder) { expectInput(failureOfFile(folder_), "folder", folder_.string()); }

TEST_F(ObjErrors, RefusesWhatIsNotARegularFile) {
  expectInput(failureOfFile(std::filesystem::path("/dev/null")), "regular file", "/dev/null");
}

TEST_F(ObjErrors, RefusesAnEmptyFile) { expectInput(failure(""), "empty", "scene.obj"); }

TEST_F(ObjErrors, RefusesABinaryFile) {
  expectInput(failure(std::string("v 0 0 0\nf\0\1\2\n", 14)), "NUL", "scene.obj:2");
}

TEST_F(ObjErrors, RefusesTextThatIsNoObj) {
  expectInput(failure("Dear reader,\nthis is a letter.\n"), "no line", "scene.obj");
  expectInput(failure("# only a comment\n\n"), "no line", "scene.obj");
}

TEST_F(ObjErrors, RefusesASceneWithoutFaces) {
  expectInput(failure(withTriangle("l 1 2\n")), "no faces (3 vertices, 1 line or point statement)",
              "scene.obj");
}

TEST_F(ObjErrors, RefusesASceneWhoseFacesHaveNoArea) {
  expectInput(failure(withTriangle("f 1 2\nf 1 2 2\n")), "area", "scene.obj:5");
}

TEST_F(ObjErrors, NamesAnIndexOfZero) {
  expectInput(failure(withTriangle("f 1 2 3\nf 1 0 3\n")),
              "vertex index 0 in '0': OBJ counts from 1; there are 3 vertices", "scene.obj:6");
  expectInput(failure(withTriangle("f 1//1 2//0 3//1\n")), "normal index 0", "scene.obj:5");
}

TEST_F(ObjErrors, NamesAnIndexBeyondTheLast) {
  expectInput(failure(withTriangle("f 1 2 3\n\nf 1 2 4\n")),
              "vertex index 4 is out of range; there are 3 vertices", "scene.obj:7");
  expectInput(failure(withTriangle("f 1//1 2//2 3//1\n")),
              "normal index 2 is out of range; there are 1 normal", "scene.obj:5");
}

TEST_F(ObjErrors, NamesAnIndexBeforeTheFirst) {
  expectInput(failure(withTriangle("f -1 -2 -4\n")), "vertex index -4", "scene.obj:5");
  expectInput(failure(withTriangle("f -1//-1 -2//-2 -3//-1\n")), "normal index -2", "scene.obj:5");
}

TEST_F(ObjErrors, NamesAnIndexBeyondTheLargest) {
  for (const std::string index : {"2147483648", "4294967297", "-4294967297", "99999999999999999999999"}) {
    expectInput(failure(withTriangle("f 1 2 " + index + "\n")),
                "vertex index " + index + " is beyond the largest that can be, 2147483647", "scene.obj:5");
  }
}

TEST_F(ObjErrors, NamesACornerThatIsNoIndex) {
  for (const std::string corner : {"x", "2x", "2.5", "/1", "2//y", "--2", "2//1/1"}) {
    expectInput(failure(withTriangle("f 1 " + corner + " 3\n")), "'" + corner + "' is not a corner",
                "scene.obj:5");
  }
}

TEST_F(ObjErrors, NamesAVertexWithoutThreeNumbers) {
  expectInput(failure("v 0 0\nf 1 1 1\n"), "three numbers", "scene.obj:1");
  expectInput(failure("v 0 0 0\nv 1 a 0\nf 1 1 1\n"), "'a' is not a number", "scene.obj:2");
  expectInput(failure("v 0 0 0\nv 1.5.5 0 0\n"), "'1.5.5' is not a number", "scene.obj:2");
  const Error comma = failure("v 0,5 0 0\n");
  expectInput(comma, "'0,5' is not a number", "scene.obj:1");
  EXPECT_NE(comma.advice().find("point"), std::string::npos);
}

TEST_F(ObjErrors, RefusesAFaceAtAVertexThatIsNotFinite) {
  for (const std::string number : {"nan", "-NaN", "inf", "-Infinity", "1e999", "nan(0x1)"}) {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 " + number + " 1\nf 1 2 3\n";
    EXPECT_EQ(read(obj).triangle_count, 1u) << number;
    expectInput(failure(obj + "f 1 2 4\n"), "vertex 4 of this face is not finite", "scene.obj:6");
  }
}

/// A scene with something of everything.
std::string rich() {
  return "# all\r\nmtllib a.mtl b.mtl\ns 1\nv 0 0 0 1 1 1\nv 1.5 0 0\nv 1.5 1e0 0\nv 0 1 \\\n 0\nv .5 .5 "
         "1\nvn 0 0 1\n"
         "vt 0 0\ng group\nusemtl red wall\nf 1/1/1 2/1/1 3/1/1 4/1/1\nusemtl lamp\nf -5//1 -4//1 -1//1\ns "
         "off\n"
         "f 2 3 5 # side\nl 1 2 3\np 4\nf 3 4 5 1 2\n";
}

TEST_F(ObjErrors, EveryBeginningOfAFileGivesASceneOrAnInputError) {
  write("a.mtl", "newmtl red wall\nKd 0.5 0 0\nmap_Kd x.png\nnewmtl lamp\nKd 1 1 1\nKe 3 3 3\n");
  const std::string obj = rich();
  std::size_t scenes = 0;
  for (std::size_t length = 0; length <= obj.size(); ++length) {
    try {
      scenes += read(std::string_view(obj).substr(0, length)).polygons.empty() ? 0 : 1;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
    }
  }
  EXPECT_GT(scenes, 0u);
}

TEST_F(ObjErrors, RandomDamageGivesASceneOrAnInputError) {
  const std::string mtl =
      "newmtl red wall\nKd 0.5 0 0\nmap_Kd -s 1 1 x.png\nnewmtl lamp\nKd 1 1 1\nKe 3 3 3\nTr 0.5\n";
  std::mt19937 random(7);
  const auto damage = [&](std::string text) {
    static constexpr std::string_view kLikely = "0123456789-/.e# \n\r\\\tvfnu";
    const std::size_t times = 1 + random() % 6;
    for (std::size_t k = 0; k < times && !text.empty(); ++k) {
      const std::size_t at = random() % text.size();
      const char c =
          random() % 4 == 0 ? static_cast<char>(random() % 256) : kLikely[random() % kLikely.size()];
      switch (random() % 4) {
        case 0:
          text[at] = c;
          break;
        case 1:
          text.insert(at, 1, c);
          break;
        case 2:
          text.erase(at, 1 + random() % 4);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 20));
          break;
      }
    }
    return text;
  };
  std::size_t scenes = 0;
  for (int i = 0; i < 1000; ++i) {
    write("a.mtl", damage(mtl));
    const std::string obj = damage(rich());
    try {
      const Scene scene = read(obj);
      ++scenes;
      for (const Corner& corner : scene.corners) {
        ASSERT_LT(corner.position, scene.positions.size());
        ASSERT_TRUE(corner.normal == kNone || corner.normal < scene.normals.size());
      }
      for (const Polygon& polygon : scene.polygons) ASSERT_LT(polygon.material, scene.materials.size());
    } catch (const Error& error) {
      ASSERT_EQ(error.kind(), ErrorKind::kInput) << error.what() << "\n" << obj;
    }
  }
  EXPECT_GT(scenes, 50u);
}

}  // namespace
}  // namespace unshot
