// What time it is in a stream, and which reports are believed to know.
#include "watch/stream_clock.hpp"

#include <cmath>

namespace kinesphere::program {

double seconds_between(const FileTime& earlier, const FileTime& later) {
  return static_cast<double>(later.whole - earlier.whole) + (later.fraction - earlier.fraction);
}

void StreamClock::go_on(const FileTime& time) {
  if (!has_begun_ || seconds_between(now_, time) > 0.0) now_ = time;
  has_begun_ = true;
}

bool StreamClock::confirms(const FileTime& time, const std::string& id, bool others) {
  if (in_a_row_ == 0 || std::abs(seconds_between(latest_ahead_, time)) > leap_) {
    in_a_row_ = 0;
    first_ahead_ = time;
    first_id_ = id;
    several_ids_ = false;
  }
  ++in_a_row_;
  latest_ahead_ = time;
  several_ids_ = several_ids_ || id != first_id_;
  if (source_ == Source::arrivals) return seconds_between(first_ahead_, time) != 0.0;
  constexpr std::size_t enough = 3, enough_of_one = 10;
  return in_a_row_ >= (several_ids_ || !others ? enough : enough_of_one);
}

}  // namespace kinesphere::program
