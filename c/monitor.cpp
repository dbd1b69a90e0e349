// Monitors: definitions, reports, events, answers, snapshots.
#include "kinesphere/monitor/monitor.hpp"

#include <functional>

#include "exchange.hpp"
#include "objects.hpp"

namespace kinesphere::c {

ks_monitor_definition c_monitor(const MonitorDefinition& definition) {
  ks_monitor_definition record{.struct_size = sizeof record,
                               .shard_of = definition.shard.of,
                               .shard_first = definition.shard.first,
                               .shard_count = definition.shard.count};
  fields::each_monitor_definition_field(convert_fields, definition, record);
  return record;
}

namespace {

SeparationRule rule_of(std::string_view call, const ks_separation_rule& given) {
  SeparationRule rule{given.first_class, given.second_class, {}};
  require_array(call, given.levels, given.level_count, "definition.separations.levels");
  for (const ks_separation& level : std::span(given.levels, given.level_count)) {
    require_number(call, "separation.shape", level.shape, KS_SEPARATION_ELLIPSOID, KS_SEPARATION_WELL_CLEAR);
    fields::each_separation_field(convert_fields, level, rule.levels.emplace_back());
  }
  return rule;
}

MonitorDefinition monitor_of(std::string_view call, const ks_monitor_definition& given) {
  MonitorDefinition definition{.shard = {given.shard_of, given.shard_first, given.shard_count}};
  fields::each_monitor_definition_field(convert_fields, given, definition);
  if (given.has_start_time) definition.start_time = given.start_time;
  require_array(call, given.classes, given.class_count, "definition.classes");
  for (const ks_track_class& one : std::span(given.classes, given.class_count))
    definition.classes.push_back({bound_of(call, one.acceleration_limit), vector_of(one.planned_acceleration),
                                  bound_of(call, one.largest_speed)});
  require_array(call, given.separations, given.separation_count, "definition.separations");
  for (const ks_separation_rule& rule : std::span(given.separations, given.separation_count))
    definition.separations.push_back(rule_of(call, rule));
  return definition;
}

ks_track_report c_report(const TrackReport& report) {
  const TrackReport::Plan plan = report.plan.value_or(TrackReport::Plan{});
  ks_track_report record{.struct_size = sizeof record,
                         .has_plan = report.plan.has_value(),
                         .plan_acceleration = c_vector(plan.acceleration),
                         .plan_valid_until = plan.valid_until};
  convert(plan.acceleration_limit, record.plan_limit);
  fields::each_track_report_field(convert_fields, report, record);
  return record;
}

TrackReport report_of(std::string_view call, const ks_track_report& given) {
  // Checks their kinds.
  bound_of(call, given.position_error);
  bound_of(call, given.velocity_error);
  TrackReport report;
  fields::each_track_report_field(convert_fields, given, report);
  if (given.has_plan) {
    report.plan = {vector_of(given.plan_acceleration), bound_of(call, given.plan_limit),
                   given.plan_valid_until};
  }
  return report;
}

ks_monitor_event c_monitor_event(const MonitorEvent& event) {
  ks_monitor_event record{.struct_size = sizeof record};
  fields::each_monitor_event_field(convert_fields, event, record);
  return record;
}

ks_pair_answer c_answer(const PairAnswer& answer) {
  ks_pair_answer record{.struct_size = sizeof record};
  fields::each_pair_answer_field(convert_fields, answer, record);
  return record;
}

ks_open_pair c_open(const OpenPair& pair) {
  ks_open_pair record;
  fields::each_open_pair_field(convert_fields, pair, record);
  return record;
}

ks_predicted_pair c_predicted(const PredictedPair& pair) {
  ks_predicted_pair record;
  fields::each_predicted_pair_field(convert_fields, pair, record);
  return record;
}

ks_report_request c_request(const ReportRequest& request) {
  ks_report_request record;
  fields::each_report_request_field(convert_fields, request, record);
  return record;
}

ks_track_place c_place(const TrackView::Place& place) {
  ks_track_place record;
  fields::each_track_place_field(convert_fields, place, record);
  return record;
}

/// Asks a poll of C for reports.
void poll_caller(std::string_view call, ks_poll poll, void* user, std::span<const TrackId> ids, double time,
                 std::span<std::optional<TrackReport>> reports) {
  std::vector<ks_track_report> given(ids.size(), c_report({}));
  std::vector<std::uint8_t> has_report(ids.size(), 0);
  require_success("poll", poll(ids.data(), ids.size(), time, given.data(), has_report.data(), user));
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (!has_report[k]) continue;
    require_record(call, &given[k], "reports");
    reports[k] = report_of(call, given[k]);
  }
}

std::optional<MonitorEvent> advance(std::string_view call, Monitor& monitor, double until, ks_poll poll,
                                    void* user) {
  if (poll == nullptr) return monitor.advance(until).value();
  const auto ask = [&](std::span<const TrackId> ids, double time,
                       std::span<std::optional<TrackReport>> reports) {
    poll_caller(call, poll, user, ids, time, reports);
  };
  return monitor.advance(until, ask).value();
}

}  // namespace
}  // namespace kinesphere::c

using namespace kinesphere;
using namespace kinesphere::c;

ks_status ks_monitor_definition_init(ks_monitor_definition* definition, uint32_t struct_size) {
  return initialise(__func__, definition, struct_size, c_monitor({}));
}

