// World::run by several threads: the same events as a loop over advance(), to the last bit.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/workers.hpp"
#include "support/playground.hpp"

namespace kinesphere {
namespace {

struct Kind {
  std::string name;
  int side = 12;  ///< so many bodies along each axis
  double spacing = 2.4;
  double faster = 1.0;  ///< one in a hundred starts so many times as fast
  ContactMode contacts = ContactMode::begin_and_end;
  bool periodic = false;
  bool sensors = false;
  bool fixed = false;
  bool passes = false;  ///< nobody answers
  double end = 3.0;
};

/// Bodies of some sizes that bounce in a box.
struct Hall {
  explicit Hall(const Kind& hall)
      : kind(hall),
        motion(RandomForces::create({.start = start(), .acceleration_limits = std::vector(count(), 6.0)})
                   .value()),
        world(World::create(definition()).value()) {
    for (std::uint32_t number = 0; number < motion.size(); ++number) {
      BodyDefinition body = motion.definition(number, 0.0);
      body.radius = radius(number);
      if (kind.sensors && number % 5 == 0) body.sensor_class = 1;
      world.add(body).value();
    }
    if (kind.sensors) world.set_sensor(1, {.distances = {0.3, 0.6}}).value();
    if (!kind.fixed) return;
    // Between the rows.
    const double lower = 0.5 * kind.spacing * 2.0;
    for (int k = 0; k < 3; ++k)
      world.add_fixed({.shape = Ball{{lower + k * 2 * kind.spacing, lower, lower}, 0.3}}).value();
    world.add_zone(Box{{5, 5, 5}, {12, 12, 12}}).value();
  }

  Answer answer(const Event& event) const {
    const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
    if (!begins || event.approach_speed <= 0.0) return {};
    const Bounce after = bounce(event, mass(event.first), mass(event.second), 0.98);
    Answer given;
    if (std::isfinite(mass(event.first))) given.first_velocity = after.first_velocity;
    if (event.second != no_body && std::isfinite(mass(event.second)))
      given.second_velocity = after.second_velocity;
    return given;
  }
  double mass(BodyId body) const {
    if (body == no_body) return 1.0;
    if (body.index >= motion.size()) return std::numeric_limits<double>::infinity();
    return radius(body.index) * radius(body.index) * radius(body.index);
  }
  void tell(const Event& event) {
    hash.add(event);
    ++told;
    EXPECT_GE(event.time, last);
    last = event.time;
  }

  void loop() {
    while (const auto event = world.advance(kind.end, motion.probe()).value()) {
      const Answer given = kind.passes ? Answer{} : answer(*event);
      const auto kick = [&](BodyId body, const std::optional<Vec3>& velocity) {
        if (!velocity) return;
        motion.set_velocity(body.index, event->time, *velocity).value();
        world.set_velocity(body, *velocity).value();
      };
      kick(event->first, given.first_velocity);
      kick(event->second, given.second_velocity);
      tell(*event);
    }
  }
  void run(Workers& workers, double until) {
    MotionMover mover(motion);
    const auto sink = [this](const Event& event) { tell(event); };
    if (kind.passes) {
      world.run(until, motion.probe(), sink, &workers).value();
    } else {
      world
          .run(
              until, mover, [this](const Event& event) { return answer(event); }, sink, &workers)
          .value();
    }
  }

  Kind kind;
  RandomForces motion;
  World world;
  EventHash hash;
  std::size_t told = 0;
  double last = 0.0;

