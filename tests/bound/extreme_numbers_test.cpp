// NaNs, infinities, overflow and underflow: the certificates return `from`, or are at least not late.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "support/bound_checks.hpp"

namespace kinesphere::extreme_numbers_test {
namespace {

constexpr std::uint64_t seed = 754;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Every certificate of one case, by name: the library's value and the true one.
struct Certificate {
  const char* name;
  std::function<double(const PairCase&)> answer;
  std::function<exact::Wide(const PairCase&)> truth;
};

const HalfSpace wall{.normal = {0.6, 0.0, -0.8}, .offset = -20.0};
const Box box{{-30, -40, -50}, {60, 50, 40}};

const std::vector<Certificate> certificates{
    {"meeting", [](const PairCase& c) { return earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance); },
     [](const PairCase& c) { return exact::earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance); }},
    {"separation",
     [](const PairCase& c) { return earliest_separation(c.a, c.b, c.from, c.horizon, c.distance); },
     [](const PairCase& c) { return exact::earliest_separation(c.a, c.b, c.from, c.horizon, c.distance); }},
    {"wall meeting",
     [](const PairCase& c) { return earliest_meeting(c.a, wall, c.from, c.horizon, c.distance); },
     [](const PairCase& c) { return exact::earliest_meeting(c.a, wall, c.from, c.horizon, c.distance); }},
    {"wall separation",
     [](const PairCase& c) { return earliest_separation(c.a, wall, c.from, c.horizon, c.distance); },
     [](const PairCase& c) { return exact::earliest_separation(c.a, wall, c.from, c.horizon, c.distance); }},
    {"exit", [](const PairCase& c) { return earliest_exit(c.a, box, c.from, c.horizon); },
     [](const PairCase& c) { return exact::earliest_exit(c.a, box, c.from, c.horizon); }},
};

/// Returns pointers to all numbers of a bound, the ones that may not be negative last.
std::vector<double*> numbers_of(Bound& bound) {
  std::vector<double*> numbers{&bound.time};
  for (Vec3* vector : {&bound.position, &bound.velocity, &bound.planned_acceleration})
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(&(*vector)[axis]);
  numbers.insert(numbers.end(), {&bound.radius, &bound.growth_speed, &bound.acceleration_limit});
  return numbers;
}
constexpr std::size_t signed_numbers = 10;

/// Returns a case in which the certificate is a finite time after `from`.
PairCase ordinary_case(const Certificate& certificate) {
  PairCase c{.a = {.time = 0.5,
                   .velocity = {1, 0.5, 0.5},
                   .planned_acceleration = {0, 0, -0.1},
                   .radius = 1,
                   .growth_speed = 0.25,
                   .acceleration_limit = 0.5},
             .b = {.time = 0.75, .position = {20, 0, 0}, .velocity = {-1, 0, 1}, .radius = 1},
             .from = 1.0,
             .horizon = 1000.0,
             .distance = 0.5};
  if (std::string(certificate.name).ends_with("separation")) c.distance = 40.0;
  return c;
}

TEST(ExtremeNumbers, nan_and_infinity_in_any_place_give_from) {
  for (const Certificate& certificate : certificates)
    for (const double wrong : {nan, infinity, -infinity})
      for (std::size_t place = 0; place < 13; ++place) {
        if (wrong < 0 && place >= signed_numbers) continue;
        PairCase c = ordinary_case(certificate);
        *numbers_of(c.a)[place] = wrong;
        EXPECT_EQ(certificate.answer(c), c.from) << certificate.name << " of " << c;
        if (certificate.name != std::string("meeting") && certificate.name != std::string("separation"))
          continue;
        std::swap(c.a, c.b);
        EXPECT_EQ(certificate.answer(c), c.from) << certificate.name << " of " << c;
      }
}

TEST(ExtremeNumbers, nan_as_distance_gives_from) {
  for (const Certificate& certificate : certificates) {
    if (certificate.name == std::string("exit")) continue;
    PairCase c = ordinary_case(certificate);
    c.distance = nan;
    EXPECT_EQ(certificate.answer(c), c.from) << certificate.name;
  }
}

