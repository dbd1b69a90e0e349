// Simulations that are moved, cloned and rolled back, with bodies of several motions that come and go.
#include "kinesphere/simulation.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <deque>
#include <optional>
#include <type_traits>
#include <vector>

#include "kinesphere/event_hash.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/steered_motion.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/workers.hpp"
#include "motion/still.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::simulation_test {
namespace {

// A struct that holds a map beside its motions would dangle after a move, so it does not compile.
static_assert(!std::is_move_constructible_v<BodyMap> && !std::is_copy_constructible_v<BodyMap>);
static_assert(!std::is_move_assignable_v<BodyMap> && !std::is_copy_assignable_v<BodyMap>);
static_assert(std::is_nothrow_move_constructible_v<Simulation> &&
              std::is_nothrow_move_assignable_v<Simulation>);
static_assert(!std::is_copy_constructible_v<Simulation>);

constexpr double dt = 1.0 / 60.0;

/// A game that moves 60 targets frame by frame and turns them at walls of its own, and fires a bullet in
/// each frame. A bullet that hits is removed; targets that meet bounce.
class Game {
 public:
  Game() : simulation_(World::create({.contact_tolerance = 1e-4}).value()) {
    Random random(40);
    for (int k = 0; k < 60; ++k) {
      positions_.push_back({-9.0 + 3.0 * (k % 6), -9.0 + 3.0 * (k / 6), 0.0});
      velocities_.push_back(6.0 * random.point_in_ball());
      velocities_.back().z = 0.0;
    }
    frames_ = simulation_.add_motion(
        FrameMotion::create({.start = positions_,
                             .velocities = velocities_,
                             .acceleration_limits = std::vector(positions_.size(), 0.1),
                             .interval = dt})
            .value());
    bullets_ = simulation_.add_motion(Ballistic::create({}).value());
    simulation_.add_all(frames_, {.radius = 0.6, .filter = {.category = 1}}).value();
  }

  /// The state of a whole game in one call: of the simulation, and of what this class keeps beside it.
  Game clone() const { return Game(*this, simulation_.clone().value()); }

  /// `aim` is the input of the player in this frame.
  void play_frame(double aim) {
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      positions_[k] += velocities_[k] * dt;
      for (int axis = 0; axis < 2; ++axis)
        if (positions_[k][axis] * velocities_[k][axis] > 0 && std::abs(positions_[k][axis]) > 20)
          velocities_[k][axis] = -velocities_[k][axis];
    }
    FrameMotion& frames = simulation_.motion(frames_);
    simulation_.push(frames_, positions_).value();
    fire(aim);
    for (const Event& event : simulation_.events(frames.latest_time())) {
      hash_.add(event);
      if (event.kind != EventKind::contact_begin) continue;
      if (simulation_.find(event.second)->motion == bullets_) {
        simulation_.remove(event.second).value();
        continue;
      }
      const Bounce after = bounce(event, 1.0, 1.0, 1.0);
      turn(event.first, after.first_velocity);
      turn(event.second, after.second_velocity);
    }
    positions_ = frames.latest();
  }

  std::uint64_t hash() const { return hash_.value(); }
  std::uint64_t hits() const { return simulation_.world().counters().count(EventKind::contact_begin); }
  std::vector<std::byte> bytes() const { return simulation_.world().save().value(); }

 private:
  Game(const Game& from, Simulation simulation)
      : simulation_(std::move(simulation)),
        frames_(from.frames_),
        bullets_(from.bullets_),
        positions_(from.positions_),
        velocities_(from.velocities_),
        flying_(from.flying_),
        hash_(from.hash_) {}

  void fire(double aim) {
    const double now = simulation_.world().time();
    const std::uint32_t number =
        simulation_.motion(bullets_).add(now, {{-30, 10.0 * aim, 0}, {300, 0, 0}}).value();
    flying_.push_back(
        simulation_.add(bullets_, number, {.radius = 0.02, .filter = {.category = 2, .mask = 1}}).value());
    if (flying_.size() <= 12) return;
    if (simulation_.find(flying_.front())) simulation_.remove(flying_.front()).value();
    flying_.pop_front();
  }
  void turn(BodyId body, const Vec3& velocity) {
    simulation_.set_velocity(body, velocity).value();
    velocities_[simulation_.find(body)->number] = velocity;
  }

  Simulation simulation_;
  MotionId<FrameMotion> frames_;
  MotionId<Ballistic> bullets_;
  std::vector<Vec3> positions_, velocities_;  ///< by number in frames_
  std::deque<BodyId> flying_;
  EventHash hash_;
};

double aim_in(int frame) { return std::sin(0.7 * frame); }

