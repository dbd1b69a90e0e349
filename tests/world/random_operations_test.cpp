// A long random stream of everything one may do to a world, with a brute-force mirror and an audit at each
// stop.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "support/playground.hpp"

namespace kinesphere {
namespace {

struct Kind {
  ContactMode mode;
  std::uint64_t seed;
  std::size_t bodies;
};

class RandomOperations : public testing::TestWithParam<Kind> {
 protected:
  static constexpr double eps = 1e-5;
  static constexpr double size = 12.0;

  RandomOperations()
      : p({.box = Box{{0, 0, 0}, {size, size, size}},
           .contact_tolerance = eps,
           .contacts = GetParam().mode,
           .start_time = -3.0}),
        random(GetParam().seed) {
    p.distort = [this](BodyId id, double, State&) { EXPECT_TRUE(enabled(id)) << id << " was probed"; };
  }

  void add() {
    const bool heavy = random.uniform() < 0.1;
    const double limit = random.uniform() < 0.3 ? 0.0 : 5.0 * random.uniform();
    const Vec3 plan = random.uniform() < 0.3 ? Vec3{0, 0, -3} : Vec3{};
    BodyDefinition body{
        .radius = heavy ? 1.5 : 0.3 * random.uniform(),
        .acceleration_limit = limit,
        .planned_acceleration = plan,
        .position = {size * random.uniform(), size * random.uniform(), size * random.uniform()},
        .velocity = 4.0 * random.point_in_ball()};
    if (random.uniform() < 0.2) body.velocity = body.planned_acceleration = {};
    const BodyId id = p.add(body, body.planned_acceleration + 0.999 * limit * random.point_in_ball());
    alive.push_back(id);
    added_at[id] = p.world.time();
  }

  void remove() {
    if (alive.size() < 5) return;
    const std::size_t k = random.bits() % alive.size();
    p.world.remove(alive[k]).value();
    removed.insert(alive[k]);
    alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(k));
  }

  void kick() {
    const BodyId id = any();
    if (!enabled(id)) return;
    p.kick(id, 4.0 * random.point_in_ball());
  }

  Vec3 anywhere() { return {size * random.uniform(), size * random.uniform(), size * random.uniform()}; }

  void place(BodyId id, const State& state) {
    p.set_position(id, state.position);
    p.set_velocity(id, state.velocity);
  }

  /// Far away, or near to where it is, so that it may stay in contact.
  void teleport(BodyId id) {
    State state{anywhere(), 4.0 * random.point_in_ball()};
    const Vec3 near = p.state(id).position + 0.01 * random.point_in_ball();
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) inside = inside && near[axis] >= 0.0 && near[axis] <= size;
    if (inside && random.uniform() < 0.5) state.position = near;
    p.world.teleport(id, state).value();
    place(id, state);
    changed_at[id] = p.world.time();
  }

  void resize(BodyId id) {
    p.world.set_radius(id, random.uniform() * (random.uniform() < 0.1 ? 1.5 : 0.4)).value();
    changed_at[id] = p.world.time();
  }

  void promise(BodyId id) {
    const double limit = random.uniform() < 0.3 ? 0.0 : 5.0 * random.uniform();
    const Vec3 plan = random.uniform() < 0.3 ? Vec3{0, 0, -3} : Vec3{};
    p.world.set_promise(id, {.acceleration_limit = limit, .planned_acceleration = plan}).value();
    p.steer(id, plan + 0.999 * limit * random.point_in_ball());
  }

  void turn_off_or_on(BodyId id) {
    changed_at[id] = p.world.time();
    if (enabled(id)) return p.world.disable(id).value();
    const State state{anywhere(), 4.0 * random.point_in_ball()};
    p.world.enable(id, state).value();
    place(id, state);
  }

  void filter(BodyId id) {
    Filter chosen;
    if (random.uniform() < 0.5) {
      chosen.category = 1 + random.bits() % 3;
      chosen.mask = 1 + random.bits() % 3;
      chosen.group = static_cast<std::int32_t>(random.bits() % 3) - 1;
    }
    p.world.set_filter(id, chosen).value();
    changed_at[id] = p.world.time();
  }

