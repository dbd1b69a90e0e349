// Windows get shorter where searches cost most, and longer where starts do; and stay possible whatever the
// numbers.
#include "window/tempo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "archive/archive.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"
#include "support/bound_cases.hpp"

namespace kinesphere::tempo_test {
namespace {

constexpr std::uint64_t seed = 4301;
/// Near pairs.
constexpr std::uint64_t none = 0;
constexpr std::uint64_t countless_pairs = 1'000'000'000;
constexpr Kicks countless{.bodies = 100, .near = 1'000'000'000};
constexpr Pace everyday{1.0, 0.0};
/// Of everyday bodies in windows of length 1.
constexpr double usual_width = 0.1;
/// Bodies, so that a search never looks at all of them.
constexpr std::size_t many = 1'000'000'000'000;

double length_of(int tier) { return std::ldexp(1.0, tier); }
int main_tier(const Tempo& tempo) { return tempo.tier_for({0.0, 0.0}); }

Tempo chosen(double way = 1.0, const Pace& typical = everyday, int dimensions = 3) {
  Tempo tempo(1e6 * way, dimensions);
  tempo.choose(way, typical);
  return tempo;
}

/// Bodies, most of which start again and again when their main windows end.
struct Round {
  std::vector<Pace> paces;
  double width = usual_width;
  std::uint64_t near = 0;  ///< pairs that their searches find
  Kicks kicks;             ///< until their windows end
};

Tempo::Round round_of(const Tempo& tempo, bool most, const std::vector<Pace>& paces, double width) {
  Tempo::Round round(tempo, most);
  for (const Pace& pace : paces) round.note(pace, width, tempo.tier_for(pace));
  return round;
}

/// They start at `now`, and those that start when their windows end know what it has cost.
void start_main(Tempo& tempo, double& now, const Round& round) {
  tempo.start_main(now, {});
  tempo.finish_start(round_of(tempo, true, round.paces, round.width), round.near, many);
  now += length_of(main_tier(tempo));
  tempo.start_main(now, round.kicks);
}

/// Bodies start while most do not.
void start_between(Tempo& tempo, const std::vector<Pace>& paces, std::uint64_t near,
                   std::uint64_t among = many) {
  tempo.finish_start(round_of(tempo, false, paces, usual_width), near, among);
}

std::vector<std::byte> bytes_of(const Tempo& tempo) {
  ByteWriter writer;
  writer(tempo);
  return writer.bytes();
}

std::vector<Pace> bodies(std::size_t count, const Pace& pace = everyday) {
  return std::vector<Pace>(count, pace);
}

TEST(Tempo, ATypicalBodyGoesAboutTheChosenWay) {
  Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const double way = log_uniform(random, -60, 60);
    const Pace typical{log_uniform(random, -60, 60),
                       chance(random, 0.5) ? 0.0 : log_uniform(random, -60, 60)};
    const Tempo tempo = chosen(way, typical);
    ASSERT_TRUE(tempo.is_chosen() && tempo.is_sound());
    const double gone = typical.way(length_of(tempo.tier_for(typical)));
    ASSERT_LE(gone, 1.001 * way) << "seed " << seed << ", case " << k;
    ASSERT_GE(gone, 0.249 * way) << "seed " << seed << ", case " << k;
  }
}

TEST(Tempo, FasterBodiesHaveNoLongerWindows) {
  Random random(seed + 1);
  for (int k = 0; k < 200; ++k) {
    const double way = log_uniform(random, -20, 20);
    const Tempo tempo = chosen(way, {log_uniform(random, -20, 20), 0.0});
    const int main = main_tier(tempo);
    int last = main;
    for (double speed = 1e-30; speed < 1e30; speed *= 3.0) {
      const int tier = tempo.tier_for({speed, 0.0});
      ASSERT_LE(tier, last) << "seed " << seed << ", case " << k << ", speed " << speed;
      ASSERT_LE(tempo.tier_for({speed, speed}), tier);
      ASSERT_EQ((main - tier) % Tempo::powers_between_tiers, 0);
      ASSERT_LE(speed * length_of(tier), 4.0 * tempo.typical_way()) << "much farther than most";
      if (tier < main) {
        ASSERT_GT(speed * length_of(tier + Tempo::powers_between_tiers), 4.0 * tempo.typical_way())
            << "shorter than needed";
      }
      last = tier;
    }
    ASSERT_LT(last, main - 30) << "the fastest have far shorter ones";
  }
}

TEST(Tempo, ShorterWhereSearchesCostMost) {
  for (const int dimensions : {2, 3}) {
    Tempo tempo = chosen(1.0, everyday, dimensions);
    double now = 0.0;
    const int before = tempo.tier_for(everyday);
    start_main(tempo, now, {.paces = bodies(100), .near = countless_pairs, .kicks = countless});
    EXPECT_LT(tempo.tier_for(everyday), before);
    EXPECT_GE(tempo.tier_for(everyday), before - 6);
    EXPECT_EQ(std::log2(tempo.typical_way()), tempo.tier_for(everyday) - before);
    EXPECT_TRUE(tempo.is_sound());
  }
}

/// No search looks at more bodies than there are: where there are few, windows may be long.
TEST(Tempo, SearchesAmongFewCostLittle) {
  for (const std::size_t all : {std::size_t{10}, many}) {
    Tempo tempo = chosen();
    const int before = main_tier(tempo);
    tempo.start_main(0.0, {});
    tempo.finish_start(round_of(tempo, true, bodies(10), usual_width), 2, all);
    tempo.start_main(length_of(before), {});
    EXPECT_EQ(main_tier(tempo) < before, all == many) << all;
  }
}

/// What kicks cost in the time of a window counts, not what they cost until the next start.
TEST(Tempo, CostsOfKicksAreOfAMainWindow) {
  // In 64 windows they would make windows shorter if they were of one.
  const Kicks kicks{.bodies = 1, .near = 64 * 4};
  for (const double windows : {1.0, 64.0}) {
    Tempo tempo = chosen();
    const int before = main_tier(tempo);
    tempo.start_main(0.0, {});
    tempo.finish_start(round_of(tempo, true, bodies(100), usual_width), none, many);
    tempo.start_main(windows * length_of(before), kicks);
    if (windows == 1.0) {
      EXPECT_LT(main_tier(tempo), before);
    } else {
      EXPECT_GE(main_tier(tempo), before);
    }
  }
}

TEST(Tempo, PairsOfKicksCostAsThoseOfStarts) {
  for (const std::uint64_t near : {6, 18}) {
    for (const std::uint64_t of_kicks : {std::uint64_t{0}, near}) {
      Tempo tempo = chosen();
      double now = 0.0;
      const int before = main_tier(tempo);
      const Kicks kicks{.bodies = 2, .near = of_kicks};
      start_main(tempo, now, {.paces = bodies(100), .near = near - of_kicks, .kicks = kicks});
      // Starts cost 15,600, half as long 31,200; a pair costs 3,100, half as long 550.
      EXPECT_EQ(main_tier(tempo) < before, near == 18) << of_kicks;
    }
  }
}

/// Where ways make most of the capsules, these grow with the cube of the length of windows, or its square.
TEST(Tempo, InAPlaneWindowsAreLonger) {
  std::array<int, 2> tiers{};
  for (const int dimensions : {2, 3}) {
    Tempo tempo = chosen(1.0, everyday, dimensions);
    double now = 0.0;
    start_main(tempo, now, {.paces = bodies(100), .width = 1e-6, .near = 1});
    tiers[static_cast<std::size_t>(dimensions - 2)] = main_tier(tempo);
  }
  EXPECT_GT(tiers[0], tiers[1]);
}

TEST(Tempo, LongerWhereStartsCostMostUpToTheLongestWay) {
  Tempo tempo = chosen();
  double now = 0.0;
  int before = main_tier(tempo);
  for (int round = 0; round < 60; ++round) {
    start_main(tempo, now, {.paces = bodies(100)});
    EXPECT_EQ(main_tier(tempo), round < 19 ? before + 1 : before) << round;
    before = main_tier(tempo);
  }
  EXPECT_LE(tempo.typical_way(), 1e6);
  EXPECT_GT(tempo.typical_way(), 0.25e6);
}

TEST(Tempo, StaysWhereNothingIsMuchCheaper) {
  int changes = 0;
  Tempo tempo = chosen();
  double now = 0.0;
  for (int round = 0; round < 100; ++round) {
    const int before = main_tier(tempo);
    // As in a crowd: what searches find grows with the volume of the capsules.
    const double larger = 0.5 + tempo.typical_way();
    const auto near = static_cast<std::uint64_t>(20 * larger * larger * larger);
    start_main(tempo, now, {.paces = bodies(100), .width = 0.5, .near = near, .kicks = {.bodies = 50}});
    if (main_tier(tempo) != before) ++changes;
  }
  EXPECT_LE(changes, 12);
  EXPECT_LT(tempo.typical_way(), 16.0);
  EXPECT_GT(tempo.typical_way(), 0x1p-4);
}

TEST(Tempo, WithoutStartsNothingIsKnown) {
  Tempo tempo = chosen();
  double now = 0.0;
  const int before = main_tier(tempo);
  start_main(tempo, now, {.near = countless_pairs, .kicks = countless});
  EXPECT_EQ(main_tier(tempo), before);
}

/// Nor without time that has passed: what kicks cost is a rate.
TEST(Tempo, AtOneInstantNothingIsKnown) {
  Tempo tempo = chosen();
  const int before = main_tier(tempo);
  for (int round = 0; round < 3; ++round) {
    tempo.start_main(0.0, countless);
    tempo.finish_start(round_of(tempo, true, bodies(100), usual_width), countless_pairs, many);
  }
  EXPECT_EQ(main_tier(tempo), before);
  EXPECT_EQ(tempo.typical_way(), 1.0);
}

TEST(Tempo, DoesNotGrowForFewThatAreSlow) {
  Tempo tempo = chosen();
  double now = 0.0;
  const int before = main_tier(tempo);
  std::vector<Pace> paces = bodies(20, {1e3, 0.0});
  paces.resize(30, everyday);
  start_main(tempo, now, {.paces = paces});
  EXPECT_LE(main_tier(tempo), before);
}

/// The typical way is that of the body that an eighth of all others exceed, about, however slow the rest.
TEST(Tempo, FewAreFasterThanTypical) {
  Random random(seed + 4);
  for (int k = 0; k < 300; ++k) {
    Tempo tempo = chosen();
    double now = 0.0;
    std::vector<Pace> paces;
    for (std::uint64_t left = 1 + random.bits() % 200; left > 0; --left)
      paces.push_back({log_uniform(random, -30, 15), 0.0});
    // With such a cost windows stay as they are.
    start_main(tempo, now, {.paces = paces, .width = 1e9});
    std::size_t faster = 0;
    std::size_t as_fast = 0;
    for (const Pace& pace : paces) {
      if (pace.speed * length_of(main_tier(tempo)) >= 2.0 * tempo.typical_way()) ++faster;
      if (pace.speed * length_of(main_tier(tempo)) >= tempo.typical_way()) ++as_fast;
    }
    ASSERT_LE(8 * faster, paces.size()) << "seed " << seed << ", case " << k;
    ASSERT_GT(8 * as_fast, paces.size()) << "seed " << seed << ", case " << k;
  }
}

/// What is slow shares the windows of what is fast, and does not keep them short.
TEST(Tempo, GrowsBackBesideSlowBodies) {
  struct Case {
    std::size_t fast;
    std::size_t slow;
  };
  for (const auto& [fast, slow] : {Case{1, 1}, Case{2, 1}, Case{1, 6}, Case{50, 300}}) {
    for (const double slower : {1e-12, 1e-3, 0.0}) {
      SCOPED_TRACE(testing::Message() << fast << " fast, " << slow << " slow: " << slower);
      std::vector<Pace> paces = bodies(fast);
      paces.resize(fast + slow, {slower, 0.0});
      Tempo tempo = chosen();
      double now = 0.0;
      const int before = tempo.tier_for(everyday);
      start_main(tempo, now, {.paces = paces, .kicks = countless});
      ASSERT_LT(tempo.tier_for(everyday), before);
      for (int round = 0; round < 20; ++round) start_main(tempo, now, {.paces = paces});
      EXPECT_GT(tempo.tier_for(everyday), before + 10);
      EXPECT_EQ(tempo.tier_for(everyday), main_tier(tempo));
    }
  }
}

/// Also if it is only found out later who is fast: all stood still before.
TEST(Tempo, FollowsBodiesThatBecomeFaster) {
  Tempo tempo = chosen();
  double now = 0.0;
  for (int round = 0; round < 10; ++round) start_main(tempo, now, {.paces = bodies(100, {0.0, 0.0})});
  EXPECT_LT(tempo.typical_way(), 1e-80);
  const int main = main_tier(tempo);
  EXPECT_LT(tempo.tier_for(everyday), main - 100);
  for (int round = 0; round < 40; ++round)
    start_main(tempo, now, {.paces = bodies(100), .width = 1.0, .near = 100});
  EXPECT_EQ(tempo.tier_for(everyday), main_tier(tempo));
}

/// Where no main window holds most bodies, they do not start together, and the tempo learns from those that
/// start between.
TEST(Tempo, GrowsWhereMostAreInLongerWindows) {
  Tempo tempo = chosen();
  const int before = main_tier(tempo);
  for (int k = 0; k < 6; ++k) {
    Tempo::Round round(tempo, false);
    for (int body = 0; body < 64; ++body) round.note({1e-3, 0.0}, usual_width, main_tier(tempo));
    tempo.finish_start(round, none, many);
  }
  EXPECT_EQ(main_tier(tempo), before + 6 * Tempo::powers_between_tiers);
  EXPECT_EQ(tempo.typical_way(), length_of(main_tier(tempo) - before));
  EXPECT_TRUE(tempo.is_sound());
  // Up to the longest way.
  for (int round = 0; round < 6; ++round) start_between(tempo, bodies(64, {1e-3, 0.0}), none);
  EXPECT_EQ(tempo.typical_way(), 1e6);
  EXPECT_TRUE(tempo.is_sound());
}

/// A main window may be far shorter than times can be told apart: then all are in longer ones.
TEST(Tempo, GrowsWhereWindowsAreLongerThanItSays) {
  Tempo tempo = chosen(1.0, {1e60, 0.0});
  const int shortest = -40;
  ASSERT_LT(main_tier(tempo), shortest - 100);
  for (int k = 0; k < 60; ++k) {
    Tempo::Round round(tempo, false);
    for (int body = 0; body < 64; ++body)
      round.note(everyday, usual_width, std::max(main_tier(tempo), shortest));
    tempo.finish_start(round, none, many);
  }
  EXPECT_GT(main_tier(tempo), shortest);
}

TEST(Tempo, FastBodiesGoFarWhereNothingIsInTheirWay) {
  const Pace fast{1000.0, 0.0};
  Tempo tempo = chosen();
  const int main = main_tier(tempo);
  const int first = tempo.tier_for(fast);
  ASSERT_LT(first, main - Tempo::powers_between_tiers);
  std::vector<int> tiers;
  for (int round = 0; round < 5; ++round) {
    start_between(tempo, bodies(64, fast), none, 64);
    tiers.push_back(tempo.tier_for(fast));
    ASSERT_TRUE(tempo.is_sound());
  }
  EXPECT_EQ(tiers[0], first + Tempo::powers_between_tiers);
  EXPECT_EQ(tiers[4], main - Tempo::powers_between_tiers) << "shorter than the main one nevertheless";
  EXPECT_EQ(main_tier(tempo), main);
  EXPECT_EQ(tempo.typical_way(), 1.0);
  // Those that are faster go no farther than has been tried.
  const Pace faster{8e7, 0.0};
  const double way = faster.way(length_of(tempo.tier_for(faster)));
  EXPECT_LE(way, std::ldexp(4.0, 5 * Tempo::powers_between_tiers));
  EXPECT_GT(way, std::ldexp(4.0, 4 * Tempo::powers_between_tiers));
}

/// Where others come, the fast pass by too many of them.
TEST(Tempo, FastBodiesHaveShorterWindowsAmongMany) {
  const Pace fast{1e5, 0.0};
  for (const int dimensions : {2, 3}) {
    Tempo tempo = chosen(1.0, everyday, dimensions);
    const int first = tempo.tier_for(fast);
    for (int round = 0; round < 3; ++round) start_between(tempo, bodies(64, fast), none, 64);
    const int among_few = tempo.tier_for(fast);
    EXPECT_EQ(among_few, first + 3 * Tempo::powers_between_tiers);
    start_between(tempo, bodies(64, fast), none);
    EXPECT_EQ(tempo.tier_for(fast), among_few - Tempo::powers_between_tiers);
    for (int round = 0; round < 5; ++round) start_between(tempo, bodies(64, fast), none);
    EXPECT_GE(fast.way(length_of(tempo.tier_for(fast))), tempo.typical_way()) << "as far as most";
    EXPECT_EQ(tempo.typical_way(), 1.0);
  }
}

/// The windows of fast bodies differ by large factors: they do not go to and fro between two of them.
TEST(Tempo, FastBodiesFindTheirWindows) {
  const Pace fast{1e5, 0.0};
  for (const int dimensions : {2, 3}) {
    for (const double density : {1e-6, 1e-4, 1e-2, 1.0, 100.0}) {
      Tempo tempo = chosen(1.0, everyday, dimensions);
      int changes = 0;
      for (int round = 0; round < 100; ++round) {
        const int before = tempo.tier_for(fast);
        const double way = fast.way(length_of(before));
        start_between(tempo, bodies(64, fast), static_cast<std::uint64_t>(64 * density * way));
        if (tempo.tier_for(fast) != before) ++changes;
      }
      EXPECT_LE(changes, 4) << dimensions << " dimensions, density " << density;
    }
  }
}

TEST(Tempo, NobodyGoesMuchFartherThanTheLongestWay) {
  for (const double way : {0.1, 0.3, 0.5, 1.0, 2.0, 1e6}) {
    Tempo tempo(1.0, 3);
    tempo.choose(way, everyday);
    for (int round = 0; round < 20; ++round) {
      ASSERT_TRUE(tempo.is_sound()) << "way " << way << ", round " << round;
      for (double speed = 1e-3; speed < 1e6; speed *= 3.0)
        ASSERT_LE(speed * length_of(tempo.tier_for({speed, 0.0})), speed > 16.0 ? 1.0 : 4.0) << "way " << way;
      start_between(tempo, bodies(64, {1e3, 0.0}), none);
    }
  }
}

/// Every number zero, tiny, everyday, huge or infinite.
TEST(Tempo, StaysPossibleWhateverTheNumbers) {
  constexpr std::array values{0.0, 5e-324, 1e-300, 1e-100, 1e-9, 1.0, 1e9, 1e100, 1e300, infinity};
  Random random(seed + 2);
  const auto value = [&] { return values[random.bits() % values.size()]; };
  const auto positive = [&] { return std::clamp(value(), 1e-300, 1e300); };
  // As the limits of a world's tolerance let it be.
  const auto longest_way = [&] { return std::clamp(value(), 1e-60, 1e300); };
  const auto count = [&] {
    constexpr std::array<std::uint64_t, 4> counts{0, 1, 1000, std::uint64_t{1} << 62};
    return counts[random.bits() % 4];
  };
  const auto kicks = [&] {
    const std::uint64_t kicked = count();
    return Kicks{kicked, count()};
  };
  for (int k = 0; k < 20000; ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << k);
    Tempo tempo(longest_way(), random.bits() % 2 == 0 ? 2 : 3);
    tempo.choose(positive(), {value(), value()});
    double now = -1e300;
    for (int round = 0; round < 4; ++round) {
      now = std::max(now, value());
      const bool most = random.bits() % 2 == 0;
      if (most) tempo.start_main(std::min(now, 1e300), kicks());
      Tempo::Round starts(tempo, most);
      std::uint64_t left = random.bits() % 5;
      if (random.bits() % 8 == 0) left += 64;
      for (; left > 0; --left) {
        const Pace pace{value(), value()};
        const int tier = tempo.tier_for(pace);
        ASSERT_LE(std::abs(tier), 300 + Tempo::powers_between_tiers);
        starts.note(pace, value(), tier);
      }
      tempo.finish_start(starts, count(), many);
      ASSERT_GE(tempo.cost_of_width(positive()), 0.0);
      ASSERT_TRUE(tempo.is_sound()) << "round " << round;
    }
  }
}

/// Of spheres that stand still, each in the middle of what its search goes through.
TEST(Tempo, WiderCapsulesCostAsTheirVolume) {
  for (const int dimensions : {2, 3}) {
    Tempo tempo = chosen(1.0, everyday, dimensions);
    EXPECT_EQ(tempo.cost_of_width(1.0), 0.0) << "nothing is known yet";
    tempo.start_main(0.0, {});
    const auto round = round_of(tempo, true, bodies(10, {0.0, 0.0}), 2.0);
    tempo.finish_start(round, none, many);
    EXPECT_EQ(tempo.cost_of_width(0.0), 0.0);
    EXPECT_DOUBLE_EQ(tempo.cost_of_width(2.0), dimensions == 2 ? 3.0 * 24.0 : 7.0 * 24.0);
    tempo.finish_start(Tempo::Round(tempo, true), 10, many);
    EXPECT_GT(tempo.cost_of_width(2.0), dimensions == 2 ? 3.0 * 284.0 : 7.0 * 284.0)
        << "near pairs cost, too";
  }
}

/// Whoever adds up what, and in which order.
TEST(Tempo, RoundsHaveOneSum) {
  Random random(seed + 5);
  for (int k = 0; k < 300; ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << seed + 5 << ", case " << k);
    const bool most = chance(random, 0.5);
    Tempo one = chosen(log_uniform(random, -30, 30));
    Tempo other = one;
    double now = 0.0;
    for (int start = 0; start < 3; ++start) {
      const std::uint64_t near = random.bits() % 1000;
      if (most) one.start_main(now, {10, near});
      if (most) other.start_main(now, {10, near});
      Tempo::Round whole(one, most);
      std::vector<Tempo::Round> parts(1 + random.bits() % 5, Tempo::Round(other, most));
      for (int body = 0; body < 100; ++body) {
        const Pace pace{log_uniform(random, -30, 30), log_uniform(random, -30, 30)};
        const double width = log_uniform(random, -30, 60);
        whole.note(pace, width, one.tier_for(pace));
        parts[random.bits() % parts.size()].note(pace, width, other.tier_for(pace));
      }
      for (std::size_t part = parts.size() - 1; part > 0; --part) parts[part - 1] += parts[part];
      one.finish_start(whole, near, many);
      other.finish_start(parts[0], near, many);
      ASSERT_EQ(bytes_of(one), bytes_of(other));
      now += length_of(main_tier(one));
    }
  }
}

