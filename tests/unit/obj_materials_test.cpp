// What MTL files become.
#include <cmath>

#include "unit/obj_fixture.h"

namespace unshot {
namespace {

using ObjMaterials = ObjFileTest;

constexpr std::string_view kFourVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

std::string sceneWith(std::string_view library, std::string_view material) {
  return "mtllib " + std::string(library) + "\n" + std::string(kFourVertices) + "usemtl " +
         std::string(material) + "\nf 1 2 3\n";
}

const Material& materialOf(const Scene& scene, std::size_t polygon = 0) {
  return scene.materials.at(scene.polygons.at(polygon).material);
}

TEST_F(ObjMaterials, ReadsReflectanceAndEmission) {
  write("a.mtl", "newmtl lamp\nKd 0.78 0.5 0.25\nKe 17 12 4\n");
  const Scene scene = read(sceneWith("a.mtl", "lamp"));
  EXPECT_EQ(materialOf(scene).name, "lamp");
  expectNear(materialOf(scene).reflectance, {0.78, 0.5, 0.25});
  expectNear(materialOf(scene).emission, {17, 12, 4});
  EXPECT_TRUE(scene.diagnostics.empty());
}

TEST_F(ObjMaterials, ReadsNothingOfThoseThatNoFaceHas) {
  write("a.mtl", "newmtl a\nKd .1 .1 .1\nnewmtl b\nKd 1 1 1\nmap_Kd gone.png\n");
  const Scene scene = read("mtllib a.mtl\n" + std::string(kFourVertices) +
                           "usemtl b\nusemtl a\nf 1 2 3\nf 1 2 4\nusemtl nowhere\n");
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].name, "a");
  ASSERT_EQ(scene.diagnostics.size(), 1u);
  EXPECT_EQ(scene.diagnostics[0].code, "no-light");
}

TEST_F(ObjMaterials, ReadsSeveralLibrariesOnSeveralLinesAndOnOne) {
  write("a.mtl", "newmtl a\nKd .1 .1 .1\n");
  write("b.mtl", "newmtl b\nKd .2 .2 .2\n");
  write("c.mtl", "newmtl c\nKd .3 .3 .3\n");
  const Scene scene = read("mtllib a.mtl b.mtl\n" + std::string(kFourVertices) +
                           "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\nmtllib c.mtl\nusemtl c\nf 1 3 4\n");
  EXPECT_NEAR(materialOf(scene, 0).reflectance.x, 0.1, 1e-12);
  EXPECT_NEAR(materialOf(scene, 1).reflectance.x, 0.2, 1e-12);
  EXPECT_NEAR(materialOf(scene, 2).reflectance.x, 0.3, 1e-12);
  expectNoDiagnostic(scene, "missing-mtl");
}

TEST_F(ObjMaterials, FindsFilesWhoseNamesHaveBlanksOrOtherLetters) {
  std::filesystem::create_directories(folder_ / "sub dir");
  write("two words.mtl", "newmtl a\nKd .2 .2 .2\n");
  write("Wände.mtl", "newmtl a\nKd .3 .3 .3\n");
  write("sub dir/x.mtl", "newmtl a\nKd .4 .4 .4\n");
  const auto rho = [&](const std::string& library) {
    const Scene scene = read(sceneWith(library, "a"));
    expectNoDiagnostic(scene, "missing-mtl");
    return materialOf(scene).reflectance.x;
  };
  EXPECT_NEAR(rho("two words.mtl"), 0.2, 1e-12);
  EXPECT_NEAR(rho("  two words.mtl \t "), 0.2, 1e-12);
  EXPECT_NEAR(rho("\"two words.mtl\""), 0.2, 1e-12);
  EXPECT_NEAR(rho("two words.mtl # a comment"), 0.2, 1e-12);
  EXPECT_NEAR(rho("two words.mtl Wände.mtl"), 0.2, 1e-12);
  EXPECT_NEAR(rho("Wände.mtl two words.mtl"), 0.3, 1e-12);
  EXPECT_NEAR(rho("sub dir\\x.mtl"), 0.4, 1e-12);
  EXPECT_NEAR(rho("./sub dir/x.mtl\r"), 0.4, 1e-12);
}

