// World::run: equal to a loop over advance(), also after failures in callbacks.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"
#include "world/bouncing_world.hpp"

namespace kinesphere::run_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double end = 16.0;

/// Bodies that bounce in a box around a post.
struct Bouncing : BouncingWorld<RandomForces> {
  Bouncing()
      : BouncingWorld(RandomForces::create({.start = start(), .acceleration_limits = limits()}).value(),
                      World::create({.box = Box{{0, 0, 0}, {12, 12, 12}}}).value(), 0.95) {
    for (std::uint32_t number = 0; number < motion.size(); ++number) {
      BodyDefinition body = next();
      body.radius = 0.4;
      body.sensor_class = number % 2 == 0 ? 1 : 0;
      add(body, 1.0);
    }
    world.set_sensor(1, {.distances = {0.5}}).value();
    world.add_static({.shape = Ball{{6, 6, 6}, 1.5}}).value();
  }

  void loop(double until = end) { BouncingWorld::loop(until); }
  Result<void> run(double until = end) { return BouncingWorld::run(until); }

 private:
  static std::vector<State> start() {
    Random random(5);
    std::vector<State> states;
    for (int k = 0; k < 64; ++k) {
      states.push_back({{1.0 + 3.0 * (k % 4), 1.0 + 3.0 * (k / 4 % 4), 1.0 + 3.0 * (k / 16)},
                        4.0 * random.point_in_ball()});
    }
    return states;
  }
  static std::vector<double> limits() { return std::vector<double>(64, 5.0); }
};

void expect_same_end(const Bouncing& found, const Bouncing& expected) {
  EXPECT_EQ(found.reported, expected.reported);
  EXPECT_EQ(found.hash.value(), expected.hash.value());
  EXPECT_EQ(found.world.save().value(), expected.world.save().value());
}

TEST(Run, DoesWhatALoopDoesToTheLastBit) {
  Bouncing looped, run;
  looped.world.start_recording().value();
  run.world.start_recording().value();
  looped.loop();
  for (const double until : {1.0, 1.0, 2.5, 9.0, end}) {
    EXPECT_TRUE(run.run(until));
    EXPECT_EQ(run.world.time(), until);
  }
  EXPECT_GT(run.world.counters().count(EventKind::contact_begin), 100u);
  EXPECT_GT(run.world.counters().count(EventKind::wall_begin), 100u);
  EXPECT_GT(run.world.counters().count(EventKind::sensor_enter), 10u);
  EXPECT_EQ(run.reported, looped.reported);
  EXPECT_EQ(run.hash.value(), looped.hash.value());
  EXPECT_TRUE(is_clean(run.world));

  Replay replay = Replay::open(run.world.stop_recording().value()).value();
  EventHash replayed;
  while (!replay.finished())
    if (const auto event = replay.advance().value()) replayed.add(*event);
  EXPECT_EQ(replayed.value(), looped.hash.value());
}

TEST(Run, LeavesTheWorldAsALoopDoes) {
  Bouncing looped, run;
  looped.loop();
  run.run().value();
  expect_same_end(run, looped);
}

TEST(Run, NeedsNoMoverWhereNobodyAnswers) {
  Bouncing looped, run;
  while (const auto event = looped.world.advance(end, looped.motion.probe()).value()) looped.tell(*event);
  run.world.run(end, run.motion.probe(), [&](const Event& event) { run.tell(event); }).value();
  EXPECT_GT(run.reported, 20u);
  expect_same_end(run, looped);
}

TEST(Run, TimesWhatItDoes) {
  Bouncing run;
  run.world.set_profiling(true).value();
  run.run().value();
  EXPECT_EQ(run.world.inspection().timings().advances, run.reported + 1);
  EXPECT_GT(run.world.inspection().timings().probes, 0.0);
}

