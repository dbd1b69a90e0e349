// Pairs whose energy changes in steps with their gap: captures, bounces inside, escapes and bonds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::step_potential_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double radius = 0.5;

/// Balls in exact flight, of mass 1 unless `masses` has others.
struct Fluid {
  Fluid(const WorldDefinition& definition, const StepPotential::Definition& its_potential,
        const std::vector<State>& start, const std::vector<double>& masses = {})
      : world(World::create(definition).value()),
        motion(Ballistic::create({.start = start}).value()),
        source(motion),
        potential(StepPotential::create(its_potential, definition).value()),
        bond(StepPotential::create({.distances = {0.3}, .energies = {0.0}, .outside = infinity}, definition)
                 .value()) {
    world.set_sensor(0, potential.sensor()).value();
    for (std::uint32_t k = 0; k < start.size(); ++k) {
      BodyDefinition ball = motion.definition(k, 0.0);
      ball.radius = radius;
      if (!masses.empty()) ball.mass = masses[k];
      world.add(ball).value();
    }
  }

  /// Runs to a time. Returns the events.
  std::vector<Event> run(double until, Workers* workers = nullptr) {
    std::vector<Event> events;
    const auto respond = [&](const Event& event) { return respond_to(event); };
    world
        .run(
            until, source, respond, [&](const Event& event) { events.push_back(event); }, workers)
        .value();
    return events;
  }
  Response respond_to(const Event& event) const {
    if (event.pair_state == bonded) return bond.respond(event);
    return potential.respond(event);
  }

  Vec3 velocity(std::uint32_t ball) const { return motion.state(ball, world.time()).velocity; }
  double kinetic() const {
    double sum = 0.0;
    for (const BodyId id : world.bodies())
      sum += 0.5 * world.body(id).value().definition.mass * norm_squared(velocity(id.index));
    return sum;
  }
  /// Energy of all pairs, by the sensor distances that they are within.
  double potential_energy() const {
    double sum = 0.0;
    for (const BodyId id : world.bodies()) {
      const auto within = world.sensor_overlaps(id).value();
      for (std::size_t k = 0; k < within.size(); ++k) {
        const bool is_last = k + 1 == within.size() || within[k + 1].body != within[k].body;
        if (is_last && id < within[k].body) sum += potential.energy(0.999 * within[k].distance);
      }
    }
    return sum;
  }

  static constexpr std::int32_t bonded = 7;
  World world;
  Ballistic motion;
  SingleMotionSource source;
  StepPotential potential;
  StepPotential bond;
};

StepPotential::Definition square_well(double width, double depth) {
  return {.distances = {width}, .energies = {-depth}};
}

const WorldDefinition open_space{.contacts = ContactEvents::impacts};

std::vector<State> head_on(double gap, double speed) {
  const double half = radius + 0.5 * gap;
  return {{{-half, 0.0, 0.0}, {0.5 * speed, 0.0, 0.0}}, {{half, 0.0, 0.0}, {-0.5 * speed, 0.0, 0.0}}};
}

TEST(StepPotential, SpeedsUpWhoFallsIn) {
  Fluid pair(open_space, square_well(0.5, 1.0), head_on(2.0, 1.0));
  const auto events = pair.run(1.6);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, EventKind::sensor_enter);
  // The reduced mass is 1/2: v^2 grows by 2 * 1 / (1/2) = 4.
  EXPECT_NEAR(2.0 * pair.velocity(0).x, std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(pair.kinetic() + pair.potential_energy(), 0.25, 1e-12);
}

TEST(StepPotential, LetsThoseOutWhoHaveTheEnergy) {
  Fluid pair(open_space, square_well(0.5, 1.0), head_on(2.0, 1.0));
  const auto events = pair.run(10.0);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[1].kind, EventKind::contact_begin);
  EXPECT_EQ(events[2].kind, EventKind::sensor_leave);
  EXPECT_NEAR(pair.velocity(0).x, -0.5, 1e-12);
  EXPECT_TRUE(pair.world.sensor_overlaps(events[0].first).value().empty());
}

