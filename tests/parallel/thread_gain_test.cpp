// When threads stand back, from times that are told.
#include "parallel/thread_gain.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace kinesphere::thread_gain_test {
namespace {

/// Does as much work as takes one thread `seconds`, in parts of 1 ms; with several threads each takes `cost`
/// times as long. Returns the time that it took.
double work(ThreadGain& gain, double seconds, double cost) {
  constexpr double part = 0.001;
  double taken = 0.0;
  for (double done = 0.0; done < seconds; done += part) {
    const double time = gain.uses_threads() ? cost * part : part;
    gain.note(time, 100.0);
    gain.decide();
    taken += time;
  }
  return taken;
}

TEST(ThreadGain, LosesLittleWhereThreadsLose) {
  for (const double cost : {1.0, 1.1, 1.6}) {
    ThreadGain gain;
    EXPECT_LT(work(gain, 3.0, cost), 1.03 * 3.0) << cost;
    EXPECT_LT(work(gain, 20.0, cost), 1.01 * 20.0) << cost;
  }
}

TEST(ThreadGain, KeepsThreadsThatGain) {
  for (const double cost : {0.5, 0.6, 0.9}) {
    ThreadGain gain;
    EXPECT_LT(work(gain, 3.0, cost), (cost + 0.03) * 3.0) << cost;
    EXPECT_LT(work(gain, 20.0, cost), (cost + 0.01) * 20.0) << cost;
  }
}

/// The same as work() with threads that have `sharing` seconds of processor time for each one of real time.
double work_sharing(ThreadGain& gain, double seconds, double cost, double sharing) {
  constexpr double part = 0.0005;
  double taken = 0.0;
  for (double done = 0.0; done < seconds; done += part) {
    const double time = gain.uses_threads() ? cost * part : part;
    if (!gain.uses_threads() || !gain.note_sharing(sharing * time, time)) gain.note(time, 100.0);
    gain.decide();
    taken += time;
  }
  return taken;
}

TEST(ThreadGain, StandsBackAtOnceWhereOneProcessorIsFree) {
  for (const double sharing : {0.5, 1.0, 1.1}) {
    ThreadGain gain;
    EXPECT_LT(work_sharing(gain, 0.1, 1.6, sharing), 1.03 * 0.1) << sharing;
    EXPECT_LT(work_sharing(gain, 3.0, 1.6, sharing), 1.01 * 3.0) << sharing;
  }
}

TEST(ThreadGain, HasNoTrialOfOneThreadInAShortRunWhereTwoProcessorsAreFree) {
  ThreadGain gain;
  EXPECT_LT(work_sharing(gain, 0.02, 0.6, 1.8), 0.601 * 0.02);
  EXPECT_LT(work_sharing(gain, 3.0, 0.6, 1.8), 0.62 * 3.0);
  EXPECT_TRUE(gain.uses_threads());
  ThreadGain other;
  EXPECT_LT(work_sharing(other, 3.0, 1.3, 1.8), 1.01 * 3.0) << "they share, and lose nevertheless";
}

TEST(ThreadGain, NoticesThatProcessorsBecomeFreeAndBusy) {
  ThreadGain gain;
  for (const double cost : {1.5, 0.6, 1.5}) {
    work(gain, 3.0, cost);
    EXPECT_EQ(gain.uses_threads(), cost < 1.0);
    EXPECT_LT(work(gain, 3.0, cost), 1.05 * 3.0 * std::min(cost, 1.0));
  }
}

}  // namespace
}  // namespace kinesphere::thread_gain_test
