// Lees-Edwards boundaries: contacts of balls in all images that slide, against formulas of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/workers.hpp"
#include "number/bit_cast.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::shear_test {
namespace {

using Long = long double;
constexpr double eps = 1e-7;

/// In which image the caller reports its bodies: where they have come on their ways, in the primary box, or
/// in any, another one each time.
enum class Frame { way, primary, any };

struct Kind {
  std::string name;
  Box box;
  int dimensions;
  std::size_t balls;
  double least_radius, largest_radius;
  double shear_rate;
  double duration;
  Frame frame = Frame::way;
  Axes periodic{true, true, true};
  double start_time = 0.0;
};
std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

/// Balls in exact flight on their ways, in the first row of images, which leads through all others.
struct Gas {
  struct Way {
    double since;
    State start;
  };

  explicit Gas(const Kind& its_kind, std::uint64_t seed, ContactEvents contacts = ContactEvents::impacts)
      : kind(its_kind), world(World::create(definition(kind, contacts)).value()) {
    Random random(seed);
    const Vec3 size = kind.box.upper - kind.box.lower;
    while (ids.size() < kind.balls) {
      const double radius = random.uniform(kind.least_radius, kind.largest_radius);
      Vec3 place = kind.box.lower;
      for (int axis = 0; axis < kind.dimensions; ++axis) {
        const double margin = kind.periodic[axis] ? 0.0 : radius;
        place[axis] += random.uniform(margin, size[axis] - margin);
      }
      Vec3 velocity = random.point_in_ball();
      velocity.x += kind.shear_rate * (place.y - kind.box.lower.y);
      if (kind.dimensions == 2) place.z = velocity.z = 0.0;
      ways.push_back({kind.start_time, {place, velocity}});
      radii.push_back(radius);
      bool is_free = true;
      for (std::size_t k = 0; k + 1 < ways.size(); ++k)
        is_free = is_free && gap(k, ways.size() - 1, kind.start_time) > 1e-3;
      if (!is_free) {
        ways.pop_back();
        radii.pop_back();
        continue;
      }
      ids.push_back(world.add({.radius = radius, .position = place, .velocity = velocity}).value());
    }
  }

  static WorldDefinition definition(const Kind& kind, ContactEvents contacts) {
    return {.box = kind.box,
            .periodic = kind.periodic,
            .shear_rate = kind.shear_rate,
            .dimensions = kind.dimensions,
            .contact_tolerance = eps,
            .contacts = contacts,
            .allow_overlap = false,
            .start_time = kind.start_time};
  }

  Long period(int axis) const { return Long(kind.box.upper[axis]) - kind.box.lower[axis]; }
  Long slide(double time) const { return period(1) * kind.shear_rate * (Long(time) - kind.start_time); }
  State state(std::size_t ball, double time) const {
    const auto& [since, start] = ways[ball];
    return {start.position + (time - since) * start.velocity, start.velocity};
  }
  /// How many rows of images up y the caller reports a ball from where its way has led.
  double rows(std::size_t ball, double time) const {
    if (kind.frame == Frame::way) return 0.0;
    const double row =
        std::floor((state(ball, time).position.y - kind.box.lower.y) / static_cast<double>(period(1)));
    if (kind.frame == Frame::primary) return -row;
    return std::floor(7.0 * Random::at(5, ball, bit_cast<std::uint64_t>(time)).uniform()) - 3.0 - row;
  }
  State reported(std::size_t ball, double time) const {
    const double count = rows(ball, time);
    if (count == 0.0) return state(ball, time);
    const auto& [since, start] = ways[ball];
    const Long s = Long(time) - since;
    Long x = start.position.x + s * start.velocity.x + count * slide(time);
    x -= std::floor((x - kind.box.lower.x) / period(0)) * period(0);
    State seen = state(ball, time);
    seen.position.x = static_cast<double>(x);
    seen.position.y += count * static_cast<double>(period(1));
    seen.velocity.x += count * kind.shear_rate * static_cast<double>(period(1));
    return seen;
  }
  Probe probe() const {
    return [this](std::span<const BodyId> bodies, double time, std::span<State> states) {
      for (std::size_t k = 0; k < bodies.size(); ++k) states[k] = reported(bodies[k].index, time);
    };
  }

