// Window starts that are prepared in slices (WorldDefinition::spread_window_starts): a world with them tells
// the same events as one without, whatever happens to its bodies meanwhile, and no frame has all the work.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/limits.hpp"
#include "support/eager_workers.hpp"
#include "support/in_windows.hpp"
#include "support/playground.hpp"
#include "world/bouncing_world.hpp"

namespace kinesphere::spread_window_starts_test {
namespace {

constexpr std::uint64_t seed = 7301;
constexpr double edge = 16.0;
constexpr double frame = 1.0 / 60.0;

struct Kind {
  const char* name;
  ContactEvents contacts = ContactEvents::begin_and_end;
  bool walls = true;
  double limit = 0.0;  ///< largest acceleration limit of the bodies
  double noise = 0.0;  ///< largest position and velocity error
  bool fixed = false;  ///< there are static bodies and a zone, some of which come and go
  bool sensors = false;
  double faster = 1.0;  ///< one in twenty is so many times as fast
  int dimensions = 3;
  int changes = 6;  ///< in each frame

  friend std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }
};

/// A crowd of bodies that pass through each other. What happens to them does not depend on events.
class Passage : public Playground {
 public:
  Passage(const Kind& kind, bool spreads, std::size_t bodies = 400)
      : Playground({.box = kind.walls ? std::optional(room(kind)) : std::nullopt,
                    .dimensions = kind.dimensions,
                    .contact_tolerance = 1e-6,
                    .separation_distance = 1e-5 + 8.0 * kind.noise,
                    .contacts = kind.contacts,
                    .spread_window_starts = spreads}),
        kind_(kind),
        random_(seed),
        errors_(seed + 1) {
    use_windows(world);
    distort = [this](BodyId, double, State& state) {
      if (kind_.noise == 0.0) return;
      state.position += flat(0.999 * kind_.noise * errors_.point_in_ball());
      state.velocity += flat(0.999 * kind_.noise * errors_.point_in_ball());
    };
    if (kind.sensors) world.set_sensor(1, {.distances = {0.3, 0.1}}).value();
    for (std::size_t k = 0; k < bodies; ++k) join();
    if (kind.fixed)
      for (int k = 0; k < 12; ++k) build();
  }

  std::vector<Event> events;

  /// Plays a frame, after changes to some bodies.
  void play() {
    for (int k = 0; k < kind_.changes; ++k) change();
    ++frames_;
    while (const auto event = advance(frame * frames_)) events.push_back(*event);
  }
  /// As play(), with probes of which each is refused once.
  void play_with_failures() {
    for (int k = 0; k < kind_.changes; ++k) change();
    ++frames_;
    const auto refused = [](std::span<const BodyId>, double, std::span<State> states) {
      for (State& state : states) state.position = {NAN, NAN, NAN};
    };
    for (;;) {
      auto event = world.advance(frame * frames_, refused);
      if (!event) {
        ++failures;
        event = world.advance(frame * frames_, probe());
      }
      if (!event.value()) return;
      hash.add(**event);
      events.push_back(**event);
    }
  }
  std::size_t failures = 0;

 private:
  static Box room(const Kind& kind) { return {{0, 0, 0}, {edge, edge, kind.dimensions == 2 ? 0.0 : edge}}; }
  Vec3 flat(const Vec3& v) const { return kind_.dimensions == 2 ? Vec3{v.x, v.y, 0.0} : v; }
  Vec3 any_place() {
    return flat({random_.uniform(0.5, edge - 0.5), random_.uniform(0.5, edge - 0.5),
                 random_.uniform(0.5, edge - 0.5)});
  }
  Vec3 any_velocity() {
    const double speed = random_.bits() % 20 == 0 ? 2.0 * kind_.faster : 2.0;
    return flat(speed * random_.point_in_ball());
  }
  void join() {
    const double limit = kind_.limit * random_.uniform();
    BodyDefinition body{.radius = 0.1 + 0.4 * random_.uniform(), .acceleration_limit = limit};
    body.position_error = body.velocity_error = kind_.noise;
    body.position = any_place();
    body.velocity = any_velocity();
    if (kind_.sensors && random_.bits() % 4 == 0) body.sensor_class = 1;
    ids_.push_back(add(body, flat(0.999 * limit * random_.point_in_ball())));
  }
  void build() {
    const Vec3 place = any_place();
    const bool zone = random_.bits() % 4 == 0;
    const Shape shape = random_.bits() % 2 == 0 ? Shape(Box{place, place + flat(Vec3{1.0, 0.5, 2.0})})
                                                : Shape(Ball{place, 0.7});
    built_.push_back(world.add_static({.shape = shape, .filter = {}, .solid = !zone}).value());
  }
  void change() {
    const std::uint64_t choice = random_.bits() % 100;
    const std::size_t which = random_.bits() % ids_.size();
    const BodyId id = ids_[which];
    const bool enabled = world.body(id).value().enabled;
    if (choice < 50) {
      const Vec3 velocity = any_velocity();
      if (enabled) set_velocity(id, velocity);
    } else if (choice < 58) {
      world.remove(id).value();
      ids_.erase(ids_.begin() + static_cast<std::ptrdiff_t>(which));
      join();
    } else if (choice < 66) {
      const Vec3 place = any_place();
      if (enabled) {
        set_position(id, place);
        world.teleport(id, state(id)).value();
      }
    } else if (choice < 74) {
      if (enabled) {
        world.disable(id).value();
      } else {
        set_position(id, any_place());
        world.enable(id, state(id)).value();
      }
    } else if (choice < 80) {
      if (enabled) {
        set_velocity(id, {});
        steer(id, {});
        if (world.body(id).value().definition.acceleration_limit == 0.0) world.sleep(id).value();
      }
    } else if (choice < 86) {
      world.change(id, {.radius = 0.1 + 0.4 * random_.uniform()}).value();
    } else if (choice < 92) {
      world
          .change(id, {.filter = Filter{.category = 1u << random_.bits() % 2,
                                        .mask = random_.bits() % 4 == 0 ? 1u : 3u}})
          .value();
    } else if (kind_.fixed && choice < 96) {
      world.remove(built_.front()).value();
      built_.erase(built_.begin());
      build();
    } else if (kind_.sensors) {
      world.change(id, {.sensor_class = static_cast<SensorClass>(random_.bits() % 2)}).value();
    }
  }

