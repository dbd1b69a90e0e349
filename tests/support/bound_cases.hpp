// Test cases for certificates: pairs of bounds, drawn at random from families that are difficult in different
// ways.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <ostream>
#include <utility>
#include <vector>

#include "kinesphere/bound.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere {

struct PairCase {
  Bound a, b;
  double from = 0.0;
  double horizon = 0.0;
  double distance = 0.0;
};

inline std::ostream& operator<<(std::ostream& out, const Vec3& v) {
  return out << "{" << v.x << ", " << v.y << ", " << v.z << "}";
}

/// Prints the bound as C++, for a failure to be pasted into a test.
inline std::ostream& operator<<(std::ostream& out, const Bound& bound) {
  return out << std::hexfloat << "Bound{.time = " << bound.time << ", .position = " << bound.position
             << ", .velocity = " << bound.velocity
             << ", .planned_acceleration = " << bound.planned_acceleration << ", .radius = " << bound.radius
             << ", .growth_speed = " << bound.growth_speed
             << ", .acceleration_limit = " << bound.acceleration_limit << "}" << std::defaultfloat;
}

inline std::ostream& operator<<(std::ostream& out, const PairCase& c) {
  return out << "a = " << c.a << "\nb = " << c.b << std::hexfloat << "\nfrom " << c.from << ", horizon "
             << c.horizon << ", distance " << c.distance << std::defaultfloat;
}

/// Returns the largest length in the computation up to time t; rounding errors are relative to it.
inline double length_scale(const Bound& bound, double t) {
  const double s = t - bound.time;
  const double speed = norm_one(bound.velocity) + bound.growth_speed;
  const double acceleration = norm_one(bound.planned_acceleration) + bound.acceleration_limit;
  return norm_one(bound.position) + bound.radius + (speed + acceleration * s) * s;
}

inline double length_scale(const PairCase& c, double t) {
  return length_scale(c.a, t) + length_scale(c.b, t) + std::abs(c.distance);
}

/// A power of two in [2^lower, 2^upper] times a number in [1, 2).
inline double log_uniform(Random& random, int lower, int upper) {
  const auto count = static_cast<std::uint64_t>(upper - lower + 1);
  const int exponent = lower + static_cast<int>(random.bits() % count);
  return std::ldexp(1.0 + random.uniform(), exponent);
}

inline bool chance(Random& random, double probability) { return random.uniform() < probability; }

/// The largest values of a random bound.
struct Scales {
  double length = 10.0;
  double speed = 5.0;
  double plan = 2.0;
  double radius = 1.0;
  double growth_speed = 0.1;
  double acceleration_limit = 3.0;
  double age = 0.5;
  double span = 10.0;
};

inline Bound random_bound(Random& random, const Scales& scales, double from) {
  return {.time = from - scales.age * random.uniform(),
          .position = scales.length * random.point_in_ball(),
          .velocity = scales.speed * random.point_in_ball(),
          .planned_acceleration = scales.plan * random.point_in_ball(),
          .radius = scales.radius * random.uniform(),
          .growth_speed = scales.growth_speed * random.uniform(),
          .acceleration_limit = scales.acceleration_limit * random.uniform()};
}

inline PairCase random_pair(Random& random, const Scales& scales, double from = 0.0) {
  PairCase c{.a = random_bound(random, scales, from), .b = random_bound(random, scales, from), .from = from};
  c.horizon = from + scales.span * random.uniform();
  if (chance(random, 0.3)) c.distance = scales.radius * random.uniform(-2.0, 2.0);
  return c;
}

/// Moves b so that the gap between the bounds is `gap` at `from`, as nearly as doubles allow.
inline void set_gap(PairCase& c, const Vec3& direction, double gap) {
  const double reach = c.a.radius_at(c.from) + c.b.radius_at(c.from);
  c.b.position += c.a.centre_at(c.from) + direction * (reach + gap) - c.b.centre_at(c.from);
}

