#include "job_clock.hpp"

#include <array>
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
  const bool stops = was_signalled != 0 || now >= limits_.time_limit.value_or(never);
  // Clocks differ, and a signal reaches some ranks first: one that wishes is enough.
  std::array<std::uint64_t, 3> wishing{stops, now >= next_checkpoint_, now >= next_progress_};
  ranks_.sum(wishing);
  const Wishes shared{wishing[0] > 0, wishing[1] > 0, wishing[2] > 0};
  if (shared.checkpoint) next_checkpoint_ = now + *limits_.checkpoint_every;
  if (shared.progress) next_progress_ = now + *limits_.progress_every;
  return shared;
}

double JobClock::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

}  // namespace kinesphere::program
