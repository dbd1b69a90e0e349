// Bodies that enter a solid box and stay there for a while: for any contact tolerance the world wakes hardly
// more often than it probes.
#include <gtest/gtest.h>

#include "support/playground.hpp"

namespace kinesphere::inside_a_box_test {
namespace {

struct Visit {
  double tolerance, radius, acceleration_limit;
  int dimensions;
};

std::ostream& operator<<(std::ostream& out, const Visit& visit) {
  return out << "tolerance " << visit.tolerance << ", radius " << visit.radius << ", acceleration limit "
             << visit.acceleration_limit << ", " << visit.dimensions << " dimensions";
}

class VisitInABox : public testing::TestWithParam<Visit> {};

TEST_P(VisitInABox, WakesHardlyMoreOftenThanItAsks) {
  const Visit& visit = GetParam();
  Playground p({.dimensions = visit.dimensions, .contact_tolerance = visit.tolerance});
  const double thick = visit.dimensions == 3 ? 0.01 : 0.0;
  p.world.add_static({.shape = Box{{1.97, 1.93, -thick}, {2.03, 2.0, thick}}}).value();
  const BodyId id = p.add({.radius = visit.radius,
                           .acceleration_limit = visit.acceleration_limit,
                           .position = {2.001, 2.0 + visit.radius + 1e-4, 0},
                           .velocity = {0.39, -2.9, 0}},
                          Vec3{});
  std::vector<Event> events;
  // Small steps, so that a world that crawls is detected early.
  for (int step = 1; step <= 1000; ++step) {
    while (const auto event = p.advance(4e-5 * step)) events.push_back(*event);
    const Counters& counters = p.world.counters();
    ASSERT_LE(counters.pair_checks, 200u) << "at time " << p.world.time();
    ASSERT_LE(counters.probes, 200u) << "at time " << p.world.time();
  }
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_begin);
  EXPECT_EQ(events[1].kind, EventKind::contact_end);
  EXPECT_LT(p.state(id).position.y, 1.93);
}

INSTANTIATE_TEST_SUITE_P(Of, VisitInABox,
                         testing::Values(Visit{1e-12, 0, 1494, 3}, Visit{1e-6, 0, 1494, 3},
                                         Visit{1e-6, 0, 10, 3}, Visit{1e-9, 1e-9, 1494, 3},
                                         Visit{1e-6, 1e-3, 1494, 3}, Visit{1e-12, 0, 1494, 2},
                                         Visit{1e-6, 0, 1494, 2}));

}  // namespace
}  // namespace kinesphere::inside_a_box_test