/// Returns the least gap between the bounds up to the horizon, by sampling and refinement.
inline double least_gap(const PairCase& c) {
  const auto gap = [&c](double t) {
    return norm(c.a.centre_at(t) - c.b.centre_at(t)) - c.a.radius_at(t) - c.b.radius_at(t);
  };
  constexpr int samples = 64;
  const double step = (c.horizon - c.from) / samples;
  double best = c.from;
  for (int k = 1; k <= samples; ++k)
    if (gap(c.from + k * step) < gap(best)) best = c.from + k * step;
  double low = std::max(c.from, best - step);
  double high = std::min(c.horizon, best + step);
  for (int k = 0; k < 100; ++k) {
    const double third = (high - low) / 3.0;
    (gap(low + third) < gap(high - third) ? high : low) +=
        gap(low + third) < gap(high - third) ? -third : third;
  }
  return gap(low);
}

/// Every draw is a statement of its own, or in braces, so that all compilers draw equal cases.
namespace families {

inline PairCase everyday(Random& random) { return random_pair(random, {}, random.uniform(-10.0, 10.0)); }

inline PairCase ballistic(Random& random) {
  PairCase c = random_pair(random, {.plan = 0.0, .growth_speed = 0.0, .acceleration_limit = 0.0});
  c.a.planned_acceleration = c.b.planned_acceleration = {0.0, 0.0, -9.81};
  return c;
}

inline PairCase resting(Random& random) { return random_pair(random, {.speed = 0.0, .plan = 0.0}); }

inline PairCase speed_limit_only(Random& random) {
  return random_pair(random, {.speed = 0.0, .plan = 0.0, .growth_speed = 3.0, .acceleration_limit = 0.0});
}

inline PairCase points(Random& random) { return random_pair(random, {.radius = 0.0}); }

inline PairCase far_away(Random& random) {
  PairCase c = random_pair(random, {.length = 0.01, .speed = 0.01, .radius = 1e-3, .growth_speed = 0.0});
  const Vec3 place = 1e7 * random.point_in_ball();
  c.a.position += place;
  c.b.position += place;
  return c;
}

inline PairCase thin_gap(Random& random) {
  PairCase c = random_pair(random, {});
  c.distance = 0.0;
  const Vec3 direction = random.unit_vector();
  set_gap(c, direction, log_uniform(random, -40, 20));
  return c;
}

inline PairCase nearly_equal_velocities(Random& random) {
  PairCase c = random_pair(random, {.growth_speed = 0.0, .acceleration_limit = 1e-6});
  const Vec3 direction = random.unit_vector();
  c.b.velocity = c.a.velocity + direction * log_uniform(random, -50, -10);
  if (chance(random, 0.5)) c.b.planned_acceleration = c.a.planned_acceleration;
  if (chance(random, 0.5)) c.a.acceleration_limit = c.b.acceleration_limit = 0.0;
  c.horizon = c.from + log_uniform(random, 0, 30);
  return c;
}

/// Two fast bounds, with a gap and a closing speed not far above their rounding errors.
inline PairCase hardly_closing(Random& random) {
  PairCase c = random_pair(random, {.length = 1.0, .growth_speed = 0.0, .acceleration_limit = 0.0});
  const Vec3 direction = random.unit_vector();
  const Vec3 acceleration = c.a.planned_acceleration;
  c.a.velocity = c.b.velocity = 1e6 * random.unit_vector();
  c.b.planned_acceleration = acceleration;
  set_gap(c, direction, log_uniform(random, -24, -16));
  const Vec3 closing = direction * log_uniform(random, -40, -26);
  c.b.velocity += c.a.velocity_at(c.from) - c.b.velocity_at(c.from) - closing;
  c.distance = 0.0;
  c.horizon = c.from + 1e9;
  return c;
}

inline PairCase tiny_times(Random& random) {
  return random_pair(random,
                     {.speed = 1e10, .plan = 1e19, .acceleration_limit = 1e19, .age = 1e-9, .span = 1e-9});
}

inline PairCase late_clock(Random& random) { return random_pair(random, {}, 1e9 * random.uniform()); }

inline PairCase huge_times(Random& random) {
  const Scales slow{.speed = 1e-8,
                    .plan = 1e-17,
                    .growth_speed = 1e-9,
                    .acceleration_limit = 1e-17,
                    .age = 1e9,
                    .span = 1e9};
  return random_pair(random, slow, 1e9 * random.uniform());
}

inline PairCase head_on(Random& random) {
  PairCase c = random_pair(random, {.plan = 0.0});
  const Vec3 direction = random.unit_vector();
  set_gap(c, direction, log_uniform(random, -20, 5));
  c.a.velocity = direction * random.uniform(-5.0, 5.0);
  c.b.velocity = direction * random.uniform(-5.0, 5.0);
  return c;
}

inline PairCase on_an_axis(Random& random) {
  PairCase c = random_pair(random, {});
  for (Bound* bound : {&c.a, &c.b})
    for (int axis = 1; axis < 3; ++axis)
      bound->position[axis] = bound->velocity[axis] = bound->planned_acceleration[axis] = 0.0;
  return c;
}

inline PairCase stale_reports(Random& random) {
  PairCase c = random_pair(random, {.age = 100.0}, 50.0);
  if (chance(random, 0.5)) c.a.time = c.from;
  const Vec3 direction = random.unit_vector();
  if (chance(random, 0.5)) set_gap(c, direction, random.uniform(0.0, 10.0));
  return c;
}

inline PairCase same_place(Random& random) {
  PairCase c = random_pair(random, {.age = chance(random, 0.5) ? 0.0 : 1.0});
  c.b.position = c.a.position;
  c.distance = -random.uniform(0.0, 4.0);
  return c;
}

/// Small whole numbers, so that sums are exact and coincidences frequent.
inline PairCase whole_numbers(Random& random) {
  const auto whole = [&random](int lower, int upper) {
    return static_cast<double>(
        lower + static_cast<int>(random.bits() % static_cast<std::uint64_t>(upper - lower + 1)));
  };
  const auto vector = [&whole](int limit) {
    return Vec3{whole(-limit, limit), whole(-limit, limit), whole(-limit, limit)};
  };
  PairCase c;
  for (Bound* bound : {&c.a, &c.b})
    *bound = {whole(-1, 0), vector(4), vector(2), vector(1), whole(0, 2), whole(0, 1), whole(0, 1)};
  c.horizon = whole(0, 8);
  c.distance = whole(-1, 1);
  return c;
}

/// Each number has any magnitude, or is zero.
inline PairCase any_scale(Random& random) {
  const auto scale = [&random] { return chance(random, 0.2) ? 0.0 : log_uniform(random, -40, 40); };
  const Scales scales{scale(), scale(), scale(), scale(), scale(), scale(), scale(), scale()};
  PairCase c = random_pair(random, scales, scale());
  if (chance(random, 0.5))
    c.b = random_bound(random, {scale(), scale(), scale(), scale(), scale(), scale(), scale(), 0.0}, c.from);
  return c;
}

/// Just meets or just misses, by one part in 2^36 to 2^53 of the distance.
inline PairCase grazing(Random& random) {
  PairCase c = chance(random, 0.5) ? ballistic(random) : everyday(random);
  if (chance(random, 0.5)) c.a.acceleration_limit = c.b.acceleration_limit = 0.0;
  c.distance = 0.0;
  const double nearest = least_gap(c);
  const double miss = nearest * log_uniform(random, -53, -36);
  c.distance = nearest + miss * random.uniform(-1.0, 1.0);
  return c;
}

}  // namespace families

struct Family {
  const char* name;
  PairCase (*draw)(Random&);

  friend std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }
};

inline const std::vector<Family> all_families{
    {"everyday", families::everyday},
    {"ballistic", families::ballistic},
    {"resting", families::resting},
    {"speed_limit_only", families::speed_limit_only},
    {"points", families::points},
    {"far_away", families::far_away},
    {"thin_gap", families::thin_gap},
    {"nearly_equal_velocities", families::nearly_equal_velocities},
    {"hardly_closing", families::hardly_closing},
    {"tiny_times", families::tiny_times},
    {"late_clock", families::late_clock},
    {"huge_times", families::huge_times},
    {"head_on", families::head_on},
    {"on_an_axis", families::on_an_axis},
    {"stale_reports", families::stale_reports},
    {"same_place", families::same_place},
    {"whole_numbers", families::whole_numbers},
    {"any_scale", families::any_scale},
    {"grazing", families::grazing},
};

inline std::string family_name(const testing::TestParamInfo<Family>& info) { return info.param.name; }

}  // namespace kinesphere