  /// The predicate keeps some bodies from touching others of the same parity.
  void haunt(BodyId id) {
    if (haunted.empty()) p.world.set_pair_filter([this](BodyId a, BodyId b) { return meet(a, b); }).value();
    if (!haunted.insert(id).second) haunted.erase(id);
    p.world.refilter(id).value();
    changed_at[id] = p.world.time();
  }
  bool meet(BodyId a, BodyId b) const {
    return (a.index + b.index) % 2 == 1 || (!haunted.contains(a) && !haunted.contains(b));
  }

  void change() {
    const BodyId id = any();
    const double choice = 6.0 * random.uniform();
    if (choice < 1.0) return enabled(id) ? teleport(id) : turn_off_or_on(id);
    if (choice < 2.0) return resize(id);
    if (choice < 3.0) return promise(id);
    if (choice < 4.0) return turn_off_or_on(id);
    choice < 5.0 ? filter(id) : haunt(id);
  }

  bool enabled(BodyId id) const { return p.world.body(id).value().enabled; }
  bool may_touch(BodyId a, BodyId b) const {
    return enabled(a) && enabled(b) && meet(a, b) &&
           passes(p.world.body(a).value().definition.filter, p.world.body(b).value().definition.filter);
  }
  /// The end of a contact that a change at this instant may have ended, so at any gap.
  bool changed_now(BodyId id) const {
    if (removed.contains(id)) return true;
    const auto found = changed_at.find(id);
    return found != changed_at.end() && found->second == p.world.time();
  }

  void steer() {
    const BodyId id = any();
    const BodyDefinition promise = p.world.body(id).value().definition;
    p.steer(id, promise.planned_acceleration + 0.999 * promise.acceleration_limit * random.point_in_ball());
  }

  /// Bodies that have strayed far outside are sent back.
  void send_back() {
    for (const BodyId id : alive) {
      if (!enabled(id)) continue;
      const State state = p.state(id);
      const Vec3 out = state.position - Vec3{0.5, 0.5, 0.5} * size;
      if (norm(out) > 1.5 * size && dot(out, state.velocity) > 0.0) p.kick(id, out * (-0.3));
    }
  }

  BodyId any() { return alive[random.bits() % alive.size()]; }

  void note(const Event& event) {
    ASSERT_EQ(event.time, p.world.time());
    ASSERT_GE(event.time, last_time);
    last_time = event.time;
    ASSERT_NE(event.kind, EventKind::bound_violation) << event;
    const auto pair = std::pair(event.first, event.second);
    const auto wall = std::pair(event.first, event.wall);
    if (GetParam().mode == ContactMode::impacts) {
      ASSERT_TRUE(event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin ||
                  event.kind == EventKind::zeno_guard)
          << event;
      if (event.kind != EventKind::zeno_guard) {
        ASSERT_GT(event.approach_speed, 0.0) << event;
        ASSERT_LE(event.gap, eps);
      }
      return;
    }
    switch (event.kind) {
      case EventKind::contact_begin:
        ASSERT_TRUE(touching.insert(pair).second) << "twice: " << event;
        ASSERT_TRUE(may_touch(event.first, event.second)) << event;
        ASSERT_LE(event.gap, eps);
        break;
      case EventKind::contact_end:
        ASSERT_EQ(touching.erase(pair), 1u) << "without a begin: " << event;
        if (!changed_now(event.first) && !changed_now(event.second)) {
          ASSERT_GE(event.gap, 4 * eps);
          ASSERT_LE(event.gap, 5 * eps);
        }
        break;
      case EventKind::wall_begin:
        ASSERT_TRUE(touching_walls.insert(wall).second) << "twice: " << event;
        break;
      case EventKind::wall_end:
        ASSERT_EQ(touching_walls.erase(wall), 1u) << "without a begin: " << event;
        break;
      default:
        FAIL() << event;
    }
  }

