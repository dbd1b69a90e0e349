// Conservative advancement stops where steps gain little, and never passes the end of what it was told.
#include "bound/safe_steps.hpp"

#include <gtest/gtest.h>

namespace kinesphere::safe_steps_test {
namespace {

TEST(SafeSteps, ConvergeToTheRootOfTheirSteps) {
  for (const double root : {1e-6, 0.5, 3.0, 1e6}) {
    int rounds = 0;
    // Each step goes nine tenths of the way that is left.
    const double time = advance_by_safe_steps(2.0, 1e9, [&](double d) {
      ++rounds;
      return 0.9 * (root - d);
    });
    EXPECT_LT(time, 2.0 + root);
    EXPECT_NEAR(time - 2.0, root, 1e-6 * root + 1e-15);
    EXPECT_LE(rounds, most_rounds);
    EXPECT_GT(rounds, 5);
  }
}

TEST(SafeSteps, StopAfterTheFirstThatGainsNothing) {
  int rounds = 0;
  const auto step = [&](double) {
    ++rounds;
    return 0.0;
  };
  EXPECT_EQ(advance_by_safe_steps(5.0, 9.0, step), 5.0);
  EXPECT_EQ(rounds, 1);
}

TEST(SafeSteps, AreLimitedInNumber) {
  int rounds = 0;
  const double time = advance_by_safe_steps(0.0, 1e300, [&](double d) {
    ++rounds;
    return d + 1.0;  // doubles the way, for ever
  });
  EXPECT_EQ(rounds, most_rounds);
  EXPECT_LE(time, 65535.0);
  EXPECT_NEAR(time, 65535.0, 1e-6);
}

TEST(SafeSteps, PastTheEndAreNever) {
  EXPECT_EQ(advance_by_safe_steps(1.0, 2.0, [](double) { return 1.5; }), infinity);
  EXPECT_EQ(advance_by_safe_steps(1.0, 2.0, [](double) { return infinity; }), infinity);
  EXPECT_EQ(advance_by_safe_steps(1.0, 2.0, [](double d) { return d == 0.0 ? 1.5 : 0.0; }), infinity);
  EXPECT_LE(advance_by_safe_steps(1.0, 2.5, [](double d) { return d == 0.0 ? 1.5 : 0.0; }), 2.5);
}

TEST(SafeSteps, ThatAreNoNumbersLeaveTheTimeAsItIs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(advance_by_safe_steps(1.0, 2.0, [=](double) { return nan; }), 1.0);
}

}  // namespace
}  // namespace kinesphere::safe_steps_test
