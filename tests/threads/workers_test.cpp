// Work that threads share out: all of it is done, once, and comes out as if one had done it.
#include "base/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>

#include "formfactor/methods.h"
#include "mesh/build.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

TEST(Workers, DoEachPartOnce) {
  Workers workers(4);
  ASSERT_EQ(workers.count(), 4u);
  for (const std::size_t parts : {0, 1, 2, 3, 7, 1000}) {
    std::vector<int> done(parts, 0);
    std::vector<std::atomic<int>> at_work(workers.count());
    workers.run(parts, [&](std::size_t part, unsigned worker) {
      ASSERT_LT(worker, 4u);
      EXPECT_EQ(at_work[worker]++, 0) << "two parts at a time";
      ++done[part];
      --at_work[worker];
    });
    EXPECT_EQ(std::accumulate(done.begin(), done.end(), std::size_t{0}), parts);
    for (const int times : done) EXPECT_EQ(times, 1);
  }
}

TEST(Workers, ThrowWhatAPartThrowsAndGoOnAfterwards) {
  Workers workers(3);
  std::atomic<int> under_way = 0;
  const auto fail = [&](std::size_t part, unsigned) {
    ++under_way;
    if (part == 5) {
      --under_way;
      throw std::runtime_error("part 5");
    }
    --under_way;
  };
  for (int k = 0; k < 20; ++k) {
    EXPECT_THROW(workers.run(100, fail), std::runtime_error);
    EXPECT_EQ(under_way, 0) << "a part is still under way";
  }
  std::atomic<int> done = 0;
  workers.run(50, [&](std::size_t, unsigned) { ++done; });
  EXPECT_EQ(done, 50);
}

TEST(Workers, OneIsTheCallingThread) {
  Workers workers(1);
  const std::thread::id caller = std::this_thread::get_id();
  workers.run(10, [&](std::size_t, unsigned worker) {
    EXPECT_EQ(worker, 0u);
    EXPECT_EQ(std::this_thread::get_id(), caller);
  });
}

// Rays go together with the same others whoever sends them, so that not even rounding differs.
TEST(Workers, MakeTheSameColumns) {
  const Mesh mesh = buildMesh(publishedCornellBox(), {3000, {}, false});
  FormFactorSetup setup;
  setup.mesh = &mesh;
  const auto alone = makeRays(setup);
  setup.workers = std::make_shared<Workers>(3);
  const auto shared = makeRays(setup);
  std::size_t most = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; q += 7) {
    const Column a = alone->column(q), b = shared->column(q);
    most = std::max(most, a.k.size());
    EXPECT_EQ(a.k, b.k) << q;
    EXPECT_EQ(a.escape, b.escape);
  }
  EXPECT_GT(most, 2048u) << "too few receivers to be shared out";
}

}  // namespace
}  // namespace unshot
