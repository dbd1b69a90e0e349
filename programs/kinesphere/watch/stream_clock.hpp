// What time it is in a stream, and which reports are believed to know.
#pragma once

#include <cstddef>
#include <deque>
#include <string>

#include "kinesphere/vec3.hpp"
#include "tracks/time_text.hpp"

namespace kinesphere::program {

/// later - earlier, in seconds.
double seconds_between(const FileTime& earlier, const FileTime& later);

/// Time goes on with the latest time told. One that leaps ahead by more than a limit is not believed until
/// others confirm it, so that one wrong clock does not turn all others' reports into old ones. So it is with
/// the first time of all.
class StreamClock {
 public:
  enum class Source {
    stamps,    ///< times of the reports
    arrivals,  ///< times at which they came in, as one clock tells them
  };

  StreamClock(Source source, double leap) : source_(source), leap_(leap) {}

  Source source() const { return source_; }
  void set_source(Source source) { source_ = source; }
  bool has_begun() const { return has_begun_; }
  const FileTime& now() const { return now_; }

  /// Whether a time is not ahead by more than the limit.
  bool believes(const FileTime& time) const { return has_begun_ && seconds_between(now_, time) <= leap_; }
  /// Goes on to a time that is believed, or known; never back.
  void go_on(const FileTime& time);

  /// A time that is not believed, of a track. Returns whether those that came one after the other, and no
  /// other time in between, now confirm each other: of stamps three of at least two tracks, or ten of one; of
  /// arrivals two that differ. `others` says whether there are tracks besides.
  bool confirms(const FileTime& time, const std::string& id, bool others);
  /// How many they are, this one included.
  std::size_t in_a_row() const { return in_a_row_; }
  /// Others have come in between.
  void interrupt() { in_a_row_ = 0; }

 private:
  Source source_;
  double leap_;
  bool has_begun_ = false;
  FileTime now_{};
  // Of the times that are not believed.
  std::size_t in_a_row_ = 0;
  FileTime first_ahead_{}, latest_ahead_{};
  std::string first_id_;
  bool several_ids_ = false;
};

}  // namespace kinesphere::program