TEST_F(ObjMaterials, TellsMaterialsApartWhoseNamesHaveBlanksOrOtherLetters) {
  write("a.mtl",
        "\xEF\xBB\xBFnewmtl red wall \r\nKd .1 .1 .1\r\nnewmtl red\r\n\tKd\t.2 .2 .2\r\nnewmtl Größe\r\nKd "
        ".3 .3 .3\r\n"
        "newmtl Color #3\r\nKd .4 .4 .4 # three\r\nnewmtl Color #4\r\nKd .5 .5 .5\r\nnewmtl plain # "
        "why\r\nKd .6 .6 \\\r\n.6");
  const auto rho = [&](const std::string& name) {
    const Scene scene = read(sceneWith("a.mtl", name));
    expectNoDiagnostic(scene, "unknown-material");
    return materialOf(scene).reflectance.z;
  };
  EXPECT_NEAR(rho("red wall"), 0.1, 1e-12);
  EXPECT_NEAR(rho("red"), 0.2, 1e-12);
  EXPECT_NEAR(rho("red # a comment"), 0.2, 1e-12);
  EXPECT_NEAR(rho("  Größe  "), 0.3, 1e-12);
  EXPECT_NEAR(rho("Color #3"), 0.4, 1e-12);
  EXPECT_NEAR(rho("Color #4"), 0.5, 1e-12);
  EXPECT_NEAR(rho("plain"), 0.6, 1e-12);
}

TEST_F(ObjMaterials, MakesUnknownMaterialsGrey) {
  write("a.mtl", "newmtl a\nKd .2 .2 .2\n");
  const Scene scene = read(sceneWith("a.mtl", "b") + "usemtl c\nf 1 2 4\n");
  EXPECT_EQ(materialOf(scene).name, "b");
  expectNear(materialOf(scene).reflectance, glm::dvec3(0.5));
  expectNear(materialOf(scene).emission, glm::dvec3(0));
  expectDiagnostic(scene, "unknown-material", "'b' is not defined (and 1 more)", "scene.obj:6");
}

TEST_F(ObjMaterials, MakesFacesWithoutMaterialGrey) {
  const Scene scene = read(std::string(kFourVertices) + "f 1 2 3\nf 1 2 4\n");
  expectNear(materialOf(scene).reflectance, glm::dvec3(0.5));
  expectDiagnostic(scene, "no-material", "2 faces have", "scene.obj:5");
}

TEST_F(ObjMaterials, SaysWhichLibraryIsMissing) {
  const Scene scene = read(sceneWith("not here.mtl", "b"));
  expectDiagnostic(scene, "missing-mtl", "'not here.mtl'", "scene.obj:1");
  expectDiagnostic(scene, "unknown-material", "'b'", "scene.obj:6");
  write("a.mtl", "newmtl b\nKd 1 1 1\n");
  const Scene partly = read(sceneWith("gone.mtl a.mtl", "b"));
  expectDiagnostic(partly, "missing-mtl", "'gone.mtl'", "scene.obj:1");
  EXPECT_EQ(materialOf(partly).reflectance.x, 1.0);
  expectDiagnostic(read(sceneWith("", "b")), "missing-mtl", "names no file", "scene.obj:1");
}

TEST_F(ObjMaterials, SaysThatALibraryHasNoMaterials) {
  write("a.mtl", "Kd 1 1 1\n");
  expectDiagnostic(read(sceneWith("a.mtl", "b")), "unreadable-mtl", "no newmtl", "a.mtl");
}

TEST_F(ObjMaterials, UsesTheFirstOfSeveralDefinitions) {
  write("a.mtl", "newmtl a\nKd .2 .2 .2\nnewmtl a\nKd .3 .3 .3\n");
  const Scene scene = read(sceneWith("a.mtl", "a"));
  EXPECT_NEAR(materialOf(scene).reflectance.x, 0.2, 1e-12);
  expectDiagnostic(scene, "repeated-material", "'a'", "a.mtl:3");
}

TEST_F(ObjMaterials, ClampsReflectancesAndNamesMaterialAndValue) {
  write("a.mtl", "newmtl a\nKd 1.5 -0.5 nan\nnewmtl b\nKd inf -inf 1\nnewmtl c\nKd 1 0 -0\n");
  const Scene scene = read(sceneWith("a.mtl", "a") + "usemtl b\nf 1 2 4\nusemtl c\nf 1 3 4\n");
  expectNear(materialOf(scene, 0).reflectance, {1, 0, 0}, 0);
  expectNear(materialOf(scene, 1).reflectance, {1, 0, 1}, 0);
  expectDiagnostic(scene, "reflectance-clamped",
                   "'a': Kd 1.5 -0.5 nan is outside 0..1 and was clamped (and 1 more)", "a.mtl:2");
}

TEST_F(ObjMaterials, ClampsEmissions) {
  write("a.mtl", "newmtl a\nKd 0 0 0\nKe -1 2 nan\nnewmtl b\nKd 0 0 0\nKe 1 1e999 3\n");
  const Scene scene = read(sceneWith("a.mtl", "a") + "usemtl b\nf 1 2 4\n");
  expectNear(materialOf(scene, 0).emission, {0, 2, 0}, 0);
  expectNear(materialOf(scene, 1).emission, {1, 0, 3}, 0);
  expectDiagnostic(scene, "emission-clamped", "'a': Ke -1 2 nan", "a.mtl:3");
}

