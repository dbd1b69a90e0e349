// A swept sphere contains the ball of its bound until its end, at all scales, and is hardly larger.
#include "broadphase/swept_sphere.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "broadphase/window.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"
#include "support/bound_cases.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::swept_sphere_test {
namespace {

constexpr std::uint64_t seed = 4001;

/// A bound reported now, a window that may have begun long before, and a frame for it.
struct Case {
  Bound bound;
  double now;
  double duration;
  double room;
  SweptSphereFrame frame;
};

/// The sizes in a case, as powers of two of the unit of length of the frame.
struct Kind {
  const char* name;
  int offset;  ///< from the base of the frame
  int speed;   ///< in units of the frame
  int radius;
  int origin;  ///< distance of the base and the clock from zero, in units
};

const std::array kinds{
    Kind{"everyday", 4, 0, -1, 4},
    Kind{"far_from_the_base", 40, 0, -1, 4},
    Kind{"fast", 4, 30, -1, 4},
    Kind{"hardly_moving", 4, -40, -1, 4},
    Kind{"tiny", -20, -20, -30, 4},
    Kind{"points", 4, 0, -200, 4},
    Kind{"a_base_far_from_zero", 4, 0, -1, 30},
    Kind{"far_and_fast", 50, 50, 20, 50},
};

Case draw(Random& random, const Kind& kind) {
  Case c;
  const int length_exponent = static_cast<int>(random.bits() % 121) - 60;
  const int rung = static_cast<int>(random.bits() % 81) - 40;
  const double length = std::ldexp(1.0, length_exponent);
  const double time = std::ldexp(1.0, rung);
  const auto part = [&] { return log_uniform(random, -4, 0) * 0.5; };
  c.now = (random.uniform() - 0.5) * std::ldexp(time, kind.origin);
  const Window window = Window::at(c.now, rung);
  c.frame = {.base = std::ldexp(length, kind.origin) * random.point_in_ball(),
             .origin = window.end - std::ldexp(1.0, window.rung),
             .per_length = 1.0 / length,
             .per_time = std::ldexp(1.0, -window.rung)};
  // Each draw in a statement of its own, so that all compilers draw equal cases.
  const auto vector = [&](double largest) {
    const double size = part() * largest;
    return size * random.point_in_ball();
  };
  c.bound.time = c.now;
  c.bound.position = c.frame.base + vector(std::ldexp(length, kind.offset));
  c.bound.velocity = vector(std::ldexp(length / time, kind.speed));
  c.bound.radius = part() * std::ldexp(length, kind.radius);
  if (chance(random, 0.5)) {
    c.bound.planned_acceleration = vector(std::ldexp(length / time / time, kind.speed));
    c.bound.growth_speed = part() * std::ldexp(length / time, kind.speed);
    c.bound.acceleration_limit = part() * std::ldexp(length / time / time, kind.speed);
  }
  const double end = chance(random, 0.5) ? window.end : c.now + part() * (window.end - c.now);
  c.duration = end - c.now;
  c.room = chance(random, 0.5) ? 0.0 : part() * std::ldexp(length, kind.radius);
  return c;
}

TEST(SweptSphere, ContainsTheBallAllTheTime) {
  // If even the squares of such lengths underflow, a search takes everything for near.
  constexpr Extended negligible = 0x1p-120L;
  for (const Kind& kind : kinds) {
    for (std::uint64_t k = 0; k < 2000; ++k) {
      Random random = Random::at(seed, k, 0);
      const Case c = draw(random, kind);
      const SweptSphere sphere = swept_sphere_of(BoundAt(c.bound, c.now), c.now, c.duration, c.room, c.frame);
      for (int sample = 0; sample <= 8; ++sample) {
        const Extended t = Extended{c.now} + Extended{c.duration} * sample / 8;
        const Extended s = (t - Extended{c.frame.origin}) * Extended{c.frame.per_time};
        const TrueBall ball = true_ball(c.bound, t);
        Extended square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Extended here = (ball.centre[axis] - Extended{c.frame.base[static_cast<int>(axis)]}) *
                                Extended{c.frame.per_length};
          const Extended there = Extended{sphere.centre[axis]} + Extended{sphere.velocity[axis]} * s;
          square += (here - there) * (here - there);
        }
        const Extended radius = (ball.radius + Extended{c.room}) * Extended{c.frame.per_length};
        ASSERT_LE(std::sqrt(square) + radius, Extended{sphere.radius} + negligible)
            << "seed " << seed << ", case " << k << ", " << kind.name << ", sample " << sample << ", "
            << c.bound;
      }
    }
  }
}

TEST(SweptSphere, IsHardlyLargerThanItsBall) {
  for (const Kind& kind : kinds) {
    for (std::uint64_t k = 0; k < 500; ++k) {
      Random random = Random::at(seed, k, 0);
      const Case c = draw(random, kind);
      const BoundAt moved(c.bound, c.now);
      const SweptSphere sphere = swept_sphere_of(moved, c.now, c.duration, c.room, c.frame);
      const double window = 1.0 / c.frame.per_time;
      const double needed = moved.radius_after(c.duration) + c.room;
      const double size =
          norm_one(c.bound.position - c.frame.base) + needed + 3.0 * norm_one(c.bound.velocity) * window;
      ASSERT_LE(static_cast<double>(sphere.radius), (needed + 0x1p-17 * size) * c.frame.per_length)
          << "seed " << seed << ", case " << k << ", " << kind.name;
    }
  }
}

TEST(SweptSphere, IsEverywhereWhereASearchCouldNotComputeWithItsNumbers) {
  const auto of = [](double distance, double speed, double radius) {
    const Bound bound{.position = {1, 2, -distance}, .velocity = {0, -speed, 0}, .radius = radius};
    return swept_sphere_of(BoundAt(bound, 0.0), 0.0, speed > 1.0 ? 1.0 / speed : 1.0, 0.0, {});
  };
  const SweptSphere everywhere{{}, {}, std::numeric_limits<float>::infinity()};
  for (const double number : {0.0, 1.0, 0x1p40, 0x1p59}) {
    EXPECT_NE(of(number, 0.0, 0.1), everywhere) << number;
    EXPECT_NE(of(0.0, number, 0.1), everywhere) << number;
    EXPECT_NE(of(0.0, 0.0, number), everywhere) << number;
  }
  for (const double number : {0x1p61, 0x1p64, 0x1p70, 0x1p120, 1e300, infinity})
    EXPECT_EQ(of(0.0, number, 0.1), everywhere) << number;
  for (const double number : {0x1p127, 1e300, infinity}) {
    EXPECT_EQ(of(number, 0.0, 0.1), everywhere) << number;
    EXPECT_EQ(of(0.0, 0.0, number), everywhere) << number;
  }
}

}  // namespace
}  // namespace kinesphere::swept_sphere_test
