// Rigid bodies on random courses, compared with brute force: gaps by other formulas, and intervals of time in
// which these certainly are, or are not, below a limit. Then what single contacts say, and wrong calls.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "kinesphere/body_map.hpp"
#include "kinesphere/certificates.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/recording.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/workers.hpp"
#include "number/infinity.hpp"
#include "support/expect_error.hpp"
#include "support/placed_parts.hpp"
#include "support/spin.hpp"
#include "support/test_size.hpp"
#include "world/surroundings.hpp"

namespace kinesphere::rigid_bodies_test {
namespace {

using namespace placed_parts;

constexpr double eps = 1e-5;

// The scene.

struct Kind {
  std::uint64_t seed;
  double angular_acceleration;
  bool has_walls;
  bool is_periodic;
  bool has_hulls = false;
  double largest_spin = 10.0;
  int stops = 80;
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) {
  return out << "angular acceleration " << kind.angular_acceleration << (kind.has_walls ? ", walls" : "")
             << (kind.is_periodic ? ", periodic" : "") << (kind.has_hulls ? ", hulls" : "") << ", spin "
             << kind.largest_spin << ", seed " << kind.seed;
}

class RandomRigidBodies : public testing::TestWithParam<Kind> {
 protected:
  RandomRigidBodies() : p(definition()), random(GetParam().seed) {
    if (spins_change()) p.world.set_rotation_probe(rotation_probe()).value();
    for (int k = 0; k < 7; ++k) come();
    for (int k = 0; k < 5; ++k) {
      const double radius = 0.1 + 0.4 * random.uniform();
      things[p.add(any_body(radius))] = {.hulls = {true_hulls::Hull(std::vector<Vec3>(1))}};
    }
    if (!GetParam().is_periodic) add_shapes();
  }

  static WorldDefinition definition() {
    const double edge = GetParam().is_periodic ? 0.5 * period : 4.0;
    WorldDefinition definition{.contact_tolerance = eps};
    if (GetParam().has_walls || GetParam().is_periodic)
      definition.box = Box{{-edge, -edge, -edge}, {edge, edge, edge}};
    if (GetParam().is_periodic) definition.periodic = {true, true, true};
    return definition;
  }
  static bool spins_change() { return GetParam().angular_acceleration > 0.0; }

  /// The middle of the scene: in periodic space a corner of the box.
  static Vec3 home() {
    return GetParam().is_periodic ? Vec3{0.5 * period, 0.5 * period, 0.5 * period} : Vec3{};
  }

  void add_shapes() {
    const std::array<Shape, 3> shapes{HalfSpace{{0.6, 0, 0.8}, -2.5}, Box{{-1, -1, -3}, {1, 0.5, -2}},
                                      Triangle{{-2, 1, 0}, {2, 2, 0.5}, {0.5, -1, 2}}};
    for (const Shape& shape : shapes)
      things[p.world.add_static({.shape = shape, .filter = {.category = 2}}).value()] = {.shape = shape};
    MovingShape plate{any_body(1.0), Box{{-1, -1, -0.1}, {1, 1, 0.1}}};
    plate.body.filter.mask = 1;  // it passes the others
    const BodyId id = p.world.add_moving_shape(plate).value();
    p.start_course(id, plate.body);
    things[id] = {.shape = plate.shape, .is_carried = true};
  }

  BodyDefinition any_body(double radius) {
    return {.radius = radius,
            .acceleration_limit = 2,
            .position = home() + 2.0 * random.point_in_ball(),
            .velocity = 1.5 * random.point_in_ball()};
  }

  /// A box, a needle, a plate or a hull, sharp or round.
  RigidPart any_hull() {
    const double radius = random.bits() % 2 == 0 ? 0.0 : 0.2 * random.uniform();
    const auto box = [&](double x, double y, double z) {
      return box_part({{-x, -y, -z}, {x, y, z}}, radius);
    };
    const auto length = [&] { return 0.1 + 0.6 * random.uniform(); };
    switch (random.bits() % 4) {
      case 0:
        return box(length(), length(), length());
      case 1:
        return box(0.001, 1.0, 0.001);
      case 2:
        return box(length(), 0.0, length());
      default: {
        std::vector<Vec3> points;
        for (std::size_t k = 3 + random.bits() % 4; k > 0; --k) points.push_back(random.point_in_ball());
        return hull_part(points, radius);
      }
    }
  }

  std::vector<RigidPart> any_parts() {
    std::vector<RigidPart> parts;
    if (GetParam().has_hulls) {
      parts.push_back(any_hull());
      if (random.bits() % 3 > 0) return parts;
    }
    const std::size_t count = 1 + random.bits() % 4;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3 a = random.point_in_ball();
      const bool is_ball = random.bits() % 2 == 0;
      // Long thin ones, too.
      const Vec3 b = random.bits() % 5 == 0 ? a + 2.5 * random.unit_vector() : random.point_in_ball();
      parts.push_back({a, is_ball ? a : b, random.bits() % 6 == 0 ? 0.002 : 0.05 + 0.3 * random.uniform()});
    }
    return parts;
  }

  void come() {
    const double speed = 0.6 * GetParam().largest_spin * random.uniform();
    Spin spin{.since = p.world.time(),
              .orientation = rotation_by(3.0 * random.point_in_ball()),
              .axis = random.unit_vector(),
              .speed = speed};
    const RigidBody body{.body = any_body(1.0),
                         .parts = any_parts(),
                         .rotation = spin.at(p.world.time()),
                         .angular_acceleration_limit = GetParam().angular_acceleration,
                         .largest_angular_speed = GetParam().largest_spin};
    const auto id = p.world.add_rigid_body(body);
    if (!id && GetParam().has_walls) return come();
    p.start_course(id.value(), body.body);
    things[*id] = {.parts = body.parts};
    for (const RigidPart& part : body.parts) things[*id].hulls.emplace_back(points_of(part));
    spins[*id] = spin;
    rigid.push_back(*id);
  }

