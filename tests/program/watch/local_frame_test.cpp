// The map's errors are within its bounds: geodesics of the ellipsoid are the truth.
#include "geography/local_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinesphere/random.hpp"

#ifdef KINESPHERE_WITH_GEOGRAPHICLIB
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>

namespace kinesphere::program::local_frame_test {
namespace {

using GeographicLib::Geodesic;

constexpr double degree = 3.14159265358979323846 / 180.0;

/// A place and the direction of a way there.
struct Going {
  double latitude = 0, longitude = 0, azimuth = 0;
  Vec3 place(double height = 0) const { return {longitude, latitude, height}; }
  Vec3 velocity(double speed) const {
    return {speed * std::sin(azimuth * degree), speed * std::cos(azimuth * degree), 0.0};
  }
};

Going gone(const Going& from, double distance) {
  Going to;
  Geodesic::WGS84().Direct(from.latitude, from.longitude, from.azimuth, distance, to.latitude, to.longitude,
                           to.azimuth);
  return to;
}

double distance_between(const Going& a, const Going& b) {
  double distance = 0;
  Geodesic::WGS84().Inverse(a.latitude, a.longitude, b.latitude, b.longitude, distance);
  return distance;
}

struct Map {
  Going origin;
  double radius;
};

class LocalFrameOf : public testing::TestWithParam<Map> {
 protected:
  LocalFrame frame() const {
    return {GetParam().origin.latitude, GetParam().origin.longitude, GetParam().radius, 0.0};
  }
  /// Often near the rim, with the largest errors of the map.
  Going somewhere(Random& random, double part = 1.0) const {
    Going way = GetParam().origin;
    way.azimuth = random.uniform(-180.0, 180.0);
    Going there = gone(way, part * GetParam().radius * std::sqrt(random.uniform(0.0, 1.0)));
    there.azimuth = random.uniform(-180.0, 180.0);
    return there;
  }
  static State on(const LocalFrame& frame, const Going& there, double speed) {
    const auto placed = frame.place(there.place(), true, there.velocity(speed));
    EXPECT_TRUE(placed);
    return placed ? placed->state : State{};
  }
};

TEST_P(LocalFrameOf, MakesDistancesNeverShorterAndAtMostSoMuchLonger) {
  const LocalFrame frame = this->frame();
  Random random(1);
  double longest = 0.0;
  for (int k = 0; k < 4000; ++k) {
    const Going a = somewhere(random, 0.999);
    // Near pairs, and any.
    Going b = k % 2 == 0 ? somewhere(random, 0.999)
                         : gone(a, 0.0009 * GetParam().radius * random.uniform(0.01, 1.0));
    const double truth = distance_between(a, b);
    const double on_map = norm(on(frame, a, 0).position - on(frame, b, 0).position);
    ASSERT_GE(on_map, truth - 1e-6);
    ASSERT_LE(on_map, frame.stretch() * truth + 1e-6);
    longest = std::max(longest, on_map / truth);
  }
  EXPECT_GT(longest - 1.0, 0.5 * (frame.stretch() - 1.0)) << "the bound is no larger than it must be";
}

TEST_P(LocalFrameOf, KeepsApartWhatIsApart) {
  const LocalFrame frame = this->frame();
  const Separation separation = frame.separation(Separation::cylinder(9260.0, 304.8));
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const Going a = somewhere(random, 0.98);
    const Going b = gone(a, 9260.0 * random.uniform(0.99, 1.0));
    if (!frame.place(b.place(), true, {})) continue;
    const double on_map = norm(on(frame, a, 0).position - on(frame, b, 0).position);
    ASSERT_LE(on_map, separation.horizontal) << "within on the earth";
  }
}

TEST_P(LocalFrameOf, TellsVelocitiesAsTheyAre) {
  const LocalFrame frame = this->frame();
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const Going here = somewhere(random, 0.99);
    const double speed = random.uniform(0.0, 300.0), step = 1.0;
    const State state = on(frame, here, speed);
    Going back = here;
    back.azimuth += 180.0;
    const Vec3 after = on(frame, gone(here, speed * step), 0).position;
    const Vec3 before = on(frame, gone(back, speed * step), 0).position;
    ASSERT_LT(norm((after - before) / (2.0 * step) - state.velocity), 1e-4 + 1e-5 * speed);
    ASSERT_LE(norm(state.velocity), frame.stretch() * speed + 1e-9);
    ASSERT_GE(norm(state.velocity), speed - 1e-9);
  }
}

