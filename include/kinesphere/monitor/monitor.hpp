// Monitor: certain statements about the separation of tracks that report irregularly.
//
//   Monitor monitor = Monitor::create({.classes = {{.acceleration_limit = 3.0}},
//                                      .separations = {{0, 0, {Separation::sphere(50.0)}}}}).value();
//   TrackReport report{.timestamp = 12.0, .state = {{0, 0, 100}, {20, 0, 0}}, .position_error = 3.0};
//   monitor.report(7, report).value();
//   // ... reports of other tracks, in the order in which they arrive
//   for (const MonitorEvent& event : monitor.events(12.5))
//     if (event.verdict == Verdict::undecided) ...  // the pair may be within 50 m from event.time on
//
// A World probes its bodies; a Monitor receives reports. Reports carry their own timestamps and errors, and
// may be late, out of order or missing. Between reports a track lies in a time-varying bound given by the
// limits of its class. At each time a pair of tracks and a separation have one of three verdicts: certainly
// apart, certainly within the separation, or undecided by the reports. The monitor emits an event at the time
// of each change of a verdict. It also names the track that has to report, and by when, for a verdict to stay
// certain. Where reports can be requested, the overloads with a Poll request as few as they can.
//
// Guarantee: no certain verdict is ever wrong, as long as (1) tracks keep the limits of their classes, and
// (2) among any three successive reports of a track at most one has larger errors than stated, and that one
// contradicts those before it. docs/monitoring.md states this precisely and proves it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kinesphere/callback.hpp"
#include "kinesphere/monitor/monitor_event.hpp"
#include "kinesphere/monitor/report.hpp"
#include "kinesphere/monitor/separation.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// The part of all pairs that one monitor watches. Several monitors that receive the same reports can divide
/// the pairs among themselves. A pair belongs to the shard whose number is the lower of its two ids modulo
/// `of`. Each monitor emits for its pairs exactly the events that a single monitor of all pairs would emit.
struct Shard {
  std::uint64_t of = 1;     ///< Number of shards, > 0.
  std::uint64_t first = 0;  ///< The monitor watches shards first, ..., first + count - 1.
  std::uint64_t count = 1;  ///< Number of watched shards, > 0; first + count <= of.

  /// Returns true if the monitor watches the pairs whose lower id is this one.
  bool contains(TrackId id) const { return id % of - first < count; }

  friend bool operator==(const Shard&, const Shard&) = default;
};

/// Parameters of a monitor.
struct MonitorDefinition {
  int dimensions = 3;  ///< 2 or 3. In two dimensions, z is ignored.
  /// Start time of the monitor, optional. Without it, the clock starts at the timestamp of the first report
  /// or at the first time passed to advance(), whichever comes first; until then time() is 0. Set it if
  /// timestamps may be later than the times passed to advance().
  std::optional<double> start_time{};
  /// Motion limits of the track classes; TrackReport::track_class is an index into this list.
  std::vector<TrackClass> classes{};
  /// Separations between classes. Pairs of classes that no rule names are not watched.
  std::vector<SeparationRule> separations{};
  /// Tolerance of Verdict::within (length, > 0): a pair is `within` if it is at most this far outside the
  /// separation. For a cylinder it applies in the plane and in height separately. No coordinate may exceed
  /// 2^41 times the tolerance. When polling, set it to at least twice the position errors of both tracks;
  /// only then does a report always decide the pair. For an ellipsoid that is taller than wide, multiply that
  /// by its ratio of height to width.
  double tolerance = 1e-3;
  /// Time resolution of verdicts (time, > 0), in [limits::least_time, limits::largest_time]. An undecided
  /// verdict that time alone decides becomes certain at most this late. A verdict that would be certain for
  /// less than this stays undecided. A certain verdict never lasts too long. Where doubles of the size of
  /// time() are coarser, 2^-50 of time() applies instead.
  double time_resolution = 1e-3;
  /// About the time between two reports of a track (time, > 0), in [limits::least_time,
  /// limits::largest_time], rounded down to a power of two. It affects speed, the horizon of needed(), and
  /// how often the reports of undecided pairs are requested: at its multiples. The region in which a track is
  /// looked for contains it for at least this time, and for longer where there is little around it.
  double window = 1.0;
  /// Ages of a track's latest report (time, > 0) at which the track becomes stale (MonitorEventKind::stale)
  /// and at which it is dropped (MonitorEventKind::dropped). Infinity, the default, disables them.
  double stale_after = std::numeric_limits<double>::infinity();
  double drop_after = std::numeric_limits<double>::infinity();
  /// A prediction ends once it has not held for this long (time, >= 0), so that it does not come and go with
  /// the errors of reports.
  double prediction_hold = 0.0;
  /// A prediction begins once it has held for this long without a break (time, >= 0), so that a single report
  /// makes none.
  double prediction_confirmation = 0.0;
  /// A prediction that has begun goes on while its closest approach is within the separation enlarged by this
  /// part of it (ratio, in [0, 1]), so that tracks about as far apart as the separation do not come and go.
  double prediction_margin = 0.0;
  /// Separations are enlarged for predictions by this part of the position errors of the latest reports of
  /// both tracks (ratio, in [0, 1]), so that two may come within the separation as far as their positions are
  /// known. With 0, reported positions count as they are.
  double prediction_error_part = 0.0;
  /// Pairs that this monitor watches, if other monitors watch the remaining ones.
  Shard shard{};

