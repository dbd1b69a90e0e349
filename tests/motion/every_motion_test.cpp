// The contract of Motion, kept by every motion that answers for all times.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "kinesphere/certificates.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/piecewise_motion.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/motion/steered_motion.hpp"
#include "kinesphere/motion/velocity_field.hpp"
#include "kinesphere/world.hpp"
#include "motion/motion_properties.hpp"

namespace kinesphere::every_motion_test {
namespace {

constexpr std::size_t bodies = 6;

template <class M>
std::unique_ptr<Motion> owned(Result<M> motion) {
  return std::make_unique<M>(std::move(motion).value());
}

std::vector<double> random_limits(Random& random) {
  std::vector<double> limits(bodies);
  for (double& limit : limits) limit = random.uniform(0, 20);
  return limits;
}

std::unique_ptr<Motion> random_forces(Random& random) {
  return owned(RandomForces::create({.start = random_states(random, bodies, 100, 30),
                                     .acceleration_limits = random_limits(random),
                                     .interval = random.uniform(0.05, 2),
                                     .seed = random.bits()}));
}

std::unique_ptr<Motion> velocity_field(Random& random) {
  return owned(VelocityField::create({.field = Circulation{{{-100, -80, -60}, {100, 80, 60}}, 40},
                                      .start = random_states(random, bodies, 60, 30),
                                      .acceleration_limits = random_limits(random),
                                      .interval = random.uniform(0.05, 0.5)}));
}

std::unique_ptr<Motion> ballistic(Random& random) {
  return owned(Ballistic::create(
      {.start = random_states(random, bodies, 100, 30), .gravity = 10 * random.point_in_ball()}));
}

std::unique_ptr<Motion> steered(Random& random) {
  auto motion = SteeredMotion::create({.start = random_states(random, bodies, 100, 30),
                                       .acceleration_limits = std::vector<double>(bodies, 7.0)});
  for (std::uint32_t body = 0; body < bodies; ++body) {
    motion->steer(body, 0.0, 7.0 * random.unit_vector()).value();
  }
  return owned(std::move(motion));
}

std::unique_ptr<Motion> recorded_tracks(Random& random) {
  std::vector<Track> tracks(bodies);
  for (Track& track : tracks) {
    double time = random.uniform(-5, 5);
    const std::uint64_t samples = 2 + random.bits() % 20;
    for (std::uint64_t k = 0; k < samples; ++k) {
      track.push_back({time, 50 * random.point_in_ball()});
      time += random.uniform(0.01, 2);
    }
  }
  return owned(RecordedTracks::create(tracks));
}

std::unique_ptr<Motion> piecewise_motion(Random& random) {
  std::vector<Trajectory> trajectories(bodies);
  for (Trajectory& trajectory : trajectories) {
    State state = random_states(random, 1, 100, 30).front();
    double time = random.uniform(-5, 5);
    for (int k = 0; k < 8; ++k) {
      const double end = time + random.uniform(0.1, 2);
      trajectory.push_back({time, end, state.position, state.velocity, 9 * random.point_in_ball(),
                            5 * random.point_in_ball()});
      state = trajectory.back().state_at(end);
      time = end;
    }
  }
  return owned(PiecewiseMotion::create(trajectories));
}

struct Maker {
  std::string name;
  std::unique_ptr<Motion> (*make)(Random&);
  bool can_be_kicked;
  double begin;  ///< begin of the known times
};

class EveryMotion : public testing::TestWithParam<Maker> {
 protected:
  static constexpr double end = 20.0;
  double begin_ = GetParam().begin;

  /// Runs a test on several motions of this kind.
  void for_motions(const std::function<void(Motion&, Random&)>& test) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      const auto motion = GetParam().make(random);
      ASSERT_EQ(motion->size(), bodies);
      test(*motion, random);
      if (HasFatalFailure()) return;
    }
  }
};

TEST_P(EveryMotion, TrajectoryGivesTheStates) {
  for_motions([&](Motion& motion, Random& random) {
    for (int k = 0; k < 50; ++k) {
      const double from = random.uniform(begin_, end);
      const double to = random.uniform(from, end);
      expect_trajectory_gives_states(motion, random_body(random, motion), from, to, random);
    }
  });
}

TEST_P(EveryMotion, TrajectoryOfAnInstantIsOneSegment) {
  for_motions([&](Motion& motion, Random&) {
    const Trajectory trajectory = motion.trajectory(0, 6.0, 6.0);
    ASSERT_EQ(trajectory.size(), 1u);
    EXPECT_EQ(trajectory.front().state_at(6.0), motion.state(0, 6.0));
  });
}

