// The steps of a window start: all bodies in windows, and all pairs that may change certified.
#include "processor/window_start.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"
#include "support/small_world.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::window_start_test {
namespace {

constexpr std::uint64_t seed = 5213;
constexpr std::uint32_t count = 80;

class WindowStartTest : public testing::Test {
 protected:
  WindowStartTest() {
    Random random(seed);
    for (std::uint32_t k = 0; k < count; ++k) {
      numbers.push_back(world.add({.radius = 0.1,
                                   .acceleration_limit = 0.2 * random.uniform(),
                                   .position = random.point_in_ball(),
                                   .velocity = random.point_in_ball()}));
      world.state.bodies[k].mark_visited();
    }
    world.main.dirty().clear();
  }
  WindowStart starting() { return {world.state, world.main, alone, found}; }

  SmallWorld world;
  PoolLease alone;
  std::vector<SearchResults> found;
  std::vector<std::uint32_t> numbers;
};

TEST_F(WindowStartTest, CertifiesEachPairUntilAWindowEnds) {
  WindowStart start = starting();
  start.choose_policy(start.measure(numbers));
  WindowPolicy::Sample sample(world.state.window_policy, true);
  const auto starters = start.choose_windows(numbers, {}, sample);
  ASSERT_EQ(starters.size(), count);
  const std::uint64_t near = start.start(starters);
  const Bodies& bodies = world.state.bodies;
  std::vector<PairCertificate> pairs;
  world.main.queue().for_each([&](const PairCertificate& pair) { pairs.push_back(pair); });
  EXPECT_EQ(pairs.size(), near) << "no walls, no links";
  const CertificateTimes times(pairs);
  std::uint64_t met = 0;
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b) {
      const double end = std::min(world.state.broad_phase.end_of(a), world.state.broad_phase.end_of(b));
      const double until = std::min(times.of(a, b), end);
      if (until > 0.0) {
        EXPECT_GE(least_true_gap(bodies[a].bound, bodies[b].bound, 0.0, until), -1e-9);
      }
      if (until > 0.0 && least_true_gap(bodies[a].bound, bodies[b].bound, 0.0, end) < 0) ++met;
    }
  EXPECT_GE(near, met);
  EXPECT_GT(met, 5u);
  EXPECT_EQ(world.main.work().counters.searches, count);
}

TEST_F(WindowStartTest, LeavesBodiesWithoutAFreeWindowDirty) {
  WindowPolicy::Sample sample(world.state.window_policy, true);
  std::vector<int> held;
  for (int rung = -300; rung <= 300; ++rung) held.push_back(rung);
  EXPECT_TRUE(starting().choose_windows(numbers, held, sample).empty());
  EXPECT_EQ(world.main.dirty().numbers().size(), count);
}

TEST_F(WindowStartTest, ChoosesWindowsInWhichBodiesGoPartOfTheirSpacing) {
  WindowStart start = starting();
  const MotionStatistics statistics = start.measure(numbers);
  start.choose_policy(statistics);
  EXPECT_NEAR(world.state.window_policy.typical_way(), 0.25 * statistics.spacing(), 1e-12);
}

TEST_F(WindowStartTest, ProbesThoseWhoseBoundsHaveGrown) {
  WindowStart start = starting();
  WindowPolicy::Sample sample(world.state.window_policy, true);
  const auto starters = start.choose_windows(numbers, {}, sample);
  world.state.window_policy.finish_start(sample, start.start(starters), count);
  world.main.advance_clock(64.0);
  ASSERT_TRUE(starting().refresh(numbers));
  std::uint64_t probed = 0;
  for (const std::uint32_t number : numbers) probed += world.state.bodies[number].bound.time == 64.0 ? 1 : 0;
  EXPECT_EQ(world.main.work().counters.probes, probed);
  EXPECT_GT(probed, count / 2);
}

TEST(WindowStart, RestartsAllIfManyAreNew) {
  EXPECT_FALSE(are_many(8, 8)) << "few are recertified one by one";
  EXPECT_TRUE(are_many(9, 71));
  EXPECT_FALSE(are_many(9, 72)) << "an eighth of all";
}

}  // namespace
}  // namespace kinesphere::window_start_test
