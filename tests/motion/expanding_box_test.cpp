// Boxes that grow and shrink: contacts of a world beside those of the box itself, found by other formulas.
#include "kinesphere/expanding_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::expanding_box_test {
namespace {

using Long = long double;
constexpr double infinity = std::numeric_limits<double>::infinity(), side = 10.0;

struct Kind {
  const char* name;
  double rate;
  ExpandingBox::Flow flow;
  double restitution, duration;
  double start_time = 0.0;
};
std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

/// Balls in a box as it is: straight ways, or ways in the flow.
struct RealGas {
  struct Way {
    double since;
    State start;
  };

  explicit RealGas(const Kind& its_kind) : kind(its_kind) {
    Random random(7);
    while (ways.size() < 40) {
      ways.push_back({kind.start_time, {side * random.point_in_ball(), 4.0 * random.point_in_ball()}});
      radii.push_back(random.uniform(0.2, 0.8));
      bool is_free = true;
      for (std::size_t k = 0; k + 1 < ways.size(); ++k)
        is_free = is_free && gap(k, ways.size() - 1, kind.start_time) > 1e-3;
      if (is_free) continue;
      ways.pop_back();
      radii.pop_back();
    }
  }

  Long edge(double time) const {
    const Long strain = Long(kind.rate) * (Long(time) - kind.start_time);
    return side * (kind.flow == ExpandingBox::Flow::free ? 1 + strain : std::exp(strain));
  }
  /// Returns the place and the velocity in space of a ball.
  void at(std::size_t ball, double time, Long (&place)[3], Long (&velocity)[3]) const {
    const auto& [since, start] = ways[ball];
    const Long s = Long(time) - since, growth = std::exp(kind.rate * s);
    for (int axis = 0; axis < 3; ++axis) {
      const Long x = start.position[axis], v = start.velocity[axis];
      if (kind.flow == ExpandingBox::Flow::free) {
        place[axis] = x + s * v, velocity[axis] = v;
      } else {
        // The solution of x' = rate x + v.
        place[axis] = growth * x + v * (growth - 1) / kind.rate;
        velocity[axis] = kind.rate * place[axis] + v;
      }
    }
  }
  /// Returns the gap of two in the images that are nearest, and the rate at which it grows.
  std::pair<Long, Long> gap_and_rate(std::size_t a, std::size_t b, double time) const {
    Long first[3], second[3], first_velocity[3], second_velocity[3], square = 0, product = 0;
    at(a, time, first, first_velocity), at(b, time, second, second_velocity);
    const Long period = edge(time),
               stretch = kind.flow == ExpandingBox::Flow::free ? side * kind.rate : period * kind.rate;
    for (int axis = 0; axis < 3; ++axis) {
      const Long image = std::round((second[axis] - first[axis]) / period);
      const Long way = second[axis] - first[axis] - image * period;
      square += way * way;
      product += way * (second_velocity[axis] - first_velocity[axis] - image * stretch);
    }
    return {std::sqrt(square) - radii[a] - radii[b], product / std::sqrt(square)};
  }
  double gap(std::size_t a, std::size_t b, double time) const {
    return static_cast<double>(gap_and_rate(a, b, time).first);
  }
  double least_gap(double time) const {
    double least = infinity;
    for (std::size_t a = 0; a < ways.size(); ++a)
      for (std::size_t b = a + 1; b < ways.size(); ++b) least = std::min(least, gap(a, b, time));
    return least;
  }
  /// Returns the time after `now` at which two begin to overlap, found in steps in which they come no nearer
  /// than they are, then halved.
  double meeting(std::size_t a, std::size_t b, double now, double until) const {
    constexpr double step = 1e-3;
    double from = now;
    while (from < until) {
      const double to = from + step + 0.05 * std::max(0.0, gap(a, b, from));
      if (gap(a, b, to) >= 0.0) {
        from = to;
        continue;
      }
      double late = to;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (from + late);
        (gap(a, b, middle) < 0.0 ? late : from) = middle;
      }
      return late;
    }
    return infinity;
  }

  Kind kind;
  std::vector<Way> ways;
  std::vector<double> radii;
};

class ExpandingBoxes : public testing::TestWithParam<Kind> {};

