// The results of a watch, as text and as JSON; its state, and metrics.
#include "watch/watch_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "base/json_text.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

/// Names in the JSON and in the metrics.
struct WatchCount {
  const char* name;
  const char* label;
  const char* note;
  std::uint64_t count;
  bool is_reason = false;  ///< for which reports were not taken
};

std::vector<WatchCount> counts_of(const Watcher& watcher) {
  const WatchCounts& counts = watcher.counts();
  const MonitorCounters monitor = watcher.monitor_counters();
  const auto events = [&](MonitorEventKind kind) { return counts.events[static_cast<std::size_t>(kind)]; };
  const auto fates = [&](AlertFate fate) { return counts.fates[static_cast<std::size_t>(fate)]; };
  return {
      {"reports", "reports", "taken", monitor.reports},
      {"late", "", "of them late: older than one before of the same track", monitor.late},
      {"repeated", "", "repeated", counts.repeated + monitor.repeated, true},
      {"too_old", "", "too old: from before their track would have been forgotten (--forget)", counts.stale,
       true},
      {"ahead", "", "stamped ahead, and not confirmed by others (--leap)", counts.ahead, true},
      {"outside", "", "beyond the radius of the map (--radius, --origin)", counts.outside, true},
      {"no_position", "", "without a position or its time", counts.no_position, true},
      {"on_ground", "", "on the ground, without a height", counts.on_ground, true},
      {"no_bound", "", "of unknown accuracy", counts.no_bound, true},
      {"no_velocity", "", "without a velocity, where --largest-speed is not given", counts.no_velocity, true},
      {"filtered", "", "left out by --where or --ignore", counts.filtered, true},
      {"superseded", "", "from before their track had its present class", counts.superseded, true},
      {"crowded", "", "of new tracks when there was no room for more (--most-tracks, --most-pairs)",
       counts.crowded, true},
      {"malformed", "", "malformed", counts.malformed, true},
      {"no_height", "", "of those taken without a height: it may be any", counts.no_height},
      {"grouped", "", "of tracks that stand at one place and are watched as a group", counts.grouped},
      {"alerts", "alerts", "", counts.alerts},
      {"groups", "", "groups of tracks that stand at one place", counts.groups},
      {"lost", "", "tracks lost in an encounter", counts.lost},
      {"one_bodies", "", "pairs that are one body under two ids", counts.one_bodies},
      {"held_back", "", "events without an alert of their own:", counts.held_back()},
      {"held_back_undecided", "", "turned undecided, or apart again (--only undecided)",
       fates(AlertFate::undecided)},
      {"held_back_of_tracks", "", "of single tracks (--only tracks)", fates(AlertFate::of_track)},
      {"held_back_other_kinds", "", "of other kinds (--only)", fates(AlertFate::other_kind)},
      {"held_back_of_encounters", "", "of encounters that other alerts tell", fates(AlertFate::encounter)},
      {"held_back_of_one_body", "", "of two that may be one body under two ids (--distinct-ids)",
       fates(AlertFate::same_body)},
      {"held_back_at_rest", "", "of two at rest that have been told once (--rest)",
       fates(AlertFate::at_rest)},
      {"held_back_elsewhere", "", "outside of --area", fates(AlertFate::elsewhere)},
      {"held_back_as_too_many", "", "more than --most-alerts", fates(AlertFate::too_many)},
      {"verdicts", "events", "changes of what is certain", events(MonitorEventKind::verdict)},
      {"predicted", "", "predicted", events(MonitorEventKind::predicted)},
      {"predictions_ended", "", "predictions ended", events(MonitorEventKind::prediction_ended)},
      {"contradictions", "", "contradictions", events(MonitorEventKind::contradiction)},
      {"resolved", "", "contradictions resolved", events(MonitorEventKind::resolved)},
      {"stale", "", "tracks became stale", events(MonitorEventKind::stale)},
      {"resumed", "", "resumed", events(MonitorEventKind::resumed)},
      {"reclassified", "", "changed their class", events(MonitorEventKind::reclassified)},
      {"dropped", "", "were dropped", events(MonitorEventKind::dropped)},
      {"handovers", "", "of them as another id goes on", counts.handovers},
      {"dropped_in_crowds", "", "of them as more pairs were open than --most-pairs", counts.dropped},
  };
}

