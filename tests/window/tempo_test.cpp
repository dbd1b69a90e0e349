// Windows get shorter where searches cost most, and longer where starts do; and stay possible whatever the
// numbers.
#include "window/tempo.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "archive/archive.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"
#include "support/bound_cases.hpp"

namespace kinesphere {
namespace {

constexpr std::uint64_t seed = 4301;
constexpr SearchCost nothing{};
constexpr SearchCost immense{.capsules = 1'000'000'000'000};

Tempo chosen(double way = 1.0, const Pace& typical = {1.0, 0.0}) {
  Tempo tempo;
  tempo.choose(way, typical, 1e6 * way);
  return tempo;
}

/// A round of bodies in main windows.
void start(Tempo& tempo, int bodies, const Pace& pace, double width) {
  for (int k = 0; k < bodies; ++k) tempo.note_start(pace, width, tempo.tier_for(pace));
}

TEST(Tempo, ATypicalBodyGoesAboutTheChosenWay) {
  Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const double way = log_uniform(random, -60, 60);
    const Pace typical{log_uniform(random, -60, 60),
                       chance(random, 0.5) ? 0.0 : log_uniform(random, -60, 60)};
    const Tempo tempo = chosen(way, typical);
    ASSERT_TRUE(tempo.is_chosen() && tempo.is_sound());
    const double gone = typical.way(std::ldexp(1.0, tempo.tier_for(typical)));
    ASSERT_LE(gone, 1.001 * way) << "seed " << seed << ", case " << k;
    ASSERT_GE(gone, 0.249 * way) << "seed " << seed << ", case " << k;
  }
}

TEST(Tempo, FasterBodiesHaveNoLongerWindows) {
  Random random(seed + 1);
  for (int k = 0; k < 200; ++k) {
    const double way = log_uniform(random, -20, 20);
    const Tempo tempo = chosen(way, {log_uniform(random, -20, 20), 0.0});
    const int main = tempo.tier_for({0.0, 0.0});
    int last = main;
    for (double speed = 1e-30; speed < 1e30; speed *= 3.0) {
      const int tier = tempo.tier_for({speed, 0.0});
      ASSERT_LE(tier, last) << "seed " << seed << ", case " << k << ", speed " << speed;
      ASSERT_LE(tempo.tier_for({speed, speed}), tier);
      ASSERT_EQ((main - tier) % Tempo::powers_between_tiers, 0);
      ASSERT_LE(speed * std::ldexp(1.0, tier), 4.0 * tempo.typical_way()) << "much farther than most";
      if (tier < main) {
        ASSERT_GT(speed * std::ldexp(1.0, tier + Tempo::powers_between_tiers), 4.0 * tempo.typical_way())
            << "shorter than needed";
      }
      last = tier;
    }
    ASSERT_LT(last, main - 30) << "the fastest have far shorter ones";
  }
}

TEST(Tempo, ShorterWhereSearchesCostMost) {
  for (const int dimensions : {2, 3}) {
    Tempo tempo = chosen();
    const Pace pace{1.0, 0.0};
    const int before = tempo.tier_for(pace);
    start(tempo, 100, pace, 0.1);
    tempo.adapt(immense, immense, 1.0, dimensions);
    EXPECT_LT(tempo.tier_for(pace), before);
    EXPECT_GE(tempo.tier_for(pace), before - 6);
    EXPECT_NEAR(std::log2(tempo.typical_way()), tempo.tier_for(pace) - before, 1e-9);
    EXPECT_TRUE(tempo.is_sound());
  }
}

/// Where ways make most of the capsules, these grow with the cube of the length of windows, or its square.
TEST(Tempo, InAPlaneWindowsAreLonger) {
  const Pace pace{1.0, 0.0};
  std::array<int, 2> tiers{};
  for (const int dimensions : {2, 3}) {
    Tempo tempo = chosen();
    start(tempo, 100, pace, 1e-6);
    tempo.adapt({.capsules = 26'000}, nothing, 1.0, dimensions);
    tiers[static_cast<std::size_t>(dimensions - 2)] = tempo.tier_for(pace);
  }
  EXPECT_GT(tiers[0], tiers[1]);
}

TEST(Tempo, LongerWhereStartsCostMostUpToTheLongestWay) {
  Tempo tempo = chosen();
  const Pace pace{1.0, 0.0};
  int before = tempo.tier_for(pace);
  for (int round = 0; round < 60; ++round) {
    start(tempo, 100, pace, 0.1);
    tempo.adapt(nothing, nothing, 1.0, 3);
    const int tier = tempo.tier_for(pace);
    EXPECT_EQ(tier, tempo.typical_way() <= 1e6 && round < 19 ? before + 1 : before) << round;
    before = tier;
  }
  EXPECT_LE(tempo.typical_way(), 1e6);
  EXPECT_GT(tempo.typical_way(), 0.25e6);
}

TEST(Tempo, StaysWhereNothingIsMuchCheaper) {
  const Pace pace{1.0, 0.0};
  int changes = 0;
  Tempo tempo = chosen();
  for (int round = 0; round < 100; ++round) {
    const int before = tempo.tier_for(pace);
    start(tempo, 100, pace, 0.5);
    // As in a crowd: what searches find grows with the volume of the capsules.
    const double larger = 0.5 + tempo.typical_way();
    const auto looked_at = static_cast<std::uint64_t>(100 * 20 * larger * larger * larger);
    tempo.adapt({.capsules = looked_at}, {.capsules = looked_at}, std::ldexp(1.0, before), 3);
    if (tempo.tier_for(pace) != before) ++changes;
  }
  EXPECT_LE(changes, 12);
  EXPECT_LT(tempo.typical_way(), 16.0);
  EXPECT_GT(tempo.typical_way(), 0x1p-4);
}

TEST(Tempo, WithoutStartsNothingIsKnown) {
  Tempo tempo = chosen();
  const int before = tempo.tier_for({1.0, 0.0});
  tempo.adapt(immense, immense, 1.0, 3);
  EXPECT_EQ(tempo.tier_for({1.0, 0.0}), before);
}

TEST(Tempo, DoesNotGrowForFewThatAreSlow) {
  Tempo tempo = chosen();
  const int before = tempo.tier_for({1.0, 0.0});
  start(tempo, 10, {1.0, 0.0}, 0.1);
  start(tempo, 20, {1e3, 0.0}, 0.1);
  tempo.adapt(nothing, nothing, 1.0, 3);
  EXPECT_LE(tempo.tier_for({1.0, 0.0}), before);
}

/// Every number zero, tiny, everyday, huge or infinite.
TEST(Tempo, StaysPossibleWhateverTheNumbers) {
  constexpr std::array values{0.0, 5e-324, 1e-300, 1e-100, 1e-9, 1.0, 1e9, 1e100, 1e300, infinity};
  Random random(seed + 2);
  const auto value = [&] { return values[random.bits() % values.size()]; };
  const auto cost = [&] {
    constexpr std::array<std::uint64_t, 4> counts{0, 1, 1000, std::uint64_t{1} << 62};
    SearchCost c;
    for (std::uint64_t* part : {&c.capsules, &c.rows, &c.found, &c.hot}) *part = counts[random.bits() % 4];
    return c;
  };
  for (int k = 0; k < 20000; ++k) {
    Tempo tempo;
    const double way = std::max(value(), 1e-300);
    const Pace typical{value(), value()};
    tempo.choose(std::min(way, 1e300), typical, value());
    for (int round = 0; round < 3; ++round) {
      for (std::uint64_t left = random.bits() % 5; left > 0; --left) {
        const Pace pace{value(), value()};
        const int tier = tempo.tier_for(pace);
        ASSERT_LE(std::abs(tier), 302) << "seed " << seed << ", case " << k;
        tempo.note_start(pace, value(), tier);
      }
      const SearchCost starts = cost();
      const SearchCost later = cost();
      tempo.adapt(starts, later, std::max(value(), 1e-300), round < 2 ? 3 : 2);
      ASSERT_TRUE(tempo.is_sound()) << "seed " << seed << ", case " << k << ", round " << round;
    }
  }
}

/// However long nothing moves.
TEST(Tempo, HasALongestWindow) {
  const Pace hardly{1e-100, 0.0};
  Tempo tempo;
  tempo.choose(1.0, hardly, 1e300);
  for (int round = 0; round < 3000; ++round) {
    start(tempo, 3, hardly, 1.0);
    tempo.adapt(nothing, nothing, 1.0, 3);
    ASSERT_TRUE(tempo.is_sound()) << round;
  }
  EXPECT_EQ(tempo.tier_for({0.0, 0.0}), 300);
}

TEST(Tempo, GoesOnAsBeforeAfterItWasBytes) {
  Random random(seed + 3);
  Tempo tempo = chosen();
  for (int round = 0; round < 200; ++round) {
    const Pace pace{log_uniform(random, -3, 3), random.uniform()};
    start(tempo, 20, pace, random.uniform());
    ByteWriter writer;
    writer(tempo);
    Tempo back = chosen(3.0);
    ByteReader reader(writer.bytes());
    reader(back);
    ASSERT_FALSE(reader.failed());
    ASSERT_TRUE(back.is_sound());
    SearchCost cost;
    cost.capsules = random.bits() % 10000;
    tempo.adapt(cost, cost, 1.0, 3);
    back.adapt(cost, cost, 1.0, 3);
    ASSERT_EQ(back.typical_way(), tempo.typical_way());
    ASSERT_EQ(back.tier_for(pace), tempo.tier_for(pace));
  }
}

}  // namespace
}  // namespace kinesphere
