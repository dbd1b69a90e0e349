// Windows get shorter if searches cost most, and longer if starts do; and stay possible for all numbers.
#include "broadphase/window_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "archive/archive.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"
#include "support/bound_cases.hpp"

namespace kinesphere::window_policy_test {
namespace {

constexpr std::uint64_t seed = 4301;
/// Number of near pairs.
constexpr std::uint64_t none = 0;
constexpr std::uint64_t countless_pairs = 1'000'000'000;
constexpr RenewalCounts countless{.bodies = 100, .near = 1'000'000'000};
constexpr SpeedBound everyday{1.0, 0.0};
/// Width of typical bodies in windows of length 1.
constexpr double usual_width = 0.1;
/// Enough bodies that a search never examines all of them.
constexpr std::size_t many = 1'000'000'000'000;

double length_of(int rung) { return std::ldexp(1.0, rung); }
int main_tier(const WindowPolicy& window_policy) { return window_policy.rung_for({0.0, 0.0}); }

WindowPolicy chosen(double way = 1.0, const SpeedBound& typical = everyday, int dimensions = 3) {
  WindowPolicy window_policy(1e6 * way, dimensions);
  window_policy.choose(way, typical);
  return window_policy;
}

/// Bodies, most of which start again and again when their main windows end.
struct Round {
  std::vector<SpeedBound> paces;
  double width = usual_width;
  std::uint64_t near = 0;          ///< pairs that their searches find
  RenewalCounts velocity_changes;  ///< until their windows end
};

WindowPolicy::Sample round_of(const WindowPolicy& window_policy, bool most,
                              const std::vector<SpeedBound>& paces, double width) {
  WindowPolicy::Sample round(window_policy, most);
  for (const SpeedBound& speed_bound : paces)
    round.note(speed_bound, width, window_policy.rung_for(speed_bound));
  return round;
}

/// Starts bodies at `now`, with the cost of the ended windows.
void start_main(WindowPolicy& window_policy, double& now, const Round& round) {
  window_policy.start_main(now, {});
  window_policy.finish_start(round_of(window_policy, true, round.paces, round.width), round.near, many);
  now += length_of(main_tier(window_policy));
  window_policy.start_main(now, round.velocity_changes);
}

/// Starts a minority of the bodies.
void start_between(WindowPolicy& window_policy, const std::vector<SpeedBound>& paces, std::uint64_t near,
                   std::uint64_t among = many) {
  window_policy.finish_start(round_of(window_policy, false, paces, usual_width), near, among);
}

std::vector<std::byte> bytes_of(const WindowPolicy& window_policy) {
  ByteWriter writer;
  writer(window_policy);
  return writer.bytes();
}

std::vector<SpeedBound> bodies(std::size_t count, const SpeedBound& speed_bound = everyday) {
  return std::vector<SpeedBound>(count, speed_bound);
}

TEST(WindowPolicy, ATypicalBodyGoesAboutTheChosenWay) {
  Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const double way = log_uniform(random, -60, 60);
    const SpeedBound typical{log_uniform(random, -60, 60),
                             chance(random, 0.5) ? 0.0 : log_uniform(random, -60, 60)};
    const WindowPolicy window_policy = chosen(way, typical);
    ASSERT_TRUE(window_policy.is_chosen() && window_policy.is_valid());
    const double gone = typical.way(length_of(window_policy.rung_for(typical)));
    ASSERT_LE(gone, 1.001 * way) << "seed " << seed << ", case " << k;
    ASSERT_GE(gone, 0.249 * way) << "seed " << seed << ", case " << k;
  }
}

TEST(WindowPolicy, FasterBodiesHaveNoLongerWindows) {
  Random random(seed + 1);
  for (int k = 0; k < 200; ++k) {
    const double way = log_uniform(random, -20, 20);
    const WindowPolicy window_policy = chosen(way, {log_uniform(random, -20, 20), 0.0});
    const int main = main_tier(window_policy);
    int last = main;
    for (double speed = 1e-30; speed < 1e30; speed *= 3.0) {
      const int rung = window_policy.rung_for({speed, 0.0});
      ASSERT_LE(rung, last) << "seed " << seed << ", case " << k << ", speed " << speed;
      ASSERT_LE(window_policy.rung_for({speed, speed}), rung);
      ASSERT_EQ((main - rung) % WindowPolicy::powers_between_rungs, 0);
      ASSERT_LE(speed * length_of(rung), 4.0 * window_policy.typical_way()) << "much farther than most";
      if (rung < main) {
        ASSERT_GT(speed * length_of(rung + WindowPolicy::powers_between_rungs),
                  4.0 * window_policy.typical_way())
            << "shorter than needed";
      }
      last = rung;
    }
    ASSERT_LT(last, main - 30) << "the fastest have far shorter ones";
  }
}

TEST(WindowPolicy, ShorterWhereSearchesCostMost) {
  for (const int dimensions : {2, 3}) {
    WindowPolicy window_policy = chosen(1.0, everyday, dimensions);
    double now = 0.0;
    const int before = window_policy.rung_for(everyday);
    start_main(window_policy, now,
               {.paces = bodies(100), .near = countless_pairs, .velocity_changes = countless});
    EXPECT_LT(window_policy.rung_for(everyday), before);
    EXPECT_GE(window_policy.rung_for(everyday), before - 6);
    EXPECT_EQ(std::log2(window_policy.typical_way()), window_policy.rung_for(everyday) - before);
    EXPECT_TRUE(window_policy.is_valid());
  }
}

/// A search examines at most all bodies: with few of them, windows may be long.
TEST(WindowPolicy, SearchesAmongFewCostLittle) {
  for (const std::size_t all : {std::size_t{10}, many}) {
    WindowPolicy window_policy = chosen();
    const int before = main_tier(window_policy);
    window_policy.start_main(0.0, {});
    window_policy.finish_start(round_of(window_policy, true, bodies(10), usual_width), 2, all);
    window_policy.start_main(length_of(before), {});
    EXPECT_EQ(main_tier(window_policy) < before, all == many) << all;
  }
}

/// Counts the cost of velocity changes during the length of a window, not until the next start.
TEST(WindowPolicy, CostsOfKicksAreOfAMainWindow) {
  // In 64 windows the updates would shorten windows if they were of one.
  const RenewalCounts updates{.bodies = 1, .near = 64 * 4};
  for (const double windows : {1.0, 64.0}) {
    WindowPolicy window_policy = chosen();
    const int before = main_tier(window_policy);
    window_policy.start_main(0.0, {});
    window_policy.finish_start(round_of(window_policy, true, bodies(100), usual_width), none, many);
    window_policy.start_main(windows * length_of(before), updates);
    if (windows == 1.0) {
      EXPECT_LT(main_tier(window_policy), before);
    } else {
      EXPECT_GE(main_tier(window_policy), before);
    }
  }
}

TEST(WindowPolicy, PairsOfKicksCostAsThoseOfStarts) {
  for (const std::uint64_t near : {6u, 18u}) {
    for (const std::uint64_t of_kicks : {std::uint64_t{0}, near}) {
      WindowPolicy window_policy = chosen();
      double now = 0.0;
      const int before = main_tier(window_policy);
      const RenewalCounts updates{.bodies = 2, .near = of_kicks};
      start_main(window_policy, now,
                 {.paces = bodies(100), .near = near - of_kicks, .velocity_changes = updates});
      // Starts cost 15,600, half as long 31,200; a pair costs 3,100, half as long 550.
      EXPECT_EQ(main_tier(window_policy) < before, near == 18) << of_kicks;
    }
  }
}

/// If ways make most of the swept spheres, these grow with the cube of the length of windows, or its square.
TEST(WindowPolicy, InAPlaneWindowsAreLonger) {
  std::array<int, 2> rungs{};
  for (const int dimensions : {2, 3}) {
    WindowPolicy window_policy = chosen(1.0, everyday, dimensions);
    double now = 0.0;
    start_main(window_policy, now, {.paces = bodies(100), .width = 1e-6, .near = 1});
    rungs[static_cast<std::size_t>(dimensions - 2)] = main_tier(window_policy);
  }
  EXPECT_GT(rungs[0], rungs[1]);
}

TEST(WindowPolicy, LongerWhereStartsCostMostUpToTheLongestWay) {
  WindowPolicy window_policy = chosen();
  double now = 0.0;
  int before = main_tier(window_policy);
  for (int round = 0; round < 60; ++round) {
    start_main(window_policy, now, {.paces = bodies(100)});
    EXPECT_EQ(main_tier(window_policy), round < 19 ? before + 1 : before) << round;
    before = main_tier(window_policy);
  }
  EXPECT_LE(window_policy.typical_way(), 1e6);
  EXPECT_GT(window_policy.typical_way(), 0.25e6);
}

TEST(WindowPolicy, StaysWhereNothingIsMuchCheaper) {
  int changes = 0;
  WindowPolicy window_policy = chosen();
  double now = 0.0;
  for (int round = 0; round < 100; ++round) {
    const int before = main_tier(window_policy);
    // The number of found bodies grows with the volume of the swept spheres, like in a crowd.
    const double larger = 0.5 + window_policy.typical_way();
    const auto near = static_cast<std::uint64_t>(20 * larger * larger * larger);
    start_main(window_policy, now,
               {.paces = bodies(100), .width = 0.5, .near = near, .velocity_changes = {.bodies = 50}});
    if (main_tier(window_policy) != before) ++changes;
  }
  EXPECT_LE(changes, 12);
  EXPECT_LT(window_policy.typical_way(), 16.0);
  EXPECT_GT(window_policy.typical_way(), 0x1p-4);
}

TEST(WindowPolicy, WithoutStartsNothingIsKnown) {
  WindowPolicy window_policy = chosen();
  double now = 0.0;
  const int before = main_tier(window_policy);
  start_main(window_policy, now, {.near = countless_pairs, .velocity_changes = countless});
  EXPECT_EQ(main_tier(window_policy), before);
}

/// Without elapsed time the cost of velocity changes, a rate, is unknown.
TEST(WindowPolicy, AtOneInstantNothingIsKnown) {
  WindowPolicy window_policy = chosen();
  const int before = main_tier(window_policy);
  for (int round = 0; round < 3; ++round) {
    window_policy.start_main(0.0, countless);
    window_policy.finish_start(round_of(window_policy, true, bodies(100), usual_width), countless_pairs,
                               many);
  }
  EXPECT_EQ(main_tier(window_policy), before);
  EXPECT_EQ(window_policy.typical_way(), 1.0);
}

TEST(WindowPolicy, DoesNotGrowForFewThatAreSlow) {
  WindowPolicy window_policy = chosen();
  double now = 0.0;
  const int before = main_tier(window_policy);
  std::vector<SpeedBound> paces = bodies(20, {1e3, 0.0});
  paces.resize(30, everyday);
  start_main(window_policy, now, {.paces = paces});
  EXPECT_LE(main_tier(window_policy), before);
}

/// The typical way is that of the body that about an eighth of all bodies exceed, however slow the rest.
TEST(WindowPolicy, FewAreFasterThanTypical) {
  Random random(seed + 4);
  for (int k = 0; k < 300; ++k) {
    WindowPolicy window_policy = chosen();
    double now = 0.0;
    std::vector<SpeedBound> paces;
    for (std::uint64_t left = 1 + random.bits() % 200; left > 0; --left)
      paces.push_back({log_uniform(random, -30, 15), 0.0});
    // With such a cost windows keep their length.
    start_main(window_policy, now, {.paces = paces, .width = 1e9});
    std::size_t faster = 0;
    std::size_t as_fast = 0;
    for (const SpeedBound& speed_bound : paces) {
      if (speed_bound.speed * length_of(main_tier(window_policy)) >= 2.0 * window_policy.typical_way())
        ++faster;
      if (speed_bound.speed * length_of(main_tier(window_policy)) >= window_policy.typical_way()) ++as_fast;
    }
    ASSERT_LE(8 * faster, paces.size()) << "seed " << seed << ", case " << k;
    ASSERT_GT(8 * as_fast, paces.size()) << "seed " << seed << ", case " << k;
  }
}

/// Slow bodies share the windows of fast ones, and do not keep them short.
TEST(WindowPolicy, GrowsBackBesideSlowBodies) {
  struct Case {
    std::size_t fast;
    std::size_t slow;
  };
  for (const auto& [fast, slow] : {Case{1, 1}, Case{2, 1}, Case{1, 6}, Case{50, 300}}) {
    for (const double slower : {1e-12, 1e-3, 0.0}) {
      SCOPED_TRACE(testing::Message() << fast << " fast, " << slow << " slow: " << slower);
      std::vector<SpeedBound> paces = bodies(fast);
      paces.resize(fast + slow, {slower, 0.0});
      WindowPolicy window_policy = chosen();
      double now = 0.0;
      const int before = window_policy.rung_for(everyday);
      start_main(window_policy, now, {.paces = paces, .velocity_changes = countless});
      ASSERT_LT(window_policy.rung_for(everyday), before);
      for (int round = 0; round < 20; ++round) start_main(window_policy, now, {.paces = paces});
      EXPECT_GT(window_policy.rung_for(everyday), before + 10);
      EXPECT_EQ(window_policy.rung_for(everyday), main_tier(window_policy));
    }
  }
}

/// Speeds may become known later: all bodies stood still before.
TEST(WindowPolicy, FollowsBodiesThatBecomeFaster) {
  WindowPolicy window_policy = chosen();
  double now = 0.0;
  for (int round = 0; round < 10; ++round) start_main(window_policy, now, {.paces = bodies(100, {0.0, 0.0})});
  EXPECT_LT(window_policy.typical_way(), 1e-80);
  const int main = main_tier(window_policy);
  EXPECT_LT(window_policy.rung_for(everyday), main - 100);
  for (int round = 0; round < 40; ++round)
    start_main(window_policy, now, {.paces = bodies(100), .width = 1.0, .near = 100});
  EXPECT_EQ(window_policy.rung_for(everyday), main_tier(window_policy));
}

/// If no main window holds most bodies, they do not start together, and the policy learns from the starts in
/// between.
TEST(WindowPolicy, GrowsWhereMostAreInLongerWindows) {
  WindowPolicy window_policy = chosen();
  const int before = main_tier(window_policy);
  for (int k = 0; k < 6; ++k) {
    WindowPolicy::Sample round(window_policy, false);
    for (int body = 0; body < 64; ++body) round.note({1e-3, 0.0}, usual_width, main_tier(window_policy));
    window_policy.finish_start(round, none, many);
  }
  EXPECT_EQ(main_tier(window_policy), before + 6 * WindowPolicy::powers_between_rungs);
  EXPECT_EQ(window_policy.typical_way(), length_of(main_tier(window_policy) - before));
  EXPECT_TRUE(window_policy.is_valid());
  // Up to the longest way.
  for (int round = 0; round < 6; ++round) start_between(window_policy, bodies(64, {1e-3, 0.0}), none);
  EXPECT_EQ(window_policy.typical_way(), 1e6);
  EXPECT_TRUE(window_policy.is_valid());
}

/// A main window may be far shorter than the resolution of times: then all bodies are in longer ones.
TEST(WindowPolicy, GrowsWhereWindowsAreLongerThanItSays) {
  WindowPolicy window_policy = chosen(1.0, {1e60, 0.0});
  const int shortest = -40;
  ASSERT_LT(main_tier(window_policy), shortest - 100);
  for (int k = 0; k < 60; ++k) {
    WindowPolicy::Sample round(window_policy, false);
    for (int body = 0; body < 64; ++body)
      round.note(everyday, usual_width, std::max(main_tier(window_policy), shortest));
    window_policy.finish_start(round, none, many);
  }
  EXPECT_GT(main_tier(window_policy), shortest);
}

TEST(WindowPolicy, FastBodiesGoFarWhereNothingIsInTheirWay) {
  const SpeedBound fast{1000.0, 0.0};
  WindowPolicy window_policy = chosen();
  const int main = main_tier(window_policy);
  const int first = window_policy.rung_for(fast);
  ASSERT_LT(first, main - WindowPolicy::powers_between_rungs);
  std::vector<int> rungs;
  for (int round = 0; round < 5; ++round) {
    start_between(window_policy, bodies(64, fast), none, 64);
    rungs.push_back(window_policy.rung_for(fast));
    ASSERT_TRUE(window_policy.is_valid());
  }
  EXPECT_EQ(rungs[0], first + WindowPolicy::powers_between_rungs);
  EXPECT_EQ(rungs[4], main - WindowPolicy::powers_between_rungs) << "shorter than the main one nevertheless";
  EXPECT_EQ(main_tier(window_policy), main);
  EXPECT_EQ(window_policy.typical_way(), 1.0);
  // Faster bodies go no farther than has been tried.
  const SpeedBound faster{8e7, 0.0};
  const double way = faster.way(length_of(window_policy.rung_for(faster)));
  EXPECT_LE(way, std::ldexp(4.0, 5 * WindowPolicy::powers_between_rungs));
  EXPECT_GT(way, std::ldexp(4.0, 4 * WindowPolicy::powers_between_rungs));
}

/// Among many bodies, fast ones pass too many.
TEST(WindowPolicy, FastBodiesHaveShorterWindowsAmongMany) {
  const SpeedBound fast{1e5, 0.0};
  for (const int dimensions : {2, 3}) {
    WindowPolicy window_policy = chosen(1.0, everyday, dimensions);
    const int first = window_policy.rung_for(fast);
    for (int round = 0; round < 3; ++round) start_between(window_policy, bodies(64, fast), none, 64);
    const int among_few = window_policy.rung_for(fast);
    EXPECT_EQ(among_few, first + 3 * WindowPolicy::powers_between_rungs);
    start_between(window_policy, bodies(64, fast), none);
    EXPECT_EQ(window_policy.rung_for(fast), among_few - WindowPolicy::powers_between_rungs);
    for (int round = 0; round < 5; ++round) start_between(window_policy, bodies(64, fast), none);
    EXPECT_GE(fast.way(length_of(window_policy.rung_for(fast))), window_policy.typical_way())
        << "as far as most";
    EXPECT_EQ(window_policy.typical_way(), 1.0);
  }
}

/// The windows of fast bodies differ by large factors: bodies do not alternate between two of them.
TEST(WindowPolicy, FastBodiesFindTheirWindows) {
  const SpeedBound fast{1e5, 0.0};
  for (const int dimensions : {2, 3}) {
    for (const double density : {1e-6, 1e-4, 1e-2, 1.0, 100.0}) {
      WindowPolicy window_policy = chosen(1.0, everyday, dimensions);
      int changes = 0;
      for (int round = 0; round < 100; ++round) {
        const int before = window_policy.rung_for(fast);
        const double way = fast.way(length_of(before));
        start_between(window_policy, bodies(64, fast), static_cast<std::uint64_t>(64 * density * way));
        if (window_policy.rung_for(fast) != before) ++changes;
      }
      EXPECT_LE(changes, 4) << dimensions << " dimensions, density " << density;
    }
  }
}

TEST(WindowPolicy, NobodyGoesMuchFartherThanTheLongestWay) {
  for (const double way : {0.1, 0.3, 0.5, 1.0, 2.0, 1e6}) {
    WindowPolicy window_policy(1.0, 3);
    window_policy.choose(way, everyday);
    for (int round = 0; round < 20; ++round) {
      ASSERT_TRUE(window_policy.is_valid()) << "way " << way << ", round " << round;
      for (double speed = 1e-3; speed < 1e6; speed *= 3.0)
        ASSERT_LE(speed * length_of(window_policy.rung_for({speed, 0.0})), speed > 16.0 ? 1.0 : 4.0)
            << "way " << way;
      start_between(window_policy, bodies(64, {1e3, 0.0}), none);
    }
  }
}

/// Every number is zero, tiny, typical, huge or infinite.
TEST(WindowPolicy, StaysPossibleWhateverTheNumbers) {
  constexpr std::array values{0.0, 5e-324, 1e-300, 1e-100, 1e-9, 1.0, 1e9, 1e100, 1e300, infinity};
  Random random(seed + 2);
  const auto value = [&] { return values[random.bits() % values.size()]; };
  const auto positive = [&] { return std::clamp(value(), 1e-300, 1e300); };
  // Range: that of the limits of a world's tolerance.
  const auto longest_way = [&] { return std::clamp(value(), 1e-60, 1e300); };
  const auto count = [&] {
    constexpr std::array<std::uint64_t, 4> counts{0, 1, 1000, std::uint64_t{1} << 62};
    return counts[random.bits() % 4];
  };
  const auto updates = [&] {
    const std::uint64_t redirected = count();
    return RenewalCounts{redirected, count()};
  };
  for (int k = 0; k < 20000; ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << k);
    WindowPolicy window_policy(longest_way(), random.bits() % 2 == 0 ? 2 : 3);
    window_policy.choose(positive(), {value(), value()});
    double now = -1e300;
    for (int round = 0; round < 4; ++round) {
      now = std::max(now, value());
      const bool most = random.bits() % 2 == 0;
      if (most) window_policy.start_main(std::min(now, 1e300), updates());
      WindowPolicy::Sample starts(window_policy, most);
      std::uint64_t left = random.bits() % 5;
      if (random.bits() % 8 == 0) left += 64;
      for (; left > 0; --left) {
        const SpeedBound speed_bound{value(), value()};
        const int rung = window_policy.rung_for(speed_bound);
        ASSERT_LE(std::abs(rung), 300 + WindowPolicy::powers_between_rungs);
        starts.note(speed_bound, value(), rung);
      }
      window_policy.finish_start(starts, count(), many);
      ASSERT_GE(window_policy.cost_of_width(positive()), 0.0);
      ASSERT_TRUE(window_policy.is_valid()) << "round " << round;
    }
  }
}

/// Spheres that stand still, each in the middle of the space that its search reads.
TEST(WindowPolicy, WiderCapsulesCostAsTheirVolume) {
  for (const int dimensions : {2, 3}) {
    WindowPolicy window_policy = chosen(1.0, everyday, dimensions);
    EXPECT_EQ(window_policy.cost_of_width(1.0), 0.0) << "nothing is known yet";
    window_policy.start_main(0.0, {});
    const auto round = round_of(window_policy, true, bodies(10, {0.0, 0.0}), 2.0);
    window_policy.finish_start(round, none, many);
    EXPECT_EQ(window_policy.cost_of_width(0.0), 0.0);
    EXPECT_DOUBLE_EQ(window_policy.cost_of_width(2.0), dimensions == 2 ? 3.0 * 24.0 : 7.0 * 24.0);
    window_policy.finish_start(WindowPolicy::Sample(window_policy, true), 10, many);
    EXPECT_GT(window_policy.cost_of_width(2.0), dimensions == 2 ? 3.0 * 284.0 : 7.0 * 284.0)
        << "near pairs cost, too";
  }
}

/// The sum does not depend on the order of additions.
TEST(WindowPolicy, RoundsHaveOneSum) {
  Random random(seed + 5);
  for (int k = 0; k < 300; ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << seed + 5 << ", case " << k);
    const bool most = chance(random, 0.5);
    WindowPolicy one = chosen(log_uniform(random, -30, 30));
    WindowPolicy other = one;
    double now = 0.0;
    for (int start = 0; start < 3; ++start) {
      const std::uint64_t near = random.bits() % 1000;
      if (most) one.start_main(now, {10, near});
      if (most) other.start_main(now, {10, near});
      WindowPolicy::Sample whole(one, most);
      std::vector<WindowPolicy::Sample> parts(1 + random.bits() % 5, WindowPolicy::Sample(other, most));
      for (int body = 0; body < 100; ++body) {
        const SpeedBound speed_bound{log_uniform(random, -30, 30), log_uniform(random, -30, 30)};
        const double width = log_uniform(random, -30, 60);
        whole.note(speed_bound, width, one.rung_for(speed_bound));
        parts[random.bits() % parts.size()].note(speed_bound, width, other.rung_for(speed_bound));
      }
      for (std::size_t part = parts.size() - 1; part > 0; --part) parts[part - 1] += parts[part];
      one.finish_start(whole, near, many);
      other.finish_start(parts[0], near, many);
      ASSERT_EQ(bytes_of(one), bytes_of(other));
      now += length_of(main_tier(one));
    }
  }
}