  /// Returns the gap of two balls in the image in which it is least.
  double gap(std::size_t a, std::size_t b, double time) const {
    const auto at = [time](const Way& way, int axis) {
      return Long(way.start.position[axis]) + (Long(time) - way.since) * way.start.velocity[axis];
    };
    Long way[3];
    for (int axis = 0; axis < 3; ++axis) way[axis] = at(ways[b], axis) - at(ways[a], axis);
    const Long nearest = std::round(way[1] / period(1));
    Long least = std::numeric_limits<Long>::infinity();
    for (const Long row : {nearest - 1, nearest, nearest + 1}) {
      const Long x = std::remainder(way[0] - row * slide(time), period(0)), y = way[1] - row * period(1);
      const Long z = kind.dimensions == 3 && kind.periodic.z ? std::remainder(way[2], period(2)) : way[2];
      least = std::min(least, std::sqrt(x * x + y * y + z * z));
    }
    return static_cast<double>(least) - radii[a] - radii[b];
  }

  /// Returns the first time from now on at which the two overlap in any image, up to `until`: each row is
  /// passed in a span of time, and in this span each image of it.
  double meeting(std::size_t a, std::size_t b, double now, double until) const {
    Long way[3], speed[3];
    for (int axis = 0; axis < 3; ++axis) {
      way[axis] = Long(ways[b].start.position[axis]) - ways[a].start.position[axis] +
                  (Long(now) - ways[b].since) * ways[b].start.velocity[axis] -
                  (Long(now) - ways[a].since) * ways[a].start.velocity[axis];
      speed[axis] = Long(ways[b].start.velocity[axis]) - ways[a].start.velocity[axis];
    }
    const Long reach = Long(radii[a]) + radii[b], all = Long(until) - now;
    Long first = all;
    for_each_pass(way[1], speed[1], reach, period(1), 0, all, [&](Long row, Long from, Long to) {
      const Long x = way[0] - row * slide(now), u = speed[0] - row * kind.shear_rate * period(1);
      for_each_pass(x, u, reach, period(0), from, std::min(to, first),
                    [&](Long column, Long later, Long end) {
                      const auto at_depth = [&](Long layer) {
                        const Long q[3] = {x - column * period(0), way[1] - row * period(1), way[2] - layer};
                        const Long qq = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - reach * reach;
                        const Long qv = q[0] * u + q[1] * speed[1] + q[2] * speed[2];
                        const Long vv = u * u + speed[1] * speed[1] + speed[2] * speed[2];
                        const Long root = qv * qv - vv * qq;
                        if (root < 0 || qv >= 0) return;
                        const Long time = (-qv - std::sqrt(root)) / vv;
                        // Two that touch now have met before.
                        if (time > -1e-9L && time < first) first = std::max(time, Long(0));
                      };
                      if (kind.dimensions == 2 || !kind.periodic.z) return at_depth(0);
                      for_each_pass(way[2], speed[2], reach, period(2), later, end,
                                    [&](Long layer, Long, Long) { at_depth(layer * period(2)); });
                    });
    });
    return first < all ? static_cast<double>(Long(now) + first) : until;
  }
  /// Calls visit(n, from, to) for the spans within [begin, end] in which |x + u t - n period| <= reach.
  template <class Visit>
  static void for_each_pass(Long x, Long u, Long reach, Long period, Long begin, Long end, Visit visit) {
    const Long p = x + u * begin, q = x + u * end;
    const Long first = std::ceil((std::min(p, q) - reach) / period),
               last = std::floor((std::max(p, q) + reach) / period);
    for (Long n = first; n <= last; ++n) {
      Long from = begin, to = end;
      if (u != 0) {
        const Long one = (n * period - reach - x) / u, other = (n * period + reach - x) / u;
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
      }
      if (from <= to) visit(n, from, to);
    }
  }