  RotationProbe rotation_probe() {
    return [this](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
      for (std::size_t k = 0; k < ids.size(); ++k) rotations[k] = spins.at(ids[k]).at(time);
    };
  }

  void change() {
    const std::size_t k = random.bits() % rigid.size();
    const BodyId id = rigid[k];
    const double now = p.world.time();
    switch (random.bits() % 8) {
      case 0:
        p.world.remove(id).value();
        std::erase_if(touching,
                      [=](const auto& pair) { return pair.first.first == id || pair.first.second == id; });
        things.erase(id);
        spins.erase(id);
        rigid.erase(rigid.begin() + static_cast<std::ptrdiff_t>(k));
        return come();
      case 1: {
        Spin& spin = spins[id];
        spin = {now, spin.at(now).orientation, random.unit_vector(),
                0.6 * GetParam().largest_spin * random.uniform()};
        return p.world.change(id, {.angular_velocity = spin.axis * spin.speed}).value();
      }
      case 2: {
        const Spin turned{now, rotation_by(3.0 * random.point_in_ball()), random.unit_vector(), 3.0};
        if (!p.world.change(id, {.rotation = turned.at(now)})) return;  // into a wall
        spins[id] = turned;
        return;
      }
      case 3: {
        const State to{home() + 2.0 * random.point_in_ball(), random.point_in_ball()};
        if (!p.world.teleport(id, to)) return;  // into a wall
        p.set_state(id, to);
        // The world knows the rotation of a body that keeps its angular velocity alone.
        if (spins_change()) p.world.change(id, {.rotation = spins[id].at(now)}).value();
        return;
      }
      case 4:
        p.world = World::restore(p.world.save().value()).value();
        if (spins_change()) p.world.set_rotation_probe(rotation_probe()).value();
        return;
      default:
        return;
    }
  }

  /// Steers the bodies back towards the middle.
  void steer() {
    for (const auto& [id, thing] : things) {
      if (thing.shape && !thing.is_carried) continue;
      const Vec3 away = p.state(id).position - home();
      p.steer(id, -1.0 * away / (norm(away) + 0.1) + 0.9 * random.point_in_ball());
      if (!spins_change() || thing.parts.empty()) continue;
      Spin& spin = spins[id];
      const double now = p.world.time();
      const double speed = spin.speed_at(now);
      const double largest = GetParam().largest_spin;
      const double sign = speed > std::min(0.8 * largest, largest - longest * GetParam().angular_acceleration)
                              ? -1.0
                          : speed < 0.0            ? 1.0
                          : random.bits() % 2 == 0 ? 1.0
                                                   : -1.0;
      spin = {now, spin.at(now).orientation, spin.axis, speed,
              sign * GetParam().angular_acceleration * random.uniform()};
    }
  }

  // Brute force.

  struct Thing {
    std::vector<RigidPart> parts{};  ///< empty for a ball and a shape
    std::vector<true_hulls::Hull> hulls{};
    std::optional<Shape> shape{};
    bool is_carried = false;
  };

  std::vector<PlacedPart> placed(BodyId id, const Thing& thing, double time, const Vec3& shift = {}) const {
    const Vec3 position = p.state(id, time).position + shift;
    if (thing.parts.empty()) return {{RigidPart{.radius = p.radius(id)}, thing.hulls[0], position, {}}};
    const Quaternion orientation = spins.at(id).at(time).orientation;
    std::vector<PlacedPart> found;
    for (std::size_t k = 0; k < thing.parts.size(); ++k)
      found.emplace_back(thing.parts[k], thing.hulls[k], position, orientation);
    return found;
  }

  /// Beyond `enough`, a lower limit will do.
  double gap(BodyId first, BodyId second, double time, bool is_deep = true, double enough = infinity) const {
    const Thing& one = things.at(first);
    const Thing& other = things.at(second);
    if (one.shape) return gap(second, first, time, is_deep, enough);
    Vec3 shift;
    if (GetParam().is_periodic)
      for (int k = 0; k < 3; ++k)
        shift[k] =
            -period *
            std::round((p.state(second, time).position[k] - p.state(first, time).position[k]) / period);
    double least = infinity;
    for (const PlacedPart& part : placed(first, one, time)) {
      if (other.shape) {
        const Vec3 origin = other.is_carried ? p.state(second, time).position : Vec3{};
        const double least_gap = distance_of(*other.shape, part.middle - origin) - part.reach;
        if (least_gap > enough) {
          least = std::min(least, least_gap);
          continue;
        }
        least = std::min(least, gap_of(part, *other.shape, origin, is_deep, enough));
        continue;
      }
      for (const PlacedPart& far : placed(second, other, time, shift)) {
        const double least_gap = norm(part.middle - far.middle) - part.reach - far.reach;
        least = std::min(least, least_gap > enough ? least_gap : gap_of(part, far, is_deep, enough));
      }
    }
    return least;
  }

  double wall_gap(BodyId id, Wall wall, double time) const {
    const int number = static_cast<int>(wall) - 1;
    double least = infinity;
    for (const PlacedPart& part : placed(id, things.at(id), time))
      for (const Vec3& point : part.points) {
        const double x = number % 2 == 0 ? point[number / 2] + 4.0 : 4.0 - point[number / 2];
        least = std::min(least, x - part.axis.radius);
      }
    return least;
  }

