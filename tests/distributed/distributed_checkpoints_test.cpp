// A saved distributed world continues without a difference, on any number of ranks.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "distributed/rigid_scenes.hpp"
#include "kinesphere/random.hpp"
#include "simulation/scene/make_scene.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::distributed_checkpoints_test {
namespace {

using Part = std::vector<std::byte>;

Scene scene_of(const std::string& name, std::uint32_t bodies) {
  SceneParameters parameters;
  for (const SceneParameters& built_in : built_in_scenes())
    if (built_in.name == name) parameters = built_in;
  parameters.bodies = bodies;
  parameters.seconds = 1.2;
  if (parameters.packing <= 0.0) parameters.box.upper = {130, 130, 130};
  return make_scene(parameters).value();
}

/// Rigid bodies and moving shapes among balls that grow and shrink.
Setting rigid_and_growing() {
  Setting setting = rigid_setting({.seed = 11, .acceleration_limit = 1.0, .seconds = 1.2});
  setting.radius_rate = 0.1;
  for (const std::uint32_t k : {8u, 40u}) {
    setting.rigid.erase(k);
    setting.shapes[k] = Box{{-2, -1, -0.2}, {2, 1, 0}};
  }
  return setting;
}

/// Returns a motion of the scene without bodies.
std::unique_ptr<Motion> empty_motion(const Scene& scene) {
  std::unique_ptr<Motion> motion = scene.motion->clone();
  for (std::uint32_t k = 0; k < scene.bodies.size(); ++k) motion->remove(k).value();
  return motion;
}

/// Runs to a time; returns the parts that all ranks save there, on all ranks.
std::vector<Part> parts_at(const Setting& setting, double time, std::vector<OrderedEvent>& reported) {
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = spread(setting, *motion);
  const ResponseFn respond = [&](const Event& event) { return setting.answer(event); };
  world.run(time, respond, [&](const OrderedEvent& event) { reported.push_back(event); }).value();
  Communicator communicator;
  return communicator.gather(world.save().value());
}

/// Returns the parts that this rank restores.
std::vector<Part> share_of(const std::vector<Part>& parts, int shift) {
  Communicator communicator;
  std::vector<Part> mine;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if ((static_cast<int>(k) + shift) % communicator.ranks() == communicator.rank()) mine.push_back(parts[k]);
  return mine;
}

TEST(DistributedCheckpoints, GoOnAsIfNothingHadBeen) {
  for (const std::string name : {"paper1", "gas", "paper2", "rigid"}) {
    SCOPED_TRACE(name);
    Setting setting = name == "rigid" ? rigid_and_growing()
                                      : Setting{.scene = scene_of(name, 300), .sensors = name == "paper1"};
    if (name == "gas") setting.potential = {.distances = {0.4}, .energies = {-0.4}};
    const RunOutcome one = alone(setting);
    Random random(5);
    for (int trial = 0; trial < 3; ++trial) {
      std::vector<OrderedEvent> reported;
      const double time = random.uniform(0.0, setting.scene.end_time);
      const std::vector<Part> parts = parts_at(setting, time, reported);
      const std::unique_ptr<Motion> motion = empty_motion(setting.scene);
      auto world = DistributedWorld::restore(share_of(parts, trial), *motion);
      ASSERT_TRUE(world) << world.error().message;
      EXPECT_EQ(world->time(), time);
      // Ranks have other bodies now: only the merged events can be compared.
      const RunOutcome rest = finish(setting, *world);
      std::vector<Event> events = merged(reported);
      events.insert(events.end(), rest.events.begin(), rest.events.end());
      // A message has each certificate once. A world may have that of a rigid body and its walls twice, and
      // checks it twice then.
      (name == "rigid" ? expect_same_course : expect_same)(one, {events, rest.counters, rest.hash});
    }
  }
}

/// A checkpoint of one rank is restored by many, and the other way round.
TEST(DistributedCheckpoints, MayBeOfAnotherNumberOfRanks) {
  for (const bool is_rigid : {false, true}) {
    const Setting setting = is_rigid ? rigid_and_growing() : Setting{.scene = scene_of("paper1", 250)};
    const RunOutcome one = alone(setting);
    std::vector<OrderedEvent> reported;
    std::vector<Part> parts = parts_at(setting, 0.5, reported);
    // One rank holds all bodies.
    const std::unique_ptr<Motion> motion = empty_motion(setting.scene);
    auto world = DistributedWorld::restore(share_of(parts, 0), *motion);
    ASSERT_TRUE(world) << world.error().message;
    Communicator communicator;
    parts = communicator.gather(world->save().value());
    const std::unique_ptr<Motion> again = empty_motion(setting.scene);
    const bool takes_all = communicator.rank() == 0;
    auto resumed = DistributedWorld::restore(takes_all ? parts : std::vector<Part>(), *again);
    ASSERT_TRUE(resumed) << resumed.error().message;
    EXPECT_EQ(finish(setting, *resumed).hash, one.hash);
  }
}

TEST(DistributedCheckpoints, OfAWorldThatHasNotBegun) {
  const Setting setting{.scene = scene_of("paper1", 200)};
  const std::unique_ptr<Motion> motion = setting.scene.motion->clone();
  DistributedWorld world = spread(setting, *motion);
  const Part part = world.save().value();
  const std::unique_ptr<Motion> other = empty_motion(setting.scene);
  auto resumed = DistributedWorld::restore(std::vector<Part>{part}, *other);
  ASSERT_TRUE(resumed) << resumed.error().message;
  expect_same(alone(setting), finish(setting, *resumed));
}

TEST(DistributedCheckpoints, AreRefusedUnlessTheyAreWhole) {
  const Setting setting{.scene = scene_of("paper1", 60)};
  std::vector<OrderedEvent> reported;
  const std::vector<Part> parts = parts_at(setting, 0.3, reported);
  const auto refused = [&](std::vector<Part> here, const std::string& why) {
    const std::unique_ptr<Motion> motion = empty_motion(setting.scene);
    const auto world = DistributedWorld::restore(here, *motion);
    ASSERT_FALSE(world);
    EXPECT_EQ(world.error().code, ErrorCode::bad_snapshot);
    EXPECT_NE(world.error().message.find(why), std::string::npos) << world.error().message;
  };
  Communicator communicator;
  const bool first = communicator.rank() == 0;
  refused({}, "restore: parts must be all of one world");
  std::vector<Part> mine = share_of(parts, 0);
  // Damages the part of rank 0 alone.
  if (first) mine[0].resize(mine[0].size() / 2);
  refused(mine, "rank 0: restore: parts must be whole");
  mine = share_of(parts, 0);
  if (first) mine[0][mine[0].size() / 2] ^= std::byte{1};
  refused(mine, "rank 0: restore: parts must be undamaged");
  mine = share_of(parts, 0);
  if (first) mine.push_back(mine[0]);
  refused(mine, "restore: parts must be all of one world, each of them once");
  mine = share_of(parts, 0);
  if (first) mine.erase(mine.begin());
  refused(mine, "restore: parts must be all of one world");
  if (communicator.ranks() == 1) return;
  std::vector<OrderedEvent> later;
  const std::vector<Part> others = parts_at(setting, 0.6, later);
  mine = share_of(parts, 0);
  if (first) mine[0] = others[0];
  refused(mine, "restore: parts must be all of one world");
}

}  // namespace
}  // namespace kinesphere::distributed_checkpoints_test
