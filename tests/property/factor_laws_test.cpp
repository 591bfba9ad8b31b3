// Laws of form factors that hold in any scene: signs, sums, reciprocity; and one method against another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "formfactor/polygon_factor.h"
#include "formfactor/regions.h"
#include "mesh/build.h"
#include "support/dice.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

struct SceneCase {
  const char* name;
  Scene (*make)();
  bool closed, convex;
};

Scene closedRooms() { return litAndDarkRoom(); }

const SceneCase kScenes[] = {{"Cube", [] { return cubeOneFaceLit(0.8); }, true, true},
                             {"Rooms", closedRooms, true, false},
                             {"LRoom", lShapedRoom, false, false},
                             {"Block", [] { return blockOnFloor(0.3); }, false, false},
                             {"Cornell", publishedCornellBox, false, false},
                             {"Squares", [] { return perpendicularSquares(0.5); }, false, true}};

struct Case {
  SceneCase scene;
  FormFactorMethodRow method;
};

std::vector<Case> cases() {
  std::vector<Case> out;
  for (const SceneCase& scene : kScenes) {
    for (const FormFactorMethodRow& method : formFactorMethods()) {
      if (scene.convex || method.info.key != "closed-form") out.push_back({scene, method});
    }
  }
  return out;
}

// `count` of the numbers below n.
std::vector<std::uint32_t> someOf(std::uint32_t n, std::uint32_t count, std::uint64_t seed) {
  Dice dice(seed);
  std::set<std::uint32_t> out;
  while (out.size() < std::min(n, count)) out.insert(dice.below(n));
  return {out.begin(), out.end()};
}

glm::dvec3 centreOf(const Mesh& mesh, std::uint32_t patch) {
  const Side& side = mesh.sides[mesh.patch_side[patch]];
  return mesh.surfaces[side.surface].point(regionOfPatch(mesh, patch).sample);
}

// Where a block stands on a floor, patches below it too.
MeshOptions withDarkSides(std::uint64_t elements) {
  MeshOptions options;
  options.elements = elements;
  options.dark_sides = true;
  return options;
}

class FactorLaws : public testing::TestWithParam<Case> {
 protected:
  // A row of hemicubes takes one of each patch.
  std::vector<std::uint32_t> someReceivers(std::uint64_t seed) const {
    const std::uint32_t count = GetParam().method.info.key == "hemicube-visibility" ? 8 : 40;
    return someOf(static_cast<std::uint32_t>(receivers_.size()), count, seed);
  }

  Mesh mesh_ = buildMesh(GetParam().scene.make(), withDarkSides(400));
  std::unique_ptr<FormFactorMethod> method_ = makeMethod(GetParam().method, mesh_);
  Receivers receivers_ = makeReceivers(mesh_, method_->receiverKind());
};

// Columns are kept as floats, their sums made up for by the defect, so that only the sum's own rounding is
// left.
TEST_P(FactorLaws, ColumnsAccountForAllOfAPatchsLight) {
  for (const std::uint32_t q : someOf(mesh_.patch_count, 25, 1)) {
    const Column column = method_->column(q);
    double sum = 0;
    column.forEach([&](std::uint32_t v, double k) {
      EXPECT_GT(k, 0);
      EXPECT_LE(k, 1.001);
      sum += k * receivers_.area[v] / mesh_.patch_area[q];
    });
    EXPECT_NEAR(sum + column.escape + column.defect, 1, 1e-12);
    EXPECT_GE(column.escape, 0);
    if (GetParam().scene.closed) {
      EXPECT_LT(column.escape, 1e-12) << "patch " << q;
    }
    // Hemicubes lose only what falls between surfaces; a pointwise method's defect is that of the mean over
    // vertices.
    const double most = method_->receiverKind() == ReceiverKind::kElements ? 1e-4 : 0.3;
    EXPECT_LT(std::abs(column.defect), most) << "patch " << q;
  }
}

