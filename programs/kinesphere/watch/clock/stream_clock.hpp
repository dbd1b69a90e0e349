// The present time of a stream, protected from wrong clocks.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "formats/fields/time_text.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

/// Follows the latest reported time. A time that leaps ahead by more than a limit, and the first time, counts
/// only after others confirm it, so that one wrong clock does not make all other reports old.
class StreamClock {
 public:
  enum class Source {
    stamps,    ///< times of the reports
    arrivals,  ///< arrival times by one clock
  };

  /// The complete state.
  struct Memory {
    Source source = Source::stamps;
    bool has_begun = false;
    FileTime now{};
    // Count of consecutive unconfirmed times.
    std::size_t in_a_row = 0;
    FileTime first_ahead{}, latest_ahead{};
    std::string first_id{};
    bool several_ids = false;
    // The latest of these times is ahead of those before it by more than the limit.
    bool leapt = false;
    FileTime latest_before_leap{};
    bool several_ids_before_leap = false;
  };

  StreamClock(Source source, double leap) : leap_(leap), memory_{.source = source} {}

  Source source() const { return memory_.source; }
  void set_source(Source source) { memory_.source = source; }
  bool has_begun() const { return memory_.has_begun; }
  const FileTime& now() const { return memory_.now; }
  const Memory& memory() const { return memory_; }
  void recall(Memory memory) { memory_ = std::move(memory); }

  /// Returns true if a time is not ahead by more than the limit.
  bool believes(const FileTime& time) const { return has_begun() && seconds_between(now(), time) <= leap_; }
  /// Moves the clock to an accepted time; never backwards.
  void go_on(const FileTime& time);

  /// Adds an unconfirmed time of a track. Returns true if consecutive times, with no accepted one in between,
  /// confirm each other: three timestamps of at least two tracks, or ten of one; or two arrivals that differ.
  /// They must come in order, but for the limit of leaps; how far apart they are does not count, as a stream
  /// may be sparse. `others`: there are more tracks. The first times of a stream, before it has begun, need
  /// more: a latest one that is ahead of the others by more than the limit does not confirm them before six,
  /// and does not count where one behind it goes on with those before.
  bool confirms(const FileTime& time, const std::string& id, bool others);
  /// Returns false for a time that is ahead of all that confirm each other.
  bool is_confirmed(const FileTime& time) const {
    return seconds_between(memory_.latest_ahead, time) <= leap_;
  }
  /// Number of consecutive unconfirmed times, this one included.
  std::size_t in_a_row() const { return memory_.in_a_row; }
  /// Resets the count because an accepted time came in between.
  void interrupt() { memory_.in_a_row = 0; }

 private:
  double leap_;
  Memory memory_;
};

}  // namespace kinesphere::program
