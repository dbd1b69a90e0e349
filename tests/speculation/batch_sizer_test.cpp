// When a run speculates, and with how many due pairs at once.
#include "speculation/batch_sizer.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>

namespace kinesphere::batch_sizer_test {
namespace {

constexpr std::size_t many_bodies = 100'000;

/// Executes a batch of `due` pairs, of which `repeats` are executed again, and commits it.
void execute(BatchSizer& sizer, std::size_t bodies, std::size_t due, std::size_t repeats) {
  (void)sizer.most_due(bodies);
  sizer.begin();
  sizer.note_run(due, false);
  sizer.note_run(repeats, true);
  sizer.adapt(bodies);
  sizer.pause(true);
}

/// Returns how many of the next 64 epochs are skipped at once.
int skipped(BatchSizer& sizer) {
  int epochs = 0;
  while (epochs < 64 && sizer.skips_epoch()) ++epochs;
  return epochs;
}

TEST(BatchSizer, SkipsTheFirstEpochsOfFewBodies) {
  for (const std::size_t threads : {2u, 4u, 16u, 64u}) {
    BatchSizer few(threads, 1000);
    EXPECT_EQ(skipped(few), 15) << threads;
    BatchSizer many(threads, many_bodies);
    EXPECT_EQ(skipped(many), 0) << threads;
    EXPECT_GT(many_bodies, 16 * many.fewest_due());
  }
}

TEST(BatchSizer, MoreThreadsSpeculateWithFewerDuePairs) {
  EXPECT_EQ(BatchSizer(2, many_bodies).fewest_due(), 1024u);
  EXPECT_EQ(BatchSizer(4, many_bodies).fewest_due(), 512u);
  EXPECT_EQ(BatchSizer(256, many_bodies).fewest_due(), 128u);
}

TEST(BatchSizer, AdaptsTheSizeToTheRepeats) {
  BatchSizer sizer(2, many_bodies);
  const std::size_t first = sizer.most_due(many_bodies);
  EXPECT_EQ(first, many_bodies / 32);
  execute(sizer, many_bodies, 3000, 0);
  EXPECT_EQ(sizer.most_due(many_bodies), 2 * first);
  execute(sizer, many_bodies, 3000, 3000 / 100);
  EXPECT_EQ(sizer.most_due(many_bodies), 2 * first) << "repeats between 1/128 and 1/48 suit the size";
  execute(sizer, many_bodies, 3000, 3000 / 47);
  EXPECT_EQ(sizer.most_due(many_bodies), first);
  for (int batch = 0; batch < 20; ++batch) execute(sizer, many_bodies, 3000, 1000);
  EXPECT_EQ(sizer.most_due(many_bodies), sizer.fewest_due())
      << "not below the fewest that repay the overhead";
}

TEST(BatchSizer, PausesLongerWhileSmallBatchesRepeatTooMuch) {
  // Two threads make up for an eighth of repeated work, sixteen for a third.
  for (const auto& [threads, share] : {std::pair(2u, 8u), std::pair(16u, 3u)}) {
    BatchSizer sizer(threads, many_bodies);
    for (int batch = 0; batch < 20; ++batch) execute(sizer, many_bodies, 24'000, 24'000);
    while (sizer.skips_epoch()) continue;
    execute(sizer, many_bodies, 24'000, 24'000 / share - 1);
    EXPECT_EQ(skipped(sizer), 0) << threads;
    for (const int epochs : {1, 3, 7, 15, 31, 31}) {
      execute(sizer, many_bodies, 24'000, 24'000 / share + 1);
      EXPECT_EQ(skipped(sizer), epochs) << threads;
    }
  }
}

TEST(BatchSizer, AlwaysSpeculatesIfRequired) {
  BatchSizer sizer(2, 10);
  sizer.require_speculation();
  EXPECT_EQ(skipped(sizer), 0);
  EXPECT_EQ(sizer.fewest_due(), 1u);
  EXPECT_EQ(sizer.most_due(10), 8u);
}

}  // namespace
}  // namespace kinesphere::batch_sizer_test