 private:
  std::size_t count() const { return static_cast<std::size_t>(kind.side * kind.side * kind.side); }
  double radius(std::uint32_t number) const { return number % 7 == 0 ? 0.7 : number % 3 == 0 ? 0.5 : 0.2; }
  WorldDefinition definition() const {
    const double size = kind.side * kind.spacing;
    WorldDefinition made{.box = Box{{0, 0, 0}, {size, size, size}}, .contacts = kind.contacts};
    if (kind.periodic) made.periodic = {true, true, true};
    return made;
  }
  std::vector<State> start() const {
    Random random(7);
    std::vector<State> states;
    for (std::size_t k = 0; k < count(); ++k) {
      const auto side = static_cast<std::size_t>(kind.side);
      const auto at = [&](std::size_t place) { return kind.spacing * (double(place % side) + 0.5); };
      states.push_back({{at(k), at(k / side), at(k / side / side)}, 3.0 * random.point_in_ball()});
      if (k % 100 == 50) states.back().velocity *= kind.faster;
    }
    return states;
  }
};

class Islands : public ::testing::TestWithParam<Kind> {};

TEST_P(Islands, AreAsOneLoop) {
  Hall looped(GetParam());
  looped.loop();
  EXPECT_GT(looped.told, 300u);
  for (const int threads : {1, 2, 3, 8}) {
    Workers workers = Workers::create(threads).value();
    Hall run(GetParam());
    for (const double part : {0.01, 0.3, 0.3, 1.0}) run.run(workers, part * run.kind.end);
    EXPECT_EQ(run.told, looped.told) << threads << " threads";
    EXPECT_EQ(run.hash.value(), looped.hash.value()) << threads << " threads";
    EXPECT_EQ(run.world.counters().probes, looped.world.counters().probes) << threads << " threads";
    EXPECT_TRUE(is_clean(run.world)) << threads << " threads";
  }
}

/// Throws at the events from a time on, until it is told not to.
TEST(IslandsThatFail, LeaveAWorldThatGoesOnAsIfNothingHadHappened) {
  const Kind kind{.name = "failing", .sensors = true, .fixed = true};
  Hall looped(kind);
  looped.loop();
  Workers workers = Workers::create(3).value();
  Hall run(kind);
  MotionMover mover(run.motion);
  std::atomic<double> fails_from = 1.0;
  const auto respond = [&](const Event& event) {
    if (event.time >= fails_from) throw std::runtime_error("no answer");
    return run.answer(event);
  };
  const auto sink = [&](const Event& event) { run.tell(event); };
  for (const double next : {1.5, 2.2, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)run.world.run(kind.end, mover, respond, sink, &workers), std::runtime_error);
    EXPECT_LE(run.last, fails_from);
    fails_from = next;
  }
  EXPECT_TRUE(run.world.run(kind.end, mover, respond, sink, &workers));
  EXPECT_EQ(run.told, looped.told);
  EXPECT_EQ(run.hash.value(), looped.hash.value());
  EXPECT_TRUE(is_clean(run.world));
}

/// An answer that is refused once is asked for again.
TEST(IslandsThatFail, GoOnWhenTheyFailNoMore) {
  const Kind kind{.name = "failing once"};
  Hall looped(kind);
  looped.loop();
  Workers workers = Workers::create(2).value();
  Hall run(kind);
  MotionMover mover(run.motion);
  std::atomic<int> asked = 0;
  const auto respond = [&](const Event& event) {
    Answer answer = run.answer(event);
    if (++asked % 400 == 0) answer.first_velocity = Vec3{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
    return answer;
  };
  const auto sink = [&](const Event& event) { run.tell(event); };
  int refused = 0;
  for (;;) {
    const auto result = run.world.run(kind.end, mover, respond, sink, &workers);
    if (result) break;
    EXPECT_EQ(result.error().code, ErrorCode::not_finite);
    ASSERT_LT(++refused, 100);
  }
  EXPECT_EQ(run.told, looped.told);
  EXPECT_EQ(run.hash.value(), looped.hash.value());
}

INSTANTIATE_TEST_SUITE_P(Of, Islands,
                         ::testing::Values(Kind{.name = "bouncing"},
                                           Kind{.name = "impacts", .contacts = ContactMode::impacts},
                                           Kind{.name = "dense", .side = 9, .spacing = 1.45, .end = 1.0},
                                           Kind{.name = "bullets", .faster = 60.0},
                                           Kind{.name = "periodic", .periodic = true},
                                           Kind{.name = "sensors", .sensors = true},
                                           Kind{.name = "fixed", .sensors = true, .fixed = true},
                                           Kind{.name = "passing", .sensors = true, .passes = true}),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace kinesphere