TEST(Run, MovesBodiesOfAMap) {
  Ballistic balls = Ballistic::create({.start = {{{9, 9, 9}, {}}, {{0, 0, 0}, {2, 0, 0}}}}).value();
  SteeredMotion targets =
      SteeredMotion::create({.start = {{{10, 0, 0}, {}}}, .acceleration_limits = {1.0}}).value();
  World world = World::create({}).value();
  BodyMap bodies;
  const BodyId target = bodies.add(world, targets, 0, {.radius = 1}).value();
  const BodyId ball = bodies.add(world, balls, 1, {.radius = 1}).value();
  auto source = bodies.source();
  std::vector<EventKind> kinds;
  world
      .run(
          6.0, source,
          [&](const Event& event) -> Response {
            if (event.kind != EventKind::contact_begin) return {};
            EXPECT_EQ(event.first, target);
            return {.first_velocity = Vec3{2, 0, 0}, .second_velocity = Vec3{-1, 0, 0}};
          },
          [&](const Event& event) { kinds.push_back(event.kind); })
      .value();
  EXPECT_EQ(kinds, (std::vector{EventKind::contact_begin, EventKind::contact_end}));
  EXPECT_NEAR(bodies.state(ball, 6.0).position.x, 8.0 - 2.0, 1e-5);
  EXPECT_NEAR(bodies.state(target, 6.0).position.x, 10.0 + 4.0, 1e-5);
  try {
    (void)source.origin({7, 0});
    ADD_FAILURE() << "nothing was thrown";
  } catch (const BadResult& thrown) {
    EXPECT_EQ(thrown.error().code, ErrorCode::unknown_body) << thrown.what();
  }
}

// Interruptions.

struct Interruption {};

/// Throws at one of its calls, once.
class Fuse {
 public:
  explicit Fuse(std::size_t calls) : calls_(calls) {}
  void burn() {
    if (++burnt_ == calls_) throw Interruption();
  }
  bool has_blown() const { return burnt_ >= calls_; }

 private:
  std::size_t calls_;
  std::size_t burnt_ = 0;
};

/// A motion source that wraps another one.
class Guarded final : public MotionSource {
 public:
  explicit Guarded(Motion& motion) : mover_(motion) {}

  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    if (at_states) at_states();
    mover_.states(ids, time, states);
  }
  MotionOrigin origin(BodyId body) const override {
    if (at_departure) at_departure();
    return mover_.origin(body);
  }
  void set_origin(BodyId body, const MotionOrigin& origin) override {
    if (at_depart) at_depart();
    mover_.set_origin(body, origin);
  }

  std::function<void()> at_states, at_departure, at_depart;

 private:
  SingleMotionSource mover_;
};

/// Runs with a callback that blows the fuse, and continues each time: the world is unaffected.
void expect_no_trace(const std::function<void(Bouncing&, Guarded&, Fuse&, std::function<void()>& at_respond,
                                              std::function<void()>& at_tell)>& plant,
                     bool probes_again = false) {
  Bouncing expected;
  expected.loop();
  for (const std::size_t calls : {1u, 2u, 3u, 4u, 5u, 6u, 50u, 51u, 52u, 200u}) {
    SCOPED_TRACE(calls);
    Bouncing run;
    Guarded source(run.motion);
    Fuse fuse(calls);
    std::function<void()> at_respond, at_tell;
    plant(run, source, fuse, at_respond, at_tell);
    std::size_t interruptions = 0;
    for (bool done = false; !done;) {
      try {
        run.world
            .run(
                end, source,
                [&](const Event& event) {
                  if (at_respond) at_respond();
                  return run.answer(event);
                },
                [&](const Event& event) {
                  run.tell(event);
                  if (at_tell) at_tell();
                })
            .value();
        done = true;
      } catch (const Interruption&) {
        ASSERT_EQ(++interruptions, 1u);
      }
    }
    EXPECT_TRUE(fuse.has_blown());
    EXPECT_EQ(interruptions, 1u);
    EXPECT_EQ(run.reported, expected.reported);
    EXPECT_EQ(run.hash.value(), expected.hash.value());
    // A probe that throws has been counted.
    if (!probes_again) {
      EXPECT_EQ(run.world.save().value(), expected.world.save().value());
    }
  }
}

TEST(InterruptedRun, GoesOnAfterStatesThrew) {
  expect_no_trace(
      [](Bouncing&, Guarded& source, Fuse& fuse, auto&, auto&) { source.at_states = [&] { fuse.burn(); }; },
      true);
}

