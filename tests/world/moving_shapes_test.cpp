// Moving shapes and balls: balls and carried boxes and triangles on random courses compared with brute force,
// and the events, answers and errors that they have (meeting_shapes_test.cpp: with other shapes).
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "kinesphere/certificates.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/response.hpp"
#include "number/infinity.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"
#include "support/random_contacts.hpp"
#include "support/test_size.hpp"
#include "world/mapped_world.hpp"
#include "world/surroundings.hpp"

namespace kinesphere::moving_shapes_test {
namespace {

constexpr double eps = 1e-5;

class RandomMovingShapes : public testing::TestWithParam<ContactScene> {
 protected:
  RandomMovingShapes() : p({.contact_tolerance = eps, .contacts = GetParam().mode}), random(GetParam().seed) {
    for (int k = 0; k < 6; ++k) come();
    for (int k = 0; k < 8; ++k) balls.push_back(p.add(any_body()));
  }

  BodyDefinition any_body() {
    return {.radius = random.bits() % 4 == 0 ? 0.0 : 0.05 + 0.5 * random.uniform(),
            .acceleration_limit = 2,
            .velocity_error = GetParam().velocity_error,
            .position = 2.0 * random.point_in_ball(),
            .velocity = 1.5 * random.point_in_ball()};
  }

  Shape any_shape() {
    if (random.bits() % 2 == 0)
      return Triangle{2.0 * random.unit_vector(), 2.0 * random.unit_vector(), 2.0 * random.unit_vector()};
    // Flat ones, and such as have their position outside of them.
    const Vec3 lower = 1.5 * random.point_in_ball() - Vec3{0.5, 0.5, 0.5};
    return Box{lower,
               lower + Vec3{random.uniform(), 2.0 * random.uniform(), random.bits() % 3 == 0 ? 0.0 : 1.0}};
  }

  /// Shapes meet balls alone; meeting_shapes_test.cpp has shapes that meet shapes.
  void come() {
    BodyDefinition body = any_body();
    body.filter = {.category = 2, .mask = 1};
    const Shape shape = any_shape();
    const auto id = p.world.add_moving_shape({body, shape});
    if (!id) return come();  // a triangle too thin
    p.start_course(*id, body);
    shapes.push_back(*id);
    carried[*id] = shape;
  }

  void change() {
    const std::size_t k = random.bits() % shapes.size();
    const BodyId shape = shapes[k];
    switch (random.bits() % 8) {
      case 0: {
        p.world.remove(shape).value();
        touching.remove(shape);
        carried.erase(shape);
        shapes.erase(shapes.begin() + static_cast<std::ptrdiff_t>(k));
        return come();
      }
      case 1:
        return p.set_velocity(shape, 2.0 * random.point_in_ball());
      case 2:
        return p.teleport(shape, {2.0 * random.point_in_ball(), random.point_in_ball()});
      case 3:
        return p.world = World::restore(p.world.save().value()).value(), void();
      case 4: {
        const Shape next = any_shape();
        if (p.world.set_shape(shape, next)) carried[shape] = next;  // else a triangle too thin
        return;
      }
      default:
        return;
    }
  }

  /// Steers the body back towards the middle.
  void steer(BodyId body) {
    const Vec3 away = p.state(body).position;
    p.steer(body, -1.0 * away / (norm(away) + 0.1) + 0.9 * random.point_in_ball());
  }

  double gap(BodyId ball, BodyId shape) const {
    return distance(carried.at(shape), p.state(ball).position - p.state(shape).position) - p.radius(ball);
  }

  void check_gaps() {
    for (const BodyId ball : balls)
      for (const BodyId shape : shapes) {
        const bool touch = touching.contains(ball, shape);
        const double gap = this->gap(ball, shape);
        const auto limits = p.world.certificates().distance_limits(ball, shape, p.world.time()).value();
        ASSERT_LE(limits.lower, gap + 1e-12);
        ASSERT_GE(limits.upper, gap - 1e-12);
        if (GetParam().mode == ContactEvents::impacts) continue;
        ASSERT_TRUE(gap >= -eps - 1e-12 || touch) << ball << " is unreported in " << shape << " by " << gap;
        ASSERT_TRUE(gap <= 5 * eps + 1e-12 || !touch)
            << ball << " and " << shape << " are apart, gap " << gap;
      }
  }

