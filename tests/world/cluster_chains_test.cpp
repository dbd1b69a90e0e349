// Clusters that take in one body after the other, and run again for each: events equal to those of a loop
// over advance(), a bounded number of runs, and memory in proportion to the work.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/workers.hpp"
#include "support/eager_workers.hpp"
#include "support/playground.hpp"
#include "world/bouncing_world.hpp"

namespace kinesphere::cluster_chains_test {
namespace {

/// Rows of balls at rest. The first of each row is hit from behind; each ball is lighter than the one before,
/// so that the wave gets faster. Far away the requested number of pairs meet.
struct Rows : BouncingWorld<Ballistic> {
  Rows(int rows, int length, int pairs)
      : BouncingWorld(Ballistic::create({.start = start(rows, length, pairs)}).value(),
                      World::create({.contacts = ContactEvents::impacts}).value(), 1.0) {
    const auto add_one = [this](double mass) {
      BodyDefinition body = next();
      body.radius = 0.5;
      body.acceleration_limit = 1e-3;
      add(body, mass);
    };
    for (int row = 0; row < rows; ++row) {
      double mass = 1.0;
      for (int k = 0; k < length; ++k, mass *= 0.9) add_one(mass);
    }
    for (int k = 0; k < 2 * pairs; ++k) add_one(1.0);
  }

  /// Counts the responses to events.
  std::size_t run_by(int threads, double until) {
    Workers workers = eager_workers(threads).value();
    SingleMotionSource source(motion);
    std::atomic<std::size_t> asked = 0;
    const auto respond = [&](const Event& event) {
      ++asked;
      return answer(event);
    };
    world
        .run(
            until, source, respond, [this](const Event& event) { tell(event); }, &workers)
        .value();
    return asked;
  }

 private:
  static std::vector<State> start(int rows, int length, int pairs) {
    std::vector<State> states;
    for (int row = 0; row < rows; ++row) {
      const double y = row % 16 * 20.0;
      const double z = row / 16 * 20.0;
      for (int k = 0; k < length; ++k)
        states.push_back({{1.05 * k, y, z}, {k == 0 ? 1.0 + 0.001 * row : 0.0, 0, 0}});
    }
    for (int k = 0; k < pairs; ++k) {
      const Vec3 place{5.0 * (k % 10), 1000.0 + 5.0 * (k / 10 % 10), 5.0 * (k / 100)};
      const double gap = 0.02 + 0.3 * k / pairs;
      states.push_back({place, {1, 0, 0}});
      states.push_back({place + Vec3{1.0 + gap, 0, 0}, {}});
    }
    return states;
  }
};

TEST(ClustersOfRows, AreLeftToALoopWhereTheyRunAgainAndAgain) {
  constexpr int rows = 48;
  Rows looped(rows, 60, 0), run(rows, 60, 0);
  looped.loop(2.0);
  const std::size_t asked = run.run_by(2, 2.0);
  expect_same_course(run, looped);
  EXPECT_GT(run.reported, 48u * 50u);
  EXPECT_LT(asked, 4 * run.reported);
}

/// Most clusters are unrelated to the rows.
TEST(ClustersOfRows, ForgetWhatTheyHaveDoneInVain) {
  for (const int threads : {2, 3}) {
    Rows looped(8, 70, 120), run(8, 70, 120);
    looped.loop(2.0);
    std::size_t asked = 0;
    for (const double until : {0.9, 2.0}) {
      asked += run.run_by(threads, until);
      EXPECT_TRUE(is_clean(run.world)) << until;
    }
    expect_same_course(run, looped);
    EXPECT_GT(asked, 3 * run.reported) << "they did run again and again";
  }
}

/// A motion source that throws a number of times after it has set a body back.
class ThrowsGoingBack final : public MotionSource {
 public:
  explicit ThrowsGoingBack(Motion& motion) : mover_(motion) {}
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    mover_.states(ids, time, states);
  }
  MotionOrigin origin(BodyId body) const override { return mover_.origin(body); }
  void set_origin(BodyId body, const MotionOrigin& to) override {
    const bool goes_back = to.time < origin(body).time;
    mover_.set_origin(body, to);
    if (!goes_back) return;
    const int time = ++times_;
    if (time % 7 == 0 && time <= 35) throw std::runtime_error("went back");
  }

 private:
  SingleMotionSource mover_;
  std::atomic<int> times_ = 0;
};

TEST(ClustersOfRows, GoOnAfterAMoverThrewAsItWentBack) {
  Rows looped(32, 40, 400), run(32, 40, 400);
  looped.loop(2.0);
  Workers workers = eager_workers(2).value();
  ThrowsGoingBack source(run.motion);
  int thrown = 0;
  for (;;) {
    try {
      run.world
          .run(
              2.0, source, [&](const Event& event) { return run.answer(event); },
              [&](const Event& event) { run.tell(event); }, &workers)
          .value();
      break;
    } catch (const std::runtime_error&) {
      ASSERT_LE(++thrown, 5);
    }
    ASSERT_TRUE(is_clean(run.world));
  }
  EXPECT_GE(thrown, 1);
  expect_same_course(run, looped);
}

}  // namespace
}  // namespace kinesphere::cluster_chains_test
