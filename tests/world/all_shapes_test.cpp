// Random worlds of bodies of all shapes, whose contacts are answered in all ways, against gaps by other
// formulas than the library's: nothing sinks deeper than the tolerance unless a Zeno guard says so, no
// contact is invented, and time goes on.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "number/infinity.hpp"
#include "support/placed_parts.hpp"
#include "support/playground.hpp"
#include "support/test_size.hpp"
#include "support/true_shapes.hpp"

namespace kinesphere {
namespace {

using placed_parts::PlacedPart;
using true_hulls::Hull;

enum class Answer { none, bounce, settle };

struct Kind {
  std::uint64_t seed;
  double eps;
  Answer answer;
  bool has_gravity;
  bool is_exact = true;  ///< accelerations and turns are as planned
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) {
  const char* const answers[] = {"no answer", "bounce", "settle"};
  return out << "tolerance " << kind.eps << ", " << answers[static_cast<int>(kind.answer)]
             << (kind.has_gravity ? ", gravity" : "") << (kind.is_exact ? "" : ", steered") << ", seed "
             << kind.seed;
}

/// A body as it truly is.
struct Thing {
  std::vector<RigidPart> parts{};  ///< at least one, unless it has a shape
  std::vector<Hull> hulls{};
  std::optional<Shape> shape{};
  std::optional<true_shapes::CarriedHulls> carried{};  ///< of a shape that moves
  bool is_static = false;
  bool is_rigid = false;
  bool has_mass = true;

  double since = 0.0;
  State state{};
  Vec3 acceleration{}, plan{};
  Quaternion orientation{};
  Vec3 spin{};
  double radius_rate = 0.0;  ///< of a ball
  double ball_radius = 0.0;

  State state_at(double time) const {
    const double s = time - since;
    return {state.position + (state.velocity + acceleration * (0.5 * s)) * s,
            state.velocity + acceleration * s};
  }
  Rotation rotation_at(double time) const {
    return {after(rotation_by(spin * (time - since)), orientation), spin};
  }
  void restart(double time) {
    const Rotation turned = rotation_at(time);
    state = state_at(time);
    orientation = turned.orientation;
    ball_radius = std::max(0.0, ball_radius + radius_rate * (time - since));
    since = time;
  }
  std::vector<PlacedPart> placed(double time) const {
    std::vector<PlacedPart> found;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      RigidPart part = parts[k];
      if (!is_rigid) part.radius = std::max(0.0, ball_radius + radius_rate * (time - since));
      found.emplace_back(part, hulls[k], state_at(time).position, rotation_at(time).orientation);
    }
    return found;
  }
  double least_radius() const {
    double least = infinity;
    for (const RigidPart& part : parts) least = std::min(least, is_rigid ? part.radius : ball_radius);
    return parts.empty() ? 0.0 : least;
  }
};

class AllShapes : public testing::TestWithParam<Kind> {
 protected:
  using Pair = std::pair<BodyId, BodyId>;

  AllShapes()
      : kind(GetParam()),
        random(kind.seed),
        world(World::create({.contact_tolerance = kind.eps,
                             .contacts = random.bits() % 2 == 0 ? ContactEvents::impacts
                                                                : ContactEvents::begin_and_end})
                  .value()) {
    if (!kind.is_exact) world.set_rotation_probe(rotation_probe()).value();
    add_static(HalfSpace{{0, 0, 1}, -1.0});
    for (const double side : {-1.0, 1.0}) {
      add_static(HalfSpace{{side, 0, 0}, -1.8});
      add_static(HalfSpace{{0, side, 0}, -1.8});
    }
    if (!kind.has_gravity) add_static(HalfSpace{{0, 0, -1}, -3.0});
    for (std::size_t k = random.bits() % 3; k > 0; --k) add_static(any_shape());
    for (std::size_t k = 2 + random.bits() % 5; k > 0; --k) come();
    for (std::size_t k = random.bits() % 4; k > 0; --k) add_moving_shape();
  }

  double some(double lower, double upper) { return lower + (upper - lower) * random.uniform(); }
  Vec3 place() { return {some(-1.2, 1.2), some(-1.2, 1.2), some(-0.3, 2)}; }

