// The results of a watch, as text and as JSON; its state, and metrics.
#include "watch/output/watch_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "scenes/summary.hpp"
#include "watch/output/alert_lines.hpp"

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

/// Returns the counts of reports.
std::vector<WatchCount> report_counts(const WatchView& watch) {
  const WatchCounts& counts = watch.counts;
  const MonitorCounters monitor = watch.counters();
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
  };
}

/// Returns the counts of alerts and events, and of what became of the events.
std::vector<WatchCount> event_counts(const WatchCounts& counts) {
  const auto events = [&](MonitorEventKind kind) { return counts.events[static_cast<std::size_t>(kind)]; };
  const auto fates = [&](AlertFate fate) { return counts.fates[static_cast<std::size_t>(fate)]; };
  return {
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

std::vector<WatchCount> counts_of(const WatchView& watch) {
  std::vector<WatchCount> all = report_counts(watch);
  for (const WatchCount& count : event_counts(watch.counts)) all.push_back(count);
  return all;
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
/// Returns them as a JSON array, on one line, or each on a line of its own.
template <class Range, class TextOf>
std::string list_of(const Range& range, const TextOf& text_of) {
  return fmt::format("[{}]", joined(range, ", ", text_of));
}
template <class Range, class TextOf>
std::string lines_of(const Range& range, const TextOf& text_of) {
  const std::string lines = joined(range, ",\n", text_of);
  return fmt::format("[{}{}]", lines.empty() ? "" : "\n", lines);
}

bool is_always_shown(const WatchCount& count) { return *count.label != '\0'; }

std::string separation_text(const NamedSeparation& named) {
  const Separation& separation = named.separation;
  const bool is_well_clear = separation.shape == Separation::Shape::well_clear;
  JsonObject object;
  object.text("name", named.name)
      .text("shape", separation.shape == Separation::Shape::cylinder ? "cylinder"
                     : is_well_clear                                 ? "well_clear"
                                                                     : "ellipsoid")
      .number("horizontal", separation.horizontal)
      .number("vertical", separation.vertical);
  if (is_well_clear) object.number("modified_tau", separation.modified_tau);
  return object.whole();
}

void add_counts(JsonObject& object, const WatchView& watch) {
  for (const WatchCount& count : counts_of(watch)) object.count(count.name, count.count);
}

/// Begins the state with the settings that it depends on, and the counts.
JsonObject begin_state(const WatchView& watch) {
  const WatchSettings& settings = watch.settings;
  const bool has_begun = watch.pairs.monitor().has_value();
  const auto& frame = watch.tracks.map().frame();
  JsonObject state, counts;
  state.add("time", has_begun ? watch.json_time(watch.monitor().time()) : "null")
      .text("stream", settings.source)
      .text("format", settings.format)
      .add("own", settings.own.empty() ? "null" : json_text(settings.own))
      .add("geographic", has_begun ? frame ? "true" : "false" : "null")
      .add("dimensions", has_begun ? fmt::to_string(watch.tracks.map().dimensions()) : "null")
      .add("origin", frame ? JsonObject()
                                 .number("lon", frame->longitude())
                                 .number("lat", frame->latitude())
                                 .number("radius", frame->radius())
                                 .whole()
                           : "null")
      .number("silence", settings.silence)
      .number("forget", settings.forget)
      .add("separations", list_of(settings.separations, separation_text));
  add_counts(counts, watch);
  state.add("counts", counts.whole());
  return state;
}

std::string text_of_place(const WatchView& watch, const TrackView::Place& place) {
  const auto numbers = [](std::initializer_list<double> values) { return list_of(values, json_number); };
  JsonObject object;
  object.number("x", place.centre.x).number("y", place.centre.y).number("z", place.centre.z);
  if (const auto& frame = watch.tracks.map().frame()) {
    const Vec3 at = frame->geographic(place.centre);
    object.number("lon", at.x).number("lat", at.y).number("alt", at.z);
  }
  return object.add("velocity", numbers({place.velocity.x, place.velocity.y, place.velocity.z}))
      .add("radius", numbers({place.radius.horizontal(), place.radius.vertical()}))
      .whole();
}

std::string text_of_track(const WatchView& watch, TrackId id) {
  const TrackView view = watch.monitor().track(id).value();
  const NamedTrack* const named = watch.track(id);
  const bool has_name = named != nullptr && !named->name.empty();
  const bool has_class = named != nullptr && named->declared.motion_class != 0;
  return JsonObject()
      .add("id", watch.json_id(id))
      .add("name", has_name ? json_text(named->name) : "null")
      .add("stamp", watch.json_time(view.timestamp))
      .add("stale", view.stale ? "true" : "false")
      .add("class", has_class ? json_text(watch.tracks.classes()[named->declared.motion_class].name) : "null")
      .add("places", list_of(view.places, [&](const auto& place) { return text_of_place(watch, place); }))
      .whole();
}

/// `pair` is an open pair or a predicted one.
template <class Pair>
std::string text_of_pair(const WatchView& watch, const Pair& pair) {
  const OrderedPair ordered = watch.in_text_order(pair.first, pair.second);
  const PairAnswer answer = watch.monitor().answer(pair.first, pair.second, pair.level).value();
  JsonObject object;
  object.add("first", watch.json_id(ordered.first))
      .add("second", watch.json_id(ordered.second))
      .text("separation", watch.separation(pair.level).name)
      .count("level", pair.level)
      .text("verdict", std::string(name_of(answer.verdict)))
      .add("since", watch.json_time(pair.since));
  add_answer(object, watch, ordered, pair.level, answer);
  return object.whole();
}

std::string text_of_request(const WatchView& watch, const ReportRequest& request) {
  return JsonObject()
      .add("track", watch.json_id(request.track))
      .add("by", watch.json_time(request.by))
      .add("other", watch.json_id(request.other))
      .whole();
}

}  // namespace

std::string reasons_text(const WatchView& watch) {
  std::string text;
  for (const WatchCount& count : report_counts(watch))
    if (count.is_reason && count.count > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count.count), count.note);
  return text;
}

std::string watch_summary_text(const WatchView& watch, const WatchEnd& end) {
  Summary summary;
  const WatchSettings& settings = watch.settings;
  summary.row("stream", settings.source, std::string(end.format));
  summary.row("time", fmt::format("{} s", number(watch.time_covered())),
              fmt::format("{} to {}", without_quotes(watch.first_time()), without_quotes(watch.last_time())));
  if (const auto& frame = watch.tracks.map().frame())
    summary.row("map", fmt::format("{} km", number(frame->radius() / 1e3)),
                fmt::format("around {:.4f}, {:.4f}; its lengths are at most {:.2g} % too long",
                            frame->latitude(), frame->longitude(), 100.0 * (frame->stretch() - 1.0)));
  for (const WatchCount& count : counts_of(watch))
    if (is_always_shown(count) || count.count > 0) summary.row(count.label, grouped(count.count), count.note);
  for (std::size_t level = 0; level < settings.separations.size(); ++level) {
    const auto& turns = watch.counts.turns[level];
    summary.row("separation", settings.separations[level].name,
                fmt::format("{} times undecided, {} times within, {} times apart again",
                            grouped(turns.undecided), grouped(turns.within), grouped(turns.apart)));
  }
  for (const MalformedLine& line : watch.counts.first_malformed)
    summary.row("malformed", fmt::format("line {}", line.line), line.reason);
  for (const Warning& warning : end.warnings)
    summary.row(
        &warning == &end.warnings.front() ? "warnings" : "", grouped(warning.times),
        fmt::format("{}, first at {}: {}", warning.what, without_quotes(warning.first), warning.text));
  const double reports = static_cast<double>(watch.counters().reports);
  summary.row("real time", fmt::format("{} s", number(end.real_seconds)),
              fmt::format("{} reports a second", number(reports / end.real_seconds)));
  return summary.text();
}

std::string watch_summary_json(const WatchView& watch, const WatchEnd& end) {
  JsonObject summary;
  summary.text("stream", watch.settings.source)
      .text("format", std::string(end.format))
      .add("from", watch.first_time())
      .add("to", watch.last_time())
      .number("seconds", watch.time_covered());
  add_counts(summary, watch);
  std::size_t level = 0;
  const auto turns_text = [&](const NamedSeparation& named) {
    const auto& turns = watch.counts.turns[level++];
    return JsonObject()
        .text("separation", named.name)
        .count("undecided", turns.undecided)
        .count("within", turns.within)
        .count("apart", turns.apart)
        .whole();
  };
  const auto line_text = [](const MalformedLine& line) {
    return JsonObject().count("line", line.line).text("reason", line.reason).whole();
  };
  const auto warning_text = [](const Warning& warning) {
    return JsonObject()
        .text("what", std::string(warning.what))
        .add("first", warning.first)
        .count("times", warning.times)
        .text("text", warning.text)
        .whole();
  };
  return summary.count("tracks", watch.tracks.names().size())
      .add("separations", list_of(watch.settings.separations, turns_text))
      .add("first_malformed", list_of(watch.counts.first_malformed, line_text))
      .add("warnings", list_of(end.warnings, warning_text))
      .number("real_seconds", end.real_seconds)
      .line();
}

std::string watch_state_json(const WatchView& watch) {
  std::string tracks = "[]", pairs = "[]", predictions = "[]", needed = "[]";
  if (watch.pairs.monitor()) {
    const Monitor& monitor = watch.monitor();
    const auto pair_text = [&](const auto& pair) { return text_of_pair(watch, pair); };
    tracks = lines_of(monitor.tracks(), [&](TrackId id) { return text_of_track(watch, id); });
    pairs = lines_of(monitor.open_pairs(), pair_text);
    predictions = lines_of(monitor.predicted_pairs(), pair_text);
    needed = lines_of(monitor.needed(monitor.time() + watch.settings.window),
                      [&](const ReportRequest& request) { return text_of_request(watch, request); });
  }
  const std::string settings = begin_state(watch).whole();
  return fmt::format("{},\n\"tracks\": {},\n\"pairs\": {},\n\"predictions\": {},\n\"needed\": {}}}\n",
                     settings.substr(0, settings.size() - 1), tracks, pairs, predictions, needed);
}

std::string watch_metrics(const WatchView& watch) {
  std::string text;
  const auto add = [&](std::string_view name, std::string_view type, std::string_view help, double value) {
    fmt::format_to(
        std::back_inserter(text),
        "# HELP kinesphere_watch_{0} {1}\n# TYPE kinesphere_watch_{0} {2}\nkinesphere_watch_{0} {3}\n", name,
        help, type, value);
  };
  for (const WatchCount& count : counts_of(watch))
    add(std::string(count.name) + "_total", "counter", *count.note != '\0' ? count.note : "lines written",
        static_cast<double>(count.count));
  std::size_t stale = 0, undecided = 0, within = 0;
  if (const auto& monitor = watch.pairs.monitor()) {
    for (const TrackId id : monitor->tracks()) stale += monitor->track(id).value().stale ? 1 : 0;
    for (const OpenPair& pair : monitor->open_pairs())
      ++(pair.verdict == Verdict::within ? within : undecided);
  }
  add("tracks", "gauge", "tracks that are watched", static_cast<double>(watch.tracks.names().size()));
  add("tracks_stale", "gauge", "of them stale", static_cast<double>(stale));
  add("pairs_undecided", "gauge", "pairs and separations that are undecided", static_cast<double>(undecided));
  add("pairs_within", "gauge", "pairs and separations that are certainly within",
      static_cast<double>(within));
  add("pairs_predicted", "gauge", "pairs and separations that are predicted",
      static_cast<double>(watch.pairs.monitor() ? watch.pairs.monitor()->predicted_pairs().size() : 0));
  add("stream_seconds", "gauge", "time of the stream that has been watched", watch.time_covered());
  return text;
}

}  // namespace kinesphere::program
