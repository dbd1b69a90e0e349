// Parallel loops over ranges and over items, and the lease of a pool.
#include "parallel/thread_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "kinesphere/workers.hpp"

namespace kinesphere::thread_pool_test {
namespace {

TEST(PoolLease, WithoutWorkersDoesAllOnOneThread) {
  PoolLease alone;
  EXPECT_TRUE(static_cast<bool>(alone));
  EXPECT_EQ(alone.count(), 1u);
  std::vector<std::size_t> items;
  alone.for_each(5, 2, [&](std::size_t k, std::size_t worker) {
    EXPECT_EQ(worker, 0u);
    items.push_back(k);
  });
  EXPECT_EQ(items, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  alone.for_each(0, 2, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(PoolLease, DoesEachItemOnceWithAnyNumberOfThreads) {
  Workers workers = Workers::create(3).value();
  PoolLease lease(&workers);
  ASSERT_TRUE(static_cast<bool>(lease));
  for (const std::size_t count : {1u, 7u, 1000u}) {
    std::vector<std::atomic<int>> done(count);
    lease.for_each(count, 4, [&](std::size_t k, std::size_t worker) {
      EXPECT_LT(worker, lease.count());
      ++done[k];
    });
    for (const auto& times : done) EXPECT_EQ(times, 1);
    std::atomic<std::size_t> in_ranges = 0;
    lease.parallel_for(count, 4, [&](std::size_t begin, std::size_t end, std::size_t) {
      EXPECT_TRUE(end - begin >= 4 || end == count);
      in_ranges += end - begin;
    });
    EXPECT_EQ(in_ranges, count);
  }
}

TEST(PoolLease, HoldsThePoolAlone) {
  Workers workers = Workers::create(2).value();
  {
    const PoolLease first(&workers);
    EXPECT_FALSE(static_cast<bool>(PoolLease(&workers)));
  }
  EXPECT_TRUE(static_cast<bool>(PoolLease(&workers)));
}

}  // namespace
}  // namespace kinesphere::thread_pool_test