std::string without_quotes(std::string text) {
  std::erase(text, '"');
  return text;
}

/// Returns the texts of all elements, with `between` between them.
template <class Range, class TextOf>
std::string joined(const Range& range, std::string_view between, const TextOf& text_of) {
  std::string all;
  for (const auto& each : range) {
    if (!all.empty()) all += between;
    all += text_of(each);
  }
  return all;
}
/// Returns them as a JSON array, each on a line of its own.
template <class Range, class TextOf>
std::string array_of(const Range& range, const TextOf& text_of) {
  const std::string lines = joined(range, ",\n", text_of);
  return fmt::format("[{}{}]", lines.empty() ? "" : "\n", lines);
}

std::string count_text(const WatchCount& count) {
  return fmt::format(R"("{}": {})", count.name, count.count);
}

bool is_always_shown(const WatchCount& count) { return *count.label != '\0'; }

/// Returns the settings that the state depends on, and the counts.
std::string setting_fields(const Watcher& watcher) {
  const WatchSettings& settings = watcher.settings();
  const auto& monitor = watcher.monitor();
  const auto& frame = watcher.frame();
  std::string text = fmt::format(
      R"("stream": {}, "format": {}, "own": {}, "geographic": {}, "dimensions": {}, "origin": )",
      json_text(settings.source), json_text(settings.format),
      settings.own.empty() ? "null" : json_text(settings.own), monitor ? frame ? "true" : "false" : "null",
      monitor ? std::to_string(monitor->definition().dimensions) : "null");
  text += frame ? fmt::format(R"({{"lon": {}, "lat": {}, "radius": {}}})", json_number(frame->longitude()),
                              json_number(frame->latitude()), json_number(frame->radius()))
                : "null";
  const auto separation_text = [](const NamedSeparation& named) {
    const Separation& separation = named.separation;
    const bool is_well_clear = separation.shape == Separation::Shape::well_clear;
    return fmt::format(
        R"({{"name": {}, "shape": "{}", "horizontal": {}, "vertical": {}{}}})", json_text(named.name),
        separation.shape == Separation::Shape::cylinder ? "cylinder"
        : is_well_clear                                 ? "well_clear"
                                                        : "ellipsoid",
        json_number(separation.horizontal), json_number(separation.vertical),
        is_well_clear ? fmt::format(R"(, "modified_tau": {})", json_number(separation.modified_tau)) : "");
  };
  return text + fmt::format(R"(, "silence": {}, "forget": {}, "separations": [{}], "counts": {{{}}})",
                            json_number(settings.silence), json_number(settings.forget),
                            joined(settings.separations, ", ", separation_text),
                            joined(counts_of(watcher), ", ", count_text));
}

std::string place_fields(const Watcher& watcher, const TrackView::Place& place) {
  std::string text = fmt::format(R"({{"x": {}, "y": {}, "z": {}, )", json_number(place.centre.x),
                                 json_number(place.centre.y), json_number(place.centre.z));
  if (const auto& frame = watcher.frame()) {
    const Vec3 at = frame->geographic(place.centre);
    text += fmt::format(R"("lon": {}, "lat": {}, "alt": {}, )", json_number(at.x), json_number(at.y),
                        json_number(at.z));
  }
  return text + fmt::format(R"("velocity": [{}, {}, {}], "radius": [{}, {}]}})",
                            json_number(place.velocity.x), json_number(place.velocity.y),
                            json_number(place.velocity.z), json_number(place.radius.horizontal()),
                            json_number(place.radius.vertical()));
}

