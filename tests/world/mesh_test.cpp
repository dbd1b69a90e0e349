// Meshes in a world: one body, which is met like one surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "kinesphere/limits.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/recording.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/simulation.hpp"
#include "kinesphere/to_string.hpp"
#include "support/expect_error.hpp"
#include "world/surroundings.hpp"

namespace kinesphere::mesh_test {
namespace {

using Corners = std::vector<std::array<std::uint32_t, 3>>;

/// n x m cells of two triangles each, with edges of length `edge`; height(x, y) gives the surface.
template <class Height>
Mesh surface(std::uint32_t n, std::uint32_t m, double edge, Height height) {
  std::vector<Vec3> vertices;
  Corners corners;
  for (std::uint32_t y = 0; y <= m; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) vertices.push_back({edge * x, edge * y, height(x, y)});
  for (std::uint32_t y = 0; y < m; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t first = y * (n + 1) + x;
      corners.push_back({first, first + 1, first + n + 2});
      corners.push_back({first, first + n + 2, first + n + 1});
    }
  return Mesh::create(vertices, corners).value();
}
Mesh flat_floor(std::uint32_t n, std::uint32_t m, double edge = 1.0) {
  return surface(n, m, edge, [](std::uint32_t, std::uint32_t) { return 0.0; });
}
Mesh hills(std::uint32_t n, double edge, std::uint64_t seed) {
  Random random(seed);
  return surface(n, n, edge, [&](std::uint32_t, std::uint32_t) { return edge * random.uniform(); });
}

/// A ball that slides and hops over a floor of triangles, without friction, goes straight on.
class FlatFloor : public testing::TestWithParam<double> {};

TEST_P(FlatFloor, NeitherTurnsNorBrakesNorThrowsABall) {
  const double eps = GetParam();
  World world = World::create({.contact_tolerance = eps, .contacts = ContactEvents::impacts}).value();
  const BodyId floor = world.add_static({.shape = flat_floor(40, 4)}).value();
  Ballistic motion =
      Ballistic::create({.start = {{{1.3, 1.7, 0.5 + 0.5 * eps}, {10, 0.7, 0}}}, .gravity = {0, 0, -10}})
          .value();
  BodyMap map;
  const BodyId ball = map.add(world, motion, 0, {.radius = 0.5}).value();
  const double rest = 2 * least_resting_speed(eps, 10);
  double highest = 0;
  int begins = 0;
  for (const Event& event : world.events(3.0, map.probe())) {
    ASSERT_NE(event.kind, EventKind::zeno_guard);
    if (event.kind != EventKind::contact_begin) continue;
    ++begins;
    EXPECT_EQ(event.partner_of(ball), floor);
    EXPECT_EQ(event.normal.x, 0.0);
    EXPECT_EQ(event.normal.y, 0.0);
    const Bounce after = settle(event, 0.0, rest);
    map.set_velocity(world, ball, event.first == ball ? after.first_velocity : after.second_velocity).value();
    const Vec3 velocity = map.state(ball, event.time).velocity;
    EXPECT_EQ(velocity.x, 10.0) << event;
    EXPECT_EQ(velocity.y, 0.7) << event;
    highest = std::max(highest, velocity.z);
  }
  EXPECT_GT(begins, 10);
  EXPECT_LE(highest, rest * (1 + 1e-12));
  const State last = map.state(ball, 3.0);
  EXPECT_NEAR(last.position.x, 31.3, 1e-12);
  EXPECT_NEAR(last.position.y, 3.8, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Tolerances, FlatFloor, testing::Values(1e-2, 1e-3, 1e-4, 1e-5, 1e-6));

/// Also where six triangles meet.
TEST(MeshContact, ABallThatLandsOnEdgesHasOneContact) {
  for (const Vec3& at : {Vec3{2, 2, 5}, Vec3{2.5, 2, 5}, Vec3{2.5, 2.5, 5}, Vec3{2.3, 2.6, 5}}) {
    Surroundings p;
    const BodyId floor = p.place(flat_floor(4, 4));
    const BodyId ball = p.add({.radius = 1, .position = at, .velocity = {0, 0, -1}});
    const auto events = p.run(20.0, [&](const Event& event) { p.bounce(event); });
    ASSERT_EQ(events.size(), 2u) << events;
    EXPECT_EQ(events[0].kind, EventKind::contact_begin);
    EXPECT_EQ(events[0].partner_of(ball), floor);
    EXPECT_NEAR(events[0].time, 4.0, 1e-4);
    EXPECT_EQ(events[1].kind, EventKind::contact_end);
    EXPECT_EQ(p.state(ball).velocity, (Vec3{0, 0, 1}));
    EXPECT_TRUE(is_clean(p.world));
  }
}

TEST(MeshContact, EventsNameTheTriangle) {
  const Mesh floor = flat_floor(4, 4);
  for (const bool is_first : {false, true}) {
    Surroundings p;
    if (is_first) p.place(floor);
    const BodyId ball = p.add({.radius = 0.1, .position = {2.7, 1.2, 5}, .velocity = {0, 0, -1}});
    if (!is_first) p.place(floor);
    const auto events = p.run(6.0);
    ASSERT_FALSE(events.empty());
    const std::uint32_t number = events[0].first == ball ? events[0].second_part : events[0].first_part;
    EXPECT_EQ(number, 2u * (4u + 2u)) << "row 1, column 2, the lower half";
    EXPECT_EQ(events[0].first == ball ? events[0].first_part : events[0].second_part, 0u);
    EXPECT_EQ(events[0].normal, (events[0].first == ball ? Vec3{0, 0, -1} : Vec3{0, 0, 1}));
  }
}

TEST(MeshContact, AHoleIsFallenThrough) {
  const Mesh whole = flat_floor(4, 4);
  Corners corners(whole.corners().begin(), whole.corners().end());
  corners.erase(corners.begin() + 20, corners.begin() + 22);  // the cell from (2, 2) to (3, 3)
  Surroundings p;
  p.place(Mesh::create(whole.vertices(), corners).value());
  p.add({.radius = 0.4, .position = {2.5, 2.5, 5}, .velocity = {0, 0, -1}});
  const BodyId wide = p.add({.radius = 0.6, .position = {2.5, 2.5, 9}, .velocity = {0, 0, -1}});
  const auto events = p.run(30.0, [&](const Event& event) { p.bounce(event); });
  ASSERT_GE(events.size(), 1u);
  EXPECT_NEAR(events[0].time, 9.0 - std::sqrt(0.36 - 0.25), 1e-4) << "meets the borders";
  for (const Event& event : events) EXPECT_TRUE(event.first == wide || event.second == wide) << event;
}

/// Balls over hills, against exact distances from every triangle.
TEST(MeshContact, AmongHillsIsToldAsBruteForceFindsIt) {
  for (const std::uint64_t seed : {11u, 12u, 13u, 14u}) {
    SCOPED_TRACE(seed);
    constexpr double eps = 1e-5;
    Random random(seed);
    Surroundings p({.contact_tolerance = eps});
    const BodyId ground = p.place(hills(6, 1.0, seed));
    std::vector<BodyId> balls;
    for (int k = 0; k < 12; ++k)
      balls.push_back(p.add({.radius = 0.05 + 0.3 * random.uniform(),
                             .acceleration_limit = 2,
                             .position = {0.5 + k % 4 * 1.5, 0.5 + k / 4 * 2.0, 3},
                             .velocity = random.point_in_ball()},
                            Vec3{0, 0, -1}));
    std::set<BodyId> touching;
    int met = 0;
    const auto answer = [&](const Event& event) {
      if (event.kind == EventKind::contact_begin && event.partner_of(ground) != no_body) {
        const BodyId ball = event.partner_of(ground);
        EXPECT_TRUE(touching.insert(ball).second) << event;
        EXPECT_NEAR(event.gap, p.gap_to(ball, ground), 1e-12);
        EXPECT_LE(event.gap, eps);
        ++met;
      }
      if (event.kind == EventKind::contact_end && event.partner_of(ground) != no_body) {
        EXPECT_EQ(touching.erase(event.partner_of(ground)), 1u) << event;
      }
      p.bounce(event);
    };
    for (double time = 0.05; time < 6.0; time += 0.05) {
      p.run(time, answer);
      for (const BodyId ball : balls) {
        const double gap = p.gap_to(ball, ground);
        ASSERT_TRUE(gap >= -eps || touching.contains(ball)) << time << ", gap " << gap;
        ASSERT_TRUE(gap <= 5 * eps || !touching.contains(ball)) << time << ", gap " << gap;
      }
      ASSERT_TRUE(is_clean(p.world));
    }
    EXPECT_GE(met, 8);
  }
}

/// A crate and a capsule that slide over a floor keep their speed.
TEST(MeshContact, RigidBodiesSlideOverEdges) {
  for (const bool is_crate : {true, false}) {
    Surroundings p({.contact_tolerance = 1e-4});
    p.place(flat_floor(20, 4));
    const RigidPart part = is_crate ? box_part({{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}}, 0.1)
                                    : RigidPart{{-0.5, 0, 0}, {0.5, 0, 0}, 0.5};
    const BodyId body =
        p.add_rigid_body({.body = {.position = {2, 2, 1}, .velocity = {3, 0.1, -0.5}}, .parts = {part}});
    int begins = 0;
    p.run(4.0, [&](const Event& event) {
      if (event.kind != EventKind::contact_begin) return;
      ++begins;
      EXPECT_LT(std::abs(event.normal.x) + std::abs(event.normal.y), 1e-12) << event;
      const Vec3 velocity = p.state(body).velocity;
      p.set_velocity(body, {velocity.x, velocity.y, 0.0});
    });
    EXPECT_EQ(begins, 1);
    EXPECT_EQ(p.state(body).velocity, (Vec3{3, 0.1, 0}));
    EXPECT_TRUE(is_clean(p.world));
  }
}

TEST(MovingMesh, LiftsABall) {
  Surroundings p;
  const MovingShape lift{{.velocity = {0, 0, 1}, .mass = infinity}, flat_floor(4, 4)};
  const BodyId id = p.world.add_moving_shape(lift).value();
  p.start_course(id, lift.body);
  EXPECT_EQ(p.world.body(id)->definition.radius, std::sqrt(32.0) * (1.0 + 0x1p-47)) << "around the position";
  const BodyId ball = p.add({.radius = 0.5, .position = {2, 2, 3}});
  const auto events = p.run(4.0, [&](const Event& event) {
    if (event.kind == EventKind::contact_begin) p.set_velocity(ball, bounce(event, 1.0).second_velocity);
  });
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].kind, EventKind::contact_begin);
  EXPECT_NEAR(events[0].time, 2.5, 1e-4);
  EXPECT_EQ(events[0].first, id);
  EXPECT_EQ(events[0].normal, (Vec3{0, 0, 1}));
  EXPECT_NEAR(p.state(ball).velocity.z, 2.0, 1e-12);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(MovingMesh, AndARigidBodyMeet) {
  Surroundings p;
  const MovingShape plate{{.velocity = {0, 0, 1}, .mass = infinity}, flat_floor(4, 4)};
  p.start_course(p.world.add_moving_shape(plate).value(), plate.body);
  p.add_rigid_body({.body = {.position = {2, 2, 3}},
                    .parts = {box_part({{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}}, 0.1)},
                    .rotation = {.angular_velocity = {0, 0, 1}}});
  const auto events = p.run(2.6);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_NEAR(events[0].time, 2.5, 1e-4);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(MeshWorld, SetShapeExchangesMeshes) {
  Surroundings p;
  const BodyId ball = p.add({.radius = 1, .position = {2, 2, 1}});
  const BodyId ground = p.place(flat_floor(4, 4));
  ASSERT_EQ(p.run(1.0).size(), 1u);
  p.world.set_shape(ground, flat_floor(8, 8)).value();
  EXPECT_TRUE(p.run(1.0).empty()) << "still touches";
  EXPECT_EQ(std::get<Mesh>(p.world.body(ground)->shape).size(), 128u);
  p.world.set_shape(ground, surface(4, 4, 1.0, [](auto, auto) { return -1.0; })).value();
  const auto events = p.run(1.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_end);
  EXPECT_EQ(events[0].partner_of(ball), ground);
  p.world.set_shape(ground, Box{{0, 0, 0}, {4, 4, 0.5}}).value();
  EXPECT_EQ(p.run(1.0).size(), 1u);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(MeshWorld, RefusesWhatDoesNotFit) {
  World world = World::create({}).value();
  expect_error(world.add_static({.shape = Mesh{}}), ErrorCode::out_of_range, "shape",
               "add_static: shape must be a mesh with triangles");
  const double far = 2 * limits::largest_length * world.definition().contact_tolerance;
  const std::array vertices{Vec3{0, 0, 0}, Vec3{far, 0, 0}, Vec3{0, far, 0}};
  const Mesh huge = Mesh::create(vertices, Corners{{0, 1, 2}}).value();
  expect_error(world.add_static({.shape = huge}), ErrorCode::out_of_range, "shape",
               "add_static: shape, vertices");
  expect_error(world.add_moving_shape({{}, Mesh{}}), ErrorCode::out_of_range, "shape", "add_moving_shape");
  EXPECT_EQ(world.size(), 0u);
  World plane = World::create({.dimensions = 2}).value();
  expect_error(plane.add_static({.shape = flat_floor(1, 1)}), ErrorCode::unsupported, "shape",
               "add_static: shape must be a mesh that Mesh::chain() makes");
}

TEST(MeshChain, RefusesWhatIsNone) {
  const auto refused = [](const std::vector<Vec3>& points, ErrorCode code, const char* message) {
    expect_error(Mesh::chain(points), code, "points", message);
  };
  refused({}, ErrorCode::out_of_range, "Mesh::chain: points must be at least two");
  refused({{1, 2, 0}}, ErrorCode::out_of_range, "Mesh::chain: points must be at least two");
  refused({{1, 2, 0}, {1, 3, 1}}, ErrorCode::out_of_range, "Mesh::chain: points 1 must have z = 0");
  refused({{1, 2, 0}, {1, 3, 0}, {1, 3, 0}}, ErrorCode::out_of_range, "Mesh::chain: points 2 must differ");
  refused({{1, 2, 0}, {1, NAN, 0}}, ErrorCode::not_finite, "Mesh::chain: points 1");
  const Mesh made = Mesh::chain(std::vector<Vec3>{{0, 0, 0}, {3, 0.1, 0}, {7, -1, 0}}).value();
  EXPECT_EQ(made.size(), 4u);
  EXPECT_TRUE(made.is_chain());
  EXPECT_EQ(Mesh::create(made.vertices(), made.corners()).value(), made);
  EXPECT_TRUE(Mesh::create(made.vertices(), made.corners())->is_chain());
  EXPECT_FALSE(flat_floor(1, 1).is_chain());
  EXPECT_FALSE(Mesh{}.is_chain());
}

/// Discs and boxes of two dimensions on a chain, against distances from its segments.
TEST(MeshChain, IsTheSurfaceOfAPlane) {
  Random random(91);
  std::vector<Vec3> points;
  for (int k = 0; k <= 40; ++k)
    points.push_back({0.5 * k, k == 0 || k == 40 ? 9.0 : 0.5 * random.uniform(), 0});
  const auto distance_to_chain = [&](const Vec3& from) {
    double least = infinity;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Vec3 side = points[k] - points[k - 1];
      const double part = std::clamp(dot(from - points[k - 1], side) / norm_squared(side), 0.0, 1.0);
      least = std::min(least, norm(from - points[k - 1] - side * part));
    }
    return least;
  };
  constexpr double eps = 1e-5;
  Surroundings p({.dimensions = 2, .contact_tolerance = eps});
  const BodyId ground = p.place(Mesh::chain(points).value());
  std::vector<BodyId> discs;
  for (int k = 0; k < 6; ++k) {
    const Vec3 velocity{3 * random.uniform(-1, 1), 0, 0};
    discs.push_back(p.add({.radius = 0.1 + 0.2 * random.uniform(),
                           .planned_acceleration = {0, -2, 0},
                           .position = {3.0 + 2 * k, 3, 0},
                           .velocity = velocity}));
  }
  const BodyId plank = p.add_rigid_body(
      {.body = {.planned_acceleration = {0, -2, 0}, .position = {10, 5, 0}},
       .parts = {hull_part(std::array{Vec3{-0.5, -0.1, 0}, Vec3{0.5, -0.1, 0}, Vec3{0, 0.2, 0}}, 0.05)},
       .rotation = {.angular_velocity = {0, 0, 1}},
       .inertia = {0, 0, 1}});
  std::set<BodyId> touching;
  int met = 0, plank_met = 0;
  const auto answer = [&](const Event& event) {
    EXPECT_EQ(event.normal.z, 0.0);
    EXPECT_EQ(event.point.z, 0.0);
    const BodyId other = event.partner_of(ground);
    if (event.kind == EventKind::contact_begin && other == plank) {
      ++plank_met;
      const Bounce after = bounce(event, 1.0);
      const bool is_first = event.first == plank;
      p.set_velocity(plank, is_first ? after.first_velocity : after.second_velocity);
      p.world
          .change(plank, {.angular_velocity =
                              is_first ? after.first_angular_velocity : after.second_angular_velocity})
          .value();
      return;
    }
    if (event.kind == EventKind::contact_begin && other != no_body) {
      EXPECT_TRUE(touching.insert(other).second) << event;
      EXPECT_NEAR(event.gap, distance_to_chain(p.state(other).position) - p.radius(other), 1e-12);
      EXPECT_LT(event.first == ground ? event.first_part : event.second_part, 80u);
      ++met;
    }
    if (event.kind == EventKind::contact_end && other != no_body) touching.erase(other);
    if (event.first != plank && event.second != plank) p.bounce(event);
  };
  for (double time = 0.02; time < 4.0; time += 0.02) {
    p.run(time, answer);
    for (const BodyId disc : discs) {
      const double gap = distance_to_chain(p.state(disc).position) - p.radius(disc);
      ASSERT_TRUE(gap >= -eps || touching.contains(disc)) << time << ", gap " << gap;
    }
    ASSERT_TRUE(is_clean(p.world));
  }
  EXPECT_GT(met, 5);
  EXPECT_GT(plank_met, 0);
  EXPECT_EQ(World::restore(p.world.save().value())->save().value(), p.world.save().value());
}

/// A wall that a chain could have made, in three dimensions.
TEST(MeshChain, IsAWallInSpace) {
  const Mesh wall = Mesh::chain(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}}).value();
  EXPECT_LT(norm(nearest_point(wall, {1, 3, 0.25}).point - Vec3{1, 0, 0.25}), 1e-15);
  EXPECT_LT(norm(nearest_point(wall, {1, 0, 3}).point - Vec3{1, 0, 1}), 1e-15);
  EXPECT_LT(norm(nearest_point(wall, {1, 0, 3}).normal - Vec3{0, 0, 1}), 1e-15);
  Surroundings p;
  p.place(wall);
  p.add_rigid_body({.body = {.position = {1, 0, 5}, .velocity = {0, 0, -1}},
                    .parts = {{{-0.3, 0, 0}, {0.3, 0, 0.1}, 0.5}}});
  const auto events = p.run(4.0);
  ASSERT_FALSE(events.empty());
  EXPECT_NEAR(events[0].time, 3.5, 0.1);
  EXPECT_NEAR(std::abs(events[0].normal.z), 1.0, 1e-6);
  EXPECT_NEAR(events[0].point.z, 1.0, 1e-3);
}

/// A disc that slides over a straight chain neither turns nor slows down.
TEST(MeshChain, OfOneLineIsSmooth) {
  Surroundings p({.dimensions = 2, .contact_tolerance = 1e-3, .contacts = ContactEvents::impacts});
  std::vector<Vec3> points;
  for (int k = 0; k <= 30; ++k) points.push_back({1.0 * k, 0, 0});
  p.place(Mesh::chain(points).value());
  const BodyId disc = p.add({.radius = 0.5,
                             .planned_acceleration = {0, -10, 0},
                             .position = {1.3, 0.5005, 0},
                             .velocity = {10, 0, 0}});
  int begins = 0;
  p.run(2.5, [&](const Event& event) {
    if (event.kind != EventKind::contact_begin) return;
    ++begins;
    const Bounce after = settle(event, 0.0, 2 * least_resting_speed(1e-3, 10));
    p.set_velocity(disc, event.first == disc ? after.first_velocity : after.second_velocity);
    EXPECT_EQ(p.state(disc).velocity.x, 10.0) << event;
  });
  EXPECT_GT(begins, 10);
}

/// In a bowl of triangles, floor and walls alike, nothing gets deeper than the tolerance.
TEST(MeshContact, ACornerOfOneMeshIsNoDeeperThanTheTolerance) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double eps = std::pow(10.0, -2.0 - static_cast<double>(seed % 4));
    const double rough = seed % 3 == 0 ? 0.0 : random.uniform();
    const Mesh bowl = surface(6, 6, 1.0, [&](std::uint32_t x, std::uint32_t y) {
      return x % 6 == 0 || y % 6 == 0 ? 4.0 : rough * random.uniform();
    });
    Surroundings p({.contact_tolerance = eps, .contacts = ContactEvents::impacts});
    const BodyId ground = p.place(bowl);
    std::vector<BodyId> balls;
    for (int k = 0; k < 3; ++k)
      balls.push_back(p.add({.radius = 0.05 + 0.3 * random.uniform(),
                             .planned_acceleration = {0, 0, -10},
                             .position = {1.5 + 1.5 * k, 1.5 + 3 * random.uniform(), 2.0 + random.uniform()},
                             .velocity = 5.0 * random.point_in_ball()}));
    const double restitution = seed % 2 == 0 ? 0.0 : 0.6 * random.uniform();
    bool is_guarded = false;
    double last = 0.0;
    p.run(2.0, [&](const Event& event) {
      is_guarded = is_guarded || event.kind == EventKind::zeno_guard;
      for (const double part : {0.25, 0.5, 0.75, 1.0})
        for (const BodyId ball : balls) {
          const Vec3 at = p.state(ball, last + (event.time - last) * part).position;
          ASSERT_TRUE(is_guarded || nearest_point(bowl, at).distance - p.radius(ball) >= -1.0001 * eps)
              << event;
        }
      last = event.time;
      if (event.kind != EventKind::contact_begin) return;
      const Bounce after = settle(event, restitution, 2 * least_resting_speed(eps, 10));
      if (event.first != ground) p.set_velocity(event.first, after.first_velocity);
      if (event.second != ground) p.set_velocity(event.second, after.second_velocity);
    });
  }
}