  /// Gives a ball of an event the velocity that it has in the image in which the event shows it.
  void turn(BodyId body, double time, const State& seen, const Vec3& velocity) {
    const State now = state(body.index, time);
    const double speed = kind.shear_rate * static_cast<double>(period(1));
    const double row = std::round((now.position.y - seen.position.y) / static_cast<double>(period(1)));
    ways[body.index] = {time, {now.position, velocity + Vec3{row * speed, 0, 0}}};
    world.set_velocity(body, reported(body.index, time).velocity).value();
  }
  void answer(const Event& event) {
    const Bounce after = bounce(event, 1.0);
    turn(event.first, event.time, event.first_state, after.first_velocity);
    if (event.second != no_body) turn(event.second, event.time, event.second_state, after.second_velocity);
  }

  /// Gives all balls other velocities at once.
  void push_all(double time, Random& random) {
    std::vector<Vec3> velocities;
    for (std::size_t ball = 0; ball < ids.size(); ++ball) {
      const State now = state(ball, time);
      Vec3 change = 0.05 * random.point_in_ball();
      if (kind.dimensions == 2) change.z = 0.0;
      ways[ball] = {time, {now.position, now.velocity + change}};
      velocities.push_back(reported(ball, time).velocity);
    }
    world.set_velocities(ids, velocities).value();
  }
  /// Gives a ball another velocity, in the row in which its way is.
  void push(std::size_t ball, double time, bool teleports, Random& random) {
    Vec3 change = 0.1 * random.point_in_ball();
    if (kind.dimensions == 2) change.z = 0.0;
    const State now = state(ball, time);
    ways[ball] = {time, {now.position, now.velocity + change}};
    const State given = reported(ball, time);
    if (teleports)
      world.teleport(ids[ball], given).value();
    else
      world.set_velocity(ids[ball], given.velocity).value();
  }