/// Returns the name of the track's class as JSON; null for the default.
std::string class_text(const AlertContext& context, TrackId id) {
  const NamedTrack* const track = context.names.find(id);
  if (track == nullptr || track->motion_class == 0) return "null";
  return json_text(context.settings.classes[track->motion_class].name);
}

std::string state_of_track(const Watcher& watcher, const AlertContext& context, TrackId id) {
  const TrackView view = context.monitor.track(id).value();
  const NamedTrack* const named = context.names.find(id);
  return fmt::format(
      R"({{"id": {}, "name": {}, "stamp": {}, "stale": {}, "class": {}, "places": [{}]}})",
      json_text(context.names.text(id)),
      named != nullptr && !named->name.empty() ? json_text(named->name) : "null",
      json_time(context.times, view.timestamp), view.stale, class_text(context, id),
      joined(view.places, ", ", [&](const auto& place) { return place_fields(watcher, place); }));
}

/// `pair` is an open pair or a predicted one.
template <class Pair>
std::string state_of_pair(const AlertContext& context, const Pair& pair) {
  const auto [first, second] = in_text_order(context.names, pair.first, pair.second);
  const PairAnswer answer = context.monitor.answer(pair.first, pair.second, pair.level).value();
  return fmt::format(
      R"({{"first": {}, "second": {}, "separation": {}, "level": {}, "verdict": "{}", "since": {}, {}}})",
      json_text(context.names.text(first)), json_text(context.names.text(second)),
      json_text(context.settings.separations[pair.level].name), pair.level, name_of(answer.verdict),
      json_time(context.times, pair.since), answer_fields(context, {first, second}, pair.level, answer));
}

std::string state_of_need(const AlertContext& context, const ReportRequest& need) {
  return fmt::format(R"({{"track": {}, "by": {}, "other": {}}})", json_text(context.names.text(need.track)),
                     json_time(context.times, need.by), json_text(context.names.text(need.other)));
}

}  // namespace

std::string reasons_text(const Watcher& watcher) {
  std::string text;
  for (const WatchCount& count : counts_of(watcher))
    if (count.is_reason && count.count > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count.count), count.note);
  return text;
}

std::string watch_summary_text(const Watcher& watcher, std::string_view format, double real_seconds) {
  Summary summary;
  const WatchSettings& settings = watcher.settings();
  summary.row("stream", settings.source, std::string(format));
  summary.row(
      "time", fmt::format("{} s", number(watcher.time_covered())),
      fmt::format("{} to {}", without_quotes(watcher.first_time()), without_quotes(watcher.last_time())));
  if (const auto& frame = watcher.frame())
    summary.row("map", fmt::format("{} km", number(frame->radius() / 1e3)),
                fmt::format("around {:.4f}, {:.4f}; its lengths are at most {:.2g} % too long",
                            frame->latitude(), frame->longitude(), 100.0 * (frame->stretch() - 1.0)));
  for (const WatchCount& count : counts_of(watcher))
    if (is_always_shown(count) || count.count > 0) summary.row(count.label, grouped(count.count), count.note);
  for (std::size_t level = 0; level < settings.separations.size(); ++level) {
    const auto& turns = watcher.counts().turns[level];
    summary.row("separation", settings.separations[level].name,
                fmt::format("{} times undecided, {} times within, {} times apart again",
                            grouped(turns.undecided), grouped(turns.within), grouped(turns.apart)));
  }
  for (const MalformedLine& line : watcher.counts().first_malformed)
    summary.row("malformed", fmt::format("line {}", line.line), line.reason);
  const double reports = static_cast<double>(watcher.monitor_counters().reports);
  summary.row("real time", fmt::format("{} s", number(real_seconds)),
              fmt::format("{} reports a second", number(reports / real_seconds)));
  return summary.text();
}