TEST(InterruptedRun, GoesOnAfterDepartureThrew) {
  expect_no_trace([](Bouncing&, Guarded& source, Fuse& fuse, auto&, auto&) {
    source.at_departure = [&] { fuse.burn(); };
  });
}

TEST(InterruptedRun, GoesOnAfterDepartThrew) {
  expect_no_trace(
      [](Bouncing&, Guarded& source, Fuse& fuse, auto&, auto&) { source.at_depart = [&] { fuse.burn(); }; });
}

TEST(InterruptedRun, GoesOnAfterRespondThrew) {
  expect_no_trace(
      [](Bouncing&, Guarded&, Fuse& fuse, auto& at_respond, auto&) { at_respond = [&] { fuse.burn(); }; });
}

TEST(InterruptedRun, GoesOnAfterTheSinkThrew) {
  expect_no_trace(
      [](Bouncing&, Guarded&, Fuse& fuse, auto&, auto& at_tell) { at_tell = [&] { fuse.burn(); }; });
}

TEST(InterruptedRun, ChangesNeitherBodyWhenTheSecondDepartureThrows) {
  Bouncing run;
  Guarded source(run.motion);
  std::optional<Event> last;
  std::vector<MotionOrigin> before;
  int departures = 0;
  source.at_depart = [&] {
    if (++departures == 2) throw Interruption();
  };
  const auto respond = [&](const Event& event) {
    const Response answer = run.answer(event);
    if (!answer.second_velocity) return Response{};
    last = event;
    before = {run.motion.origin(event.first.index), run.motion.origin(event.second.index)};
    return answer;
  };
  EXPECT_THROW((void)run.world.run(end, source, respond, [](const Event&) {}), Interruption);
  ASSERT_TRUE(last);
  EXPECT_EQ(departures, 3) << "the first one was taken back";
  const auto same = [](const MotionOrigin& a, const MotionOrigin& b) {
    return a.time == b.time && a.state == b.state;
  };
  EXPECT_TRUE(same(run.motion.origin(last->first.index), before[0]));
  EXPECT_TRUE(same(run.motion.origin(last->second.index), before[1]));
  EXPECT_TRUE(is_clean(run.world));
}

/// Runs until the first contact, which stays without a response.
std::optional<Event> interrupt(Bouncing& run) {
  std::optional<Event> at;
  SingleMotionSource source(run.motion);
  const auto respond = [&](const Event& event) -> Response {
    if (event.kind != EventKind::contact_begin) return run.answer(event);
    at = event;
    throw Interruption();
  };
  EXPECT_THROW((void)run.world.run(end, source, respond, [&](const Event& event) { run.tell(event); }),
               Interruption);
  return at;
}

TEST(InterruptedRun, HandsTheEventToALoop) {
  Bouncing expected, run;
  expected.loop();
  ASSERT_TRUE(interrupt(run));
  run.loop();
  expect_same_end(run, expected);
}

TEST(InterruptedRun, IsClonedWithWhatIsLeft) {
  Bouncing run;
  const auto at = interrupt(run);
  ASSERT_TRUE(at);
  World copy = run.world.clone().value();
  const World moved = std::exchange(run.world, World::create({}).value());
  for (const auto& event : {copy.advance(end, run.motion.probe()).value()}) {
    ASSERT_TRUE(event);
    EXPECT_EQ(event->time, at->time);
    EXPECT_EQ(event->first, at->first);
  }
}

TEST(InterruptedRun, CannotBeSavedOrRecordedYet) {
  Bouncing run;
  run.world.start_recording().value();
  ASSERT_TRUE(interrupt(run));
  const auto too_early = ErrorCode::run_in_progress;
  expect_error(run.world.save(), too_early, "world", "save:");
  expect_error(run.world.start_recording(), too_early, "world", "start_recording:");
  expect_error(run.world.stop_recording(), too_early, "world", "stop_recording:");
  EXPECT_TRUE(is_clean(run.world));
  EXPECT_TRUE(run.world.advance(run.world.time(), run.motion.probe()).value());
  EXPECT_TRUE(run.world.save());
  EXPECT_TRUE(run.world.stop_recording());
}

