// Numbers that are not numbers, overflow or underflow: the certificates answer `from`, or are at least not
// late.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "support/bound_checks.hpp"

namespace kinesphere {
namespace {

constexpr std::uint64_t seed = 754;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Every certificate of one case, by name: what the library says and what is true.
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

/// Pointers to all numbers of a bound. They end with those that may not be negative.
std::vector<double*> numbers_of(Bound& bound) {
  std::vector<double*> numbers{&bound.time};
  for (Vec3* vector : {&bound.position, &bound.velocity, &bound.planned_acceleration})
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(&(*vector)[axis]);
  numbers.insert(numbers.end(), {&bound.radius, &bound.growth_speed, &bound.growth_acceleration});
  return numbers;
}
constexpr std::size_t signed_numbers = 10;

/// A case in which the certificate is a finite time after `from`.
PairCase ordinary_case(const Certificate& certificate) {
  PairCase c{.a = {.time = 0.5,
                   .velocity = {1, 0.5, 0.5},
                   .planned_acceleration = {0, 0, -0.1},
                   .radius = 1,
                   .growth_speed = 0.25,
                   .growth_acceleration = 0.5},
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
        bound->growth_acceleration *= length / time / time;
      }
      c.distance = length * 20.0 * random.uniform();
      c.horizon = 10.0 * time;
      ASSERT_TRUE(never_late(certificate.answer(c), certificate.truth(c), c.from, c.horizon))
          << certificate.name << ", seed " << seed << ", case " << k << "\n"
          << c;
    }
}

TEST(ExtremeNumbers, squares_that_underflow_make_nothing_late) {
  // Points at distances whose squares have few bits, with bounds that grow almost as fast as they part.
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

}  // namespace
}  // namespace kinesphere
