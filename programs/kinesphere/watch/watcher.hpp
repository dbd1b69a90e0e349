// A watch: takes the reports of a stream and emits certain alerts.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/streams/source_report.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "watch/alert_policy.hpp"
#include "watch/alerts.hpp"
#include "watch/local_frame.hpp"
#include "watch/same_bodies.hpp"
#include "watch/stream_clock.hpp"
#include "watch/track_groups.hpp"
#include "watch/track_names.hpp"
#include "watch/watch_counts.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// Holds the whole state of a watch, except the state that a format keeps from earlier lines.
class Watcher final : public ReportSink {
 public:
  /// Receives alerts, as lines with their ends and in order of time, with the share of each.
  using AlertFn = std::function<void(std::uint64_t share, std::string_view alert)>;

  Watcher(WatchSettings settings, AlertFn alert);

  // Functions for formats. They throw ProgramError naming an option that has to be given.
  void take(const SourceReport& report) override;
  void time_is(const FileTime& arrival, TimeKind kind) override;
  void pass_over(Passed reason) override;
  void refuse(const std::string& reason) { refuse(line_, reason); }
  void warn(const std::string& warning) override { warnings_.push_back(warning); }
  /// Counts a malformed record. Throws ProgramError if there have been too many.
  void refuse(std::size_t line, const std::string& reason) override;

  /// Sets the line of the stream for all calls until end_record().
  void begin_record(std::size_t line) { line_ = line; }
  /// Emits all alerts that are certain from the input so far.
  void end_record();
  /// Sets the present time of this machine's clock, in seconds since 1970.
  void machine_time_is(const FileTime& now);
  /// Call at the end of the stream.
  void finish();

  /// save() returns the whole state except the settings; restore() puts it into a new watcher with equal
  /// settings. restore() throws ProgramError, or an exception of nlohmann::json, if this is not the state of
  /// a watch.
  nlohmann::json save() const;
  void restore(const nlohmann::json& state);

  const WatchSettings& settings() const { return settings_; }
  const WatchCounts& counts() const { return counts_; }
  /// Counts of reports and so on; zero before there is a monitor.
  MonitorCounters monitor_counters() const { return monitor_ ? monitor_->counters() : MonitorCounters{}; }
  /// Returns the warnings about the stream since the last call.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }
  /// True if a report had a height that does not count, since the first report had none.
  bool ignores_heights() const { return ignores_heights_; }
  /// Returns the number of pairs of which nothing is told because reports have not shown yet whether they are
  /// one body.
  std::size_t undecided_bodies() const;
  /// Empty before the first report has been taken.
  const std::optional<Monitor>& monitor() const { return monitor_; }
  const std::optional<LocalFrame>& frame() const { return frame_; }
  const TrackNames& names() const { return names_; }
  /// Precondition: there is a monitor.
  AlertContext context() const;
  /// First and last time as JSON; null before there is one.
  std::string first_time() const;
  std::string last_time() const;
  double time_covered() const;  ///< seconds

 private:
  struct HeldReport {
    std::string id, name;
    SourceReport report;
  };