TEST(Simulation, RollsBackEightFramesInEachFrameToTheSameEnd) {
  constexpr int frames = 120, delay = 8;
  Game in_time;
  for (int frame = 0; frame < frames; ++frame) in_time.play_frame(aim_in(frame));
  EXPECT_GT(in_time.hits(), 100u);

  Game game;
  std::deque<Game> past;  // before each of the last frames
  for (int frame = 0; frame < frames + delay; ++frame) {
    // The input of the player arrives late: its frame is played again, and those after it by a guess.
    const int known = frame - delay;
    if (known >= 0) {
      game = std::move(past.front());
      past.clear();
    }
    for (int again = known >= 0 ? known : frame; again <= frame && again < frames; ++again) {
      if (again > known) past.push_back(game.clone());
      game.play_frame(again <= known ? aim_in(again) : 1.0);
    }
  }
  EXPECT_EQ(game.hash(), in_time.hash());
  EXPECT_EQ(game.bytes(), in_time.bytes());
}

TEST(Simulation, KeepsItsMotionsThroughMovesAndOutlivesItsOriginal) {
  const auto made = [] {
    Simulation simulation(World::create({}).value());
    const auto ships = simulation.add_motion(
        SteeredMotion::create({.start = {{}, {{10, 0, 0}, {}}}, .acceleration_limits = {2, 2}}).value());
    simulation.add_all(ships, {.radius = 1}).value();
    return simulation;
  };
  const MotionId<SteeredMotion> ships{0};
  std::vector<Simulation> all;
  for (int k = 0; k < 20; ++k) all.push_back(made());  // moves those before it to another place
  Simulation last = std::move(all.front());
  const Simulation copy = last.clone().value();
  const BodyId body = last.body_of(ships, 1).value();
  last.set_velocity(body, {-1, 0, 0}).value();
  last.motion(ships).steer(0, 0.0, {2, 0, 0}).value();
  all.clear();
  EXPECT_EQ(last.motion(ships).state(1, 1.0).position, (Vec3{9, 0, 0}));
  EXPECT_EQ(copy.motion(ships).state(1, 1.0).position, (Vec3{10, 0, 0})) << "clones are independent";

  std::optional<Simulation> original(copy.clone().value());
  original = std::move(last);
  Simulation heir = original->clone().value();
  original.reset();
  EXPECT_EQ(heir.state(body, 1.0).position, (Vec3{9, 0, 0}));
  const auto event = heir.advance(10.0).value();
  ASSERT_TRUE(event);
  EXPECT_NEAR(event->time, (std::sqrt(33.0) - 1.0) / 2.0, 1e-5) << "t^2 + t = 8";
}

TEST(Simulation, KnowsBodiesByTheirNumbers) {
  Simulation simulation(World::create({}).value());
  const auto bullets = simulation.add_motion(Ballistic::create({}).value());
  const auto still = simulation.add_motion(Still());
  const BodyId post = simulation.add(still, 0).value();
  EXPECT_EQ(simulation.find(post)->motion, still);
  EXPECT_FALSE(simulation.body_of(bullets, 0));
  const std::uint32_t number = simulation.motion(bullets).add(0.0, {{9, 0, 0}, {}}).value();
  const BodyId bullet = simulation.add(bullets, number).value();
  EXPECT_EQ(simulation.body_of(bullets, number), bullet);
  EXPECT_EQ(simulation.clone()->body_of(bullets, number), bullet);
  simulation.remove(bullet).value();
  EXPECT_FALSE(simulation.body_of(bullets, number));
  EXPECT_FALSE(simulation.find(bullet));
}

TEST(Simulation, RunsAsItsWorldDoes) {
  Simulation simulation(World::create({.box = Box{{0, 0, 0}, {9, 9, 9}}}).value());
  const auto balls =
      simulation.add_motion(Ballistic::create({.start = {{{2, 2, 2}, {3, 1, 0}}, {{6, 6, 2}, {}}}}).value());
  simulation.add_all(balls, std::vector{0.5, 0.7}).value();
  Simulation other = simulation.clone().value();
  const auto response = [](const Event& event) -> Response {
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return {};
    const Bounce after = bounce(event, 1, 1, 1);
    if (event.second == no_body) return {after.first_velocity, {}};
    return {after.first_velocity, after.second_velocity};
  };
  EventHash run, looped;
  simulation.run(20.0, response, [&](const Event& event) { run.add(event); }).value();
  for (const Event& event : other.events(20.0)) {
    looped.add(event);
    const Response given = response(event);
    if (given.first_velocity) other.set_velocity(event.first, *given.first_velocity).value();
    if (given.second_velocity) other.set_velocity(event.second, *given.second_velocity).value();
  }
  EXPECT_EQ(run.value(), looped.value());
}

