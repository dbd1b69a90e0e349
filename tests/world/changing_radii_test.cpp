// Balls whose radii change with time, on random courses compared with exact gaps, and their events, answers
// and errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "kinesphere/certificates.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/placement.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/response.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"
#include "support/test_size.hpp"
#include "world/mapped_world.hpp"

namespace kinesphere::changing_radii_test {
namespace {

using Long = long double;
constexpr double eps = 1e-6;

/// A quadratic course of a coordinate, or a linear one of a radius, from a time on.
struct Piece {
  Long since = 0, value = 0, speed = 0, acceleration = 0;

  Long at(Long time) const {
    const Long s = time - since;
    return value + (speed + acceleration * s / 2) * s;
  }
  Long speed_at(Long time) const { return speed + acceleration * (time - since); }
};

/// All pieces of a course, by time.
class Course {
 public:
  /// Replaces what was to come from `time` on.
  void turn(Long time, Long value, Long speed, Long acceleration) {
    std::erase_if(pieces_, [=](const Piece& piece) { return piece.since >= time; });
    pieces_.push_back({time, value, speed, acceleration});
  }
  const Piece& piece(Long time) const {
    auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), time,
                                  [](Long t, const Piece& piece) { return t < piece.since; });
    return *std::prev(after);
  }
  Long at(Long time) const { return piece(time).at(time); }
  Long speed_at(Long time) const { return piece(time).speed_at(time); }

 private:
  std::vector<Piece> pieces_;
};

struct Scene {
  bool walls;
  bool periodic;
  double acceleration_limit;
  double velocity_error;
  std::uint64_t seed;
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) {
  return out << (scene.walls      ? "walls"
                 : scene.periodic ? "periodic"
                                  : "open")
             << ", acceleration limit " << scene.acceleration_limit << ", velocity error "
             << scene.velocity_error << ", seed " << scene.seed;
}

/// Balls that nothing turns, in a cube with edges of 4; they pass through each other and through walls.
class GrowingBalls : public testing::TestWithParam<Scene> {
 protected:
  static constexpr double side = 4.0, end = 3.0, interval = 0.25;
  static constexpr std::size_t count = 16;
  static constexpr Long step = 1e-6L;  ///< for differences

  struct Ball {
    BodyId id;
    std::array<Course, 3> position;
    Course radius;
  };

  GrowingBalls() : random(GetParam().seed) {
    WorldDefinition definition{.contact_tolerance = eps};
    if (GetParam().walls || GetParam().periodic) definition.box = Box{{0, 0, 0}, Vec3{1, 1, 1} * side};
    if (GetParam().periodic) definition.periodic = {.x = true, .y = true, .z = true};
    world = std::make_unique<World>(World::create(definition).value());
    for (std::size_t k = 0; k < count; ++k) {
      const BodyDefinition ball{.radius = 0.1 + 0.35 * random.uniform(),
                                .acceleration_limit = GetParam().acceleration_limit,
                                .velocity_error = GetParam().velocity_error,
                                .position = Vec3{1, 1, 1} * (side / 2) + 1.5 * random.point_in_ball(),
                                .velocity = 1.5 * random.point_in_ball(),
                                .radius_rate = k % 4 == 0 ? 0.0 : any_rate()};
      balls.push_back({world->add(ball).value(), {}, {}});
      for (int axis = 0; axis < 3; ++axis)
        balls.back().position[static_cast<std::size_t>(axis)].turn(0, ball.position[axis],
                                                                   ball.velocity[axis], 0);
      change_radius(balls.back(), 0, ball.radius, ball.radius_rate);
    }
    for (double time = 0.0; time < end; time += interval)
      for (Ball& ball : balls) steer(ball, time);
  }

  /// Balls grow little where space repeats, as they have to stay small there.
  double any_rate() { return (GetParam().periodic ? 0.1 : 0.4) * (2.0 * random.uniform() - 1.0); }

  /// Turns the ball back towards the middle, within its acceleration limit.
  void steer(Ball& ball, double time) {
    const Vec3 away = position(ball, time) - Vec3{1, 1, 1} * (side / 2);
    const Vec3 wanted =
        GetParam().acceleration_limit * (0.5 * random.point_in_ball() - 0.5 * away / (1.0 + norm(away)));
    for (int axis = 0; axis < 3; ++axis) {
      Course& course = ball.position[static_cast<std::size_t>(axis)];
      course.turn(time, course.at(time), course.speed_at(time), wanted[axis]);
    }
  }