  /// Returns the time of a report by which the clock goes.
  const FileTime& clock_time(const SourceReport& report) const {
    return clock_.source() == StreamClock::Source::arrivals && report.arrival ? *report.arrival
                                                                              : report.stamp;
  }
  /// Takes a report whose id is that of its body (Identities).
  void take_of_body(const SourceReport& report);
  void hold(const SourceReport& report);
  void drop_held();
  void deliver_held();
  void start(const FileTime& time, TimeKind kind);
  void begin_times(const FileTime& first, TimeKind kind);
  /// Moves time on, and emits alerts that are certain by then.
  void go_on(const FileTime& time);
  void deliver(const SourceReport& report);
  static bool knows_velocity(const SourceReport& report);
  bool lacks_height(const SourceReport& report) const { return dimensions_ == 3 && !report.has_height; }
  void refuse_without_velocity();
  bool is_usable(const SourceReport& report, const NamedTrack* known, const NamedTrack& track);
  void remember(TrackId id, const SourceReport& report, NamedTrack& named, const NamedTrack& track,
                const TrackReport& on_map, bool is_first);
  void begin_monitor(const SourceReport& report);
  void begin_map(const WatchSettings::Origin& origin);
  /// `track` has the class of the report.
  std::optional<TrackReport> on_map(const SourceReport& report, NamedTrack& track);
  void add_errors(const SourceReport& report, double added_velocity_error, TrackReport& result,
                  NamedTrack& track) const;
  AlertFate fate_of(MonitorEvent& event);
  bool is_in_area(TrackId track) const;
  void begin_areas();
  void write(std::uint64_t share, std::string_view line);
  void write_refused(double time);
  void report_lost(const MonitorEvent& event);
  void enter_area(TrackId track);
  bool is_in_area(const AlertPolicy::Key& pair) const;
  std::optional<AlertFate> hold_of(const MonitorEvent& event) const;
  std::optional<AlertFate> hold_of(TrackId first, TrackId second) const;
  void begin_bodies();
  void compare_bodies(TrackId track, Sighting& seen, const TrackReport& report, bool is_first);
  void note_rest(TrackId id, NamedTrack& track, const SourceReport& report, const TrackReport& on_map,
                 bool is_first);
  void release_from(TrackId later);
  void release(TrackId track);
  void release_due();
  void report_one_body(const SameBodies::Change::Pair& pair);
  void give_up_until(double time);
  void hand_over(const SameBodies::GivenUp& given_up);
  void leave(TrackId track);
  TrackGroups::Cutting cutting() const;
  bool watch_as_group(const SourceReport& report, TrackId id, const TrackReport& on_map,
                      const NamedTrack& track);
  void begin_group(const TrackGroups::Outcome& outcome);
  void end_group(const TrackGroups::Cell& group);
  std::string group_name(const TrackGroups::Cell& group) const;
  void remove(TrackId track, const LeftFor& left_for);
  const MotionLimits& limits_of(const NamedTrack& track) const {
    return settings_.classes[track.motion_class].limits;
  }
  double velocity_age_of(const SourceReport& report) const;
  /// True if the report is from before its track had its present class, or would change it from the past.
  static bool is_superseded(const SourceReport& report, const NamedTrack& known, std::size_t motion_class);
  double needed_bound(const FallbackError& fallback, const char* option) const;
  void advance(double until);
  /// Returns true if the limits allow another track.
  bool has_room() const;
  /// Removes the tracks in most open pairs if there are too many open pairs, until half of the limit is left.
  void drop_crowd();
  void report(const MonitorEvent& event);
  void count_and_report(MonitorEvent event);

  WatchSettings settings_;
  AlertFn alert_;
  AlertPolicy policy_;
  StreamClock clock_;
  bool clock_is_chosen_;
  std::vector<HeldReport> held_;
  TimeScale times_;
  FileTime first_{};
  double first_time_ = 0.0;
  std::optional<Monitor> monitor_;
  std::optional<LocalFrame> frame_;
  struct Circle {
    Vec3 centre{};
    double radius = 0.0;
  };
  std::vector<Circle> areas_;  ///< WatchSettings::areas in the plane of the monitor
  bool is_geographic_ = false;
  int dimensions_ = 3;
  TrackNames names_;
  RestRule rest_;
  std::vector<TrackId> to_release_;  ///< tracks of which pairs are held no more, during a report
  /// Why tracks were removed whose alerts are still to come.
  std::map<TrackId, LeftFor> removed_;
  std::optional<SameBodies> bodies_;   ///< from the first report on, unless each id counts as a body
  std::optional<TrackGroups> groups_;  ///< from the first report on
  double next_forgetting_ = 0.0;       ///< time at which the stale members of groups are forgotten
  std::map<TrackId, TrackGroups::Cell> group_tracks_;  ///< the tracks that stand for groups
  WatchCounts counts_;
  std::vector<std::string> warnings_;
  bool ignores_heights_ = false;
  std::size_t line_ = 0;
};

}  // namespace kinesphere::program
