// A motion source with bad answers of states() now and then: World::run refuses each, also if a response
// changes velocities, and continues as if nothing had happened.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"
#include "world/bouncing_world.hpp"

namespace kinesphere::glitching_source_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

/// Returns an invalid state of a body in a world in the plane.
State bad_state(std::uint64_t kind) {
  const std::vector<State> all{{{nan, 0, 0}, {}}, {{0, -inf, 0}, {}}, {{0, 1e300, 0}, {}},
                               {{0, 0, 1}, {}},   {{}, {0, nan, 0}},  {{}, {1e200, 0, 0}}};
  return all[kind % all.size()];
}

/// Two bodies that meet at time 1.5 and bounce, and two more that do so at the same instant: they are asked
/// for last, so a run asks again for the states of the first two when these are answered.
class TwoPairs final : public MotionSource {
 public:
  TwoPairs() {
    for (const Vec3& place : {Vec3{0, 0, 0}, Vec3{5, 0, 0}, Vec3{0, 9, 0}, Vec3{5, 9, 0}}) {
      const State state{place, {place.x > 0.0 ? -1.0 : 1.0, 0, 0}};
      world.add({.radius = 1, .position = state.position, .velocity = state.velocity}).value();
      departures.push_back({0.0, state});
    }
  }
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const MotionOrigin& from = departures[ids[k].index];
      if (turning && ids[k].index == glitches) {
        if (bad) states[k] = *bad;
      } else {
        states[k] = {from.state.position + from.state.velocity * (time - from.time), from.state.velocity};
      }
    }
  }
  MotionOrigin origin(BodyId body) const override { return departures[body.index]; }
  void set_origin(BodyId body, const MotionOrigin& origin) override { departures[body.index] = origin; }

  Result<void> run(double until) {
    const auto respond = [this](const Event& event) -> Response {
      turning = event.kind == EventKind::contact_begin;
      if (!turning) return {};
      return {Vec3{-1, 0, 0}, Vec3{1, 0, 0}};
    };
    auto result = world.run(until, *this, respond, [this](const Event& event) {
      turning = false;
      reported.push_back(event);
    });
    turning = false;
    return result;
  }

  World world = World::create({.dimensions = 2, .contacts = ContactEvents::impacts}).value();
  std::vector<MotionOrigin> departures;
  std::vector<Event> reported;
  std::uint32_t glitches = no_body.index;  ///< this body, while an answer turns it
  std::optional<State> bad;                ///< or nothing is written
  bool turning = false;
};

TEST(GlitchingSource, IsRefusedWhileAnAnswerTurnsABody) {
  for (std::uint64_t kind = 0; kind < 7; ++kind) {
    for (const std::uint32_t body : {0u, 1u}) {
      TwoPairs balls;
      balls.glitches = body;
      if (kind < 6) balls.bad = bad_state(kind);
      expect_error(balls.run(10.0),
                   kind < 2 || kind == 4 || kind == 6 ? ErrorCode::not_finite : ErrorCode::out_of_range,
                   kind == 4 || kind == 5 ? "velocity" : "position", "run: the probe's answer at time 1.4999",
                   balls.world.bodies()[body]);
      // No body has a new origin, and no event was delivered.
      for (const MotionOrigin& origin : balls.departures) EXPECT_EQ(origin.time, 0.0);
      EXPECT_TRUE(balls.reported.empty());
      EXPECT_TRUE(is_clean(balls.world));
      balls.glitches = no_body.index;
      EXPECT_TRUE(balls.run(10.0));
      ASSERT_EQ(balls.reported.size(), 2u);
      EXPECT_EQ(balls.reported[0].kind, EventKind::contact_begin);
      EXPECT_NEAR(balls.departures[0].state.position.x, 1.5, 1e-6);
      EXPECT_NEAR(balls.departures[1].state.position.x, 3.5, 1e-6);
    }
  }
}