  /// Compares what queries say with the true gaps of a ball and a ray to all moving shapes.
  void check_queries() {
    const Vec3 centre = 2.0 * random.point_in_ball();
    const double radius = random.uniform();
    std::map<BodyId, Certainty> found;
    for (const OverlapHit& hit : p.world.queries().overlapping(centre, radius).value())
      found[hit.body] = hit.certainty;
    std::map<BodyId, Certainty> in_box;
    const Vec3 half{radius, radius, radius};
    for (const OverlapHit& hit : p.world.queries().overlapping(Box{centre - half, centre + half}).value())
      in_box[hit.body] = hit.certainty;
    const Vec3 direction = random.unit_vector();
    std::map<BodyId, CastHit> met;
    for (const CastHit& hit : p.world.queries().ray_cast(centre, direction, 3.0).value()) met[hit.body] = hit;
    constexpr double step = 0.02;
    double first = infinity;
    for (const BodyId shape : shapes) {
      const Vec3 origin = p.state(shape).position;
      const auto gap_at = [&](const Vec3& point) { return distance(carried.at(shape), point - origin); };
      const bool overlaps = gap_at(centre) <= radius;
      const auto known = found.find(shape);
      ASSERT_TRUE(!overlaps || known != found.end()) << shape;
      ASSERT_TRUE(overlaps || known == found.end() || known->second == Certainty::possibly) << shape;
      // The box contains the ball.
      ASSERT_TRUE(!overlaps || in_box.contains(shape)) << shape;
      const bool apart = gap_at(centre) > std::sqrt(3.0) * radius + 1e-9;
      ASSERT_TRUE(!apart || !in_box.contains(shape) || in_box[shape] == Certainty::possibly) << shape;
      double enters = infinity;
      for (double at = 0.0; at <= 3.0 && enters == infinity; at += step)
        if (gap_at(centre + direction * at) <= 0.0) enters = at;
      first = std::min(first, enters);
      if (const auto hit = met.find(shape); hit != met.end()) {
        ASSERT_LE(hit->second.lower, enters + 1e-9) << shape;
        ASSERT_TRUE(enters == infinity || hit->second.upper >= enters - step) << shape;
      }
    }
    // Something is met no later than the first shape that the samples meet.
    ASSERT_TRUE(first == infinity || !met.empty());
  }