TEST_F(ObjMaterials, TakesOneNumberForAllChannels) {
  write("a.mtl", "newmtl a\nKd 0.25\nKe 3\n");
  const Scene scene = read(sceneWith("a.mtl", "a"));
  expectNear(materialOf(scene).reflectance, glm::dvec3(0.25));
  expectNear(materialOf(scene).emission, glm::dvec3(3));
}

TEST_F(ObjMaterials, SaysThatAColourIsNoThreeNumbers) {
  write("a.mtl", "newmtl a\nKd spectral red.rfl 1\nKe bright\n");
  const Scene scene = read(sceneWith("a.mtl", "a"));
  expectNear(materialOf(scene).reflectance, glm::dvec3(0.5));
  expectNear(materialOf(scene).emission, glm::dvec3(0));
  expectDiagnostic(scene, "unreadable-colour", "'a': Kd 'spectral red.rfl 1'", "a.mtl:2");
}

TEST_F(ObjMaterials, LetsAMaterialWithoutKdReflectNothing) {
  write("a.mtl", "newmtl a\nKe 1 1 1\n");
  const Scene scene = read(sceneWith("a.mtl", "a"));
  expectNear(materialOf(scene).reflectance, glm::dvec3(0));
  expectDiagnostic(scene, "no-kd", "'a'", "a.mtl:1");
}

TEST_F(ObjMaterials, MultipliesKdByTheLinearMeanOfItsTexture) {
  // Half black, half white in red; sRGB 188 in green is 0.5029 linear; full blue.
  write("my image.ppm", std::string("P6\n2 1\n255\n\x00\xBC\xFF\xFF\xBC\xFF", 17));
  write("a.mtl", "newmtl a\nKd 0.5 1 0.5\nmap_Kd -s 1 1 1 my image.ppm\nnewmtl b\nmap_Kd my image.ppm\n");
  const Scene scene = read(sceneWith("a.mtl", "a") + "usemtl b\nf 1 2 4\n");
  const double green = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
  expectNear(materialOf(scene, 0).reflectance, {0.25, green, 0.5});
  expectNear(materialOf(scene, 1).reflectance, {0.5, green, 1});
  expectNoDiagnostic(scene, "unreadable-texture");
}

TEST_F(ObjMaterials, UsesKdAloneWhereATextureCannotBeRead) {
  write("bad.png", "no image");
  write("a.mtl",
        "newmtl a\nKd 0.5 0.4 0.3\nmap_Kd gone.png\nnewmtl b\nKd 0.2 0.2 0.2\nmap_Kd bad.png\nnewmtl c\nKd 0 "
        "0 0\nmap_Kd\n");
  const Scene scene = read(sceneWith("a.mtl", "a") + "usemtl b\nf 1 2 4\nusemtl c\nf 1 3 4\n");
  expectNear(materialOf(scene, 0).reflectance, {0.5, 0.4, 0.3});
  expectNear(materialOf(scene, 1).reflectance, glm::dvec3(0.2));
  expectDiagnostic(scene, "unreadable-texture", "'a': the texture 'gone.png' cannot be read (and 2 more)",
                   "a.mtl:3");
}

TEST_F(ObjMaterials, NotesOnceWhatItReadsPast) {
  write("a.mtl",
        "newmtl a\nKd 0 0 0\nKs 0.5 0 0\nd 0.5\nTr 0.5\nNs 10\nillum 2\nnewmtl b\nKd 0 0 0\nKs 1 1 1\nmap_Ke "
        "x.png\n");
  const Scene scene = read(sceneWith("a.mtl", "a") + "usemtl b\nf 1 2 4\n");
  expectDiagnostic(scene, "read-past", "Ks, Tr, d, map_Ke", "a.mtl:1");
  EXPECT_EQ(findDiagnostic(scene, "read-past")->severity, Severity::kNote);
}

TEST_F(ObjMaterials, DoesNotNoteValuesThatAskForNothing) {
  write("a.mtl", "newmtl a\nKa 1 1 1\nKd 0 0 0\nKs 0 0.0 0\nd 1.0\nTr 0\nTf 1 1 1\nNs 10\nNi 1.5\nillum 2\n");
  expectNoDiagnostic(read(sceneWith("a.mtl", "a")), "read-past");
}

TEST_F(ObjMaterials, WarnsOfASceneWithoutLight) {
  write("a.mtl", "newmtl a\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\n");
  const Scene dark = read(sceneWith("a.mtl", "a") + "usemtl lamp\n");
  expectDiagnostic(dark, "no-light", "no face emits light", "scene.obj");
  EXPECT_EQ(findDiagnostic(dark, "no-light")->severity, Severity::kWarning);
  expectNoDiagnostic(read(sceneWith("a.mtl", "lamp")), "no-light");
}

}  // namespace
}  // namespace unshot
