// A watch: takes the reports of a stream, whatever its format, and tells what is certain.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "watch/alerts.hpp"
#include "watch/local_frame.hpp"
#include "watch/source_report.hpp"
#include "watch/stream_clock.hpp"
#include "watch/track_names.hpp"
#include "watch/watch_counts.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// Has all state of a watch but what a format keeps of the lines before.
class Watcher final : public ReportSink {
 public:
  /// `tell` gets alerts, lines with their ends, in the order of their times, and whose share each is.
  using Tell = std::function<void(std::uint64_t share, std::string_view alert)>;

  Watcher(WatchSettings settings, Tell tell);

  // Of formats. These throw ProgramError naming an option that has to be given.
  void take(const SourceReport& report) override;
  void time_is(const FileTime& arrival, TimeKind kind) override;
  void pass_over(Passed reason) override;
  void refuse(const std::string& reason) { refuse(line_, reason); }
  /// Throws ProgramError when there have been too many.
  void refuse(std::size_t line, const std::string& reason) override;

  /// What comes until end_record() stands in this line of the stream.
  void begin_record(std::size_t line) { line_ = line; }
  /// All that is certain by what was taken is told.
  void end_record();
  /// By the clock of this machine it is so late, seconds since 1970.
  void machine_time_is(const FileTime& now);
  /// The stream has ended.
  void finish();

  /// All of its state but the settings, and back: to a new one with the same settings. restore() throws
  /// ProgramError, or an exception of nlohmann::json, when that cannot be the state of a watch.
  nlohmann::json save() const;
  void restore(const nlohmann::json& state);

  const WatchSettings& settings() const { return settings_; }
  const WatchCounts& counts() const { return counts_; }
  /// Reports that the monitor has taken, and so on; zero before there is one.
  MonitorCounters monitor_counters() const { return monitor_ ? monitor_->counters() : MonitorCounters{}; }
  /// Empty before the first report has been taken.
  const std::optional<Monitor>& monitor() const { return monitor_; }
  const std::optional<LocalFrame>& frame() const { return frame_; }
  const TrackNames& names() const { return names_; }
  /// Needs a monitor.
  AlertContext context() const;
  /// From its first time to its last, as JSON; null before there is one.
  std::string first_time() const;
  std::string last_time() const;
  double time_covered() const;  ///< seconds

 private:
  struct HeldReport {
    std::string id;
    SourceReport report;
  };

  /// Whether the clock believes in a time, or does now; then what was held has been delivered.
  bool admit(const FileTime& time, const std::string& id, TimeKind kind);
  void hold(const SourceReport& report);
  void drop_held();
  void deliver_held();
  void start(const FileTime& time, TimeKind kind);
  void begin_times(const FileTime& first, TimeKind kind);
  /// It is so late: tells what is certain by then.
  void go_on(const FileTime& time);
  void deliver(const SourceReport& report);
  void begin_monitor(const SourceReport& report);
  void begin_map(const WatchSettings::Origin& origin);
  std::optional<TrackReport> on_map(const SourceReport& report, NamedTrack& track);
  void add_errors(const SourceReport& report, double added_velocity_error, TrackReport& result,
                  NamedTrack& track) const;
  double velocity_age_of(const SourceReport& report) const;
  double needed_bound(const FallbackError& fallback, const char* option) const;
  void advance(double until);
  /// Whether the limits allow another track.
  bool has_room() const;
  /// Removes the tracks in most open pairs, where more pairs are open than may be, until half of that are.
  void drop_crowd();
  void tell(const MonitorEvent& event);
  void count_and_tell(const MonitorEvent& event);

  WatchSettings settings_;
  Tell tell_;
  StreamClock clock_;
  bool clock_is_chosen_;
  std::vector<HeldReport> held_;
  TimeScale times_;
  FileTime first_{};
  double first_time_ = 0.0;
  std::optional<Monitor> monitor_;
  std::optional<LocalFrame> frame_;
  bool is_geographic_ = false;
  int dimensions_ = 3;
  TrackNames names_;
  std::set<TrackId> dropped_;  ///< of which has not been told yet that they leave
  WatchCounts counts_;
  std::size_t line_ = 0;
  std::set<std::string, std::less<>> declarations_;  ///< of a snapshot
};

}  // namespace kinesphere::program
