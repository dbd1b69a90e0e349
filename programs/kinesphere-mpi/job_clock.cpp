#include "job_clock.hpp"

#include <cstdint>
#include <limits>

namespace kinesphere::program {
namespace {

volatile std::sig_atomic_t was_signalled = 0;

void note_signal(int) { was_signalled = 1; }

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

JobClock::JobClock(const Ranks& ranks, const JobLimits& limits)
    : ranks_(ranks),
      limits_(limits),
      began_(std::chrono::steady_clock::now()),
      next_checkpoint_(limits.checkpoint_every.value_or(never)),
      next_progress_(limits.progress_every.value_or(never)) {
  if (!limits_.heeds_signals) return;
  was_signalled = 0;
  before_terminate_ = std::signal(SIGTERM, note_signal);
  before_user_ = std::signal(SIGUSR1, note_signal);
}

JobClock::~JobClock() {
  if (!limits_.heeds_signals) return;
  std::signal(SIGTERM, before_terminate_);
  std::signal(SIGUSR1, before_user_);
}

JobClock::Wishes JobClock::look() {
  if (!is_watched()) return {};
  const double now = elapsed();
  constexpr std::uint64_t stop = 1, checkpoint = 2, progress = 4;
  std::uint64_t wishes = 0;
  if (was_signalled != 0 || now >= limits_.time_limit.value_or(never)) wishes |= stop;
  if (now >= next_checkpoint_) wishes |= checkpoint;
  if (now >= next_progress_) wishes |= progress;
  // Clocks differ, and a signal reaches some ranks first: one that wishes is enough.
  const auto any_wishes = [&](std::uint64_t wish) { return ranks_.largest(wishes & wish) != 0; };
  const Wishes shared{any_wishes(stop), any_wishes(checkpoint), any_wishes(progress)};
  if (shared.checkpoint) next_checkpoint_ = now + *limits_.checkpoint_every;
  if (shared.progress) next_progress_ = now + *limits_.progress_every;
  return shared;
}

double JobClock::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

}  // namespace kinesphere::program
