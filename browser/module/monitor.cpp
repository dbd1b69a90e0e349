// Monitors: definitions, reports, events, answers, snapshots.
#include <limits>

#include "exchange.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "numbers.hpp"

namespace kinesphere::browser {
namespace {

// Returns true if the JavaScript function returned, and false if it threw.
KINESPHERE_IMPORT(poll)
bool javascript_poll(std::size_t count, const double* ids, double time, double* reports);

/// Reads what monitorNumbers() in package/src/monitor_definition.ts writes.
MonitorDefinition monitor_definition_at(const double* at) {
  NumberReader numbers(at);
  MonitorDefinition definition;
  fields::each_monitor_definition_field(numbers, definition);
  const bool starts = numbers.flag();
  const double start_time = numbers.number();
  if (starts) definition.start_time = start_time;
  definition.shard = {numbers.take<std::uint64_t>(), numbers.take<std::uint64_t>(),
                      numbers.take<std::uint64_t>()};
  definition.classes.resize(numbers.take<std::size_t>());
  definition.separations.resize(numbers.take<std::size_t>());
  for (TrackClass& one : definition.classes) fields::each_track_class_field(numbers, one);
  for (SeparationRule& rule : definition.separations) {
    rule.first_class = numbers.take<std::size_t>();
    rule.second_class = numbers.take<std::size_t>();
    rule.levels.resize(numbers.take<std::size_t>());
    for (Separation& level : rule.levels) fields::each_separation_field(numbers, level);
  }
  return definition;
}

void answer_with(std::initializer_list<double> numbers) {
  answer().insert(answer().end(), numbers.begin(), numbers.end());
}

/// Answers the fields of a record that `walk` goes through.
template <class Walk>
void answer_record(const Walk& walk) {
  // More than any record has.
  double numbers[64];
  NumberWriter writer(numbers);
  walk(writer);
  answer().insert(answer().end(), numbers, writer.next());
}

double number_of_track(TrackId id) { return static_cast<double>(id); }
TrackId track_of(double number) { return static_cast<TrackId>(number); }

void answer_tracks(std::span<const TrackId> ids) {
  answer().clear();
  for (const TrackId id : ids) answer().push_back(number_of_track(id));
}

/// Size of a report in numbers, which putReport() in package/src/report.ts writes: the id of the track or, in
/// a reply to a poll, 1 if there is a report; the fields; and a plan with whether there is one.
constexpr std::size_t report_numbers = 1 + report_field_numbers + 8;
TrackReport report_at(const double* at) {
  NumberReader numbers(at + 1);
  TrackReport report;
  fields::each_track_report_field(numbers, report);
  if (numbers.flag()) {
    const Vec3 acceleration = numbers.take<Vec3>();
    const ErrorBound limit = numbers.take<ErrorBound>();
    report.plan = {acceleration, limit, numbers.number()};
  }
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
  answer_record([&](NumberWriter& writer) { fields::each_monitor_event_field(writer, event); });
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
  answer_record([&](NumberWriter& writer) {
    fields::each_monitor_definition_field(writer, definition);
    writer.put(definition.start_time.has_value());
    writer.put(definition.start_time.value_or(0.0));
    for (const std::uint64_t part : {definition.shard.of, definition.shard.first, definition.shard.count})
      writer.put(part);
    writer.put(definition.classes.size());
    writer.put(definition.separations.size());
  });
  for (const TrackClass& one : definition.classes)
    answer_record([&](NumberWriter& writer) { fields::each_track_class_field(writer, one); });
  for (const SeparationRule& rule : definition.separations) {
    answer_with({static_cast<double>(rule.first_class), static_cast<double>(rule.second_class),
                 static_cast<double>(rule.levels.size())});
    for (const Separation& level : rule.levels)
      answer_record([&](NumberWriter& writer) { fields::each_separation_field(writer, level); });
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
  answer().clear();
  answer_record([&](NumberWriter& writer) { fields::each_pair_answer_field(writer, *pair); });
  return true;
}

KINESPHERE_EXPORT(monitor_open_pairs) void monitor_open_pairs(const Monitor* monitor) {
  answer().clear();
  for (const OpenPair& pair : monitor->open_pairs())
    answer_record([&](NumberWriter& writer) { fields::each_open_pair_field(writer, pair); });
}
KINESPHERE_EXPORT(monitor_predicted_pairs) void monitor_predicted_pairs(const Monitor* monitor) {
  answer().clear();
  for (const PredictedPair& pair : monitor->predicted_pairs())
    answer_record([&](NumberWriter& writer) { fields::each_predicted_pair_field(writer, pair); });
}
KINESPHERE_EXPORT(monitor_open_pair_count) std::size_t monitor_open_pair_count(const Monitor* monitor) {
  return monitor->open_pair_count();
}
KINESPHERE_EXPORT(monitor_crowd) void monitor_crowd(const Monitor* monitor, std::size_t pairs) {
  answer_tracks(monitor->crowd(pairs));
}
KINESPHERE_EXPORT(monitor_needed) void monitor_needed(const Monitor* monitor, double until) {
  answer().clear();
  for (const ReportRequest& request : monitor->needed(until))
    answer_record([&](NumberWriter& writer) { fields::each_report_request_field(writer, request); });
}

}  // namespace kinesphere::browser
