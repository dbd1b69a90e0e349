// Worlds with bodies of several motions.
#include "kinesphere/body_map.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/motion/steered_motion.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/simulation.hpp"
#include "motion/still.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::body_map_test {
namespace {

Ballistic rows(std::size_t bodies, double y) {
  BallisticDefinition definition;
  for (std::size_t k = 0; k < bodies; ++k)
    definition.start.push_back({{10.0 * static_cast<double>(k), y, 0}, {0, 1, 0}});
  return Ballistic::create(definition).value();
}

TEST(BodyMap, AsksEachBodysOwnMotion) {
  Ballistic balls = rows(3, 0), others = rows(2, 100);
  World world = World::create({}).value();
  BodyMap map;
  const auto first = map.add_all(world, balls, {.radius = 0.5, .user_data = 7}).value();
  const auto second = map.add_all(world, others, std::vector{1.0, 2.0}).value();
  ASSERT_EQ(first.size(), 3u);
  ASSERT_EQ(second.size(), 2u);
  EXPECT_EQ(world.body(first[1])->definition.radius, 0.5);
  EXPECT_EQ(world.user_data(first[2]).value(), 7u);
  EXPECT_EQ(world.body(second[1])->definition.radius, 2.0);
  EXPECT_EQ(map.find(second[1])->motion, &others);
  EXPECT_EQ(map.find(second[1])->number, 1u);
  EXPECT_FALSE(map.find({5, 0}));
  EXPECT_FALSE(map.find({1, 1}));
  EXPECT_EQ(map.state(second[1], 2.0), others.state(1, 2.0));
  EXPECT_FALSE(world.advance(50.0, map.probe()).value());
}

TEST(BodyMap, FollowsBulletsThatComeAndGo) {
  Ballistic targets = rows(4, 0);
  Ballistic bullets = Ballistic::create({}).value();
  World world = World::create({.contact_tolerance = 1e-3}).value();
  BodyMap map;
  const auto ids = map.add_all(world, targets).value();
  // A body that no motion moves any more: from here on indices and numbers differ.
  map.remove(world, ids[0]).value();
  EXPECT_FALSE(targets.contains(0));
  int hits = 0;
  for (int shot = 0; shot < 20; ++shot) {
    const double now = world.time();
    const double x = 10.0 * (1 + shot % 3);
    const std::uint32_t number = bullets.add(now, {{x, now, 50}, {0, 1, -100}}).value();
    EXPECT_EQ(number, 0u) << "numbers are used again";
    const BodyId bullet = map.add(world, bullets, number, {.radius = 0.01}).value();
    while (const auto event = world.advance(now + 1.0, map.probe()).value()) {
      if (event->kind != EventKind::contact_begin) continue;
      EXPECT_EQ(event->second == bullet ? event->first : event->second, ids[1 + shot % 3]);
      EXPECT_NEAR(event->time, now + 0.49, 0.0002);
      ++hits;
      map.remove(world, bullet).value();
      EXPECT_FALSE(map.find(bullet));
    }
  }
  EXPECT_EQ(hits, 20);
}

TEST(BodyMap, ChangesTheMotionAndTheWorld) {
  SteeredMotion ships =
      SteeredMotion::create({.start = {{}, {{20, 0, 0}, {}}}, .acceleration_limits = {1, 1}}).value();
  World world = World::create({}).value();
  BodyMap map;
  const auto ids = map.add_all(world, ships, {}).value();
  EXPECT_FALSE(world.advance(1.0, map.probe()).value());
  map.set_velocity(world, ids[0], {3, 0, 0}).value();
  EXPECT_EQ(ships.state(0, 1.0).velocity, (Vec3{3, 0, 0}));
  map.teleport(world, ids[1], {{10, 0, 0}, {}}).value();
  EXPECT_EQ(ships.state(1, 1.0), (State{{10, 0, 0}, {}}));
  const auto event = world.advance(10.0, map.probe()).value();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::contact_begin);
  EXPECT_NEAR(event->time, 1.0 + 8.0 / 3.0, 1e-5);
}

