// Windows of one length begin and end at its multiples; shorter ones exist for bodies that find the others
// taken.
#include "broadphase/window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "broadphase/window_policy.hpp"
#include "kinesphere/random.hpp"
#include "support/bound_cases.hpp"

namespace kinesphere::window_test {
namespace {

constexpr std::uint64_t seed = 4507;

TEST(Window, OfOneLengthBeginsAndEndsAtItsMultiples) {
  Random random(seed);
  for (int k = 0; k < 20000; ++k) {
    const double size = log_uniform(random, -100, 100);
    const double now = chance(random, 0.1) ? 0.0 : random.uniform(-1.0, 1.0) * size;
    const int rung = static_cast<int>(random.bits() % 300) - 150;
    const Window window = Window::at(now, rung);
    const double length = std::ldexp(1.0, window.rung);
    ASSERT_TRUE(window.is_valid());
    ASSERT_GE(window.rung, rung) << "seed " << seed << ", case " << k;
    if (std::ldexp(1.0, rung) > 0x1p-49 * std::abs(now)) {
      ASSERT_EQ(window.rung, rung);
    }
    ASSERT_LT(now, window.end);
    ASSERT_EQ(window.begin(), window.end - length);
    ASSERT_LE(window.begin(), now);
    ASSERT_EQ(window.end / length, std::floor(window.end / length));
    // Its end is also the end of all shorter windows.
    const Window shorter = Window::at(now, rung - 3);
    ASSERT_LE(shorter.end, window.end);
    ASSERT_EQ(Window::at(now, Window::shortest).rung, Window::at(now, -310).rung);
  }
}

TEST(Window, IsShorterWhereOthersHoldTheTier) {
  const double now = 3.0;
  std::vector<int> held{5, 5 - WindowPolicy::powers_between_rungs};
  EXPECT_EQ(Window::free_at(now, 4, held), Window::at(now, 4));
  EXPECT_EQ(Window::free_at(now, 5, held), Window::at(now, 5 - 2 * WindowPolicy::powers_between_rungs));
  held.clear();
  for (int rung = 5; rung > -Window::longest_rung; --rung) held.push_back(rung);
  EXPECT_EQ(Window::free_at(now, 5, held).end, now) << "there is none";
}

TEST(Window, ThatNeverEndsHasNoDuration) {
  EXPECT_TRUE(Window::endless().is_valid());
  EXPECT_EQ(Window::endless().end, infinity);
  EXPECT_EQ(duration_until(Window::endless().end, 3.0), 0.0);
  EXPECT_EQ(duration_until(5.0, 3.0), 2.0);
  EXPECT_FALSE((Window{Window::endless().rung, 1.0}.is_valid()));
  EXPECT_FALSE((Window{0, infinity}.is_valid()));
  EXPECT_FALSE((Window{Window::longest_rung + 1, 1.0}.is_valid()));
}

}  // namespace
}  // namespace kinesphere::window_test