/// Two that are inside from the start, too slow to leave.
TEST(StepPotential, TurnsThoseBackWhoHaveNot) {
  Fluid pair(open_space, square_well(0.5, 1.0), head_on(0.2, 1.0));
  const auto events = pair.run(40.0);
  EXPECT_EQ(events.front().kind, EventKind::sensor_enter) << "they are inside from the start";
  std::size_t contacts = 0, turns = 0;
  for (std::size_t k = 1; k < events.size(); ++k) {
    EXPECT_NE(events[k].kind, EventKind::sensor_enter) << "at " << events[k].time;
    contacts += events[k].kind == EventKind::contact_begin;
    turns += events[k].kind == EventKind::sensor_leave;
    EXPECT_EQ(pair.world.sensor_overlaps(events[k].first).value().size(), 1u);
  }
  EXPECT_NEAR(static_cast<double>(contacts), 40.0, 1.0) << "each period is 2 * 0.5 / 1";
  EXPECT_NEAR(static_cast<double>(turns), 40.0, 1.0);
  EXPECT_NEAR(pair.kinetic(), 0.25, 1e-13);
  EXPECT_TRUE(is_clean(pair.world));
}

TEST(StepPotential, RepelsAtAShoulder) {
  const StepPotential::Definition shoulder{.distances = {0.5}, .energies = {1.0}};
  Fluid slow(open_space, shoulder, head_on(2.0, 1.0)), fast(open_space, shoulder, head_on(2.0, 4.0));
  const auto events = slow.run(10.0);
  ASSERT_EQ(events.size(), 1u) << "who is turned back does not leave";
  EXPECT_NEAR(slow.velocity(0).x, -0.5, 1e-13);
  EXPECT_TRUE(slow.world.sensor_overlaps(events[0].first).value().empty());
  EXPECT_EQ(fast.run(10.0).size(), 3u);
  EXPECT_NEAR(fast.velocity(0).x, -2.0, 1e-12);
}

TEST(StepPotential, TakesMassesAndWhatCannotMove) {
  Fluid pair(open_space, square_well(0.5, 1.0), head_on(2.0, 1.0), {1.0, 3.0});
  const double before = pair.kinetic();
  pair.run(1.6);
  EXPECT_NEAR(pair.velocity(0).x + 3.0 * pair.velocity(1).x, 0.5 - 1.5, 1e-12);
  EXPECT_NEAR(pair.kinetic(), before + 1.0, 1e-12);
  Fluid beside_rock(open_space, square_well(0.5, 1.0), {{{-2.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}});
  beside_rock.world.add_static({.shape = Ball{{0.0, 0.0, 0.0}, radius}}).value();
  beside_rock.run(0.7);
  EXPECT_NEAR(beside_rock.velocity(0).x, std::sqrt(3.0), 1e-12);
}

/// A third ball hits one of two on their way back, after a turn at the outer side of a well: they move on.
TEST(StepPotential, TellsAgainOfThoseWhoAreHitOnTheirWayBack) {
  const double gap = 0.5;
  Fluid three(open_space, square_well(gap, 1.0), head_on(0.2, 1.0));
  const auto first = three.run(0.2);
  ASSERT_GE(first.size(), 1u);
  std::size_t leaves = 0;
  const Probe probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = three.motion.state(ids[k].index, time);
  };
  const auto turn = [&](const Event& event, double speed) {
    three.motion.set_velocity(event.first.index, event.time, {-0.5 * speed, 0.0, 0.0}).value();
    three.motion.set_velocity(event.second.index, event.time, {0.5 * speed, 0.0, 0.0}).value();
    three.world
        .set_velocities(std::vector{event.first, event.second},
                        std::vector<Vec3>{{-0.5 * speed, 0.0, 0.0}, {0.5 * speed, 0.0, 0.0}})
        .value();
  };
  std::vector<double> times;
  for (const Event& event : three.world.events(3.0, probe)) {
    if (event.kind == EventKind::contact_begin) turn(event, 1.0);
    if (event.kind != EventKind::sensor_leave) continue;
    times.push_back(event.time);
    ++leaves;
    if (leaves > 3) break;
    turn(event, -1.0);
    three.world.turn_back(event).value();
    // It is hit at the same instant, and the next time a little later.
    if (leaves == 1) turn(event, 1.0);
    if (leaves == 2) {
      EXPECT_EQ(event.time, times[0]) << "they move on at once";
      const double later = event.time + 1e-7;
      EXPECT_FALSE(three.world.advance(later, probe).value());
      Event now = event;
      now.time = later;
      turn(now, 1.0);
    }
    if (leaves == 3) {
      EXPECT_EQ(event.time, times[1] + 1e-7) << "they move on a little later";
      EXPECT_TRUE(is_clean(three.world));
    }
  }
  EXPECT_EQ(leaves, 4u) << "after the third turn they come back, bounce and leave anew";
  EXPECT_GT(times.back(), times[2] + 0.9);
}