TEST(MotionStatistics, TellsTheDistanceOfNeighbours) {
  const auto spacing = [](int x, int y, int z) {
    MotionStatistics statistics;
    for (int k = 0; k < x * y * z; ++k)
      statistics.note({2.0 * (k % x), 2.0 * (k / x % y), 2.0 * (k / x / y)}, everyday);
    return statistics.spacing();
  };
  for (const auto& [x, y, z] : {std::array{1000, 1, 1}, std::array{30, 30, 1}, std::array{10, 10, 10}}) {
    EXPECT_GT(spacing(x, y, z), 0.9) << x;
    EXPECT_LT(spacing(x, y, z), 2.7) << x;
  }
  MotionStatistics alone;
  alone.note({1.0, 2.0, 3.0}, everyday);
  EXPECT_EQ(alone.spacing(), 0.0);
}

TEST(MotionStatistics, TellsTheTypicalPace) {
  Random random(seed + 6);
  for (int k = 0; k < 1000; ++k) {
    MotionStatistics statistics;
    std::vector<double> speeds, accelerations;
    for (std::uint64_t left = 1 + 2 * (random.bits() % 50); left > 0; --left) {
      speeds.push_back(chance(random, 0.1) ? 0.0 : log_uniform(random, -60, 60));
      accelerations.push_back(log_uniform(random, -60, 60));
      statistics.note({}, {speeds.back(), accelerations.back()});
    }
    std::sort(speeds.begin(), speeds.end());
    const double speed = speeds[speeds.size() / 2];
    double acceleration = 0.0;
    for (const double each : accelerations) acceleration += each / static_cast<double>(accelerations.size());
    const SpeedBound typical = statistics.typical();
    ASSERT_TRUE(typical.speed <= 1.5 * speed && typical.speed >= 0.75 * speed)
        << "seed " << seed + 6 << ", case " << k;
    ASSERT_TRUE(typical.acceleration <= 1.5 * acceleration && typical.acceleration >= 0.75 * acceleration);
  }
  MotionStatistics immense;
  immense.note({}, {infinity, 0.0});
  EXPECT_EQ(immense.typical().speed, infinity);
  EXPECT_EQ(immense.typical().acceleration, 0.0);
}