  /// Largest speed of a point of the body during a step.
  double largest_speed(BodyId id) const {
    const Thing& thing = things.at(id);
    if (thing.shape && !thing.is_carried) return 0.0;
    double reach = 0.0;
    for (const RigidPart& part : thing.parts)
      for (const Vec3& point : points_of(part)) reach = std::max(reach, norm(point));
    return norm(p.state(id).velocity) + 2.0 * longest + GetParam().largest_spin * reach;
  }

  /// Checks that the world says of every moment in [from, to] what the gap is, wherever that is clear.
  template <class Gap>
  void check(double from, double to, double speed, bool was_touching,
             const std::vector<std::pair<double, bool>>& told, Gap gap_at) {
    const double middle = 0.5 * (from + to);
    const double change = speed * 0.5 * (to - from) + 1e-9;
    const double gap = gap_at(middle, change + 6.0 * eps);
    const auto says = [&](bool wanted) {
      bool state = was_touching;
      for (const auto& [time, begins] : told) {
        if (time > to) break;
        if (time > from && state != wanted) return false;
        state = begins;
      }
      return state == wanted;
    };
    if (gap - change > 5.0 * eps) {
      ASSERT_TRUE(says(false)) << "apart by " << gap << " at " << middle;
    } else if (gap + change < -eps) {
      ASSERT_TRUE(says(true)) << "unreported, gap " << gap << " at " << middle;
    } else if (change > 0.25 * eps) {
      check(from, middle, speed, was_touching, told, gap_at);
      if (HasFatalFailure()) return;
      check(middle, to, speed, was_touching, told, gap_at);
    }
  }

  static constexpr double longest = 0.2;  ///< of a step (time)
  static constexpr double period = 22.0;

  Surroundings p;
  Random random;
  std::map<BodyId, Thing> things;
  std::map<BodyId, Spin> spins;
  std::vector<BodyId> rigid;
  /// Pairs in touch; for a wall, the number of the wall stands for the second body.
  std::map<std::pair<BodyId, BodyId>, bool> touching;
};

TEST_P(RandomRigidBodies, AreReportedWheneverTheirPartsTouch) {
  std::size_t begins = 0;
  const int stops = rounds_of(GetParam().stops);
  for (int stop = 1; stop <= stops && !HasFatalFailure(); ++stop) {
    change();
    steer();
    const double from = p.world.time();
    const double to = from + longest * random.uniform();
    const auto wall_id = [](Wall wall) { return BodyId{1000000u + static_cast<std::uint32_t>(wall), 0, 0}; };
    std::map<std::pair<BodyId, BodyId>, std::vector<std::pair<double, bool>>> told;
    p.run(to, [&](const Event& event) {
      ASSERT_NE(event.kind, EventKind::bound_violation) << event;
      const BodyId second = event.second == no_body ? wall_id(event.wall) : event.second;
      const bool begin = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
      const bool end = event.kind == EventKind::contact_end || event.kind == EventKind::wall_end;
      if (!begin && !end) return;
      if (!things.contains(event.first) || (event.second != no_body && !things.contains(event.second)))
        return;
      begins += begin;
      told[{event.first, second}].emplace_back(event.time, begin);
      if (!begin) return;
      const double gap = event.second == no_body ? wall_gap(event.first, event.wall, event.time)
                                                 : this->gap(event.first, event.second, event.time, false);
      EXPECT_LE(gap, eps + 1e-9) << event;
      if (gap > -1e-3) {
        EXPECT_NEAR(event.gap, gap, 1e-9) << event;
      }
    });
    for (auto one = things.begin(); one != things.end() && !HasFatalFailure(); ++one) {
      for (auto other = std::next(one); other != things.end() && !HasFatalFailure(); ++other) {
        if (one->second.parts.empty() && other->second.parts.empty()) continue;
        const auto pair = std::pair(one->first, other->first);
        check(from, to, largest_speed(pair.first) + largest_speed(pair.second), touching[pair], told[pair],
              [&](double time, double enough) { return gap(pair.first, pair.second, time, true, enough); });
        if (HasFatalFailure()) ADD_FAILURE() << pair.first << " and " << pair.second << ", stop " << stop;
        if (!told[pair].empty()) touching[pair] = told[pair].back().second;
        const auto limits =
            p.world.certificates().distance_limits(pair.first, pair.second, p.world.time()).value();
        const double gap = this->gap(pair.first, pair.second, p.world.time());
        if (gap > 0.0) {
          ASSERT_LE(limits.lower, gap + 1e-9) << pair.first << " " << pair.second;
        }
        ASSERT_GE(limits.upper, gap - 1e-9) << pair.first << " " << pair.second;
      }
      if (!GetParam().has_walls || one->second.shape) continue;
      for (int wall = 1; wall <= wall_count; ++wall) {
        const auto pair = std::pair(one->first, wall_id(static_cast<Wall>(wall)));
        check(from, to, largest_speed(pair.first), touching[pair], told[pair],
              [&](double time, double) { return wall_gap(pair.first, static_cast<Wall>(wall), time); });
        if (HasFatalFailure()) ADD_FAILURE() << pair.first << " and wall " << wall << ", stop " << stop;
        if (!told[pair].empty()) touching[pair] = told[pair].back().second;
      }
    }
    if (stop % 10 == 0) {
      ASSERT_TRUE(is_clean(p.world)) << "stop " << stop;
    }
  }
  EXPECT_GT(begins, static_cast<std::size_t>(stops) / 4);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, RandomRigidBodies,
    testing::ValuesIn(scenes_of_each<Kind>(
        {Kind{1, 0.0, false, false}, Kind{2, 0.0, true, false}, Kind{3, 8.0, false, false},
         Kind{4, 8.0, true, false}, Kind{5, 0.0, false, true}, Kind{6, 8.0, false, true},
         Kind{7, 0.0, true, false, true, 10.0, 25}, Kind{8, 8.0, false, false, true, 10.0, 15},
         Kind{9, 8.0, false, true, true, 10.0, 40}, Kind{10, 200.0, true, false, true, 100.0, 3}})));

/// A dumbbell along x: two balls of radius 0.5 and mass 1, each 1 from the position.
RigidBody dumbbell(const Vec3& position, const Vec3& velocity = {}, const Vec3& spin = {}) {
  return {.body = {.position = position, .velocity = velocity, .mass = 2},
          .parts = {{{-1, 0, 0}, {-1, 0, 0}, 0.5}, {{1, 0, 0}, {1, 0, 0}, 0.5}},
          .rotation = {.angular_velocity = spin},
          .inertia = {0, 2, 2}};
}

/// World of bodies that fly freely and bounce without loss; the world turns them.
class FreeFlight : public testing::Test {
 protected:
  void bounce_at(const Event& event) {
    const Bounce after = bounce(event, 1.0);
    p.set_velocity(event.first, after.first_velocity);
    p.world.change(event.first, {.angular_velocity = after.first_angular_velocity}).value();
    if (event.second == no_body) return;
    p.set_velocity(event.second, after.second_velocity);
    if (p.world.body(event.second)->rigid)
      p.world.change(event.second, {.angular_velocity = after.second_angular_velocity}).value();
  }
  double energy(BodyId id) const {
    const RigidBody body = p.world.body(id)->rigid.value();
    const Vec3 spin = rotated_back(body.rotation.orientation, body.rotation.angular_velocity);
    return 0.5 * (body.body.mass * norm_squared(p.state(id).velocity) + body.inertia.x * spin.x * spin.x +
                  body.inertia.y * spin.y * spin.y + body.inertia.z * spin.z * spin.z);
  }
  Vec3 angular_momentum(BodyId id) const {
    const RigidBody body = p.world.body(id)->rigid.value();
    Vec3 spin = rotated_back(body.rotation.orientation, body.rotation.angular_velocity);
    for (int axis = 0; axis < 3; ++axis) spin[axis] *= body.inertia[axis];
    const State state = p.state(id);
    return rotated(body.rotation.orientation, spin) + body.body.mass * cross(state.position, state.velocity);
  }

