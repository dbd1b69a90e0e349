// Long random streams of all operations on a world, with an audit after each, and all results compared with
// the exact truth.
#include <gtest/gtest.h>

#include <iostream>

#include "stream/player.hpp"

namespace kinesphere::stream::random_streams_test {
namespace {

/// Each shard is a test of its own, so that shards can run in parallel.
class RandomStreams : public testing::TestWithParam<int> {
 protected:
  void play_all(Bytes (*stream)(std::uint64_t seed, std::size_t operations), int streams, int operations) {
    std::size_t events = 0;
    std::size_t performed = 0;
    for (int k = 0; k < streams; ++k) {
      const auto seed = static_cast<std::uint64_t>(1000 * GetParam() + k);
      const Bytes bytes = stream(seed, static_cast<std::size_t>(operations));
      const Played played = play(bytes);
      events += played.events;
      performed += played.operations;
      ASSERT_FALSE(played.failure) << "seed " << seed << ", operation " << played.failure->operation << ": "
                                   << played.failure->what << "\nshrunk to " << story_of(shrunk(bytes));
    }
    EXPECT_EQ(performed, static_cast<std::size_t>(streams) * static_cast<std::size_t>(operations));
    EXPECT_GT(events, performed / 10) << "too little happens";
    RecordProperty("events", std::to_string(events));
  }
};

/// Over a million operations in all shards.
TEST_P(RandomStreams, AgreeWithTheTruth) { play_all(random_stream, 63, 1000); }

INSTANTIATE_TEST_SUITE_P(Shards, RandomStreams, testing::Range(0, 1));
INSTANTIATE_TEST_SUITE_P(Long, RandomStreams, testing::Range(1, 16));

class RandomCrowds : public RandomStreams {};

/// Worlds in which clusters run concurrently.
TEST_P(RandomCrowds, RunAsALoopDoes) { play_all(crowd_stream, 4, 30); }

INSTANTIATE_TEST_SUITE_P(Shards, RandomCrowds, testing::Range(0, 4));

/// Regressions: certificates counted for a stopped cluster, and a pair that left the tolerance by a hair.
TEST(Crowds, ThatOnceFailed) {
  for (const std::uint64_t seed : {40001u, 40008u}) {
    const Played played = play(crowd_stream(seed, 30));
    EXPECT_FALSE(played.failure) << "seed " << seed << ", operation " << played.failure->operation << ": "
                                 << played.failure->what;
  }
}

}  // namespace
}  // namespace kinesphere::stream::random_streams_test