TEST_P(FactorLaws, RowsSumToOne) {
  for (const std::uint32_t v : someReceivers(2)) {
    const Row row = method_->row(v);
    double sum = row.escape;
    for (const float k : row.k) {
      EXPECT_GT(k, 0);
      sum += static_cast<double>(k);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    // Where surfaces occlude, a ray or a few decide about a patch: what they leave open is part of a patch a
    // row. Methods that can see them take distant patches within 0.3 % (FactorPolygon::quick).
    const bool occluding = occludes(GetParam().method);
    const double sampled = !occluding ? 0 : GetParam().scene.convex ? 1e-4 : 0.04;
    EXPECT_GT(row.escape, -1e-6 - sampled);
    if (GetParam().scene.closed) {
      EXPECT_LT(row.escape, 1e-4 + sampled) << "receiver " << v;
    }
  }
}

// But a vertex where surfaces join smoothly looks from each: where they are folded inwards, as the two
// triangles of a quadrilateral that is not quite planar, one of them sees the other at a glancing angle.
TEST_P(FactorLaws, NothingSeesItself) {
  const auto surfaceOf = [&](std::uint32_t patch) { return mesh_.sides[mesh_.patch_side[patch]].surface; };
  for (const std::uint32_t q : someOf(mesh_.patch_count, 15, 3)) {
    method_->column(q).forEach([&](std::uint32_t v, double k) {
      std::size_t own = 0, others = 0;
      for (std::uint32_t s = receivers_.start[v]; s < receivers_.start[v + 1]; ++s)
        ++(surfaceOf(receivers_.shares[s].patch) == surfaceOf(q) ? own : others);
      if (own == 0) return;
      EXPECT_GT(others, 0u);
      EXPECT_LT(k, 0.01);
    });
  }
}

// The same numbers by shooting and by gathering. Closed form: the same to the last digit. Hemicubes: what an
// element sees of a patch at its centre against what the patch's samples see of the element, both counted in
// pixels.
TEST_P(FactorLaws, RowsAndColumnsAreTheSameNumbers) {
  const bool exact = method_->receiverKind() == ReceiverKind::kVertices;
  const auto some = someReceivers(4);
  std::vector<std::vector<double>> rows;
  for (const std::uint32_t v : some) {
    const Row row = method_->row(v);
    rows.emplace_back(mesh_.patch_count, 0.0);
    for (std::size_t i = 0; i < row.source.size(); ++i)
      rows.back()[row.source[i]] = static_cast<double>(row.k[i]);
  }
  double difference = 0, total = 0;
  for (const std::uint32_t q : someOf(mesh_.patch_count, 25, 5)) {
    std::vector<double> column(receivers_.size(), 0.0);
    method_->column(q).forEach([&](std::uint32_t v, double k) { column[v] = k; });
    for (std::size_t i = 0; i < some.size(); ++i) {
      const double here = column[some[i]], there = rows[i][q];
      if (exact) {
        EXPECT_EQ(here, there);
      }
      difference += (here - there) * (here - there);
      total += here * here;
    }
  }
  measured("relative L2 difference of rows and columns", std::sqrt(difference / total));
  EXPECT_LT(std::sqrt(difference / total), 0.25);
}

INSTANTIATE_TEST_SUITE_P(Scenes, FactorLaws, testing::ValuesIn(cases()), [](const auto& row) {
  return std::string(row.param.scene.name) + "_" + testName(row.param.method.info.key);
});

// The relative L2 difference of A_p F_pq and A_q F_qp, means over a patch's vertices, of pairs at least three
// patches apart.
double defectOfReciprocity(std::uint64_t elements) {
  const Mesh mesh = buildMesh(cubeOneFaceLit(0.5), {elements, {}, false});
  EXPECT_EQ(mesh.patch_count, 6u * 64);
  const auto method = makeMethod(methodRow("closed-form"), mesh);
  const Receivers receivers = makeReceivers(mesh, ReceiverKind::kVertices);
  const auto patches = someOf(mesh.patch_count, 40, 6);
  std::vector<std::vector<double>> received(patches.size(), std::vector<double>(mesh.patch_count, 0.0));
  for (std::size_t i = 0; i < patches.size(); ++i) {
    method->column(patches[i]).forEach([&](std::uint32_t v, double k) {
      for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s) {
        received[i][receivers.shares[s].patch] += receivers.shares[s].area * k;
      }
    });
  }
  double difference = 0, total = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (glm::distance(centreOf(mesh, patches[i]), centreOf(mesh, patches[j])) < 3.0 / 8) continue;
      const double there = received[i][patches[j]], back = received[j][patches[i]];
      difference += (there - back) * (there - back);
      total += there * there;
    }
  }
  return std::sqrt(difference / total);
}

