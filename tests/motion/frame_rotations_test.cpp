// Rigid bodies whose poses a game pushes: they turn between frames, and meet others where their surfaces do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "kinesphere/body_map.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/random.hpp"
#include "support/expect_error.hpp"
#include "support/test_size.hpp"

namespace kinesphere::frame_rotations_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;

using Places = std::vector<Vec3>;
using Turns = std::vector<Quaternion>;

Quaternion about_z(double angle) { return {std::cos(0.5 * angle), 0, 0, std::sin(0.5 * angle)}; }

FrameMotion one(const Quaternion& start = {}) {
  return FrameMotion::create({.start = {{}}, .interval = 0.5, .rotations = Turns{start}}).value();
}

TEST(FrameRotations, TurnByTheShorterWay) {
  FrameMotion frames = one();
  EXPECT_EQ(frames.rotation(0, 0.0), Rotation{});
  World world = World::create({}).value();
  BodyMap bodies;
  bodies.add_rigid_body(world, frames, 0, {.parts = {{}}}).value();
  bodies.push(world, frames, Places{{}}, Turns{about_z(1.0)}).value();
  EXPECT_NEAR(frames.rotation(0, 0.125)->angular_velocity.z, 2.0, 1e-12);
  EXPECT_NEAR(angle_between(frames.rotation(0, 0.125)->orientation, about_z(0.25)), 0.0, 1e-12);
  EXPECT_EQ(frames.latest_rotations()[0], about_z(1.0));
  while (world.advance(0.5, bodies.probe()).value()) {
  }
  // The negative quaternion is the same orientation.
  const Quaternion same = about_z(1.0 - 3.0);
  bodies.push(world, frames, Places{{}}, Turns{{-same.w, -same.x, -same.y, -same.z}}, 1.5).value();
  EXPECT_NEAR(frames.rotation(0, 1.0)->angular_velocity.z, -3.0, 1e-12);
  EXPECT_NEAR(bodies.rotation({0, 0}, 1.0).angular_velocity.z, -3.0, 1e-12);
  EXPECT_NEAR(angle_between(frames.rotation(0, 1.5)->orientation, about_z(-2.0)), 0.0, 1e-12);
  EXPECT_NEAR(world.body({0, 0})->rigid->rotation.angular_velocity.z, -3.0, 1e-12);
}

TEST(FrameRotations, AreRefusedWithoutASense) {
  const Turns turns{{}, {}};
  FrameMotionDefinition definition{.start = {{}, {9, 0, 0}}, .rotations = Turns{{}}};
  expect_error(FrameMotion::create(definition), ErrorCode::out_of_range, "rotations",
               "FrameMotion::create: ");
  definition.rotations = Turns{{}, {2, 0, 0, 0}};
  expect_error(FrameMotion::create(definition), ErrorCode::out_of_range, "rotations",
               "FrameMotion::create: ", BodyId{1, 0});
  definition.rotations = turns;
  FrameMotion frames = FrameMotion::create(definition).value();
  World world = World::create({}).value();
  BodyMap bodies;
  const auto add = [&](std::uint32_t number, RigidBody like) {
    like.parts = {{}};
    return bodies.add_rigid_body(world, frames, number, like);
  };
  expect_error(add(0, {.inertia = {1, 1, 1}}), ErrorCode::unsupported, "inertia",
               "BodyMap::add_rigid_body: ");
  add(0, {.largest_angular_speed = 10.0}).value();
  add(1, {}).value();
  const Places places = definition.start;
  const auto push = [&](const Turns& rotations, std::optional<double> time = {}) {
    return bodies.push(world, frames, places, rotations, time);
  };
  const std::string call = "BodyMap::push: ";
  expect_error(bodies.push(world, frames, places), ErrorCode::out_of_range, "rotations", call);
  expect_error(push({{}}), ErrorCode::out_of_range, "rotations", call);
  expect_error(push({{}, {0.9, 0, 0, 0}}), ErrorCode::out_of_range, "rotations", call, BodyId{1, 0});
  expect_error(push({{nan, 0, 0, 0}, {}}), ErrorCode::not_finite, "rotations", call, BodyId{0, 0});
  expect_error(push({about_z(1.0), about_z(1.0)}, 0.05), ErrorCode::out_of_range, "angular_velocity",
               call + "change: ", BodyId{0, 0});
  expect_error(frames.push(places, Turns{{}, about_z(0.1)}), ErrorCode::out_of_range, "rotations",
               "push: rotations of body 1 give it a new angular velocity", BodyId{1, 0});
  EXPECT_EQ(frames.latest_time(), 0.0);
  EXPECT_EQ(frames.latest_rotations(), turns);
  EXPECT_EQ(world.body({1, 0})->rigid->rotation, Rotation{});
  expect_error(frames.add(0.0, {}, 1.0, {0, 0, 0, 0}), ErrorCode::out_of_range, "orientation",
               "FrameMotion::add: ");
  FrameMotion balls = FrameMotion::create({.start = places}).value();
  World other = World::create({}).value();
  expect_error(balls.push(other, places, turns), ErrorCode::out_of_range, "rotations", "push: ");
  EXPECT_EQ(balls.rotation(0, 0.0), std::nullopt);
}