TEST(MeshWorld, TakesVerticesAndCorners) {
  World world = World::create({}).value();
  const Mesh floor = flat_floor(2, 2);
  const BodyId id = world.add_mesh(floor.vertices(), floor.corners(), {.category = 4}).value();
  EXPECT_EQ(std::get<Mesh>(world.body(id)->shape), floor);
  EXPECT_EQ(world.body(id)->definition.filter.category, 4u);
  EXPECT_TRUE(world.body(id)->is_static);
  expect_error(world.add_mesh(floor.vertices(), {}), ErrorCode::out_of_range, "corners",
               "Mesh::create: corners");
  EXPECT_EQ(world.size(), 1u);
}

TEST(MeshWorld, OverlapIsRefusedWhereItIsNotAllowed) {
  World world = World::create({.allow_overlap = false}).value();
  const BodyId ball = world.add({.radius = 1, .position = {2, 2, 0.5}}).value();
  expect_error(world.add_static({.shape = flat_floor(4, 4)}), ErrorCode::overlapping, "shape", "add_static",
               ball);
  EXPECT_TRUE(world.add_static({.shape = surface(4, 4, 1.0, [](auto, auto) { return -0.5; })}));
}

/// Worlds that are saved, cloned and replayed in the middle of contacts go on in the same way.
TEST(MeshWorld, IsSavedClonedAndReplayed) {
  Surroundings p({.contact_tolerance = 1e-5});
  p.world.start_recording().value();
  p.place(hills(6, 1.0, 3));
  const MovingShape lift{{.position = {3, 3, -4}, .velocity = {0, 0, 0.1}, .mass = infinity},
                         flat_floor(2, 2)};
  p.start_course(p.world.add_moving_shape(lift).value(), lift.body);
  for (int k = 0; k < 8; ++k)
    p.add({.radius = 0.2, .acceleration_limit = 1, .position = {0.6 * k + 0.5, 3, 1.5 + 0.1 * k}},
          Vec3{0, 0, -0.5});
  p.run(2.5);
  const auto bytes = p.world.save().value();
  World back = World::restore(bytes).value();
  World copy = p.world.clone().value();
  EXPECT_EQ(back.save().value(), bytes);
  EXPECT_EQ(copy.save().value(), bytes);
  EXPECT_TRUE(is_clean(back));
  std::size_t events = 0;
  while (const auto event = p.world.advance(8.0, p.probe()).value()) {
    for (World* const other : {&back, &copy}) {
      const auto same = other->advance(8.0, p.probe()).value();
      ASSERT_TRUE(same);
      EXPECT_EQ(same->time, event->time);
      EXPECT_EQ(std::pair(same->first, same->second), std::pair(event->first, event->second));
      EXPECT_EQ(same->normal, event->normal);
    }
    ++events;
  }
  EXPECT_GT(events, 3u);
  Replay replay = Replay::open(p.world.stop_recording().value()).value();
  while (!replay.finished()) replay.advance().value();
  EXPECT_EQ(replay.world().save().value(), p.world.save().value());
}