  friend bool operator==(const MonitorDefinition&, const MonitorDefinition&) = default;
};

/// Counts of the work that a monitor has done since it was created.
struct MonitorCounters {
  std::uint64_t reports = 0;  ///< Accepted reports, without repeated ones.
  std::uint64_t late = 0;  ///< Accepted reports with an older timestamp than an earlier report of the track.
  std::uint64_t repeated = 0;        ///< Reports that repeat an earlier one; they have no effect.
  std::uint64_t contradictions = 0;  ///< Reports that contradict all hypotheses of their track.
  std::uint64_t polls = 0;           ///< Requests for a track's report through a Poll.
  std::uint64_t searches = 0;        ///< Searches for the tracks around a new region of a hypothesis.
  std::uint64_t near_pairs = 0;      ///< Pairs that have come near each other by those searches.
  std::uint64_t rechecks = 0;        ///< Evaluations of a pair at one separation level.

  friend constexpr bool operator==(const MonitorCounters&, const MonitorCounters&) = default;
};

/// The verdict about two tracks and a separation now, and a forecast. Times are absolute.
struct PairAnswer {
  Verdict verdict = Verdict::apart;
  /// Time since which the verdict has held; -infinity for a pair that is apart at all levels.
  double since = 0.0;
  /// A certain verdict is true until this time, whatever is reported. A later call may return an earlier time
  /// if newer reports say less. An undecided verdict changes by the passing of time alone no earlier than
  /// this. In [time(), +infinity].
  double until = 0.0;
  /// Lower and upper limit of the distance now (length, >= 0). For a cylinder, of the distance in the plane.
  double lower = 0.0;
  double upper = 0.0;
  /// Closest approach if both tracks continue straight on from now: its distance (length) and its time. An
  /// estimate, not a bound. For a cylinder, the distance is that in the plane.
  double closest_distance = 0.0;
  double closest_time = 0.0;
  /// Horizontal and vertical part of the distance at that time (length), also if they continue straight on.
  double closest_horizontal = 0.0;
  double closest_vertical = 0.0;
  /// Speed of one relative to the other now (length / time). An estimate, not a bound.
  double relative_speed = 0.0;
  /// Time at which the tracks first are within the separation if they continue straight on from now;
  /// +infinity if they never are. An estimate, not a bound.
  double likely_time = 0.0;
  /// The pair certainly is within the separation (as for Verdict::within) at some time up to this one, now or
  /// ahead, whatever the tracks do within their limits: an inevitable collision state. +infinity if nothing
  /// certain is in sight. For Separation::Shape::well_clear, losses ahead are found only by the horizontal
  /// distance. Short stays within, of about MonitorDefinition::time_resolution, may be overlooked.
  double inevitable_by = 0.0;
  /// If both continue straight on until this time, no accelerations within their limits keep them out of the
  /// separation after it; now if it is too late already. +infinity if straight paths do not meet, and always
  /// for Separation::Shape::well_clear. An estimate, not a bound: errors of reports, largest speeds and
  /// planned accelerations do not count, and an evasion shortly before this time may still fail.
  double avoidable_until = 0.0;
  /// The track whose report would tighten the bounds most, and the time by which that report is needed for
  /// the verdict to stay certain. For an undecided pair that time is now.
  TrackId ask = 0;
  double ask_by = 0.0;
  /// True from MonitorEventKind::predicted to MonitorEventKind::prediction_ended.
  bool predicted = false;

  friend constexpr bool operator==(const PairAnswer&, const PairAnswer&) = default;
};

/// A pair that is not certainly apart at one separation level.
struct OpenPair {
  TrackId first = 0;
  TrackId second = 0;
  std::uint32_t level = 0;
  Verdict verdict = Verdict::undecided;
  double since = 0.0;

