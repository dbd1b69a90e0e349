// Random streams of operations on worlds with all features mixed, with an audit after each operation, and all
// results compared with the true motion in long double. Other seeds:
//   KINESPHERE_SEEDS=1000-1999 build/ci/tests/test_stream --gtest_filter='Shards/RandomStreams*'
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "stream/player.hpp"

namespace kinesphere::stream::random_streams_test {
namespace {

/// Seeds from the first to the last.
struct Seeds {
  std::uint64_t first, last;
};

/// Returns the wanted seeds, FIRST-LAST or one, or these.
Seeds wanted_or(Seeds seeds) {
  const char* const wanted = std::getenv("KINESPHERE_SEEDS");
  if (wanted == nullptr) return seeds;
  const std::string text = wanted;
  const std::size_t dash = text.find('-');
  const std::uint64_t first = std::stoull(text);
  return {first, dash == std::string::npos ? first : std::stoull(text.substr(dash + 1))};
}

/// Each shard is a test of its own, so that shards can run in parallel.
class RandomStreams : public testing::TestWithParam<int> {
 protected:
  void play_all(Bytes (*stream)(std::uint64_t seed, std::size_t operations), Seeds seeds,
                std::size_t operations) {
    Tally total;
    std::size_t performed = 0;
    std::size_t cut_short = 0;
    for (std::uint64_t seed = seeds.first; seed <= seeds.last; ++seed) {
      const Bytes bytes = stream(seed, operations);
      const Played played = play(bytes);
      ASSERT_FALSE(played.failure) << "seed " << seed << ": " << *played.failure << "\nshrunk to "
                                   << story_of(shrunk(bytes));
      performed += played.operations;
      total.events += played.tally.events;
      total.begins += played.tally.begins;
      total.answers += played.tally.answers;
      cut_short += played.cut_short;
    }
    const std::size_t count = seeds.last - seeds.first + 1;
    std::cout << count << " worlds: " << performed << " operations, " << total.events << " events, "
              << total.begins << " begins, " << total.answers << " answers, " << cut_short
              << " worlds cut short\n";
    EXPECT_LE(cut_short, count / 4);
    EXPECT_GT(total.events, performed / 10) << "too little happens";
  }
};

TEST_P(RandomStreams, AgreeWithTheTruth) {
  const auto shard = static_cast<std::uint64_t>(GetParam());
  play_all(random_stream, wanted_or({100 * shard + 1, 100 * shard + 96}), 120);
}

INSTANTIATE_TEST_SUITE_P(Shards, RandomStreams, testing::Range(0, 1));
INSTANTIATE_TEST_SUITE_P(Long, RandomStreams, testing::Range(1, 16));

class RandomCrowds : public RandomStreams {};

/// Worlds in which clusters run concurrently.
TEST_P(RandomCrowds, RunAsALoopDoes) {
  const auto shard = static_cast<std::uint64_t>(GetParam());
  play_all(crowd_stream, {10 * shard + 1, 10 * shard + 4}, 30);
}

INSTANTIATE_TEST_SUITE_P(Shards, RandomCrowds, testing::Range(0, 4));

}  // namespace
}  // namespace kinesphere::stream::random_streams_test
