// Responses to contacts, in the world that the first lines of the docs make: those that part bodies never let them
// pass, those that do not part them let them through, and none stops time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "kinesphere/response.hpp"
#include "support/playground.hpp"

namespace kinesphere::responses_test {
namespace {

constexpr double eps = 1e-6;

bool begins(const Event& event) {
  return event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
}

void bounce_off(Playground& p, const Event& event, double restitution) {
  const Bounce after = bounce(event, restitution);
  p.set_velocity(event.first, after.first_velocity);
  if (event.second_can_move()) p.set_velocity(event.second, after.second_velocity);
}

/// Every choice of events that a world can report.
class Responses : public testing::TestWithParam<ContactEvents> {
 protected:
  WorldDefinition definition{.contacts = GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Events, Responses,
                         testing::Values(ContactEvents::all, ContactEvents::impacts, ContactEvents::begin_and_end),
                         [](const auto& parameter) {
                           return parameter.param == ContactEvents::all       ? "all"
                                  : parameter.param == ContactEvents::impacts ? "impacts"
                                                                              : "begin_and_end";
                         });

TEST_P(Responses, ABallThatComesToRestStaysInTheBox) {
  definition.box = Box{{0, 0, 0}, {10, 10, 10}};
  Playground p(definition);
  const BodyId ball = p.add({.planned_acceleration = {0, 0, -10}, .position = {5, 5, 3}});
  for (int tick = 1; tick <= 200; ++tick) {
    p.run(
        0.05 * tick,
        [&](const Event& event) {
          if (begins(event)) bounce_off(p, event, 0.5);
        },
        20000);
    ASSERT_GE(p.state(ball).position.z, 1.0 - eps) << p.world.time();
  }
  EXPECT_NEAR(p.state(ball).position.z, 1.0, 10 * eps);
  EXPECT_EQ(p.world.counters().count(EventKind::wall_end) > 0, wants_ends(GetParam()));
}

TEST_P(Responses, AGasNeverOverlaps) {
  definition.box = Box{{0, 0, 0}, {5, 5, 5}};
  Playground p(definition);
  Random random(1);
  std::vector<BodyId> balls;
  for (int k = 0; k < 64; ++k)
    balls.push_back(p.add({.radius = 0.49,
                           .position = Vec3{0.6 + 1.2 * (k % 4), 0.6 + 1.2 * (k / 4 % 4), 0.6 + 1.2 * (k / 16)},
                           .velocity = random.point_in_ball()}));
  for (int tick = 1; tick <= 40; ++tick) {
    p.run(
        0.05 * tick,
        [&](const Event& event) {
          if (begins(event)) bounce_off(p, event, 1.0);
        },
        100000);
    for (std::size_t a = 0; a < balls.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) ASSERT_GE(p.gap(balls[a], balls[b]), -eps) << p.world.time();
  }
}

TEST_P(Responses, ACradlePassesTheBlowOnWhetherItsBallsTouchOrNot) {
  for (const double gap : {0.0, 1e-10, 1e-6, 0.01})
    for (const int in : {1, 2, 3}) {
      // Balls that touch from the start have begun without an approach, and report no further one.
      if (GetParam() == ContactEvents::begin_and_end && gap <= eps) continue;
      Playground p(definition);
      std::vector<BodyId> balls;
      for (int k = 0; k < 5; ++k)
        balls.push_back(p.add({.position = {k * (2.0 + gap) - (k < in ? 3.0 : 0.0), 0, 0},
                               .velocity = {k < in ? 1.0 : 0.0, 0, 0}}));
      p.run(10.0, [&](const Event& event) {
        if (begins(event) && event.approach_speed > 0) bounce_off(p, event, 1.0);
      });
      for (int k = 0; k < 5; ++k)
        EXPECT_NEAR(p.state(balls[static_cast<std::size_t>(k)]).velocity.x, k < 5 - in ? 0.0 : 1.0, 1e-12)
            << "gap " << gap << ", " << in << " in, ball " << k;
    }
}

TEST_P(Responses, AResponseThatDoesNotPartThePairLetsItThrough) {
  // The ball grazes the end of the paddle from above, and the game only turns its horizontal velocity.
  definition.dimensions = 2;
  definition.contact_tolerance = 1e-4;
  Playground p(definition);
  const BodyId ball = p.add({.position = {0.3, 5, 0}, .velocity = {-3, -400, 0}});
  p.world.add_static({.shape = Ball{{0, 0, 0}, 0.5}}).value();
  const auto events = p.run(1.0, [&](const Event& event) {
    if (!begins(event)) return;
    Vec3 velocity = p.state(ball).velocity;
    velocity.x = std::abs(velocity.x);
    p.set_velocity(ball, velocity);
  });
  EXPECT_LE(events.size(), 4u) << events;
  EXPECT_EQ(p.world.time(), 1.0);
}

TEST_P(Responses, BodiesThatPassThroughAreReportedOnce) {
  Playground p(definition);
  const BodyId a = p.add({.position = {-5, 0, 0}, .velocity = {1, 0, 0}});
  p.add({.position = {5, 0.3, 0}, .velocity = {-1, 0, 0}});
  // The velocity is news in every frame, and no one answers.
  std::size_t begun = 0;
  for (int frame = 1; frame <= 600; ++frame) {
    for (const Event& event : p.run(frame / 60.0)) begun += begins(event) ? 1 : 0;
    p.set_velocity(a, {1.0 + 1e-3 * (frame % 2), 0, 0});
  }
  EXPECT_EQ(begun, 1u);
}

/// Any responses, in crowds that touch at the start: time goes on, and what happens at an instant is bounded.
TEST_P(Responses, WhateverTheyAreTimeGoesOn) {
  Random random(7);
  for (int scene = 0; scene < 300; ++scene) {
    Playground p(definition);
    const int count = 2 + static_cast<int>(random.bits() % 6);
    for (int k = 0; k < count; ++k)
      p.add({.acceleration_limit = random.bits() % 3 == 0 ? 1.0 : 0.0,
             .position = {2.0 * (k % 3), 2.0 * (k / 3), 0},
             .velocity = random.point_in_ball()});
    const auto kind = random.bits() % 4;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<double, int>> at_instant;
    std::size_t reported = 0;
    p.run(
        1.0,
        [&](const Event& event) {
          ++reported;
          if (!begins(event)) return;
          auto& [time, times] = at_instant[{event.first.index, event.second.index}];
          times = time == event.time ? times + 1 : 1;
          time = event.time;
          ASSERT_LE(times, 256) << scene;
          if (kind == 0) return bounce_off(p, event, 1.0);
          if (kind == 1 || random.bits() % 2 == 0) p.set_velocity(event.first, random.point_in_ball());
          if (kind == 2) p.set_velocity(event.second, event.first_state.velocity);
          if (kind == 3) p.set_velocity(event.second, -event.second_state.velocity);
        },
        100000);
    ASSERT_EQ(p.world.time(), 1.0) << "scene " << scene << ", kind " << kind;
    EXPECT_LT(reported, 20000u) << "scene " << scene << ", kind " << kind;
    EXPECT_TRUE(is_clean(p.world)) << scene;
  }
}

TEST_P(Responses, NaNIsRefusedAndNothingChanges) {
  Playground p(definition);
  const BodyId a = p.add({.position = {-5, 0, 0}, .velocity = {1, 0, 0}});
  p.add({.position = {5, 0, 0}, .velocity = {-1, 0, 0}});
  const auto events = p.run(10.0, [&](const Event& event) {
    EXPECT_FALSE(p.world.set_velocity(a, {std::nan(""), 0, 0}));
    if (begins(event)) bounce_off(p, event, 1.0);
  });
  EXPECT_EQ(std::count_if(events.begin(), events.end(), begins), 1);
  EXPECT_NEAR(p.state(a).velocity.x, -1.0, 1e-12);
}

}  // namespace
}  // namespace kinesphere::responses_test