  /// The truth now, with its events told: apart means gap >= -eps, touching means gap <= 5 eps.
  void compare_with_truth() {
    ASSERT_TRUE(is_clean(p.world));
    if (GetParam().mode == ContactMode::impacts) return;
    for (std::size_t a = 0; a < alive.size(); ++a) {
      for (std::size_t b = a + 1; b < alive.size(); ++b) {
        if (!may_touch(alive[a], alive[b])) {
          ASSERT_FALSE(touching.contains(std::minmax(alive[a], alive[b]))) << alive[a] << " " << alive[b];
          continue;
        }
        const double gap = p.gap(alive[a], alive[b]);
        if (touching.contains(std::minmax(alive[a], alive[b]))) {
          ASSERT_LE(gap, 5.001 * eps) << alive[a] << " " << alive[b] << " at " << p.world.time();
        } else {
          ASSERT_GE(gap, -1.001 * eps) << alive[a] << " " << alive[b] << " at " << p.world.time();
        }
      }
      if (!enabled(alive[a])) continue;
      const Vec3 at = p.state(alive[a]).position;
      const double radius = p.radius(alive[a]);
      for (int axis = 0; axis < 3; ++axis) {
        const bool lower = touching_walls.contains({alive[a], static_cast<Wall>(1 + 2 * axis)});
        const bool upper = touching_walls.contains({alive[a], static_cast<Wall>(2 + 2 * axis)});
        const double below = at[axis] - radius;
        const double above = size - at[axis] - radius;
        ASSERT_TRUE(lower ? below <= 5.001 * eps : below >= -1.001 * eps) << alive[a] << " " << below;
        ASSERT_TRUE(upper ? above <= 5.001 * eps : above >= -1.001 * eps) << alive[a] << " " << above;
      }
    }
    for (const auto& [first, second] : touching)
      ASSERT_TRUE(p.world.contains(first) && p.world.contains(second)) << "outlived";
  }

  Playground p;
  Random random;
  std::vector<BodyId> alive;
  std::map<BodyId, double> added_at;
  std::map<BodyId, double> changed_at;  ///< in a way that may end contacts
  std::set<BodyId> haunted;
  std::set<BodyId> removed;
  std::set<std::pair<BodyId, BodyId>> touching;
  std::set<std::pair<BodyId, Wall>> touching_walls;
  double last_time = -3.0;
};

TEST_P(RandomOperations, MirrorAndAuditAgree) {
  for (std::size_t k = 0; k < GetParam().bodies; ++k) add();
  std::size_t events = 0;
  for (int stop = 1; stop <= 60; ++stop) {
    const double until = -3.0 + 0.03 * stop;
    for (;;) {
      if (events % 4 == 0) {
        ASSERT_TRUE(is_clean(p.world));
      }
      const auto event = p.advance(until);
      if (!event) break;
      ASSERT_LT(++events, 100000u);
      ASSERT_NO_FATAL_FAILURE(note(*event)) << "seed " << GetParam().seed;
      const bool begins = event->kind == EventKind::contact_begin || event->kind == EventKind::wall_begin;
      if (begins && random.uniform() < 0.7) {
        // Bounces, as far as both still live.
        const double speed = std::max(0.0, event->approach_speed);
        if (p.world.contains(event->first) && enabled(event->first))
          p.kick(event->first, p.state(event->first).velocity - event->normal * (1.1 * speed));
        if (event->second != no_body && p.world.contains(event->second) && enabled(event->second))
          p.kick(event->second, p.state(event->second).velocity + event->normal * (1.1 * speed));
      } else if (random.uniform() < 0.05) {
        remove();
      } else if (random.uniform() < 0.05) {
        add();
      } else if (random.uniform() < 0.2) {
        kick();
      } else if (random.uniform() < 0.3) {
        change();
      }
    }
    ASSERT_EQ(p.world.time(), until);
    ASSERT_NO_FATAL_FAILURE(compare_with_truth()) << "seed " << GetParam().seed;
    for (int k = 0; k < 8; ++k) {
      if (random.uniform() < 0.5) change();
      const double choice = random.uniform();
      choice < 0.25 ? remove() : choice < 0.5 ? add() : choice < 0.75 ? kick() : steer();
    }
    send_back();
  }
  EXPECT_GT(events, 30u);
  EXPECT_EQ(p.world.size(), alive.size());
}

INSTANTIATE_TEST_SUITE_P(
    Seeds, RandomOperations,
    testing::Values(Kind{ContactMode::begin_and_end, 1, 150}, Kind{ContactMode::begin_and_end, 2, 60},
                    Kind{ContactMode::begin_and_end, 3, 60}, Kind{ContactMode::begin_and_end, 4, 20},
                    Kind{ContactMode::impacts, 5, 120}, Kind{ContactMode::impacts, 6, 60},
                    Kind{ContactMode::impacts, 7, 20}));

}  // namespace
}  // namespace kinesphere
