// Moved-from worlds, and worlds that are destroyed while their own probe runs.
#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "kinesphere/certificates.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/queries.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::moved_world_test {
namespace {

const auto idle_probe = [](std::span<const BodyId>, double, std::span<State>) {};

TEST(MovedFromWorld, AnswersEveryCallWithAnError) {
  World world = World::create({}).value();
  const BodyId id = world.add({}).value();
  const World taken = std::move(world);
  const auto refused = [](const auto& result, const std::string& call) {
    expect_error(result, ErrorCode::moved_from, "world", call);
  };
  // NOLINTBEGIN(bugprone-use-after-move): that is what is tested.
  refused(world.add({}), "add");
  refused(world.reserve(1), "reserve");
  refused(world.add_all({}), "add_all");
  refused(world.add_static({}), "add_static");
  refused(world.add_static_all({}), "add_static_all");
  refused(world.remove(id), "remove");
  refused(world.remove({}), "remove");
  refused(world.set_velocity(id, {}), "set_velocity");
  refused(world.set_velocities({}, {}), "set_velocities");
  refused(world.teleport(id, {}), "teleport");
  refused(world.change(id, {.radius = 1.0}), "change");
  refused(world.change(id, {.motion_limits = MotionLimits{}}), "change");
  refused(world.disable(id), "disable");
  refused(world.enable(id, {}), "enable");
  refused(world.sleep(id), "sleep");
  refused(world.wake(id), "wake");
  refused(world.add_zone({}), "add_zone");
  refused(world.change(id, {.filter = Filter{}}), "change");
  refused(world.set_pair_filter({}), "set_pair_filter");
  refused(world.refresh_filter(id), "refresh_filter");
  refused(world.change(id, {.solid = true}), "change");
  refused(world.set_sensor(0, {}), "set_sensor");
  refused(world.change(id, {.sensor_class = 0}), "change");
  refused(world.change(id, {.user_data = 0}), "change");
  refused(world.user_data(id), "user_data");
  refused(world.advance(1.0, idle_probe), "advance");
  refused(world.body(id), "body");
  refused(world.touching(id), "touching");
  refused(world.sensor_overlaps(id), "sensor_overlaps");
  refused(world.set_profiling(true), "set_profiling");
  refused(world.certificates().safe_until(), "safe_until");
  refused(world.certificates().safe_until(id), "safe_until");
  refused(world.certificates().safe_until(id, id), "safe_until");
  refused(world.certificates().earliest_contact(id), "earliest_contact");
  refused(world.certificates().distance_limits(id, id, 1.0), "distance_limits");
  refused(world.certificates(idle_probe).safe_until(), "safe_until");
  refused(world.certificates(idle_probe).safe_until(id), "safe_until");
  refused(world.certificates(idle_probe).safe_until(id, id), "safe_until");
  refused(world.certificates(idle_probe).earliest_contact(id), "earliest_contact");
  refused(world.certificates(idle_probe).distance_limits(id, id, 1.0), "distance_limits");
  refused(world.queries().overlapping({}, 1.0), "overlapping");
  refused(world.queries(idle_probe).overlapping({}, 1.0), "overlapping");
  refused(world.queries().overlapping(Box{}), "overlapping");
  refused(world.queries().nearest({}, 1), "nearest");
  refused(world.queries().ray_cast({}, {1, 0, 0}, 1.0), "ray_cast");
  refused(world.queries().sphere_cast({}, 1.0, {1, 0, 0}, 1.0), "sphere_cast");
  refused(world.save(), "save");
  refused(world.clone(), "clone");
  refused(world.start_recording(), "start_recording");
  refused(world.stop_recording(), "stop_recording");

  EXPECT_THROW((void)world.time(), BadResult);
  EXPECT_THROW((void)world.size(), BadResult);
  EXPECT_THROW((void)world.definition(), BadResult);
  EXPECT_THROW((void)world.contains(id), BadResult);
  EXPECT_THROW((void)world.bodies(), BadResult);
  EXPECT_THROW((void)world.counters(), BadResult);
  EXPECT_THROW((void)world.sensor(0), BadResult);
  EXPECT_THROW((void)world.inspection().memory(), BadResult);
  EXPECT_THROW((void)world.inspection().cells(), BadResult);
  EXPECT_THROW((void)world.inspection().certificates(), BadResult);
  EXPECT_THROW((void)world.inspection().timings(), BadResult);
  EXPECT_THROW((void)world.inspection().audit(), BadResult);
  EXPECT_THROW((void)world.inspection().is_recording(), BadResult);
  // NOLINTEND(bugprone-use-after-move)
}

TEST(MovedFromWorld, MayBeAssignedTo) {
  World world = World::create({}).value();
  World taken = std::move(world);
  const BodyId id = taken.add({}).value();
  world = std::move(taken);
  EXPECT_TRUE(world.contains(id));
  World empty = std::move(taken);  // NOLINT(bugprone-use-after-move): that is what is tested
  EXPECT_THROW((void)empty.size(), BadResult);
}

TEST(MovedWorld, TakesItsRecordingAlong) {
  World world = World::create({}).value();
  world.start_recording().value();
  World taken = std::move(world);
  EXPECT_TRUE(taken.inspection().is_recording());
  EXPECT_TRUE(taken.stop_recording());
}

/// Returns a world that probes in its next advance.
World busy_world() {
  World world = World::create({}).value();
  world.add({.acceleration_limit = 1.0, .velocity = {1, 0, 0}}).value();
  world.add({.acceleration_limit = 1.0, .position = {10, 0, 0}}).value();
  return world;
}

TEST(WorldInItsOwnProbeDeathTest, StopsTheProgramWhenItGoes) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(
      {
        auto world = std::make_unique<World>(busy_world());
        (void)world->advance(100.0,
                             [&](std::span<const BodyId>, double, std::span<State>) { world.reset(); });
      },
      "a World was destroyed inside its own probe");
  EXPECT_DEATH(
      {
        World world = busy_world();
        (void)world.advance(100.0,
                            [&](std::span<const BodyId>, double, std::span<State>) { world = busy_world(); });
      },
      "a World was assigned to inside its own probe");
  EXPECT_DEATH(
      {
        World world = busy_world();
        std::optional<World> other;
        (void)world.advance(
            100.0, [&](std::span<const BodyId>, double, std::span<State>) { other = std::move(world); });
      },
      "a World was moved from inside its own probe");
}

TEST(WorldInItsOwnPairFilterDeathTest, StopsTheProgramWhenItGoes) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(
      {
        auto world = std::make_unique<World>(busy_world());
        world->add({.position = {11, 0, 0}}).value();
        world
            ->set_pair_filter([&](BodyId, BodyId) {
              world.reset();
              return true;
            })
            .value();
        (void)world->advance(100.0, idle_probe);
      },
      "a World was destroyed inside its own pair filter");
}

TEST(WorldInItsOwnProbe, MayGoAfterTheProbeHasThrown) {
  auto world = std::make_unique<World>(busy_world());
  EXPECT_THROW(
      (void)world->advance(100.0, [](std::span<const BodyId>, double, std::span<State>) { throw 7; }), int);
  world.reset();
}

}  // namespace
}  // namespace kinesphere::moved_world_test