TEST(BodyMap, SaysWhatIsWrong) {
  Ballistic balls = rows(2, 0);
  RecordedTracks tracks =
      RecordedTracks::create({{{0, {0, 50, 0}}, {1, {0, 51, 0}}, {2, {0, 52, 0}}}}).value();
  World world = World::create({}).value();
  BodyMap map;
  const BodyId stranger = world.add({.acceleration_limit = 1, .position = {0, 0, 30}}).value();
  const BodyId recorded = map.add(world, tracks, 0).value();
  expect_error(map.set_velocity(world, stranger, {}), ErrorCode::unknown_body, "body",
               "BodyMap::set_velocity: ", stranger);
  expect_error(map.teleport(world, stranger, {}), ErrorCode::unknown_body, "body",
               "BodyMap::teleport: ", stranger);
  expect_error(map.remove(world, stranger), ErrorCode::unknown_body, "body", "BodyMap::remove: ", stranger);
  expect_error(map.set_velocity(world, recorded, {}), ErrorCode::unsupported, "body",
               "set_velocity: ", BodyId{0, 0});
  expect_error(map.add(world, balls, 2), ErrorCode::unknown_body, "body", "BodyMap::add: ", BodyId{2, 0});
  expect_error(map.add_all(world, balls, std::vector{1.0}), ErrorCode::out_of_range, "radii",
               "BodyMap::add_all: ");
  expect_error(map.add(world, balls, 0, {.radius = -1}), ErrorCode::out_of_range, "radius", "add: ");
  EXPECT_EQ(world.size(), 2u);
  EXPECT_THROW((void)map.state(stranger, 0.0), BadResult);
  EXPECT_THROW((void)world.advance(1000.0, map.probe()), BadResult);
  map.remove(world, recorded).value();
  EXPECT_FALSE(tracks.contains(0));
  EXPECT_FALSE(world.contains(recorded));
}

TEST(BodyMap, ChangesNeitherTheMotionNorTheWorldAfterAnError) {
  const Box room{{-9, -9, -9}, {9, 9, 9}};
  SteeredMotion ships = SteeredMotion::create({.start = {{}}, .acceleration_limits = {1}}).value();
  FrameMotion frames = FrameMotion::create({.start = {{5, 0, 0}}, .interval = 1.0}).value();
  World world = World::create({.box = room}).value(), plane = World::create({.dimensions = 2}).value();
  BodyMap map, flat;
  const BodyId ship = map.add(world, ships, 0).value(), framed = map.add(world, frames, 0).value();
  const BodyId disc = flat.add(plane, ships, 0).value();
  const State before = ships.state(0, 0.0);
  expect_error(map.teleport(world, ship, {{99, 0, 0}, {}}), ErrorCode::outside_domain, "position",
               "teleport: ", ship);
  expect_error(map.teleport(world, framed, {{99, 0, 0}, {}}), ErrorCode::outside_domain, "position",
               "teleport: ", framed);
  expect_error(flat.set_velocity(plane, disc, {0, 0, 1}), ErrorCode::out_of_range, "velocity",
               "set_velocity: ", disc);
  world.disable(framed).value();
  expect_error(map.set_velocity(world, framed, {1, 0, 0}), ErrorCode::disabled_body, "body",
               "set_velocity: ", framed);
  const auto probe = [&](std::span<const BodyId> ids, double t, std::span<State> states) {
    expect_error(map.remove(world, ship), ErrorCode::probe_in_progress, "probe", "remove: ");
    map.probe()(ids, t, states);
  };
  EXPECT_FALSE(world.advance(0.0, probe).value());
  world.add({.acceleration_limit = 1, .position = {3, 0, 0}}).value();
  EXPECT_FALSE(world.queries(probe).refresh(ship).value()) << "its report is from now";
  EXPECT_EQ(ships.state(0, 0.0), before);
  EXPECT_EQ(frames.latest().front(), (Vec3{5, 0, 0}));
  EXPECT_TRUE(ships.contains(0));
  EXPECT_TRUE(map.find(ship));
}

