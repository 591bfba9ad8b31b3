// Blocks of receivers, and columns that are interpolated over them, against every entry computed by itself.
#include "formfactor/receiver_blocks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formfactor/methods.h"
#include "mesh/build.h"
#include "mesh/refine.h"
#include "support/dice.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

Mesh layered(const Scene& scene, std::uint64_t elements) {
  Dice dice(1);
  return refineMesh(std::make_shared<const Mesh>(buildMesh(scene, {elements, {}, false, true})),
                    [&](const CellPart& part) { return part.depth == 0 && dice.between(0, 1) < 0.1; });
}

TEST(ReceiverBlocks, AreGridsThatHoldEachReceiverOrLeaveItToTheRest) {
  for (const Scene& scene : {publishedCornellBox(), blockOnFloor(0.3), lShapedRoom()}) {
    const Mesh mesh = layered(scene, 1500);
    const Receivers receivers = makeReceivers(mesh, ReceiverKind::kVertices);
    const ReceiverBlocks found = receiverBlocks(mesh, receivers);
    const Range all = receivers.reachedBy(false);
    std::vector<int> held(all.count, 0);
    std::size_t in_blocks = 0;
    for (const ReceiverBlock& block : found.blocks) {
      ASSERT_EQ(block.vertex.size(), (block.nu + 1) * (block.nv + 1));
      EXPECT_TRUE(block.nu > 2 || block.nv > 2);
      const Side& side = mesh.sides[receivers.viewsOf(block.vertex[0])[0].side];
      const Surface& surface = mesh.base->surfaces[side.surface];
      const glm::dvec2 step = surface.extent / glm::dvec2(surface.nu, surface.nv);
      const auto at = [&](std::uint32_t v) {
        return surface.chart(glm::dvec3(mesh.base->vertices[v - all.first].position)) / step;
      };
      const glm::dvec2 first = at(block.vertex[0]);
      for (std::uint32_t j = 0; j <= block.nv; ++j) {
        for (std::uint32_t i = 0; i <= block.nu; ++i) {
          const std::uint32_t v = block.at(i, j);
          held[v - all.first] |= 1;
          EXPECT_EQ(receivers.viewsOf(v).size(), 1u);
          EXPECT_LT(glm::length(at(v) - first - glm::dvec2(i, j)), 1e-3);
        }
      }
    }
    for (const std::uint32_t v : found.rest) {
      EXPECT_EQ(held[v - all.first], 0);
      held[v - all.first] |= 2;
    }
    for (const int h : held) {
      EXPECT_NE(h, 0);
      in_blocks += h == 1;
    }
    EXPECT_GT(in_blocks, all.count / 4);
  }
}

TEST(ReceiverBlocks, AreNoneWhereThereIsOneLayer) {
  const Mesh mesh = buildMesh(publishedCornellBox(), {1500, {}, false, true});
  EXPECT_TRUE(receiverBlocks(mesh, makeReceivers(mesh, ReceiverKind::kVertices)).blocks.empty());
}

// Rows have every factor by itself.
TEST(ReceiverBlocks, ColumnsAreNearlyWhatTheyAreEntryByEntry) {
  const Mesh mesh = layered(publishedCornellBox(), 1500);
  const auto receivers = std::make_shared<const Receivers>(makeReceivers(mesh, ReceiverKind::kVertices));
  FormFactorSetup setup;
  setup.mesh = &mesh;
  setup.receivers = receivers;
  const auto method = methodRow("rays").make(setup);
  std::vector<Column> columns;
  for (std::uint32_t q = 0; q < mesh.patch_count; q += 7) columns.push_back(method->column(q));
  double difference = 0, size = 0;
  std::size_t off = 0, entries = 0;
  const Range range = receivers->reachedBy(false);
  for (std::uint32_t v = range.first; v < range.end(); v += 3) {
    std::vector<double> exact(mesh.patch_count, 0.0);
    const Row row = method->row(v);
    for (std::size_t k = 0; k < row.source.size(); ++k) exact[row.source[k]] = double{row.k[k]};
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (mesh.emits(static_cast<std::uint32_t>(7 * c))) continue;
      const double found = double{columns[c].k[v - range.first]}, meant = exact[7 * c];
      difference += (found - meant) * (found - meant);
      size += meant * meant;
      off += std::abs(found - meant) > 0.05 * meant;
      ++entries;
    }
  }
  measured("RMS difference", std::sqrt(difference / size));
  measured("share of entries more than 5 % off", double(off) / double(entries));
  EXPECT_LT(std::sqrt(difference / size), 0.005);
  EXPECT_LT(double(off) / double(entries), 0.005);
}

}  // namespace
}  // namespace unshot
