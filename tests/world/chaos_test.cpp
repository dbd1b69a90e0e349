// Random calls on random worlds of all scales of length and time: a restored snapshot continues like the
// original, and the audit finds nothing, since no caller violates a limit.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "kinesphere/kinesphere.hpp"

namespace kinesphere::chaos_test {
namespace {

/// The range of worlds that a seed may make.
struct Scales {
  double least_time, largest_time;      ///< powers of ten of the unit of time
  double least_start, largest_start;    ///< powers of ten of the start, in units of time; none below -2
  double least_length, largest_length;  ///< powers of ten of the unit of length
};
constexpr Scales ordinary{0.0, 0.0, -3.0, -3.0, 0.0, 0.0};
constexpr Scales all{-25.0, 25.0, -3.0, 25.0, -8.0, 5.0};

class Chaos {
 public:
  Chaos(std::uint64_t seed, const Scales& scales, bool repeats)
      : random_(seed),
        time_(power_of_ten(scales.least_time, scales.largest_time)),
        world_(create(scales, repeats, seed % 2 == 1)) {
    if (random_.bits() % 3 == 0)
      world_.set_sensor(1, {.distances = {0.05 * length_, 0.02 * length_}}).value();
  }

  /// Returns the failure as text; empty if there is none.
  std::string go(int calls) {
    for (int k = 0; k < calls; ++k) {
      call();
      if (k % 4 == 3) check();
      if (!wrong_.empty()) return "call " + std::to_string(k) + ": " + wrong_;
    }
    return wrong_;
  }

 private:
  struct Course {
    double time;
    State state;
    double position_error;
  };

  double power_of_ten(double least, double most) { return std::pow(10.0, random_.uniform(least, most)); }

  World create(const Scales& scales, bool repeats, bool spreads) {
    length_ = power_of_ten(scales.least_length, scales.largest_length);
    WorldDefinition definition;
    definition.spread_window_starts = spreads;
    definition.dimensions = random_.bits() % 4 == 0 ? 2 : 3;
    definition.contact_tolerance = 1e-6 * length_;
    definition.contacts = random_.bits() % 2 == 0 ? ContactEvents::impacts : ContactEvents::begin_and_end;
    if (definition.contacts == ContactEvents::begin_and_end && random_.bits() % 2 == 0)
      definition.separation_distance = 1e-3 * length_;
    const double start = power_of_ten(scales.least_start, scales.largest_start);
    if (start > 1e-2)
      definition.start_time = std::min(1e28, start * time_) * (random_.bits() % 4 == 0 ? -1.0 : 1.0);
    // The corner of the box lies anywhere, or at a place with rounding.
    const double corner = random_.bits() % 3 == 0 ? 0.0 : random_.uniform(-2.0, 2.0);
    const Vec3 lower = Vec3{corner, corner, corner} * length_;
    if (repeats || random_.bits() % 2 == 0) {
      definition.box = Box{lower, lower + Vec3{1, 1, 1} * length_};
      if (definition.dimensions == 2) definition.box->lower.z = definition.box->upper.z = 0.0;
    }
    if (repeats) {
      const auto axes = random_.bits() % 7 + 1;
      definition.periodic = {(axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0 && definition.dimensions == 3};
      if (!definition.periodic.x && !definition.periodic.y && !definition.periodic.z)
        definition.periodic.x = true;
    }
    box_ = {lower, lower + Vec3{1, 1, 1} * length_};
    flat_ = definition.dimensions == 2;
    periodic_ = definition.periodic;
    return World::create(definition).value();
  }

  Vec3 in_plane(Vec3 v) const {
    if (flat_) v.z = 0.0;
    return v;
  }

  /// Returns a place in the box, on its border or, in periodic space, some periods away.
  Vec3 place(double margin) {
    Vec3 position;
    const bool axes[3] = {periodic_.x, periodic_.y, periodic_.z};
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = random_.uniform(box_.lower[axis] + margin, box_.upper[axis] - margin);
      if (!axes[axis]) continue;
      const auto choice = random_.bits() % 8;
      if (choice == 0) position[axis] = box_.lower[axis];
      if (choice == 1) position[axis] = box_.upper[axis];
      if (choice == 2) position[axis] = std::nextafter(box_.upper[axis], box_.lower[axis]);
      if (choice == 3) position[axis] = box_.lower[axis] - 1e-18 * length_;
      if (choice == 4) position[axis] += std::floor(random_.uniform(-4.0, 5.0)) * length_;
    }
    return in_plane(position);
  }
  Vec3 velocity() {
    if (random_.bits() % 5 == 0) return {};
    return in_plane(random_.point_in_ball() * (length_ / time_ * std::pow(10.0, random_.uniform(-2.0, 1.0))));
  }

