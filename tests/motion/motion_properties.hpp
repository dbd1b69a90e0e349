// Properties of every motion, checked by functions that report through GoogleTest.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere {

inline std::vector<State> random_states(Random& random, std::size_t count, double extent, double speed) {
  std::vector<State> states(count);
  for (State& state : states) {
    state.position = extent * random.point_in_ball();
    state.velocity = speed * random.point_in_ball();
  }
  return states;
}

inline std::uint32_t random_body(Random& random, const Motion& motion) {
  return static_cast<std::uint32_t>(random.bits() % motion.size());
}

/// Expects that trajectory() has no holes, covers [begin, end], and gives the states of state(), to the last
/// bit.
inline void expect_trajectory_gives_states(const Motion& motion, std::uint32_t body, double begin, double end,
                                           Random& random) {
  const Trajectory trajectory = motion.trajectory(body, begin, end);
  ASSERT_FALSE(trajectory.empty());
  EXPECT_LE(trajectory.front().begin, begin);
  EXPECT_EQ(trajectory.back().end, end);
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const Segment& segment = trajectory[k];
    if (k > 0) {
      ASSERT_EQ(segment.begin, trajectory[k - 1].end);
      EXPECT_EQ(segment.state_at(segment.begin), motion.state(body, segment.begin));
    }
    const double t = random.uniform(std::max(begin, segment.begin), segment.end);
    if (t == segment.end) continue;  // belongs to the next segment, if there is one
    EXPECT_EQ(segment.state_at(t), motion.state(body, t)) << "body " << body << " at " << t;
  }
}

/// Expects that the body keeps its limits in [begin, end]: in its place after any time, in its speed, and in
/// the acceleration of each segment.
inline void expect_promise_kept(const Motion& motion, std::uint32_t body, double begin, double end,
                                Random& random) {
  const double t0 = random.uniform(begin, end);
  const double t1 = random.uniform(t0, end);
  const double s = t1 - t0;
  const BodyDefinition promise = motion.definition(body, t0);
  const State now = motion.state(body, t1);
  const double limit = promise.acceleration_limit;
  const double error = promise.velocity_error;
  const Vec3& g = promise.planned_acceleration;
  ASSERT_EQ(motion.state(body, t0), (State{promise.position, promise.velocity}));
  EXPECT_EQ(promise.radius, BodyDefinition{}.radius);
  const double rounding = 1e-12 * (1.0 + norm(promise.position) + norm(promise.velocity) * (1.0 + s));
  const Vec3 expected = promise.position + promise.velocity * s + 0.5 * s * s * g;
  EXPECT_LE(norm(now.position - expected), error * s + 0.5 * limit * s * s + rounding) << t0 << " to " << t1;
  EXPECT_LE(norm(now.velocity - promise.velocity - s * g), error + limit * s + rounding)
      << t0 << " to " << t1;
  for (const Segment& segment : motion.trajectory(body, t0, t1)) {
    EXPECT_LE(norm(segment.acceleration - g), limit);
    EXPECT_LE(norm(segment.acceleration_at(segment.end) - g), limit);
  }
}

/// Expects equal answers to equal queries in any order.
inline void expect_order_does_not_matter(const Motion& motion, double begin, double end, Random& random) {
  struct Question {
    std::uint32_t body;
    double time;
    State answer;
  };
  std::vector<Question> questions;
  for (int k = 0; k < 300; ++k) {
    const std::uint32_t body = random_body(random, motion);
    const double time = random.uniform(begin, end);
    questions.push_back({body, time, motion.clone()->state(body, time)});
  }
  for (const Question& question : questions) {
    ASSERT_EQ(motion.state(question.body, question.time), question.answer);
  }
  std::sort(questions.begin(), questions.end(), [](auto& a, auto& b) { return a.time < b.time; });
  for (const Question& question : questions) {
    ASSERT_EQ(motion.state(question.body, question.time), question.answer);
  }
}

}  // namespace kinesphere