  Kind kind;
  World world;
  std::vector<BodyId> ids{};
  std::vector<Way> ways{};
  std::vector<double> radii{};
};

std::vector<Kind> kinds() {
  const auto box = [](double x, double y, double z) { return Box{{-1, 3, 2}, {-1 + x, 3 + y, 2 + z}}; };
  const auto flat = [](double x, double y) { return Box{{-1, 3, 0}, {-1 + x, 3 + y, 0}}; };
  const Axes no_z{true, true, false};
  return {{"dilute_disks", flat(10, 8), 2, 30, 0.2, 0.4, 1.0, 20.0, Frame::way, no_z},
          {"dense_disks", flat(10, 10), 2, 60, 0.45, 0.5, 2.0, 3.0, Frame::primary, no_z},
          {"backwards", flat(6, 12), 2, 40, 0.1, 0.5, -3.0, 5.0, Frame::any, no_z},
          {"fast", flat(7, 9), 2, 30, 0.3, 0.4, 40.0, 0.3, Frame::any, no_z},
          {"tiny", flat(3, 3), 2, 4, 0.4, 0.54, 2.0, 6.0, Frame::way, no_z},
          {"low", flat(20, 3), 2, 20, 0.3, 0.5, 5.0, 5.0, Frame::primary, no_z},
          {"late", flat(10, 8), 2, 30, 0.2, 0.4, -1.0, 16.0, Frame::way, no_z, 1e4},
          {"spheres", box(6, 5, 4), 3, 60, 0.2, 0.5, 1.0, 5.0},
          {"sizes", box(8, 8, 8), 3, 120, 0.05, 1.2, -2.0, 2.0, Frame::any},
          {"many", box(7, 7, 7), 3, 200, 0.4, 0.5, 0.5, 1.5, Frame::primary},
          {"walls", box(6, 5, 4), 3, 50, 0.2, 0.5, 1.5, 8.0, Frame::any, no_z},
          {"tiny_spheres", box(3, 3, 3), 3, 5, 0.4, 0.54, 3.0, 10.0, Frame::any}};
}

class Shear : public testing::TestWithParam<Kind> {};

/// Of all pairs, the times at which they meet next in any image are computed anew whenever one of the two has
/// turned. No event comes later, nor where two do not touch.
TEST_P(Shear, FindsEachContactInImagesThatSlide) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    Gas gas(GetParam(), seed);
    Random random = Random::at(seed, 1, 1);
    const double until = gas.kind.start_time + gas.kind.duration;
    const std::size_t count = gas.ids.size();
    std::vector<double> meeting(count * count, until);
    const auto look = [&](std::size_t ball, double now) {
      for (std::size_t other = 0; other < count; ++other)
        if (other != ball)
          meeting[ball * count + other] = meeting[other * count + ball] =
              gas.meeting(ball, other, now, until);
    };
    for (std::size_t ball = 0; ball < count; ++ball) look(ball, gas.kind.start_time);
    std::size_t contacts = 0, across = 0;
    for (double last = gas.kind.start_time;;) {
      const auto event = gas.world.advance(until, gas.probe()).value();
      const double now = event ? event->time : until;
      ASSERT_GE(now, last);
      const auto missed = std::min_element(meeting.begin(), meeting.end());
      const auto place = static_cast<std::size_t>(missed - meeting.begin());
      ASSERT_GE(*missed, now - 1e-9 * std::max(1.0, std::abs(now)))
          << place / count << " and " << place % count << " met at " << *missed;
      if (!event) break;
      last = now;
      if (event->kind == EventKind::wall_begin) {
        gas.answer(*event);
        look(event->first.index, now);
        continue;
      }
      ASSERT_EQ(event->kind, EventKind::contact_begin) << *event;
      ASSERT_NEAR(gas.gap(event->first.index, event->second.index, now), event->gap, 0.1 * eps) << *event;
      ASSERT_LE(std::abs(event->gap), eps) << *event;
      const Vec3 box = event->second_state.position;
      across += box.y < gas.kind.box.lower.y || box.y >= gas.kind.box.upper.y ? 1 : 0;
      gas.answer(*event);
      look(event->first.index, now);
      look(event->second.index, now);
      if (++contacts % 7 == 0) {
        const auto ball = static_cast<std::size_t>(random.bits() % count);
        gas.push(ball, now, contacts % 2 == 0, random);
        look(ball, now);
      }
      if (contacts % 60 == 0) {
        gas.push_all(now, random);
        for (std::size_t ball = 0; ball < count; ++ball) look(ball, now);
      }
      if (contacts % 50 == 0) {
        ASSERT_TRUE(is_clean(gas.world)) << contacts;
      }
    }
    EXPECT_TRUE(is_clean(gas.world));
    EXPECT_GT(contacts, 100u);
    EXPECT_GT(across, 10u);
  }
}

/// World::run gives the velocities of a response to the ways of a motion, which lead through all images.
TEST_P(Shear, RunsAlikeOnThreadsAfterSnapshotsAndInReplays) {
  Kind kind = GetParam();
  kind.frame = Frame::way;
  Gas gas(kind, 4);
  const double until = gas.kind.start_time + 0.3 * gas.kind.duration;
  Ballistic motion = Ballistic::create({.start_time = gas.kind.start_time}).value();
  for (const auto& [since, start] : gas.ways) motion.add(since, start).value();
  const World fresh = gas.world.clone().value();
  const ResponseFn respond = [](const Event& event) {
    return event.approach_speed > 0.0 ? response_of(event, bounce(event, 1.0)) : Response{};
  };
  EventHash expected;
  gas.world.start_recording().value();
  while (const auto event = gas.world.advance(until, gas.probe()).value()) {
    expected.add(*event);
    gas.answer(*event);
  }
  const auto recording = gas.world.stop_recording().value();
  EXPECT_TRUE(read_recording(recording));
  for (const int threads : {1, 2}) {
    World world = fresh.clone().value();
    const auto moved = motion.clone();
    SingleMotionSource source(*moved);
    Workers workers = Workers::create(threads).value();
    EventHash found;
    const EventFn sink = [&](const Event& event) { found.add(event); };
    world.run(gas.kind.start_time + 0.1 * gas.kind.duration, source, respond, sink, &workers).value();
    World restored = World::restore(world.save().value()).value();
    EXPECT_EQ(restored.save().value(), world.save().value());
    EXPECT_TRUE(is_clean(restored));
    const auto moved_too = moved->clone();
    SingleMotionSource other(*moved_too);
    world
        .run(
            until, other, respond, [](const Event&) {}, &workers)
        .value();
    restored.run(until, source, respond, sink, &workers).value();
    EXPECT_TRUE(is_clean(restored));
    EXPECT_EQ(found.value(), expected.value());
    EXPECT_EQ(restored.save().value(), world.save().value());
  }
}