// Wrong calls.

const auto silent = [](const Event&) {};
const auto no_answer = [](const Event&) { return Response{}; };

TEST(WrongRun, IsRefusedByArgument) {
  Bouncing b;
  SingleMotionSource source(b.motion);
  const std::vector<std::byte> before = b.world.save().value();
  const std::function<Response(const Event&)> no_respond;
  const std::function<void(const Event&)> no_sink;
  expect_error(b.world.run(1.0, source, no_respond, silent), ErrorCode::null_callback, "respond", "run:");
  expect_error(b.world.run(1.0, source, no_answer, no_sink), ErrorCode::null_callback, "sink", "run:");
  expect_error(b.world.run(1.0, source, ResponseFn::Function{nullptr}, silent), ErrorCode::null_callback,
               "respond", "run:");
  expect_error(b.world.run(1.0, b.motion.probe(), no_sink), ErrorCode::null_callback, "sink", "run:");
  expect_error(b.world.run(1.0, Probe::Function{nullptr}, silent), ErrorCode::null_probe, "probe", "run:");
  expect_error(b.world.run(nan, source, no_answer, silent), ErrorCode::not_finite, "until", "run:");
  expect_error(b.world.run(-1.0, source, no_answer, silent), ErrorCode::time_backwards, "until", "run:");
  expect_error(b.world.run(-1.0, b.motion.probe(), silent), ErrorCode::time_backwards, "until", "run:");
  EXPECT_EQ(b.world.save().value(), before);
  const World taken = std::move(b.world);
  // NOLINTBEGIN(bugprone-use-after-move): that is what is tested.
  expect_error(b.world.run(1.0, source, no_answer, silent), ErrorCode::moved_from, "world", "run:");
  expect_error(b.world.run(1.0, b.motion.probe(), silent), ErrorCode::moved_from, "world", "run:");
  // NOLINTEND(bugprone-use-after-move)
}

TEST(WrongRun, NamesTheBodyOfABadState) {
  Bouncing b;
  const auto lost = [](std::span<const BodyId>, double, std::span<State>) {};
  const auto run = b.world.run(end, lost, [&](const Event& event) { b.tell(event); });
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, ErrorCode::not_finite);
  EXPECT_EQ(run.error().message.rfind("run: the probe's answer", 0), 0u) << run.error().message;
  EXPECT_NE(run.error().body, no_body);
  Bouncing expected;
  expected.loop();
  b.run().value();
  EXPECT_EQ(b.hash.value(), expected.hash.value());
}

/// Responds to the first event of a kind with a wrong value, which is refused by name; then continues
/// normally.
void expect_refused(EventKind kind, const std::function<Response(const Event&)>& wrong, ErrorCode code,
                    const std::string& argument, bool of_second) {
  Bouncing b, expected;
  expected.loop();
  SingleMotionSource source(b.motion);
  std::optional<Event> at;
  const auto respond = [&](const Event& event) {
    if (event.kind != kind) return b.answer(event);
    const Response answer = wrong(event);
    if (!answer.first_velocity && !answer.second_velocity) return b.answer(event);
    at = event;
    return answer;
  };
  const auto sink = [&](const Event& event) { b.tell(event); };
  const auto run = b.world.run(end, source, respond, sink);
  ASSERT_TRUE(at);
  expect_error(run, code, argument, "run: respond: " + argument + " at " + std::string(name_of(kind)),
               of_second ? at->second : at->first);
  EXPECT_EQ(b.world.time(), at->time);
  b.run().value();
  EXPECT_EQ(b.reported, expected.reported);
  EXPECT_EQ(b.hash.value(), expected.hash.value());
}

TEST(WrongRun, NamesTheBodyOfAnAnswerThatIsNone) {
  const auto nothing = [](const Event&) { return Response{.first_velocity = Vec3{0, nan, 0}}; };
  expect_refused(EventKind::contact_begin, nothing, ErrorCode::not_finite, "first_velocity", false);
  const auto second = [](const Event& event) {
    return event.second == BodyId{64, 0} ? Response{} : Response{Vec3{1, 0, 0}, Vec3{0, 0, 1e200}};
  };
  expect_refused(EventKind::contact_begin, second, ErrorCode::out_of_range, "second_velocity", true);
}

