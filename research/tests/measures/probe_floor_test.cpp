// The probe floor: worked out by hand where possible, and at most the probes of every detector.
#include "research/measures/probe_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "kinesphere/motion/steered_motion.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/oracle/gap_course.hpp"
#include "simulation/scene/make_scene.hpp"

namespace kinesphere::probe_floor_test {
namespace {

/// Returns bodies of radius 1 that fly straight on, though their acceleration limit would allow turns.
Scene straight(std::vector<State> states, double limit, double seconds) {
  Scene scene;
  const std::vector<double> limits(states.size(), limit);
  scene.bodies.resize(states.size());
  scene.motion = std::make_unique<SteeredMotion>(
      SteeredMotion::create({.start = std::move(states), .acceleration_limits = limits}).value());
  scene.response = SceneResponse::bounce;
  scene.world.contacts = ContactEvents::impacts;
  scene.end_time = seconds;
  return scene;
}

Scene built_in(SceneParameters::MotionKind motion, double limit, SceneResponse response) {
  return make_scene({.motion = motion,
                     .bodies = 60,
                     .radius_min = 1.0,
                     .limit_min = limit,
                     .limit_max = limit,
                     .box = {{0, 0, 0}, {90, 90, 90}},
                     .response = response,
                     .seconds = 2.0})
      .value();
}

ProbeFloor floor_of(const Scene& scene) {
  return probe_floor(scene, record_flight(scene, make_world_detector).value());
}

TEST(ProbeFloor, NobodyNearNeedsNoProbe) {
  EXPECT_EQ(floor_of(straight({{{0, 0, 0}, {1, 0, 0}}}, 10.0, 5.0)).total(), 0u);
  EXPECT_EQ(floor_of(straight({{{0, 0, 0}, {1, 0, 0}}, {{1000, 0, 0}, {-1, 0, 0}}}, 10.0, 5.0)).total(), 0u);
}

/// Returns the probes of one of two bodies that approach at `speed` until they touch: one each time that gap
/// + eps = speed s + limit s^2 / 2.
std::uint64_t probes_of_an_approach(double gap, double speed, double limit, double tolerance) {
  std::uint64_t probes = 0;
  for (;; ++probes) {
    const double margin = gap + tolerance;
    const double interval = 2.0 * margin / (speed + std::sqrt(speed * speed + 2.0 * limit * margin));
    gap -= speed * interval;
    if (gap <= 0.5 * tolerance) return probes + 1;  // the last probe is that of the contact
  }
}

TEST(ProbeFloor, HeadOnApproachByHand) {
  for (const double gap : {1.0, 10.0, 100.0}) {
    const Scene scene =
        straight({{{0, 0, 0}, {3, 0, 0}}, {{gap + 2.0, 0, 0}, {-2, 0, 0}}}, 8.0, gap / 5.0 + 1e-3);
    const Flight flight = record_flight(scene, make_world_detector).value();
    ASSERT_EQ(flight.contacts.size(), 1u);
    const ProbeFloor floor = probe_floor(scene, flight);
    const auto expected =
        static_cast<double>(probes_of_an_approach(gap, 5.0, 8.0, scene.world.contact_tolerance));
    // The contact is reported somewhere within the tolerance, which may or may not save the last probe before
    // it.
    EXPECT_NEAR(static_cast<double>(floor.probes[0]), expected, 1.0) << gap;
    EXPECT_EQ(floor.probes[0], floor.probes[1]) << "both have the same limit";
  }
}

TEST(ProbeFloor, SideBySideByHand) {
  // The gap stays at 0.5: each body is probed every sqrt(2 (gap + eps) / A).
  const Scene scene = straight({{{0, 0, 0}, {3, 0, 0}}, {{0, 2.5, 0}, {3, 0, 0}}}, 4.0, 10.0);
  const double interval = std::sqrt(2.0 * (0.5 + scene.world.contact_tolerance) / 4.0);
  const auto expected = static_cast<std::uint64_t>(std::floor(10.0 / interval));
  EXPECT_EQ(floor_of(scene).probes, (std::vector<std::uint64_t>{expected, expected}));
}

TEST(ProbeFloor, AlongAWallByHand) {
  Scene scene = straight({{{-20, 0, 1.5}, {3, 0, 0}}}, 4.0, 10.0);
  scene.world.box = Box{{-100, -100, 0}, {100, 100, 100}};
  const double interval = std::sqrt(2.0 * (0.5 + scene.world.contact_tolerance) / 4.0);
  EXPECT_EQ(floor_of(scene).total(), static_cast<std::uint64_t>(std::floor(10.0 / interval)));
}

TEST(ProbeFloor, BallisticBodiesAreAskedAtTheirContactsAlone) {
  const Scene scene = built_in(SceneParameters::MotionKind::ballistic, 0.0, SceneResponse::bounce);
  const Flight flight = record_flight(scene, make_world_detector).value();
  std::vector<std::set<double>> times(scene.bodies.size());
  for (const FlightContact& contact : flight.contacts) {
    times[contact.first].insert(contact.begin);
    times[contact.second].insert(contact.begin);
  }
  const ProbeFloor floor = probe_floor(scene, flight);
  ASSERT_GT(floor.total(), 50u);
  for (std::size_t body = 0; body < times.size(); ++body) EXPECT_EQ(floor.probes[body], times[body].size());
}

/// Counts probes by testing fixed times, too close to each other for a body to pass the tolerance in between.
std::uint64_t sampled_floor(const Scene& scene, const Flight& flight, std::uint32_t body, double step) {
  const auto state = [&](std::uint32_t number, double time) {
    return segment_at(flight.paths[number], time).state_at(time);
  };
  BodyDefinition definition = scene.motion->definition(body, 0.0);
  definition.radius = scene.bodies[body].radius;
  std::vector<double> stops;
  for (const FlightContact& contact : flight.contacts)
    if (contact.first == body || contact.second == body) stops.push_back(contact.begin);
  Bound bound = bound_of(definition, state(body, 0.0), 0.0);
  std::uint64_t probes = 0;
  std::size_t next_stop = 0;
  for (double time = 0.0; time < scene.end_time; time += step) {
    const bool stopped = next_stop < stops.size() && stops[next_stop] <= time;
    while (next_stop < stops.size() && stops[next_stop] <= time) ++next_stop;
    bool reached = false;
    for (std::uint32_t other = 0; other < scene.bodies.size(); ++other) {
      const double distance = norm(bound.centre_at(time) - state(other, time).position);
      const double margin = distance - bound.radius_at(time) - scene.bodies[other].radius;
      reached = reached || (other != body && margin < -scene.world.contact_tolerance);
    }
    if (!stopped && !reached) continue;
    ++probes;
    bound = bound_of(definition, state(body, time), time);
  }
  return probes;
}

TEST(ProbeFloor, AgreesWithFineSteps) {
  SceneParameters parameters{.bodies = 12,
                             .radius_min = 4.0,
                             .radius_max = 6.0,
                             .speed_min = 2.0,
                             .speed_max = 5.0,
                             .limit_min = 200.0,
                             .limit_max = 200.0,
                             .box = {{0, 0, 0}, {50, 50, 50}},
                             .walls = false,
                             .redraw_interval = 0.02,
                             .contact_tolerance = 0.02,
                             .seconds = 1.0};
  std::uint64_t total = 0;
  for (parameters.seed = 1; parameters.seed <= 5; ++parameters.seed) {
    const Scene scene = make_scene(parameters).value();
    const Flight flight = record_flight(scene, make_world_detector).value();
    const ProbeFloor floor = probe_floor(scene, flight);
    for (std::uint32_t body = 0; body < scene.bodies.size(); ++body) {
      const std::uint64_t sampled = sampled_floor(scene, flight, body, 2e-4);
      EXPECT_NEAR(static_cast<double>(floor.probes[body]), static_cast<double>(sampled), 1.0)
          << "seed " << parameters.seed << ", body " << body;
      total += sampled;
    }
  }
  EXPECT_GT(total, 200u);
}

TEST(ProbeFloor, NoDetectorAsksLess) {
  for (const SceneResponse response : {SceneResponse::bounce, SceneResponse::pass_through}) {
    const Scene scene = built_in(SceneParameters::MotionKind::random_forces, 15.0, response);
    for (const char* name : {"world", "paper", "hubbard", "hayward"}) {
      const Flight flight = record_flight(scene, detector_maker(name).value()).value();
      const std::uint64_t floor = probe_floor(scene, flight).total();
      EXPECT_GT(floor, 100u) << name;
      EXPECT_LE(floor, flight.result.counters.probes) << name;
    }
  }
}

}  // namespace
}  // namespace kinesphere::probe_floor_test