/// However long nothing moves.
TEST(WindowPolicy, HasALongestWindow) {
  const SpeedBound hardly{1e-100, 0.0};
  WindowPolicy window_policy(1e300, 3);
  window_policy.choose(1.0, hardly);
  double now = 0.0;
  for (int round = 0; round < 3000; ++round) {
    start_main(window_policy, now, {.paces = bodies(3, hardly), .width = 1.0});
    ASSERT_TRUE(window_policy.is_valid()) << round;
  }
  EXPECT_EQ(main_tier(window_policy), 300);
}

TEST(WindowPolicy, GoesOnAsBeforeAfterItWasBytes) {
  Random random(seed + 3);
  WindowPolicy window_policy = chosen();
  double now = 0.0;
  for (int round = 0; round < 400; ++round) {
    std::vector<SpeedBound> paces;
    for (int k = 0; k < 20; ++k) paces.push_back({log_uniform(random, -10, 10), random.uniform()});
    const std::uint64_t of_starts = random.bits() % 100;
    const bool most = random.bits() % 2 == 0;
    const auto updates = [&] {
      return RenewalCounts{.bodies = random.bits() % 1000, .near = random.bits() % 1000};
    };
    if (most) window_policy.start_main(now, updates());
    window_policy.finish_start(round_of(window_policy, most, paces, random.uniform()), of_starts, many);
    const std::vector<std::byte> bytes = bytes_of(window_policy);
    WindowPolicy back = chosen();
    back.choose(3.0, everyday);
    ByteReader reader(bytes);
    reader(back);
    ASSERT_FALSE(reader.failed());
    EXPECT_EQ(reader.remaining(), 0u);
    ASSERT_TRUE(back.is_valid());
    now += random.uniform();
    const RenewalCounts kicks_since = updates();
    const std::uint64_t of_fast = random.bits() % 100;
    for (WindowPolicy* each : {&window_policy, &back}) {
      start_between(*each, bodies(70, {1e3, 0.0}), of_fast);
      each->start_main(now, kicks_since);
    }
    ASSERT_EQ(back.typical_way(), window_policy.typical_way());
    ASSERT_EQ(back.cost_of_width(1.0), window_policy.cost_of_width(1.0));
    for (const SpeedBound& speed_bound : paces)
      ASSERT_EQ(back.rung_for(speed_bound), window_policy.rung_for(speed_bound));
  }
}

}  // namespace
}  // namespace kinesphere::window_policy_test
