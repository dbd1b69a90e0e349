// Turning boxes and hulls where the time of a contact is known by other means: faces that rest and slide on
// each other, edges that graze, boxes that bounce, boxes in the plane, and wrong calls.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "kinesphere/response.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::hulls_test {
namespace {

constexpr double tolerance = 1e-9;

class Hulls : public testing::Test {
 protected:
  /// A cube with edges of length 1.
  static RigidBody cube(const Vec3& position, const Vec3& velocity = {}, const Vec3& spin = {}) {
    return {.body = {.position = position, .velocity = velocity},
            .parts = {box_part({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, 0.0)},
            .rotation = {.angular_velocity = spin},
            .inertia = {1.0 / 6, 1.0 / 6, 1.0 / 6}};
  }

  Playground p{WorldDefinition{.contact_tolerance = tolerance}};
};

TEST_F(Hulls, ACubeRestsOnAnotherAndSlidesOff) {
  p.add_rigid_body(cube({0, 0, 0}));
  const BodyId upper = p.add_rigid_body(cube({0.2, 0.1, 1.0}));
  const auto begin = p.advance(1.0);
  ASSERT_TRUE(begin && begin->kind == EventKind::contact_begin);
  EXPECT_NEAR(std::abs(begin->normal.z), 1.0, 1e-12);
  EXPECT_NEAR(begin->gap, 0.0, 1e-12);
  EXPECT_FALSE(p.advance(1000.0));
  EXPECT_LT(p.world.counters().probes, 100u);
  p.set_velocity(upper, {0.5, 0.25, 0});
  const auto end = p.advance(2000.0);
  ASSERT_TRUE(end && end->kind == EventKind::contact_end);
  EXPECT_NEAR(end->time, 1000.0 + 0.8 / 0.5, 1e-7);
  EXPECT_LT(p.world.counters().probes, 1000u);
}

/// A mesh is hollow: one triangle for each half of a face of a cube, which turns by a quarter and moves on.
TEST_F(Hulls, AMeshThatMovesIsABodyOfPlates) {
  RigidBody mesh{.body = {.velocity = {1, 0, 0}, .mass = 1e9}, .inertia = {1e9, 1e9, 1e9}};
  const Vec3 axes[] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  for (int k = 0; k < 6; ++k) {
    const Vec3 face = axes[k / 2] * (k % 2 == 0 ? 1.0 : -1.0);
    const Vec3 along = axes[(k / 2 + 1) % 3];
    const Vec3 across = axes[(k / 2 + 2) % 3];
    const Vec3 a = face - along - across;
    const Vec3 c = face + along + across;
    for (const Vec3& b : {face + along - across, face - along + across})
      mesh.parts.push_back(hull_part(std::vector{a, b, c}, 0.0));
  }
  const double quarter = 0.5 * std::numbers::pi;
  mesh.rotation = {rotation_by({0, quarter, 0}), {quarter / 1.5, 0, 0}};
  const BodyId cube = p.add_rigid_body(mesh);
  const BodyId inside = p.add({.radius = 0.5, .position = {0.1, 0.2, 0.3}});
  const BodyId outside = p.add({.radius = 0.5, .position = {4, 0.1, 0.2}});
  const auto events = p.run(1.7);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].first, cube);
  EXPECT_EQ(events[0].second, outside);
  EXPECT_NEAR(events[0].time, 1.5, 1e-8);
  EXPECT_NEAR(events[0].normal.x, 1.0, 1e-8);
  EXPECT_EQ(events[1].second, inside);
  EXPECT_NEAR(events[1].time, 1.6, 1e-8);
  EXPECT_NEAR(events[1].normal.x, 1.0, 1e-8);
}

/// A cube spins about z; its edge passes the face of another one within `beyond`, which is negative for a
/// hit.
TEST_F(Hulls, EdgesGrazeAtAHundredRadiansPerTime) {
  const double reach = 0.5 * std::numbers::sqrt2;
  for (const double beyond : {1e-3, 1e-6, 5e-9, -5e-9, -1e-6, -1e-3}) {
    p = Playground(WorldDefinition{.contact_tolerance = tolerance});
    p.add_rigid_body(cube({0, 0, 0}, {}, {0, 0, 100}));
    p.add_rigid_body(cube({reach + 0.5 + beyond, 0, 0.3}));
    const auto event = p.advance(0.05);
    ASSERT_EQ(event.has_value(), beyond < 0.0) << beyond;
    if (!event) continue;
    // The gap is the tolerance at most when the contact is told, and what is left of it before.
    const auto time_at = [&](double gap) {
      return (std::numbers::pi / 4 - std::acos(std::min((reach + beyond - gap) / reach, 1.0))) / 100.0;
    };
    EXPECT_GE(event->time, time_at(tolerance) - 1e-12);
    EXPECT_LE(event->time, time_at(0.0) + 1e-12);
    EXPECT_NEAR(event->normal.x, 1.0, 1e-6);
  }
}

