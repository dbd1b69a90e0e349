// A failed advance leaves a world that can be saved, restored, audited and advanced.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "support/playground.hpp"
#include "support/test_size.hpp"

namespace kinesphere::failed_advance_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

testing::AssertionResult can_be_restored(const World& world) {
  const auto bytes = world.save().value();
  const auto restored = World::restore(bytes);
  if (!restored) return testing::AssertionFailure() << restored.error().message;
  if (restored->save().value() != bytes) return testing::AssertionFailure() << "it saves other bytes";
  return is_clean(*restored);
}

/// A static body is recertified first, and records facts about bodies that have not been recertified yet.
TEST(FailedAdvance, BetweenANewFixedBodyAndANewBodyCanBeSaved) {
  Playground p;
  const BodyId old = p.add({.radius = 1, .acceleration_limit = 1});
  p.run(1.0);
  p.world.add_static({.shape = Box{{3, -1, -1}, {4, 1, 1}}}).value();
  p.add({.radius = 1, .acceleration_limit = 1, .position = {2.5, 0, 0}});
  bool good = false;
  p.distort = [&](BodyId id, double, State& state) {
    if (id == old && !good) state.position.x = nan;
  };
  auto advanced = p.world.advance(2.0, p.probe());
  while (advanced && *advanced) advanced = p.world.advance(2.0, p.probe());
  ASSERT_FALSE(advanced);
  EXPECT_TRUE(is_clean(p.world));
  EXPECT_TRUE(can_be_restored(p.world));
  good = true;
  p.run(2.0);
  EXPECT_TRUE(is_clean(p.world));
}

/// Two that have met, and let each other pass, have no certificate before they are looked at again, which a
/// report of a third one has to precede.
TEST(FailedAdvance, AfterAContactClaimsNothingOfIt) {
  Playground p;
  p.add({.radius = 1, .position = {0, 0, 0}, .velocity = {1, 0, 0}});
  p.add({.radius = 1, .position = {3, 0, 0}});
  const BodyId third = p.add({.radius = 1, .acceleration_limit = 1, .position = {0, 50, 0}});
  bool good = true;
  p.distort = [&](BodyId id, double, State& state) {
    if (id == third && !good) state.position.x = nan;
  };
  const auto begin = p.world.advance(20.0, p.probe());
  ASSERT_TRUE(begin && *begin && (*begin)->kind == EventKind::contact_begin);
  p.set_velocity(third, {0, 1, 0});
  good = false;
  ASSERT_FALSE(p.world.advance(20.0, p.probe()));
  EXPECT_TRUE(is_clean(p.world));
  EXPECT_TRUE(can_be_restored(p.world));
  good = true;
  const auto end = p.world.advance(20.0, p.probe());
  ASSERT_TRUE(end && *end && (*end)->kind == EventKind::contact_end);
  EXPECT_NEAR((*end)->time, 5.0, 1e-4);
}

/// A crowd among shapes, with sensors and changes, and a probe that fails every so often.
class RandomCrowd {
 public:
  explicit RandomCrowd(std::uint64_t seed) : random_(seed), playground_(definition()) {
    for (int k = 0; k < 12; ++k) add();
    for (int k = 0; k < 3; ++k) add_static();
    if (random_.bits() % 2 == 0) playground_.world.set_sensor(1, {.distances = {0.0, 0.2}}).value();
  }

  void go() {
    for (int step = 0; step < 60; ++step) {
      for (auto changes = random_.bits() % 4; changes > 0; --changes) change();
      advance(playground_.world.time() + 0.1 * random_.uniform());
      if (testing::Test::HasFailure()) return;
    }
  }
  int failures() const { return failures_; }

