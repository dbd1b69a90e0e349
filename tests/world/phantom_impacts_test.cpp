// Bodies that touch and slide past each other: an approach caused by rounding is not reported. A real one,
// however slow, is reported before the gap has gone below minus the tolerance.
#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/response.hpp"
#include "number/infinity.hpp"
#include "world/surroundings.hpp"

namespace kinesphere::phantom_impacts_test {
namespace {

constexpr std::uint64_t seed = 1404;
constexpr double eps = 1e-7;
constexpr double restitution = 0.9;

/// Responds to all impacts with bounce(), and counts them.
std::size_t impacts(Surroundings& p, double until) {
  const auto mass = [&p](BodyId id) { return p.fixed.contains(id) ? infinity : 1.0; };
  const auto answer = [&](const Event& event) {
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return;
    const double second = event.second == no_body ? 1.0 : mass(event.second);
    const Bounce after = bounce(event, mass(event.first), second, restitution);
    if (!p.fixed.contains(event.first)) p.set_velocity(event.first, after.first_velocity);
    if (event.second != no_body && !p.fixed.contains(event.second))
      p.set_velocity(event.second, after.second_velocity);
  };
  return p.run(until, answer).size();
}

/// Returns a vector of length `speed`, normal to n except for rounding.
Vec3 sideways(Random& random, const Vec3& n, double speed) {
  const Vec3 c = cross(n, random.unit_vector());
  return c / norm(c) * speed;
}

BodyDefinition ball(const Vec3& position, const Vec3& velocity, double radius = 1.0) {
  return {.radius = radius, .acceleration_limit = 0.15, .position = position, .velocity = velocity};
}

/// Returns the largest count of several trials.
template <class Trial>
std::size_t most_impacts(std::uint64_t trials, Trial impacts_in) {
  std::size_t most = 0;
  for (std::uint64_t trial = 0; trial < trials; ++trial) most = std::max(most, impacts_in(trial));
  return most;
}

TEST(PhantomImpacts, OfTwoBallsThatSlidePastEachOther) {
  const std::size_t most = most_impacts(2000, [](std::uint64_t trial) {
    Random random(trial);
    Surroundings p({.contact_tolerance = eps, .contacts = ContactEvents::impacts});
    const Vec3 n = random.unit_vector();
    const Vec3 v = random.point_in_ball();
    p.add(ball({}, v), Vec3{});
    p.add(ball(2.0 * n, v + sideways(random, n, 0.5)), Vec3{});
    return impacts(p, 1e-3);
  });
  EXPECT_LE(most, 2u);
}

/// Bodies of all sizes, far from the origin, and fast ones with a common direction.
TEST(PhantomImpacts, OfTwoBallsAnywhere) {
  const std::size_t most = most_impacts(2000, [](std::uint64_t trial) {
    Random random = Random::at(seed, trial, 0);
    Surroundings p({.contact_tolerance = eps, .contacts = ContactEvents::impacts});
    const Vec3 n = random.unit_vector();
    const Vec3 v = std::pow(10.0, random.uniform(-3.0, 4.0)) * random.point_in_ball();
    const Vec3 place = std::pow(10.0, random.uniform(-2.0, 5.0)) * random.point_in_ball();
    const double first = std::pow(10.0, random.uniform(-5.0, 1.0));
    const double second = std::pow(10.0, random.uniform(-5.0, 1.0));
    p.add(ball(place, v, first), Vec3{});
    p.add(ball(place + (first + second) * n, v + sideways(random, n, 0.5), second), Vec3{});
    return impacts(p, 1e-3);
  });
  EXPECT_LE(most, 2u);
}

TEST(PhantomImpacts, OfTwoBallsWhereSpaceRepeats) {
  const std::size_t most = most_impacts(1000, [](std::uint64_t trial) {
    Random random = Random::at(seed, trial, 1);
    Surroundings p({.box = Box{{0, 0, 0}, {20, 20, 20}},
                    .periodic = {true, true, true},
                    .contact_tolerance = eps,
                    .contacts = ContactEvents::impacts});
    const Vec3 n = random.unit_vector();
    const Vec3 v = random.point_in_ball();
    // The bodies lie on both sides of the border of the box.
    const Vec3 place{random.bits() % 2 == 0 ? 0.5 : 19.5, 10, 10};
    p.add(ball(place, v), Vec3{});
    p.add(ball(place + 2.0 * n, v + sideways(random, n, 0.5)), Vec3{});
    return impacts(p, 1e-3);
  });
  EXPECT_LE(most, 2u);
}

TEST(PhantomImpacts, OfABallAtAWall) {
  const std::size_t most = most_impacts(1000, [](std::uint64_t trial) {
    Random random = Random::at(seed, trial, 2);
    Surroundings p(
        {.box = Box{{0, 0, 0}, {20, 20, 20}}, .contact_tolerance = eps, .contacts = ContactEvents::impacts});
    // The typical error after a bounce at a wall and a turn elsewhere.
    const double rounding = random.uniform(-1e-15, 1e-15);
    p.add(ball({1.0, 10, 10}, {rounding, random.uniform(0.5, 2.0), random.uniform(-1.0, 1.0)}), Vec3{});
    return impacts(p, 1e-3);
  });
  EXPECT_LE(most, 2u);
}

TEST(PhantomImpacts, OfABallAtAFixedShape) {
  const std::size_t most = most_impacts(4000, [](std::uint64_t trial) {
    Random random = Random::at(seed, trial, 3);
    Surroundings p({.contact_tolerance = eps, .contacts = ContactEvents::impacts});
    const Vec3 n = random.unit_vector();
    const Vec3 aside = sideways(random, n, 3.0);
    const Vec3 other = cross(n, aside);
    const Vec3 place = 10.0 * random.point_in_ball();
    Vec3 normal = n;
    switch (trial % 4) {
      case 0:
        p.place(HalfSpace{n, dot(n, place)});
        break;
      case 1:
        p.place(Triangle{place + aside + other, place - 2.0 * aside, place - 2.0 * other});
        break;
      case 2:
        p.place(Ball{place - 2.0 * n, 2.0});
        break;
      default:  // at an edge
        p.place(Box{place - Vec3{3, 3, 3}, place + Vec3{0, 0, 3}});
        normal = Vec3{std::abs(n.x), std::abs(n.y), 0.0} / std::hypot(n.x, n.y);
    }
    p.add(ball(place + normal, sideways(random, normal, 0.5)), Vec3{});
    return impacts(p, 1e-3);
  });
  EXPECT_LE(most, 2u);
}

/// Ever slower approaches, down to the rounding error.
TEST(PhantomImpacts, RealSlowApproachesAreTold) {
  for (double approach = 1e-3; approach > 1e-13; approach *= 0.1) {
    Surroundings p({.contact_tolerance = eps, .contacts = ContactEvents::impacts});
    p.add({.radius = 1, .position = {0, 0, 0}, .velocity = {approach, 0.5, 0}}, Vec3{});
    p.add({.radius = 1, .position = {2, 0, 0}, .velocity = {0, 0.5, 0}}, Vec3{});
    const auto event = p.advance(1.0 + 4 * eps / approach);
    ASSERT_TRUE(event) << approach;
    EXPECT_EQ(event->kind, EventKind::contact_begin);
    EXPECT_NEAR(event->approach_speed, approach, 1e-3 * approach);
    EXPECT_GE(event->gap, -eps);
  }
}

/// An approach as slow as a rounding error that lasts until it has used most of the tolerance.
TEST(PhantomImpacts, ApproachesThatDoNotEndAreToldInTime) {
  constexpr double fine = 1e-10;
  constexpr double approach = 1.5e-12;
  Surroundings p({.box = Box{{0, 0, 0}, {100, 100, 0}},
                  .periodic = {false, true, false},
                  .dimensions = 2,
                  .contact_tolerance = fine,
                  .contacts = ContactEvents::impacts});
  const BodyId id = p.add({.radius = 1, .position = {1, 50, 0}, .velocity = {-approach, 1000, 0}}, Vec3{});
  // In the box, and more exact than a product of doubles, which would violate the limits.
  p.distort = [](BodyId, double time, State& state) {
    state.position.y = static_cast<double>(std::fmod(50.0L + 1000.0L * time, 100.0L));
  };
  const auto event = p.advance(1000.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::wall_begin);
  EXPECT_GE(p.state(id).position.x - 1.0, -fine);
  EXPECT_GE(event->gap, -fine);
  EXPECT_TRUE(is_clean(p.world));
}

}  // namespace
}  // namespace kinesphere::phantom_impacts_test