  void change_radius(Ball& ball, Long time, Long radius, Long rate) {
    ball.radius.turn(time, radius, rate, 0);
    if (rate < 0) ball.radius.turn(time - radius / rate, 0, 0, 0);
  }

  Vec3 position(const Ball& ball, Long time) const {
    return {double(ball.position[0].at(time)), double(ball.position[1].at(time)),
            double(ball.position[2].at(time))};
  }
  Long radius(const Ball& ball, Long time) const { return ball.radius.at(time); }

  /// The true gap of two balls, or of a ball and a wall.
  Long gap(const Ball& a, const Ball& b, Long time) const {
    Long square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Long way = a.position[axis].at(time) - b.position[axis].at(time);
      if (GetParam().periodic) way = std::remainder(way, Long(side));
      square += way * way;
    }
    return std::sqrt(square) - radius(a, time) - radius(b, time);
  }
  Long gap(const Ball& ball, Wall wall, Long time) const {
    const int index = static_cast<int>(wall) - 1;
    const Long at = ball.position[static_cast<std::size_t>(index / 2)].at(time);
    return (index % 2 == 0 ? at : side - at) - radius(ball, time);
  }

  auto probe() {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) {
        const Ball& ball = balls[ids[k].index];
        states[k].position = position(ball, time);
        for (int axis = 0; axis < 3; ++axis)
          states[k].velocity[axis] = double(ball.position[static_cast<std::size_t>(axis)].speed_at(time));
        states[k].velocity += GetParam().velocity_error * random.point_in_ball();
      }
    };
  }

  /// Changes the radius of a ball or its rate, or restores the world, at a time at which some balls have just
  /// reported and others have not.
  void change(Ball& ball) {
    const double now = world->time();
    const double rate = any_rate();
    switch (random.bits() % 8) {
      case 0: {
        const double to = 0.1 + 0.35 * random.uniform();
        world->change(ball.id, {.radius = to}).value();
        return change_radius(ball, now, to, world->body(ball.id)->definition.radius_rate);
      }
      case 1:
        *world = World::restore(world->save().value()).value();
        return;
      default:
        world->change(ball.id, {.radius_rate = rate}).value();
        return change_radius(ball, now, radius(ball, now), rate);
    }
  }

  /// A pair in touch, or apart, from a time on.
  struct Span {
    double since;
    bool touching;
  };
  using Key = std::pair<std::uint32_t, std::uint32_t>;  ///< of two balls, or of a ball and count plus a wall
  Key key_of(const Event& event) const {
    return {event.first.index, event.second == no_body ? static_cast<std::uint32_t>(count) +
                                                             static_cast<std::uint32_t>(event.wall)
                                                       : event.second.index};
  }
  Long gap(const Key& key, Long time) const {
    const Ball& ball = balls[key.first];
    return key.second < count ? gap(ball, balls[key.second], time)
                              : gap(ball, static_cast<Wall>(key.second - count), time);
  }

  /// Expects that the gap stays on its side of a level, by subdivision: no gap changes faster than `fastest`.
  void expect_side(const Key& key, Long from, Long to, bool above, Long level) const {
    const Long fastest = 18;
    const Long middle = (from + to) / 2;
    const Long clear = (gap(key, middle) - level) * (above ? 1 : -1);
    if (clear > fastest * (to - from) / 2) return;
    ASSERT_GT(clear, -1e-9) << key.first << " and " << key.second << " at " << double(middle) << ", gap "
                            << double(gap(key, middle));
    if (to - from < 1e-11L) return;
    expect_side(key, from, middle, above, level);
    if (!testing::Test::HasFatalFailure()) expect_side(key, middle, to, above, level);
  }

  void check_spans(const Key& key, std::vector<Span> spans) const {
    spans.push_back({world->time(), false});
    for (std::size_t k = 0; k + 1 < spans.size() && !HasFatalFailure(); ++k) {
      if (spans[k].since == spans[k + 1].since) continue;
      expect_side(key, spans[k].since, spans[k + 1].since, !spans[k].touching,
                  spans[k].touching ? 5 * eps : -eps);
    }
  }

  void check_answers() {
    const double now = world->time();
    for (const Ball& ball : balls)
      ASSERT_NEAR(world->body(ball.id)->definition.radius, double(radius(ball, now)), 1e-14);
    const double later = now + 0.1 * random.uniform();
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b) {
        const auto limits = world->certificates().distance_limits(balls[a].id, balls[b].id, now).value();
        ASSERT_LE(limits.lower, gap(balls[a], balls[b], now) + 1e-12);
        ASSERT_GE(limits.upper, gap(balls[a], balls[b], now) - 1e-12);
        ASSERT_LE(world->certificates().distance_limits(balls[a].id, balls[b].id, later)->lower,
                  gap(balls[a], balls[b], later) + 1e-12);
      }
    const Vec3 centre = Vec3{1, 1, 1} * (side / 2) + 1.5 * random.point_in_ball();
    std::map<BodyId, Certainty> found;
    for (const OverlapHit& hit : world->queries().overlapping(centre, 0.3).value())
      found[hit.body] = hit.certainty;
    for (const Ball& ball : balls) {
      if (GetParam().periodic) break;
      const bool overlaps = norm(position(ball, now) - centre) <= 0.3 + double(radius(ball, now));
      const auto known = found.find(ball.id);
      ASSERT_TRUE(!overlaps || known != found.end()) << ball.id;
      ASSERT_TRUE(overlaps || known == found.end() || known->second == Certainty::possibly) << ball.id;
    }
  }

  /// True if no course of the pair has a kink near `time`, and its gap none where the centres meet.
  bool is_smooth(const Key& key, Long time) const {
    if (key.second < count && radius(balls[key.first], time) + radius(balls[key.second], time) < 0.05)
      return false;
    const auto turns = [time](const Course& course) {
      return course.piece(time - step).since != course.piece(time + step).since;
    };
    const auto ball_turns = [&](const Ball& ball) {
      return turns(ball.radius) || std::any_of(ball.position.begin(), ball.position.end(), turns);
    };
    return !ball_turns(balls[key.first]) && (key.second >= count || !ball_turns(balls[key.second]));
  }

  /// Compares an event with the exact gap.
  void check_event(const Event& event) const {
    const Key key = key_of(event);
    ASSERT_NEAR(event.gap, double(gap(key, event.time)), 1e-12) << event;
    if (GetParam().velocity_error > 0.0 || !is_smooth(key, event.time)) return;
    const Long closing = (gap(key, event.time - step) - gap(key, event.time + step)) / (2 * step);
    ASSERT_NEAR(event.approach_speed, double(closing), 1e-6) << event;
  }

  /// Notes that a ball may be in or out of touch from now on, as its radius has jumped.
  void cut_spans(std::map<Key, std::vector<Span>>& touching, std::uint32_t ball) const {
    for (auto& [key, spans] : touching)
      if (key.first == ball || key.second == ball) spans.push_back({world->time(), spans.back().touching});
  }

  Random random;
  std::unique_ptr<World> world;
  std::vector<Ball> balls;
};

