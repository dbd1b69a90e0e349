// The two tests of the inner loop for a pair of bounds, against the slow twin of earliest_meeting.
#include "bound/quick_reject.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "number/infinity.hpp"
#include "support/exact_certificates.hpp"
#include "support/family_test.hpp"

namespace kinesphere::quick_reject_test {
namespace {

using exact::Wide;

constexpr std::uint64_t seed = 2111;

/// Returns the case with `distance` as the margin, which is not negative; the radii are reduced instead.
PairCase with_room(PairCase c, Random&) {
  if (c.distance < 0.0) {
    c.a.radius = std::max(0.0, c.a.radius + c.b.radius + c.distance);
    c.b.radius = c.distance = 0.0;
  }
  return c;
}

QuickReject encounter_of(const PairCase& c) { return {BoundAt(c.a, c.from), BoundAt(c.b, c.from)}; }

/// The rounding error that quick_reject.hpp allows.
double rounding_error(const PairCase& c, double end) {
  return 0x1p-49 * (std::max(length_scale(c.a, end), length_scale(c.b, end)) + c.distance);
}

/// Returns the first time at which the bounds are within the margin and `extra`.
Wide truth(const PairCase& c, Wide extra) {
  return exact::earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance, extra);
}

/// Returns |X| less the radii and the margin, at `from`.
Wide gap_now(const PairCase& c) {
  const exact::Course a(c.a, c.from), b(c.b, c.from);
  return exact::sqrt(exact::squared_distance(a, b).at(0)) - a.growth.at(0) - b.growth.at(0) -
         (Wide(c.a.radius) + c.b.radius + c.distance);
}

bool is_straight(const PairCase& c) {
  return c.a.planned_acceleration == c.b.planned_acceleration && c.a.acceleration_limit == 0.0 &&
         c.b.acceleration_limit == 0.0 && c.a.growth_speed == 0.0 && c.b.growth_speed == 0.0;
}

PairCase far_out(Random& random) {
  PairCase c = chance(random, 0.5) ? families::ballistic(random) : families::everyday(random);
  const Vec3 place = 1e4 * random.unit_vector();
  c.a.position += place;
  c.b.position += place;
  c.distance = 1e-9;
  return c;
}

PairCase at_rest(Random& random) {
  return random_pair(random, {.speed = 0.0, .plan = 0.0, .growth_speed = 0.0, .acceleration_limit = 0.0});
}

/// Returns a case that misses or meets by a billionth of the distance of the centres.
PairCase grazing_by_a_billionth(Random& random) {
  PairCase c = families::grazing(random);
  const double part = random.uniform(-1e-9, 1e-9);
  c.distance += part * (c.distance + c.a.radius + c.b.radius);
  return c;
}

std::vector<Family> families_here() {
  std::vector<Family> families = all_families;
  families.push_back({"far_out", far_out});
  families.push_back({"at_rest", at_rest});
  families.push_back({"grazing_by_a_billionth", grazing_by_a_billionth});
  return families;
}

class Encounters : public FamilyTest<seed, with_room> {};

TEST_P(Encounters, that_stay_apart_do_not_meet) {
  for_each_case(0, [](const PairCase& c, Random&) {
    if (!encounter_of(c).stay_apart(c.horizon - c.from, c.distance)) return;
    EXPECT_GT(truth(c, -Wide(rounding_error(c, c.horizon))), Wide(c.horizon));
  });
}

/// Returns two bounds on straight lines, with their final radii, enlarged by half of their turns.
PairCase straightened(const PairCase& c) {
  const BoundAt a(c.a, c.from), b(c.b, c.from);
  const double duration = c.horizon - c.from;
  const double turn = 0.5 * norm_one(a.acceleration - b.acceleration) * duration * duration;
  PairCase straight = c;
  straight.a = {.time = c.from,
                .position = a.centre,
                .velocity = a.velocity,
                .radius = c.a.radius_at(c.horizon) + turn};
  straight.b = {
      .time = c.from, .position = b.centre, .velocity = b.velocity, .radius = c.b.radius_at(c.horizon)};
  return straight;
}

TEST_P(Encounters, whose_straightened_ways_do_not_meet_stay_apart) {
  for_each_case(1, [](const PairCase& c, Random&) {
    const Wide error = rounding_error(c, c.horizon);
    if (truth(straightened(c), error) <= Wide(c.horizon)) return;
    EXPECT_TRUE(encounter_of(c).stay_apart(c.horizon - c.from, c.distance));
  });
}

TEST_P(Encounters, are_never_later_than_the_truth) {
  for_each_case(2, [](const PairCase& c, Random&) {
    const double got = encounter_of(c).meeting(c.horizon - c.from, c.distance);
    const double end = std::min(c.horizon, c.from + got);
    const Wide latest = truth(c, -Wide(rounding_error(c, end)));
    EXPECT_GE(got, 0.0);
    EXPECT_TRUE(got <= c.horizon - c.from || got == infinity) << got;
    EXPECT_LE(Wide(c.from) + Wide(got), latest)
        << got << " is too late by " << static_cast<double>(Wide(c.from) + Wide(got) - latest);
  });
}

/// Allows the rounding error of the margin, or a part of the gap and of the way; for turning or growing
/// bounds the search stops when it becomes slow.
TEST_P(Encounters, are_hardly_early) {
  if (std::string(GetParam().name).starts_with("grazing"))
    GTEST_SKIP() << "what rounding does to a length takes a long time there";
  for_each_case(3, [](const PairCase& c, Random&) {
    const double got = encounter_of(c).meeting(c.horizon - c.from, c.distance);
    if (got == infinity) return;
    const double end = c.from + got;
    const auto offset = [&c](double t) { return c.a.centre_at(t) - c.b.centre_at(t); };
    const auto radii = [&c](double t) { return c.a.radius_at(t) + c.b.radius_at(t); };
    const double gap = std::max(0.0, static_cast<double>(gap_now(c)));
    const double way = norm(offset(end) - offset(c.from)) + radii(end) - radii(c.from);
    const double extra =
        std::max(64.0 * rounding_error(c, end), (is_straight(c) ? 0x1p-22 : 0x1p-7) * (gap + way));
    const Wide part = is_straight(c) ? 1e-9 : 0.02;
    EXPECT_GE(Wide(c.from) + Wide(got) * (1 + part), truth(c, extra));
  });
}

TEST_P(Encounters, meet_at_the_same_time_whatever_the_duration) {
  for_each_case(4, [](const PairCase& c, Random&) {
    const double duration = c.horizon - c.from;
    const QuickReject encounter = encounter_of(c);
    const double meeting = encounter.meeting(infinity, c.distance);
    EXPECT_EQ(encounter.meeting(duration, c.distance), meeting > duration ? infinity : meeting);
  });
}

TEST_P(Encounters, are_near_where_the_gap_is_within_the_room) {
  for_each_case(5, [](const PairCase& c, Random&) {
    const Wide gap = gap_now(c);
    const Wide error = rounding_error(c, c.from);
    const QuickReject encounter = encounter_of(c);
    if (gap > error) {
      EXPECT_FALSE(encounter.is_near(c.distance));
    }
    if (gap <= -error) {
      EXPECT_TRUE(encounter.is_near(c.distance));
      EXPECT_FALSE(encounter.stay_apart(0.0, c.distance));
      EXPECT_EQ(encounter.meeting(infinity, c.distance), 0.0);
    }
  });
}

/// Returns the reach of the moved bound from the centre of one that moves straight on.
Wide reach(const BoundAt& moved, const Bound& bound, double from, Wide d) {
  const exact::Course course(bound, from);
  Wide squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Wide way = course.centre[static_cast<std::size_t>(axis)].at(d) -
                     (Wide(moved.centre[axis]) + Wide(moved.velocity[axis]) * d);
    squares += way * way;
  }
  return exact::sqrt(squares) + bound.radius + course.growth.at(d);
}