/// Bodies under random forces, of which one in four vanishes at a contact, and others come in their places.
/// Returns the hash of the events. The forces depend on the numbers in the motion.
std::uint64_t hash_of_comings_and_goings(int threads) {
  constexpr int side = 10;
  Simulation simulation(World::create({.box = Box{{0, 0, 0}, {20, 20, 20}}}).value());
  Random random(5);
  RandomForcesDefinition forces{.interval = 0.1, .seed = 3};
  for (int k = 0; k < side * side * side; ++k) {
    forces.start.push_back({Vec3{1.0 + 2 * (k % side), 1.0 + 2 * (k / side % side), 1.0 + 2 * (k / 100)},
                            4.0 * random.point_in_ball()});
    forces.acceleration_limits.push_back(10.0);
  }
  const auto crowd = simulation.add_motion(RandomForces::create(forces).value());
  simulation.add_all(crowd, {.radius = 0.5}).value();
  const auto respond = [](const Event& event) -> Response {
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return {};
    Random dice(std::bit_cast<std::uint64_t>(event.time));
    (void)dice.bits();
    Response response = response_of(event, bounce(event, 1.0));
    if (dice.bits() % 4 == 0) response.first_action = BodyAction::remove;
    response.stop = event.kind == EventKind::wall_begin && dice.bits() % 16 == 0;
    return response;
  };
  EventHash hash;
  int added = 0;
  const auto sink = [&](const Event& event) {
    hash.add(event);
    if (!respond(event).stop || added >= 60) return;
    for (int k = 0; k < 3; ++k, ++added) {
      const State state{{4.0 + 0.2 * added, 10.0, 10.0}, {}};
      simulation.add(crowd, simulation.motion(crowd).add(event.time, state, 10.0).value(), {.radius = 0.1})
          .value();
    }
  };
  Workers workers = Workers::create(threads).value();
  simulation.run(3.0, respond, sink, &workers).value();
  EXPECT_GT(added, 5);
  EXPECT_GT(simulation.world().size(), 100u);
  // At the first stop, fewer may be gone than the three that come.
  EXPECT_LT(simulation.motion(crowd).size(), 1000u + 3u) << "new bodies have the places of old ones";
  return hash.value();
}

TEST(Simulation, ForgetsRemovedBodiesInTheOrderOfEvents) {
  const std::uint64_t hash = hash_of_comings_and_goings(1);
  for (const int threads : {2, 3}) EXPECT_EQ(hash_of_comings_and_goings(threads), hash);
}

/// A motion whose author has forgotten that it needs a clone of its own.
class Forgetful final : public PiecewiseMotion {
 public:
  Forgetful() : PiecewiseMotion({}) {}
};

TEST(Simulation, SaysWhatIsWrong) {
  Simulation simulation(World::create({}).value());
  const auto still = simulation.add_motion(Still());
  const BodyId post = simulation.add(still, 0).value();
  const BodyId stranger = simulation.world().add({.position = {5, 0, 0}}).value();
  expect_error(simulation.set_velocity(stranger, {}), ErrorCode::unknown_body, "body",
               "BodyMap::set_velocity: ", stranger);
  expect_error(simulation.add(MotionId<>{1}, 0), ErrorCode::out_of_range, "motion", "Simulation::add: ");
  const auto thrown_by = [](const auto& call) -> Result<void> {
    try {
      call();
    } catch (const BadResult& bad) {
      return bad.error();
    }
    return {};
  };
  expect_error(thrown_by([&] { (void)simulation.motion(MotionId<Ballistic>{0}); }), ErrorCode::out_of_range,
               "motion", "Simulation::motion: ");
  expect_error(thrown_by([&] { (void)simulation.body_of(MotionId<>{7}, 0); }), ErrorCode::out_of_range,
               "motion", "Simulation::body_of: ");
  simulation.add_motion(Forgetful());
  expect_error(simulation.clone(), ErrorCode::unsupported, "motion", "Simulation::clone: motion 1 ");

  const Simulation taken = std::move(simulation);
  EXPECT_TRUE(taken.find(post));
  // NOLINTBEGIN(bugprone-use-after-move): that is what is tested.
  const auto refused = [](const auto& result, const std::string& call) {
    expect_error(result, ErrorCode::moved_from, "simulation", "Simulation::" + call + ": ");
  };
  refused(simulation.clone(), "clone");
  refused(simulation.add(still, 0), "add");
  refused(simulation.add_all(still), "add_all");
  refused(simulation.add_all(still, std::vector{1.0}), "add_all");
  refused(simulation.set_velocity(post, {}), "set_velocity");
  refused(simulation.teleport(post, {}), "teleport");
  refused(simulation.remove(post), "remove");
  refused(simulation.push({0}, {}), "push");
  refused(simulation.advance(1.0), "advance");
  refused(simulation.run(
              1.0, [](const Event&) -> Response { return {}; }, [](const Event&) {}),
          "run");
  refused(thrown_by([&] { (void)simulation.events(1.0); }), "events");
  refused(thrown_by([&] { (void)simulation.probe(); }), "probe");
  refused(thrown_by([&] { (void)simulation.state(post, 1.0); }), "state");
  refused(thrown_by([&] { (void)simulation.find(post); }), "find");
  refused(thrown_by([&] { (void)simulation.body_of(still, 0); }), "body_of");
  refused(thrown_by([&] { (void)simulation.motion(still); }), "motion");
  refused(thrown_by([&] { (void)simulation.add_motion(Still()); }), "add_motion");
  // NOLINTEND(bugprone-use-after-move)
}

}  // namespace
}  // namespace kinesphere::simulation_test
