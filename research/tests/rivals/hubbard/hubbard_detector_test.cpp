// Properties of Hubbard's detector alone: the times at which it rebuilds space-time bounds, and progress of
// time where they overlap from the start. Tests of all detectors cover its contacts.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "kinesphere/motion/steered_motion.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere::hubbard_detector_test {
namespace {

/// Spheres of radius 1 with an acceleration limit that move straight on.
class Flight {
 public:
  Flight(std::vector<State> start, double limit, const WorldDefinition& definition = {})
      : motion_(
            SteeredMotion::create({.start = start, .acceleration_limits = std::vector(start.size(), limit)})
                .value()),
        detector_(make_hubbard_detector(definition, motion_).value()) {
    for (std::uint32_t number = 0; number < start.size(); ++number)
      detector_->add(number, motion_.definition(number, 0.0)).value();
  }

  /// Advances to a time or to the next event.
  std::optional<Event> advance(double until) { return detector_->advance(until).value(); }
  void set_velocity(std::uint32_t number, const Vec3& velocity) {
    ASSERT_TRUE(motion_.set_velocity(number, detector_->time(), velocity));
    detector_->set_velocity(number, velocity).value();
  }
  void remove(std::uint32_t number) { detector_->remove(number).value(); }

  DetectorCounters counters() const { return detector_->counters(); }

 private:
  SteeredMotion motion_;
  std::unique_ptr<Detector> detector_;
};

TEST(HubbardDetector, probes_all_bodies_at_each_rebuild) {
  Flight flight({{{0, 0, 0}, {}}, {{100, 0, 0}, {}}, {{0, 100, 0}, {}}}, 1.0);
  EXPECT_FALSE(flight.advance(50.0));
  const DetectorCounters counters = flight.counters();
  EXPECT_GT(counters.rebuilds, 5u);
  // The first rebuild uses the states with which the bodies were added.
  EXPECT_EQ(counters.probes, 3 * (counters.rebuilds - 1));
}

TEST(HubbardDetector, intervals_grow_while_nothing_meets) {
  Flight flight({{{0, 0, 0}, {}}, {{100, 0, 0}, {}}}, 0.0);
  EXPECT_FALSE(flight.advance(1.0));
  const std::uint64_t first = flight.counters().rebuilds;
  EXPECT_FALSE(flight.advance(1e9));
  EXPECT_LT(flight.counters().rebuilds, first + 80);
}

TEST(HubbardDetector, a_kick_and_a_removal_ask_for_a_rebuild) {
  Flight flight({{{0, 0, 0}, {}}, {{100, 0, 0}, {}}, {{0, 100, 0}, {}}}, 0.0);
  EXPECT_FALSE(flight.advance(1.0));
  const std::uint64_t rebuilds = flight.counters().rebuilds;
  flight.set_velocity(0, {0.1, 0, 0});
  EXPECT_FALSE(flight.advance(1.0));
  EXPECT_EQ(flight.counters().rebuilds, rebuilds + 1);
  flight.remove(1);
  EXPECT_FALSE(flight.advance(1.0));
  EXPECT_EQ(flight.counters().rebuilds, rebuilds + 2);
}

TEST(HubbardDetector, finds_the_time_of_a_head_on_contact) {
  Flight flight({{{0, 0, 0}, {1, 0, 0}}, {{12, 0, 0}, {-1, 0, 0}}}, 3.0);
  const auto begin = flight.advance(10.0);
  ASSERT_TRUE(begin);
  EXPECT_EQ(begin->kind, EventKind::contact_begin);
  EXPECT_NEAR(begin->time, 5.0, 1e-6);
  const auto end = flight.advance(10.0);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->kind, EventKind::contact_end);
  EXPECT_NEAR(end->time, 7.0, 1e-5);
  EXPECT_FALSE(flight.advance(10.0));
}

/// The narrow phase has the pair that has met, or the body and the wall; else the gap would only shrink by a
/// factor from interval to interval.
TEST(HubbardDetector, an_approach_takes_few_rebuilds) {
  Flight pair({{{0, 0, 0}, {0.01, 0, 0}}, {{2.1, 0, 0}, {-0.01, 0, 0}}}, 3.0);
  EXPECT_TRUE(pair.advance(10.0));
  EXPECT_LT(pair.counters().rebuilds, 60u);
  Flight wall({{{1.1, 5, 5}, {-0.01, 0, 0}}}, 3.0, {.box = Box{{0, 0, 0}, {10, 10, 10}}});
  EXPECT_TRUE(wall.advance(10.0));
  EXPECT_LT(wall.counters().rebuilds, 60u);
}

/// The cubes of the two overlap for a second, the spheres stay apart.
TEST(HubbardDetector, time_goes_on_while_two_pass_corner_to_corner) {
  for (const double limit : {0.0, 1.0}) {
    Flight flight({{{0, 0, 0}, {1, 0, 0}}, {{6, 1.9, 1.9}, {-1, 0, 0}}}, limit);
    EXPECT_FALSE(flight.advance(6.0));
    EXPECT_LT(flight.counters().rebuilds, 100u);
    EXPECT_LT(flight.counters().certificates, 200u);
  }
}

TEST(HubbardDetector, time_goes_on_while_bodies_rest_against_each_other_and_a_wall) {
  for (const double limit : {0.0, 1.0}) {
    const WorldDefinition definition{.box = Box{{0, 0, 0}, {10, 10, 10}}, .contact_tolerance = 1e-3};
    Flight flight({{{1, 5, 5}, {}}, {{3, 5, 5}, {}}, {{3, 7, 5}, {}}}, limit, definition);
    int events = 0;
    while (flight.advance(1.0)) ++events;
    EXPECT_EQ(events, 3);
    EXPECT_LT(flight.counters().rebuilds, 200u);
    EXPECT_LT(flight.counters().certificates, 5000u);
  }
}

TEST(HubbardDetector, time_goes_on_along_a_wall_and_in_a_corner) {
  const WorldDefinition definition{.box = Box{{0, 0, 0}, {10, 10, 10}}};
  // The distances from the walls are around the tolerance, where a bound reaches the wall before long.
  for (const double gap : {2e-6, 1e-5, 1e-3}) {
    Flight flight({{{1 + gap, 5, 5}, {0, 1, 0}}, {{9 - gap, 9 - gap, 9 - gap}, {}}}, 0.1, definition);
    EXPECT_FALSE(flight.advance(3.0)) << gap;
    EXPECT_LT(flight.counters().rebuilds, 1000u) << gap;
  }
}

TEST(HubbardDetector, a_world_without_bodies_has_no_rebuilds_to_wait_for) {
  Flight flight({{{0, 0, 0}, {1, 0, 0}}}, 1.0);
  EXPECT_FALSE(flight.advance(1.0));
  flight.remove(0);
  EXPECT_FALSE(flight.advance(1e6));
  EXPECT_LT(flight.counters().rebuilds, 200u);
}

}  // namespace
}  // namespace kinesphere::hubbard_detector_test