TEST_P(Encounters, have_bounds_that_stay_within_the_radius_of_a_straight_one) {
  for_each_case(6, [](const PairCase& c, Random&) {
    const BoundAt moved(c.a, c.from);
    const double duration = c.horizon - c.from;
    const Wide error = Wide(0x1p-49) * length_scale(c.a, c.horizon);
    const Wide radius = moved.radius_after(duration);
    for (int k = 0; k <= 8; ++k)
      EXPECT_LE(reach(moved, c.a, c.from, Wide(duration) * k / 8), radius + error) << k;
    if (c.a.planned_acceleration == Vec3{}) {
      EXPECT_GE(reach(moved, c.a, c.from, Wide(duration)), radius - error);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, Encounters, testing::ValuesIn(families_here()), family_name);

/// Ballistic bounds with central impacts.
TEST(QuickReject, of_ballistic_bounds_is_exact) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 7);
    const double radius = random.uniform(0.2, 1.0);
    const Vec3 aim = 1.8 * radius * random.point_in_ball();
    PairCase c{.a = {.velocity = 5.0 * random.point_in_ball(), .radius = radius},
               .b = {.radius = radius},
               .horizon = 1e9,
               .distance = 1e-9};
    const Vec3 closing = 4.0 * random.unit_vector();
    const double lead = random.uniform(1.0, 5.0);
    c.b.velocity = c.a.velocity - closing;
    c.b.position = closing * lead + aim;
    c.a.planned_acceleration = c.b.planned_acceleration = {0.0, 0.0, -9.81};
    const double got = encounter_of(c).meeting(infinity, c.distance);
    ASSERT_GE(Wide(got) * (1 + Wide(1e-9)), truth(c, 0)) << "seed " << seed << ", case " << k << "\n" << c;
    ASSERT_LE(Wide(got), truth(c, 0)) << "seed " << seed << ", case " << k << "\n" << c;
  }
}

}  // namespace
}  // namespace kinesphere::quick_reject_test