/// The fluid by brute force: exact times of all pairs, in a periodic cube.
class BruteForce {
 public:
  BruteForce(const std::vector<State>& start, double width, double well, double depth)
      : states_(start), width_(width), outer_(2.0 * radius + well), depth_(depth) {
    for (std::size_t a = 0; a < states_.size(); ++a)
      for (std::size_t b = a + 1; b < states_.size(); ++b) pairs_.push_back({a, b, norm(way(a, b)) < outer_});
  }

  struct Next {
    double time = infinity;
    std::size_t pair = 0;
    bool is_contact = false;
  };
  /// Advances to the next event and carries it out. Returns the time, the bodies, and whether it is a
  /// contact, whether they come in, and whether they pass.
  std::tuple<double, std::size_t, std::size_t, bool, bool> step() {
    Next next;
    for (std::size_t k = 0; k < pairs_.size(); ++k) look(k, next);
    for (State& state : states_) state.position += state.velocity * next.time;
    time_ += next.time;
    auto& [a, b, inside] = pairs_[next.pair];
    const Vec3 r = way(a, b), normal = r / norm(r);
    const double along = dot(states_[b].velocity - states_[a].velocity, normal);
    const bool comes_in = !next.is_contact && !inside;
    double after = -along;
    if (!next.is_contact) {
      const double square = along * along + (inside ? -4.0 : 4.0) * depth_;
      if (square > 0.0) {
        after = std::copysign(std::sqrt(square), along);
        inside = !inside;
      }
    }
    states_[b].velocity += normal * (0.5 * (after - along));
    states_[a].velocity -= normal * (0.5 * (after - along));
    return {time_, a, b, next.is_contact, comes_in};
  }

 private:
  struct Pair {
    std::size_t a, b;
    bool inside;
  };
  Vec3 way(std::size_t a, std::size_t b) const {
    Vec3 r = states_[b].position - states_[a].position;
    for (int axis = 0; axis < 3; ++axis) r[axis] -= width_ * std::round(r[axis] / width_);
    return r;
  }
  void look(std::size_t k, Next& next) const {
    const auto& [a, b, inside] = pairs_[k];
    const Vec3 v = states_[b].velocity - states_[a].velocity;
    const Vec3 nearest = way(a, b);
    // Images: those beside the nearest one may come first.
    for (int image = 0; image < 27; ++image) {
      const Vec3 r = nearest + Vec3{image % 3 - 1.0, image / 3 % 3 - 1.0, image / 9 - 1.0} * width_;
      const bool is_inside = inside && image == 13;
      const double rv = dot(r, v), vv = norm_squared(v);
      const auto crossing = [&](double distance, bool outwards) {
        const double root = rv * rv - vv * (norm_squared(r) - distance * distance);
        if (root < 0.0) return infinity;
        const double left = norm_squared(r) - distance * distance;
        if (outwards) return rv > 0.0 ? -left / (rv + std::sqrt(root)) : (-rv + std::sqrt(root)) / vv;
        return rv < 0.0 ? left / (-rv + std::sqrt(root)) : infinity;
      };
      const double contact = crossing(2.0 * radius, false);
      if (is_inside && contact > 0.0 && contact < next.time) next = {contact, k, true};
      const double edge = std::max(crossing(outer_, is_inside), 0.0);
      if (edge < next.time && (is_inside || rv < 0.0)) next = {edge, k, false};
    }
  }

  std::vector<State> states_;
  double width_, outer_, depth_, time_ = 0.0;
  std::vector<Pair> pairs_;
};

/// Balls at random in a periodic cube.
struct Crowd {
  std::vector<State> start{};
  WorldDefinition world{};
  double width = 0.0;

  Crowd(std::size_t balls, double packing, double speed, std::uint64_t seed) {
    width =
        std::cbrt(static_cast<double>(balls) * 4.0 / 3.0 * 3.141592653589793 * std::pow(radius, 3) / packing);
    const Box box{{}, {width, width, width}};
    const Axes periodic{true, true, true};
    Random random(seed);
    for (const Vec3& place :
         place_spheres(std::vector<double>(balls, radius), box, {.periodic = periodic, .seed = seed}).value())
      start.push_back({place, random.point_in_ball() * speed});
    world = {.box = box, .periodic = periodic, .contacts = ContactEvents::impacts};
    world.contact_tolerance = 1e-10;
  }
};