  friend constexpr bool operator==(const OpenPair&, const OpenPair&) = default;
};

/// A pair that is predicted to come within a separation (MonitorEventKind::predicted).
struct PredictedPair {
  TrackId first = 0;
  TrackId second = 0;
  std::uint32_t level = 0;
  double since = 0.0;  ///< Time of its event `predicted`.
  // As in MonitorEvent, from now.
  double likely_time = 0.0;
  double closest_time = 0.0;
  double closest_distance = 0.0;

  friend constexpr bool operator==(const PredictedPair&, const PredictedPair&) = default;
};

/// A request for a report of `track` by time `by`. Without the report, a verdict about `track` and `other`
/// turns undecided.
struct ReportRequest {
  TrackId track = 0;
  double by = 0.0;
  TrackId other = 0;

  friend constexpr bool operator==(const ReportRequest&, const ReportRequest&) = default;
};

/// What a monitor knows about a track now. The track certainly lies within `radius` of `centre` of one of the
/// `places`. There are several places only while reports contradict each other.
struct TrackView {
  TrackId id = 0;
  std::size_t track_class = 0;
  double timestamp = 0.0;  ///< Timestamp of the latest report.
  bool stale = false;
  /// A ball or a cylinder in which the track may be, and the velocity of its centre.
  struct Place {
    Vec3 centre{};
    Vec3 velocity{};
    ErrorBound radius{};

    friend bool operator==(const Place&, const Place&) = default;
  };
  std::vector<Place> places;

  friend bool operator==(const TrackView&, const TrackView&) = default;
};

/// Any callable `void(std::span<const TrackId> ids, double time, std::span<std::optional<TrackReport>>
/// reports)`. It fetches the latest reports of the tracks, with timestamps no later than `time`. An entry
/// that it leaves empty means that there is no newer report.
using Poll =
    Callback<void(std::span<const TrackId> ids, double time, std::span<std::optional<TrackReport>> reports)>;

class MonitorEventRange;

/// Tracks, their reports and the verdicts about their pairs.
///
/// Thread safety: one thread at a time may use a monitor; const calls may run concurrently with other const
/// calls. Errors: every call checks its arguments, and a call that returns an error has changed nothing.
/// Calls that change a monitor fail with probe_in_progress inside its own Poll, which may make all const
/// calls. A moved-from monitor returns moved_from, or throws BadResult from calls that return no Result or
/// that are const; it may be assigned to and destroyed.
class Monitor {
 public:
  /// Creates a monitor. Errors: not_finite or out_of_range, naming the field.
  [[nodiscard]] static Result<Monitor> create(const MonitorDefinition& definition);

  Monitor(Monitor&&) noexcept;
  Monitor& operator=(Monitor&&) noexcept;
  ~Monitor();

  /// Accepts a report that arrives at the current time. The first report of an id adds a track, and one of
  /// another class than before starts it anew (MonitorEventKind::reclassified). The next advance() emits the
  /// resulting events, at the current time. Errors: not_finite; out_of_range (a negative error, an unknown
  /// class, a coordinate too large, no velocity where the class has no largest speed). Cost: about that of a
  /// hash-table lookup, and a recheck of each open pair of the track. With look-ahead times, also a recheck
  /// of each track that may come near in that time.
  Result<void> report(TrackId id, const TrackReport& report);
  /// Returns the error that report() would return, and changes nothing. It depends on the definition alone:
  /// a batch of reports that have all passed can be taken without an error. Cost: O(1).
  Result<void> check_report(TrackId id, const TrackReport& report) const;
  /// Removes a track; the next advance() emits its `dropped` event. Errors: unknown_body.
  Result<void> remove(TrackId id);

  /// Advances to the next event, at most to time `until`. Returns the event, with time() at its time, or
  /// nothing, with time() == until. Events of one time come in the order of their kind, ids and level; an end
  /// counts as the kind that it ends, and what begins and ends for the same tracks keeps its order.
  /// Errors: time_backwards, not_finite, or out_of_range beyond limits::largest_time for `until`.
  Result<std::optional<MonitorEvent>> advance(double until);
  /// Advances as advance(until) does, and requests reports through `poll`: for a pair that is about to turn
  /// undecided it requests a report of one track and, if that is not enough, of the other one. With a
  /// tolerance as MonitorDefinition::tolerance recommends, no pair stays undecided while its tracks answer.
  /// Errors: null_probe; those of report() for the returned reports, whose tracks then count as not having
  /// answered.
  Result<std::optional<MonitorEvent>> advance(double until, const Poll& poll);
  /// Returns all events up to a time, for a range-for. Errors are thrown as BadResult.
  [[nodiscard]] MonitorEventRange events(double until) &;
  [[nodiscard]] MonitorEventRange events(double until, Poll poll) &;
  /// A temporary monitor would be gone before the loop began.
  MonitorEventRange events(double until) && = delete;
  MonitorEventRange events(double until, Poll poll) && = delete;