/// Balls and bodies of other motions beside rigid ones; bodies that come and go.
TEST(FrameRotations, ConcernRigidBodiesAlone) {
  FrameMotion frames =
      FrameMotion::create({.start = {{}, {9, 0, 0}}, .interval = 1.0, .rotations = Turns{{}, {}}}).value();
  Ballistic flight = Ballistic::create({.start = {{{0, 50, 0}, {}}}}).value();
  World world = World::create({}).value();
  BodyMap bodies;
  const BodyId car = bodies.add_rigid_body(world, frames, 0, {.parts = {{}}}).value();
  bodies.add(world, frames, 1).value();
  const BodyId stone = bodies.add(world, flight, 0).value();
  EXPECT_THROW((void)bodies.rotation(stone, 0.0), BadResult);
  bodies.push(world, frames, frames.latest(), Turns{about_z(0.5), about_z(0.5)}).value();
  while (world.advance(1.0, bodies.probe()).value()) {
  }
  bodies.remove(world, car).value();
  EXPECT_EQ(frames.add(1.0, {{0, -9, 0}, {}}, 1.0, about_z(2.0)).value(), 2u);
  const BodyId late = bodies.add_rigid_body(world, frames, 2, {.parts = {{}}}).value();
  EXPECT_NEAR(angle_between(world.body(late)->rigid->rotation.orientation, about_z(2.0)), 0.0, 1e-12);
  Places places = frames.latest();
  Turns turns{{nan, nan, nan, nan}, {}, about_z(2.5)};
  bodies.push(world, frames, places, turns).value();
  EXPECT_NEAR(bodies.rotation(late, 2.0).angular_velocity.z, 0.5, 1e-12);
  while (world.advance(2.0, bodies.probe()).value()) {
  }
  world.disable(late).value();
  turns[2] = about_z(2.0);
  bodies.push(world, frames, places, turns).value();
  // Copies and bytes turn alike.
  FrameMotion copy = *dynamic_cast<FrameMotion*>(frames.clone().get());
  EXPECT_EQ(copy.rotation(2, 2.5), frames.rotation(2, 2.5));
  FrameMotion elsewhere = FrameMotion::create({.start = {}, .interval = 1.0, .rotations = Turns{}}).value();
  for (int frame = 0; frame < 3; ++frame) elsewhere.push(Places{}, Turns{}).value();
  std::vector<std::byte> bytes;
  frames.write_body(2, bytes).value();
  std::span<const std::byte> rest = bytes;
  EXPECT_EQ(elsewhere.read_body(rest).value(), 0u);
  EXPECT_EQ(elsewhere.rotation(0, 2.5), frames.rotation(2, 2.5));
  EXPECT_EQ(elsewhere.latest_rotations()[0], frames.latest_rotations()[2]);
  FrameMotion balls = FrameMotion::create({.start = {}, .interval = 1.0}).value();
  for (int frame = 0; frame < 3; ++frame) balls.push(Places{}).value();
  rest = bytes;
  EXPECT_EQ(balls.read_body(rest).error().code, ErrorCode::bad_bytes);
}