TEST(StepPotential, AgreesWithBruteForce) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Crowd crowd(40, 0.15, 2.0, seed);
    const double well = 0.4, depth = 0.7;
    Fluid fluid(crowd.world, square_well(well, depth), crowd.start);
    BruteForce truth(crowd.start, crowd.width, well, depth);
    const auto events = fluid.run(3.0);
    std::size_t compared = 0;
    for (const Event& event : events) {
      if (event.time == 0.0) continue;  // those that are inside from the start
      const auto [time, a, b, is_contact, comes_in] = truth.step();
      ASSERT_NEAR(event.time, time, 1e-6) << "seed " << seed << ", event " << compared;
      ASSERT_EQ(event.first.index, a) << "seed " << seed << ", event " << compared;
      ASSERT_EQ(event.second.index, b);
      ASSERT_EQ(event.kind == EventKind::contact_begin, is_contact);
      ASSERT_EQ(event.kind == EventKind::sensor_enter, comes_in);
      if (++compared == 120) break;
    }
    EXPECT_EQ(compared, 120u) << "seed " << seed;
  }
}

TEST(StepPotential, ConservesEnergyAndMomentum) {
  const Crowd crowd(108, 0.3, 1.5, 5);
  const StepPotential::Definition steps{.distances = {0.1, 0.25, 0.5}, .energies = {0.4, -1.0, -0.3}};
  Fluid fluid(crowd.world, steps, crowd.start);
  fluid.run(0.0);
  const double energy = fluid.kinetic() + fluid.potential_energy();
  Vec3 momentum;
  for (std::uint32_t k = 0; k < 108; ++k) momentum += fluid.velocity(k);
  std::size_t events = 0;
  for (double time = 1.0; time <= 12.0; time += 1.0) {
    events += fluid.run(time).size();
    EXPECT_NEAR(fluid.kinetic() + fluid.potential_energy(), energy, 1e-11) << "at " << time;
    EXPECT_TRUE(is_clean(fluid.world));
  }
  for (std::uint32_t k = 0; k < 108; ++k) momentum -= fluid.velocity(k);
  EXPECT_LT(norm(momentum), 1e-12);
  EXPECT_GT(events, 20000u);
}

TEST(StepPotential, IsTheSameFromSnapshotsWithThreadsAndInReplays) {
  const Crowd crowd(108, 0.3, 1.0, 9);
  const auto hash_of = [](const std::vector<Event>& events) {
    EventHash hash;
    for (const Event& event : events) hash.add(event);
    return hash.value();
  };
  Fluid alone(crowd.world, square_well(0.4, 1.0), crowd.start);
  Fluid threaded(crowd.world, square_well(0.4, 1.0), crowd.start);
  Workers workers = Workers::create(2).value();
  EXPECT_EQ(hash_of(alone.run(1.0)), hash_of(threaded.run(1.0, &workers)));
  // Some have been turned back just now.
  for (double time = 1.0; time < 1.5; time += 0.003) {
    threaded.world = World::restore(threaded.world.save().value()).value();
    EXPECT_EQ(hash_of(alone.run(time)), hash_of(threaded.run(time)));
  }
  alone.world.start_recording().value();
  alone.run(2.0);
  auto replay = Replay::open(alone.world.stop_recording().value()).value();
  while (!replay.finished()) ASSERT_TRUE(replay.advance());
}

/// A chain of beads in which neighbours are bonded, in a well of all: it stays whole.
TEST(StepPotential, BondsHold) {
  constexpr std::uint32_t beads = 16;
  std::vector<State> start;
  Random random(3);
  for (std::uint32_t k = 0; k < beads; ++k) {
    const double along = 1.15 * k;
    start.push_back({{along, 0.0, 0.0}, random.point_in_ball() * 2.0});
  }
  const double width = 30.0;
  WorldDefinition definition{.box = Box{{-5.0, -15.0, -15.0}, {25.0, 15.0, 15.0}},
                             .periodic = {true, true, true}};
  definition.contacts = ContactEvents::impacts;
  Fluid chain(definition, {.distances = {0.3, 0.5}, .energies = {-0.5, -0.5}}, start);
  for (std::uint32_t k = 0; k + 1 < beads; ++k)
    chain.world.set_pair_state(chain.world.bodies()[k], chain.world.bodies()[k + 1], Fluid::bonded).value();
  EXPECT_EQ(chain.world.pair_state(chain.world.bodies()[1], chain.world.bodies()[0]).value(), Fluid::bonded);
  const double energy = chain.kinetic();
  std::size_t turns = 0;
  for (double time = 0.5; time <= 30.0; time += 0.5) {
    for (const Event& event : chain.run(time))
      turns += event.kind == EventKind::sensor_leave && event.pair_state == Fluid::bonded;
    for (std::uint32_t k = 0; k + 1 < beads; ++k) {
      Vec3 r = chain.motion.state(k + 1, time).position - chain.motion.state(k, time).position;
      for (int axis = 0; axis < 3; ++axis) r[axis] -= width * std::round(r[axis] / width);
      ASSERT_LT(norm(r), 1.3 + 1e-5) << "bond " << k << " at " << time;
      ASSERT_GT(norm(r), 1.0 - 1e-5);
    }
  }
  EXPECT_GT(turns, 500u);
  EXPECT_GT(chain.kinetic(), 0.1 * energy);
}