TEST_P(EveryMotion, AnswersDoNotDependOnTheOrderOfQuestions) {
  for_motions(
      [&](Motion& motion, Random& random) { expect_order_does_not_matter(motion, begin_, end, random); });
}

TEST_P(EveryMotion, KeepsItsPromise) {
  for_motions([&](Motion& motion, Random& random) {
    for (int k = 0; k < 200; ++k) {
      expect_promise_kept(motion, random_body(random, motion), begin_, end, random);
    }
  });
}

TEST_P(EveryMotion, KickChangesTheVelocityAndNothingElse) {
  for_motions([&](Motion& motion, Random& random) {
    double time = begin_;
    for (int k = 0; k < 10; ++k) {
      time = random.uniform(time, end);
      const auto before = motion.clone();
      const Vec3 velocity = 20 * random.point_in_ball();
      ASSERT_EQ(bool(motion.set_velocity(2, time, velocity)), GetParam().can_be_kicked);
      const State expected = GetParam().can_be_kicked ? State{before->state(2, time).position, velocity}
                                                      : before->state(2, time);
      EXPECT_EQ(motion.state(2, time), expected);
      EXPECT_EQ(motion.state(3, end), before->state(3, end));
      expect_trajectory_gives_states(motion, 2, time, end, random);
      for (int i = 0; i < 20; ++i) expect_promise_kept(motion, 2, time, end, random);
    }
  });
}

TEST_P(EveryMotion, RefusesKicksThatMakeNoSense) {
  for_motions([&](Motion& motion, Random&) {
    (void)motion.set_velocity(1, 3.0, {1, 2, 3});
    const State before = motion.state(1, end);
    EXPECT_FALSE(motion.set_velocity(1, 2.5, {}));
    EXPECT_FALSE(motion.set_velocity(1, std::numeric_limits<double>::quiet_NaN(), {}));
    EXPECT_FALSE(motion.set_velocity(1, std::numeric_limits<double>::infinity(), {}));
    EXPECT_FALSE(motion.set_velocity(1, 4.0, {0, std::numeric_limits<double>::infinity(), 0}));
    EXPECT_EQ(motion.state(1, end), before);
  });
}

TEST_P(EveryMotion, ClonesGoTheirOwnWay) {
  for_motions([&](Motion& motion, Random&) {
    (void)motion.set_velocity(0, 2.0, {1, 2, 3});
    const auto clone = motion.clone();
    const State before = motion.state(0, end);
    EXPECT_EQ(clone->state(0, end), before);
    const bool redirected{clone->set_velocity(0, 4.0, {-50, 0, 0})};
    EXPECT_EQ(motion.state(0, end), before);
    EXPECT_EQ(clone->state(0, end) == before, !redirected);
  });
}

TEST_P(EveryMotion, ProbeReadsTheStates) {
  for_motions([&](Motion& motion, Random&) {
    const std::vector<BodyId> ids{{4, 0}, {1, 0}};
    std::vector<State> states(2);
    motion.probe()(ids, 5.0, states);
    EXPECT_EQ(states[0], motion.state(4, 5.0));
    EXPECT_EQ(states[1], motion.state(1, 5.0));
  });
}

/// Returns the error with which a call that has no Result fails.
template <class Call>
std::optional<Error> refusal(const Call& call) {
  try {
    call();
  } catch (const BadResult& refused) {
    return refused.error();
  }
  return std::nullopt;
}

TEST_P(EveryMotion, RefusesToAnswerForABodyThatItDoesNotHave) {
  for_motions([&](Motion& motion, Random&) {
    for (const std::uint32_t body : {std::uint32_t{bodies}, 1'000'000u, 0xffffffffu}) {
      EXPECT_FALSE(motion.contains(body));
      const std::function<void()> questions[] = {[&] { (void)motion.state(body, 5.0); },
                                                 [&] { (void)motion.definition(body, 5.0); },
                                                 [&] { (void)motion.trajectory(body, 5.0, 6.0); }};
      for (const auto& question : questions) {
        const auto error = refusal(question);
        ASSERT_TRUE(error);
        EXPECT_EQ(error->code, ErrorCode::unknown_body) << error->message;
        EXPECT_EQ(error->body, (BodyId{body, 0}));
        EXPECT_NE(error->message.find("body " + std::to_string(body)), std::string::npos) << error->message;
      }
      EXPECT_EQ(motion.set_velocity(body, 5.0, {}).error().code, ErrorCode::unknown_body);
      EXPECT_EQ(motion.teleport(body, 5.0, {}).error().code, ErrorCode::unknown_body);
      EXPECT_EQ(motion.remove(body).error().code, ErrorCode::unknown_body);
    }
  });
}