TEST(MeshWorld, BytesOfAMeshThatIsNoneAreRefused) {
  World world = World::create({}).value();
  world.add_static({.shape = flat_floor(1, 1)}).value();
  const auto bytes = world.save().value();
  int refused = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    auto wrong = bytes;
    wrong[k] ^= std::byte{0x40};
    if (!World::restore(wrong)) ++refused;
  }
  EXPECT_GT(refused, static_cast<int>(bytes.size() / 2));
}

/// Queries give what all triangles together give.
TEST(MeshWorld, QueriesAreThoseOfItsTriangles) {
  const Mesh mesh = hills(12, 1.0, 5);
  World one = World::create({}).value();
  World many = World::create({}).value();
  const BodyId ground = one.add_static({.shape = mesh}).value();
  many.add_static_all(triangles(mesh.vertices(), mesh.corners()).value()).value();
  Random random(77);
  int hits = 0;
  for (int k = 0; k < 400; ++k) {
    const Vec3 at{random.uniform(-2, 14), random.uniform(-2, 14), random.uniform(-1, 3)};
    const Vec3 way = random.unit_vector();
    const double radius = k % 2 == 0 ? 0.0 : 0.3 * random.uniform();
    const auto cast = one.queries().sphere_cast(at, radius, way, 10.0).value();
    const auto all = many.queries().sphere_cast(at, radius, way, 10.0).value();
    ASSERT_EQ(cast.empty(), all.empty()) << k;
    if (!cast.empty()) {
      ++hits;
      ASSERT_EQ(cast.size(), 1u);
      EXPECT_EQ(cast[0].body, ground);
      EXPECT_NEAR(cast[0].lower, all[0].lower, 1e-9) << k;
      double upper = infinity;
      for (const CastHit& hit : all) upper = std::min(upper, hit.upper);
      EXPECT_NEAR(cast[0].upper, upper, 1e-9) << k;
      EXPECT_EQ(cast[0].certainty, Certainty::certainly);
    }
    EXPECT_EQ(one.queries().overlapping(at, 0.2).value().empty(),
              many.queries().overlapping(at, 0.2).value().empty());
    const Box region{at, at + Vec3{0.3, 0.2, 0.1}};
    EXPECT_EQ(one.queries().overlapping(region).value().empty(),
              many.queries().overlapping(region).value().empty());
    const auto near = one.queries().nearest(at, 1).value();
    ASSERT_EQ(near.size(), 1u);
    const auto nearest = many.queries().nearest(at, 1).value();
    EXPECT_NEAR(near[0].lower, nearest[0].lower, 1e-12);
  }
  EXPECT_GT(hits, 50);
}

