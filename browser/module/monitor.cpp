// What C does not tell of monitors.
#include "kinesphere/monitor/monitor.hpp"

#include "module.hpp"

namespace kinesphere::browser {
namespace {

template <class Look>
ks_status answering(ks_monitor monitor, const Look& look) {
  answer().clear();
  return c::reading("monitor", monitor, [&](const c::MonitorObject& object) { look(object.monitor); });
}

}  // namespace

/// Writes the definition, whose lists are valid until the next call.
KINESPHERE_EXPORT(monitor_definition)
ks_status monitor_definition(ks_monitor monitor, ks_monitor_definition* written) {
  static std::vector<ks_track_class> classes;
  static std::vector<ks_separation> levels;
  static std::vector<ks_separation_rule> rules;
  return answering(monitor, [&](const Monitor& of) {
    const MonitorDefinition& definition = of.definition();
    classes.clear();
    levels.clear();
    rules.clear();
    for (const TrackClass& one : definition.classes)
      fields::each_track_class_field(c::convert_fields, one, classes.emplace_back());
    for (const SeparationRule& rule : definition.separations)
      for (const Separation& level : rule.levels)
        fields::each_separation_field(c::convert_fields, level, levels.emplace_back());
    const ks_separation* next = levels.data();
    for (const auto& [first, second, own] : definition.separations) {
      rules.push_back({first, second, next, own.size()});
      next += own.size();
    }
    *written = c::c_monitor(definition);
    written->has_start_time = definition.start_time.has_value();
    written->start_time = definition.start_time.value_or(0.0);
    written->classes = classes.data();
    written->class_count = classes.size();
    written->separations = rules.data();
    written->separation_count = rules.size();
  });
}
/// Answers the counters, and the numbers of tracks and of open pairs.
KINESPHERE_EXPORT(monitor_counters) ks_status monitor_counters(ks_monitor monitor) {
  return answering(monitor, [&](const Monitor& of) {
    const MonitorCounters& counters = of.counters();
    for (const std::uint64_t count :
         {counters.reports, counters.late, counters.repeated, counters.contradictions, counters.polls,
          counters.searches, counters.near_pairs, counters.rechecks, std::uint64_t{of.size()},
          std::uint64_t{of.open_pair_count()}})
      answer().push_back(static_cast<double>(count));
  });
}
KINESPHERE_EXPORT(monitor_contains)
ks_status monitor_contains(ks_monitor monitor, std::uint64_t track, ks_bool* contains) {
  return answering(monitor, [&](const Monitor& of) { *contains = of.contains(track); });
}
/// Answers class, timestamp, stale, and nine numbers for each place: centre, velocity, radius.
KINESPHERE_EXPORT(monitor_track) ks_status monitor_track(ks_monitor monitor, std::uint64_t track) {
  return answering(monitor, [&](const Monitor& of) {
    const auto view = of.track(track).value();
    answer() = {static_cast<double>(view.track_class), view.timestamp, view.stale ? 1.0 : 0.0};
    for (const auto& [centre, velocity, radius] : view.places)
      answer().insert(answer().end(), {centre.x, centre.y, centre.z, velocity.x, velocity.y, velocity.z,
                                       radius.horizontal(), radius.vertical(), radius.total()});
  });
}
KINESPHERE_EXPORT(monitor_crowd) ks_status monitor_crowd(ks_monitor monitor, std::size_t pairs) {
  return answering(monitor, [&](const Monitor& of) {
    for (const TrackId track : of.crowd(pairs)) answer().push_back(static_cast<double>(track));
  });
}

}  // namespace kinesphere::browser