TEST(WrongRun, NamesWhatCannotBeGivenAVelocity) {
  const auto post = [](const Event& event) {
    return event.second == BodyId{64, 0} ? Response{.second_velocity = Vec3{}} : Response{};
  };
  expect_refused(EventKind::contact_begin, post, ErrorCode::static_body, "second_velocity", true);
  const auto wall = [](const Event&) { return Response{.second_velocity = Vec3{}}; };
  expect_refused(EventKind::wall_begin, wall, ErrorCode::unknown_body, "second_velocity", true);
}

TEST(Run, GivesNoVelocityToABodyThatHasGone) {
  Ballistic motion = Ballistic::create({.start = {{{0, 0, 0}, {}}, {{1.5, 0, 0}, {}}}}).value();
  World world = World::create({}).value();
  for (std::uint32_t k = 0; k < 2; ++k) world.add(motion.definition(k, 0.0)).value();
  ASSERT_TRUE(world.advance(1.0, motion.probe()).value());
  world.remove(BodyId{1, 0}).value();
  SingleMotionSource source(motion);
  const auto respond = [](const Event&) { return Response{Vec3{0, 1, 0}, Vec3{0, 2, 0}}; };
  std::vector<EventKind> kinds;
  world.run(1.0, source, respond, [&](const Event& event) { kinds.push_back(event.kind); }).value();
  EXPECT_EQ(kinds, std::vector{EventKind::contact_end});
  EXPECT_EQ(motion.state(0, 1.0).velocity, (Vec3{0, 1, 0}));
  EXPECT_EQ(motion.state(1, 1.0).velocity, Vec3{});
}

/// Expects that calls forbidden inside a run are refused by name.
void expect_refused_inside(Bouncing& b) {
  const auto busy = ErrorCode::run_in_progress;
  SingleMotionSource source(b.motion);
  expect_error(b.world.run(end, source, no_answer, silent), busy, "world", "run:");
  expect_error(b.world.run(end, b.motion.probe(), silent), busy, "world", "run:");
  expect_error(b.world.advance(end, b.motion.probe()), busy, "world", "advance:");
  expect_error(b.world.set_velocity({3, 0}, {}), busy, "world", "set_velocity:");
  expect_error(b.world.add({}), busy, "world", "add:");
  expect_error(b.world.remove(BodyId{3, 0}), busy, "world", "remove:");
  expect_error(b.world.save(), busy, "world", "save:");
  expect_error(b.world.clone(), busy, "world", "clone:");
  expect_error(b.world.start_recording(), busy, "world", "start_recording:");
  expect_error(b.world.queries().overlapping({6, 6, 6}, 1.0), busy, "world", "overlapping:");
  EXPECT_EQ(b.world.inspection().audit()->where, "call");
}

TEST(WrongRun, RefusesCallsFromInside) {
  Bouncing expected, b;
  expected.loop();
  Guarded source(b.motion);
  int inside = 0;
  const auto ask = [&] {
    if (++inside % 50 == 1) expect_refused_inside(b);
  };
  source.at_states = source.at_departure = source.at_depart = ask;
  const auto respond = [&](const Event& event) {
    ask();
    return b.answer(event);
  };
  const auto sink = [&](const Event& event) {
    ask();
    b.tell(event);
    EXPECT_GE(b.world.time(), event.time);
    EXPECT_TRUE(b.world.body(event.first));
    EXPECT_TRUE(b.world.touching(event.first));
    EXPECT_TRUE(b.world.sensor_overlaps(event.first));
  };
  b.world.run(end, source, respond, sink).value();
  EXPECT_GT(inside, 1000);
  expect_same_end(b, expected);
}

TEST(WorldInItsOwnRunDeathTest, StopsTheProgramWhenItGoes) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(
      {
        auto b = std::make_unique<Bouncing>();
        (void)b->world.run(end, b->motion.probe(),
                           [&](const Event&) { const World taken = std::move(b->world); });
      },
      "a World was moved from inside its own run");
}

}  // namespace
}  // namespace kinesphere::run_test
