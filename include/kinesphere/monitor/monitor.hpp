// A monitor: what is certain about the separation of things that report when they like.
//
//   Monitor monitor = Monitor::create({.classes = {{.acceleration_limit = 3.0}},
//                                      .separations = {{0, 0, {Separation::sphere(50.0)}}}}).value();
//   monitor.report(7, {.stamp = 12.0, .state = {{0, 0, 100}, {20, 0, 0}}, .position_error = 3.0}).value();
//   // ... others, as they come in
//   for (const MonitorEvent& event : monitor.events(12.5))
//     if (event.verdict == Verdict::undecided) ...  // may be within 50 m from event.time on
//
// A world asks; a monitor is told. Reports come with their own times and errors, late, out of order or not at
// all. Between them a track is somewhere in a time-varying bound, as its class promises, and at each time
// three answers are possible for two tracks and a separation: they certainly are apart, they certainly are
// within it, or the reports leave it open. The monitor tells of each change of the answer, at the time when
// it changes, and says who would have to report, by when, to keep it decided. Where reports can be asked for,
// it asks: for as few as it can (the calls with a Poll).
//
// The guarantee: as long as tracks keep the promises of their classes, and of any three successive reports of
// a track at most one is farther off than it says and that one contradicts those before, no answer called
// certain is ever wrong. docs/monitoring.md says what that means, and proves it.
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

/// Several monitors that are told the same may divide the pairs among themselves: a pair belongs to the share
/// that is the lower of its two ids modulo `of`. What each tells of its pairs is what one monitor would tell
/// that watches all.
struct Shard {
  std::uint64_t of = 1;     ///< > 0
  std::uint64_t first = 0;  ///< watched are the shares first, ..., first + count - 1
  std::uint64_t count = 1;  ///< > 0; first + count <= of

  bool contains(TrackId id) const { return id % of - first < count; }

  friend bool operator==(const Shard&, const Shard&) = default;
};

struct MonitorDefinition {
  int dimensions = 3;  ///< 2 or 3; in two dimensions z is ignored
  /// The time at which the monitor starts. Without one it starts at the stamp of the first report or at the
  /// first time that it is advanced to, whichever comes first; until then time() is 0. Give one where stamps
  /// may be ahead of the times that you advance to.
  std::optional<double> start_time{};
  /// What promises there are: TrackReport::track_class is a place in this list.
  std::vector<TrackClass> classes{};
  /// Pairs of classes that are not named here are not watched.
  std::vector<SeparationRule> separations{};
  /// Within a separation means: no farther outside of it than this (length, > 0); of a cylinder, in the plane
  /// and in height each. No coordinate may be larger than 2^41 times the tolerance. Who polls (below) should
  /// let it be at least twice the position errors of both tracks: only then can a report always decide. (For
  /// an ellipsoid that is taller than wide: so many times that, as it is taller.)
  double tolerance = 1e-3;
  /// An answer that can become certain by the passing of time alone does so at most this late (time, > 0),
  /// and one that could stay certain for less than this does not become so. Answers never are certain too
  /// long. In [limits::least_time, limits::largest_time]; where numbers of the size of time() are less exact,
  /// 2^-50 of time() counts instead.
  double time_resolution = 1e-3;
  /// How far ahead pairs are looked for (time, > 0): about the time between two reports of a track. It
  /// matters for speed, and for needed(), alone; it is rounded down to a power of two. In
  /// [limits::least_time, limits::largest_time]; while nothing is reported, pairs are looked for farther and
  /// farther ahead.
  double window = 1.0;
  /// A track of which nothing is heard for so long is told of, and for so long leaves (time, > 0).
  double stale_after = std::numeric_limits<double>::infinity();
  double drop_after = std::numeric_limits<double>::infinity();
  /// Which pairs are watched, where others watch the rest.
  Shard shard{};
};