TEST(ExtremeNumbers, no_horizon_and_nan_as_horizon_are_not_late) {
  for (const Certificate& certificate : certificates)
    for (const double horizon : {infinity, nan}) {
      PairCase c = ordinary_case(certificate);
      const exact::Wide truth = certificate.truth(c);
      ASSERT_TRUE(truth > 1.0 && truth < 1000.0) << certificate.name;
      c.horizon = horizon;
      EXPECT_TRUE(exact::Wide(certificate.answer(c)) <= truth) << certificate.name;
    }
}

TEST(ExtremeNumbers, one_huge_or_tiny_number_makes_nothing_late) {
  for (const Certificate& certificate : certificates)
    for (std::uint64_t k = 0; k < 6000; ++k) {
      Random random = Random::at(seed, k, 0);
      PairCase c = families::everyday(random);
      c.distance = 20.0 * random.uniform();
      const std::size_t place = 1 + random.bits() % 12;
      double& number = *numbers_of(chance(random, 0.5) ? c.a : c.b)[place];
      number = std::ldexp(number, 4 * (static_cast<int>(random.bits() % 500) - 250));
      ASSERT_TRUE(never_late(certificate.answer(c), certificate.truth(c), c.from, c.horizon))
          << certificate.name << ", seed " << seed << ", case " << k << "\n"
          << c;
    }
}

TEST(ExtremeNumbers, overflow_on_the_way_makes_nothing_late) {
  for (const Certificate& certificate : certificates)
    for (std::uint64_t k = 0; k < 6000; ++k) {
      Random random = Random::at(seed, k, 1);
      PairCase c = families::everyday(random);
      c.a.time = c.b.time = c.from = 0.0;
      const double time = log_uniform(random, -250, 0);
      const double length = log_uniform(random, 100, 500);
      for (Bound* bound : {&c.a, &c.b}) {
        bound->position *= length;
        bound->radius *= length;
        bound->velocity *= length / time;
        bound->growth_speed *= length / time;
        bound->planned_acceleration *= length / time / time;
        bound->acceleration_limit *= length / time / time;
      }
      c.distance = length * 20.0 * random.uniform();
      c.horizon = 10.0 * time;
      ASSERT_TRUE(never_late(certificate.answer(c), certificate.truth(c), c.from, c.horizon))
          << certificate.name << ", seed " << seed << ", case " << k << "\n"
          << c;
    }
}

TEST(ExtremeNumbers, squares_that_underflow_make_nothing_late) {
  // Points at distances with squares of few bits, and bounds that grow almost as fast as they separate.
  for (std::uint64_t k = 0; k < 6000; ++k) {
    Random random = Random::at(seed, k, 2);
    const Vec3 direction = random.unit_vector();
    const double length = log_uniform(random, -560, -400);
    const double faster = 1.0 - log_uniform(random, -40, -2);
    const PairCase c{.a = {.position = direction * length,
                           .velocity = direction * length,
                           .growth_speed = faster * length},
                     .b = {},
                     .horizon = 1e20};
    for (const Certificate& certificate : certificates)
      ASSERT_TRUE(never_late(certificate.answer(c), certificate.truth(c), c.from, c.horizon))
          << certificate.name << ", seed " << seed << ", case " << k << "\n"
          << c;
  }
}

TEST(ExtremeNumbers, gaps_of_a_few_least_numbers_make_nothing_late) {
  // All lengths are zero but the distance, three times the smallest double, and the growth of both bounds
  // until `from`, each 1.49 times the smallest double and rounded down to it.
  Bound bound;
  bound.growth_speed = 0x1p-480;
  const double from = 0x1.7dp-594;
  EXPECT_LE(earliest_meeting(bound, bound, from, 1.0, -3 * 0x1p-1074), 1.5 * 0x1p-594);
}

/// Returns a power of two that is in range or out of range, or a NaN.
double any_scale(Random& random, int least, int most) {
  const int count = most - least + 1;
  return std::ldexp(1.0, least + static_cast<int>(random.bits() % static_cast<std::uint64_t>(count)));
}

bool is_finite(PairCase& c) {
  bool finite = std::isfinite(c.from) && std::isfinite(c.horizon) && std::isfinite(c.distance);
  for (Bound* bound : {&c.a, &c.b})
    for (const double* number : numbers_of(*bound)) finite = finite && std::isfinite(*number);
  return finite;
}

