// Ids know the world that created them.
#include <gtest/gtest.h>

#include "kinesphere/certificates.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/queries.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::foreign_id_test {
namespace {

TEST(ForeignId, IsRefusedByEveryCallThatTakesOne) {
  World world = World::create({}).value();
  World other = World::create({}).value();
  const BodyId own = world.add({}).value();
  const BodyId id = other.add({.position = {5, 0, 0}}).value();
  ASSERT_EQ(own, id) << "equal but for the world";
  const std::vector<std::byte> before = world.save().value();
  const auto refused = [&](const auto& result, const std::string& call) {
    expect_error(result, ErrorCode::foreign_body, "body", call, id);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, call + ": body 0 is one of another world");
  };
  refused(world.remove(id), "remove");
  refused(world.remove(std::vector{id}), "remove");
  refused(world.set_velocity(id, {1, 0, 0}), "set_velocity");
  refused(world.set_velocities(std::vector{id}, std::vector<Vec3>(1)), "set_velocities");
  refused(world.teleport(id, {}), "teleport");
  refused(world.change(id, {.radius = 2.0}), "change");
  refused(world.change(id, {.motion_limits = MotionLimits{}}), "change");
  refused(world.disable(id), "disable");
  refused(world.enable(id, {}), "enable");
  refused(world.sleep(id), "sleep");
  refused(world.wake(id), "wake");
  refused(world.change(id, {.filter = Filter{}}), "change");
  refused(world.refresh_filter(id), "refresh_filter");
  refused(world.change(id, {.solid = true}), "change");
  refused(world.change(id, {.sensor_class = 0}), "change");
  refused(world.change(id, {.user_data = 0}), "change");
  refused(world.user_data(id), "user_data");
  refused(world.body(id), "body");
  refused(world.touching(id), "touching");
  refused(world.sensor_overlaps(id), "sensor_overlaps");
  refused(world.certificates().safe_until(id), "safe_until");
  refused(world.certificates().safe_until(own, id), "safe_until");
  refused(world.certificates().earliest_contact(id), "earliest_contact");
  refused(world.certificates().distance_limits(id, own, 1.0), "distance_limits");
  EXPECT_FALSE(world.contains(id));
  EXPECT_EQ(world.save().value(), before);
}

/// Returns all ids that a world creates.
std::vector<BodyId> given_out(Playground& p) {
  std::vector<BodyId> ids = p.world.bodies();
  for (const Event& event : p.run(10.0)) {
    ids.push_back(event.first);
    if (event.second != no_body) ids.push_back(event.second);
    for (const BodyId id : p.world.touching(event.first).value()) ids.push_back(id);
  }
  for (const OverlapHit& found : p.world.queries().overlapping({0, 0, 0}, 100.0).value())
    ids.push_back(found.body);
  for (const NearestHit& near : p.world.queries().nearest({0, 0, 0}, 5).value()) ids.push_back(near.body);
  for (const CastHit& hit : p.world.queries().ray_cast({-50, 0, 0}, {1, 0, 0}, 100.0).value())
    ids.push_back(hit.body);
  for (const Certificate& each : p.world.inspection().certificates()) {
    ids.push_back(each.first);
    if (each.second != no_body) ids.push_back(each.second);
  }
  return ids;
}

TEST(ForeignId, IsNoneThatTheWorldGaveOutItself) {
  Playground p({.box = Box{{-100, -100, -100}, {100, 100, 100}}});
  std::vector<BodyId> probed;
  p.distort = [&](BodyId id, double, State&) { probed.push_back(id); };
  p.add({.acceleration_limit = 1.0, .velocity = {1, 0, 0}});
  p.add({.acceleration_limit = 1.0, .position = {10, 0, 0}});
  const std::vector<BodyId> ids = given_out(p);
  EXPECT_GT(ids.size(), 10u);
  ASSERT_FALSE(probed.empty());
  for (const BodyId id : ids) EXPECT_TRUE(id.world != 0 && p.world.contains(id)) << id;
  for (const BodyId id : probed) EXPECT_TRUE(id.world != 0 && p.world.contains(id)) << id;
}

TEST(ForeignId, IsNoneOfACloneAndNoneThatDoesNotSay) {
  World world = World::create({}).value();
  const BodyId id = world.add({}).value();
  World clone = world.clone().value();
  EXPECT_TRUE(clone.set_velocity(id, {1, 0, 0}));
  EXPECT_TRUE(world.contains(clone.bodies().front()));
  EXPECT_TRUE(world.set_velocity({0, 0}, {1, 0, 0})) << "a literal";
  World moved = std::move(world);
  EXPECT_TRUE(moved.set_velocity(id, {1, 0, 0}));
}

TEST(ForeignId, IsNoneOfARestoredWorldWhichSavesWithoutItsTag) {
  World world = World::create({}).value();
  World twin = World::create({}).value();
  const BodyId id = world.add({}).value();
  twin.add({}).value();
  EXPECT_EQ(world.save().value(), twin.save().value()) << "equal histories, equal snapshots";
  World restored = World::restore(world.save().value()).value();
  EXPECT_TRUE(restored.set_velocity(id, {1, 0, 0}));
  for (const BodyId other : restored.bodies()) {
    EXPECT_EQ(other.world, 0u);
    EXPECT_TRUE(world.contains(other));
  }
}

}  // namespace
}  // namespace kinesphere::foreign_id_test