// All that stands between is the trapezoidal mean over a patch, whose error falls with the square of the
// vertices' distance: 4 vertices a patch, then 25, four times as close.
TEST(ClosedFormFactors, AreReciprocalButForTheMeanOverVertices) {
  const double coarse = defectOfReciprocity(6 * 64), fine = defectOfReciprocity(6 * 64 * 16);
  measured("4 vertices a patch", coarse);
  measured("25 vertices a patch", fine);
  EXPECT_LT(coarse, 0.06);
  EXPECT_LT(fine, coarse / 10);
}

// Hemicube columns in the cube against the mean of exact point factors over each element (3 x 3 points of
// Gauss), at elements at least four patches above the patch's plane: nearer, what is left is the patch seen
// as a few points, and more pixels do not help (furnace_test says how much that is).
TEST(HemicubeColumns, ComeCloserToClosedFormsTheFinerTheirPixelsAre) {
  const Mesh mesh = buildMesh(furnaceScene(0.5, 0.5), {6 * 144, {}, false});
  const auto patches = someOf(mesh.patch_count, 12, 7);
  std::vector<std::vector<double>> exact(patches.size(), std::vector<double>(mesh.element_count, 0.0));
  std::vector<std::vector<char>> counts(patches.size(), std::vector<char>(mesh.element_count, 0));
  std::vector<glm::dvec3> scratch;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Side& side = mesh.sides[mesh.patch_side[patches[i]]];
    const Surface& surface = mesh.surfaces[side.surface];
    const Region region = regionOfPatch(mesh, patches[i]);
    const std::vector<glm::dvec3> ring{
        surface.point(region.low), surface.point({region.high.x, region.low.y}), surface.point(region.high),
        surface.point({region.low.x, region.high.y})};
    for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
      const Side& other = mesh.sides[mesh.element_side[e]];
      if (other.surface == side.surface) continue;
      const Surface& s = mesh.surfaces[other.surface];
      const glm::dvec3 centre = mesh.shapes[s.elements.first + e - other.first_element].centre;
      if (glm::dot(centre - surface.origin, side.normal) < 4.0 / 12) continue;
      counts[i][e] = 1;
      const double step = std::sqrt(0.6) / 24, weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
      for (int k = 0; k < 9; ++k) {
        const glm::dvec3 p = centre + (k % 3 - 1) * step * s.axis_u + (k / 3 - 1) * step * s.axis_v;
        exact[i][e] += weight[k % 3] * weight[k / 3] * pointToPolygonFactor(p, other.normal, ring, scratch);
      }
    }
  }
  double last = INFINITY;
  for (const std::uint32_t resolution : {32u, 128u, 512u}) {
    const auto method = makeMethod(methodRow("hemicube"), mesh, resolution);
    double difference = 0, total = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      std::vector<double> k(mesh.element_count, 0.0);
      method->column(patches[i]).forEach([&](std::uint32_t e, double value) { k[e] = value; });
      for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
        if (!counts[i][e]) continue;
        difference += (k[e] - exact[i][e]) * (k[e] - exact[i][e]);
        total += exact[i][e] * exact[i][e];
      }
    }
    const double error = std::sqrt(difference / total);
    measured(std::to_string(resolution) + " pixels, relative L2 error", error);
    EXPECT_LT(error, 0.7 * last);
    last = error;
  }
  EXPECT_LT(last, 0.02);
}

}  // namespace
}  // namespace unshot
