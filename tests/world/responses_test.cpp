// Responses to contacts, in the world that the first lines of the docs make: those that part bodies never let
// them pass, those that do not part them let them through, and none stops time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
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
                         testing::Values(ContactEvents::all, ContactEvents::impacts,
                                         ContactEvents::begin_and_end),
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
    balls.push_back(
        p.add({.radius = 0.49,
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

TEST_P(Responses, ACrystalWithoutAnyRoomKeepsToItsTolerance) {
  definition.box = Box{{0, 0, 0}, {3, 3, 3}};
  Playground p(definition);
  Random random(1);
  std::vector<BodyId> balls;
  for (int k = 0; k < 27; ++k)
    balls.push_back(p.add({.radius = 0.5,
                           .position = Vec3{0.5 + k % 3, 0.5 + k / 3 % 3, 0.5 + k / 9},
                           .velocity = random.point_in_ball()}));
  std::size_t guards = 0;
  for (int tick = 1; tick <= 4; ++tick) {
    p.run(
        0.01 * tick,
        [&](const Event& event) {
          guards += event.kind == EventKind::zeno_guard ? 1u : 0u;
          if (begins(event)) bounce_off(p, event, 1.0);
        },
        1000000);
    for (std::size_t a = 0; a < balls.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) ASSERT_GE(p.gap(balls[a], balls[b]), -eps) << p.world.time();
  }
  EXPECT_EQ(guards, 0u);
}

TEST_P(Responses, AHeavyBallInACradleKeepsMomentumAndEnergy) {
  for (const double gap : {0.0, 0.01}) {
    Playground p(definition);
    std::vector<BodyId> balls;
    const auto mass = [](int k) { return k == 2 ? 3.0 : 1.0; };
    for (int k = 0; k < 5; ++k)
      balls.push_back(p.add({.position = {k * (2.0 + gap) - (k == 0 ? 3.0 : 0.0), 0, 0},
                             .velocity = {k == 0 ? 1.0 : 0.0, 0, 0},
                             .mass = mass(k)}));
    p.run(20.0, [&](const Event& event) {
      if (begins(event) && event.approach_speed > 0) bounce_off(p, event, 1.0);
    });
    double momentum = 0.0, energy = 0.0;
    for (int k = 0; k < 5; ++k) {
      const double velocity = p.state(balls[static_cast<std::size_t>(k)]).velocity.x;
      momentum += mass(k) * velocity;
      energy += mass(k) * velocity * velocity;
      if (k == 0) continue;
      EXPECT_GE(p.gap(balls[static_cast<std::size_t>(k)], balls[static_cast<std::size_t>(k) - 1]), -eps);
    }
    EXPECT_NEAR(momentum, 1.0, 1e-12) << gap;
    EXPECT_NEAR(energy, 1.0, 1e-12) << gap;
  }
}

/// A floor that shakes: a ball that is so heavy that nothing moves it follows a known course, and reaches
/// through a wall of the box, for which nobody answers.
TEST_P(Responses, ABallThatReachesThroughAWallDoesNotFloodTheLog) {
  constexpr double radius = 50.0, frequency = 60.0, amplitude = 3.0 * 9.81 / (frequency * frequency);
  definition.box = Box{{0, 0, -200}, {0.96, 0.96, 4}};
  definition.allow_overlap = true;
  Playground p(definition);
  const auto course = [](double t) {
    return State{{0.48, 0.48, -radius + amplitude * std::sin(frequency * t)},
                 {0, 0, amplitude * frequency * std::cos(frequency * t)}};
  };
  const BodyId floor = p.add({.radius = radius,
                              .acceleration_limit = 1.01 * amplitude * frequency * frequency,
                              .position = course(0.0).position,
                              .velocity = course(0.0).velocity,
                              .mass = std::numeric_limits<double>::infinity()});
  p.distort = [&](BodyId id, double time, State& state) {
    if (id == floor) state = course(time);
  };
  std::vector<BodyId> grains;
  for (int k = 0; k < 16; ++k)
    grains.push_back(p.add({.radius = 0.05,
                            .planned_acceleration = {0, 0, -9.81},
                            .position = {0.12 + 0.24 * (k % 4), 0.12 + 0.24 * (k / 4), 0.1}}));
  std::size_t with_floor = 0, with_walls = 0, guards = 0;
  p.run(
      0.5,
      [&](const Event& event) {
        guards += event.kind == EventKind::zeno_guard ? 1u : 0u;
        if (!begins(event)) return;
        if (event.wall != Wall::none && event.first == floor) {
          ++with_walls;
          return;
        }
        with_floor += event.partner_of(floor) == no_body ? 0u : 1u;
        const Bounce after = bounce(event, 0.9);
        if (event.first != floor) p.set_velocity(event.first, after.first_velocity);
        if (event.second_can_move() && event.second != floor)
          p.set_velocity(event.second, after.second_velocity);
      },
      20000);
  EXPECT_EQ(p.world.time(), 0.5);
  EXPECT_GT(with_floor, 16u);
  EXPECT_LE(with_walls, 5u) << "four walls and perhaps the lower one";
  EXPECT_LE(guards, 5u);
  for (const BodyId grain : grains)
    EXPECT_GE(norm(p.state(grain).position - course(0.5).position) - radius - 0.05, -1e-5);
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

TEST_P(Responses, ABallThatOnlySlowsDownSinksInOnce) {
  definition.box = Box{{0, 0, 0}, {10, 10, 10}};
  definition.allow_overlap = true;
  Playground p(definition);
  const BodyId ball = p.add({.position = {5, 5, 2}, .velocity = {0, 0, -3}});
  const auto events = p.run(1.0, [&](const Event& event) {
    if (begins(event)) p.set_velocity(ball, 0.9 * p.state(ball).velocity);
  });
  EXPECT_EQ(events.size(), 1u) << events;
  EXPECT_NEAR(p.state(ball).velocity.z, -2.7, 1e-12);
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

TEST_P(Responses, AContactThatBeganWithoutAnApproachReportsItsFirstOne) {
  Playground p(definition);
  const BodyId ball = p.add({.position = {2, 0, 0}});
  p.add({.position = {0, 0, 0}});
  std::vector<Event> begun;
  const auto note = [&](const Event& event) {
    if (begins(event)) begun.push_back(event);
  };
  p.run(1.0, note);
  // No one answers: of all later approaches, those in begin_and_end are not told.
  const auto course = [&](double speed, double until) {
    p.set_velocity(ball, {speed, 0, 0});
    p.run(until, note);
  };
  course(-0.5, 2.0);
  const bool ends = wants_ends(GetParam());
  ASSERT_EQ(begun.size(), ends ? 2u : 1u);
  if (ends) {
    EXPECT_EQ(begun[0].time, 0.0);
    EXPECT_FALSE(begun[0].already_touching);
  }
  EXPECT_EQ(begun.back().time, 1.0);
  EXPECT_EQ(begun.back().already_touching, ends);
  EXPECT_EQ(begun.back().approach_speed, 0.5);
  course(0.25, 3.0);
  course(-0.25, 4.0);
  EXPECT_EQ(begun.size(), (ends ? 2u : 1u) + (wants_approaches(GetParam()) ? 1u : 0u));
}

/// A fuzz of responses: crowds that touch at the start, with walls and static balls, and callers of any kind.
class RandomResponses : public testing::TestWithParam<std::tuple<ContactEvents, int>> {};

INSTANTIATE_TEST_SUITE_P(Events, RandomResponses,
                         testing::Combine(testing::Values(ContactEvents::all, ContactEvents::impacts,
                                                          ContactEvents::begin_and_end),
                                          testing::Values(0)));
INSTANTIATE_TEST_SUITE_P(Long, RandomResponses,
                         testing::Combine(testing::Values(ContactEvents::all, ContactEvents::impacts,
                                                          ContactEvents::begin_and_end),
                                          testing::Values(1000, 2000, 3000)));

TEST_P(RandomResponses, LetTimeGoOnAndBouncingBodiesNeverPass) {
  enum Caller { bounces, chooses_at_random, lets_the_second_follow, turns_back, answers_nonsense, callers };
  WorldDefinition definition{.contacts = std::get<0>(GetParam())};
  const int first = std::get<1>(GetParam());
  for (int scene = first; scene < first + 1000; ++scene) {
    SCOPED_TRACE(scene);
    Random random = Random::at(7, 0, static_cast<std::uint32_t>(scene));
    const auto caller = static_cast<Caller>(scene % callers);
    definition.box = std::nullopt;
    if (random.bits() % 2 == 0) definition.box = Box{{-1, -1, -1}, {6, 6, 1 + random.uniform(0.0, 1.0)}};
    Playground p(definition);
    std::vector<BodyId> balls;
    const int count = 2 + static_cast<int>(random.bits() % 6);
    for (int k = 0; k < count; ++k)
      balls.push_back(p.add({.acceleration_limit = random.bits() % 3 == 0 ? 1.0 : 0.0,
                             .position = {2.0 * (k % 3), 2.0 * (k / 3), 0},
                             .velocity = 3.0 * random.point_in_ball()}));
    std::optional<Ball> post;
    if (random.bits() % 3 == 0) {
      post = Ball{{2.0 * (count % 3), 2.0 * (count / 3), 0}, 1.0};
      p.world.add_static({.shape = *post}).value();
    }
    std::map<std::tuple<std::uint32_t, std::uint32_t, Wall>, std::pair<double, int>> at_instant;
    const double restitution = random.uniform(0.0, 1.0);
    bool is_guarded = false;
    const auto respond = [&](const Event& event) {
      is_guarded = is_guarded || event.kind == EventKind::zeno_guard;
      if (!begins(event)) return;
      auto& [time, times] = at_instant[{event.first.index, event.second.index, event.wall}];
      times = time == event.time ? times + 1 : 1;
      time = event.time;
      ASSERT_LE(times, 256);
      const bool both = event.second_can_move();
      if (caller == bounces) return bounce_off(p, event, restitution);
      if (caller == chooses_at_random || random.bits() % 2 == 0)
        p.set_velocity(event.first, random.point_in_ball());
      if (caller == lets_the_second_follow && both) p.set_velocity(event.second, event.first_state.velocity);
      if (caller == turns_back && both) p.set_velocity(event.second, -event.second_state.velocity);
      if (caller == answers_nonsense) {
        EXPECT_FALSE(p.world.set_velocity(event.first, {std::nan(""), 0, 0}));
      }
    };
    for (int tick = 1; tick <= 4; ++tick) {
      const auto events = p.run(0.5 * tick, respond, 20000);
      if (HasFailure()) return;
      ASSERT_EQ(p.world.time(), 0.5 * tick);
      ASSERT_TRUE(is_clean(p.world));
      if (caller != bounces || is_guarded) continue;
      for (std::size_t a = 0; a < balls.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) ASSERT_GE(p.gap(balls[a], balls[b]), -eps);
        const Vec3 at = p.state(balls[a]).position;
        const double from_post = post ? norm(at - post->centre) - 2.0 : 0.0;
        ASSERT_GE(from_post, -eps);
        for (int axis = 0; axis < 3 && definition.box; ++axis) {
          ASSERT_GE(at[axis] - 1.0, definition.box->lower[axis] - eps);
          ASSERT_LE(at[axis] + 1.0, definition.box->upper[axis] + eps);
        }
      }
    }
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
