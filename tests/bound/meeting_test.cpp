// earliest_meeting of two bounds against its slow twin.
#include <gtest/gtest.h>

#include <string>

#include "support/bound_checks.hpp"
#include "support/test_size.hpp"

namespace kinesphere::meeting_test {
namespace {

constexpr std::uint64_t seed = 2005;
const auto cases_per_family = rounds_of<std::uint64_t>(12000);
double certificate(const PairCase& c) { return earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance); }

exact::Wide truth(const PairCase& c, exact::Wide extra = 0) {
  return exact::earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance, extra);
}

/// Allows the rounding error of the distance or, since a sequence of tangents only halves the rest of its way
/// in each round at a nearly double root, a small part of the gap and of the way since `from`.
testing::AssertionResult tight(const PairCase& c, const Tightness& allowed) {
  const double got = certificate(c);
  const double end = std::min(got, c.horizon);
  const auto offset = [&c](double t) { return c.a.centre_at(t) - c.b.centre_at(t); };
  const auto reach = [&c](double t) { return c.a.radius_at(t) + c.b.radius_at(t) + c.distance; };
  const double gap = std::max(0.0, norm(offset(c.from)) - reach(c.from));
  const double way = norm(offset(end) - offset(c.from)) + reach(end) - reach(c.from);
  const double extra = std::max(allowed.length * length_scale(c, end), 0x1p-22 * (gap + way));
  return hardly_early(got, truth(c, extra), c.from, c.horizon, allowed.part);
}

class EarliestMeeting : public testing::TestWithParam<Family> {};

TEST_P(EarliestMeeting, is_never_late) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 0);
    const PairCase c = GetParam().draw(random);
    ASSERT_TRUE(never_late(certificate(c), truth(c), c.from, c.horizon))
        << "seed " << seed << ", case " << k << "\n"
        << c;
  }
}

TEST_P(EarliestMeeting, is_tight) {
  const bool grazing = std::string(GetParam().name) == "grazing";
  const Tightness allowed = grazing ? Tightness{0x1p-20, 1e-3} : Tightness{};
  for (std::uint64_t k = 0; k < cases_per_family / 2; ++k) {
    Random random = Random::at(seed, k, 1);
    const PairCase c = GetParam().draw(random);
    ASSERT_TRUE(tight(c, allowed)) << "seed " << seed << ", case " << k << "\n" << c;
  }
}

TEST_P(EarliestMeeting, does_not_depend_on_the_order_of_the_bounds) {
  for (std::uint64_t k = 0; k < 1000; ++k) {
    Random random = Random::at(seed, k, 2);
    PairCase c = GetParam().draw(random);
    const double got = certificate(c);
    std::swap(c.a, c.b);
    ASSERT_EQ(got, certificate(c)) << "seed " << seed << ", case " << k << "\n" << c;
  }
}

TEST_P(EarliestMeeting, asked_again_on_the_way_is_never_late_and_tight) {
  int continued = 0;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    Random random = Random::at(seed, k, 3);
    PairCase c = GetParam().draw(random);
    const exact::Wide first_truth = truth(c);
    for (int question = 0; question < 4; ++question) {
      const double got = certificate(c);
      ASSERT_TRUE(never_late(got, first_truth, c.from, c.horizon))
          << "seed " << seed << ", case " << k << ", question " << question << "\n"
          << c;
      if (got == infinity || got <= c.from) break;
      c.from += (got - c.from) * (question == 0 ? 1.0 : random.uniform());
      ++continued;
    }
  }
  EXPECT_GT(continued, 0);
}

INSTANTIATE_TEST_SUITE_P(Families, EarliestMeeting, testing::ValuesIn(all_families), family_name);