TEST_P(GrowingBalls, TouchWhenTheirSurfacesMeet) {
  std::map<Key, std::vector<Span>> touching;
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = a + 1; b < count; ++b) touching[{a, b}] = {{0.0, false}};
    for (int wall = 1; GetParam().walls && wall <= 6; ++wall)
      touching[{a, static_cast<std::uint32_t>(count) + static_cast<std::uint32_t>(wall)}] = {{0.0, false}};
  }
  std::size_t begins = 0;
  double changed = -1.0;
  while (world->time() < end && !HasFatalFailure()) {
    const double quiet = world->certificates().safe_until()->time;
    for (const Event& event : world->events(std::min(world->time() + 0.1 * random.uniform(), end), probe())) {
      ASSERT_NE(event.kind, EventKind::bound_violation) << event;
      if (event.kind == EventKind::zeno_guard) continue;
      // A contact that a change of a radius has ended is told as it was before.
      if (event.time != changed) check_event(event);
      const bool is_begin = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
      std::vector<Span>& spans = touching.at(key_of(event));
      ASSERT_EQ(spans.back().touching, !is_begin || event.already_touching) << event;
      ASSERT_TRUE(!is_begin || event.already_touching || event.time >= quiet) << event;
      begins += is_begin && !event.already_touching;
      spans.push_back({event.time, is_begin});
    }
    ASSERT_TRUE(is_clean(*world));
    check_answers();
    const auto ball = static_cast<std::uint32_t>(random.bits() % count);
    change(balls[ball]);
    changed = world->time();
    cut_spans(touching, ball);
  }
  for (const auto& [key, spans] : touching) check_spans(key, spans);
  EXPECT_GT(begins, 0u);
  EXPECT_LT(world->counters().probes, 20000u);
}