/// What a monitor has done so far.
struct MonitorCounters {
  std::uint64_t reports = 0;         ///< that were taken
  std::uint64_t late = 0;            ///< of them, with an older stamp than one before of the same track
  std::uint64_t repeated = 0;        ///< the same as one before
  std::uint64_t contradictions = 0;  ///< reports that contradict those before
  std::uint64_t polls = 0;           ///< tracks that were asked
  std::uint64_t windows = 0;         ///< that have started
  std::uint64_t searches = 0;        ///< for tracks near one
  std::uint64_t near_pairs = 0;      ///< that searches have found
  std::uint64_t rechecks = 0;        ///< at what is certain of a pair
};

/// What is certain of two tracks and a separation now, and what may come.
struct PairAnswer {
  Verdict verdict = Verdict::apart;
  /// From when on it was so: of a pair that is apart at all levels, -infinity.
  double since = 0.0;
  /// A certain verdict is true until then, whatever is reported; it may be told to end sooner, where reports
  /// that come say less. An undecided one may be decided by the passing of time no earlier than this. In
  /// [time(), +infinity].
  double until = 0.0;
  /// Limits of the distance now (length). For a cylinder that in the plane.
  double lower = 0.0;
  double upper = 0.0;
  /// If both went on as reported: the least distance from now on, and when. +infinity, and never, if the
  /// paths say nothing.
  double closest_distance = 0.0;
  double closest_time = 0.0;
  /// If both went on as reported: when they would first be within the separation; +infinity if not at all.
  double likely_time = 0.0;
  /// Whose report would tell most, and by when it is needed for the verdict to stay certain; of an undecided
  /// pair that is now.
  TrackId ask = 0;
  double ask_by = 0.0;
};

/// A pair that is not certainly apart.
struct OpenPair {
  TrackId first = 0;
  TrackId second = 0;
  std::uint32_t level = 0;
  Verdict verdict = Verdict::undecided;
  double since = 0.0;
};

/// A report that is needed: without it something about the two turns undecided.
struct ReportRequest {
  TrackId track = 0;
  double by = 0.0;
  TrackId other = 0;
};

/// What a monitor knows of a track now. It certainly is within `radius` of `centre` or, where reports
/// contradict each other, of one of these places.
struct TrackView {
  TrackId id = 0;
  std::size_t track_class = 0;
  double timestamp = 0.0;  ///< of its latest report
  bool stale = false;
  struct Place {
    Vec3 centre{};
    Vec3 velocity{};
    ErrorBound radius{};
  };
  std::vector<Place> places;
};

/// Any callable `void(std::span<const TrackId> ids, double time, std::span<std::optional<TrackReport>>
/// reports)`: asks tracks for their latest reports, stamped no later than `time`. Where it leaves a report
/// empty there is nothing newer.
using Poll =
    Callback<void(std::span<const TrackId> ids, double time, std::span<std::optional<TrackReport>> reports)>;

class MonitorEventRange;

/// One thread at a time may use a monitor; const calls may run at the same time as other const calls. Every
/// call checks what it is handed, and one that returns an error has changed nothing. Calls that change a
/// monitor fail with probe_in_progress inside its own Poll, which may ask it everything else. A monitor that
/// has been moved from answers with moved_from, or throws BadResult where a call returns no Result or answers
/// a question; it may be assigned to and destroyed.
class Monitor {
 public:
  /// Errors: not_finite or out_of_range, naming the field.
  [[nodiscard]] static Result<Monitor> create(const MonitorDefinition& definition);

  Monitor(Monitor&&) noexcept;
  Monitor& operator=(Monitor&&) noexcept;
  ~Monitor();

  /// Takes a report that has come in at the current time. The first one of an id makes a track. What changes
  /// by it is told by the next advance(), at the current time. Errors: not_finite, out_of_range (a negative
  /// error, an unknown class or another than before, a coordinate too large, no velocity where the class has
  /// no largest speed). Cost: about that of a hash table's look-up, and a look at each open pair of the
  /// track.
  Result<void> report(TrackId id, const TrackReport& report);
  /// The track leaves. Errors: unknown_body.
  Result<void> remove(TrackId id);