  Shape any_shape() {
    const Vec3 at{some(-1.5, 1.5), some(-1.5, 1.5), some(-1, 0.5)};
    switch (random.bits() % 3) {
      case 0:
        return Box{at, at + Vec3{some(0.05, 1), some(0.05, 1), some(0.05, 1)}};
      case 1:
        return perhaps_folded({at, at + Vec3{some(0.3, 2), some(-0.5, 0.5), some(-0.5, 0.5)},
                               at + Vec3{some(-0.5, 0.5), some(0.3, 2), some(-0.5, 0.5)}});
      default:
        return Ball{at, some(0.0, 0.6)};
    }
  }

  /// In every other world, a mesh of four triangles instead, whose inner corners stand out to either side.
  Shape perhaps_folded(const Triangle& t) const {
    if (kind.seed % 2 == 0) return t;
    const Vec3 out = 0.15 * cross(t.b - t.a, t.c - t.a);
    const std::array vertices{
        t.a, t.b, t.c, 0.5 * (t.a + t.b) + out, 0.5 * (t.b + t.c) - out, 0.5 * (t.c + t.a)};
    constexpr std::array<std::array<std::uint32_t, 3>, 4> corners{
        {{0, 3, 5}, {3, 1, 4}, {4, 5, 2}, {3, 4, 5}}};
    return Mesh::create(vertices, corners).value();
  }

  /// Needles and sharp hulls, too.
  double any_radius() {
    switch (random.bits() % 4) {
      case 0:
        return kind.answer == Answer::none ? 0.0 : 3.0 * kind.eps;
      case 1:
        return 0.002 + 3.0 * kind.eps;
      default:
        return some(0.02, 0.3);
    }
  }

  RigidPart any_part(double size) {
    const double radius = any_radius();
    const auto length = [&] { return size * some(0.05, 0.6); };
    switch (random.bits() % 5) {
      case 0: {
        const Vec3 at = size * random.point_in_ball();
        return {at, at, radius};
      }
      case 1:
        return {size * random.point_in_ball(), size * random.point_in_ball(), radius};
      case 2: {
        const Vec3 half{length(), length(), length()};
        return box_part({-half, half}, radius);
      }
      case 3: {
        const Vec3 half{length(), length(), 0.0};
        return box_part({-half, half}, radius);
      }
      default: {
        std::vector<Vec3> points;
        for (std::size_t k = 3 + random.bits() % 5; k > 0; --k)
          points.push_back(size * random.point_in_ball());
        return hull_part(points, radius);
      }
    }
  }

  BodyDefinition any_body() {
    BodyDefinition body;
    body.acceleration_limit = kind.is_exact ? 0.0 : 1.0;
    body.position = place();
    body.velocity = 2.0 * random.point_in_ball();
    if (kind.has_gravity) body.planned_acceleration = {0, 0, -10};
    body.mass = some(0.5, 3);
    return body;
  }

  void note(BodyId id, Thing thing, const BodyDefinition& body) {
    thing.state = {body.position, body.velocity};
    thing.plan = thing.acceleration = body.planned_acceleration;
    for (const RigidPart& part : thing.parts) thing.hulls.emplace_back(placed_parts::points_of(part));
    things.emplace(id, std::move(thing));
  }

  void come() {
    BodyDefinition body = any_body();
    if (random.bits() % 4 == 0) {
      body.radius = any_radius();
      if (random.bits() % 3 == 0) body.radius_rate = some(-0.2, 0.05);
      const BodyId id = world.add(body).value();
      note(id,
           {.parts = {RigidPart{.radius = body.radius}},
            .radius_rate = body.radius_rate,
            .ball_radius = body.radius},
           body);
      return;
    }
    std::vector<RigidPart> parts;
    for (std::size_t k = random.bits() % 2 == 0 ? 1 : 2 + random.bits() % 2; k > 0; --k)
      parts.push_back(any_part(0.7));
    Thing thing{.parts = parts,
                .is_rigid = true,
                .orientation = rotation_by(3.0 * random.point_in_ball()),
                .spin = 4.0 * random.point_in_ball()};
    const RigidBody rigid{.body = body,
                          .parts = parts,
                          .rotation = {thing.orientation, thing.spin},
                          .angular_acceleration_limit = kind.is_exact ? 0.0 : 0.5,
                          .largest_angular_speed = kind.is_exact ? infinity : most_spin,
                          .inertia = {some(0.05, 0.5), some(0.05, 0.5), some(0.05, 0.5)}};
    note(world.add_rigid_body(rigid).value(), std::move(thing), body);
  }

  void add_static(const Shape& shape) {
    note(world.add_static({.shape = shape}).value(), {.shape = shape, .is_static = true, .has_mass = false},
         {});
  }