INSTANTIATE_TEST_SUITE_P(, GrowingBalls,
                         testing::ValuesIn(scenes_of_each<Scene>(
                             {Scene{false, false, 0.0, 0.0, 1}, Scene{false, false, 2.0, 0.0, 2},
                              Scene{true, false, 0.0, 0.0, 3}, Scene{true, false, 2.0, 0.0, 4},
                              Scene{false, true, 0.0, 0.0, 5}, Scene{false, true, 2.0, 0.0, 6},
                              Scene{true, false, 1.0, 0.01, 7}, Scene{false, true, 1.0, 0.01, 8}})));

TEST(ChangingRadii, AreMetAndLeftWithTheSpeedOfTheirSurfaces) {
  Playground p({.contact_tolerance = 1e-9});
  // Surfaces at -0.5 and 9.5 that close at 1 + 0.5 + 1 + 0.25.
  const BodyId first =
      p.add({.radius = 0.5, .position = {-1, 0, 0}, .velocity = {1, 0, 0}, .radius_rate = 0.5});
  const BodyId second =
      p.add({.radius = 0.5, .position = {10, 0, 0}, .velocity = {-1, 0, 0}, .radius_rate = 0.25});
  const auto event = p.advance(10.0);
  ASSERT_TRUE(event);
  EXPECT_NEAR(event->time, 10.0 / 2.75, 1e-8);
  EXPECT_NEAR(event->approach_speed, 2.75, 1e-12);
  EXPECT_NEAR(p.radius(first), 0.5 + 0.5 * event->time, 1e-15);
  EXPECT_NEAR(event->point.x, p.state(first).position.x + p.radius(first), 1e-8);
  const Bounce after = bounce(*event, 1.0);
  EXPECT_NEAR(after.second_velocity.x - after.first_velocity.x, 2.75 + 0.75, 1e-12)
      << "the surfaces part as fast as they came";
  p.set_velocity(first, after.first_velocity);
  p.set_velocity(second, after.second_velocity);
  const double before = p.world.time();
  const auto end = p.advance(10.0);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->kind, EventKind::contact_end);
  EXPECT_NEAR(end->time, before + 4e-9 / 2.75, 1e-9);
  EXPECT_FALSE(p.advance(40.0));
  // Growth alone brings the next contact: the centres stand 23 apart, both radii grow.
  p.set_velocity(first, {});
  p.set_velocity(second, {});
  const double gap = p.gap(first, second), now = p.world.time();
  const auto again = p.advance(1000.0);
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->time, now + gap / 0.75, 1e-6);
  EXPECT_NEAR(again->approach_speed, 0.75, 1e-12);
}

TEST(ChangingRadii, PushOffAWallAndShrinkToPoints) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}});
  const BodyId ball = p.add({.radius = 1, .position = {3, 5, 5}, .radius_rate = 0.5});
  const auto event = p.advance(20.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->wall, Wall::x_lower);
  EXPECT_NEAR(event->time, 4.0, 1e-6);
  EXPECT_NEAR(event->approach_speed, 0.5, 1e-12);
  const Bounce after = bounce(*event, 1.0);
  EXPECT_NEAR(after.first_velocity.x, 1.0, 1e-12);
  p.set_velocity(ball, after.first_velocity);
  // It is a point at 14, and then meets the wall with its centre.
  p.world.change(ball, {.radius_rate = -0.3}).value();
  p.set_velocity(ball, {0, 0.25, 0});
  const auto events = of_kind(p.run(100.0), EventKind::wall_begin);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].time, 24.0, 1e-5);
  EXPECT_NEAR(events[0].approach_speed, 0.25, 1e-12);
  EXPECT_EQ(p.radius(ball), 0.0);
}

