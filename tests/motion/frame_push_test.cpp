// Frames pushed to a world: new velocities are known there, and entries of removed bodies are found out.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "kinesphere/body_map.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/random.hpp"
#include "support/expect_error.hpp"
#include "support/straight_frames.hpp"

namespace kinesphere::frame_push_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3 nowhere{nan, nan, nan};

using Places = std::vector<Vec3>;

/// Frames of one time unit, and a world with their bodies, balls of radius 1.
struct Game {
  explicit Game(Places start, std::vector<double> limits = {})
      : places(std::move(start)),
        frames(
            FrameMotion::create({.start = places, .acceleration_limits = std::move(limits), .interval = 1.0})
                .value()),
        ids(bodies.add_all(world, frames).value()) {}

  /// Pushes the places and returns the contacts that begin in the frame.
  std::vector<Event> frame() {
    bodies.push(world, frames, places).value();
    std::vector<Event> begins;
    for (const Event& event : world.events(frames.latest_time(), bodies.probe())) {
      EXPECT_NE(event.kind, EventKind::bound_violation);
      if (event.kind == EventKind::contact_begin) begins.push_back(event);
    }
    return begins;
  }

  Places places;
  FrameMotion frames;
  World world = World::create({}).value();
  BodyMap bodies;
  std::vector<BodyId> ids;
};

/// A body that is put to another place across a body at rest, with and without a limit that permits nothing.
TEST(PushedFrames, JumpThroughNothing) {
  for (const std::vector<double>& limits : {std::vector<double>{}, std::vector<double>{1.0, 1.0}}) {
    Game game({{0, 0, 0}, {-5, 0, 0}}, limits);
    for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(game.frame().empty());
    game.places[1] = {5, 0, 0};
    const std::vector<Event> begins = game.frame();
    ASSERT_EQ(begins.size(), 1u);
    EXPECT_NEAR(begins[0].time, 3.3, 1e-6);
    EXPECT_TRUE(game.frame().empty()) << "it stands again";
    EXPECT_EQ(game.frames.violations().size(), limits.empty() ? 0u : 1u);
  }
}

TEST(PushedFrames, AreRefusedWithoutTheWorldThatHasToKnow) {
  Game game({{}, {10, 0, 0}}, {std::numeric_limits<double>::infinity(), 4.0});
  game.frames.push(game.places).value();
  const Places turned = {{1, 0, 0}, {10, 0, 0}}, violating = {{}, {18, 0, 0}};
  expect_error(game.frames.push(turned), ErrorCode::out_of_range, "positions", "push: ", BodyId{0, 0});
  EXPECT_EQ(game.frames.push(turned).error().message,
            "push: positions of body 0 give it a new velocity, which its world has to know: call push(world, "
            "positions), or BodyMap::push");
  EXPECT_EQ(game.frames.push(violating).error().message,
            "push: positions of body 1 give it a new velocity (acceleration 8, with a limit of 4), which its "
            "world has to know: call push(world, positions), or BodyMap::push");
  EXPECT_EQ(game.frames.latest_time(), 1.0) << "as it was";
  EXPECT_EQ(game.frames.latest()[1], (Vec3{10, 0, 0}));
}

TEST(PushedFrames, ChangeNothingOnAnError) {
  Game game({{}, {10, 0, 0}, {20, 0, 0}});
  const Places moved = {{1, 0, 0}, {10, 1, 0}, {20, 0, 0}};
  const auto unchanged = [&] {
    EXPECT_EQ(game.frames.latest_time(), 0.0);
    EXPECT_EQ(game.frames.latest(), game.places);
    for (const BodyId id : game.ids) EXPECT_EQ(game.world.body(id)->bound.velocity, Vec3{});
  };
  expect_error(game.bodies.push(game.world, game.frames, Places{{}}), ErrorCode::out_of_range, "positions",
               "BodyMap::push: ");
  expect_error(game.bodies.push(game.world, game.frames, Places{{1, 0, 0}, {10, nan, 0}, {}}),
               ErrorCode::not_finite, "positions", "BodyMap::push: ", game.ids[1]);
  expect_error(game.bodies.push(game.world, game.frames, Places{{1, 0, 0}, {1e110, 0, 0}, {}}),
               ErrorCode::out_of_range, "velocity", "BodyMap::push: set_velocities: ", game.ids[1]);
  BodyMap stranger;
  expect_error(stranger.push(game.world, game.frames, moved), ErrorCode::unknown_body, "frames",
               "BodyMap::push: ", BodyId{0, 0});
  World later = World::create({.start_time = 0.5}).value();
  expect_error(game.frames.push(later, moved), ErrorCode::out_of_range, "world", "push: ");
  unchanged();
  // One who removes a body from the world alone is told which.
  game.world.remove(game.ids[2]).value();
  const auto forgotten = game.bodies.push(game.world, game.frames, Places{{}, {10, 0, 0}, {21, 0, 0}});
  expect_error(forgotten, ErrorCode::stale_body, "body",
               "BodyMap::push: set_velocities: body 2 has been removed", game.ids[2]);
  EXPECT_EQ(game.frames.latest(), game.places);
  // One who forgets to advance the world is told in the next frame.
  game.bodies.push(game.world, game.frames, moved).value();
  expect_error(game.bodies.push(game.world, game.frames, moved), ErrorCode::out_of_range, "world",
               "BodyMap::push: ");
}

