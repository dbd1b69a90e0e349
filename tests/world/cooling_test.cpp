// Grains that lose energy in collisions cool at the same rate whether or not they fall together.
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/placement.hpp"
#include "support/test_size.hpp"

namespace kinesphere::cooling_test {
namespace {

constexpr int grains = 300;
constexpr double radius = 0.5e-3;
constexpr double restitution = 0.8;

struct Cooling {
  std::vector<double> temperatures{};  ///< relative to the first one
  std::uint64_t contacts = 0;
  std::uint64_t repeated = 0;
};

/// Beads of a millimetre at 0.1 m/s, which fill 30 % of a periodic box, in SI units.
Cooling cool(double gravity, std::uint64_t seed) {
  const double width = std::cbrt(grains * 4.0 / 3.0 * 3.141592653589793 * radius * radius * radius / 0.3);
  const Box box{{}, {width, width, width}};
  const Axes periodic{true, true, true};
  const auto places = place_spheres(std::vector<double>(grains, radius), box, {.periodic = periodic}).value();
  BallisticDefinition flight{.gravity = {0.0, 0.0, -gravity}};
  Random random(seed);
  for (const Vec3& place : places) flight.start.push_back({place, random.point_in_ball() * 0.1});
  Ballistic motion = Ballistic::create(flight).value();
  World world = World::create({.box = box, .periodic = periodic, .contacts = ContactEvents::impacts}).value();
  for (std::uint32_t body = 0; body < grains; ++body) {
    BodyDefinition grain = motion.definition(body, 0.0);
    grain.radius = radius;
    world.add(grain).value();
  }
  const auto temperature = [&](double time) {
    Vec3 mean;
    for (std::uint32_t body = 0; body < grains; ++body)
      mean += motion.state(body, time).velocity * (1.0 / grains);
    double sum = 0.0;
    for (std::uint32_t body = 0; body < grains; ++body)
      sum += norm_squared(motion.state(body, time).velocity - mean);
    return sum;
  };
  const double first = temperature(0.0);
  Cooling found;
  SingleMotionSource source(motion);
  for (const double time : {0.01, 0.03, 0.1}) {
    const auto respond = [](const Event& event) { return response_of(event, bounce(event, restitution)); };
    world.run(time, source, respond, [](const Event&) {}).value();
    found.temperatures.push_back(temperature(time) / first);
  }
  found.contacts = world.counters().count(EventKind::contact_begin);
  found.repeated = world.counters().repeated_contacts;
  return found;
}

/// Returns what several worlds have in the mean. The last temperatures of one differ by 8 % (standard
/// deviation) if rounding makes its collisions take another course.
Cooling cool_in_the_mean(double gravity) {
  const auto worlds = rounds_of<std::uint64_t>(16);
  Cooling mean;
  for (std::uint64_t seed = 1; seed <= worlds; ++seed) {
    const Cooling one = cool(gravity, seed);
    mean.temperatures.resize(one.temperatures.size());
    for (std::size_t k = 0; k < one.temperatures.size(); ++k)
      mean.temperatures[k] += one.temperatures[k] / static_cast<double>(worlds);
    mean.contacts += one.contacts;
    mean.repeated += one.repeated;
  }
  return mean;
}

TEST(Cooling, GrainsThatFallTogetherCoolAsWithoutGravity) {
  const Cooling without = cool_in_the_mean(0.0);
  ASSERT_GT(without.contacts, 9000u);
  EXPECT_EQ(without.repeated, 0u);
  const std::vector<double> gravities{9.81, 98.1};
  for (const double gravity : std::span(gravities).first(rounds_of(2u))) {
    const Cooling falling = cool_in_the_mean(gravity);
    EXPECT_EQ(falling.repeated, 0u);
    ASSERT_EQ(falling.temperatures.size(), without.temperatures.size());
    for (std::size_t k = 0; k < without.temperatures.size(); ++k)
      EXPECT_NEAR(falling.temperatures[k] / without.temperatures[k], 1.0, 0.1)
          << "gravity " << gravity << ", time " << k;
  }
}

}  // namespace
}  // namespace kinesphere::cooling_test