TEST_P(EveryMotion, RefusesTimesThatAreNone) {
  for_motions([&](Motion& motion, Random&) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double time : {nan, infinity, -infinity}) {
      EXPECT_EQ(refusal([&] { (void)motion.state(1, time); })->code, ErrorCode::not_finite);
      EXPECT_EQ(refusal([&] { (void)motion.definition(1, time); })->code, ErrorCode::not_finite);
      EXPECT_EQ(refusal([&] { (void)motion.trajectory(1, time, 6.0); })->argument, "begin");
      EXPECT_EQ(refusal([&] { (void)motion.trajectory(1, 5.0, time); })->argument, "end");
    }
    EXPECT_EQ(refusal([&] { (void)motion.trajectory(1, 5.0, 4.0); })->code, ErrorCode::out_of_range);
    if (!motion.set_velocity(1, 5.0, {1, 0, 0})) return;
    EXPECT_EQ(refusal([&] { (void)motion.state(1, 4.0); })->code, ErrorCode::time_backwards);
    EXPECT_EQ(refusal([&] { (void)motion.trajectory(1, 4.0, 6.0); })->code, ErrorCode::time_backwards);
  });
}

/// A body that a world has added itself, such as a bullet.
TEST_P(EveryMotion, ProbeRefusesABodyOfTheWorldThatIsNoneOfItsOwn) {
  for_motions([&](Motion& motion, Random&) {
    World world = World::create({.contact_tolerance = 1e-3, .start_time = begin_}).value();
    BodyId first = no_body;
    for (std::uint32_t k = 0; k < motion.size(); ++k) {
      BodyDefinition body = motion.definition(k, begin_);
      body.radius = 0.001;
      const BodyId id = world.add(body).value();
      if (k == 0) first = id;
    }
    const BodyId bullet = world.add({.radius = 0.1, .acceleration_limit = 5, .velocity = {0, 50, 0}}).value();
    const auto error = refusal([&] {
      while (world.advance(begin_ + 1.0, motion.probe()).value()) continue;
      // The bullet may not have been probed yet, without another body near it.
      (void)world.certificates(motion.probe()).distance_limits(bullet, first, begin_ + 2.0);
    });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, ErrorCode::unknown_body);
    EXPECT_EQ(error->body, bullet);
    EXPECT_NE(error->message.find("body " + std::to_string(bodies)), std::string::npos) << error->message;
  });
}

TEST_P(EveryMotion, ProbeRefusesIndicesThatTheWorldUsesAgain) {
  for_motions([&](Motion& motion, Random&) {
    const std::vector<BodyId> ids{{1, 1}};
    std::vector<State> states(1);
    EXPECT_EQ(refusal([&] { motion.probe()(ids, 5.0, states); })->code, ErrorCode::unknown_body);
  });
}

TEST_P(EveryMotion, TeleportsWhatCanBeChangedAndRemoves) {
  for_motions([&](Motion& motion, Random&) {
    const auto before = motion.clone();
    const State there{{1, 2, 3}, {4, 5, 6}};
    if (GetParam().can_be_kicked) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      EXPECT_EQ(motion.teleport(1, 5.0, {{nan, 0, 0}, {}}).error().code, ErrorCode::not_finite);
      EXPECT_EQ(motion.teleport(1, -1.0, there).error().code, ErrorCode::time_backwards);
      EXPECT_EQ(motion.state(1, 6.0), before->state(1, 6.0));

      motion.teleport(1, 5.0, there).value();
      EXPECT_EQ(motion.state(1, 5.0), there);
      EXPECT_EQ(motion.state(2, 6.0), before->state(2, 6.0));
    } else {
      EXPECT_EQ(motion.teleport(1, 5.0, there).error().code, ErrorCode::unsupported);
      EXPECT_EQ(motion.state(1, 6.0), before->state(1, 6.0));
    }

    motion.remove(1).value();
    EXPECT_FALSE(motion.contains(1));
    EXPECT_EQ(motion.size(), bodies);
    EXPECT_EQ(refusal([&] { (void)motion.state(1, 6.0); })->code, ErrorCode::stale_body);
    EXPECT_EQ(refusal([&] { (void)motion.definition(1, 6.0); })->code, ErrorCode::stale_body);
    EXPECT_EQ(motion.set_velocity(1, 6.0, {}).error().code, ErrorCode::stale_body);
    EXPECT_EQ(motion.remove(1).error().code, ErrorCode::stale_body);
    EXPECT_EQ(motion.state(2, 6.0), before->state(2, 6.0));
  });
}

