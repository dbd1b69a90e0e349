// Moving shapes that meet static bodies and one another: times in closed form, random scenes against gaps by
// other formulas, and the events, answers and errors of such pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "kinesphere/certificates.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/response.hpp"
#include "number/infinity.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"
#include "support/random_contacts.hpp"
#include "support/test_size.hpp"
#include "support/true_shapes.hpp"
#include "world/mapped_world.hpp"

namespace kinesphere::meeting_shapes_test {
namespace {

using true_shapes::CarriedHulls;

constexpr double eps = 1e-5;
constexpr Box plate{{-1, -1, 0}, {1, 1, 0.5}};

BodyId add_moving_shape(Playground& p, const BodyDefinition& body, const Shape& shape) {
  const BodyId id = p.world.add_moving_shape({body, shape}).value();
  p.start_course(id, body);
  return id;
}

// Boxes that move straight on.

struct MovedBox {
  Box box;
  State start{};

  Box at(double time) const {
    const Vec3 place = start.position + start.velocity * time;
    return {box.lower + place, box.upper + place};
  }
};

double gap_of(const Box& a, const Box& b) {
  Vec3 apart;
  for (int axis = 0; axis < 3; ++axis)
    apart[axis] = std::max({a.lower[axis] - b.upper[axis], b.lower[axis] - a.upper[axis], 0.0});
  return norm(apart);
}

/// When two boxes overlap, from 0 on.
struct Stay {
  double from = 0.0;
  double until = infinity;

  Stay(const MovedBox& a, const MovedBox& b) {
    for (int axis = 0; axis < 3; ++axis) {
      const double speed = a.start.velocity[axis] - b.start.velocity[axis];
      const double below = a.at(0.0).lower[axis] - b.at(0.0).upper[axis];  // negative while they overlap
      const double above = b.at(0.0).lower[axis] - a.at(0.0).upper[axis];
      if (speed == 0.0) {
        if (below > 0.0 || above > 0.0) until = -infinity;
        continue;
      }
      const double one = -below / speed;
      const double other = above / speed;
      from = std::max(from, std::min(one, other));
      until = std::min(until, std::max(one, other));
    }
  }
};

TEST(MeetingShapes, BoxesMeetAndPartWhenTheirFacesDo) {
  Random random(71);
  std::size_t met = 0;
  for (int scene = 0; scene < 60; ++scene) {
    Playground p({.contact_tolerance = eps, .contacts = ContactEvents::begin_and_end});
    std::map<BodyId, MovedBox> boxes;
    for (int k = 0; k < 6; ++k) {
      const Vec3 half{0.05 + random.uniform(), 0.05 + random.uniform(), 0.05 + random.uniform()};
      const bool is_static = k < 2;
      const Vec3 place = 4.0 * random.point_in_ball();
      const MovedBox moved{is_static ? Box{place - half, place + half} : Box{-half, half},
                           is_static ? State{} : State{place, 2.0 * random.point_in_ball()}};
      const BodyDefinition body{.position = moved.start.position, .velocity = moved.start.velocity};
      boxes.emplace(
          is_static ? p.world.add_static({.shape = moved.box}).value() : add_moving_shape(p, body, moved.box),
          moved);
    }
    constexpr double end = 6.0;
    std::map<std::pair<BodyId, BodyId>, std::vector<Event>> events;
    for (const Event& event : p.run(end)) events[{event.first, event.second}].push_back(event);
    for (auto one = boxes.begin(); one != boxes.end(); ++one)
      for (auto other = std::next(one); other != boxes.end(); ++other) {
        const auto& of_pair = events[{one->first, other->first}];
        const bool both_static = one->first.index < 2 && other->first.index < 2;
        const Stay stay(one->second, other->second);
        if (both_static || stay.until < std::min(stay.from, end) - 1e-3 || stay.from > end + 1e-3) {
          EXPECT_TRUE(of_pair.empty()) << one->first << " and " << other->first << " in scene " << scene;
          continue;
        }
        if (stay.until - stay.from < 1e-3 || stay.from > end - 1e-3 || std::abs(stay.until - end) < 1e-3)
          continue;
        ++met;
        ASSERT_EQ(of_pair.size(), stay.until < end ? 2u : 1u)
            << one->first << " and " << other->first << " in scene " << scene;
        const auto gap_at = [&](double time) { return gap_of(one->second.at(time), other->second.at(time)); };
        EXPECT_EQ(of_pair[0].kind, EventKind::contact_begin);
        EXPECT_LE(of_pair[0].time, stay.from + 1e-12);
        EXPECT_LE(gap_at(of_pair[0].time), eps + 1e-12);
        if (of_pair.size() < 2) continue;
        EXPECT_EQ(of_pair[1].kind, EventKind::contact_end);
        EXPECT_GE(of_pair[1].time, stay.until - 1e-12);
        EXPECT_LE(gap_at(of_pair[1].time), 5.0 * eps + 1e-12);
      }
    ASSERT_TRUE(is_clean(p.world));
  }
  EXPECT_GT(met, 50u);
}

// Random scenes.

class RandomMeetings : public testing::TestWithParam<ContactScene> {
 protected:
  struct Carried {
    Shape shape;
    CarriedHulls hulls;
  };

