// What time it is in a stream, and which reports are believed to know.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

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

  /// All that it remembers.
  struct Memory {
    Source source = Source::stamps;
    bool has_begun = false;
    FileTime now{};
    // Of the times that are not believed.
    std::size_t in_a_row = 0;
    FileTime first_ahead{}, latest_ahead{};
    std::string first_id{};
    bool several_ids = false;
  };

  StreamClock(Source source, double leap) : leap_(leap), memory_{.source = source} {}

  Source source() const { return memory_.source; }
  void set_source(Source source) { memory_.source = source; }
  bool has_begun() const { return memory_.has_begun; }
  const FileTime& now() const { return memory_.now; }
  const Memory& memory() const { return memory_; }
  void recall(Memory memory) { memory_ = std::move(memory); }

  /// Whether a time is not ahead by more than the limit.
  bool believes(const FileTime& time) const { return has_begun() && seconds_between(now(), time) <= leap_; }
  /// Goes on to a time that is believed, or known; never back.
  void go_on(const FileTime& time);

  /// A time that is not believed, of a track. Returns whether those that came one after the other, and no
  /// other time in between, now confirm each other: of stamps three of at least two tracks, or ten of one; of
  /// arrivals two that differ. `others` says whether there are tracks besides.
  bool confirms(const FileTime& time, const std::string& id, bool others);
  /// How many they are, this one included.
  std::size_t in_a_row() const { return memory_.in_a_row; }
  /// Others have come in between.
  void interrupt() { memory_.in_a_row = 0; }

 private:
  double leap_;
  Memory memory_;
};

}  // namespace kinesphere::program
