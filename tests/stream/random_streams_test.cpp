// Long random streams of everything that one may do to a world, each operation followed by an audit and all
// that the world says held against the exact truth.
#include <gtest/gtest.h>

#include <iostream>

#include "stream/player.hpp"

namespace kinesphere::stream {
namespace {

/// Each shard is a test of its own, so that they run side by side.
class RandomStreams : public testing::TestWithParam<int> {};

constexpr int shards = 16;
constexpr int streams = 63;       ///< of one shard
constexpr int operations = 1000;  ///< of one stream: over a million in all

TEST_P(RandomStreams, AgreeWithTheTruth) {
  std::size_t events = 0;
  std::size_t performed = 0;
  for (int k = 0; k < streams; ++k) {
    const auto seed = static_cast<std::uint64_t>(1000 * GetParam() + k);
    const Bytes bytes = random_stream(seed, operations);
    const Played played = play(bytes);
    events += played.events;
    performed += played.operations;
    ASSERT_FALSE(played.failure) << "seed " << seed << ", operation " << played.failure->operation << ": "
                                 << played.failure->what << "\nshrunk to " << story_of(shrunk(bytes));
  }
  EXPECT_EQ(performed, std::size_t{streams} * operations);
  EXPECT_GT(events, performed / 10) << "too little happens";
  RecordProperty("events", std::to_string(events));
}

INSTANTIATE_TEST_SUITE_P(Shards, RandomStreams, testing::Range(0, shards));

}  // namespace
}  // namespace kinesphere::stream
