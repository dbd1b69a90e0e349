// The default engine as a detector whose bodies all have one sensor.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "simulation/detector/detector.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::sensing_detector_test {
namespace {

/// Two that fly towards each other with a closing speed of 2.
Ballistic meeting() {
  return Ballistic::create({.start = {{{-6, 0, 0}, {1, 0, 0}}, {{6, 0, 0}, {-1, 0, 0}}}}).value();
}

TEST(SensingDetector, TellsAlarmsBeforeContacts) {
  const Ballistic motion = meeting();
  const auto detector = make_sensing_detector({}, motion, {.distances = {5.0, 1.0}}).value();
  for (const std::uint32_t body : {0u, 1u}) {
    BodyDefinition definition = motion.definition(body, 0.0);
    definition.radius = 0.5;
    ASSERT_TRUE(detector->add(body, definition));
  }
  std::vector<EventKind> kinds;
  std::vector<double> times;
  while (const auto event = detector->advance(5.6).value()) {
    kinds.push_back(event->kind);
    times.push_back(event->time);
  }
  EXPECT_EQ(kinds, (std::vector{EventKind::sensor_enter, EventKind::sensor_enter, EventKind::contact_begin}));
  ASSERT_EQ(times.size(), 3u);
  EXPECT_NEAR(times[0], 3.0, 1e-5);
  EXPECT_NEAR(times[1], 5.0, 1e-5);
  EXPECT_NEAR(times[2], 5.5, 1e-5);
}

TEST(SensingDetector, RefusesWhatWorldsRefuse) {
  const Ballistic motion = meeting();
  ASSERT_TRUE(make_sensing_detector({}, motion, {}));
  expect_error(make_sensing_detector({}, motion, {.distances = {-1.0}}), ErrorCode::out_of_range, "sensor",
               "set_sensor:");
  expect_error(make_sensing_detector({}, motion, {.distances = {std::numeric_limits<double>::quiet_NaN()}}),
               ErrorCode::not_finite, "sensor", "set_sensor:");
  expect_error(make_sensing_detector({.contact_tolerance = 0.0}, motion, {.distances = {1.0}}),
               ErrorCode::out_of_range, "contact_tolerance", "World::create:");
}

}  // namespace
}  // namespace kinesphere::sensing_detector_test