  Playground p{WorldDefinition{.contact_tolerance = 1e-9, .contacts = ContactEvents::impacts}};
};

TEST_F(FreeFlight, BouncesKeepMomentaAndEnergy) {
  Random random(5);
  int bounces = 0;
  for (int run = 0; run < 200; ++run) {
    p = Playground(WorldDefinition{.contact_tolerance = 1e-9, .contacts = ContactEvents::impacts});
    RigidBody one = dumbbell(random.point_in_ball(), {}, random.point_in_ball());
    one.inertia = {0.5, 2, 3};
    RigidBody other = dumbbell({4, 0, 0}, {-2, 0, 0}, 3.0 * random.point_in_ball());
    other.rotation.orientation = rotation_by(3.0 * random.point_in_ball());
    other.parts.push_back({{0, 0.5, 0}, {0, -1, 0.5}, 0.2});
    other.inertia = {random.uniform(), random.uniform(), random.uniform()};
    other.body.mass = 0.1 + random.uniform();
    const BodyId a = p.add_rigid_body(one);
    const BodyId b = p.add_rigid_body(other);
    const auto event = p.advance(10.0);
    if (!event) continue;
    ++bounces;
    ASSERT_NEAR(event->gap, 0.0, 2e-9);
    const double energy_before = energy(a) + energy(b);
    const Vec3 turning_before = angular_momentum(a) + angular_momentum(b);
    const Vec3 way_before = 2.0 * p.state(a).velocity + other.body.mass * p.state(b).velocity;
    bounce_at(*event);
    ASSERT_NEAR(energy(a) + energy(b), energy_before, 1e-12 * energy_before) << *event;
    ASSERT_LT(norm(angular_momentum(a) + angular_momentum(b) - turning_before), 1e-11) << *event;
    ASSERT_LT(norm(2.0 * p.state(a).velocity + other.body.mass * p.state(b).velocity - way_before), 1e-12);
  }
  EXPECT_GT(bounces, 100);
}

TEST_F(FreeFlight, ASpinningDumbbellHitsAtTheTimeOfItsRotation) {
  p.add_rigid_body(dumbbell({0, 0, 0}, {}, {0, 0, 1}));
  const BodyId ball = p.add({.radius = 0.5, .position = {0, -1.5, 0}});
  // The ball of the part at -x comes to (0, -1, 0) after a quarter turn; the two touch when it is within 1 of
  // the other ball: cos(angle) from there.
  const auto event = p.advance(10.0);
  ASSERT_TRUE(event);
  const double cosine = (1.0 + 1.5 * 1.5 - 1.0) / (2.0 * 1.5);
  EXPECT_NEAR(event->time, 0.5 * 3.14159265358979323846 - std::acos(cosine), 1e-8);
  EXPECT_EQ(event->second, ball);
  EXPECT_EQ(event->first_part, 0u);
  EXPECT_EQ(event->second_part, 0u);
  EXPECT_EQ(event->first_angular_velocity, (Vec3{0, 0, 1}));
  EXPECT_EQ(event->second_spin_gain, Vec3{});
  EXPECT_GT(event->approach_speed, 0.5);
}

/// Answers that change spins alone, and leave a part of the approach.
TEST_F(FreeFlight, PinnedRotorsStopEachOther) {
  const auto rotor = [](const Vec3& position, double angle) {
    return RigidBody{.body = {.position = position, .mass = infinity},
                     .parts = {{{}, {1, 0, 0}, 0.1}},
                     .rotation = {rotation_by({0, 0, angle}), {0, 0, -1}},
                     .inertia = {1, 1, 1}};
  };
  p.add_rigid_body(rotor({0, 0, 0}, 0.0));
  p.add_rigid_body(rotor({1.8, 0, 0}, std::numbers::pi + 0.5));
  double first = infinity;
  const auto events = p.run(1.0, [&](const Event& event) {
    first = std::min(first, event.time);
    EXPECT_NEAR(event.time, first, 1e-8) << "they have nearly stopped";
    p.world.change(event.first, {.angular_velocity = 0.3 * event.first_angular_velocity}).value();
    p.world.change(event.second, {.angular_velocity = 0.3 * event.second_angular_velocity}).value();
  });
  EXPECT_GT(events.size(), 10u);
}

TEST_F(FreeFlight, ARecordingIsReplayed) {
  for (int k = 0; k < 5; ++k)
    p.add_rigid_body(dumbbell({3.0 * k, 0.1 * k, 0}, {k % 2 == 0 ? 1.0 : -1.0, 0, 0}, {0.3 * k, 0, 1.0}));
  p.world.start_recording().value();
  int events = 0;
  p.run(20.0, [&](const Event& event) {
    ++events;
    bounce_at(event);
  });
  ASSERT_GT(events, 5);
  Replay replay = Replay::open(p.world.stop_recording().value()).value();
  while (!replay.finished()) ASSERT_TRUE(replay.advance());
  EXPECT_EQ(replay.world().time(), 20.0);
}

/// Two rods that the caller turns meet each other again and again.
TEST_F(FreeFlight, ARecordingContainsRotations) {
  for (const double x : {0.0, 2.5}) {
    RigidBody rod = dumbbell({x, 0, 0});
    rod.angular_acceleration_limit = 1;
    rod.largest_angular_speed = 3;
    p.add_rigid_body(rod);
  }
  const auto turning = [](double speed) {
    return [speed](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
      for (std::size_t k = 0; k < ids.size(); ++k) {
        const double rate = speed * (1.0 + ids[k].index);
        rotations[k] = {rotation_by({0, 0, rate * time}), {0, 0, rate}};
      }
    };
  };
  p.world.change({0, 0, 0}, {.rotation = Rotation{.angular_velocity = {0, 0, 1}}}).value();
  p.world.change({1, 0, 0}, {.rotation = Rotation{.angular_velocity = {0, 0, 2}}}).value();
  p.world.set_rotation_probe(turning(1.0)).value();
  p.world.start_recording().value();
  EXPECT_EQ(p.run(5.0).size(), 2u) << "they overlap from the start, part, and meet at 2.88";
  World copy = p.world.clone().value();
  p.run(10.0);
  // The copy is not recorded, and asks the caller.
  EXPECT_TRUE(copy.advance(5.01, p.probe()));
  p.world.set_rotation_probe({}).value();
  EXPECT_FALSE(p.world.advance(11.0, p.probe())) << "nobody says how they turn";
  p.world.set_rotation_probe(turning(1.0)).value();
  p.run(12.0);
  const auto recording = p.world.stop_recording().value();
  p.run(14.0);
  Replay replay = Replay::open(recording).value();
  while (!replay.finished()) {
    const auto event = replay.advance();
    ASSERT_TRUE(event) << event.error().message;
  }
  EXPECT_EQ(replay.world().time(), 12.0);
}

TEST_F(FreeFlight, RunGivesWhatALoopGives) {
  std::vector<State> start;
  for (int k = 0; k < 6; ++k) start.push_back({{2.5 * k, 0.2 * (k % 3), 0}, {k % 2 == 0 ? 1.0 : -1.0, 0, 0}});
  EventHash hashes[2];
  for (EventHash& hash : hashes) {
    Ballistic motion = Ballistic::create({.start = start}).value();
    World world = World::create({.contacts = ContactEvents::impacts}).value();
    BodyMap bodies;
    for (std::uint32_t k = 0; k < start.size(); ++k)
      bodies.add_rigid_body(world, motion, k, dumbbell({}, {}, {0, 0.5, 1.0 * k})).value();
    if (&hash == hashes) {
      auto source = bodies.source();
      Workers workers = Workers::create(2).value();
      world
          .run(
              20, source, [](const Event& event) { return response_of(event, bounce(event, 1.0)); },
              [&](const Event& event) { hash.add(event); }, &workers)
          .value();
      continue;
    }
    while (const auto event = world.advance(20, bodies.probe()).value()) {
      hash.add(*event);
      const Bounce after = bounce(*event, 1.0);
      bodies.set_velocity(world, event->first, after.first_velocity).value();
      bodies.set_velocity(world, event->second, after.second_velocity).value();
      if (event->first_spin_gain != Vec3{})
        world.change(event->first, {.angular_velocity = after.first_angular_velocity}).value();
      if (event->second_spin_gain != Vec3{})
        world.change(event->second, {.angular_velocity = after.second_angular_velocity}).value();
    }
  }
  EXPECT_EQ(hashes[0].value(), hashes[1].value());
}

TEST(RigidBodyErrors, NameTheCulprit) {
  World world = World::create({}).value();
  const auto refused = [&](RigidBody body, ErrorCode code, const std::string& argument) {
    expect_error(world.add_rigid_body(body), code, argument, "add_rigid_body");
    EXPECT_EQ(world.size(), 0u);
  };
  const double nan = std::nan("");
  RigidBody body = dumbbell({});
  body.parts.clear();
  refused(body, ErrorCode::out_of_range, "parts");
  body = dumbbell({});
  body.parts[1].b.y = nan;
  refused(body, ErrorCode::not_finite, "parts");
  body.parts[1] = {.radius = -1};
  refused(body, ErrorCode::out_of_range, "parts");
  body = dumbbell({});
  body.rotation.orientation = {1, 1, 0, 0};
  refused(body, ErrorCode::out_of_range, "rotation");
  body.rotation.orientation = {nan, 1, 0, 0};
  refused(body, ErrorCode::not_finite, "rotation");
  body = dumbbell({}, {}, {0, 0, 4});
  body.largest_angular_speed = 3;
  refused(body, ErrorCode::out_of_range, "rotation");
  body = dumbbell({});
  body.angular_acceleration_limit = 1;
  refused(body, ErrorCode::out_of_range, "largest_angular_speed");
  body.angular_acceleration_limit = -1;
  refused(body, ErrorCode::out_of_range, "angular_acceleration_limit");
  body = dumbbell({});
  body.inertia.y = -1;
  refused(body, ErrorCode::out_of_range, "inertia");
}

TEST(RigidBodyErrors, NeedARotationProbeThatAnswers) {
  World world = World::create({}).value();
  RigidBody body = dumbbell({});
  body.angular_acceleration_limit = 1;
  body.largest_angular_speed = 5;
  const BodyId id = world.add_rigid_body(body).value();
  // So near that reports must tell whether they touch.
  const BodyId near = world.add({.radius = 1, .position = {0, 1.3, 0}}).value();
  const Probe probe = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = State{ids[k] == near ? Vec3{0, 1.3, 0} : Vec3{}};
  };
  expect_error(world.advance(1000.0, probe), ErrorCode::null_probe, "rotation_probe", "advance", id);
  world.set_rotation_probe([](auto, double, auto) {}).value();
  expect_error(world.advance(1000.0, probe), ErrorCode::not_finite, "rotation", "advance", id);
  bool turns_too_fast = true;
  world
      .set_rotation_probe([&](std::span<const BodyId>, double, std::span<Rotation> rotations) {
        rotations[0] = turns_too_fast ? Rotation{.angular_velocity = {0, 0, 6}} : Rotation{};
      })
      .value();
  const auto event = world.advance(1000.0, probe).value();
  ASSERT_TRUE(event && event->kind == EventKind::bound_violation);
  EXPECT_GT(event->velocity_excess, 1.0);
  // A world goes on after a broken promise, and so does a copy of it.
  EXPECT_TRUE(World::restore(world.save().value()));
  expect_error(world.change(id, {.angular_velocity = Vec3{0, 0, 9}}), ErrorCode::out_of_range,
               "angular_velocity", "change", id);
  expect_error(world.change(id, {.radius = 1.0}), ErrorCode::unsupported, "body", "change", id);
  expect_error(world.sleep(id), ErrorCode::unsupported, "body", "sleep", id);
  const BodyId ball = world.add({.position = {9, 9, 9}}).value();
  expect_error(world.change(ball, {.angular_velocity = Vec3{}}), ErrorCode::unsupported, "body", "change",
               ball);
  EXPECT_FALSE(world.body(ball)->rigid);
}