ks_status ks_track_report_init(ks_track_report* report, uint32_t struct_size) {
  return initialise(__func__, report, struct_size, c_report({}));
}

const char* ks_monitor_event_kind_name(ks_monitor_event_kind kind) {
  if (kind == KS_MONITOR_NONE) return "none";
  if (kind < KS_MONITOR_VERDICT || kind > KS_MONITOR_RECLASSIFIED) return "";
  return name_of(static_cast<MonitorEventKind>(kind - KS_MONITOR_VERDICT)).data();
}

const char* ks_verdict_name(ks_verdict verdict) {
  return verdict < KS_VERDICT_APART || verdict > KS_VERDICT_WITHIN
             ? ""
             : name_of(static_cast<Verdict>(verdict)).data();
}

ks_status ks_monitor_create(const ks_monitor_definition* definition, ks_monitor* monitor) {
  return guarded([&, call = __func__] {
    require_record(call, definition, "definition");
    create<MonitorObject>(call, monitor, Monitor::create(monitor_of(call, *definition)).value());
  });
}

ks_status ks_monitor_destroy(ks_monitor monitor) { return destroy(__func__, monitor); }

ks_status ks_monitor_save(ks_monitor monitor, void* bytes, size_t capacity, size_t* count) {
  return reading(__func__, monitor, [&, call = __func__](const MonitorObject& object) {
    write_all(call, object.monitor.save(), static_cast<std::byte*>(bytes), capacity, count, std::identity());
  });
}

ks_status ks_monitor_restore(const void* bytes, size_t count, ks_monitor* monitor) {
  return guarded([&, call = __func__] {
    require_array(call, bytes, count, "bytes");
    const std::span snapshot(static_cast<const std::byte*>(bytes), count);
    create<MonitorObject>(call, monitor, Monitor::restore(snapshot).value());
  });
}

ks_status ks_monitor_report(ks_monitor monitor, const uint64_t* tracks, const ks_track_report* reports,
                            size_t count) {
  return changing(__func__, monitor, [&, call = __func__](MonitorObject& object) {
    require_array(call, tracks, count, "tracks");
    require_records(call, reports, count, "reports");
    std::vector<TrackReport> taken;
    for (std::size_t k = 0; k < count; ++k) {
      taken.push_back(report_of(call, reports[k]));
      object.monitor.check_report(tracks[k], taken.back()).value();
    }
    for (std::size_t k = 0; k < count; ++k) object.monitor.report(tracks[k], taken[k]).value();
  });
}

ks_status ks_monitor_remove(ks_monitor monitor, uint64_t track) {
  return changing(__func__, monitor, [&](MonitorObject& object) { object.monitor.remove(track).value(); });
}

ks_status ks_monitor_advance(ks_monitor monitor, double until, ks_poll poll, void* user,
                             ks_monitor_event* event) {
  return changing(__func__, monitor, [&, call = __func__](MonitorObject& object) {
    require_record(call, event, "event");
    const auto next = advance(call, object.monitor, until, poll, user);
    *event = c_monitor_event(next.value_or(MonitorEvent{.time = object.monitor.time()}));
    if (!next) event->kind = KS_MONITOR_NONE;
  });
}

ks_status ks_monitor_time(ks_monitor monitor, double* time) {
  return reading(__func__, monitor, [&, call = __func__](const MonitorObject& object) {
    require_pointer(call, time, "time");
    *time = object.monitor.time();
  });
}

ks_status ks_monitor_tracks(ks_monitor monitor, uint64_t* tracks, size_t capacity, size_t* count) {
  return reading(__func__, monitor, [&, call = __func__](const MonitorObject& object) {
    write_all(call, object.monitor.tracks(), tracks, capacity, count, std::identity());
  });
}

ks_status ks_monitor_places(ks_monitor monitor, uint64_t track, ks_track_place* places, size_t capacity,
                            size_t* count) {
  return reading(__func__, monitor, [&, call = __func__](const MonitorObject& object) {
    write_all(call, object.monitor.track(track).value().places, places, capacity, count, c_place);
  });
}

ks_status ks_monitor_answer(ks_monitor monitor, uint64_t first, uint64_t second, uint32_t level,
                            ks_pair_answer* answer) {
  return reading(__func__, monitor, [&, call = __func__](const MonitorObject& object) {
    require_record(call, answer, "answer");
    *answer = c_answer(object.monitor.answer(first, second, level).value());
  });
}

ks_status ks_monitor_open_pairs(ks_monitor monitor, ks_open_pair* pairs, size_t capacity, size_t* count) {
  return reading(__func__, monitor, [&, call = __func__](const MonitorObject& object) {
    write_all(call, object.monitor.open_pairs(), pairs, capacity, count, c_open);
  });
}

ks_status ks_monitor_predicted_pairs(ks_monitor monitor, ks_predicted_pair* pairs, size_t capacity,
                                     size_t* count) {
  return reading(__func__, monitor, [&, call = __func__](const MonitorObject& object) {
    write_all(call, object.monitor.predicted_pairs(), pairs, capacity, count, c_predicted);
  });
}

ks_status ks_monitor_needed(ks_monitor monitor, double until, ks_report_request* requests, size_t capacity,
                            size_t* count) {
  return reading(__func__, monitor, [&, call = __func__](const MonitorObject& object) {
    write_all(call, object.monitor.needed(until), requests, capacity, count, c_request);
  });
}
