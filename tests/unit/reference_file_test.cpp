// References kept as files.
#include "report/reference_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "support/error_of.h"
#include "support/temp_folder.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

ReferenceOptions sixPoints() {
  ReferenceOptions options;
  options.points = 6;
  options.relative_error = 0;
  options.max_samples = 64;
  return options;
}

std::string nameOf(const Scene& scene, const ReferenceOptions& options) {
  return referencePath({}, scene, options).string();
}

bool saysCache(const Reference& reference) {
  for (const Diagnostic& d : reference.diagnostics) {
    if (d.code == "reference-cache") return true;
  }
  return false;
}

void expectSame(const std::vector<ReferencePoint>& a, const std::vector<ReferencePoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].position, b[k].position);
    EXPECT_EQ(a[k].normal, b[k].normal);
    EXPECT_EQ(a[k].reflectance, b[k].reflectance);
    EXPECT_EQ(a[k].emission, b[k].emission);
    EXPECT_EQ(a[k].radiosity, b[k].radiosity);
    EXPECT_EQ(a[k].standard_error, b[k].standard_error);
    EXPECT_EQ(a[k].samples, b[k].samples);
    EXPECT_EQ(a[k].material, b[k].material);
  }
}

TEST(ReferenceFile, IsTracedOnceAndReadBackBitByBit) {
  const TempFolder folder;
  const Scene scene = publishedCornellBox();
  const Reference first = cachedReference(scene, sixPoints(), folder.path());
  EXPECT_FALSE(first.from_file);
  EXPECT_FALSE(saysCache(first));
  EXPECT_THAT(folder.names(), ElementsAre(nameOf(scene, sixPoints())));
  const Reference second = cachedReference(scene, sixPoints(), folder.path());
  EXPECT_TRUE(second.from_file);
  EXPECT_GE(second.seconds, first.seconds);
  expectSame(first.points, second.points);
  expectSame(first.points, readReferencePoints(folder / nameOf(scene, sixPoints())));
}

TEST(ReferenceFile, IsTracedOnWhereMoreIsAskedFor) {
  const TempFolder folder;
  const Scene scene = publishedCornellBox();
  cachedReference(scene, sixPoints(), folder.path());
  ReferenceOptions more = sixPoints();
  more.max_samples = 128;
  const Reference longer = cachedReference(scene, more, folder.path());
  EXPECT_FALSE(longer.from_file);
  const Reference at_once = traceReference(scene, more);
  for (std::size_t k = 0; k < at_once.points.size(); ++k) {
    EXPECT_EQ(longer.points[k].samples, 128u);
    EXPECT_NEAR(longer.points[k].radiosity.x, at_once.points[k].radiosity.x, 1e-12);
    EXPECT_NEAR(longer.points[k].standard_error.x, at_once.points[k].standard_error.x, 1e-12);
  }
  // Less is asked for: what is there is better.
  EXPECT_EQ(cachedReference(scene, sixPoints(), folder.path()).points[0].samples, 128u);
}

TEST(ReferenceFile, BelongsToOneSceneAndOneSetOfOptions) {
  const Scene scene = cubeOneFaceLit(0.5);
  std::set<std::uint64_t> hashes{referenceHash(scene, sixPoints())};
  const auto expectOther = [&](const Scene& s, const ReferenceOptions& o) {
    EXPECT_TRUE(hashes.insert(referenceHash(s, o)).second);
  };
  expectOther(cubeOneFaceLit(0.6), sixPoints());
  Scene changed = scene;
  changed.positions[5].y += 1e-9;
  expectOther(changed, sixPoints());
  changed = scene;
  changed.materials[0].emission.z = 2;
  expectOther(changed, sixPoints());
  ReferenceOptions options = sixPoints();
  options.seed = 2;
  expectOther(scene, options);
  options = sixPoints();
  options.emit_front_only = true;
  expectOther(scene, options);
  options = sixPoints();
  options.points = 7;
  expectOther(scene, options);
  options = sixPoints();
  options.places = {{{0.5, 1, 0.5}, {0, -1, 0}}};
  expectOther(scene, options);
  changed = scene;
  changed.name = "other";
  changed.materials[0].name = "other";
  options = sixPoints();
  options.max_samples = 1;
  options.relative_error = 0.5;
  options.threads = 5;
  EXPECT_EQ(referenceHash(changed, options), referenceHash(scene, sixPoints()));
}