  Playground p;
  Random random;
  std::vector<BodyId> shapes, balls;
  std::map<BodyId, Shape> carried;
  TouchingPairs touching{GetParam().mode};
};

TEST_P(RandomMovingShapes, MeetWhatTheyTouch) {
  std::size_t begins = 0;
  for (int stop = 1; stop <= 600 && !HasFatalFailure(); ++stop) {
    change();
    for (const BodyId ball : balls) steer(ball);
    for (const BodyId shape : shapes) steer(shape);
    const double quiet = p.world.certificates().safe_until()->time;
    p.run(p.world.time() + 0.2 * random.uniform(), [&](const Event& event) {
      touching.note(event, p.world);
      if (event.kind != EventKind::contact_begin) return;
      ++begins;
      const auto carries = [&](BodyId body) { return carried.contains(body); };
      ASSERT_FALSE(carries(event.first) && carries(event.second)) << event;
      EXPECT_TRUE(GetParam().mode == ContactEvents::impacts || event.time >= quiet) << event;
      if (carries(event.first) || carries(event.second)) {
        const BodyId shape = carries(event.first) ? event.first : event.second;
        const BodyId ball = event.first == shape ? event.second : event.first;
        EXPECT_NEAR(event.gap, gap(ball, shape), 1e-10) << event;
        const Vec3 apart = p.state(ball).velocity - p.state(shape).velocity;
        EXPECT_NEAR(event.approach_speed, dot(event.normal, event.first == ball ? apart : -1.0 * apart),
                    1e-9);
      }
      if (GetParam().mode == ContactEvents::impacts) {
        const Bounce after = kinesphere::bounce(event, 1.0);
        p.set_velocity(event.first, after.first_velocity);
        p.set_velocity(event.second, after.second_velocity);
      }
    });
    ASSERT_TRUE(is_clean(p.world));
    check_gaps();
    if (stop % 8 == 0) check_queries();
  }
  EXPECT_GT(begins, 20u);
  const Counters& counters = p.world.counters();
  EXPECT_LE(counters.pair_checks, 2 * counters.probes);
}

INSTANTIATE_TEST_SUITE_P(
    , RandomMovingShapes,
    testing::ValuesIn(scenes_of_each<ContactScene>({ContactScene{ContactEvents::begin_and_end, 0.0, 1},
                                                    ContactScene{ContactEvents::begin_and_end, 0.5, 2},
                                                    ContactScene{ContactEvents::impacts, 0.0, 3},
                                                    ContactScene{ContactEvents::impacts, 0.01, 4},
                                                    ContactScene{ContactEvents::begin_and_end, 0.5, 5}})));

constexpr Box plate{{-1, -1, 0}, {1, 1, 0.5}};

TEST(MovingShapes, AreMetWithTheirVelocity) {
  Playground p;
  // A plate rises at 2 towards a ball that falls at 1: their gap of 3 closes within 1.
  const BodyDefinition lift{.position = {0, 0, 0}, .velocity = {0, 0, 2}, .mass = infinity};
  const BodyId plate_id = p.world.add_moving_shape({lift, plate}).value();
  p.start_course(plate_id, lift);
  const BodyId ball = p.add({.radius = 0.5, .position = {0.25, 0.5, 4}, .velocity = {0, 0, -1}});
  const auto event = p.advance(5.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::contact_begin);
  EXPECT_NEAR(event->time, 1.0, 1e-5);
  EXPECT_NEAR(event->approach_speed, 3.0, 1e-12);
  EXPECT_NEAR(norm(event->point - Vec3{0.25, 0.5, 2.5}), 0.0, 1e-5);
  EXPECT_EQ(event->normal, (Vec3{0, 0, 1})) << "from the plate, the first, to the ball";
  const Bounce after = bounce(*event, 1.0);
  EXPECT_EQ(after.first_velocity, lift.velocity);
  EXPECT_NEAR(after.second_velocity.z, 5.0, 1e-12);
  EXPECT_FALSE(response_of(*event, after).first_velocity) << "a body of infinite mass keeps its velocity";
  EXPECT_EQ(std::get<Box>(p.world.body(plate_id).value().shape), plate);
  EXPECT_FALSE(p.world.body(plate_id)->is_static);
  EXPECT_NEAR(p.world.body(plate_id)->definition.radius, 1.5, 1e-12);
  EXPECT_TRUE(p.world.contains(ball));
}

TEST(MovingShapes, GrowAroundWhoIsInside) {
  Playground p;
  p.world.set_sensor(3, {.distances = {0.0}}).value();
  const BodyDefinition zone{.velocity = {1, 0, 0}, .solid = false, .sensor_class = 3};
  const BodyId id = p.world.add_moving_shape({zone, plate}).value();
  p.start_course(id, zone);
  p.add({.radius = 0.1, .position = {0, 0, 0.2}, .velocity = {1, 0, 0}});
  ASSERT_EQ(p.run(1.0).size(), 1u);
  p.world.set_shape(id, Box{{-3, -3, -1}, {3, 3, 2}}).value();
  EXPECT_NEAR(p.world.body(id)->definition.radius, std::sqrt(22.0), 1e-12);
  EXPECT_TRUE(p.run(2.0).empty()) << "it neither leaves nor enters";
  p.world.set_shape(id, Box{{-3, -3, 1}, {3, 3, 2}}).value();
  const auto left = p.run(3.0);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].kind, EventKind::sensor_leave);
  EXPECT_EQ(left[0].time, 2.0);
}

TEST(MovingShapes, SlideThroughWalls) {
  Playground p({.box = Box{{-2, -2, -2}, {2, 2, 2}}});
  const BodyDefinition from_outside{.position = {0, 0, 9}, .velocity = {0, 0, -1}};
  for (const Shape& shape : {Shape(plate), Shape(Triangle{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}})}) {
    p.start_course(p.world.add_moving_shape({from_outside, shape}).value(), from_outside);
    EXPECT_TRUE(p.run(p.world.time() + 20.0).empty());
  }
}

TEST(MovingShapes, AreMetInThePlane) {
  Playground p({.dimensions = 2});
  const BodyDefinition door{.velocity = {1, 0, 0}};
  p.start_course(p.world.add_moving_shape({door, Box{{0, -5, -7}, {0.5, 5, 7}}}).value(), door);
  EXPECT_NEAR(p.world.body({0, 0, 0})->definition.radius, std::hypot(0.5, 5), 1e-12);
  p.add({.radius = 0.5, .position = {3, 2, 0}});
  const auto event = p.advance(5.0);
  ASSERT_TRUE(event);
  EXPECT_NEAR(event->time, 2.0, 1e-4);
  EXPECT_NEAR(event->normal.x, 1.0, 1e-12);
}