TEST(EarliestMeetingOfTwoBounds, is_exact_for_bodies_on_a_line) {
  const Bound a{.velocity = {1, 0, 0}, .radius = 1};
  const Bound b{.position = {10, 0, 0}, .velocity = {-1, 0, 0}, .radius = 1};
  EXPECT_NEAR(earliest_meeting(a, b, 0, 100), 4.0, 1e-12);
  EXPECT_LE(earliest_meeting(a, b, 0, 100), 4.0);
  EXPECT_NEAR(earliest_meeting(a, b, 0, 100, 2.0), 3.0, 1e-12);
  EXPECT_NEAR(earliest_meeting(a, b, 0, 100, -1.0), 4.5, 1e-12);
}

TEST(EarliestMeetingOfTwoBounds, follows_the_paper_for_bodies_at_rest_that_may_accelerate) {
  // 2 * (1/2) A s^2 = gap, with A = 3 and gap = 12.
  const Bound a{.radius = 1, .acceleration_limit = 3};
  const Bound b{.position = {14, 0, 0}, .radius = 1, .acceleration_limit = 3};
  EXPECT_NEAR(earliest_meeting(a, b, 0, 100), 2.0, 1e-12);
}

TEST(EarliestMeetingOfTwoBounds, is_infinite_when_they_move_apart) {
  const Bound a{.radius = 1};
  const Bound b{.position = {5, 0, 0}, .velocity = {1, 0, 0}, .radius = 1};
  EXPECT_EQ(earliest_meeting(a, b, 0, 10), infinity);
  EXPECT_EQ(earliest_meeting(a, b, 0, infinity), infinity);
}

TEST(EarliestMeetingOfTwoBounds, is_infinite_exactly_when_the_horizon_comes_first) {
  const Bound a{.velocity = {1, 0, 0}, .radius = 1};
  const Bound b{.position = {10, 0, 0}, .radius = 1};
  EXPECT_EQ(earliest_meeting(a, b, 0, 7.999), infinity);
  EXPECT_LE(earliest_meeting(a, b, 0, 8.0), 8.0);
  EXPECT_LE(earliest_meeting(a, b, 0, 1e300), 8.0);
  EXPECT_EQ(earliest_meeting(a, b, 0, 0), infinity);
}

TEST(EarliestMeetingOfTwoBounds, is_from_when_they_touch_already) {
  const Bound a{.velocity = {-5, 0, 0}, .radius = 1};
  const Bound b{.position = {1.5, 0, 0}, .velocity = {5, 0, 0}, .radius = 1};
  for (const double from : {0.0, 1e-300, 0.01, 0.03}) {
    EXPECT_EQ(earliest_meeting(a, b, from, 10), from);
    EXPECT_EQ(earliest_meeting(a, b, from, from), from);
  }
  EXPECT_EQ(earliest_meeting(a, a, 0, 10), 0.0);
  EXPECT_EQ(earliest_meeting(a, {.position = {2, 0, 0}, .velocity = {1, 0, 0}, .radius = 1}, 0, 10), 0.0);
}

TEST(EarliestMeetingOfTwoBounds, tells_a_hit_from_a_miss_by_a_millionth) {
  for (const double miss : {-1e-3, -1e-6, -1e-9, 1e-6, 1e-3}) {
    const Bound a{.position = {-10, 2.0 * (1.0 + miss), 0}, .velocity = {3, 0, 0}, .radius = 1};
    const Bound b{.radius = 1};
    const double got = earliest_meeting(a, b, 0, 100);
    EXPECT_EQ(got == infinity, miss > 0.0) << miss;
  }
}

TEST(EarliestMeetingOfTwoBounds, of_points_needs_them_at_one_place) {
  const Bound a{.position = {-3, 0, 0}, .velocity = {1, 0, 0}};
  const double meets = earliest_meeting(a, Bound{}, 0, 100);
  EXPECT_LE(meets, 3.0);
  EXPECT_GT(meets, 3.0 - 1e-6);
  EXPECT_EQ(earliest_meeting(a, Bound{.position = {0, 1e-3, 0}}, 0, 100), infinity);
}

}  // namespace
}  // namespace kinesphere::meeting_test