/// Queries find what is near in any image, and no body is added where another one is.
TEST_P(Shear, AnswersWhatIsNearInAnyImage) {
  Gas gas(GetParam(), 5);
  Random random(6);
  std::size_t hits = 0, refused = 0;
  for (int part = 0; part < 20; ++part) {
    const double until = gas.kind.start_time + gas.kind.duration * part / 60.0;
    while (const auto event = gas.world.advance(until, gas.probe()).value()) gas.answer(*event);
    // A point of no size is the last ball here, and none of the world.
    Vec3 point = gas.kind.box.lower;
    for (int axis = 0; axis < gas.kind.dimensions; ++axis)
      point[axis] += random.uniform(0.0, static_cast<double>(gas.period(axis)));
    gas.ways.push_back({until, {point, {}}});
    gas.radii.push_back(0.0);
    std::vector<double> gaps;
    for (std::size_t ball = 0; ball < gas.ids.size(); ++ball)
      gaps.push_back(gas.gap(ball, gas.ids.size(), until));
    const double radius = random.uniform(0.0, 1.2) * (part % 5 == 0 ? 5.0 : 1.0);
    auto found = gas.world.queries(gas.probe()).overlapping(point, radius).value();
    for (std::size_t ball = 0; ball < gaps.size(); ++ball) {
      const bool is_hit = std::any_of(found.begin(), found.end(), [&](const OverlapHit& hit) {
        return hit.body == gas.ids[ball] && hit.certainty == Certainty::certainly;
      });
      hits += is_hit ? 1 : 0;
      EXPECT_EQ(is_hit, gaps[ball] < radius) << ball << ": " << gaps[ball] - radius;
    }
    const auto nearest = gas.world.queries(gas.probe()).nearest(point, 3).value();
    std::vector<double> sorted = gaps;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(nearest[k].lower, sorted[k], 1e-9);
      EXPECT_NEAR(gaps[nearest[k].body.index], sorted[k], 1e-9);
    }
    if (sorted[0] > 0.0) {
      const double limit = std::min({0.1 * static_cast<double>(gas.period(0)),
                                     0.1 * static_cast<double>(gas.period(1)), sorted[0] + 1e-3});
      const bool is_inside = gas.kind.dimensions == 2 || gas.kind.periodic.z;
      const auto added = gas.world.add({.radius = limit, .position = point});
      if (is_inside) {
        EXPECT_EQ(static_cast<bool>(added), limit < sorted[0]);
      }
      refused += added ? 0 : 1;
      if (added) gas.world.remove(*added).value();
    }
    gas.ways.pop_back();
    gas.radii.pop_back();
  }
  EXPECT_GT(hits, 10u);
  EXPECT_GT(refused, 0u);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Shear, testing::ValuesIn(kinds()),
                         [](const auto& test) { return test.param.name; });

/// Balls that go through each other, on ways that bend and wind, whose radii change, and which sense others.
struct Crowd {
  struct Ball {
    State start;
    Vec3 plan, swing;  ///< planned acceleration; amplitude of a wave
    double radius, rate, limit;
  };
  static constexpr double frequency = 3.0, distance = 0.2;

