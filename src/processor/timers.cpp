#include "processor/timers.hpp"

#include <algorithm>
#include <cmath>

#include "contact/contact_predictor.hpp"

namespace kinesphere {

std::size_t Timers::remove(std::uint64_t user_data) {
  return std::erase_if(waiting_,
                       [=](const Waiting& waiting) { return waiting.timer.user_data == user_data; });
}

std::uint64_t Timers::take() {
  Waiting first = waiting_.extract(waiting_.begin()).value();
  const Timer& timer = first.timer;
  if (timer.period > 0.0) {
    // The sum of many periods would drift. Where a period is too short to tell times apart, time goes on by
    // the least step.
    const double next = timer.time + static_cast<double>(++first.rounds) * timer.period;
    first.time = std::max(next, just_after(first.time));
    first.order = ++added_;
    waiting_.insert(first);
  }
  return timer.user_data;
}

bool Timers::is_valid(double now) const {
  return std::is_sorted(waiting_.begin(), waiting_.end()) &&
         std::all_of(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
           const auto& [time, order, timer, rounds] = waiting;
           return time >= now && time < infinity && order <= added_ && std::isfinite(timer.time) &&
                  timer.period >= 0.0 && timer.period < infinity;
         });
}

}  // namespace kinesphere