/// What stands still has no report of the time at which a ball that shrinks is near.
TEST(ChangingRadii, MeetWhatHasStoodStillForLong) {
  for (const bool sleeps : {false, true}) {
    SCOPED_TRACE(sleeps ? "sleeping" : "static");
    Playground p({.contact_tolerance = eps});
    if (sleeps)
      p.world.sleep(p.add({.radius = 1.0})).value();
    else
      p.world.add_static({.shape = Ball{{}, 1.0}}).value();
    p.run(100.0);
    p.add({.radius = 1.0, .position = {5, 0, 0}, .velocity = {-1, 0, 0}, .radius_rate = -0.1});
    const auto begins = of_kind(p.run(104.0), EventKind::contact_begin);
    ASSERT_EQ(begins.size(), 1u);
    EXPECT_NEAR(begins[0].time, 100.0 + 3.0 / 0.9, 1e-5);
  }
}

/// A ball of great growth that leaves its promised course by little is told.
TEST(ChangingRadii, HideNoBrokenPromise) {
  for (const bool jumps : {false, true}) {
    Playground p;
    const BodyId ball = p.add({.position = {0, 0, 0}, .radius_rate = 5.0});
    p.add({.position = {20, 0, 0}});
    p.distort = [&](BodyId id, double time, State& state) {
      if (id == ball && time > 0.0) (jumps ? state.velocity : state.position).y += 1e-3;
    };
    const auto event = p.advance(5.0);
    ASSERT_TRUE(event);
    EXPECT_EQ(event->kind, EventKind::bound_violation);
    EXPECT_NEAR(jumps ? event->velocity_excess : event->position_excess, 1e-3, 1e-12);
  }
}

/// A gas of balls that grow and bounce.
struct Gas : MappedWorld<RandomForces> {
  explicit Gas(double rate = 0.02) {
    const Box box{{0, 0, 0}, {8, 8, 8}};
    const Axes everywhere{true, true, true};
    const std::vector<double> radii(200, 0.3);
    RandomForcesDefinition forces{.acceleration_limits = std::vector<double>(200, 0.5), .seed = 9};
    Random random(9);
    for (const Vec3& centre : place_spheres(radii, box, {.periodic = everywhere, .seed = 9}).value())
      forces.start.push_back({centre, random.unit_vector()});
    motion = std::make_unique<RandomForces>(RandomForces::create(forces).value());
    world = World::create({.box = box, .periodic = everywhere}).value();
    ids = bodies.add_all(world, *motion, {.radius = 0.3, .radius_rate = rate}).value();
  }

  std::vector<BodyId> ids;
};

TEST(ChangingRadii, RunTheSameWithThreadsAndFromSnapshots) {
  expect_the_same_with_threads_and_from_snapshots<Gas>(2, 2.0, 200);
}

TEST(ChangingRadii, AreRecorded) {
  Gas gas;
  ASSERT_TRUE(gas.world.start_recording());
  for (int step = 1; step <= 4; ++step) {
    gas.run(0.5 * step);
    gas.world.change(gas.ids[static_cast<std::size_t>(step)], {.radius_rate = -0.1 * step}).value();
  }
  expect_replay(gas.world);
}

/// A body that changes its number, sleeps or is disabled starts anew.
TEST(ChangingRadii, EndWithTheirBody) {
  Playground p;
  const BodyId ball = p.add({.radius = 1, .radius_rate = 0.5});
  p.run(2.0);
  p.world.disable(ball).value();
  p.run(4.0);
  p.world.enable(ball, {}).value();
  EXPECT_EQ(p.radius(ball), 3.0) << "it grows while it is disabled";
  p.world.change(ball, {.motion_limits = MotionLimits{.velocity_error = 0.25}}).value();
  EXPECT_GE(p.world.body(ball)->bound.growth_speed, 0.75);
  EXPECT_NEAR(p.world.body(ball)->bound.growth_speed, 0.75, 1e-15);
  p.world.change(ball, {.radius_rate = 0.0}).value();
  p.run(5.0);
  EXPECT_EQ(p.radius(ball), 3.0);
  EXPECT_EQ(p.world.body(ball)->bound.growth_speed, 0.25);
  EXPECT_EQ(p.world.body(ball)->definition.velocity_error, 0.25);
  EXPECT_TRUE(p.world.sleep(ball));
  p.run(6.0);
  p.world.change(ball, {.radius_rate = 1.0}).value();
  EXPECT_FALSE(p.world.body(ball)->sleeping) << "the change wakes it";
  p.run(7.0);
  EXPECT_EQ(p.radius(ball), 4.0);
  p.world.remove(ball).value();
  const BodyId next = p.add({.radius = 1});
  p.run(8.0);
  EXPECT_EQ(next.index, ball.index);
  EXPECT_EQ(p.radius(next), 1.0);
}