  static constexpr Box box{{0, 0, 0}, {9, 8, 7}};

  explicit Crowd(std::uint64_t seed) : world(World::create(definition).value()) {
    Random random(seed);
    world.set_sensor(1, {.distances = {distance}}).value();
    for (std::uint32_t k = 0; k < 60; ++k) {
      Vec3 place;
      for (int axis = 0; axis < 3; ++axis) place[axis] = random.uniform(0.0, box.upper[axis]);
      const Vec3 swing = k % 3 == 0 ? 0.1 * random.point_in_ball() : Vec3{};
      const Vec3 plan = k % 4 == 1 ? Vec3{0, -0.2, 0.1} : Vec3{};
      const double rate = k % 5 == 2 ? random.uniform(-0.02, 0.02) : 0.0;
      balls.push_back({{place, random.point_in_ball()}, plan, swing, random.uniform(0.1, 0.4), rate, 0.0});
      Ball& ball = balls.back();
      ball.limit = 1.01 * frequency * frequency * norm(swing);
      ids.push_back(world
                        .add({.radius = ball.radius,
                              .acceleration_limit = ball.limit,
                              .planned_acceleration = plan,
                              .position = place,
                              .velocity = state(k, 0.0).velocity,
                              .sensor_class = static_cast<SensorClass>(k % 2),
                              .radius_rate = rate})
                        .value());
    }
  }
  State state(std::size_t ball, double t) const {
    const auto& [start, plan, swing, radius, rate, limit] = balls[ball];
    return {start.position + t * start.velocity + (0.5 * t * t) * plan + std::sin(frequency * t) * swing,
            start.velocity + t * plan + (frequency * std::cos(frequency * t)) * swing};
  }
  double gap(std::size_t a, std::size_t b, double t) const {
    const Vec3 way = state(b, t).position - state(a, t).position;
    double least = 1e9;
    for (double row = std::round(way.y / 8.0) - 1.0, k = 0; k < 3; ++row, ++k)
      least = std::min(least, norm({std::remainder(way.x - row * definition.shear_rate * 8.0 * t, 9.0),
                                    way.y - row * 8.0, std::remainder(way.z, 7.0)}));
    const auto radius = [&](std::size_t ball) { return balls[ball].radius + t * balls[ball].rate; };
    return least - radius(a) - radius(b);
  }

  static inline const WorldDefinition definition{
      .box = box, .periodic = {true, true, true}, .shear_rate = -1.5, .contact_tolerance = eps};
  World world;
  std::vector<Ball> balls{};
  std::vector<BodyId> ids{};
};

TEST(ShearedCrowd, TouchesAndSensesAsTheTruthDoes) {
  Crowd crowd(7);
  const Probe probe = [&](std::span<const BodyId> bodies, double time, std::span<State> states) {
    for (std::size_t k = 0; k < bodies.size(); ++k) states[k] = crowd.state(bodies[k].index, time);
  };
  std::size_t contacts = 0, crossings = 0;
  for (int step = 1; step <= 400; ++step) {
    const double until = 0.03 * step;
    while (const auto event = crowd.world.advance(until, probe).value()) {
      ASSERT_NE(event->kind, EventKind::bound_violation) << *event;
      const double gap = crowd.gap(event->first.index, event->second.index, event->time) - event->distance;
      const bool ends = event->kind == EventKind::contact_end || event->kind == EventKind::sensor_leave;
      EXPECT_LE(gap, ends ? 5.1 * eps : 1.1 * eps) << *event;
      if (event->time > 0.0) {
        EXPECT_GE(gap, ends ? 3.9 * eps : -0.1 * eps) << *event;
      }
      (event->kind == EventKind::contact_begin ? contacts : crossings) += ends ? 0 : 1;
    }
    if (step % 20 == 0) {
      ASSERT_TRUE(is_clean(crowd.world)) << until;
    }
    if (step == 200) crowd.world = World::restore(crowd.world.save().value()).value();
    for (const BodyId body : crowd.ids) {
      const auto touching = crowd.world.touching(body).value();
      const auto sensed = crowd.world.sensor_overlaps(body).value();
      for (const BodyId other : crowd.ids) {
        if (other == body) continue;
        const double gap = crowd.gap(body.index, other.index, until);
        const bool touches = std::find(touching.begin(), touching.end(), other) != touching.end();
        const bool senses = std::any_of(sensed.begin(), sensed.end(),
                                        [&](const SensorOverlap& overlap) { return overlap.body == other; });
        EXPECT_TRUE(std::abs(gap) < 6.0 * eps || touches == (gap < 0.0)) << body << other << gap;
        const bool may_sense = body.index % 2 == 1 || other.index % 2 == 1;
        const double more = gap - Crowd::distance;
        EXPECT_TRUE(std::abs(more) < 6.0 * eps || senses == (may_sense && more < 0.0))
            << body << other << gap;
      }
    }
  }
  EXPECT_GT(contacts, 200u);
  EXPECT_GT(crossings, 200u);
}