/// A car: a box with rounded edges, in the axes of the body.
constexpr Vec3 half{2.0, 0.9, 0.7};
constexpr double rounding = 0.05, post = 0.2, tolerance = 1e-4;

/// Returns the gap between the car in this pose and a post, a ball.
double gap(const Vec3& position, const Quaternion& orientation, const Vec3& ball) {
  const Vec3 inside = rotated_back(orientation, ball - position);
  Vec3 out;
  for (int axis = 0; axis < 3; ++axis)
    out[axis] = std::max(0.0, std::abs(inside[axis]) - (half[axis] - rounding));
  return norm(out) - rounding - post;
}

/// A drive through posts, and the poses that the game has of it.
struct Drive {
  explicit Drive(std::uint64_t seed) : random(seed) {
    for (int k = 0; k < 100; ++k)
      posts.push_back({random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(-0.8, 0.8)});
    std::erase_if(posts, [&](const Vec3& at) { return gap(position, orientation, at) < 0.1; });
  }

  /// A step of the game, with sharp turns, and wobbling about all axes.
  void step(double dt) {
    if (random.bits() % 10 == 0) steering = random.uniform(-4, 4);
    heading += steering * dt;
    position += Vec3{std::cos(heading), std::sin(heading), 0} * (12.0 * dt);
    for (int axis = 0; axis < 2; ++axis)
      if (std::abs(position[axis]) > 15.0) heading += pi * dt;
    const Vec3 wobble{random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), 0};
    orientation = after(about_z(heading), rotation_by(wobble));
  }

  Random random;
  Vec3 position{};
  Quaternion orientation{};
  double heading = 0.0, steering = 0.0;
  Places posts;
};

/// Which bodies of a game at 20 Hz have an angular acceleration limit, and so need a RotationProbe.
class DrivenCar : public testing::TestWithParam<bool> {};

