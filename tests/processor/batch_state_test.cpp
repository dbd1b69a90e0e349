// What the clusters of a batch share.
#include "processor/batch_state.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace kinesphere::batch_state_test {
namespace {

TEST(SharedTime, IsLoweredToTheLeast) {
  SharedTime time = 1000.0;
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread)
    threads.emplace_back([&, thread] {
      for (int k = 250; k > 0; --k) time.lower_to(4.0 * k + thread);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(double(time), 4.0);
  time.lower_to(5.0);
  EXPECT_EQ(double(time), 4.0);
}

TEST(BatchState, EndsBeforeItsStopAndWithTheRun) {
  BatchState batch;
  batch.stop = 2.0;
  batch.until = 3.0;
  EXPECT_TRUE(batch.is_in_batch(1.0));
  EXPECT_FALSE(batch.is_in_batch(2.0)) << "the stop is exclusive";
  batch.until = 1.5;
  EXPECT_TRUE(batch.is_in_batch(1.5)) << "the end of the run is inclusive";
  EXPECT_FALSE(batch.is_in_batch(1.6));
}

TEST(BatchState, FindsCheckpointsOfBodiesThatHaveOne) {
  BatchState batch;
  batch.slots.resize(3);
  batch.slots[1].checkpoint = 1;
  batch.slots[2].checkpoint = 0;
  batch.checkpoints.resize(2);
  batch.has_checkpoint = {0, 1};
  EXPECT_EQ(batch.checkpoint_of(0), nullptr);
  EXPECT_EQ(batch.checkpoint_of(1), &batch.checkpoints[1]);
  EXPECT_EQ(batch.checkpoint_of(2), nullptr) << "its cluster has not been executed";
  EXPECT_EQ(batch.checkpoint_of(9), nullptr) << "a body that came later";
}

}  // namespace
}  // namespace kinesphere::batch_state_test