/// Discs in square wells: those that are in each other's are told to be, also after many have been turned
/// back.
TEST(ShearedCrowd, KeepsPotentialsOfSteps) {
  const Kind kind{"wells",    {{0, 0, 0}, {12, 10, 0}}, 2, 50, 0.4, 0.4, 1.0, 0.0,
                  Frame::way, {true, true, false}};
  Gas gas(kind, 8);
  const double distance = 0.3;
  const StepPotential well =
      StepPotential::create({.distances = {distance}, .energies = {-2.0}}, gas.world.definition()).value();
  gas.world.set_sensor(0, well.sensor()).value();
  Ballistic motion = Ballistic::create({}).value();
  for (const auto& [since, start] : gas.ways) motion.add(since, start).value();
  SingleMotionSource source(motion);
  std::size_t turned = 0, contacts = 0;
  for (int step = 1; step <= 20; ++step) {
    gas.world
        .run(
            0.5 * step, source,
            [&](const Event& event) {
              const Response response = well.respond(event);
              (event.kind == EventKind::contact_begin ? contacts : turned) +=
                  event.kind == EventKind::contact_begin || response.turned_back ? 1 : 0;
              return response;
            },
            [](const Event&) {})
        .value();
    const double now = gas.world.time();
    EXPECT_TRUE(is_clean(gas.world));
    for (std::uint32_t k = 0; k < motion.size(); ++k) gas.ways[k] = {now, motion.state(k, now)};
    for (const BodyId body : gas.ids) {
      const auto sensed = gas.world.sensor_overlaps(body).value();
      for (const BodyId other : gas.ids) {
        if (other == body) continue;
        const double beyond = gas.gap(body.index, other.index, now) - distance;
        const bool is_in = std::any_of(sensed.begin(), sensed.end(),
                                       [&](const SensorOverlap& overlap) { return overlap.body == other; });
        EXPECT_TRUE(std::abs(beyond) < 10.0 * eps || is_in == (beyond < 0.0)) << body << other << beyond;
      }
    }
  }
  EXPECT_GT(turned, 100u);
  EXPECT_GT(contacts, 100u);
}