TEST(BodyMap, ThatHasServedAnotherWorldSinceSaysSo) {
  Ballistic balls = rows(2, 0), others = rows(1, 50);
  World world = World::create({}).value(), other = World::create({}).value();
  BodyMap map;
  const auto ids = map.add_all(world, balls).value();
  const World copy = world.clone().value();
  EXPECT_EQ(map.find(copy.bodies()[0])->motion, &balls) << "clones keep the ids";
  const BodyId taken = map.add(other, others, 0).value();
  EXPECT_EQ(taken, ids[0]) << "equal but for the world";
  EXPECT_EQ(map.find(taken)->motion, &others);
  EXPECT_FALSE(map.find(ids[0]));
  EXPECT_EQ(map.find(ids[1])->motion, &balls);
  expect_error(map.set_velocity(world, ids[0], {1, 0, 0}), ErrorCode::unknown_body, "body",
               "BodyMap::set_velocity: ", ids[0]);
  try {
    static_cast<void>(map.state(ids[0], 0.0));
    FAIL() << "the state of another body";
  } catch (const BadResult& error) {
    EXPECT_NE(error.error().message.find("another world"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(map.find(BodyId{0, 0})) << "an id that names no world";
  EXPECT_EQ(map.bodies()[0].world, taken.world);
}

template <class Object>
concept HasProbe = requires(Object&& object) {
  static_cast<Object&&>(object).probe();
};
static_assert(HasProbe<Ballistic&> && HasProbe<const BodyMap&> && HasProbe<Simulation&>);
static_assert(!HasProbe<Ballistic> && !HasProbe<BodyMap> && !HasProbe<Simulation>, "its probe would dangle");

TEST(BodyMap, IsMadeAgainForWhatWasRestored) {
  Ballistic balls = rows(3, 0);
  World world = World::create({}).value();
  BodyMap map;
  const BodyId removed = map.add(world, balls, 2).value();
  map.remove(world, removed).value();
  const BodyId late = map.add(world, balls, 1).value();  // in the place of the removed one
  const BodyId other = map.add(world, balls, 0).value();
  EXPECT_EQ(map.bodies(), (std::vector{late, other}));

  Ballistic balls_again = balls;
  BodyMap again;
  for (const BodyId body : map.bodies()) again.connect(body, balls_again, map.find(body)->number).value();
  EXPECT_EQ(again.bodies(), map.bodies());
  EXPECT_EQ(again.find(late)->motion, &balls_again);
  EXPECT_EQ(again.state(late, 1.0).position, map.state(late, 1.0).position);
  EXPECT_FALSE(again.find(removed));
  expect_error(again.connect(late, balls_again, 7), ErrorCode::unknown_body, "body",
               "BodyMap::connect: ", BodyId{7, 0});
  expect_error(again.connect(late, balls_again, 2), ErrorCode::stale_body, "body",
               "BodyMap::connect: ", BodyId{2, 0});
  expect_error(again.connect(no_body, balls_again, 0), ErrorCode::unknown_body, "body",
               "BodyMap::connect: ", no_body);
}

TEST(BodyMap, LeavesBodiesToMotionsThatCannotRemoveThem) {
  Still motion;
  World world = World::create({}).value();
  BodyMap map;
  const BodyId id = map.add(world, motion, 0).value();
  map.remove(world, id).value();
  EXPECT_TRUE(motion.contains(0));
  EXPECT_FALSE(world.contains(id));
  EXPECT_FALSE(map.find(id));
}

TEST(BodyMap, ServesClonesOfItsMotions) {
  Ballistic balls = rows(2, 0), others = rows(1, 100);
  World world = World::create({}).value();
  BodyMap map;
  const auto ids = map.add_all(world, balls).value();
  const BodyId other = map.add(world, others, 0).value();
  Ballistic balls_then = balls, others_then = others;
  const auto then =
      map.with_motions(std::vector<Motion*>{&balls, &others}, std::vector<Motion*>{&balls_then, &others_then})
          .value();
  map.set_velocity(world, ids[1], {5, 0, 0}).value();
  EXPECT_EQ(then->find(ids[1])->motion, &balls_then);
  EXPECT_EQ(then->state(ids[1], 1.0).position, (Vec3{10, 1, 0}));
  EXPECT_EQ(then->find(other)->motion, &others_then);
  expect_error(map.with_motions(std::vector<Motion*>{&balls}, std::vector<Motion*>{&balls_then}),
               ErrorCode::out_of_range, "from", "BodyMap::with_motions: ", other);
  expect_error(map.with_motions(std::vector<Motion*>{&balls}, {}), ErrorCode::out_of_range, "to",
               "BodyMap::with_motions: ");
}

}  // namespace
}  // namespace kinesphere::body_map_test
