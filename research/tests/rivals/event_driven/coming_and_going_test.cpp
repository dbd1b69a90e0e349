// Bodies that come, go and change velocity at any time: event-driven detectors report what the world reports
// of that motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <tuple>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/random.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere::coming_and_going_test {
namespace {

constexpr std::uint64_t seed = 3107;
constexpr std::uint32_t bodies = 24;
constexpr double edge = 20.0;

std::vector<State> random_start(Random& random) {
  std::vector<State> start;
  for (std::uint32_t body = 0; body < bodies; ++body)
    start.push_back({Vec3{10, 10, 10} + 9.0 * random.point_in_ball(), 8.0 * random.point_in_ball()});
  return start;
}

/// Twins makes equal calls to a detector under test and to the world.
class Twins {
 public:
  Twins(const DetectorMaker& make, std::unique_ptr<Motion> motion, const WorldDefinition& definition)
      : motion_(std::move(motion)),
        detector_(make(definition, *motion_).value()),
        world_(make_world_detector(definition, *motion_).value()),
        present_(bodies) {}

  void act(Random& random) {
    const auto body = static_cast<std::uint32_t>(random.bits() % bodies);
    if (!present_[body]) {
      BodyDefinition definition = motion_->definition(body, time_);
      definition.radius = random.uniform() < 0.2 ? 0.0 : random.uniform(0.1, 2.0);
      // The world refuses a body outside the box.
      if (!world_->add(body, definition)) return;
      detector_->add(body, definition).value();
      present_[body] = true;
    } else if (random.bits() % 3 == 0) {
      detector_->remove(body).value();
      world_->remove(body).value();
      present_[body] = false;
    } else {
      const Vec3 velocity = 10.0 * random.point_in_ball();
      ASSERT_TRUE(motion_->set_velocity(body, time_, velocity));
      detector_->set_velocity(body, velocity).value();
      world_->set_velocity(body, velocity).value();
    }
  }

  void advance(double until) {
    time_ = until;
    const std::vector<Event> found = events_until(*detector_);
    const std::vector<Event> expected = events_until(*world_);
    // Within the contact tolerance the order of contacts may differ.
    const auto in_order = [](std::vector<Event> events) {
      std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
        return std::tie(a.first, a.second, a.wall, a.time) < std::tie(b.first, b.second, b.wall, b.time);
      });
      return events;
    };
    compare(in_order(found), in_order(expected));
  }

  std::size_t events() const { return events_; }

 private:
  std::vector<Event> events_until(Detector& detector) const {
    std::vector<Event> events;
    // Of two that touch already, only the world reports that they begin to approach.
    while (const auto event = detector.advance(time_).value())
      if (!event->already_touching) events.push_back(*event);
    return events;
  }

  void compare(const std::vector<Event>& found, const std::vector<Event>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      ASSERT_EQ(found[k].kind, expected[k].kind);
      ASSERT_EQ(found[k].first, expected[k].first);
      ASSERT_EQ(found[k].second, expected[k].second);
      ASSERT_EQ(found[k].wall, expected[k].wall);
      ASSERT_NEAR(found[k].time, expected[k].time, 1e-4);
    }
    events_ += found.size();
  }

  std::unique_ptr<Motion> motion_;
  std::unique_ptr<Detector> detector_;
  std::unique_ptr<Detector> world_;
  std::vector<bool> present_;
  double time_ = 0.0;
  std::size_t events_ = 0;
};

void expect_twins(const DetectorMaker& make, const std::function<std::unique_ptr<Motion>(Random&)>& motion) {
  std::size_t events = 0;
  for (std::uint64_t k = 0; k < 8; ++k) {
    Random random = Random::at(seed, k, 0);
    WorldDefinition definition{.contact_tolerance = 1e-6};
    if (k % 2 == 0) definition.box = Box{{0, 0, 0}, {edge, edge, edge}};
    Twins twins(make, motion(random), definition);
    double time = 0.0;
    for (int action = 0; action < 300; ++action) {
      const auto several = random.bits() % 3;
      for (std::uint64_t n = 0; n <= several; ++n) twins.act(random);
      time += 0.02 * random.uniform();
      twins.advance(time);
      if (testing::Test::HasFatalFailure())
        FAIL() << "seed " << seed << ", run " << k << ", action " << action;
    }
    events += twins.events();
  }
  EXPECT_GT(events, 400u);
}

TEST(ComingAndGoing, is_followed_by_the_paper) {
  for (const double cell_edge : {0.0, 1.0}) {
    expect_twins(
        [=](const WorldDefinition& definition, const Motion& motion) {
          return make_paper_detector(definition, motion, {.cell_edge = cell_edge});
        },
        [](Random& random) {
          RandomForcesDefinition definition;
          definition.start = random_start(random);
          definition.acceleration_limits.assign(bodies, 0.0);
          for (double& limit : definition.acceleration_limits) limit = 30.0 * random.uniform();
          return std::make_unique<RandomForces>(RandomForces::create(definition).value());
        });
  }
}

TEST(ComingAndGoing, is_followed_by_the_ballistic_one) {
  expect_twins(make_ballistic_detector, [](Random& random) {
    return std::make_unique<Ballistic>(
        Ballistic::create({.start = random_start(random), .gravity = {0, 0, -5}}).value());
  });
}

}  // namespace
}  // namespace kinesphere::coming_and_going_test