/// Flies towards a partner, a wall or a shape. Returns the first contact.
std::optional<Event> first_contact(std::uint64_t seed, bool has_errors) {
  constexpr double error = 0.1;
  Random random(seed);
  Playground p({.box = Box{{-6, -6, -6}, {6, 6, 6}}, .contact_tolerance = 1e-9});
  const auto wider = [&](double radius, double by) { return has_errors ? radius : radius + by; };
  const auto course = [&](const Vec3& position, const Vec3& velocity) {
    return BodyDefinition{.radius = wider(0.4, error),
                          .position_error = has_errors ? error : 0.0,
                          .position = position,
                          .velocity = velocity};
  };
  const auto rigid = [&](const BodyDefinition& body, double by) {
    RigidBody made{.body = body, .rotation = {rotation_by(random.unit_vector()), 3.0 * random.unit_vector()}};
    made.parts = {{{-0.5, 0, 0}, {0.5, 0.1, 0}, wider(0.1, by)}, {{0, 0.3, 0}, {0, 0.3, 0}, wider(0.3, by)}};
    made.parts.push_back(box_part({{-0.2, -0.2, 0.2}, {0.1, 0.2, 0.6}}, wider(0.05, by)));
    p.add_rigid_body(made);
  };
  // A moving shape without an error is not wider instead: the other body is.
  const bool is_moving_shape = seed % 5 == 4;
  rigid(course({}, {1, 0.1, 0.2 * random.uniform()}), is_moving_shape ? 2.0 * error : error);
  const BodyDefinition partner = course({3, 0, 0}, {-1, 0, 0});
  const Box box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  if (seed % 5 == 0) rigid(partner, error);
  if (seed % 5 == 1) p.add(partner);
  if (seed % 5 == 2) p.world.add_static({.shape = Box{{3, -1, -1}, {4, 1, 1}}}).value();
  if (is_moving_shape) {
    const BodyId id = p.world.add_moving_shape({partner, box}).value();
    p.start_course(id, partner);
  }
  return p.advance(20.0);
}

