// Alerts as JSON lines.
#include "watch/alerts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/json_text.hpp"
#include "watch/alert_text.hpp"
#include "watch/pair_distance.hpp"

namespace kinesphere::program {
namespace {

/// Returns the fields of an alert about a pair: a verdict or a prediction.
std::string pair_alert_fields(const AlertContext& context, const MonitorEvent& event) {
  const auto [first, second] = in_text_order(context.names, event.first, event.second);
  const auto answer = context.monitor.answer(event.first, event.second, event.level);
  std::string line = fmt::format(R"("first": {}, "second": {}, "separation": {}, "level": {})",
                                 json_text(context.names.text(first)), json_text(context.names.text(second)),
                                 json_text(context.settings.separations[event.level].name), event.level);
  if (event.kind == MonitorEventKind::verdict)
    line +=
        fmt::format(R"(, "verdict": "{}", "before": "{}")", name_of(event.verdict), name_of(event.before));
  else if (answer)
    line += fmt::format(R"(, "verdict": "{}")", name_of(answer->verdict));
  line += fmt::format(R"(, "since": {})", json_time(context.times, event.since));
  if (answer) line += ", " + answer_fields(context, {first, second}, event.level, answer.value());
  const NamedTrack* const one = context.names.find(first);
  const NamedTrack* const other = context.names.find(second);
  if (one != nullptr && other != nullptr)
    line += fmt::format(R"(, "rests_on": {{"first": {}, "second": {}, "both": {}}})",
                        json_text(declarations_of(*one)), json_text(declarations_of(*other)),
                        json_text(context.settings.classes.promise(one->motion_class, other->motion_class)));
  return line;
}

/// Returns the field that names the track that goes on as one that has left; empty without one.
std::string goes_on_field(const LeftFor& left_for) {
  return left_for.later.empty() ? "" : fmt::format(R"(, "goes_on_as": {})", json_text(left_for.later));
}

}  // namespace

OrderedPair in_text_order(const TrackNames& names, TrackId a, TrackId b) {
  return names.text(b) < names.text(a) ? OrderedPair{b, a} : OrderedPair{a, b};
}

std::string json_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

std::string json_time(const TimeScale& times, double time) {
  if (!std::isfinite(time)) return "null";
  constexpr int decimals = 6;
  const std::string text = times.text(time, decimals);
  return times.is_number() ? text : fmt::format("\"{}\"", text);
}

std::string answer_fields(const AlertContext& context, const OrderedPair& pair, std::uint32_t level,
                          const PairAnswer& answer) {
  const auto length = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "null";
  };
  const PairDistance now =
      distance_now(context.monitor, context.settings.separations[level].separation, pair.first, pair.second);
  std::string line =
      fmt::format(R"("distance": [{}, {}], "likely_distance": {}, )", length(answer.lower / context.stretch),
                  length(answer.upper), length(now.likely));
  line += now.vertical ? fmt::format(R"("vertical_distance": [{}, {}], "likely_vertical": {}, )",
                                     length(now.vertical->lower), length(now.vertical->upper),
                                     length(now.vertical->likely))
                       : R"("vertical_distance": null, "likely_vertical": null, )";
  line += fmt::format(
      R"("until": {}, "closest_distance": {}, "closest_time": {}, "likely_time": {}, "ask": {}, "ask_by": {})",
      json_time(context.times, answer.until), length(answer.closest_distance),
      json_time(context.times, answer.closest_time), json_time(context.times, answer.likely_time),
      json_text(context.names.text(answer.ask)), json_time(context.times, answer.ask_by));
  return line +
         fmt::format(
             R"(, "closest_horizontal": {}, "closest_vertical": {}, "relative_speed": {}, "avoidable_until": {}, "inevitable_by": {})",
             length(answer.closest_horizontal), length(answer.closest_vertical),
             length(answer.relative_speed), json_time(context.times, answer.avoidable_until),
             json_time(context.times, answer.inevitable_by));
}

