// Moved-from worlds, and worlds that are destroyed while their own probe runs.
#include <gtest/gtest.h>

#include <memory>
#include <optional>

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
  refused(world.shape_of(id), "shape_of");
  refused(world.remove(id), "remove");
  refused(world.remove_all({}), "remove_all");
  refused(world.set_velocity(id, {}), "set_velocity");
  refused(world.set_velocity_all({}, {}), "set_velocity_all");
  refused(world.teleport(id, {}), "teleport");
  refused(world.set_radius(id, 1.0), "set_radius");
  refused(world.set_motion_limits(id, {}), "set_motion_limits");
  refused(world.disable(id), "disable");
  refused(world.enable(id, {}), "enable");
  refused(world.sleep(id), "sleep");
  refused(world.wake(id), "wake");
  refused(world.add_zone({}), "add_zone");
  refused(world.set_filter(id, {}), "set_filter");
  refused(world.set_pair_filter({}), "set_pair_filter");
  refused(world.refresh_filter(id), "refresh_filter");
  refused(world.set_solid(id, true), "set_solid");
  refused(world.set_sensor(0, {}), "set_sensor");
  refused(world.set_sensor_class(id, 0), "set_sensor_class");
  refused(world.set_user_data(id, 0), "set_user_data");
  refused(world.user_data(id), "user_data");
  refused(world.advance(1.0, idle_probe), "advance");
  refused(world.body(id), "body");
  refused(world.touching(id), "touching");
  refused(world.sensor_overlaps(id), "sensor_overlaps");
  refused(world.set_profiling(true), "set_profiling");
  refused(world.safe_until(), "safe_until");
  refused(world.safe_until(id), "safe_until");
  refused(world.safe_until(id, id), "safe_until");
  refused(world.earliest_contact(id), "earliest_contact");
  refused(world.distance_limits(id, id, 1.0), "distance_limits");
  refused(world.safe_until(idle_probe), "safe_until");
  refused(world.safe_until(id, idle_probe), "safe_until");
  refused(world.safe_until(id, id, idle_probe), "safe_until");
  refused(world.earliest_contact(id, idle_probe), "earliest_contact");
  refused(world.distance_limits(id, id, 1.0, idle_probe), "distance_limits");
  refused(world.overlapping({}, 1.0), "overlapping");
  refused(world.overlapping({}, 1.0, idle_probe), "overlapping");
  refused(world.overlapping(Box{}), "overlapping");
  refused(world.nearest({}, 1), "nearest");
  refused(world.ray_cast({}, {1, 0, 0}, 1.0), "ray_cast");
  refused(world.sphere_cast({}, 1.0, {1, 0, 0}, 1.0), "sphere_cast");
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
  EXPECT_THROW((void)world.memory(), BadResult);
  EXPECT_THROW((void)world.cells(), BadResult);
  EXPECT_THROW((void)world.certificates(), BadResult);
  EXPECT_THROW((void)world.timings(), BadResult);
  EXPECT_THROW((void)world.audit(), BadResult);
  EXPECT_THROW((void)world.recording(), BadResult);
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
  EXPECT_TRUE(taken.recording());
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