TEST(RigidBodies, PositionErrorsCountAsRadiusOfTheirParts) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const auto with_error = first_contact(seed, true);
    const auto with_radius = first_contact(seed, false);
    ASSERT_TRUE(with_error && with_radius);
    EXPECT_EQ(with_error->second, with_radius->second);
    EXPECT_EQ(with_error->first_part, with_radius->first_part);
    EXPECT_EQ(with_error->second_part, with_radius->second_part);
    EXPECT_NEAR(with_error->time, with_radius->time, 1e-6);
    EXPECT_NEAR(with_error->gap, 0.0, 2e-9);
    EXPECT_LT(norm(with_error->normal - with_radius->normal), 1e-5);
    EXPECT_LT(norm(with_error->point - with_radius->point), seed % 5 == 4 ? 0.101 : 1e-5);
  }
}

/// Parts and carried shapes may be as much nearer as their positions are wrong: contacts come early, never
/// late, and time goes on.
TEST(RigidBodies, CountPositionErrors) {
  constexpr double error = 1e-3;
  const RigidPart rod{{0, -1, 0}, {0, 1, 0}, 0.5};
  const Vec3 far{3, 0, 0};
  const auto meeting = [&](auto add_partner, double nominal) {
    Playground p({.box = Box{{-9, -9, -9}, {9, 9, 9}}, .contact_tolerance = eps, .separation_distance = 0.1});
    p.add_rigid_body(
        {.body = {.position_error = error, .position = -far, .velocity = {1, 0, 0}}, .parts = {rod}});
    add_partner(p);
    const auto begins = of_kind(p.run(5.5), EventKind::contact_begin);
    ASSERT_EQ(begins.size(), 1u);
    EXPECT_NEAR(begins[0].time, nominal, eps);
    EXPECT_LE(begins[0].gap, eps);
  };
  const BodyDefinition at_rest{.radius = 0.5, .position_error = 2.0 * error, .position = far};
  meeting([&](Playground& p) { p.add(at_rest); }, 5.0 - 3.0 * error);
  const std::vector<RigidPart> box{box_part({{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}}, 0.1)};
  meeting([&](Playground& p) { p.add_rigid_body({.body = at_rest, .parts = box}); }, 5.0 - 3.0 * error);
  meeting(
      [&](Playground& p) {
        const BodyId id =
            p.world.add_moving_shape({at_rest, Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}}).value();
        p.start_course(id, at_rest);
      },
      5.0 - 3.0 * error);
  meeting([&](Playground& p) { p.world.add_static({.shape = Ball{far, 0.5}}).value(); }, 5.0 - error);
  Playground p({.box = Box{{-9, -9, -9}, {9, 9, 9}}, .contact_tolerance = eps});
  p.add_rigid_body({.body = {.position_error = error, .velocity = {1, 0, 0}}, .parts = {rod}});
  const auto walls = of_kind(p.run(8.6), EventKind::wall_begin);
  ASSERT_EQ(walls.size(), 1u);
  EXPECT_NEAR(walls[0].time, 8.5 - error, eps);
}

