// Verdicts about two tracks hold for all motions that their reports allow, for as long as they say.
#include "monitor/separation_forecast.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"

namespace kinesphere::separation_forecast_test {
namespace {

constexpr std::uint64_t seed = 5222;
constexpr double tolerance = 0.01;
constexpr double limit = 0.2;

struct Case {
  TrackEstimate estimate;
  State reported;

  explicit Case(const State& state) : reported(state) {
    estimate.update({.state = state, .position_error = 0.004, .velocity_error = 0.01},
                    {.acceleration_limit = limit}, 0.0, 1.0);
  }
  /// Returns a place at which the track may be.
  Vec3 any_place(double time, Random& random) const {
    const Vec3 acceleration = limit * random.unit_vector();
    return reported.position + 0.004 * random.unit_vector() +
           (reported.velocity + 0.01 * random.unit_vector() + acceleration * (0.5 * time)) * time;
  }
};

/// Returns how far the offset is outside of a separation; negative within.
double outside(const Vec3& offset, const Components& separation) {
  double most = -infinity;
  for (const Component& component : separation)
    most = std::max(most, norm(component.part(offset)) - component.limit);
  return most;
}

TEST(SeparationForecast, HoldsForAllMotions) {
  SCOPED_TRACE(seed);
  int verdicts[3] = {};
  for (std::uint64_t k = 0; k < 600; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    const Separation separation =
        k % 2 == 0 ? Separation::sphere(2.0) : Separation::cylinder(2.0, random.uniform(0.5, 2.0));
    const Components components(separation, 3, tolerance);
    const Case one({3.0 * random.point_in_ball(), random.point_in_ball()});
    const Case other({3.0 * random.point_in_ball(), random.point_in_ball()});
    const auto [verdict, until] = forecast_of(one.estimate, other.estimate, components, 0.0, 4.0, 1e-3);
    ++verdicts[static_cast<int>(verdict)];
    if (verdict == Verdict::undecided) continue;
    EXPECT_GE(until, 1e-3);
    for (int look = 0; look < 60; ++look) {
      const double time = std::min(until, 4.0) * random.uniform();
      const double gap = outside(one.any_place(time, random) - other.any_place(time, random), components);
      if (verdict == Verdict::apart) {
        EXPECT_GT(gap, -1e-9) << time;
      } else {
        EXPECT_LE(gap, tolerance + 1e-9) << time;
      }
    }
  }
  EXPECT_GT(verdicts[static_cast<int>(Verdict::apart)], 100);
  EXPECT_GT(verdicts[static_cast<int>(Verdict::within)], 50);
}

TEST(SeparationForecast, DistancesAreBetweenTheirLimits) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 300; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 1, k);
    const Components components(Separation::cylinder(2.0, 1.0), 3, tolerance);
    const Case one({3.0 * random.point_in_ball(), random.point_in_ball()});
    const Case other({3.0 * random.point_in_ball(), random.point_in_ball()});
    const double time = 2.0 * random.uniform();
    for (const Component& component : components) {
      const auto [lower, upper] = distance_between(one.estimate, other.estimate, component, time);
      for (int look = 0; look < 20; ++look) {
        const double distance =
            norm(component.part(one.any_place(time, random) - other.any_place(time, random)));
        EXPECT_GE(distance, lower - 1e-9);
        EXPECT_LE(distance, upper + 1e-9);
      }
    }
  }
}

TEST(SeparationForecast, SaysWhenTwoCertainlyComeTogether) {
  SCOPED_TRACE(seed);
  int certain = 0;
  for (std::uint64_t k = 0; k < 100; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 2, k);
    const Components components(Separation::sphere(3.0), 3, tolerance);
    const Vec3 direction = random.unit_vector();
    const Case one({{}, direction * 2.0});
    const Case other({direction * random.uniform(4.0, 6.0), direction * -2.0});
    const double by = certain_within_by(one.estimate, other.estimate, components, 0.0, 1e-3);
    if (by == infinity) continue;
    ++certain;
    EXPECT_LE(outside(one.any_place(by, random) - other.any_place(by, random), components), tolerance);
  }
  EXPECT_GT(certain, 80) << "head-on";
}

}  // namespace
}  // namespace kinesphere::separation_forecast_test
