// The sweep through one plane, compared with all pairs of lines, with and without ties.
#include "research/rivals/hubbard/sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::sweep_test {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

constexpr auto ignore = [](std::uint32_t, std::uint32_t) {};

/// Returns a line with one of few values, so that lines coincide, are parallel and cross in common points.
/// Products are exact.
Line degenerate_line(Random& random) {
  const auto whole = [&random] { return static_cast<double>(random.bits() % 7) - 3.0; };
  return {whole(), whole()};
}

Line random_line(Random& random) { return {random.uniform(-10.0, 10.0), random.uniform(-5.0, 5.0)}; }

/// Returns the crossings during [0, duration] of lines that are sorted at time 0, by (below, above).
std::map<Pair, double> crossings_of_all_pairs(const Sweep& sweep, std::uint32_t count, double duration) {
  std::map<Pair, double> overlaps;
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = 0; b < count; ++b) {
      if (a == b || !sweep.is_below(a, b)) continue;
      const double gap = sweep.line(b).start - sweep.line(a).start;
      const double closing = sweep.line(a).speed - sweep.line(b).speed;
      if (closing * duration > gap) overlaps[{a, b}] = gap / closing;
    }
  return overlaps;
}

/// Sweeps to the end and compares every crossing with `expected`.
void expect_crossings(Sweep& sweep, std::map<Pair, double> expected, double error) {
  double last = 0.0;
  while (sweep.next_time() < std::numeric_limits<double>::infinity()) {
    const double due = sweep.next_time();
    const Sweep::Crossing overlap = sweep.step();
    ASSERT_EQ(overlap.time, due);
    ASSERT_GE(overlap.time, last);
    last = overlap.time;
    const auto found = expected.find({overlap.below, overlap.above});
    ASSERT_NE(found, expected.end()) << overlap.below << " and " << overlap.above << " cross at " << last;
    ASSERT_NEAR(overlap.time, found->second, error);
    ASSERT_TRUE(sweep.is_below(overlap.above, overlap.below));
    ASSERT_TRUE(sweep.is_sorted(error));
    expected.erase(found);
  }
  EXPECT_TRUE(expected.empty()) << expected.size() << " crossings have not been found";
}

class SweepAgainstAllPairs : public ::testing::TestWithParam<Line (*)(Random&)> {};

TEST_P(SweepAgainstAllPairs, finds_every_crossing_once) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random = Random::at(1995, 0, seed);
    const auto count = static_cast<std::uint32_t>(random.bits() % 40);
    const double duration = 4.0;
    Sweep sweep;
    for (std::uint32_t number = 0; number < count; ++number) sweep.insert(number, GetParam()(random));
    sweep.sort(ignore);
    sweep.begin(duration);
    ASSERT_TRUE(sweep.is_sorted(0.0));
    expect_crossings(sweep, crossings_of_all_pairs(sweep, count, duration), 1e-9);
  }
}

/// Lines are changed between sweeps, which may stop half-way, and some lines are added and erased.
TEST_P(SweepAgainstAllPairs, starts_anew_from_any_order) {
  Random random(96);
  const std::uint32_t count = 24;
  Sweep sweep;
  for (std::uint32_t number = 0; number < count; ++number) sweep.insert(number, GetParam()(random));
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    const auto moved = static_cast<std::uint32_t>(random.bits() % count);
    sweep.erase(moved);
    EXPECT_FALSE(sweep.contains(moved));
    sweep.insert(moved, {});
    for (std::uint32_t number = 0; number < count; ++number) sweep.line(number) = GetParam()(random);
    sweep.sort(ignore);
    sweep.begin(3.0);
    if (round % 2 == 0) {
      expect_crossings(sweep, crossings_of_all_pairs(sweep, count, 3.0), 1e-9);
    } else {
      for (int k = 0; k < 20 && sweep.next_time() <= 3.0; ++k) sweep.step();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lines, SweepAgainstAllPairs, ::testing::Values(random_line, degenerate_line),
                         [](const auto& lines) { return lines.index == 0 ? "random" : "degenerate"; });

TEST(Sweep, reports_each_exchange_of_a_sort) {
  Random random(3);
  Sweep sweep;
  const std::uint32_t count = 30;
  for (std::uint32_t number = 0; number < count; ++number) sweep.insert(number, random_line(random));
  std::map<Pair, int> exchanges;
  sweep.sort([&](std::uint32_t below, std::uint32_t above) {
    EXPECT_TRUE(sweep.is_below(above, below));
    ++exchanges[{below, above}];
  });
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b)
      EXPECT_EQ(exchanges.count({a, b}), sweep.line(b).start < sweep.line(a).start ? 1u : 0u);
}

TEST(Sweep, a_bundle_through_one_point_is_turned_over) {
  Sweep sweep;
  const std::uint32_t count = 50;
  for (std::uint32_t number = 0; number < count; ++number) {
    const double speed = 0.1 * static_cast<double>(number);
    sweep.insert(number, {7.0 - 2.0 * speed, speed});
  }
  sweep.sort(ignore);
  sweep.begin(4.0);
  std::uint32_t overlaps = 0;
  while (sweep.next_time() <= 4.0) {
    EXPECT_NEAR(sweep.step().time, 2.0, 1e-12);
    ++overlaps;
    EXPECT_TRUE(sweep.is_sorted(Sweep::order_error(count, 20.0)));
  }
  EXPECT_EQ(overlaps, count * (count - 1) / 2);
}

TEST(Sweep, coincident_and_parallel_lines_do_not_cross) {
  Sweep sweep;
  for (std::uint32_t number = 0; number < 6; ++number) sweep.insert(number, {number < 3 ? 1.0 : 2.0, -0.5});
  sweep.sort(ignore);
  sweep.begin(1e6);
  EXPECT_EQ(sweep.next_time(), std::numeric_limits<double>::infinity());
}

/// The error of the order stays within order_error(), also where many lines of very different sizes nearly
/// coincide.
TEST(Sweep, order_is_right_up_to_the_promised_error) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random = Random::at(1995, 1, seed);
    const std::uint32_t count = 60;
    Sweep sweep;
    for (std::uint32_t number = 0; number < count; ++number) {
      const double speed = random.uniform(-1.0, 1.0);
      sweep.insert(number, {1e6 - speed + random.uniform(-1.0, 1.0) * 1e-9, speed});
    }
    sweep.sort(ignore);
    sweep.begin(2.0);
    const double error = Sweep::order_error(count, 1e6 + 2.0);
    while (sweep.next_time() <= 2.0) {
      sweep.step();
      ASSERT_TRUE(sweep.is_sorted(error));
    }
  }
}

}  // namespace
}  // namespace kinesphere::sweep_test