/// A straight way on the earth has no acceleration; on the map it turns by what the class gets in addition.
TEST_P(LocalFrameOf, MakesRoomForTheCurvatureOfStraightWays) {
  const LocalFrame frame = this->frame();
  const double speed = 400.0, step = 10.0;
  const TrackClass promise = frame.promise(ErrorBound::cylinder(0.0, 0.0), ErrorBound::cylinder(speed, 0.0));
  Random random(4);
  double largest = 0.0;
  for (int k = 0; k < 4000; ++k) {
    const Going here = somewhere(random, 0.98);
    Going back = here;
    back.azimuth += 180.0;
    const Vec3 before = on(frame, gone(back, speed * step), 0).position;
    const Vec3 now = on(frame, here, 0).position;
    const Vec3 after = on(frame, gone(here, speed * step), 0).position;
    const double acceleration = norm(after - 2.0 * now + before) / (step * step);
    ASSERT_LE(acceleration, promise.acceleration_limit.horizontal() + 1e-7);
    largest = std::max(largest, acceleration);
  }
  EXPECT_GT(largest, 0.2 * promise.acceleration_limit.horizontal())
      << "the bound is no larger than it must be";
}

TEST_P(LocalFrameOf, RefusesWhatLiesBeyond) {
  const LocalFrame frame = this->frame();
  Going way = GetParam().origin;
  for (way.azimuth = -180.0; way.azimuth < 180.0; way.azimuth += 30.0) {
    EXPECT_TRUE(frame.place(gone(way, 0.9999 * GetParam().radius).place(), true, {}));
    EXPECT_FALSE(frame.place(gone(way, 1.0001 * GetParam().radius).place(), true, {}));
  }
  EXPECT_FALSE(frame.place(way.place(1e6), true, {}));
}

TEST_P(LocalFrameOf, TellsPlacesBack) {
  const LocalFrame frame = this->frame();
  Random random(5);
  for (int k = 0; k < 100; ++k) {
    const Going here = somewhere(random, 0.99);
    const Vec3 back = frame.geographic(on(frame, here, 0).position);
    ASSERT_NEAR(back.y, here.latitude, 1e-9);
    ASSERT_NEAR(std::remainder(back.x - here.longitude, 360.0), 0.0, 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, LocalFrameOf,
                         testing::Values(Map{{51.5, -0.5}, 500e3}, Map{{0.0, 179.9}, 500e3},
                                         Map{{-89.0, 20.0}, 300e3}, Map{{2.0, 10.0}, 3000e3},
                                         Map{{60.0, -150.0}, 5000e3}));

/// A velocity in terms of east and north that was measured elsewhere.
TEST_P(LocalFrameOf, KnowsHowFarVelocitiesTurnOnTheWay) {
  const LocalFrame frame = this->frame();
  Random random(6);
  for (int k = 0; k < 2000; ++k) {
    const Going here = somewhere(random, 0.98);
    const double away = 2000.0 * random.uniform(0.0, 1.0), speed = 250.0;
    Going there = gone(here, away);
    const State truth = on(frame, here, speed);
    there.azimuth = here.azimuth;
    const auto drawn = frame.place(there.place(), true, there.velocity(speed), away);
    if (!drawn) continue;
    const double limit =
        drawn->velocity_error - frame.place(there.place(), true, there.velocity(speed))->velocity_error;
    ASSERT_LE(norm(drawn->state.velocity - truth.velocity), limit + 1e-9) << there.latitude;
  }
}

TEST(LocalFrame, KnowsThatThereIsRoomAtTheTop) {
  const LocalFrame frame(50.0, 8.0, 500e3, 20e3);
  // At 12 km of height, the angle is 0.19 % more way.
  const auto low = frame.place({9.0, 50.0, 0.0}, true, {250.0, 0.0, 0.0});
  const auto high = frame.place({9.0, 50.0, 12e3}, true, {250.0, 0.0, 0.0});
  const auto unknown = frame.place({9.0, 50.0, 0.0}, false, {250.0, 0.0, 0.0});
  ASSERT_TRUE(low && high && unknown);
  EXPECT_NEAR(norm(low->state.velocity) / norm(high->state.velocity), 1.0 + 12e3 / 6371e3, 1e-9);
  EXPECT_LT(high->velocity_error, 0.1);
  EXPECT_GT(unknown->velocity_error, norm(low->state.velocity) - norm(high->state.velocity));
}

}  // namespace
}  // namespace kinesphere::program::local_frame_test

#endif