  void add_moving_shape() {
    BodyDefinition body = any_body();
    const bool has_mass = random.bits() % 2 == 0;
    if (!has_mass) {
      body.planned_acceleration = {};
      body.mass = infinity;
    }
    body.velocity = 0.5 * random.point_in_ball();
    const Shape shape = random.bits() % 2 == 0
                            ? Shape(Box{{-0.6, -0.4, -0.1}, {0.6, 0.4, 0.1}})
                            : perhaps_folded({{-0.8, -0.5, 0}, {0.8, -0.5, 0.1}, {0, 0.9, -0.1}});
    Thing thing{.shape = shape, .has_mass = has_mass};
    thing.carried.emplace(shape);
    note(world.add_moving_shape({body, shape}).value(), std::move(thing), body);
  }

  RotationProbe rotation_probe() {
    return [this](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
      for (std::size_t k = 0; k < ids.size(); ++k) rotations[k] = things.at(ids[k]).rotation_at(time);
    };
  }
  auto probe() {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = things.at(ids[k]).state_at(time);
    };
  }

  // Brute force.

  /// Lower limits will do beyond `enough`.
  double gap(const Thing& one, const Thing& other, double time, double enough) const {
    if (one.carried && other.shape) {
      const Vec3 origin = other.is_static ? Vec3{} : other.state_at(time).position;
      return one.carried->gap(one.state_at(time).position, *other.shape, origin, enough);
    }
    if (one.shape) return gap(other, one, time, enough);
    double least = infinity;
    for (const PlacedPart& part : one.placed(time)) {
      if (other.shape) {
        const Vec3 origin = other.is_static ? Vec3{} : other.state_at(time).position;
        const double near = placed_parts::distance_of(*other.shape, part.middle - origin) - part.reach;
        if (const auto* ball = std::get_if<Ball>(&*other.shape)) {
          const Hull point{std::vector<Vec3>(1)};
          const PlacedPart solid({.radius = ball->radius}, point, ball->centre, {});
          least = std::min(least, near > enough ? near : gap_of(part, solid, true, enough));
        } else {
          least = std::min(least, near > enough ? near : gap_of(part, *other.shape, origin, true, enough));
        }
        continue;
      }
      for (const PlacedPart& far : other.placed(time)) {
        const double near = norm(part.middle - far.middle) - part.reach - far.reach;
        least = std::min(least, near > enough ? near : gap_of(part, far, true, enough));
      }
    }
    return least;
  }

  /// True if the depth of two can be told from their gap: sharp parts have the gap 0 however deep they
  /// overlap, and two sheets have no thickness.
  bool is_told(const Thing& one, const Thing& other) const {
    const auto is_sheet = [](const Thing& thing) {
      return std::holds_alternative<Triangle>(*thing.shape) || std::holds_alternative<Mesh>(*thing.shape);
    };
    if (one.shape && std::holds_alternative<HalfSpace>(*one.shape)) return true;
    if (other.shape && std::holds_alternative<HalfSpace>(*other.shape)) return true;
    if (one.shape && other.shape) return !is_sheet(one) || !is_sheet(other);
    return one.least_radius() + other.least_radius() > 2.5 * kind.eps;
  }

  template <class Visit>
  void for_each_pair(Visit visit) {
    for (auto one = things.begin(); one != things.end(); ++one)
      for (auto other = std::next(one); other != things.end(); ++other)
        if (!(one->second.is_static && other->second.is_static))
          visit(Pair(one->first, other->first), one->second, other->second);
  }

  /// Pairs that are deeper than the tolerance, but for those that may be.
  void check_depths(double time) {
    for_each_pair([&](const Pair& pair, const Thing& one, const Thing& other) {
      const double now = gap(one, other, time, 8.0 * kind.eps);
      if (now > 6.0 * kind.eps) excused.erase(pair);
      if (excused.contains(pair) || !is_told(one, other)) return;
      EXPECT_GE(now, -kind.eps * (1.0 + 1e-6) - 1e-12) << pair.first << " and " << pair.second << " at "
                                                       << time << ": " << now / kind.eps << " tolerances";
      deepest = std::min(deepest, now / kind.eps);
    });
  }

  void check_begin(const Event& event) {
    const Thing& one = things.at(event.first);
    const Thing& other = things.at(event.second);
    const double now = gap(one, other, event.time, 2.0 * kind.eps);
    EXPECT_LE(now, kind.eps * (1.0 + 1e-6) + 1e-12) << "invented: " << event;
    if (now > -2.0 * kind.eps && is_told(one, other)) {
      EXPECT_NEAR(event.gap, now, 1e-9) << event;
    }
  }