  State state_at(const Course& course, double time) const {
    return {course.state.position + course.state.velocity * (time - course.time), course.state.velocity};
  }

  auto probe() {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = state_at(courses_.at(ids[k].index), time);
    };
  }

  std::optional<BodyId> any() {
    const auto bodies = world_.bodies();
    if (bodies.empty()) return std::nullopt;
    return bodies[random_.bits() % bodies.size()];
  }
  void depart(BodyId id, const State& state, double error) {
    if (id.index >= courses_.size()) courses_.resize(id.index + 1u);
    courses_[id.index] = {world_.time(), state, error};
  }

  void add() {
    if (world_.size() > 12) return;
    const double radius = length_ * random_.uniform(0.0, 0.1);
    const State state{place(radius), velocity()};
    BodyDefinition body{.radius = radius,
                        .position = state.position,
                        .velocity = state.velocity,
                        .sensor_class = static_cast<SensorClass>(random_.bits() % 2)};
    if (random_.bits() % 3 == 0) body.acceleration_limit = 0.3 * length_ / time_ / time_;
    if (const auto added = world_.add(body)) depart(*added, state, 0.0);
  }
  void add_static() {
    if (world_.size() > 12) return;
    StaticDefinition fixed{.shape = Ball{place(0.1 * length_), length_ * random_.uniform(0.0, 0.1)}};
    if (const auto added = world_.add_static(fixed))
      depart(*added, {std::get<Ball>(fixed.shape).centre, {}}, 0.0);
  }

  void call() {
    const auto id = any();
    const auto what = random_.bits() % 16;
    if (what <= 1 || !id) return add();
    if (what == 2) return add_static();
    if (what == 3) return (void)world_.remove(*id);
    if (what <= 5) {
      const State state{place(0.1 * length_), velocity()};
      if (world_.teleport(*id, state)) depart(*id, state, 0.0);
    } else if (what <= 8) {
      const Vec3 v = velocity();
      const State now = state_at(courses_.at(id->index), world_.time());
      if (world_.set_velocity(*id, v)) depart(*id, {now.position, v}, 0.0);
    } else if (what == 9) {
      MotionLimits limits;
      if (random_.bits() % 2 == 0)
        limits.acceleration_limit = random_.uniform(0.0, 3.0) * length_ / time_ / time_;
      (void)world_.change(*id, {.motion_limits = limits});
    } else if (what == 10) {
      if (world_.sleep(*id)) {
        const State now = state_at(courses_.at(id->index), world_.time());
        depart(*id, {now.position, {}}, 0.0);
      }
    } else if (what == 11) {
      const State state{place(0.1 * length_), velocity()};
      if (world_.disable(*id) && random_.bits() % 2 == 0) {
        if (world_.enable(*id, state)) depart(*id, state, 0.0);
      }
    } else {
      advance();
    }
  }

  void advance() {
    const double until = std::min(1e30, world_.time() + time_ * std::pow(10.0, random_.uniform(-3.0, 1.0)));
    for (int k = 0; k < 20; ++k) {
      std::optional<World> twin;
      if (random_.bits() % 4 == 0) {
        auto restored = World::restore(world_.save().value());
        if (!restored) return fail("refused: " + restored.error().message);
        twin = std::move(*restored);
      }
      const auto event = world_.advance(until, probe());
      if (!event) return fail(event.error().message);
      if (twin) {
        const auto same = twin->advance(until, probe());
        if (!same || same->has_value() != event->has_value() || twin->save().value() != world_.save().value())
          return fail("a restored world goes on in another way");
      }
      if (!*event) return;
      if ((*event)->kind == EventKind::bound_violation && std::abs(world_.time()) < 1e6 * time_)
        return fail("a promise is said to be broken by " + std::to_string((*event)->position_excess));
      if ((*event)->kind == EventKind::contact_begin || (*event)->kind == EventKind::wall_begin)
        bounce_off(**event);
    }
  }