TEST_F(Hulls, NeedlesCrossWhereTheirEdgesMeet) {
  // Each 1000 times as long as thick; one turns about z above the other, the gap between them is `above`.
  for (const double above : {1e-7, -1e-7}) {
    p = Playground(WorldDefinition{.contact_tolerance = tolerance});
    RigidBody needle = cube({});
    needle.parts = {box_part({{-0.5, -0.0005, -0.0005}, {0.5, 0.0005, 0.0005}}, 0.0)};
    p.add_rigid_body(needle);
    needle.body.position = {0.6, 0.0, 0.001 + above};
    needle.rotation.orientation = rotation_by({0, 0, std::numbers::pi / 2});
    needle.body.velocity = {-0.5, 0, 0};
    p.add_rigid_body(needle);
    const auto event = p.advance(1.0);
    ASSERT_EQ(event.has_value(), above < 0.0);
    if (event) {
      EXPECT_NEAR(event->time, (0.6 - 0.5005) / 0.5, 1e-8);
    }
  }
}

TEST_F(Hulls, BoxesThatBounceKeepTheirEnergy) {
  Random random(3);
  p = Playground(WorldDefinition{.box = Box{{-3, -3, -3}, {3, 3, 3}},
                                 .contact_tolerance = tolerance,
                                 .contacts = ContactEvents::impacts});
  std::vector<BodyId> ids;
  for (int k = 0; k < 8; ++k) {
    const auto side = [k](int bit) { return k >> bit & 1 ? 1.5 : -1.5; };
    RigidBody body = cube({side(0), side(1), side(2)}, random.point_in_ball(), 3.0 * random.point_in_ball());
    body.parts[0].radius = 1e-6;
    ids.push_back(p.add_rigid_body(body));
  }
  const auto energy = [&] {
    double sum = 0.0;
    for (const BodyId id : ids)
      sum += 0.5 * norm_squared(p.state(id).velocity) +
             norm_squared(p.world.body(id)->rigid->rotation.angular_velocity) / 12;
    return sum;
  };
  const double before = energy();
  int bounces = 0;
  p.run(30.0, [&](const Event& event) {
    ++bounces;
    ASSERT_GE(event.gap, -2.0 * tolerance) << event;
    const Bounce after = bounce(event, 1.0);
    p.set_velocity(event.first, after.first_velocity);
    p.world.change(event.first, {.angular_velocity = after.first_angular_velocity}).value();
    if (event.second == no_body) return;
    p.set_velocity(event.second, after.second_velocity);
    p.world.change(event.second, {.angular_velocity = after.second_angular_velocity}).value();
  });
  EXPECT_GT(bounces, 100);
  EXPECT_NEAR(energy(), before, 1e-11 * before);
}

/// A cube hops within the tolerance: not the gap but the turn of its velocity is the event.
TEST_F(Hulls, ASharpCubeThatComesBackWithinTheToleranceIsAnImpact) {
  p = Playground(WorldDefinition{.contact_tolerance = 0.01, .contacts = ContactEvents::impacts});
  p.add_rigid_body(cube({}));
  RigidBody upper = cube({0.1, 0.2, 1.005}, {0, 0, 0.01});
  upper.body.planned_acceleration.z = -1;
  p.add_rigid_body(upper);
  const auto event = p.advance(1.0);
  ASSERT_TRUE(event);
  EXPECT_GT(event->approach_speed, 0.0);
  EXPECT_GT(event->gap, -1e-9);
}

TEST_F(Hulls, ASquareInThePlaneTurnsIntoABox) {
  p = Playground(WorldDefinition{.dimensions = 2, .contact_tolerance = tolerance});
  RigidBody square = cube({}, {}, {0, 0, 2});
  square.parts = {box_part({{-0.5, -0.5, 0}, {0.5, 0.5, 0}}, 0.0)};
  EXPECT_EQ(square.parts[0].more.size(), 2u);
  p.add_rigid_body(square);
  ASSERT_TRUE(p.world.add_static({.shape = Box{{0.6, -9, 0}, {2, 9, 0}}}));
  const auto event = p.advance(1.0);
  ASSERT_TRUE(event);
  const double reach = 0.5 * std::numbers::sqrt2;
  EXPECT_NEAR(event->time, (std::numbers::pi / 4 - std::acos(0.6 / reach)) / 2.0, 1e-8);
  EXPECT_NEAR(event->normal.x, 1.0, 1e-12);
}

TEST(HullErrors, NameTheCulprit) {
  World world = World::create({}).value();
  std::vector<Vec3> points;
  for (int k = 0; k < 65; ++k) points.push_back({std::cos(k), std::sin(k), 0.01 * k});
  RigidBody body{.parts = {hull_part(points, 0.0)}};
  expect_error(world.add_rigid_body(body), ErrorCode::out_of_range, "parts", "add_rigid_body");
  points.pop_back();
  body.parts = {hull_part(points, 0.0)};
  EXPECT_TRUE(world.add_rigid_body(body));
  body.parts = {hull_part({}, 0.0)};
  expect_error(world.add_rigid_body(body), ErrorCode::not_finite, "parts", "add_rigid_body");
  body.parts = {hull_part(points, 0.0)};
  body.parts[0].more[7].y = std::nan("");
  expect_error(world.add_rigid_body(body), ErrorCode::not_finite, "parts", "add_rigid_body");
  const World copy = World::restore(world.save().value()).value();
  EXPECT_EQ(copy.size(), 1u);
}

}  // namespace
}  // namespace kinesphere::hulls_test