TEST_P(DrivenCar, MeetsPostsWhereItsSurfaceDoes) {
  const unsigned rounds = rounds_of(4u);
  std::uint64_t met = 0, checked_speeds = 0;
  for (std::uint64_t seed = 1; seed <= rounds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Drive drive(seed);
    FrameMotion frames =
        FrameMotion::create(
            {.start = {drive.position}, .interval = 1.0 / 20, .rotations = Turns{drive.orientation}})
            .value();
    World world = World::create({.contact_tolerance = tolerance}).value();
    BodyMap bodies;
    RigidBody like{
        .parts = {box_part(Box{Vec3{} - half + Vec3{1, 1, 1} * rounding, half - Vec3{1, 1, 1} * rounding},
                           rounding)}};
    if (GetParam()) {
      like.angular_acceleration_limit = 1.0;
      like.largest_angular_speed = 60.0;
      world.set_rotation_probe(bodies.rotation_probe()).value();
    }
    const BodyId car = bodies.add_rigid_body(world, frames, 0, like).value();
    std::vector<BodyId> posts;
    for (const Vec3& at : drive.posts) posts.push_back(world.add_static({.shape = Ball{at, post}}).value());
    std::vector<bool> touches(posts.size());
    double time = 0.0;
    for (int frame = 0; frame < 200; ++frame) {
      const Vec3 from = drive.position;
      const Quaternion before = frames.latest_rotations()[0];
      const double dt = frame % 5 == 4 ? drive.random.uniform(0.02, 0.09) : 1.0 / 20;
      drive.step(dt);
      time = frames.latest_time() + dt;
      bodies.push(world, frames, Places{drive.position}, Turns{drive.orientation}, time).value();
      // The poses in between, by a formula of their own: the quaternion on the great circle.
      const auto orientation_at = [&](double share) {
        const Quaternion& a = before;
        Quaternion b = drive.orientation;
        double cosine = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
        if (cosine < 0.0) b = {-b.w, -b.x, -b.y, -b.z}, cosine = -cosine;
        const double angle = std::acos(std::min(1.0, cosine));
        if (angle < 1e-9) return a;
        const double p = std::sin((1 - share) * angle) / std::sin(angle);
        const double q = std::sin(share * angle) / std::sin(angle);
        return Quaternion{p * a.w + q * b.w, p * a.x + q * b.x, p * a.y + q * b.y, p * a.z + q * b.z};
      };
      const auto gap_at = [&](std::size_t k, double t) {
        const double share = (t - frames.previous_time()) / dt;
        return gap(from + (drive.position - from) * share, orientation_at(share), drive.posts[k]);
      };
      std::vector<std::optional<double>> begun(posts.size());  // the first time in this frame
      std::vector<bool> has_ended(posts.size());
      for (const Event& event : world.events(time, bodies.probe())) {
        ASSERT_NE(event.kind, EventKind::bound_violation);
        const BodyId other = event.first == car ? event.second : event.first;
        const auto k = static_cast<std::size_t>(std::ranges::find(posts, other) - posts.begin());
        ASSERT_LT(k, posts.size());
        if (event.kind == EventKind::contact_end) {
          touches[k] = false;
          has_ended[k] = true;
          EXPECT_GT(gap_at(k, event.time), tolerance);
        }
        // A body in touch that approaches anew begins again.
        if (event.kind != EventKind::contact_begin || touches[k]) continue;
        EXPECT_LE(std::abs(gap_at(k, event.time)), 1.01 * tolerance);
        touches[k] = true;
        if (!begun[k] && !has_ended[k]) begun[k] = event.time;
        ++met;
        const bool is_first = event.first == car;
        const Vec3& spin = is_first ? event.first_angular_velocity : event.second_angular_velocity;
        EXPECT_NEAR(norm(spin), angle_between(before, drive.orientation) / dt, 1e-6);
        EXPECT_LT(
            norm((is_first ? event.first_state : event.second_state).velocity - (drive.position - from) / dt),
            1e-9);
        // The gap closes as fast as the surfaces approach each other.
        const double h = 1e-6;
        if (event.time - h < frames.previous_time() || event.time + h > time) continue;
        const double closing = (gap_at(k, event.time - h) - gap_at(k, event.time + h)) / (2 * h);
        EXPECT_NEAR(event.approach_speed, closing, 0.01 * (1.0 + std::abs(closing)));
        ++checked_speeds;
      }
      for (std::size_t k = 0; k < posts.size(); ++k) {
        const bool touched = touches[k] || has_ended[k];
        for (int part = 0; part <= 200; ++part) {
          const double t = frames.previous_time() + dt * part / 200;
          if (gap_at(k, t) >= -tolerance) continue;
          // In touch at every instant at which the surfaces overlap.
          ASSERT_TRUE(touched) << "post " << k << " is missed at " << t << ", frame " << frame;
          EXPECT_LE(begun[k].value_or(0.0), t);
        }
      }
    }
  }
  EXPECT_GT(met, 10 * rounds);
  EXPECT_GT(checked_speeds, 10 * rounds);
}

INSTANTIATE_TEST_SUITE_P(FrameRotations, DrivenCar, testing::Bool(),
                         [](const auto& test) { return test.param ? "WithARotationProbe" : "AsItIs"; });

}  // namespace
}  // namespace kinesphere::frame_rotations_test