  Kind kind_;
  Random random_;
  Random errors_;
  std::vector<BodyId> ids_;
  std::vector<BodyId> built_;
  int frames_ = 0;
};

const std::vector<Kind> kinds{
    {.name = "plain"},
    {.name = "undisturbed", .changes = 0},
    {.name = "impacts", .contacts = ContactEvents::impacts},
    {.name = "without_walls", .walls = false},
    {.name = "accelerated", .limit = 4.0},
    {.name = "noisy", .limit = 1.0, .noise = 1e-4},
    {.name = "among_static_bodies", .fixed = true},
    {.name = "with_sensors", .fixed = true, .sensors = true},
    {.name = "some_fast", .fixed = true, .faster = 30.0},
    {.name = "flat", .fixed = true, .dimensions = 2, .changes = 20},
    {.name = "of_many_changes", .fixed = true, .changes = 60},
};
constexpr int frames = 150;

/// What an event is about: all but its time, and what follows from that.
using Subject = std::tuple<EventKind, std::uint32_t, std::uint32_t, Wall, double>;
Subject subject_of(const Event& event) {
  return {event.kind, event.first.index, event.second.index, event.wall, event.distance};
}

std::map<Subject, std::vector<double>> times_of(const std::vector<Event>& events) {
  std::map<Subject, std::vector<double>> times;
  for (const Event& event : events) times[subject_of(event)].push_back(event.time);
  return times;
}

std::string text_of(const Subject& subject) {
  const auto& [kind, first, second, wall, distance] = subject;
  return std::string(name_of(kind)) + " of " + std::to_string(first) + " and " + std::to_string(second);
}

class SpreadWindowStarts : public testing::TestWithParam<Kind> {};

TEST_P(SpreadWindowStarts, TellTheSameEvents) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Passage spread(GetParam(), true);
  Passage plain(GetParam(), false);
  for (int k = 0; k < frames; ++k) {
    spread.play();
    plain.play();
    if (k % 12 == 5) {
      ASSERT_TRUE(is_clean(spread.world));
    }
  }
  ASSERT_GT(plain.events.size(), 200u);
  const auto expected = times_of(plain.events);
  const auto found = times_of(spread.events);
  // Reports with errors are told when they are asked for, which differs.
  const double slack = GetParam().noise > 0.0 ? 2e-2 : 1e-5;
  for (const auto& [subject, times] : expected) {
    const auto same = found.find(subject);
    ASSERT_TRUE(same != found.end()) << text_of(subject) << " at " << times.front();
    if (GetParam().noise > 0.0) continue;
    ASSERT_EQ(same->second.size(), times.size()) << text_of(subject) << " from " << times.front() << " on";
    for (std::size_t k = 0; k < times.size(); ++k)
      ASSERT_NEAR(same->second[k], times[k], slack) << text_of(subject);
  }
  if (GetParam().noise == 0.0) {
    EXPECT_EQ(found.size(), expected.size());
  }
}

/// A snapshot in the midst of a preparation holds it.
TEST_P(SpreadWindowStarts, GoOnInARestoredWorld) {
  Passage through(GetParam(), true);
  Passage restored(GetParam(), true);
  for (int k = 0; k < frames; ++k) {
    through.play();
    restored.play();
    const auto bytes = restored.world.save().value();
    ASSERT_EQ(bytes, through.world.save().value()) << "frame " << k;
    restored.world = k % 3 == 0 ? restored.world.clone().value() : World::restore(bytes).value();
  }
  EXPECT_EQ(restored.hash.value(), through.hash.value());
  EXPECT_EQ(restored.world.counters(), through.world.counters());
}