TEST(Survey, TellsTheDistanceOfNeighbours) {
  const auto spacing = [](int x, int y, int z) {
    Survey survey;
    for (int k = 0; k < x * y * z; ++k)
      survey.note({2.0 * (k % x), 2.0 * (k / x % y), 2.0 * (k / x / y)}, everyday);
    return survey.spacing();
  };
  for (const auto& [x, y, z] : {std::array{1000, 1, 1}, std::array{30, 30, 1}, std::array{10, 10, 10}}) {
    EXPECT_GT(spacing(x, y, z), 0.9) << x;
    EXPECT_LT(spacing(x, y, z), 2.7) << x;
  }
  Survey alone;
  alone.note({1.0, 2.0, 3.0}, everyday);
  EXPECT_EQ(alone.spacing(), 0.0);
}

TEST(Survey, TellsTheTypicalPace) {
  Random random(seed + 6);
  for (int k = 0; k < 1000; ++k) {
    Survey survey;
    std::vector<double> speeds, accelerations;
    for (std::uint64_t left = 1 + 2 * (random.bits() % 50); left > 0; --left) {
      speeds.push_back(chance(random, 0.1) ? 0.0 : log_uniform(random, -60, 60));
      accelerations.push_back(log_uniform(random, -60, 60));
      survey.note({}, {speeds.back(), accelerations.back()});
    }
    std::sort(speeds.begin(), speeds.end());
    const double speed = speeds[speeds.size() / 2];
    double acceleration = 0.0;
    for (const double each : accelerations) acceleration += each / static_cast<double>(accelerations.size());
    const Pace typical = survey.typical();
    ASSERT_TRUE(typical.speed <= 1.5 * speed && typical.speed >= 0.75 * speed)
        << "seed " << seed + 6 << ", case " << k;
    ASSERT_TRUE(typical.acceleration <= 1.5 * acceleration && typical.acceleration >= 0.75 * acceleration);
  }
  Survey immense;
  immense.note({}, {infinity, 0.0});
  EXPECT_EQ(immense.typical().speed, infinity);
  EXPECT_EQ(immense.typical().acceleration, 0.0);
}

