// The clock of a watch: lets reports pass once their times are believed.
#pragma once

#include <vector>

#include "formats/fields/time_scale.hpp"
#include "watch/clock/stream_clock.hpp"
#include "watch/source/kept_report.hpp"
#include "watch/watch_counts.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// Says what time it is in a stream: by the arrivals or stamps of its reports, or by this machine. Reports
/// whose times nothing confirms yet are held back, and pass when others do.
class ReportClock {
 public:
  /// What comes behind the clock.
  class Next {
   public:
    virtual ~Next() = default;
    /// The time is now() of the clock.
    virtual void go_on() = 0;
    /// Receives a report that is neither too old nor ahead of now().
    virtual void deliver(const SourceReport& report) = 0;
    /// Receives why a report is malformed.
    virtual void refuse(const std::string& reason) = 0;
    /// True if reports of more than one track were delivered: then one alone confirms little.
    virtual bool has_several_tracks() const = 0;
  };

  /// All arguments must outlive the clock.
  ReportClock(const WatchSettings& settings, WatchCounts& counts, Next& next);

  void take(const SourceReport& report);
  /// Takes the time of arrival that the stream tells.
  void time_is(const FileTime& arrival, TimeKind kind);
  /// Takes the time of this machine's clock, in seconds since 1970.
  void machine_time_is(const FileTime& now);
  /// Call at the end of the stream: what is held back passes if nothing has passed before.
  void finish();

  bool has_begun() const { return clock_.has_begun(); }
  bool goes_by_stamps() const { return clock_.source() == StreamClock::Source::stamps; }
  // Times of the monitor (seconds). Precondition of the first two: the clock has begun.
  double now() const { return times_.seconds(clock_.now()); }
  double first() const { return times_.seconds(first_); }
  double seconds(const FileTime& time) const { return times_.seconds(time); }
  /// Returns how much older than now a stamp is; < 0 if it is ahead.
  double age_of(const FileTime& stamp) const { return seconds_between(stamp, clock_.now()); }
  const TimeScale& times() const { return times_; }

  static void serialize(auto& self, auto& archive) {
    TimeKind kind = self.times_.kind();
    StreamClock::Memory memory = self.clock_.memory();
    archive(memory, self.is_chosen_, self.held_, kind, self.first_);
    if constexpr (requires { self.clock_.recall(memory); }) {
      self.clock_.recall(memory);
      if (memory.has_begun) self.begin_times(self.first_, kind);
    }
  }

 private:
  /// Returns the time of a report by which the clock goes.
  const FileTime& time_of(const SourceReport& report) const {
    return !goes_by_stamps() && report.arrival ? *report.arrival : report.stamp;
  }
  void choose(bool has_arrivals);
  void go_on(const FileTime& time);
  void pass(const SourceReport& report);
  void hold(const SourceReport& report);
  void drop_held();
  void pass_held();
  void start(const FileTime& time, TimeKind kind);
  void begin_times(const FileTime& first, TimeKind kind);

  const WatchSettings& settings_;
  WatchCounts& counts_;
  Next& next_;
  StreamClock clock_;
  bool is_chosen_;  ///< whether it goes by stamps or arrivals
  std::vector<KeptReport> held_;
  TimeScale times_;
  FileTime first_{};  ///< time at which the stream begins
};

}  // namespace kinesphere::program