TEST(TwoPairs, SinkMayMoveWhatWasAskedFor) {
  TwoPairs balls;
  const auto respond = [](const Event& event) -> Response {
    if (event.first.index == 0) return {.stop = true};
    return {Vec3{0, 1, 0}, Vec3{0, -1, 0}};
  };
  // The run has asked for the states of the other two at this time, for their contact. They touch at another
  // place then.
  const State above{{3.5, 11, 0}, {0, -1, 0}};
  const auto sink = [&](const Event& event) {
    balls.reported.push_back(event);
    if (event.first.index != 0) return;
    balls.world.teleport(balls.world.bodies()[2], above).value();
    balls.departures[2] = {event.time, above};
  };
  balls.world.run(3.0, balls, respond, sink).value();
  ASSERT_EQ(balls.reported.size(), 2u);
  EXPECT_EQ(balls.departures[2].time, balls.reported[1].time);
  EXPECT_EQ(balls.departures[2].state.position, above.position);
  EXPECT_TRUE(is_clean(balls.world));
}

/// Bodies that bounce in a flat box.
struct Bouncing : BouncingWorld<RandomForces> {
  Bouncing()
      : BouncingWorld(
            RandomForces::create({.start = start(), .acceleration_limits = std::vector<double>(1024, 0.0)})
                .value(),
            World::create({.box = Box{{0, 0, 0}, {64, 64, 0}}, .dimensions = 2}).value(), 1.0) {
    for (std::uint32_t number = 0; number < motion.size(); ++number) {
      BodyDefinition body = next();
      body.radius = 0.6;
      add(body, 1.0);
    }
  }
  static std::vector<State> start() {
    Random random(17);
    std::vector<State> states;
    for (int k = 0; k < 1024; ++k) {
      State state{{1.0 + 2.0 * (k % 32), 1.0 + 2.0 * (k / 32), 0.0}, 3.0 * random.point_in_ball()};
      state.velocity.z = 0.0;
      states.push_back(state);
    }
    return states;
  }
};

/// Answers wrongly after every few calls of states().
class Glitching final : public MotionSource {
 public:
  Glitching(RandomForces& motion, std::uint64_t period) : mover_(motion), period_(period) {}
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    mover_.states(ids, time, states);
    const std::uint64_t call = ++calls_;
    if (call % period_ == 0) states[call % states.size()] = bad_state(call / period_);
  }
  MotionOrigin origin(BodyId body) const override { return mover_.origin(body); }
  void set_origin(BodyId body, const MotionOrigin& origin) override {
    EXPECT_TRUE(is_finite(origin.state.position) && norm(origin.state.position) < 1e3);
    mover_.set_origin(body, origin);
  }

 private:
  SingleMotionSource mover_;
  std::uint64_t period_;
  std::atomic<std::uint64_t> calls_ = 0;
};

TEST(GlitchingSource, ChangesNothingThatIsTold) {
  Bouncing expected;
  expected.loop(3.0);
  EXPECT_GT(expected.reported, 1000u);
  for (const int threads : {1, 2, 3}) {
    for (const std::uint64_t period : {61u, 1009u}) {
      Bouncing found;
      Glitching source(found.motion, period);
      Workers workers = Workers::create(threads).value();
      int errors = 0;
      for (;;) {
        const auto run = found.world.run(
            3.0, source, [&](const Event& event) { return found.answer(event); },
            [&](const Event& event) { found.tell(event); }, &workers);
        if (run) break;
        ASSERT_LT(++errors, 10000);
        EXPECT_EQ(run.error().message.rfind("run: the probe's answer at time ", 0), 0u)
            << run.error().message;
      }
      EXPECT_GT(errors, threads == 1 ? 5 : -1) << period;
      EXPECT_EQ(found.reported, expected.reported) << threads << " threads, period " << period;
      EXPECT_EQ(found.hash.value(), expected.hash.value());
      EXPECT_TRUE(is_clean(found.world));
    }
  }
}

}  // namespace
}  // namespace kinesphere::glitching_source_test