/// For answers without a probe, which know the rotation of the last report alone.
TEST(RigidBodies, AreTheBallsAroundThemFromAChangeToTheNextReport) {
  const double half_pi = 1.5707963267948966;
  for (const bool at_once : {true, false}) {
    SCOPED_TRACE(at_once);
    Playground p;
    const BodyId rod =
        p.add_rigid_body({.body = {.acceleration_limit = 1}, .parts = {{{-2, 0, 0}, {2, 0, 0}, 0.1}}});
    const BodyId ball = p.add({.radius = 0.1, .position = {0, 1.5, 0}});
    p.run(0.01);
    ASSERT_LT(p.world.body(rod)->bound.time, 0.01);
    if (at_once)
      p.world.change(rod, {.rotation = Rotation{rotation_by({0, 0, half_pi})}}).value();
    else
      p.world.change(rod, {.angular_velocity = Vec3{0, 0, half_pi}}).value();
    const World& world = p.world;
    const double meets = world.certificates().earliest_contact(rod).value().time;
    const DistanceLimits limits = world.certificates().distance_limits(rod, ball, world.time()).value();
    const auto event = p.advance(2.0);
    ASSERT_TRUE(event);
    EXPECT_LE(meets, event->time);
    if (at_once) {
      EXPECT_EQ(event->time, 0.01);
      EXPECT_LE(limits.lower, 0.0);
    } else {
      EXPECT_NEAR(event->time, 0.88, 0.08);
      EXPECT_GE(limits.upper, 1.3);
    }
  }
}

/// A rod and a ball beside it. The last report of the rod is older than the change.
struct ChangedRod {
  explicit ChangedRod(const BodyChange& change) {
    p.run(1.0);
    EXPECT_LT(p.world.body(rod)->bound.time, 1.0);
    p.world.change(rod, change).value();
  }
  void expect_met_by(double time) {
    const auto known = p.world.certificates();
    EXPECT_LE(known.safe_until()->time, time);
    EXPECT_LE(known.safe_until(ball)->time, time);
    EXPECT_LE(known.safe_until(rod, ball)->time, time);
    EXPECT_LE(known.safe_until(rod, ball, 0.0)->time, time);
    EXPECT_LE(known.earliest_approach(ball, 0.0)->time, time);
    EXPECT_LE(known.distance_limits(rod, ball, time)->lower, 0.0);
    EXPECT_NEAR(p.world.certificates(p.probe()).safe_until(rod, ball)->time, time, 1e-4);
  }

  Playground p{WorldDefinition{.contact_tolerance = eps}};
  const BodyId rod = p.add_rigid_body({.parts = {{{-1, 0, 0}, {1, 0, 0}, 0.1}}});
  const BodyId ball = p.add({.radius = 0.1, .position = {0, 1, 0}});
};

TEST(RigidBodies, AnswersCountARotationThatHasChanged) {
  ChangedRod(BodyChange{.angular_velocity = Vec3{0, 0, 1}}).expect_met_by(1.0 + std::acos(0.2));
  ChangedRod(BodyChange{.rotation = Rotation{rotation_by({0, 0, 1.5})}}).expect_met_by(1.0);
}

