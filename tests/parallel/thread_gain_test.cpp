// When threads stand back, from times that are told.
#include "parallel/thread_gain.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace kinesphere::thread_gain_test {
namespace {

using Seconds = std::chrono::duration<double>;

class Machine {
 public:
  explicit Machine(double sharing) : sharing_(sharing) {}

  /// From now on, threads have so many seconds of processor time for each one of real time.
  void set_sharing(double sharing) { sharing_ = sharing; }
  /// Runs for some seconds, in parallel sections of half a millisecond with serial ones of the same length
  /// between them. Returns the share of the time in which threads were used.
  double run(ThreadGain& gain, double seconds) {
    constexpr double section = 0.0005;
    double with_threads = 0.0;
    double all = 0.0;
    for (; all < seconds; all += 2.0 * section) {
      const bool uses_threads = gain.uses_threads([this] { return now_; });
      now_ += std::chrono::duration_cast<ThreadGain::Clock::duration>(Seconds(2.0 * section));
      if (!uses_threads) continue;
      with_threads += 2.0 * section;
      gain.note_sharing(sharing_ * section, section, now_);
    }
    return with_threads / all;
  }

 private:
  double sharing_;
  ThreadGain::Clock::time_point now_{};
};

TEST(ThreadGain, StandsBackAtOnceWhereOneProcessorIsFree) {
  for (const double sharing : {0.5, 1.0, 1.1}) {
    ThreadGain gain;
    Machine machine(sharing);
    EXPECT_LT(machine.run(gain, 0.1), 0.08) << sharing;
    EXPECT_LT(machine.run(gain, 20.0), 0.01) << sharing;
  }
}

TEST(ThreadGain, UsesThreadsThatShare) {
  for (const double sharing : {1.3, 2.0, 8.0}) {
    ThreadGain gain;
    EXPECT_EQ(Machine(sharing).run(gain, 20.0), 1.0) << sharing;
  }
}

TEST(ThreadGain, NoticesThatProcessorsBecomeFreeAndBusy) {
  ThreadGain gain;
  Machine machine(1.0);
  for (int turn = 0; turn < 3; ++turn) {
    machine.set_sharing(1.0);
    machine.run(gain, 0.05);
    EXPECT_LT(machine.run(gain, 5.0), 0.02);
    machine.set_sharing(1.9);
    machine.run(gain, 1.7);
    EXPECT_EQ(machine.run(gain, 1.0), 1.0);
  }
}

}  // namespace
}  // namespace kinesphere::thread_gain_test