TEST_P(EveryMotion, GoesBackToAnEarlierDepartureToTheLastBit) {
  for_motions([&](Motion& motion, Random& random) {
    if (!GetParam().can_be_kicked) {
      EXPECT_EQ(refusal([&] { (void)motion.origin(1); })->code, ErrorCode::unsupported);
      EXPECT_EQ(motion.set_origin(1, {}).error().code, ErrorCode::unsupported);
      return;
    }
    motion.set_velocity(1, 2.0, 10 * random.point_in_ball()).value();
    const auto before = motion.clone();
    const MotionOrigin origin = motion.origin(1);
    EXPECT_EQ(origin.time, 2.0);
    EXPECT_EQ(origin.state, motion.state(1, 2.0));
    const double kicked_at = random.uniform(2.0, 10.0);
    motion.set_velocity(1, kicked_at, {1, 2, 3}).value();
    EXPECT_NE(motion.state(1, 15.0), before->state(1, 15.0));
    const auto redirected = motion.clone();
    motion.set_origin(1, origin).value();
    for (const double time : {15.0, 2.0, kicked_at, 9.0})
      EXPECT_EQ(motion.state(1, time), before->state(1, time)) << time;
    motion.set_origin(1, redirected->origin(1)).value();
    EXPECT_EQ(motion.state(1, 15.0), redirected->state(1, 15.0));

    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(motion.set_origin(1, {nan, {}}).error().code, ErrorCode::not_finite);
    EXPECT_EQ(motion.set_origin(1, {2.0, {{}, {0, nan, 0}}}).error().argument, "origin");
    EXPECT_EQ(motion.set_origin(bodies, origin).error().code, ErrorCode::unknown_body);
    EXPECT_EQ(refusal([&] { (void)motion.origin(bodies); })->code, ErrorCode::unknown_body);
    EXPECT_EQ(motion.state(1, 15.0), redirected->state(1, 15.0));
    motion.remove(1).value();
    EXPECT_EQ(motion.set_origin(1, origin).error().code, ErrorCode::stale_body);
    EXPECT_EQ(refusal([&] { (void)motion.origin(1); })->code, ErrorCode::stale_body);
  });
}

TEST_P(EveryMotion, MoverRefusesBodiesOfTheWorldThatAreNoneOfItsOwn) {
  for_motions([&](Motion& motion, Random&) {
    SingleMotionSource source(motion);
    for (const BodyId id : {BodyId{1, 1}, BodyId{bodies, 0}}) {
      EXPECT_EQ(refusal([&] { (void)source.origin(id); })->code, ErrorCode::unknown_body);
      EXPECT_EQ(refusal([&] { source.set_origin(id, {}); })->code, ErrorCode::unknown_body);
    }
  });
}

/// Each thread has bodies of its own, and may query, change and restore them. The thread sanitizer checks it;
/// the answers must equal those of one thread.
TEST_P(EveryMotion, ServesThreadsWithDifferentBodies) {
  for_motions([&](Motion& motion, Random&) {
    const auto visit = [&](Motion& visited, std::uint32_t body, std::vector<State>& states) {
      for (const double time : {15.0, 5.0, 9.0, 6.5}) states.push_back(visited.state(body, time));
      if (!GetParam().can_be_kicked) return;
      const MotionOrigin origin = visited.origin(body);
      visited.set_velocity(body, 7.0, {1, 2, 3}).value();
      states.push_back(visited.state(body, 12.0));
      visited.set_origin(body, origin).value();
      states.push_back(visited.state(body, 12.0));
    };
    const auto alone = motion.clone();
    std::vector<std::vector<State>> expected(bodies), found(bodies);
    for (std::uint32_t body = 0; body < bodies; ++body) visit(*alone, body, expected[body]);
    std::vector<std::thread> threads;
    for (std::uint32_t first = 0; first < 3; ++first) {
      threads.emplace_back([&, first] {
        for (std::uint32_t body = first; body < bodies; body += 3) visit(motion, body, found[body]);
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(found, expected);
  });
}

INSTANTIATE_TEST_SUITE_P(All, EveryMotion,
                         testing::Values(Maker{"RandomForces", random_forces, true, 0.0},
                                         Maker{"VelocityField", velocity_field, true, 0.0},
                                         Maker{"Ballistic", ballistic, true, 0.0},
                                         Maker{"Steered", steered, true, 0.0},
                                         Maker{"RecordedTracks", recorded_tracks, false, 5.0},
                                         Maker{"PiecewiseMotion", piecewise_motion, false, 5.0}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace kinesphere::every_motion_test
