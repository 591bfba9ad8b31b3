// Groups of patches that may shoot as one, and the drafts that they give.
#include "formfactor/patch_groups.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesh/build.h"
#include "mesh/grid.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

constexpr std::uint32_t kMost = 16;

Scene byNumber(int scene) {
  return scene == 0 ? publishedCornellBox() : scene == 1 ? lShapedRoom() : blockOnFloor(0.4);
}

class PatchGroupsOf : public testing::TestWithParam<int> {};

TEST_P(PatchGroupsOf, HoldEachPatchOnceWithOthersOfItsSideAndAir) {
  const Mesh mesh = buildMesh(byNumber(GetParam()), {5000, {}, false});
  const PatchGroups groups(mesh, kMost);
  std::vector<int> seen(mesh.patch_count, 0);
  std::size_t joined = 0;
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    const std::vector<std::uint32_t>& members = groups.members(g);
    ASSERT_FALSE(members.empty());
    EXPECT_LE(members.size(), kMost);
    joined += members.size() > 1;
    for (const std::uint32_t q : members) {
      ++seen[q];
      EXPECT_EQ(groups.of(q), g);
      EXPECT_EQ(mesh.patch_side[q], mesh.patch_side[members.front()]);
      EXPECT_EQ(mesh.patch_air[q], mesh.patch_air[members.front()]);
      if (members.size() > 1) {
        EXPECT_EQ(mesh.sides[mesh.patch_side[q]].emission, glm::dvec3(0.0));
      }
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  if (GetParam() != 1) {  // where all emits there is nothing to join
    EXPECT_GT(joined, 5u);
  }
}

TEST_P(PatchGroupsOf, AreShotFromAPointOfTheirOwnAndHaveTheirArea) {
  const Mesh mesh = buildMesh(byNumber(GetParam()), {5000, {}, false});
  const PatchGroups groups(mesh, kMost);
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    const Region region = groups.region(g);
    double area = 0;
    for (const std::uint32_t q : groups.members(g)) area += mesh.patch_area[q];
    EXPECT_NEAR(region.area, area, 1e-9 * area);
    const Surface& surface = mesh.surfaces[region.surface];
    const double tolerance = 1e-9 * glm::length(surface.extent);
    const std::uint32_t element = elementAt(mesh, surface, region.sample, tolerance);
    ASSERT_NE(element, kNone) << "the point lies outside the surface";
    const Side& side = mesh.sides[mesh.patch_side[groups.members(g).front()]];
    EXPECT_EQ(
        groups.of(
            mesh.patch_parts[side.first_part + mesh.shapes[surface.elements.first + element].patch].patch),
        g);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PatchGroupsOf, testing::Values(0, 1, 2));

/// What patch q sends to elements, as shares of its light: with the escape and the defect 1.
std::vector<double> sharesOf(const Mesh& mesh, std::uint32_t q, const Column& column) {
  std::vector<double> out(mesh.element_count, 0.0);
  double sum = column.escape + column.defect;
  column.forEach([&](std::uint32_t e, double k) {
    out[e] = k * mesh.element_area[e] / mesh.patch_area[q];
    sum += out[e];
  });
  EXPECT_NEAR(sum, 1, 1e-6);
  return out;
}

TEST(DraftsOfGroups, AreOnePictureAndSendTheSameShares) {
  const Mesh mesh = buildMesh(publishedCornellBox(), {2000, {}, false});
  const PatchGroups groups(mesh, kMost);
  const auto method = makeMethod(findChoice(formFactorMethods(), "hemicube", "form-factor method"), mesh);
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    const std::vector<std::uint32_t>& members = groups.members(g);
    if (members.size() < 2) continue;
    const std::uint64_t drawn = method->drawn();
    const Column first = method->draft(members[0], ColumnQuality::kGroup);
    const Column second = method->draft(members[1], ColumnQuality::kGroup);
    EXPECT_EQ(method->drawn(), drawn + 1);
    EXPECT_EQ(first.quality, ColumnQuality::kGroup);
    EXPECT_FALSE(first.at_hand);
    EXPECT_TRUE(second.at_hand);
    const std::vector<double> a = sharesOf(mesh, members[0], first), b = sharesOf(mesh, members[1], second);
    for (std::size_t e = 0; e < a.size(); ++e) ASSERT_NEAR(a[e], b[e], 1e-6);
  }
}

// Between two sheets, a twentieth of their size apart, what each patch sends arrives opposite to it: one
// picture from the middle would send all of it there.
TEST(DraftsOfGroups, AreNotForSheetsThatFaceEachOther) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.7)), lamp = b.material("lamp", {}, glm::dvec3(10));
  addBox(b, allOf(grey), glm::dvec3(0), glm::dvec3(4), true);
  for (const double y : {1.0, 1.05}) b.quad(grey, {1, y, 1}, {0, 0, 1}, {1, 0, 0});
  b.quad(lamp, {1, 3.9, 1}, {1, 0, 0}, {0, 0, 1});
  const Mesh mesh = buildMesh(b.finish(), {20'000, {}, false});
  const auto method = makeMethod(findChoice(formFactorMethods(), "hemicube", "form-factor method"), mesh);
  int between = 0, open = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const Side& side = mesh.sides[mesh.patch_side[q]];
    const double height = mesh.surfaces[side.surface].origin.y + mesh.frame_origin.y;
    const bool lower = std::abs(height - 1) < 1e-6, upper = std::abs(height - 1.05) < 1e-6;
    if (std::abs(side.normal.y) < 0.5 || (!lower && !upper)) continue;
    const bool faced = lower ? side.normal.y > 0 : side.normal.y < 0;
    const ColumnQuality quality = method->draft(q, ColumnQuality::kGroup).quality;
    EXPECT_EQ(quality == ColumnQuality::kGroup, !faced) << "patch " << q;
    (faced ? between : open) += 1;
  }
  EXPECT_GT(between, 4);
  EXPECT_GT(open, 4);
}

// Patches of an emitter show in every shadow: they are never drafts.
TEST(DraftsOfGroups, AreNotForEmitters) {
  const Mesh mesh = buildMesh(publishedCornellBox(), {2000, {}, false});
  const auto method = makeMethod(findChoice(formFactorMethods(), "hemicube", "form-factor method"), mesh);
  int emitters = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    if (mesh.sides[mesh.patch_side[q]].emission == glm::dvec3(0.0)) continue;
    ++emitters;
    EXPECT_EQ(method->draft(q, ColumnQuality::kGroup).quality, ColumnQuality::kFull);
  }
  EXPECT_GT(emitters, 0);
}

}  // namespace
}  // namespace unshot