  /// Goes on to the next event, at most to time `until`. Returns it, with time() at its time, or nothing,
  /// with time() == until. Events of one time come in the order of their fields. Errors: time_backwards,
  /// not_finite, or out_of_range beyond limits::largest_time for `until`.
  Result<std::optional<MonitorEvent>> advance(double until);
  /// The same, and asks for reports: of a pair that is about to turn undecided for that of one of the two
  /// and, if that is not enough, of the other. So with a tolerance as MonitorDefinition has it nothing stays
  /// undecided that can be asked for. Errors: null_probe; those of report() for what comes back, whose track
  /// is then taken as not having answered.
  Result<std::optional<MonitorEvent>> advance(double until, const Poll& poll);
  /// All events up to a time, for a range-for. Errors are thrown as BadResult.
  [[nodiscard]] MonitorEventRange events(double until);
  [[nodiscard]] MonitorEventRange events(double until, Poll poll);

  double time() const;
  const MonitorDefinition& definition() const;
  const MonitorCounters& counters() const;
  /// Tracks that there are, by number.
  std::vector<TrackId> tracks() const;
  std::size_t size() const;
  bool contains(TrackId id) const;
  /// Errors: unknown_body.
  Result<TrackView> track(TrackId id) const;

  /// What is certain of two tracks. Errors: unknown_body; out_of_range for the same track twice, a level that
  /// the two do not have, or a pair of another share. Cost: that of a look at the pair; O(pairs that are
  /// near) where the latest reports alone leave open what was certified before.
  Result<PairAnswer> answer(TrackId first, TrackId second, std::uint32_t level = 0) const;
  /// Pairs that are not certainly apart, by their ids and levels.
  std::vector<OpenPair> open_pairs() const;
  /// Pairs of tracks that are not certainly apart, or were not at some time of the present window: what takes
  /// memory besides the tracks, about 200 bytes each. Reports count from the next advance() on. Cost: O(1).
  std::size_t open_pair_count() const;
  /// Tracks without which open_pair_count() is at most `pairs`: those with most open pairs first, of equal
  /// ones the lower id. Cost: O(tracks log tracks + open pairs).
  std::vector<TrackId> crowd(std::size_t pairs) const;
  /// Whose reports are needed by `until` so that nothing turns undecided before, in the order of those times,
  /// each track once. Pairs are known ahead until the window ends, no further. Cost: O(pairs that are near).
  std::vector<ReportRequest> needed(double until) const;

  /// The whole monitor as bytes; one that is restored from them goes on as this one does. Cost: O(tracks).
  std::vector<std::byte> save() const;
  /// Errors: bad_snapshot.
  static Result<Monitor> restore(std::span<const std::byte> snapshot);

 private:
  class Engine;
  explicit Monitor(std::unique_ptr<Engine> engine);
  Engine& engine(const char* call) const;
  Result<void> check_idle(const char* call) const;
  Result<std::optional<MonitorEvent>> go_on(double until, const Poll* poll);
  std::unique_ptr<Engine> engine_;
};

/// The events of a monitor up to a time: as EventRange.
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

  MonitorEventRange(Monitor& monitor, double until, std::optional<Poll> poll)
      : monitor_(&monitor), until_(until), poll_(std::move(poll)) {}
  Iterator begin() {
    go_on();
    return Iterator(*this);
  }
  std::default_sentinel_t end() const { return {}; }

 private:
  void go_on() {
    event_ = poll_ ? monitor_->advance(until_, *poll_).value() : monitor_->advance(until_).value();
  }

  Monitor* monitor_;
  double until_;
  std::optional<Poll> poll_;
  std::optional<MonitorEvent> event_;
};

inline MonitorEventRange Monitor::events(double until) { return {*this, until, std::nullopt}; }
inline MonitorEventRange Monitor::events(double until, Poll poll) { return {*this, until, std::move(poll)}; }

}  // namespace kinesphere