/// The positions are nearest in one image, and the parts in another.
TEST(RigidBodies, AreAsFarApartAsInTheImageWhereTheirPartsAreNearest) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {true, true, true}});
  const auto beside = [](double place, double arm) {
    return RigidBody{.body = {.position = {place, 5, 5}}, .parts = {{{arm, 0, 0}, {arm, 0, 0}, 0.05}}};
  };
  const BodyId one = p.add_rigid_body(beside(0.0, -1.8));
  const BodyId other = p.add_rigid_body(beside(4.5, 1.8));
  const auto limits = p.world.certificates().distance_limits(one, other, 0.0).value();
  EXPECT_NEAR(limits.lower, 1.8, 1e-12);
  EXPECT_NEAR(limits.upper, 1.8, 1e-12);
}

TEST(RigidBodies, EndContactsAsTheyAreTurnedByThen) {
  Playground p;
  p.world.set_sensor(3, {.distances = {5.0}}).value();
  p.add_rigid_body({.parts = {{{-1, 0, 0}, {1, 0, 0}, 0.1}}, .rotation = {.angular_velocity = {0, 0, 1}}});
  const BodyId ball = p.add({.radius = 0.1, .position = {0, 1.5, 0}, .sensor_class = 3});
  p.run(1.0);
  p.world.remove(ball).value();
  const auto event = p.advance(1.0);
  ASSERT_TRUE(event && event->kind == EventKind::sensor_leave);
  const Vec3 tip{std::cos(1.0), std::sin(1.0), 0};
  EXPECT_NEAR(event->gap, point_to_segment({0, 1.5, 0}, {-tip, tip, 0.0}) - 0.2, 1e-12);
}

/// The limits that a body gets with a new angular velocity hold from then on, also for the Zeno interval.
TEST(RigidBodies, TakeNewLimitsWithANewAngularVelocity) {
  for (const bool at_once : {false, true}) {
    Playground p({.box = Box{{-50, -50, 0}, {50, 50, 4}}});
    // Under its first limit a hop within the tolerance takes 4 s.
    const BodyId ball =
        p.add_rigid_body({.body = {.acceleration_limit = 1e-6, .position = {0, 0, 2}, .velocity = {0, 0, 3}},
                          .parts = {{{}, {}, 1.0}}});
    p.run(0.1);
    BodyChange limits{.motion_limits = MotionLimits{.acceleration_limit = 100.0}};
    if (at_once) limits.angular_velocity = Vec3{0, 0, 1e-3};
    p.world.change(ball, limits).value();
    std::size_t contacts = 0;
    p.run(3.0, [&](const Event& event) {
      if (event.kind != EventKind::wall_begin) return;
      ++contacts;
      EXPECT_FALSE(event.repeated) << event;
      p.set_velocity(ball, bounce(event, 1.0).first_velocity);
    });
    EXPECT_GE(contacts, 3u);
  }
}

TEST(RigidBodies, LieOnAFloorThoughTheBallAroundThemReachesBelow) {
  World world = World::create({.box = Box{{-5, -5, 0}, {5, 5, 9}}, .allow_overlap = false}).value();
  const RigidBody plank{.body = {.position = {0, 0, 0.25}}, .parts = {{{-2, 0, 0}, {2, 0, 0}, 0.25}}};
  const BodyId id = world.add_rigid_body(plank).value();
  expect_error(world.change(id, {.rotation = Rotation{rotation_by({0, 1, 0})}}), ErrorCode::outside_domain,
               "parts", "change", id);
  world.change(id, {.rotation = Rotation{rotation_by({0, 0, 1})}}).value();
  RigidBody deep = plank;
  deep.body.position.z = 0.1;
  expect_error(world.add_rigid_body(deep), ErrorCode::outside_domain, "parts", "add_rigid_body");
  // Another one beside it: the balls around the two overlap, their parts do not.
  RigidBody next = plank;
  next.rotation.orientation = rotation_by({0, 0, 1});
  next.body.position.y = 1.5;
  EXPECT_TRUE(world.add_rigid_body(next));
  next.body.position.y = 0.2;
  expect_error(world.add_rigid_body(next), ErrorCode::overlapping, "position", "add_rigid_body", id);
}

/// Nobody knows how a body has turned that may turn otherwise than it has said: no overlap is certain.
TEST(RigidBodies, OfUnknownRotationMayBeTeleported) {
  World world = World::create({.allow_overlap = false}).value();
  const BodyId rod =
      world
          .add_rigid_body({.body = {.position = {-50.0, 0.0, 0.0}},
                           .parts = {{.a = {-2.0, 0.0, 0.0}, .b = {2.0, 0.0, 0.0}, .radius = 0.1}},
                           .angular_acceleration_limit = 1.0,
                           .largest_angular_speed = 10.0})
          .value();
  world.add({.radius = 0.5, .position = {1.5, 0.0, 0.0}}).value();
  const auto rotations = [](std::span<const BodyId> ids, double time, std::span<Rotation> given) {
    for (std::size_t k = 0; k < ids.size(); ++k)
      given[k] = {rotation_by({0.0, 0.0, 0.5 * time * time}), {0.0, 0.0, time}};
  };
  world.set_rotation_probe(rotations).value();
  const Probe probe = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k)
      states[k] = {ids[k] == rod ? Vec3{-50.0, 0.0, 0.0} : Vec3{1.5, 0.0, 0.0}, {}};
  };
  EXPECT_EQ(world.teleport(rod, {}).error().code, ErrorCode::overlapping);
  EXPECT_FALSE(world.advance(1.7, probe).value());
  world.teleport(rod, {}).value();
  EXPECT_EQ(world.time(), 1.7);
}

}  // namespace
}  // namespace kinesphere::rigid_bodies_test
