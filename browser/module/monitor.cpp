// Monitors: definitions, reports, events, answers, snapshots.
#include <limits>

#include "exchange.hpp"
#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere::browser {
namespace {

// Returns true if the JavaScript function returned, and false if it threw.
KINESPHERE_IMPORT(poll)
bool javascript_poll(std::size_t count, const double* ids, double time, double* reports);

/// Reads numbers one after the other.
class Numbers {
 public:
  explicit Numbers(const double* next) : next_(next) {}
  double number() { return *next_++; }
  bool flag() { return number() != 0.0; }
  template <class Whole>
  Whole whole() {
    return static_cast<Whole>(number());
  }
  Vec3 vector() {
    const Vec3 read = vector_at(next_);
    next_ += 3;
    return read;
  }
  /// Three numbers: 0 and a radius, or 1, the horizontal and the vertical limit.
  ErrorBound bound() {
    const bool is_cylinder = flag();
    const double horizontal = number(), vertical = number();
    return is_cylinder ? ErrorBound::cylinder(horizontal, vertical) : ErrorBound(horizontal);
  }

 private:
  const double* next_;
};

/// Reads what monitorNumbers() in package/src/monitor_definition.ts writes.
MonitorDefinition monitor_definition_at(const double* at) {
  Numbers numbers(at);
  MonitorDefinition definition;
  definition.dimensions = numbers.whole<int>();
  const bool starts = numbers.flag();
  const double start_time = numbers.number();
  if (starts) definition.start_time = start_time;
  for (double* const field :
       {&definition.tolerance, &definition.time_resolution, &definition.window, &definition.stale_after,
        &definition.drop_after, &definition.prediction_hold, &definition.prediction_confirmation,
        &definition.prediction_margin, &definition.prediction_error_part})
    *field = numbers.number();
  definition.shard.of = numbers.whole<std::uint64_t>();
  definition.shard.first = numbers.whole<std::uint64_t>();
  definition.shard.count = numbers.whole<std::uint64_t>();
  definition.classes.resize(numbers.whole<std::size_t>());
  definition.separations.resize(numbers.whole<std::size_t>());
  for (TrackClass& one : definition.classes) {
    one.acceleration_limit = numbers.bound();
    one.planned_acceleration = numbers.vector();
    one.largest_speed = numbers.bound();
  }
  for (SeparationRule& rule : definition.separations) {
    rule.first_class = numbers.whole<std::size_t>();
    rule.second_class = numbers.whole<std::size_t>();
    rule.levels.resize(numbers.whole<std::size_t>());
    for (Separation& level : rule.levels) {
      level.shape = static_cast<Separation::Shape>(numbers.whole<int>());
      level.horizontal = numbers.number();
      level.vertical = numbers.number();
      level.look_ahead = numbers.number();
      level.modified_tau = numbers.number();
    }
  }
  return definition;
}

void answer_with(std::initializer_list<double> numbers) {
  answer().insert(answer().end(), numbers.begin(), numbers.end());
}

/// Answers what Numbers::bound() reads.
void answer_bound(const ErrorBound& bound) {
  const bool is_ball = bound == ErrorBound(bound.horizontal());
  answer_with({is_ball ? 0.0 : 1.0, bound.horizontal(), bound.vertical()});
}

double number_of_track(TrackId id) { return static_cast<double>(id); }
TrackId track_of(double number) { return static_cast<TrackId>(number); }

void answer_tracks(std::span<const TrackId> ids) {
  answer().clear();
  for (const TrackId id : ids) answer().push_back(number_of_track(id));
}

/// Size of a report in numbers; putReport() in package/src/report.ts writes them. The first one is the id of
/// the track or, in a reply to a poll, 1 if there is a report.
constexpr std::size_t report_numbers = 24;
TrackReport report_at(const double* at) {
  Numbers numbers(at + 1);
  TrackReport report;
  report.timestamp = numbers.number();
  report.state.position = numbers.vector();
  report.state.velocity = numbers.vector();
  report.position_error = numbers.bound();
  report.velocity_error = numbers.bound();
  report.timestamp_error = numbers.number();
  report.track_class = numbers.whole<std::size_t>();
  const bool has_plan = numbers.flag();
  const Vec3 acceleration = numbers.vector();
  const ErrorBound limit = numbers.bound();
  if (has_plan) report.plan = {acceleration, limit, numbers.number()};
  return report;
}

/// Calls the package's poll function. If it throws, the first report has no timestamp, and the monitor
/// refuses it; the package rethrows the exception.
void poll_javascript(std::span<const TrackId> ids, double time,
                     std::span<std::optional<TrackReport>> reports) {
  std::vector<double> numbers;
  for (const TrackId id : ids) numbers.push_back(number_of_track(id));
  std::vector<double> replies(report_numbers * ids.size(), 0.0);
  if (!javascript_poll(ids.size(), numbers.data(), time, replies.data())) {
    reports.front().emplace().timestamp = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (const double* const reply = replies.data() + report_numbers * k; reply[0] != 0.0)
      reports[k] = report_at(reply);
}

/// Answers the numbers that the class MonitorEvent in package/src/monitor_event.ts reads.
void answer_event_of(const MonitorEvent& event) {
  answer_with({event.time, static_cast<double>(event.kind), number_of_track(event.first),
               number_of_track(event.second), static_cast<double>(event.level),
               static_cast<double>(event.verdict), static_cast<double>(event.before), event.since,
               event.likely_time, event.closest_time, event.closest_distance, event.position_excess,
               event.velocity_excess});
}

Monitor* handle_of(Result<Monitor> monitor) {
  return is_good(monitor) ? new Monitor(std::move(*monitor)) : nullptr;
}

}  // namespace

KINESPHERE_EXPORT(monitor_create) Monitor* monitor_create(const double* definition) {
  return handle_of(Monitor::create(monitor_definition_at(definition)));
}
KINESPHERE_EXPORT(monitor_restore) Monitor* monitor_restore(const std::byte* snapshot, std::size_t size) {
  return handle_of(Monitor::restore({snapshot, size}));
}
KINESPHERE_EXPORT(monitor_free) void monitor_free(Monitor* monitor) { delete monitor; }
KINESPHERE_EXPORT(monitor_save) void monitor_save(const Monitor* monitor) {
  answer_bytes() = monitor->save();
}

/// Answers what monitor_definition_at() reads.
KINESPHERE_EXPORT(monitor_definition) void monitor_definition(const Monitor* monitor) {
  const MonitorDefinition& definition = monitor->definition();
  answer().clear();
  answer_with({static_cast<double>(definition.dimensions), definition.start_time ? 1.0 : 0.0,
               definition.start_time.value_or(0.0), definition.tolerance, definition.time_resolution,
               definition.window, definition.stale_after, definition.drop_after, definition.prediction_hold,
               definition.prediction_confirmation, definition.prediction_margin,
               definition.prediction_error_part, static_cast<double>(definition.shard.of),
               static_cast<double>(definition.shard.first), static_cast<double>(definition.shard.count),
               static_cast<double>(definition.classes.size()),
               static_cast<double>(definition.separations.size())});
  for (const TrackClass& one : definition.classes) {
    answer_bound(one.acceleration_limit);
    answer_with({one.planned_acceleration.x, one.planned_acceleration.y, one.planned_acceleration.z});
    answer_bound(one.largest_speed);
  }
  for (const SeparationRule& rule : definition.separations) {
    answer_with({static_cast<double>(rule.first_class), static_cast<double>(rule.second_class),
                 static_cast<double>(rule.levels.size())});
    for (const Separation& level : rule.levels)
      answer_with({static_cast<double>(level.shape), level.horizontal, level.vertical, level.look_ahead,
                   level.modified_tau});
  }
}

/// Accepts all reports or, on an error, none.
KINESPHERE_EXPORT(monitor_report)
bool monitor_report(Monitor* monitor, std::size_t count, const double* numbers) {
  for (std::size_t k = 0; count > 1 && k < count; ++k) {
    const double* const at = numbers + report_numbers * k;
    if (!is_good(monitor->check_report(track_of(at[0]), report_at(at)))) return false;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const double* const at = numbers + report_numbers * k;
    if (!is_good(monitor->report(track_of(at[0]), report_at(at)))) return false;
  }
  return true;
}
KINESPHERE_EXPORT(monitor_remove) bool monitor_remove(Monitor* monitor, double id) {
  return is_good(monitor->remove(track_of(id)));
}

/// Returns 0 if there is no event until then; 1 if it is in answer(); -1 for an error.
KINESPHERE_EXPORT(monitor_advance) int monitor_advance(Monitor* monitor, double until, bool polls) {
  const auto event =
      polls ? monitor->advance(until, static_cast<Poll::Function>(poll_javascript)) : monitor->advance(until);
  if (!is_good(event)) return -1;
  answer().clear();
  if (*event) answer_event_of(**event);
  return *event ? 1 : 0;
}
/// Answers all events until then.
KINESPHERE_EXPORT(monitor_run) bool monitor_run(Monitor* monitor, double until) {
  answer().clear();
  while (true) {
    const auto event = monitor->advance(until);
    if (!is_good(event)) return false;
    if (!*event) return true;
    answer_event_of(**event);
  }
}

KINESPHERE_EXPORT(monitor_time) double monitor_time(const Monitor* monitor) { return monitor->time(); }
KINESPHERE_EXPORT(monitor_size) std::size_t monitor_size(const Monitor* monitor) { return monitor->size(); }
KINESPHERE_EXPORT(monitor_contains) bool monitor_contains(const Monitor* monitor, double id) {
  return monitor->contains(track_of(id));
}
KINESPHERE_EXPORT(monitor_tracks) void monitor_tracks(const Monitor* monitor) {
  answer_tracks(monitor->tracks());
}
KINESPHERE_EXPORT(monitor_counters) void monitor_counters(const Monitor* monitor) {
  const MonitorCounters& counters = monitor->counters();
  answer().clear();
  for (const std::uint64_t count :
       {counters.reports, counters.late, counters.repeated, counters.contradictions, counters.polls,
        counters.searches, counters.near_pairs, counters.rechecks})
    answer().push_back(static_cast<double>(count));
}

/// Answers class, timestamp, stale, and nine numbers for each place: centre, velocity, radius.
KINESPHERE_EXPORT(monitor_track) bool monitor_track(const Monitor* monitor, double id) {
  const auto view = monitor->track(track_of(id));
  if (!is_good(view)) return false;
  answer() = {static_cast<double>(view->track_class), view->timestamp, view->stale ? 1.0 : 0.0};
  for (const auto& [centre, velocity, radius] : view->places)
    answer_with({centre.x, centre.y, centre.z, velocity.x, velocity.y, velocity.z, radius.horizontal(),
                 radius.vertical(), radius.total()});
  return true;
}

KINESPHERE_EXPORT(monitor_answer)
bool monitor_answer(const Monitor* monitor, double first, double second, std::uint32_t level) {
  const auto pair = monitor->answer(track_of(first), track_of(second), level);
  if (!is_good(pair)) return false;
  answer() = {static_cast<double>(pair->verdict),
              pair->since,
              pair->until,
              pair->lower,
              pair->upper,
              pair->closest_distance,
              pair->closest_time,
              pair->closest_horizontal,
              pair->closest_vertical,
              pair->relative_speed,
              pair->likely_time,
              pair->inevitable_by,
              pair->avoidable_until,
              number_of_track(pair->ask),
              pair->ask_by,
              pair->predicted ? 1.0 : 0.0};
  return true;
}

/// Answers five numbers for each pair.
KINESPHERE_EXPORT(monitor_open_pairs) void monitor_open_pairs(const Monitor* monitor) {
  answer().clear();
  for (const OpenPair& pair : monitor->open_pairs())
    answer_with({number_of_track(pair.first), number_of_track(pair.second), static_cast<double>(pair.level),
                 static_cast<double>(pair.verdict), pair.since});
}
/// Answers seven numbers for each pair.
KINESPHERE_EXPORT(monitor_predicted_pairs) void monitor_predicted_pairs(const Monitor* monitor) {
  answer().clear();
  for (const PredictedPair& pair : monitor->predicted_pairs())
    answer_with({number_of_track(pair.first), number_of_track(pair.second), static_cast<double>(pair.level),
                 pair.since, pair.likely_time, pair.closest_time, pair.closest_distance});
}
KINESPHERE_EXPORT(monitor_open_pair_count) std::size_t monitor_open_pair_count(const Monitor* monitor) {
  return monitor->open_pair_count();
}
KINESPHERE_EXPORT(monitor_crowd) void monitor_crowd(const Monitor* monitor, std::size_t pairs) {
  answer_tracks(monitor->crowd(pairs));
}
/// Answers three numbers for each request.
KINESPHERE_EXPORT(monitor_needed) void monitor_needed(const Monitor* monitor, double until) {
  answer().clear();
  for (const ReportRequest& request : monitor->needed(until))
    answer_with({number_of_track(request.track), request.by, number_of_track(request.other)});
}

}  // namespace kinesphere::browser