/// However long nothing moves.
TEST(Tempo, HasALongestWindow) {
  const Pace hardly{1e-100, 0.0};
  Tempo tempo(1e300, 3);
  tempo.choose(1.0, hardly);
  double now = 0.0;
  for (int round = 0; round < 3000; ++round) {
    start_main(tempo, now, {.paces = bodies(3, hardly), .width = 1.0});
    ASSERT_TRUE(tempo.is_sound()) << round;
  }
  EXPECT_EQ(main_tier(tempo), 300);
}

TEST(Tempo, GoesOnAsBeforeAfterItWasBytes) {
  Random random(seed + 3);
  Tempo tempo = chosen();
  double now = 0.0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Pace> paces;
    for (int k = 0; k < 20; ++k) paces.push_back({log_uniform(random, -10, 10), random.uniform()});
    const std::uint64_t of_starts = random.bits() % 100;
    const bool most = random.bits() % 2 == 0;
    const auto kicks = [&] { return Kicks{.bodies = random.bits() % 1000, .near = random.bits() % 1000}; };
    if (most) tempo.start_main(now, kicks());
    tempo.finish_start(round_of(tempo, most, paces, random.uniform()), of_starts, many);
    const std::vector<std::byte> bytes = bytes_of(tempo);
    Tempo back = chosen();
    back.choose(3.0, everyday);
    ByteReader reader(bytes);
    reader(back);
    ASSERT_FALSE(reader.failed());
    EXPECT_EQ(reader.remaining(), 0u);
    ASSERT_TRUE(back.is_sound());
    now += random.uniform();
    const Kicks kicks_since = kicks();
    const std::uint64_t of_fast = random.bits() % 100;
    for (Tempo* each : {&tempo, &back}) {
      start_between(*each, bodies(70, {1e3, 0.0}), of_fast);
      each->start_main(now, kicks_since);
    }
    ASSERT_EQ(back.typical_way(), tempo.typical_way());
    ASSERT_EQ(back.cost_of_width(1.0), tempo.cost_of_width(1.0));
    for (const Pace& pace : paces) ASSERT_EQ(back.tier_for(pace), tempo.tier_for(pace));
  }
}

}  // namespace
}  // namespace kinesphere::tempo_test