/// Returns a case with lengths, times, or single kinds of numbers as small and as large as doubles are, alone
/// or together. All are finite, as the exact twin needs them.
PairCase of_any_size(Random& random) {
  PairCase c = families::everyday(random);
  const double length = any_scale(random, -1060, 600);
  const double time = any_scale(random, -300, 300);
  const double speed = chance(random, 0.7) ? length / time : any_scale(random, -1060, 600);
  const double acceleration = chance(random, 0.7) ? speed / time : any_scale(random, -1060, 600);
  for (Bound* bound : {&c.a, &c.b}) {
    bound->time *= time;
    bound->position *= length;
    bound->radius *= length;
    bound->velocity *= speed;
    bound->growth_speed *= speed;
    bound->planned_acceleration *= acceleration;
    bound->acceleration_limit *= acceleration;
  }
  c.from *= time;
  c.horizon *= time;
  c.distance = length * 20.0 * random.uniform();
  return is_finite(c) ? c : of_any_size(random);
}

TEST(ExtremeNumbers, numbers_of_any_size_make_nothing_late) {
  for (const Certificate& certificate : certificates)
    for (std::uint64_t k = 0; k < 6000; ++k) {
      Random random = Random::at(seed, k, 3);
      const PairCase c = of_any_size(random);
      ASSERT_TRUE(never_late(certificate.answer(c), certificate.truth(c), c.from, c.horizon))
          << certificate.name << ", seed " << seed << ", case " << k << "\n"
          << c;
    }
}

testing::AssertionResult encloses(const GapLimits& limits, const exact::Gaps& truth) {
  if (exact::Wide(limits.lower) <= truth.lower && truth.upper <= exact::Wide(limits.upper))
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << "from " << limits.lower << " to " << limits.upper << ", not "
                                     << static_cast<double>(truth.lower) << " to "
                                     << static_cast<double>(truth.upper);
}

TEST(ExtremeNumbers, gaps_of_any_size_are_enclosed) {
  for (std::uint64_t k = 0; k < 20000; ++k) {
    Random random = Random::at(seed, k, 4);
    const PairCase c = of_any_size(random);
    ASSERT_TRUE(encloses(gap_limits(c.a, c.b, c.horizon), exact::gap_limits(c.a, c.b, c.horizon)))
        << "seed " << seed << ", case " << k << "\n"
        << c;
    ASSERT_TRUE(encloses(gap_limits(c.a, wall, c.horizon), exact::gap_limits(c.a, wall, c.horizon)))
        << "wall, seed " << seed << ", case " << k << "\n"
        << c;
  }
}

TEST(ExtremeNumbers, boxes_of_any_size_hold_what_they_should) {
  for (std::uint64_t k = 0; k < 20000; ++k) {
    Random random = Random::at(seed, k, 5);
    const PairCase c = of_any_size(random);
    const Box swept = swept_box(c.a, c.from, c.horizon);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_TRUE(exact::Wide(swept.upper[axis]) >= exact::farthest(c.a, axis, 1, c.from, c.horizon))
          << "seed " << seed << ", case " << k << "\n"
          << c;
      ASSERT_TRUE(exact::Wide(swept.lower[axis]) <= exact::farthest(c.a, axis, -1, c.from, c.horizon))
          << "seed " << seed << ", case " << k << "\n"
          << c;
    }
  }
}

TEST(ExtremeNumbers, gaps_that_overflow_are_not_known) {
  const Bound far{.position = {1e155, 0, 0}, .radius = 1};
  const GapLimits gap = gap_limits({.position = {-1e155, 0, 0}, .radius = 1}, far, 0.0);
  EXPECT_EQ(gap.lower, -infinity);
  EXPECT_EQ(gap.upper, infinity);
  // Two overlapping bounds, one with a radius that overflows when squared.
  const Bound huge{.position = {1e160, 0, 0}, .radius = 2e160};
  EXPECT_EQ(earliest_meeting({}, huge, 3.0, 4.0), 3.0);
}

}  // namespace
}  // namespace kinesphere::extreme_numbers_test