TEST(ReferenceFile, IsTracedAgainWhereItIsDamaged) {
  const TempFolder folder;
  const Scene scene = cubeOneFaceLit(0.5);
  const std::string name = nameOf(scene, sixPoints());
  const Reference good = cachedReference(scene, sixPoints(), folder.path());
  const std::string text = folder.read(name);
  std::string digit = text;
  const std::size_t last = digit.find_last_of("0123456789", digit.size() - 20);
  digit[last] = digit[last] == '1' ? '2' : '1';
  const std::string cut = text.substr(0, text.size() - 30);
  std::string row_less = text;
  row_less.erase(row_less.rfind('\n', row_less.size() - 2) + 1);
  for (const std::string& damaged :
       {digit, cut, row_less, std::string("x"), std::string(), std::string(99, '\0')}) {
    folder.write(name, damaged);
    const Reference again = cachedReference(scene, sixPoints(), folder.path());
    EXPECT_FALSE(again.from_file);
    EXPECT_TRUE(saysCache(again));
    expectSame(good.points, again.points);
    EXPECT_TRUE(cachedReference(scene, sixPoints(), folder.path()).from_file);
  }
  // A good file of another scene under this name.
  const Scene other = cubeOneFaceLit(0.6);
  cachedReference(other, sixPoints(), folder.path());
  folder.write(name, folder.read(nameOf(other, sixPoints())));
  EXPECT_TRUE(saysCache(cachedReference(scene, sixPoints(), folder.path())));
}

TEST(ReferenceFile, IsMissedWithoutHarmWhereItCannotBeWritten) {
  const TempFolder folder;
  const Reference reference = cachedReference(cubeOneFaceLit(0.5), sixPoints(), folder.path() / "missing");
  EXPECT_EQ(reference.points.size(), 6u);
  EXPECT_TRUE(saysCache(reference));
}

TEST(ReferenceFile, IsNotMadeOfNothing) {
  const TempFolder folder;
  ReferenceOptions options = sixPoints();
  options.max_seconds = 0;
  cachedReference(cubeOneFaceLit(0.5), options, folder.path());
  EXPECT_TRUE(folder.names().empty());
}

TEST(ReferenceFile, MayComeFromElsewhere) {
  const TempFolder folder;
  const std::string file = folder.write("truth.csv",
                                        "# comment\nx,y,z,nx,ny,nz,E_r,E_g,E_b,B_r,B_g,B_b,more\n"
                                        "1,2,3,0,0,2,0,0,0,0.5,0.25,0.125,7\n");
  const auto points = readReferencePoints(file);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(points[0].normal, glm::dvec3(0, 0, 1));
  EXPECT_EQ(points[0].radiosity, glm::dvec3(0.5, 0.25, 0.125));
  EXPECT_EQ(points[0].standard_error, glm::dvec3(0.0));
  const Error column =
      errorOf([&] { readReferencePoints(folder.write("a.csv", "x,y,z,nx,ny,nz\n0,0,0,0,0,1\n")); });
  EXPECT_THAT(column.what(), HasSubstr("E_r"));
  const Error number = errorOf([&] {
    readReferencePoints(
        folder.write("b.csv", "x,y,z,nx,ny,nz,E_r,E_g,E_b,B_r,B_g,B_b\n0,0,0,0,0,1,0,0,0,nan,0,0\n"));
  });
  EXPECT_THAT(number.where(), HasSubstr("b.csv:2"));
}

}  // namespace
}  // namespace unshot