TEST(ChangingRadii, EndContactsWithTheRadiusOfThatTime) {
  Playground p;
  p.world.set_sensor(3, {.distances = {5.0}}).value();
  const BodyId ball = p.add({.radius = 1.0, .position = {0, 0, 0}, .radius_rate = 0.5});
  p.add({.radius = 1.0, .position = {6, 0, 0}, .sensor_class = 3});
  p.run(1.0);
  ASSERT_LT(p.world.body(ball)->bound.time, 1.0);
  p.world.teleport(ball, {{100, 0, 0}, {}}).value();
  const auto event = p.advance(1.0);
  ASSERT_TRUE(event && event->kind == EventKind::sensor_leave);
  EXPECT_NEAR(event->gap, 6.0 - 1.5 - 1.0, 1e-12);
}

TEST(ChangingRadii, AreRefusedWithAReason) {
  World world = World::create({}).value();
  expect_error(world.add({.radius_rate = NAN}), ErrorCode::not_finite, "radius_rate", "add");
  expect_error(world.add({.radius_rate = -1e300}), ErrorCode::out_of_range, "radius_rate", "add");
  expect_error(world.add_rigid_body({.body = {.radius_rate = 1}, .parts = {{.radius = 1}}}),
               ErrorCode::unsupported, "radius_rate", "add_rigid_body");
  expect_error(world.add_moving_shape({{.radius_rate = 1}, Box{{-1, -1, -1}, {1, 1, 1}}}),
               ErrorCode::unsupported, "radius_rate", "add_moving_shape");
  const BodyId rigid = world.add_rigid_body({.parts = {{.radius = 1}}}).value();
  const BodyId floor = world.add_static({.shape = HalfSpace{{0, 0, 1}, -50}}).value();
  const BodyId ball = world.add({.position = {9, 0, 0}, .radius_rate = 1}).value();
  const BodyChange change{.radius_rate = 1.0};
  expect_error(world.change(rigid, change), ErrorCode::unsupported, "body", "change", rigid);
  expect_error(world.change(floor, change), ErrorCode::static_body, "body", "change", floor);
  expect_error(world.change(ball, {.radius_rate = INFINITY}), ErrorCode::not_finite, "radius_rate", "change",
               ball);
  expect_error(world.sleep(ball), ErrorCode::unsupported, "body", "sleep", ball);
}

TEST(ChangingRadii, EndWhereSpaceIsFull) {
  Playground p({.box = Box{{0, 0, 0}, {8, 8, 8}}, .periodic = {.x = true, .y = true, .z = true}});
  const BodyId ball = p.add({.radius = 1, .position = {4, 4, 4}, .radius_rate = 0.1});
  const auto refused = p.world.advance(100.0, p.probe());
  expect_error(refused, ErrorCode::out_of_range, "radius", "advance", ball);
  EXPECT_LE(p.world.time(), 8.0) << "it has 3/8 of the box at 5 and may not reach half of it";
  EXPECT_TRUE(is_clean(p.world));
  // As long as it is too large, nothing else goes wrong.
  p.world.change(ball, {.radius_rate = 0.05}).value();
  const std::vector<std::byte> saved = p.world.save().value();
  EXPECT_EQ(World::restore(saved).value().save().value(), saved);
  p.world.change(ball, {.radius = 1.0, .radius_rate = 0.0}).value();
  EXPECT_FALSE(p.advance(100.0));
}

}  // namespace
}  // namespace kinesphere::changing_radii_test