/// Two that whirl about each other at the full length of their bond swing out again before they are back.
/// They come out no farther each time, however often they are hit meanwhile so that they only just part.
TEST(StepPotential, HoldsThoseWhoWhirlAtItsEnd) {
  const WorldDefinition definition{.contacts = ContactEvents::impacts};
  const StepPotential::Definition chain{.distances = {0.5}, .energies = {0.0}, .outside = infinity};
  Fluid pair(definition, chain, {{{0.0, 0.0, 0.0}, {0.0, -1.1, 0.0}}, {{1.49, 0.0, 0.0}, {0.0, 1.1, 0.0}}});
  const auto ids = pair.world.bodies();
  Random random(6);
  const auto gap = [&] {
    const double now = pair.world.time();
    return norm(pair.motion.state(1, now).position - pair.motion.state(0, now).position) - 2.0 * radius;
  };
  // Random speeds of parting, by orders of magnitude: each hit leaves the two as fast about each other.
  const auto hit = [&] {
    const double now = pair.world.time();
    const Vec3 between = pair.motion.state(1, now).position - pair.motion.state(0, now).position;
    const Vec3 along = between / norm(between), across = cross(Vec3{0, 0, 1}, along);
    const double part = std::pow(10.0, random.uniform(-6.0, -1.0));
    for (const std::uint32_t k : {0u, 1u}) {
      const Vec3 velocity = (k == 0 ? -1.0 : 1.0) * (1.1 * across + part * along);
      pair.motion.set_velocity(k, now, velocity).value();
      pair.world.set_velocity(ids[k], velocity).value();
    }
  };
  double most = 0.0;
  std::size_t events = 0;
  const auto respond = [&](const Event& event) { return pair.potential.respond(event); };
  for (int round = 1; round <= 3000; ++round) {
    pair.world
        .run(pair.world.time() + random.uniform(0.0, 0.05), pair.source, respond,
             [&](const Event& event) {
               ++events;
               most = std::max(most, event.gap);
             })
        .value();
    ASSERT_EQ(pair.world.sensor_overlaps(ids[0]).value().size(), 1u) << round;
    ASSERT_LT(gap(), 0.5 + 8e-6) << round;
    hit();
  }
  EXPECT_LT(most, 0.5 + 8e-6);
  EXPECT_GT(events, 5000u);
}

/// Nobody gets to where none can be, however far beyond the distance the two are, as those of a chain at rest
/// may be. For a step of finite height they have been put there.
TEST(StepPotential, TurnsThoseBackWhoAreFarBeyondABond) {
  const auto answer = [](double outside, double gap) {
    Event event{.kind = EventKind::sensor_leave, .first = {0, 0, 1}, .second = {1, 0, 1}};
    event.gap = gap;
    event.distance = 0.5;
    event.normal = {1.0, 0.0, 0.0};
    event.second_state.velocity.x = 2.0;
    event.approach_speed = -2.0;
    return StepPotential::create({.distances = {0.5}, .energies = {0.0}, .outside = outside}, {})
        .value()
        .respond(event);
  };
  for (const double gap : {0.5 + 4e-6, 0.5 + 4e-5, 0.6}) {
    const Response bonded = answer(infinity, gap);
    EXPECT_TRUE(bonded.turned_back) << gap;
    EXPECT_EQ(bonded.first_velocity, (Vec3{2.0, 0.0, 0.0}));
    EXPECT_EQ(bonded.second_velocity, Vec3{});
    EXPECT_EQ(answer(0.5, gap).second_velocity.has_value(), gap < 0.5 + 1e-5) << gap;
  }
}