/// States that the world returns lie in the primary box, and have the velocities of their images.
TEST(ShearedCrowd, ShowsBodiesInThePrimaryBox) {
  WorldDefinition definition{
      .box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {true, true, true}, .shear_rate = 0.5};
  World world = World::create(definition).value();
  const State start{{1, 9, 5}, {1, 2, 0}};
  const BodyId body =
      world.add({.radius = 1.0, .position = start.position, .velocity = start.velocity}).value();
  const Probe probe = [&](std::span<const BodyId>, double time, std::span<State> states) {
    states[0] = {start.position + time * start.velocity, start.velocity};
  };
  for (const double time : {1.0, 4.0, 7.25, 30.0}) {
    ASSERT_FALSE(world.advance(time, probe).value());
    ASSERT_TRUE(world.queries(probe).refresh(std::span(&body, 1)).value());
    const BodyView view = world.body(body).value();
    const double rows = std::floor((9.0 + 2.0 * time) / 10.0);
    EXPECT_NEAR(view.bound.velocity.x, 1.0 - 5.0 * rows, 1e-12);
    EXPECT_NEAR(view.bound.position.y, 9.0 + 2.0 * time - 10.0 * rows, 1e-9);
    EXPECT_EQ(view.image[1], static_cast<std::int64_t>(rows));
    const double x = 1.0 + time - rows * 5.0 * time;
    EXPECT_NEAR(view.bound.position.x, x - 10.0 * std::floor(x / 10.0), 1e-9);
    EXPECT_NEAR(view.bound.position.x + 10.0 * static_cast<double>(view.image[0]) + rows * 5.0 * time,
                1.0 + time, 1e-9);
    EXPECT_GE(view.bound.position.x, 0.0);
  }
  EXPECT_TRUE(is_clean(world));
}

TEST(ShearedCrowd, RefusesWhatItCannotDo) {
  const WorldDefinition good{
      .box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {true, true, true}, .shear_rate = 0.5};
  const auto create = [&](auto change) {
    WorldDefinition definition = good;
    change(definition);
    return World::create(definition);
  };
  const auto out_of_range = ErrorCode::out_of_range;
  const std::string call = "World::create";
  for (const Axes& axes : {Axes{true, false, true}, Axes{false, true, true}, Axes{}})
    expect_error(create([&](auto& world) { world.periodic = axes; }), out_of_range, "shear_rate", call);
  expect_error(create([](auto& world) { world.box.reset(), world.periodic = {}; }), out_of_range,
               "shear_rate", call);
  for (const double rate :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    expect_error(create([&](auto& world) { world.shear_rate = rate; }), ErrorCode::not_finite, "shear_rate",
                 call);
  for (const double rate : {1e100, -1e-200})
    expect_error(create([&](auto& world) { world.shear_rate = rate; }), out_of_range, "shear_rate", call);
  EXPECT_TRUE(create([](auto& world) { world.periodic.z = false; }));

  World world = World::create(good).value();
  const BodyId body = world.add({.radius = 1.0, .position = {5, 5, 5}}).value();
  const BodyId other = world.add({.radius = 1.0, .position = {1, 1, 5}}).value();
  const auto refused = [](const auto& result, const std::string& of) {
    expect_error(result, ErrorCode::unsupported, "shear_rate", of);
  };
  refused(world.add_static({.shape = Ball{{1, 1, 1}, 1.0}}), "add_static");
  refused(world.add_zone(Ball{{1, 1, 1}, 1.0}), "add_zone");
  refused(world.add_rigid_body({.body = {.position = {1, 1, 1}}, .parts = {{.radius = 1.0}}}),
          "add_rigid_body");
  refused(world.sleep(body), "sleep");
  refused(world.queries().ray_cast({}, {1, 0, 0}, 5.0), "ray_cast");
  refused(world.queries().sphere_cast({}, 0.5, {1, 0, 0}, 5.0), "sphere_cast");
  refused(world.certificates().safe_until(), "safe_until");
  refused(world.certificates().safe_until(body), "safe_until");
  refused(world.certificates().safe_until(body, other), "safe_until");
  refused(world.certificates().earliest_contact(body), "earliest_contact");
  refused(world.certificates().earliest_approach(body, 1.0), "earliest_approach");
  refused(world.certificates().distance_limits(body, other, 1.0), "distance_limits");
  refused(GameWorld::create({.world = good}), "GameWorld::create");
  expect_error(world.queries().overlapping(Box{{0, 0, 0}, {1, 11, 1}}), out_of_range, "box", "overlapping");
  EXPECT_EQ(world.queries().overlapping(Box{{4, 4, 4}, {5, 5, 5}}).value().size(), 1u);
}

}  // namespace
}  // namespace kinesphere::shear_test