TEST(MeshWorld, CertificatesAreThoseOfItsTriangles) {
  const Mesh mesh = hills(8, 1.0, 6);
  World one = World::create({}).value();
  World many = World::create({}).value();
  one.add_static({.shape = mesh}).value();
  many.add_static_all(triangles(mesh.vertices(), mesh.corners()).value()).value();
  Random random(78);
  for (int k = 0; k < 60; ++k) {
    const BodyDefinition body{.radius = 0.1,
                              .acceleration_limit = k % 2 == 0 ? 0.0 : random.uniform(),
                              .position = {random.uniform(1, 7), random.uniform(1, 7), 4},
                              .velocity = 2.0 * random.point_in_ball()};
    const BodyId a = one.add(body).value();
    const BodyId b = many.add(body).value();
    const double until = one.certificates().earliest_contact(a)->time;
    const double expected = many.certificates().earliest_contact(b)->time;
    if (expected == infinity)
      EXPECT_EQ(until, infinity) << k;
    else
      EXPECT_NEAR(until, expected, 1e-4 * expected) << k;
    one.remove(a).value();
    many.remove(b).value();
  }
}

/// What a ball costs beside a hundred thousand triangles: one candidate, and as many checks as beside two.
TEST(MeshWorld, ABallBesideManyTrianglesHasOnePartner) {
  const auto work_of = [](std::uint32_t n) {
    World world = World::create({}).value();
    const double edge = 224.0 / n;
    const auto level = [&](std::uint32_t x, std::uint32_t y) { return edge * 0.2 * ((x + y) % 3); };
    world.add_static({.shape = surface(n, n, edge, level)}).value();
    const auto probe = [](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = {{112, 112, 9 - time}, {0, 0, -1}};
    };
    world.add({.radius = 0.5, .position = {112, 112, 9}, .velocity = {0, 0, -1}}).value();
    world.advance(7.0, probe).value();
    return world.counters();
  };
  const Counters few = work_of(1);
  const Counters many = work_of(224);
  EXPECT_LE(many.candidates, few.candidates);
  EXPECT_LE(many.pair_checks, few.pair_checks + 3);
  EXPECT_LE(many.probes, few.probes + 3);
}

TEST(MeshWorld, IsShownByItsSizeAndBox) {
  World world = World::create({}).value();
  const BodyId id = world.add_static({.shape = flat_floor(2, 3), .user_data = 5}).value();
  EXPECT_EQ(to_string(world.body(id)->shape), "mesh: triangles 12, in (0, 0, 0) to (2, 3, 0)");
  EXPECT_EQ(world.body(id)->definition.user_data, 5u);
  EXPECT_GT(world.inspection().memory().bodies, 12 * 48u);
}

}  // namespace
}  // namespace kinesphere::mesh_test