  void bounce_off(const Event& event) {
    const Bounce after = bounce(event, 1.0, 1.0, 0.9);
    const auto turn = [&](BodyId id, const Vec3& v) {
      if (id == no_body || !world_.contains(id)) return;
      const State now = state_at(courses_.at(id.index), world_.time());
      if (world_.set_velocity(id, v)) depart(id, {now.position, v}, 0.0);
    };
    turn(event.first, after.first_velocity);
    turn(event.second, after.second_velocity);
  }

  void check() {
    if (!wrong_.empty()) return;
    const auto snapshot = world_.save().value();
    const auto restored = World::restore(snapshot);
    if (!restored) return fail("refused: " + restored.error().message);
    if (restored->save().value() != snapshot) return fail("another snapshot of the restored world");
    if (const auto finding = world_.inspection().audit())
      fail("audit: " + finding->where + ": " + finding->what);
  }
  void fail(const std::string& what) {
    if (wrong_.empty())
      wrong_ = what + " at time " + std::to_string(world_.time()) + " in units " + std::to_string(time_);
  }

  Random random_;
  double time_;
  double length_ = 1.0;
  Box box_{};
  bool flat_ = false;
  Axes periodic_{};
  World world_;
  std::vector<Course> courses_;
  std::string wrong_;
};

void expect_nothing_wrong(int first_seed, int last_seed, const Scales& scales, bool repeats) {
  int wrong = 0;
  for (int seed = first_seed; seed <= last_seed && wrong < 10; ++seed) {
    const std::string found = Chaos(static_cast<std::uint64_t>(seed), scales, repeats).go(80);
    EXPECT_EQ(found, "") << "seed " << seed;
    wrong += found.empty() ? 0 : 1;
  }
}

TEST(Chaos, PeriodicBoxesOfOrdinaryScale) { expect_nothing_wrong(1, 200, ordinary, true); }

TEST(Chaos, PeriodicBoxesOfAllScales) { expect_nothing_wrong(1, 500, all, true); }

TEST(Chaos, BoxesAndOpenSpaceOfOrdinaryScale) { expect_nothing_wrong(1, 170, ordinary, false); }

TEST(Chaos, BoxesAndOpenSpaceOfAllScales) { expect_nothing_wrong(1, 170, all, false); }

// With the label long: further seeds.
TEST(MoreChaos, PeriodicBoxesOfOrdinaryScale) { expect_nothing_wrong(201, 600, ordinary, true); }

TEST(MoreChaos, PeriodicBoxesOfAllScales) { expect_nothing_wrong(501, 1500, all, true); }

TEST(MoreChaos, BoxesAndOpenSpaceOfOrdinaryScale) { expect_nothing_wrong(171, 500, ordinary, false); }

TEST(MoreChaos, BoxesAndOpenSpaceOfAllScales) { expect_nothing_wrong(171, 500, all, false); }

/// Rounding puts the middle of the box around such a ball on the border, in the next image.
TEST(StaticBall, OnTheBorderOfAPeriodicBoxStaysInItsImage) {
  for (const double y : {0.0, -1e-300, -1e-20, -1e-17, -6e-17, -1e-16}) {
    World world =
        World::create({.box = Box{{-1, -1, -1}, {0, 0, 0}}, .periodic = {true, true, true}}).value();
    const BodyId ball = world.add_static({.shape = Ball{{-0.5, y, -0.5}, 0.1}}).value();
    (void)world.add({.radius = 0.05, .position = {-0.5, -0.8, -0.5}, .velocity = {0, -0.1, 0}}).value();
    const auto probe = [](std::span<const BodyId>, double time, std::span<State> states) {
      for (State& state : states) state = {{-0.5, -0.8 - 0.1 * time, -0.5}, {0, -0.1, 0}};
    };
    EXPECT_TRUE(World::restore(world.save().value()));
    const auto event = world.advance(10.0, probe).value();
    ASSERT_TRUE(event && event->kind == EventKind::contact_begin) << y;
    EXPECT_NEAR(event->time, 0.5, 1e-5);
    EXPECT_EQ(world.inspection().audit(), std::nullopt) << y;
    EXPECT_TRUE(World::restore(world.save().value())) << y;
    EXPECT_EQ(world.body(ball)->definition.position, std::get<Ball>(world.body(ball).value().shape).centre);
  }
}

TEST(FlatBox, OfAnySizeIsTaken) {
  EXPECT_TRUE(
      World::create({.box = Box{{0, 0, 0}, {1e-8, 1e-8, 0}}, .dimensions = 2, .contact_tolerance = 1e-14}));
}

}  // namespace
}  // namespace kinesphere::chaos_test