TEST_P(ExpandingBoxes, HaveTheContactsOfTheBoxItself) {
  const Kind& kind = GetParam();
  RealGas gas(kind);
  const ExpandingBox box =
      ExpandingBox::create({.rate = kind.rate, .flow = kind.flow, .start_time = kind.start_time}).value();
  World world = World::create({.box = Box{{}, {side, side, side}},
                               .periodic = {true, true, true},
                               .contact_tolerance = 1e-9,
                               .contacts = ContactEvents::impacts})
                    .value();
  Ballistic balls = Ballistic::create({}).value();
  BodyMap bodies;
  for (std::size_t k = 0; k < gas.ways.size(); ++k) {
    const State seen = box.seen(gas.ways[k].start, kind.start_time);
    const std::uint32_t number = balls.add(0.0, seen).value();
    bodies.add(world, balls, number, {.radius = gas.radii[k], .radius_rate = box.growth_rate(gas.radii[k])})
        .value();
  }
  double now = kind.start_time;
  int contacts = 0;
  for (const Event& event : world.events(box.clock(kind.start_time + kind.duration), bodies.probe())) {
    ASSERT_EQ(event.kind, EventKind::contact_begin);
    const std::size_t a = event.first.index, b = event.second.index;
    const Event real = box.real(event);
    // The contact is the first one of all.
    const double expected = gas.meeting(a, b, now, real.time + 1.0);
    ASSERT_NEAR(real.time, expected, 1e-6) << contacts;
    ASSERT_GE(gas.least_gap(real.time), -1e-7) << contacts;
    EXPECT_NEAR(real.gap, 0.0, 1e-7);
    EXPECT_NEAR(norm(real.second_state.position - real.first_state.position), gas.radii[a] + gas.radii[b],
                1e-7);
    const double approach = static_cast<double>(-gas.gap_and_rate(a, b, real.time).second);
    EXPECT_NEAR(real.approach_speed, approach, 1e-5 * (1.0 + std::abs(approach)));
    // A bounce in the world is one in the box.
    const Bounce after = bounce(event, kind.restitution);
    const auto turn = [&](BodyId body, const State& before, const Vec3& velocity) {
      const double clock = event.time;
      Long place[3], old[3];
      gas.at(body.index, real.time, place, old);
      const State kept = box.real(before, clock), changed = box.real(State{before.position, velocity}, clock);
      // The ways go on in the image in which they are; the image of the event has another velocity in free
      // flow.
      State way{{double(place[0]), double(place[1]), double(place[2])}, gas.ways[body.index].start.velocity};
      way.velocity += changed.velocity - kept.velocity;
      gas.ways[body.index] = {real.time, way};
      bodies.set_velocity(world, body, velocity).value();
    };
    turn(event.first, event.first_state, after.first_velocity);
    turn(event.second, event.second_state, after.second_velocity);
    EXPECT_NEAR(static_cast<double>(gas.gap_and_rate(a, b, real.time).second), kind.restitution * approach,
                1e-5 * (1.0 + std::abs(approach)));
    now = real.time;
    ++contacts;
  }
  EXPECT_GE(gas.least_gap(kind.start_time + kind.duration), -1e-7);
  EXPECT_GT(contacts, 100);
}

INSTANTIATE_TEST_SUITE_P(Of, ExpandingBoxes,
                         testing::Values(Kind{"grows", 0.02, ExpandingBox::Flow::free, 1.0, 20.0},
                                         Kind{"shrinks", -0.08, ExpandingBox::Flow::free, 1.0, 7.0},
                                         Kind{"shrinks_later", -0.08, ExpandingBox::Flow::free, 0.7, 7.0,
                                              30.0},
                                         Kind{"carries", 0.02, ExpandingBox::Flow::carried, 1.0, 20.0},
                                         Kind{"presses", -0.1, ExpandingBox::Flow::carried, 0.9, 7.5}),
                         [](const auto& each) { return each.param.name; });

TEST(ExpandingBox, ConvertsThereAndBack) {
  for (const ExpandingBox::Flow flow : {ExpandingBox::Flow::free, ExpandingBox::Flow::carried}) {
    for (const double rate : {-0.1, 0.0, 0.3}) {
      const ExpandingBox box = ExpandingBox::create({.rate = rate, .flow = flow, .start_time = 2.0}).value();
      EXPECT_EQ(box.clock(2.0), 0.0);
      EXPECT_EQ(box.scale(2.0), 1.0);
      for (const double time : {1.0, 2.0, 3.5, 9.0}) {
        const double clock = box.clock(time);
        EXPECT_NEAR(box.time(clock), time, 1e-12);
        EXPECT_NEAR(box.scale_at(clock), box.scale(time), 1e-12);
        const State real{{1, -2, 3}, {0.5, 0.25, -4}}, back = box.real(box.seen(real, time), clock);
        EXPECT_LT(norm(back.position - real.position), 1e-12);
        EXPECT_LT(norm(back.velocity - real.velocity), 1e-12);
      }
    }
  }
}

TEST(ExpandingBox, EndsWithItsSize) {
  const ExpandingBox shrinks = ExpandingBox::create({.rate = -0.1}).value();
  EXPECT_EQ(shrinks.clock(10.0), infinity);
  EXPECT_EQ(shrinks.clock(11.0), infinity);
  const ExpandingBox grows = ExpandingBox::create({.rate = 0.1}).value();
  EXPECT_EQ(grows.time(10.0), infinity);
  EXPECT_EQ(grows.time(11.0), infinity);
  EXPECT_EQ(grows.clock(-10.0), -infinity);
}

TEST(ExpandingBox, RefusesWhatIsNoNumber) {
  expect_error(ExpandingBox::create({.rate = infinity}), ErrorCode::not_finite, "rate",
               "ExpandingBox::create");
  expect_error(ExpandingBox::create({.start_time = std::nan("")}), ErrorCode::not_finite, "start_time",
               "ExpandingBox::create");
}

}  // namespace
}  // namespace kinesphere::expanding_box_test