 private:
  WorldDefinition definition() {
    WorldDefinition world{.box = Box{{0, 0, 0}, {4, 4, 4}}};
    const auto choice = random_.bits();
    if (choice % 2 == 0) world.contacts = ContactEvents::impacts;
    if (choice / 2 % 2 == 0) world.periodic = {true, choice / 4 % 2 == 0, choice / 8 % 2 == 0};
    if (choice / 16 % 8 == 0) world.contact_tolerance = 1e-3;
    return world;
  }
  bool repeats() const { return playground_.world.definition().periodic.any(); }
  Vec3 place() { return {random_.uniform(0.7, 3.3), random_.uniform(0.7, 3.3), random_.uniform(0.7, 3.3)}; }

  void add() {
    const double limit = random_.bits() % 3 == 0 ? 0.0 : 3.0 * random_.uniform();
    playground_.add({.radius = 0.35 * random_.uniform(),
                     .acceleration_limit = limit,
                     .position = place(),
                     .velocity = 3.0 * random_.point_in_ball(),
                     .solid = random_.bits() % 8 != 0,
                     .sensor_class = static_cast<SensorClass>(random_.bits() % 2)},
                    0.99 * limit * random_.point_in_ball());
  }
  void add_static() {
    const Vec3 at = place();
    const Vec3 size{random_.uniform(), random_.uniform(), random_.uniform()};
    Shape shape = Ball{at, 0.35 * random_.uniform()};
    if (!repeats() && random_.bits() % 2 == 0) shape = Box{at, at + size};
    if (!repeats() && random_.bits() % 3 == 0)
      shape = Triangle{at, at + Vec3{size.x, 0, 0.1}, at + Vec3{0, size.y + 0.1, size.z}};
    fixed_.push_back(playground_.world.add_static({.shape = shape}).value());
  }

  void change() {
    const auto bodies = playground_.world.bodies();
    const BodyId id = bodies[random_.bits() % bodies.size()];
    const bool fixed = playground_.world.body(id).value().is_static;
    const bool enabled = playground_.world.body(id).value().enabled;
    const State state{place(), random_.point_in_ball()};
    switch (random_.bits() % 6) {
      case 0:
        return add();
      case 1:
        playground_.world.remove(id).value();
        return random_.bits() % 2 == 0 ? add() : add_static();
      case 2:
        if (enabled) return playground_.world.disable(id).value();
        playground_.world.enable(id, state).value();
        if (!fixed) playground_.start_course(id, {.position = state.position, .velocity = state.velocity});
        return;
      default:
        if (enabled && !fixed) playground_.set_velocity(id, 3.0 * random_.point_in_ball());
    }
  }

  void advance(double until) {
    for (int tries = 0; tries < 400; ++tries) {
      auto left = random_.bits() % 12;
      const auto how = random_.bits() % 3;
      const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
        playground_.probe()(ids, time, states);
        if (left-- != 0) return;
        if (how == 0) states[random_.bits() % states.size()].velocity.z = nan;
        if (how == 1) states[random_.bits() % states.size()].position.x = 1e200;
        if (how == 2) throw std::runtime_error("no answer");
      };
      bool failed = true;
      bool ended = false;
      try {
        const auto event = playground_.world.advance(until, probe);
        failed = !event;
        ended = event && !*event;
      } catch (const std::runtime_error&) {
      }
      ASSERT_TRUE(is_clean(playground_.world)) << "failed " << failed;
      if (failed) {
        ++failures_;
        ASSERT_TRUE(can_be_restored(playground_.world));
      }
      if (ended) return;
    }
    playground_.run(until);
  }

  Random random_;
  Playground playground_;
  std::vector<BodyId> fixed_;
  int failures_ = 0;
};

TEST(FailedAdvance, LeavesAWorldThatIsCleanAndCanBeRestored) {
  const int rounds = rounds_of(150);
  int failures = 0;
  for (int seed = 0; seed < rounds && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomCrowd crowd(static_cast<std::uint64_t>(seed));
    crowd.go();
    failures += crowd.failures();
  }
  EXPECT_GT(failures, 6 * rounds);
}

}  // namespace
}  // namespace kinesphere::failed_advance_test
