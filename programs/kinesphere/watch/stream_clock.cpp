// The present time of a stream, protected from wrong clocks.
#include "watch/stream_clock.hpp"

namespace kinesphere::program {

void StreamClock::go_on(const FileTime& time) {
  if (!has_begun() || seconds_between(now(), time) > 0.0) memory_.now = time;
  memory_.has_begun = true;
}

bool StreamClock::confirms(const FileTime& time, const std::string& id, bool others) {
  auto& [source, has_begun, now, in_a_row, first_ahead, latest_ahead, first_id, several_ids] = memory_;
  // A stream may be sparse: later ones confirm, however much later. Earlier ones do not, but for disorder.
  if (in_a_row == 0 || seconds_between(time, latest_ahead) > leap_) {
    in_a_row = 0;
    first_ahead = time;
    first_id = id;
    several_ids = false;
  }
  ++in_a_row;
  if (in_a_row == 1 || seconds_between(latest_ahead, time) > 0.0) latest_ahead = time;
  several_ids = several_ids || id != first_id;
  if (source == Source::arrivals) return seconds_between(first_ahead, time) != 0.0;
  constexpr std::size_t enough = 3, enough_of_one = 10;
  return in_a_row >= (several_ids || !others ? enough : enough_of_one);
}

}  // namespace kinesphere::program