TEST(StepPotential, RefusesWhatIsNone) {
  using Definition = StepPotential::Definition;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const Definition& definition) {
    return StepPotential::create(definition, {.contact_tolerance = 0.0625}).error().message;
  };
  EXPECT_EQ(refused({}), "StepPotential::create: number of distances must be at least 1, but is 0");
  EXPECT_EQ(refused({.distances = {2.0, 2.0}, .energies = {1.0, 1.0}}),
            "StepPotential::create: distances[1] must be more than 3.25, but is 2");
  EXPECT_EQ(refused({.distances = {0.0}, .energies = {1.0}}),
            "StepPotential::create: distances[0] must be more than 1.25, but is 0");
  EXPECT_EQ(refused({.distances = {nan}, .energies = {1.0}}),
            "StepPotential::create: distances[0] must be finite, but is nan");
  EXPECT_EQ(refused({.distances = {2.0}, .energies = {}}),
            "StepPotential::create: number of energies must be that of distances, 1, but is 0");
  EXPECT_EQ(refused({.distances = {2.0}, .energies = {-infinity}}),
            "StepPotential::create: energies[0] must be more than -infinity, but is -inf");
  EXPECT_EQ(refused({.distances = {2.0}, .energies = {1.0}, .outside = nan}),
            "StepPotential::create: outside must be a number, but is nan");
  EXPECT_EQ(refused({.distances = {2.0}, .energies = {1.0}, .restitution = 2.0}),
            "StepPotential::create: restitution must be at most 1, but is 2");
}

TEST(StepPotential, IsAskedForAtCrossingsOnly) {
  Fluid pair(open_space, square_well(0.5, 1.0), head_on(2.0, 1.0));
  const auto ids = pair.world.bodies();
  EXPECT_EQ(pair.world.turn_back({}).error().message,
            "turn_back: crossing must be a sensor_enter or sensor_leave, but is contact_begin");
  EXPECT_EQ(pair.world.turn_back({.kind = EventKind::sensor_leave, .time = 1.0}).error().message,
            "turn_back: crossing must be of the present time, 0, but is 1");
  EXPECT_EQ(pair.world.turn_back({.kind = EventKind::sensor_leave, .first = ids[0]}).error().code,
            ErrorCode::unknown_body);
  // They are not within that distance, and have never been.
  pair.world.turn_back({.kind = EventKind::sensor_leave, .first = ids[0], .second = ids[1], .distance = 3.0})
      .value();
  EXPECT_TRUE(pair.world.sensor_overlaps(ids[0]).value().empty());
  EXPECT_EQ(pair.world.set_pair_state(ids[0], ids[0], 1).error().message,
            "set_pair_state: second must be another body than first, but is body 0");
  const auto bad_run = [&](const Response& answer) {
    const auto respond = [&](const Event&) { return answer; };
    return pair.world.run(10.0, pair.source, respond, [](const Event&) {}).error().message;
  };
  pair.world.set_sensor(0, {}).value();
  EXPECT_EQ(bad_run({.turned_back = true}),
            "run: respond: turned_back at contact_begin: must be given only at a sensor_enter or a "
            "sensor_leave");
}

/// A response that says so of two whom it has not turned: they have crossed the distance.
TEST(StepPotential, TurnsNobodyWhoMovesOn) {
  Fluid pair(open_space, square_well(0.5, 1.0), head_on(2.0, 1.0));
  std::size_t events = 0;
  const auto lie = [&](const Event& event) -> Response { return {.turned_back = is_of_sensor(event.kind)}; };
  pair.world.run(10.0, pair.source, lie, [&](const Event&) { ++events; }).value();
  EXPECT_EQ(events, 3u) << "they pass through each other";
  EXPECT_TRUE(pair.world.sensor_overlaps(pair.world.bodies()[0]).value().empty());
}

TEST(PairStates, EndWithTheirBodies) {
  Fluid pair(open_space, square_well(0.5, 1.0), head_on(2.0, 1.0));
  const auto ids = pair.world.bodies();
  pair.world.set_pair_state(ids[0], ids[1], -3).value();
  EXPECT_EQ(pair.world.pair_state(ids[0], ids[1]).value(), -3);
  pair.world.remove(ids[0]).value();
  const BodyId again = pair.world.add({.radius = radius, .position = {-2.0, 0.0, 0.0}}).value();
  EXPECT_EQ(again.index, ids[0].index);
  EXPECT_EQ(pair.world.pair_state(again, ids[1]).value(), 0);
  EXPECT_EQ(pair.world.pair_state(ids[0], ids[1]).error().code, ErrorCode::stale_body);
}

}  // namespace
}  // namespace kinesphere::step_potential_test