TEST_P(SpreadWindowStarts, GoOnAfterProbesThatFail) {
  Passage through(GetParam(), true);
  Passage failing(GetParam(), true);
  for (int k = 0; k < frames; ++k) {
    through.play();
    failing.play_with_failures();
  }
  EXPECT_GT(failing.failures, 0u);
  EXPECT_TRUE(GetParam().noise > 0.0 || failing.hash.value() == through.hash.value());
}

/// A prepared start depends on times alone, not on the calls that pass them.
TEST_P(SpreadWindowStarts, DoNotDependOnFrames) {
  Kind undisturbed = GetParam();
  undisturbed.changes = 0;
  Passage in_frames(undisturbed, true);
  Passage at_once(undisturbed, true);
  for (int k = 0; k < frames; ++k) in_frames.play();
  while (const auto event = at_once.advance(in_frames.world.time())) continue;
  EXPECT_EQ(at_once.hash.value(), in_frames.hash.value());
  EXPECT_EQ(at_once.world.counters(), in_frames.world.counters());
}

std::string kind_name(const testing::TestParamInfo<Kind>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Kinds, SpreadWindowStarts, testing::ValuesIn(kinds), kind_name);

/// Bodies that bounce and are pushed about; one in twenty is so many times as fast.
struct Bouncing : BouncingWorld<RandomForces> {
  explicit Bouncing(ContactEvents contacts, double radius = 0.4, double faster = 1.0)
      : BouncingWorld(
            RandomForces::create(
                {.start = start(faster), .acceleration_limits = std::vector<double>(count, 3.0)})
                .value(),
            World::create(
                {.box = Box{{0, 0, 0}, {21, 21, 21}}, .contacts = contacts, .spread_window_starts = true})
                .value(),
            1.0) {
    for (std::size_t number = 0; number < count; ++number) {
      BodyDefinition body = next();
      body.radius = radius;
      if (number % 4 == 0) body.sensor_class = 1;
      add(body, 1.0);
    }
    world.set_sensor(1, {.distances = {0.5}}).value();
    world.add_static({.shape = Ball{{6, 6, 6}, 1.5}}).value();
  }

 private:
  static constexpr std::size_t count = 1000;
  static std::vector<State> start(double faster) {
    Random random(seed);
    std::vector<State> states;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 place{double(k % 10), double(k / 10 % 10), double(k / 100)};
      const double speed = k % 20 == 7 ? 4.0 * faster : 4.0;
      states.push_back({Vec3{1, 1, 1} + 2.0 * place, speed * random.point_in_ball()});
    }
    return states;
  }
};

/// World::run, on threads too, tells the events of World::advance. Threads count other changes of windows
/// than one thread does; where these are about a third of the bodies, some starts have spare slots there
/// alone.
TEST(SpreadWindowStartsOfMany, AreTheSameOnThreads) {
  const auto compare = [](const auto& make, double until) {
    Bouncing looped = make();
    looped.loop(until);
    for (const int threads : {1, 2}) {
      SCOPED_TRACE(testing::Message() << threads << " threads");
      Bouncing found = make();
      Workers workers = eager_workers(threads).value();
      for (double time = 0.0; time < until; time += 0.3) found.run(time, &workers).value();
      found.run(until, &workers).value();
      expect_same_course(found, looped);
      EXPECT_TRUE(is_clean(found.world));
    }
    EXPECT_GT(looped.reported, 1000u);
    EXPECT_GT(looped.world.counters().window_ends, 8u);
  };
  compare([] { return Bouncing(ContactEvents::all); }, 3.0);
  compare([] { return Bouncing(ContactEvents::impacts); }, 3.0);
  compare([] { return Bouncing(ContactEvents::impacts, 0.3, 25.0); }, 2.0);
}

/// Returns the most starts and restarts of bodies in a frame, after the first second.
std::uint64_t most_in_a_frame(bool spreads, std::size_t bodies) {
  Passage passage({.name = "steady", .walls = false, .changes = 10}, spreads, bodies);
  std::uint64_t most = 0;
  for (int k = 0; k < 180; ++k) {
    const Counters before = passage.world.counters();
    passage.play();
    const Counters after = passage.world.counters();
    if (k >= 60) most = std::max(most, after.starts + after.restarts - before.starts - before.restarts);
  }
  return most;
}

TEST(SpreadWindowStartsOfMany, HaveNoFrameWithAllTheWork) {
  constexpr std::size_t bodies = 3000;
  EXPECT_GT(most_in_a_frame(false, bodies), bodies * 9 / 10);
  EXPECT_LT(most_in_a_frame(true, bodies), bodies / 4);
}

}  // namespace
}  // namespace kinesphere::spread_window_starts_test