TEST(PushedFrames, GoToWorldsWithAndWithoutAMap) {
  FrameMotion frames = FrameMotion::create({.start = {{}, {10, 0, 0}}, .interval = 1.0}).value();
  World world = World::create({}).value();
  for (std::uint32_t body = 0; body < 2; ++body) world.add(frames.definition(body, 0.0)).value();
  frames.push(world, Places{{4, 0, 0}, {10, 0, 0}}).value();
  EXPECT_FALSE(world.advance(1.0, frames.probe()).value());
  frames.push(world, Places{{12, 0, 0}, {10, 0, 0}}).value();
  const auto begin = world.advance(2.0, frames.probe()).value();
  ASSERT_TRUE(begin);
  EXPECT_EQ(begin->kind, EventKind::contact_begin);
  EXPECT_NEAR(begin->time, 1.5, 1e-6);
}

TEST(PushedFrames, SkipDisabledBodies) {
  Game game({{}, {10, 0, 0}, {20, 0, 0}});
  game.world.disable(game.ids[1]).value();
  game.places = {{1, 0, 0}, {10, 5, 0}, {17, 0, 0}};
  EXPECT_TRUE(game.frame().empty());
  EXPECT_EQ(game.world.body(game.ids[2])->bound.velocity, (Vec3{-3, 0, 0}));
  game.world.enable(game.ids[1], game.frames.state(1, 1.0)).value();
  game.places[1] = {17, 0, 0};
  EXPECT_EQ(game.frame().size(), 1u);
}

TEST(PushedFrames, FindOutTheEntryOfARemovedBody) {
  Game game({{}, {10, 0, 0}, {40, 0, 0}});
  game.frame();
  game.bodies.remove(game.world, game.ids[2]).value();
  EXPECT_NE(game.frames.latest()[2], game.frames.latest()[2]) << "NaN";
  // A body that comes in the frame of the removal gets a number, and so an entry, of its own.
  const State spawned{{-40, 0, 0}, {}};
  EXPECT_EQ(game.frames.add(game.world.time(), spawned).value(), 3u);
  game.bodies.add(game.world, game.frames, 3).value();
  expect_error(game.bodies.push(game.world, game.frames, game.places), ErrorCode::out_of_range, "positions",
               "BodyMap::push: ");
  game.places.push_back(spawned.position);
  expect_error(game.bodies.push(game.world, game.frames, game.places), ErrorCode::stale_body, "positions",
               "BodyMap::push: ", BodyId{2, 0});
  game.places[2] = nowhere;
  EXPECT_TRUE(game.frame().empty());
  // Later the number is used again. The entry of the removed body has become NaN, and is refused.
  EXPECT_EQ(game.frames.add(game.world.time(), {{-20, 0, 0}, {}}).value(), 2u);
  game.bodies.add(game.world, game.frames, 2).value();
  expect_error(game.bodies.push(game.world, game.frames, game.places), ErrorCode::not_finite, "positions",
               "BodyMap::push: ", BodyId{2, 0});
  game.places = game.frames.latest();
  EXPECT_TRUE(game.frame().empty()) << "it stands where it came";
  EXPECT_EQ(game.frames.state(2, game.world.time()).position, (Vec3{-20, 0, 0}));
}

/// A game with bodies that come, turn, jump and go. Truth: the smallest distance of each pair on the straight
/// lines of a frame.
TEST(PushedFrames, LoseAndInventNoContactWhereBodiesComeAndGo) {
  StraightFrames truth(2.0, 1e-5);
  std::uint64_t reused = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto anywhere = [&] { return 15.0 * random.point_in_ball(); };
    Places start;
    for (int body = 0; body < 24; ++body) start.push_back(anywhere());
    Game game(start);
    std::vector<Vec3> velocities(start.size());
    for (int frame = 0; frame < 100; ++frame) {
      if (random.bits() % 2 == 0) {
        const auto body = static_cast<std::uint32_t>(random.bits() % game.ids.size());
        if (game.frames.contains(body)) game.bodies.remove(game.world, game.ids[body]).value();
      }
      game.places = game.frames.latest();
      if (random.bits() % 2 == 0) {
        const Vec3 place = anywhere();
        const std::uint32_t body = game.frames.add(game.world.time(), {place, {}}).value();
        const BodyId id = game.bodies.add(game.world, game.frames, body).value();
        reused += body < game.ids.size() ? 1 : 0;
        game.ids.resize(game.frames.size());
        velocities.resize(game.frames.size());
        game.ids[body] = id;
        game.places = game.frames.latest();
      }
      const Places before = game.places;
      for (std::size_t body = 0; body < game.places.size(); ++body) {
        if (random.bits() % 4 == 0) velocities[body] = 5.0 * random.point_in_ball();
        if (random.bits() % 16 == 0) velocities[body] = {};
        game.places[body] += velocities[body];
        if (norm(game.places[body]) > 30.0) game.places[body] = anywhere();
      }
      BegunPairs begun(game.ids.size(), std::vector<bool>(game.ids.size()));
      for (const Event& event : game.frame()) {
        const auto first = game.bodies.find(event.first)->number,
                   second = game.bodies.find(event.second)->number;
        begun[first][second] = begun[second][first] = true;
      }
      SCOPED_TRACE("frame " + std::to_string(frame));
      truth.expect(before, game.places, begun,
                   [&](std::uint32_t body) { return game.frames.contains(body); });
    }
  }
  EXPECT_GT(truth.met, 200u);
  EXPECT_GT(truth.apart, 10000u);
  EXPECT_GT(reused, 50u);
}

}  // namespace
}  // namespace kinesphere::frame_push_test