std::string watch_summary_json(const Watcher& watcher, std::string_view format, double real_seconds) {
  const WatchSettings& settings = watcher.settings();
  std::string text = fmt::format(R"({{"stream": {}, "format": "{}", "from": {}, "to": {}, "seconds": {})",
                                 json_text(settings.source), format, watcher.first_time(),
                                 watcher.last_time(), json_number(watcher.time_covered()));
  text += ", " + joined(counts_of(watcher), ", ", count_text);
  std::size_t level = 0;
  const auto turns_text = [&](const NamedSeparation& named) {
    const auto& turns = watcher.counts().turns[level++];
    return fmt::format(R"({{"separation": {}, "undecided": {}, "within": {}, "apart": {}}})",
                       json_text(named.name), turns.undecided, turns.within, turns.apart);
  };
  const auto line_text = [](const MalformedLine& line) {
    return fmt::format(R"({{"line": {}, "reason": {}}})", line.line, json_text(line.reason));
  };
  return text +
         fmt::format(R"(, "tracks": {}, "separations": [{}], "first_malformed": [{}], "real_seconds": {}}})"
                     "\n",
                     watcher.names().size(), joined(settings.separations, ", ", turns_text),
                     joined(watcher.counts().first_malformed, ", ", line_text), json_number(real_seconds));
}

std::string watch_state_json(const Watcher& watcher) {
  if (!watcher.monitor())
    return fmt::format("{{\"time\": null, {},\n{}}}\n", setting_fields(watcher),
                       "\"tracks\": [],\n\"pairs\": [],\n\"predictions\": [],\n\"needed\": []");
  const AlertContext context = watcher.context();
  const Monitor& monitor = context.monitor;
  const auto text_of_pair = [&](const auto& pair) { return state_of_pair(context, pair); };
  return fmt::format(
      "{{\"time\": {}, {},\n\"tracks\": {},\n\"pairs\": {},\n\"predictions\": {},\n\"needed\": {}}}\n",
      json_time(context.times, monitor.time()), setting_fields(watcher),
      array_of(monitor.tracks(), [&](TrackId id) { return state_of_track(watcher, context, id); }),
      array_of(monitor.open_pairs(), text_of_pair), array_of(monitor.predicted_pairs(), text_of_pair),
      array_of(monitor.needed(monitor.time() + context.settings.window),
               [&](const ReportRequest& need) { return state_of_need(context, need); }));
}

std::string watch_metrics(const Watcher& watcher) {
  std::string text;
  const auto add = [&](std::string_view name, std::string_view type, std::string_view help, double value) {
    fmt::format_to(
        std::back_inserter(text),
        "# HELP kinesphere_watch_{0} {1}\n# TYPE kinesphere_watch_{0} {2}\nkinesphere_watch_{0} {3}\n", name,
        help, type, value);
  };
  for (const WatchCount& count : counts_of(watcher))
    add(std::string(count.name) + "_total", "counter", *count.note != '\0' ? count.note : "lines written",
        static_cast<double>(count.count));
  std::size_t stale = 0, undecided = 0, within = 0;
  if (const auto& monitor = watcher.monitor()) {
    for (const TrackId id : monitor->tracks()) stale += monitor->track(id).value().stale ? 1 : 0;
    for (const OpenPair& pair : monitor->open_pairs())
      ++(pair.verdict == Verdict::within ? within : undecided);
  }
  add("tracks", "gauge", "tracks that are watched", static_cast<double>(watcher.names().size()));
  add("tracks_stale", "gauge", "of them stale", static_cast<double>(stale));
  add("pairs_undecided", "gauge", "pairs and separations that are undecided", static_cast<double>(undecided));
  add("pairs_within", "gauge", "pairs and separations that are certainly within",
      static_cast<double>(within));
  add("pairs_predicted", "gauge", "pairs and separations that are predicted",
      static_cast<double>(watcher.monitor() ? watcher.monitor()->predicted_pairs().size() : 0));
  add("stream_seconds", "gauge", "time of the stream that has been watched", watcher.time_covered());
  return text;
}

}  // namespace kinesphere::program
