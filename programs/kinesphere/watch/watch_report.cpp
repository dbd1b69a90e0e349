// The results of a watch, as text and as JSON; its state, and metrics.
#include "watch/watch_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "json_text.hpp"
#include "summary.hpp"

namespace kinesphere::program {
namespace {

/// Names in the JSON and in the metrics.
struct WatchCount {
  const char* name;
  const char* label;
  const char* note;
  std::uint64_t count;
};

std::vector<WatchCount> counts_of(const Watcher& watcher) {
  const WatchCounts& counts = watcher.counts();
  const MonitorCounters monitor = watcher.monitor_counters();
  const auto events = [&](MonitorEventKind kind) { return counts.events[static_cast<std::size_t>(kind)]; };
  const auto fates = [&](AlertFate fate) { return counts.fates[static_cast<std::size_t>(fate)]; };
  return {
      {"reports", "reports", "taken", monitor.reports},
      {"late", "", "of them late: older than one before of the same track", monitor.late},
      {"repeated", "", "repeated", counts.repeated + monitor.repeated},
      {"stale", "", "too old: from before their track would have been forgotten (--forget)", counts.stale},
      {"ahead", "", "stamped ahead, and not confirmed by others (--leap)", counts.ahead},
      {"outside", "", "beyond the radius of the map (--radius, --origin)", counts.outside},
      {"no_position", "", "without a position or its time", counts.no_position},
      {"on_ground", "", "on the ground, without a height", counts.on_ground},
      {"no_bound", "", "of unknown accuracy", counts.no_bound},
      {"no_velocity", "", "without a velocity, where --largest-speed is not given", counts.no_velocity},
      {"filtered", "", "left out by --where", counts.filtered},
      {"superseded", "", "from before their track had its present class", counts.superseded},
      {"crowded", "", "of new tracks when there was no room for more (--most-tracks, --most-pairs)",
       counts.crowded},
      {"malformed", "", "malformed", counts.malformed},
      {"no_height", "", "of those taken without a height: it may be any", counts.no_height},
      {"grouped", "", "of tracks that stand at one place and are watched as a group", counts.grouped},
      {"alerts", "alerts", "", counts.alerts},
      {"groups", "", "groups of tracks that stand at one place", counts.groups},
      {"lost", "", "tracks lost in an encounter", counts.lost},
      {"held_back", "", "events without an alert of their own:", counts.held_back()},
      {"held_back_undecided", "", "turned undecided, or apart again (--only undecided)",
       fates(AlertFate::undecided)},
      {"held_back_of_tracks", "", "of single tracks (--only tracks)", fates(AlertFate::of_track)},
      {"held_back_other_kinds", "", "of other kinds (--only)", fates(AlertFate::other_kind)},
      {"held_back_of_encounters", "", "of encounters that other alerts tell", fates(AlertFate::encounter)},
      {"held_back_elsewhere", "", "outside of --area", fates(AlertFate::elsewhere)},
      {"held_back_as_too_many", "", "more than --most-alerts", fates(AlertFate::too_many)},
      {"verdicts", "events", "changes of what is certain", events(MonitorEventKind::verdict)},
      {"predicted", "", "predicted", events(MonitorEventKind::predicted)},
      {"predictions_ended", "", "predictions ended", events(MonitorEventKind::prediction_ended)},
      {"contradictions", "", "contradictions", events(MonitorEventKind::contradiction)},
      {"resolved", "", "contradictions resolved", events(MonitorEventKind::resolved)},
      {"silent", "", "tracks fell silent", events(MonitorEventKind::stale)},
      {"heard", "", "were heard again", events(MonitorEventKind::resumed)},
      {"reclassified", "", "changed their class", events(MonitorEventKind::reclassified)},
      {"left", "", "left", events(MonitorEventKind::dropped)},
      {"dropped", "", "of them dropped: more pairs were open than --most-pairs", counts.dropped},
  };
}

/// Reasons for which reports were not taken; the counts above without those of tracks and alerts.
bool is_reason(const WatchCount& count) {
  constexpr std::string_view reasons[] = {"repeated",    "stale",      "ahead",    "outside",
                                          "no_position", "on_ground",  "no_bound", "no_velocity",
                                          "filtered",    "superseded", "crowded",  "malformed"};
  return count.count > 0 &&
         std::find(std::begin(reasons), std::end(reasons), count.name) != std::end(reasons);
}

std::string without_quotes(std::string text) {
  std::erase(text, '"');
  return text;
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
  text += fmt::format(R"(, "silence": {}, "forget": {}, "separations": [)", json_number(settings.silence),
                      json_number(settings.forget));
  const char* separator = "";
  for (const NamedSeparation& named : settings.separations) {
    const Separation::Shape shape = named.separation.shape;
    text += fmt::format(R"({}{{"name": {}, "shape": "{}", "horizontal": {}, "vertical": {})", separator,
                        json_text(named.name),
                        shape == Separation::Shape::cylinder     ? "cylinder"
                        : shape == Separation::Shape::well_clear ? "well_clear"
                                                                 : "ellipsoid",
                        json_number(named.separation.horizontal), json_number(named.separation.vertical));
    if (shape == Separation::Shape::well_clear)
      text += fmt::format(R"(, "modified_tau": {})", json_number(named.separation.modified_tau));
    text += "}";
    separator = ", ";
  }
  text += R"(], "counts": {)";
  separator = "";
  for (const WatchCount& count : counts_of(watcher)) {
    text += fmt::format(R"({}"{}": {})", separator, count.name, count.count);
    separator = ", ";
  }
  return text + "}";
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

void add_tracks(std::string& text, const Watcher& watcher) {
  const AlertContext context = watcher.context();
  const char* separator = "\n";
  for (const TrackId id : context.monitor.tracks()) {
    const TrackView view = context.monitor.track(id).value();
    const NamedTrack* const named = context.names.find(id);
    text += fmt::format(R"({}{{"id": {}, "name": {}, "stamp": {}, "silent": {}, "class": {}, "places": [)",
                        separator, json_text(context.names.text(id)),
                        named != nullptr && !named->name.empty() ? json_text(named->name) : "null",
                        json_time(context.times, view.timestamp), view.stale, class_text(context, id));
    const char* between = "";
    for (const TrackView::Place& place : view.places) {
      text += between + place_fields(watcher, place);
      between = ", ";
    }
    text += "]}";
    separator = ",\n";
  }
}

/// Adds open pairs or predicted ones.
template <class Pair>
void add_pairs(std::string& text, const Watcher& watcher, const std::vector<Pair>& pairs) {
  const AlertContext context = watcher.context();
  const char* separator = "\n";
  for (const Pair& pair : pairs) {
    const auto [first, second] = in_text_order(context.names, pair.first, pair.second);
    const PairAnswer answer = context.monitor.answer(pair.first, pair.second, pair.level).value();
    text += fmt::format(
        R"({}{{"first": {}, "second": {}, "separation": {}, "level": {}, "verdict": "{}", "since": {}, {}}})",
        separator, json_text(context.names.text(first)), json_text(context.names.text(second)),
        json_text(context.settings.separations[pair.level].name), pair.level, name_of(answer.verdict),
        json_time(context.times, pair.since), answer_fields(context, answer));
    separator = ",\n";
  }
}

void add_needs(std::string& text, const Watcher& watcher) {
  const AlertContext context = watcher.context();
  const char* separator = "\n";
  for (const ReportRequest& need : context.monitor.needed(context.monitor.time() + context.settings.window)) {
    text += fmt::format(R"({}{{"track": {}, "by": {}, "other": {}}})", separator,
                        json_text(context.names.text(need.track)), json_time(context.times, need.by),
                        json_text(context.names.text(need.other)));
    separator = ",\n";
  }
}

}  // namespace

std::string reasons_text(const Watcher& watcher) {
  std::string text;
  for (const WatchCount& count : counts_of(watcher))
    if (is_reason(count))
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
  for (const WatchCount& count : counts_of(watcher))
    text += fmt::format(R"(, "{}": {})", count.name, count.count);
  text += fmt::format(R"(, "tracks": {}, "separations": [)", watcher.names().size());
  const char* separator = "";
  for (std::size_t level = 0; level < settings.separations.size(); ++level) {
    const auto& turns = watcher.counts().turns[level];
    text +=
        fmt::format(R"({}{{"separation": {}, "undecided": {}, "within": {}, "apart": {}}})", separator,
                    json_text(settings.separations[level].name), turns.undecided, turns.within, turns.apart);
    separator = ", ";
  }
  text += R"(], "first_malformed": [)";
  separator = "";
  for (const MalformedLine& line : watcher.counts().first_malformed) {
    text += fmt::format(R"({}{{"line": {}, "reason": {}}})", separator, line.line, json_text(line.reason));
    separator = ", ";
  }
  return text + fmt::format("], \"real_seconds\": {}}}\n", json_number(real_seconds));
}

std::string watch_state_json(const Watcher& watcher) {
  std::string text = "{\"time\": ";
  text += watcher.monitor() ? json_time(watcher.context().times, watcher.monitor()->time()) : "null";
  text += ", " + setting_fields(watcher) + ",\n\"tracks\": [";
  if (watcher.monitor()) add_tracks(text, watcher);
  text += "],\n\"pairs\": [";
  if (watcher.monitor()) add_pairs(text, watcher, watcher.monitor()->open_pairs());
  text += "],\n\"predictions\": [";
  if (watcher.monitor()) add_pairs(text, watcher, watcher.monitor()->predicted_pairs());
  text += "],\n\"needed\": [";
  if (watcher.monitor()) add_needs(text, watcher);
  return text + "]}\n";
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
  std::size_t silent = 0, undecided = 0, within = 0;
  if (const auto& monitor = watcher.monitor()) {
    for (const TrackId id : monitor->tracks()) silent += monitor->track(id).value().stale ? 1 : 0;
    for (const OpenPair& pair : monitor->open_pairs())
      ++(pair.verdict == Verdict::within ? within : undecided);
  }
  add("tracks", "gauge", "tracks that are watched", static_cast<double>(watcher.names().size()));
  add("tracks_silent", "gauge", "of them silent", static_cast<double>(silent));
  add("pairs_undecided", "gauge", "pairs and separations that are undecided", static_cast<double>(undecided));
  add("pairs_within", "gauge", "pairs and separations that are certainly within",
      static_cast<double>(within));
  add("pairs_predicted", "gauge", "pairs and separations that are predicted",
      static_cast<double>(watcher.monitor() ? watcher.monitor()->predicted_pairs().size() : 0));
  add("stream_seconds", "gauge", "time of the stream that has been watched", watcher.time_covered());
  return text;
}

}  // namespace kinesphere::program