  RandomMeetings() : p({.contact_tolerance = eps, .contacts = GetParam().mode}), random(GetParam().seed) {
    for (const Shape& shape : {Shape(HalfSpace{{0, 0.6, 0.8}, -2.0}), Shape(Box{{1, -1, -1}, {1.5, 1, 1}}),
                               Shape(Triangle{{-2, -1, 0.5}, {-1, 1.5, 0}, {-1.5, 0, 1.5}}),
                               Shape(Ball{{0, 1.5, 1.2}, 0.4}), folded({-1, -1, -1}, 1.5)})
      statics[p.world.add_static({.shape = shape}).value()] = shape;
    for (int k = 0; k < 5; ++k) come();
  }

  /// A mesh of four triangles around its middle.
  static Shape folded(const Vec3& at, double size) {
    const std::array vertices{at + Vec3{-size, -size, 0.2 * size}, at + Vec3{size, -size, -0.2 * size},
                              at + Vec3{size, size, 0.3 * size}, at + Vec3{-size, size, 0},
                              at + Vec3{0, 0, -0.3 * size}};
    constexpr std::array<std::array<std::uint32_t, 3>, 4> corners{
        {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    return Mesh::create(vertices, corners).value();
  }

  Shape any_shape() {
    switch (random.bits() % 4) {
      case 0:
        return Triangle{1.2 * random.unit_vector(), 1.2 * random.unit_vector(), 1.2 * random.unit_vector()};
      case 1: {
        // In an order that no compiler chooses.
        const double size = 0.3 + 0.5 * random.uniform();
        return folded(0.2 * random.point_in_ball(), size);
      }
      default: {
        const Vec3 lower = 0.7 * random.point_in_ball() - Vec3{0.4, 0.4, 0.4};
        return Box{lower, lower + Vec3{random.uniform(), random.uniform(),
                                       random.bits() % 3 == 0 ? 0.0 : random.uniform()}};
      }
    }
  }

  void come() {
    const BodyDefinition body{.acceleration_limit = 2,
                              .velocity_error = GetParam().velocity_error,
                              .position = 2.0 * random.point_in_ball(),
                              .velocity = 1.5 * random.point_in_ball()};
    const Shape shape = any_shape();
    const auto id = p.world.add_moving_shape({body, shape});
    if (!id) return come();  // a triangle too thin
    p.start_course(*id, body);
    carried.emplace(*id, Carried{shape, CarriedHulls(shape)});
  }

  BodyId any_carried() {
    return std::next(carried.begin(), static_cast<std::ptrdiff_t>(random.bits() % carried.size()))->first;
  }

  void change() {
    const BodyId body = any_carried();
    switch (random.bits() % 8) {
      case 0:
        p.world.remove(body).value();
        touching.remove(body);
        carried.erase(body);
        return come();
      case 1:
        return p.set_velocity(body, 2.0 * random.point_in_ball());
      case 2:
        return p.teleport(body, {2.0 * random.point_in_ball(), random.point_in_ball()});
      case 3:
        return p.world = World::restore(p.world.save().value()).value(), void();
      case 4: {
        const Shape next = any_shape();
        if (p.world.set_shape(body, next)) carried.at(body) = {next, CarriedHulls(next)};
        return;
      }
      default:
        return;
    }
  }

  void steer(BodyId body) {
    const Vec3 away = p.state(body).position;
    p.steer(body, -1.0 * away / (norm(away) + 0.1) + 0.9 * random.point_in_ball());
  }

  double gap(BodyId one, BodyId other, double enough = infinity) const {
    if (!carried.contains(one)) std::swap(one, other);
    const Vec3 at = p.state(one).position;
    const auto fixed = statics.find(other);
    return fixed != statics.end()
               ? carried.at(one).hulls.gap(at, fixed->second, {}, enough)
               : carried.at(one).hulls.gap(at, carried.at(other).shape, p.state(other).position, enough);
  }

  void check_begin(const Event& event) {
    const double now = gap(event.first, event.second);
    EXPECT_LE(now, eps + 1e-12) << "invented: " << event;
    EXPECT_NEAR(norm(event.normal), 1.0, 1e-12);
    const auto velocity_of = [&](BodyId body) {
      return carried.contains(body) ? p.state(body).velocity : Vec3{};
    };
    EXPECT_NEAR(event.approach_speed, dot(event.normal, velocity_of(event.first) - velocity_of(event.second)),
                1e-9);
    if (now < 1e-9) return;
    EXPECT_NEAR(event.gap, now, 1e-10) << event;
    // The normal is the way out: along it, the two are farther apart by as much as they are moved.
    const BodyId moved = carried.contains(event.second) ? event.second : event.first;
    const State before = p.state(moved);
    p.set_position(moved, before.position + event.normal * (moved == event.second ? eps : -eps));
    EXPECT_NEAR(gap(event.first, event.second), now + eps, 1e-8) << event;
    p.set_position(moved, before.position);
  }

  void check_pair(BodyId a, BodyId b) {
    const auto pair = std::minmax(a, b);
    const double now = gap(a, b);
    const auto limits = p.world.certificates().distance_limits(a, b, p.world.time()).value();
    // Shapes without a radius have the gap 0 however deep they overlap, but in a half-space.
    ASSERT_LE(limits.lower, std::max(now, 0.0) + 1e-12) << a << ", " << b;
    ASSERT_GE(limits.upper, now - 1e-12) << a << ", " << b;
    if (GetParam().mode == ContactEvents::impacts) return;
    const bool touch = touching.contains(pair.first, pair.second);
    ASSERT_TRUE(now >= -eps - 1e-12 || touch) << a << " is unreported in " << b << " by " << now;
    ASSERT_TRUE(now <= 5 * eps + 1e-12 || !touch) << a << " and " << b << " are apart, gap " << now;
  }

  void check_gaps() {
    for (auto one = carried.begin(); one != carried.end(); ++one) {
      for (auto other = std::next(one); other != carried.end(); ++other) check_pair(one->first, other->first);
      for (const auto& [fixed, shape] : statics) check_pair(one->first, fixed);
    }
  }

  Playground p;
  Random random;
  std::map<BodyId, Shape> statics;
  std::map<BodyId, Carried> carried;
  TouchingPairs touching{GetParam().mode};
};

TEST_P(RandomMeetings, AreReportedWhenTheyHappen) {
  std::size_t begins = 0, with_static = 0;
  const int stops = rounds_of(300);
  for (int stop = 1; stop <= stops && !HasFailure(); ++stop) {
    change();
    for (const auto& [body, shape] : carried) steer(body);
    const double quiet = p.world.certificates().safe_until()->time;
    p.run(p.world.time() + 0.15 * random.uniform(), [&](const Event& event) {
      touching.note(event, p.world);
      if (event.kind != EventKind::contact_begin) return;
      ++begins;
      with_static += statics.contains(event.first) || statics.contains(event.second);
      EXPECT_TRUE(GetParam().mode == ContactEvents::impacts || event.time >= quiet) << event;
      check_begin(event);
      if (GetParam().mode != ContactEvents::impacts) return;
      const Bounce after = bounce(event, 1.0);
      if (carried.contains(event.first)) p.set_velocity(event.first, after.first_velocity);
      if (carried.contains(event.second)) p.set_velocity(event.second, after.second_velocity);
    });
    ASSERT_TRUE(is_clean(p.world));
    check_gaps();
  }
  EXPECT_GT(with_static, static_cast<std::size_t>(stops) / 15);
  EXPECT_GT(begins, with_static);
}

INSTANTIATE_TEST_SUITE_P(
    , RandomMeetings,
    testing::ValuesIn(scenes_of_each<ContactScene>({ContactScene{ContactEvents::begin_and_end, 0.0, 1},
                                                    ContactScene{ContactEvents::begin_and_end, 0.02, 2},
                                                    ContactScene{ContactEvents::impacts, 0.0, 3},
                                                    ContactScene{ContactEvents::impacts, 0.01, 4},
                                                    ContactScene{ContactEvents::begin_and_end, 0.02, 5}})));

// What events say.

Shape floor_of_triangles() {
  const std::array vertices{Vec3{-9, -9, 0}, Vec3{9, -9, 0}, Vec3{9, 9, 0}, Vec3{-9, 9, 0}};
  constexpr std::array<std::array<std::uint32_t, 3>, 2> corners{{{0, 1, 2}, {0, 2, 3}}};
  return Mesh::create(vertices, corners).value();
}
std::vector<Shape> floors() {
  return {HalfSpace{{0, 0, 1}, 0.0}, Box{{-9, -9, -1}, {9, 9, 0}},
          Triangle{{-9, -9, 0}, {9, -9, 0}, {0, 30, 0}}, floor_of_triangles()};
}
std::vector<Shape> lifts() {
  const std::array vertices{Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{1, 1, 0}, Vec3{-1, 1, 0}};
  constexpr std::array<std::array<std::uint32_t, 3>, 2> corners{{{0, 1, 2}, {0, 2, 3}}};
  return {plate, Triangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, Mesh::create(vertices, corners).value()};
}

TEST(MeetingShapes, ALiftMeetsTheFloorAndBounces) {
  for (const Shape& floor : floors())
    for (const Shape& shape : lifts()) {
      Playground p;
      const BodyId ground = p.world.add_static({.shape = floor}).value();
      const BodyId lift = add_moving_shape(p, {.position = {0, 0, 3}, .velocity = {0.5, 0, -2}}, shape);
      const auto event = p.advance(5.0);
      ASSERT_TRUE(event) << floor.index() << " and " << shape.index();
      EXPECT_EQ(event->kind, EventKind::contact_begin);
      EXPECT_EQ(event->first, ground);
      EXPECT_EQ(event->second, lift);
      EXPECT_NEAR(event->time, 1.5, 1e-5);
      EXPECT_NEAR(norm(event->normal - Vec3{0, 0, 1}), 0.0, 1e-9);
      EXPECT_NEAR(event->approach_speed, 2.0, 1e-9);
      EXPECT_NEAR(event->point.z, 0.0, 1e-5);
      EXPECT_LT(std::abs(event->point.x - 0.75), 1.0 + 1e-9);
      const Bounce after = bounce(*event, 0.5);
      EXPECT_NEAR(norm(after.second_velocity - Vec3{0.5, 0, 1}), 0.0, 1e-8);
      EXPECT_EQ(after.second_angular_velocity, Vec3{});
      EXPECT_EQ(after.first_velocity, Vec3{});
      p.set_velocity(lift, after.second_velocity);
      EXPECT_TRUE(p.run(9.0).empty() || p.world.definition().contacts != ContactEvents::impacts);
    }
}

TEST(MeetingShapes, TwoExchangeTheirSpeeds) {
  for (const Shape& one : lifts())
    for (const Shape& other : lifts()) {
      Playground p;
      const BodyId lower = add_moving_shape(p, {.velocity = {0, 0, 1}, .mass = 2}, one);
      const BodyId upper =
          add_moving_shape(p, {.position = {0.1, 0.2, 4}, .velocity = {0, 0, -1}, .mass = 2}, other);
      const auto event = p.advance(5.0);
      ASSERT_TRUE(event) << one.index() << " and " << other.index();
      const double thick = std::holds_alternative<Box>(one) ? 0.5 : 0.0;
      EXPECT_NEAR(event->time, 2.0 - thick / 2, 1e-5);
      EXPECT_NEAR(norm(event->normal - Vec3{0, 0, 1}), 0.0, 1e-9);
      const Bounce after = bounce(*event, 1.0);
      EXPECT_NEAR(norm(after.first_velocity - Vec3{0, 0, -1}), 0.0, 1e-8);
      EXPECT_NEAR(norm(after.second_velocity - Vec3{0, 0, 1}), 0.0, 1e-8);
      EXPECT_EQ(event->first, lower);
      EXPECT_EQ(event->second, upper);
    }
}

/// Two sheets have no thickness that could carry the one.
bool are_sheets(const Shape& one, const Shape& other) {
  const auto is_sheet = [](const Shape& shape) {
    return std::holds_alternative<Triangle>(shape) || std::holds_alternative<Mesh>(shape);
  };
  return is_sheet(one) && is_sheet(other);
}

TEST(MeetingShapes, ComeToRestOnAFloor) {
  for (const Shape& floor : floors())
    for (const Shape& shape : lifts()) {
      if (are_sheets(floor, shape)) continue;
      Playground p({.contact_tolerance = eps, .contacts = ContactEvents::impacts});
      p.world.add_static({.shape = floor}).value();
      const BodyId crate = add_moving_shape(
          p, {.planned_acceleration = {0, 0, -10}, .position = {0, 0, 1}, .velocity = {0.3, 0, 0}}, shape);
      const double resting = 1.01 * least_resting_speed(eps, 10.0);
      double lowest = infinity;
      p.run(3.0, [&](const Event& event) {
        lowest = std::min(lowest, p.state(crate).position.z);
        if (event.kind == EventKind::contact_begin)
          p.set_velocity(crate, settle(event, 0.3, resting).second_velocity);
      });
      EXPECT_EQ(p.world.time(), 3.0);
      EXPECT_GE(lowest, -eps * 1.000001) << floor.index() << " and " << shape.index();
      EXPECT_NEAR(p.state(crate).position.z, 0.0, 2.0 * eps);
      EXPECT_LT(p.world.counters().pair_checks, 200'000u);
    }
}

/// A door in its frame touches it on all sides, and slides on.
TEST(MeetingShapes, SlideAlongWhatTheyTouch) {
  Playground p({.contacts = ContactEvents::all});
  for (const double side : {-1.0, 1.0})
    p.world.add_static({.shape = Box{{side < 0 ? -2.0 : 1.0, -3, -9}, {side < 0 ? -1.0 : 2.0, 3, 9}}})
        .value();
  p.world.add_static({.shape = Triangle{{-5, 1, -9}, {5, 1, -9}, {0, 1, 30}}}).value();
  const BodyId lift = add_moving_shape(p, {.velocity = {0, 0, 1}}, Box{{-1, -1, -1}, {1, 1, 1}});
  add_moving_shape(p, {.position = {0, 0, 2}, .velocity = {0, 0, 1}}, Box{{-1, -1, -1}, {1, 0.5, 1}});
  std::set<BodyId> partners;
  for (const Event& event : p.run(3.0)) {
    ASSERT_EQ(event.kind, EventKind::contact_begin) << event;
    EXPECT_EQ(event.time, 0.0);
    EXPECT_NEAR(event.approach_speed, 0.0, 1e-12) << event;
    if (event.second == lift) partners.insert(event.first);
    if (event.first == lift) partners.insert(event.second);
  }
  EXPECT_EQ(partners.size(), 4u);
}

TEST(MeetingShapes, StayApartWhereTheirFiltersSaySo) {
  Playground p;
  p.world.add_static({.shape = HalfSpace{{0, 0, 1}, 0.0}, .filter = {.category = 2}}).value();
  const BodyDefinition falls{.position = {0, 0, 3}, .velocity = {0, 0, -1}, .filter = {.mask = 1}};
  const BodyId lift = add_moving_shape(p, falls, plate);
  EXPECT_TRUE(p.run(5.0).empty());
  p.world.change(lift, {.filter = Filter{}}).value();
  const auto event = p.advance(6.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->time, 5.0);
  EXPECT_TRUE(event->already_touching || event->gap < 0.0);
}

TEST(MeetingShapes, ZonesAndSensorsKnowMovingShapes) {
  Playground p;
  const BodyId zone = p.world.add_zone(Box{{4, -1, -1}, {5, 1, 1}}).value();
  const BodyId lift = add_moving_shape(p, {.velocity = {1, 0, 0}}, plate);
  // A zone that moves, in turn, knows the wall.
  p.world.set_sensor(3, {.distances = {0.5}}).value();
  p.world.add_static({.shape = Box{{-9, -1, 8}, {-8, 1, 9}}}).value();
  add_moving_shape(p, {.position = {0, 0, 8}, .velocity = {-1, 0, 0}, .solid = false, .sensor_class = 3},
                   plate);
  const auto events = p.run(20.0);
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(events[0].kind, EventKind::sensor_enter);
  EXPECT_EQ(std::pair(events[0].first, events[0].second), std::pair(zone, lift));
  EXPECT_NEAR(events[0].time, 3.0, 1e-4);
  EXPECT_EQ(events[1].kind, EventKind::sensor_leave);
  EXPECT_NEAR(events[1].time, 6.0, 1e-4);
  EXPECT_EQ(events[2].kind, EventKind::sensor_enter);
  EXPECT_NEAR(events[2].time, 6.5, 1e-4);
  EXPECT_EQ(events[3].kind, EventKind::sensor_leave);
  EXPECT_NEAR(events[3].time, 10.5, 1e-4);
}

TEST(MeetingShapes, AreInThePlaneThere) {
  const std::array frame{Vec3{4, -9, 0}, Vec3{4, 9, 0}};
  const auto chain = Mesh::chain(frame);
  ASSERT_TRUE(chain) << chain.error().message;
  const std::array bent{Vec3{-0.5, -1, 0}, Vec3{0.5, 0.3, 0}, Vec3{-0.5, 1, 0}};
  const Shape bow = Mesh::chain(bent).value();
  const std::vector<Shape> walls{HalfSpace{{-1, 0, 0}, -4}, Box{{4, -9, 0}, {5, 9, 0}}, *chain};
  for (const Shape& wall : walls)
    for (const Shape& door : {Shape(Box{{-0.5, -1.03, 0}, {0.5, 1, 0}}), bow}) {
      Playground p({.dimensions = 2, .contact_tolerance = eps});
      p.world.add_static({.shape = wall}).value();
      const BodyId id = add_moving_shape(p, {.position = {0.1, 0.3, 0}, .velocity = {1, 0.37, 0}}, door);
      const auto event = p.advance(9.0);
      ASSERT_TRUE(event) << wall.index() << " and " << door.index();
      EXPECT_NEAR(event->time, 3.4, 1e-4);
      EXPECT_NEAR(event->normal.x, -1.0, 1e-9);
      EXPECT_EQ(event->normal.z, 0.0);
      EXPECT_EQ(event->point.z, 0.0);
      p.set_velocity(id, bounce(*event, 1.0).second_velocity);
      EXPECT_NEAR(p.state(id).velocity.x, -1.0, 1e-9);
    }
}

// Answers, errors, copies.

TEST(MeetingShapes, AnswersKnowThem) {
  Playground p;
  const BodyId ground = p.world.add_static({.shape = Box{{-9, -9, -1}, {9, 9, 0}}}).value();
  const BodyId lift = add_moving_shape(p, {.position = {0, 0, 3}, .velocity = {0, 0, -1}}, plate);
  const BodyId upper = add_moving_shape(p, {.position = {0, 0, 6}, .velocity = {0, 0, -2}}, plate);
  const auto certificates = p.world.certificates();
  EXPECT_NEAR(certificates.safe_until()->time, 2.5, 1e-4);
  EXPECT_NEAR(certificates.safe_until(lift, upper)->time, 2.5, 1e-4);
  EXPECT_NEAR(certificates.safe_until(lift, ground)->time, 3.0, 1e-4);
  EXPECT_NEAR(certificates.safe_until(lift, ground, 1.0)->time, 2.0, 1e-4);
  EXPECT_EQ(certificates.earliest_contact(ground)->partner, lift);
  EXPECT_NEAR(certificates.earliest_approach(ground, 1.0)->time, 2.0, 1e-4);
  const auto limits = certificates.distance_limits(ground, upper, 1.0).value();
  EXPECT_NEAR(limits.lower, 4.0, 1e-12);
  EXPECT_NEAR(limits.upper, 4.0, 1e-12);
}

TEST(MeetingShapes, OverlapsAreRefused) {
  Playground p({.allow_overlap = false});
  const BodyId ground = p.world.add_static({.shape = Box{{-9, -9, -1}, {9, 9, 0}}}).value();
  const auto refused = [&](const auto& result, BodyId by) {
    expect_error(result, ErrorCode::overlapping, "shape", "", by);
  };
  for (const Shape& shape : lifts()) {
    const bool is_solid = std::holds_alternative<Box>(shape);
    const MovingShape in{{.position = {0, 0, -0.25}}, shape};
    refused(p.world.add_moving_shape(in), ground);
    MovingShape upon = in;
    upon.body.position.z = is_solid ? 0.0 : 1e-7;
    p.world.remove(p.world.add_moving_shape(upon).value()).value();
  }
  const BodyId lift = p.world.add_moving_shape({{.position = {0, 0, 2}}, plate}).value();
  refused(p.world.add_moving_shape({{.position = {0.5, 0, 2.25}}, plate}), lift);
  refused(p.world.add_static({.shape = Box{{0, 0, 2.1}, {4, 4, 5}}}), lift);
  refused(p.world.add_static({.shape = HalfSpace{{0, 0, 1}, 2.1}}), lift);
  refused(p.world.set_shape(lift, Box{{-1, -1, -3}, {1, 1, 0}}), ground);
  refused(p.world.teleport(lift, {{0, 0, -0.1}, {}}), ground);
  EXPECT_EQ(p.world.body(lift)->definition.position, (Vec3{0, 0, 2}));
  p.world.set_shape(lift, Box{{-1, -1, -2}, {1, 1, 0}}).value();
  p.world.add_moving_shape({{.position = {0, 0, 2}, .filter = {.mask = 0}}, plate}).value();
}

/// Plates of all shapes that fall onto a floor and onto each other.
struct Heap : MappedWorld<Ballistic> {
  Heap() {
    world = World::create({.contacts = ContactEvents::impacts}).value();
    std::vector<State> start;
    Random random(45);
    for (int k = 0; k < count; ++k)
      start.push_back(
          {{random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(1, 9)}, random.unit_vector()});
    motion = std::make_unique<Ballistic>(Ballistic::create({.start = start}).value());
    for (const Shape& wall : {Shape(Box{{-9, -9, -1}, {9, 9, 0}}), Shape(HalfSpace{{0, 0, -1}, -10}),
                              Shape(HalfSpace{{1, 0, 0}, -8}), Shape(HalfSpace{{-1, 0, 0}, -8}),
                              Shape(HalfSpace{{0, 1, 0}, -8}), Shape(HalfSpace{{0, -1, 0}, -8})})
      world.add_static({.shape = wall}).value();
    for (std::uint32_t k = 0; k < count; ++k) {
      if (k % 4 == 3)
        bodies.add(world, *motion, k, {.radius = 0.3}).value();
      else
        bodies.add_moving_shape(world, *motion, k, {{}, lifts()[k % 3]}).value();
    }
  }

  static constexpr int count = 120;
};

TEST(MeetingShapes, RunTheSameWithThreadsAndFromSnapshots) {
  expect_the_same_with_threads_and_from_snapshots<Heap>(4, 2.0, 100);
  Heap alone, threaded;
  Workers workers = Workers::create(4).value();
  alone.run(2.0);
  threaded.run(2.0, &workers);
  EXPECT_EQ(alone.world.save().value(), threaded.world.save().value());
}

TEST(MeetingShapes, AreRecorded) {
  Heap heap;
  ASSERT_TRUE(heap.world.start_recording());
  heap.run(1.0);
  expect_replay(heap.world);
}

/// A snapshot between two events of one instant, both about a moving shape alone.
TEST(MeetingShapes, SnapshotsHoldBrokenPromisesThatWait) {
  Playground p;
  std::vector<BodyId> plates;
  for (const double x : {-5.0, 5.0})
    plates.push_back(add_moving_shape(p, {.position = {x, 0, 3}, .velocity = {0, 0, -1}}, plate));
  EXPECT_TRUE(p.run(1.0).empty());
  for (const BodyId id : plates) p.set_velocity_unseen(id, {0, 0, 1});
  const auto first = p.advance(99.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->kind, EventKind::bound_violation);
  auto restored = World::restore(p.world.save().value());
  ASSERT_TRUE(restored) << restored.error().message;
  p.world = std::move(restored).value();
  const auto second = p.advance(99.0);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->kind, EventKind::bound_violation);
  EXPECT_EQ(second->time, first->time);
}

/// A snapshot between two contacts of one instant.
TEST(MeetingShapes, SnapshotsHoldTheirWaitingEvents) {
  Playground p;
  p.world.add_static({.shape = HalfSpace{{0, 0, 1}, 0.0}}).value();
  for (const double x : {-5.0, 5.0})
    add_moving_shape(p, {.position = {x, 0, 3}, .velocity = {0, 0, -1}}, plate);
  ASSERT_TRUE(p.advance(5.0));
  ASSERT_TRUE(World::restore(p.world.save().value()));
  p.world = World::restore(p.world.save().value()).value();
  const auto second = p.advance(5.0);
  ASSERT_TRUE(second);
  EXPECT_NEAR(second->time, 3.0, 1e-5);
}

}  // namespace
}  // namespace kinesphere::meeting_shapes_test
