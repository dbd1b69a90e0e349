// The present time of a stream, protected from wrong clocks.
#include "watch/clock/stream_clock.hpp"

namespace kinesphere::program {

void StreamClock::go_on(const FileTime& time) {
  if (!has_begun() || seconds_between(now(), time) > 0.0) memory_.now = time;
  memory_.has_begun = true;
}

bool StreamClock::confirms(const FileTime& time, const std::string& id, bool others) {
  Memory& m = memory_;
  // A stream may be sparse: later ones confirm, however much later. Earlier ones do not, but for disorder.
  const bool goes_back = m.in_a_row > 0 && seconds_between(time, m.latest_ahead) > leap_;
  if (goes_back && !m.has_begun && m.leapt && seconds_between(time, m.latest_before_leap) <= leap_) {
    --m.in_a_row;
    m.latest_ahead = m.latest_before_leap;
    m.several_ids = m.several_ids_before_leap;
  } else if (goes_back || m.in_a_row == 0) {
    m.in_a_row = 0;
    m.first_ahead = time;
    m.first_id = id;
    m.several_ids = false;
  }
  m.leapt = m.in_a_row > 0 && seconds_between(m.latest_ahead, time) > leap_;
  if (m.leapt) {
    m.latest_before_leap = m.latest_ahead;
    m.several_ids_before_leap = m.several_ids;
  }
  ++m.in_a_row;
  if (m.in_a_row == 1 || seconds_between(m.latest_ahead, time) > 0.0) m.latest_ahead = time;
  m.several_ids = m.several_ids || id != m.first_id;
  if (m.source == Source::arrivals) return seconds_between(m.first_ahead, time) != 0.0;
  constexpr std::size_t enough = 3, enough_with_leap = 6, enough_of_one = 10;
  if (m.leapt && !m.has_begun && m.in_a_row < enough_with_leap) return false;
  return m.in_a_row >= (m.several_ids || !others ? enough : enough_of_one);
}

}  // namespace kinesphere::program
