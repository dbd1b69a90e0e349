// Windows of one length begin and end at its multiples; there are shorter ones for those who find the others
// taken.
#include "window/window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kinesphere/random.hpp"
#include "support/bound_cases.hpp"
#include "window/tempo.hpp"

namespace kinesphere::window_test {
namespace {

constexpr std::uint64_t seed = 4507;

TEST(Window, OfOneLengthBeginsAndEndsAtItsMultiples) {
  Random random(seed);
  for (int k = 0; k < 20000; ++k) {
    const double size = log_uniform(random, -100, 100);
    const double now = chance(random, 0.1) ? 0.0 : random.uniform(-1.0, 1.0) * size;
    const int tier = static_cast<int>(random.bits() % 300) - 150;
    const Window window = Window::at(now, tier);
    const double length = std::ldexp(1.0, window.tier);
    ASSERT_TRUE(window.is_sound());
    ASSERT_GE(window.tier, tier) << "seed " << seed << ", case " << k;
    if (std::ldexp(1.0, tier) > 0x1p-49 * std::abs(now)) {
      ASSERT_EQ(window.tier, tier);
    }
    ASSERT_LT(now, window.end);
    ASSERT_EQ(window.begin(), window.end - length);
    ASSERT_LE(window.begin(), now);
    ASSERT_EQ(window.end / length, std::floor(window.end / length));
    // Where it ends all shorter ones end.
    const Window shorter = Window::at(now, tier - 3);
    ASSERT_LE(shorter.end, window.end);
    ASSERT_EQ(Window::at(now, Window::shortest).tier, Window::at(now, -310).tier);
  }
}

TEST(Window, IsShorterWhereOthersHoldTheTier) {
  const double now = 3.0;
  std::vector<int> held{5, 5 - Tempo::powers_between_tiers};
  EXPECT_EQ(Window::free_at(now, 4, held), Window::at(now, 4));
  EXPECT_EQ(Window::free_at(now, 5, held), Window::at(now, 5 - 2 * Tempo::powers_between_tiers));
  held.clear();
  for (int tier = 5; tier > -Window::longest_tier; --tier) held.push_back(tier);
  EXPECT_EQ(Window::free_at(now, 5, held).end, now) << "there is none";
}

TEST(Window, ThatNeverEndsHasNoDuration) {
  EXPECT_TRUE(Window::endless().is_sound());
  EXPECT_EQ(Window::endless().end, infinity);
  EXPECT_EQ(duration_until(Window::endless().end, 3.0), 0.0);
  EXPECT_EQ(duration_until(5.0, 3.0), 2.0);
  EXPECT_FALSE((Window{Window::endless().tier, 1.0}.is_sound()));
  EXPECT_FALSE((Window{0, infinity}.is_sound()));
  EXPECT_FALSE((Window{Window::longest_tier + 1, 1.0}.is_sound()));
}

}  // namespace
}  // namespace kinesphere::window_test