std::string declarations_of(const NamedTrack& track) {
  std::string text;
  const auto add = [&](const char* what, std::string_view declaration) {
    if (declaration.empty()) return;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", what, declaration);
  };
  add("position", track.position_by);
  if (track.extent > 0.0) add("extent", fmt::format("{:.4g}", track.extent));
  add("height", track.height_by);
  add("velocity", track.velocity_by);
  add("climb", track.climb_by);
  return text;
}

std::string lost_line(const AlertContext& context, const LostTrack& lost) {
  if (context.settings.text) return lost_text(context, lost);
  const auto& [time, track, key, encounter, left_for] = lost;
  const auto [first, second] = in_text_order(context.names, key.first, key.second);
  return fmt::format(
      R"({{"event": "lost", "time": {}, "track": {}, "reason": "{}"{}, "first": {}, "second": {}, )"
      R"("separation": {}, "level": {}, "predicted": {}, "within": {}, "closest_distance": {:.6g}, )"
      R"("closest_time": {}}})"
      "\n",
      json_time(context.times, time), json_text(context.names.text(track)), left_for.reason,
      goes_on_field(left_for), json_text(context.names.text(first)), json_text(context.names.text(second)),
      json_text(context.settings.separations[key.level].name), key.level, encounter.predicted,
      encounter.within, encounter.loss->closest_distance,
      json_time(context.times, encounter.loss->closest_time));
}

std::string one_body_line(const AlertContext& context, double time, TrackId a, TrackId b) {
  if (context.settings.text) return one_body_text(context, time, a, b);
  const auto [first, second] = in_text_order(context.names, a, b);
  return fmt::format(R"({{"event": "one_body", "time": {}, "first": {}, "second": {}}})"
                     "\n",
                     json_time(context.times, time), json_text(context.names.text(first)),
                     json_text(context.names.text(second)));
}

std::string group_line(const AlertContext& context, double time, const std::string& name,
                       std::size_t tracks) {
  if (context.settings.text) return group_text(context, time, name, tracks);
  return fmt::format(R"({{"event": "group", "time": {}, "track": {}, "tracks": {}}})"
                     "\n",
                     json_time(context.times, time), json_text(name), tracks);
}

std::string refused_line(const AlertContext& context, const AlertPolicy::Refused& refused) {
  if (context.settings.text) return refused_text(context, refused);
  return fmt::format(R"({{"event": "held_back", "time": {}, "since": {}, "alerts": {}}})"
                     "\n",
                     json_time(context.times, refused.since + 1.0), json_time(context.times, refused.since),
                     refused.alerts);
}

std::string alert_line(const AlertContext& context, const MonitorEvent& event, const LeftFor& left_for) {
  if (context.settings.text) return alert_text(context, event, left_for);
  std::string line = fmt::format(R"({{"event": "{}", "time": {}, )", name_of(event.kind),
                                 json_time(context.times, event.time));
  if (is_of_pair(event.kind)) return line + pair_alert_fields(context, event) + "}\n";
  line += fmt::format(R"("track": {})", json_text(context.names.text(event.first)));
  const NamedTrack* const track = context.names.find(event.first);
  if (event.kind == MonitorEventKind::dropped)
    line += fmt::format(R"(, "reason": "{}"{})", left_for.reason, goes_on_field(left_for));
  if (event.kind == MonitorEventKind::contradiction) {
    line += fmt::format(R"(, "position_excess": {}, "velocity_excess": {})",
                        json_number(event.position_excess), json_number(event.velocity_excess));
    if (track != nullptr)
      line += fmt::format(R"(, "rests_on": {{"track": {}, "both": {}}})", json_text(declarations_of(*track)),
                          json_text(context.settings.classes.promise(track->motion_class)));
  }
  if (event.kind == MonitorEventKind::reclassified && track != nullptr)
    line += fmt::format(R"(, "class": {})", json_text(context.settings.classes.promise(track->motion_class)));
  return line + "}\n";
}

}  // namespace kinesphere::program