TEST(MovingShapes, AreZones) {
  Playground p;
  p.world.set_sensor(3, {.distances = {0.5}}).value();
  const BodyDefinition beam{.velocity = {1, 0, 0}, .solid = false, .sensor_class = 3};
  p.start_course(p.world.add_moving_shape({beam, plate}).value(), beam);
  p.add({.radius = 0.0, .position = {4, 0, 0.25}});
  std::vector<double> times;
  for (const Event& event : p.run(20.0)) times.push_back(event.time);
  ASSERT_EQ(times.size(), 2u);
  EXPECT_NEAR(times[0], 2.5, 1e-4) << "0.5 before its face, at x = 1 in it";
  EXPECT_NEAR(times[1], 5.5, 1e-4);
}

/// A gas and a piston, as a Simulation would run it.
struct Gas : MappedWorld<Ballistic> {
  Gas() {
    world = World::create({.box = Box{{0, 0, 0}, {10, 10, 10}}, .contacts = ContactEvents::impacts}).value();
    std::vector<State> start;
    Random random(44);
    for (int k = 0; k < 200; ++k)
      start.push_back(
          {{random.uniform(1, 9), random.uniform(1, 9), random.uniform(1, 7)}, random.unit_vector()});
    start.push_back({{5, 5, 10}, {0, 0, -0.5}});
    motion = std::make_unique<Ballistic>(Ballistic::create({.start = start}).value());
    for (std::uint32_t k = 0; k < 200; ++k) bodies.add(world, *motion, k, {.radius = 0.3}).value();
    bodies.add_moving_shape(world, *motion, 200, {{.mass = infinity}, Box{{-6, -6, 0}, {6, 6, 1}}}).value();
  }
};

TEST(MovingShapes, RunTheSameWithThreadsAndFromSnapshots) {
  expect_the_same_with_threads_and_from_snapshots<Gas>(2, 4.0, 200);
}

TEST(MovingShapes, AreRecorded) {
  Gas gas;
  ASSERT_TRUE(gas.world.start_recording());
  const State still{{5, 5, 3}, {}};
  const std::uint32_t number = gas.motion->add(0.0, still).value();
  gas.bodies.add_moving_shape(gas.world, *gas.motion, number, {{.mass = infinity}, plate}).value();
  gas.run(2.0);
  expect_replay(gas.world);
}

TEST(MovingShapes, AreRefusedWithAReason) {
  World world = World::create({}).value();
  const auto refused = [&](const MovingShape& shape, ErrorCode code, const char* argument) {
    expect_error(world.add_moving_shape(shape), code, argument, "add_moving_shape");
  };
  refused({{}, HalfSpace{{0, 0, 1}, 0.0}}, ErrorCode::unsupported, "shape");
  refused({{}, Ball{}}, ErrorCode::unsupported, "shape");
  refused({{}, Box{{1, 0, 0}, {0, 1, 1}}}, ErrorCode::out_of_range, "shape");
  refused({{}, Triangle{}}, ErrorCode::out_of_range, "shape");
  refused({{.acceleration_limit = -1}, plate}, ErrorCode::out_of_range, "acceleration_limit");
  refused({{.position = {NAN, 0, 0}}, plate}, ErrorCode::not_finite, "position");
  const BodyId lift = world.add_moving_shape({{}, plate}).value();
  expect_error(world.change(lift, {.radius = 2.0}), ErrorCode::unsupported, "body", "change", lift);
  expect_error(world.set_shape(lift, Ball{}), ErrorCode::unsupported, "shape", "set_shape");
  World periodic =
      World::create({.box = Box{{0, 0, 0}, {9, 9, 9}}, .periodic = {.x = true, .y = true, .z = true}})
          .value();
  const auto moving = periodic.add_moving_shape({{}, plate});
  expect_error(moving, ErrorCode::unsupported, "shape", "add_moving_shape");
  EXPECT_NE(moving.error().message.find("must not move where space repeats"), std::string::npos);
  World tight = World::create({.allow_overlap = false}).value();
  const BodyId ball = tight.add({.radius = 1.0, .position = {0, 0, 2}}).value();
  tight.add_moving_shape({{}, plate}).value();
  expect_error(tight.add_moving_shape({{.position = {0, 0, 1}}, plate}), ErrorCode::overlapping, "shape",
               "add_moving_shape", ball);
}

}  // namespace
}  // namespace kinesphere::moving_shapes_test