  /// Return the current time, the definition, and the counts of work so far.
  double time() const;
  const MonitorDefinition& definition() const;
  const MonitorCounters& counters() const;
  /// Returns the ids of all tracks, in ascending order.
  std::vector<TrackId> tracks() const;
  /// Return the number of tracks, and whether a track is known.
  std::size_t size() const;
  bool contains(TrackId id) const;
  /// Returns what is known about a track now. Errors: unknown_body.
  Result<TrackView> track(TrackId id) const;

  /// Returns the verdict about two tracks at one level, with its forecast. Errors: unknown_body; out_of_range
  /// for the same track twice, a level that the pair does not have, or a pair outside the watched shards.
  /// Cost: that of one recheck of the pair.
  Result<PairAnswer> answer(TrackId first, TrackId second, std::uint32_t level = 0) const;
  /// Returns the pairs that are not certainly apart, in the order of their ids and levels.
  std::vector<OpenPair> open_pairs() const;
  /// Returns the pairs that are predicted to come within a separation, in the order of their ids and levels.
  std::vector<PredictedPair> predicted_pairs() const;
  /// Returns the number of pairs that are not certainly apart.
  /// Each of them takes about 150 bytes, in addition to the memory of the tracks. Reports count from the next
  /// advance() on. Cost: O(1).
  std::size_t open_pair_count() const;
  /// Returns tracks whose removal reduces open_pair_count() to at most `pairs`: those with most open pairs
  /// first, and the lower id first among equals. Cost: O(tracks log tracks + open pairs).
  std::vector<TrackId> crowd(std::size_t pairs) const;
  /// Returns the reports that are needed by `until` so that no verdict turns undecided before, in the order
  /// of their times, each track once. Pairs are known only as long as both tracks stay in their regions.
  /// Cost: O(near pairs).
  std::vector<ReportRequest> needed(double until) const;

  /// Returns a snapshot of the whole monitor; a monitor that is restored from it continues identically. Cost:
  /// O(tracks + near pairs).
  std::vector<std::byte> save() const;
  /// Restores a monitor from a snapshot made by save(). Errors: bad_snapshot.
  static Result<Monitor> restore(std::span<const std::byte> snapshot);

 private:
  class Engine;
  explicit Monitor(std::unique_ptr<Engine> engine);
  Engine& engine(const char* call) const;
  Result<void> check_idle(const char* call) const;
  Result<std::optional<MonitorEvent>> go_on(double until, const Poll* poll);
  std::unique_ptr<Engine> engine_;
};

/// The events of a monitor up to a time, as an input range; the counterpart of EventRange.
class [[nodiscard]] MonitorEventRange {
 public:
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = MonitorEvent;
    using difference_type = std::ptrdiff_t;
    using pointer = const MonitorEvent*;
    using reference = const MonitorEvent&;

    Iterator() = default;
    explicit Iterator(MonitorEventRange& range) : range_(&range) {}
    const MonitorEvent& operator*() const { return *range_->event_; }
    const MonitorEvent* operator->() const { return &*range_->event_; }
    Iterator& operator++() {
      range_->go_on();
      return *this;
    }
    void operator++(int) { range_->go_on(); }
    bool operator==(std::default_sentinel_t) const { return !range_->event_; }

   private:
    MonitorEventRange* range_ = nullptr;
  };

  /// Monitor::events() makes a range.
  MonitorEventRange(Monitor& monitor, double until) : monitor_(&monitor), until_(until) {}
  MonitorEventRange(Monitor& monitor, double until, Poll poll)
      : monitor_(&monitor), until_(until), poll_(std::move(poll)) {}
  /// Advances to the first event.
  Iterator begin() {
    go_on();
    return Iterator(*this);
  }
  /// The end of every range.
  std::default_sentinel_t end() const { return {}; }

 private:
  void go_on() {
    event_ = poll_ ? monitor_->advance(until_, *poll_).value() : monitor_->advance(until_).value();
  }

  Monitor* monitor_;
  double until_;
  std::optional<Poll> poll_{};
  std::optional<MonitorEvent> event_;
};

inline MonitorEventRange Monitor::events(double until) & { return {*this, until}; }
inline MonitorEventRange Monitor::events(double until, Poll poll) & {
  return {*this, until, std::move(poll)};
}

}  // namespace kinesphere
