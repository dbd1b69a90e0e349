// earliest_meeting and earliest_separation of a bound and the plane of a half-space against their slow twins.
#include <gtest/gtest.h>

#include "support/bound_checks.hpp"
#include "support/test_size.hpp"

namespace kinesphere::half_space_test {
namespace {

constexpr std::uint64_t seed = 1638;
const auto cases_per_family = rounds_of<std::uint64_t>(8000);
struct WallCase {
  Bound bound;
  HalfSpace wall;
  double from, horizon, distance;
};

std::ostream& operator<<(std::ostream& out, const WallCase& c) {
  return out << "bound = " << c.bound << std::hexfloat << "\nwall " << c.wall.normal << ", " << c.wall.offset
             << "\nfrom " << c.from << ", horizon " << c.horizon << ", distance " << c.distance
             << std::defaultfloat;
}

/// Returns a plane about as far from the bound as the bound is large, or as it moves; on the `inside` or not.
WallCase draw(const Family& family, Random& random, bool inside) {
  const PairCase pair = family.draw(random);
  WallCase c{pair.a, {}, pair.from, pair.horizon, pair.distance};
  c.wall.normal = random.unit_vector();
  if (chance(random, 0.3)) {
    c.wall.normal = {};
    c.wall.normal[static_cast<int>(random.bits() % 3)] = chance(random, 0.5) ? 1.0 : -1.0;
  }
  const bool alongside = chance(random, 0.2) && norm(c.bound.velocity) > 0.0;
  if (alongside) {
    // The rest of the velocity across the plane is rounding error.
    c.bound.planned_acceleration = {};
    const Vec3 along = c.bound.velocity / norm(c.bound.velocity);
    const Vec3 across = c.wall.normal - along * dot(along, c.wall.normal);
    if (norm(across) > 0.01) c.wall.normal = across / norm(across);
  }
  const Vec3 now = c.bound.centre_at(c.from);
  const double later = c.from + (c.horizon - c.from) * random.uniform();
  const double margin = c.bound.radius_at(later) + (alongside ? 0.0 : norm(c.bound.centre_at(later) - now));
  const double part = chance(random, 0.2) ? log_uniform(random, -50, -1) : 1.0;
  const double gap = part * margin * random.uniform();
  if (inside) {
    c.wall.offset = dot(c.wall.normal, now) - c.bound.radius_at(c.from) - c.distance - gap;
  } else {
    c.wall.offset = dot(c.wall.normal, now) - c.bound.radius + c.bound.radius_at(c.from) - c.distance + gap;
  }
  return c;
}

double length_scale(const WallCase& c, double t) {
  return length_scale(c.bound, t) + std::abs(c.wall.offset) + std::abs(c.distance);
}

double meeting(const WallCase& c) { return earliest_meeting(c.bound, c.wall, c.from, c.horizon, c.distance); }

exact::Wide true_meeting(const WallCase& c, exact::Wide extra = 0) {
  return exact::earliest_meeting(c.bound, c.wall, c.from, c.horizon, c.distance, extra);
}

double separation(const WallCase& c) {
  return earliest_separation(c.bound, c.wall, c.from, c.horizon, c.distance);
}

exact::Wide true_separation(const WallCase& c, exact::Wide extra = 0) {
  return exact::earliest_separation(c.bound, c.wall, c.from, c.horizon, c.distance, extra);
}

class HalfSpaceCertificates : public testing::TestWithParam<Family> {};

TEST_P(HalfSpaceCertificates, meeting_is_never_late_and_tight) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 0);
    const WallCase c = draw(GetParam(), random, true);
    const double got = meeting(c);
    const double scale = length_scale(c, std::min(got, c.horizon));
    ASSERT_TRUE(never_late(got, true_meeting(c), c.from, c.horizon))
        << "seed " << seed << ", case " << k << "\n"
        << c;
    ASSERT_TRUE(hardly_early(got, true_meeting(c, Tightness{}.length * scale), c.from, c.horizon, 1e-12))
        << "seed " << seed << ", case " << k << "\n"
        << c;
  }
}

TEST_P(HalfSpaceCertificates, separation_is_never_late_and_tight) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 1);
    const WallCase c = draw(GetParam(), random, false);
    const double got = separation(c);
    const double scale = length_scale(c, std::min(got, c.horizon));
    ASSERT_TRUE(never_late(got, true_separation(c), c.from, c.horizon))
        << "seed " << seed << ", case " << k << "\n"
        << c;
    ASSERT_TRUE(hardly_early(got, true_separation(c, -Tightness{}.length * scale), c.from, c.horizon, 1e-12))
        << "seed " << seed << ", case " << k << "\n"
        << c;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, HalfSpaceCertificates, testing::ValuesIn(all_families), family_name);

const HalfSpace floor_at_zero{.normal = {0, 0, 1}};

TEST(HalfSpaceMeeting, of_a_falling_ball) {
  const Bound ball{.position = {0, 0, 6}, .planned_acceleration = {0, 0, -10}, .radius = 1};
  const double got = earliest_meeting(ball, floor_at_zero, 0, 10);
  EXPECT_LE(got, 1.0);
  EXPECT_NEAR(got, 1.0, 1e-12);
  EXPECT_EQ(earliest_meeting(ball, floor_at_zero, 0, 0.5), infinity);
}

TEST(HalfSpaceMeeting, is_infinite_for_a_ball_that_turns_in_time) {
  const Bound ball{
      .position = {0, 0, 2.01}, .velocity = {0, 0, -1}, .planned_acceleration = {0, 0, 0.5}, .radius = 1};
  EXPECT_EQ(earliest_meeting(ball, floor_at_zero, 0, 100), infinity);
  EXPECT_EQ(earliest_meeting(ball, floor_at_zero, 0, infinity), infinity);
  EXPECT_NE(earliest_meeting(ball, floor_at_zero, 0, 100, 0.02), infinity);
}

TEST(HalfSpaceMeeting, is_from_when_touching) {
  const Bound ball{.position = {0, 0, 1}, .velocity = {0, 0, 5}, .radius = 1};
  EXPECT_EQ(earliest_meeting(ball, floor_at_zero, 0, 10), 0.0);
  EXPECT_EQ(earliest_meeting(ball, floor_at_zero, 3, 10, 20.0), 3.0);
}

TEST(HalfSpaceSeparation, of_a_ball_that_jumps) {
  const Bound ball{.position = {0, 0, 1}, .velocity = {0, 0, 2}, .radius = 1};
  const double got = earliest_separation(ball, floor_at_zero, 0, 10, 1.0);
  EXPECT_LE(got, 0.5);
  EXPECT_NEAR(got, 0.5, 1e-12);
  EXPECT_EQ(earliest_separation(ball, floor_at_zero, 1, 10, 1.0), 1.0);
}

}  // namespace
}  // namespace kinesphere::half_space_test