  void answer(const Event& event) {
    if (kind.answer == Answer::none ||
        !(things.at(event.first).has_mass || things.at(event.second).has_mass)) {
      excused.insert({event.first, event.second});
      return;
    }
    const double resting = std::max(0.02, 1.01 * least_resting_speed(kind.eps, 12.0));
    const Bounce after =
        kind.answer == Answer::bounce ? bounce(event, restitution) : settle(event, restitution, resting);
    turn(event.first, event.time, after.first_velocity, after.first_angular_velocity);
    turn(event.second, event.time, after.second_velocity, after.second_angular_velocity);
    // A body that may turn no faster may go on as it came: such a pair is let through.
    if (!kind.is_exact &&
        std::max(norm(after.first_angular_velocity), norm(after.second_angular_velocity)) > 0.99 * most_spin)
      excused.insert({event.first, event.second});
  }
  void turn(BodyId id, double time, const Vec3& velocity, const Vec3& spin) {
    Thing& thing = things.at(id);
    if (!thing.has_mass) return;
    thing.restart(time);
    thing.state.velocity = velocity;
    thing.spin = kind.is_exact ? spin : spin * std::min(1.0, 0.99 * most_spin / norm(spin));
    world.set_velocity(id, velocity).value();
    if (thing.is_rigid) world.change(id, {.angular_velocity = thing.spin}).value();
  }

  static constexpr double most_spin = 12.0;
  Kind kind;
  Random random;
  World world;
  std::map<BodyId, Thing> things;
  std::set<Pair> excused;  ///< pairs that may be deeper than the tolerance until they have separated
  double deepest = 0.0;
  double restitution = 0.5;
};

TEST_P(AllShapes, SinkNoDeeperThanTheToleranceAndTimeGoesOn) {
  restitution = random.bits() % 3 == 0 ? 1.0 : some(0.0, 0.9);
  for_each_pair([&](const Pair& pair, const Thing& one, const Thing& other) {
    if (gap(one, other, 0.0, kind.eps) < 0.0) excused.insert(pair);
  });
  const auto probe = this->probe();
  std::size_t events = 0;
  const double step = 0.05;
  const double end = kind.has_gravity ? 2.5 : 1.5;
  for (double stop = step; stop < end && !HasFailure(); stop += step) {
    for (;;) {
      const auto event = world.advance(stop, probe);
      ASSERT_TRUE(event) << event.error().message;
      if (!*event) break;
      const Event& now = **event;
      ASSERT_NE(now.kind, EventKind::bound_violation) << now;
      if (now.kind == EventKind::zeno_guard) excused.insert({now.first, now.second});
      if (++events % 8 == 0 || now.kind != EventKind::contact_begin) check_depths(now.time);
      if (now.kind == EventKind::contact_begin) {
        check_begin(now);
        if (!excused.contains({now.first, now.second}) &&
            is_told(things.at(now.first), things.at(now.second))) {
          EXPECT_GE(now.gap, -kind.eps * (1.0 + 1e-6)) << now;
          deepest = std::min(deepest, now.gap / kind.eps);
        }
        answer(now);
      }
      if (HasFailure() || events > 4000) return;
    }
    const Counters& counters = world.counters();
    ASSERT_LT(counters.pair_checks + counters.probes, 200000 + 500 * events)
        << "time hardly goes on at " << stop;
    // Times at which the world has no reason to look.
    check_depths(stop);
    if (!kind.is_exact)
      for (auto& [id, thing] : things) {
        if (thing.is_static) continue;
        thing.restart(stop);
        thing.acceleration = thing.plan + 0.99 * random.point_in_ball();
        if (random.bits() % 4 == 0) {
          thing.state.velocity = random.point_in_ball();
          world.set_velocity(id, thing.state.velocity).value();
        }
      }
  }
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  std::uint64_t seed = 0;
  for (const double eps : {1e-3, 1e-4, 1e-6})
    for (const Answer answer : {Answer::none, Answer::bounce, Answer::settle})
      for (const bool has_gravity : {false, true})
        for (const bool is_exact : {true, false})
          for (int k = 0; k < rounds_of(3); ++k) all.push_back({++seed, eps, answer, has_gravity, is_exact});
  return scenes_of_each(all);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AllShapes, testing::ValuesIn(kinds()),
                         [](const auto& of) { return "Seed" + std::to_string(of.param.seed); });

}  // namespace
}  // namespace kinesphere
