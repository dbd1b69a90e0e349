#include "watch/alert_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/ascii_text.hpp"

namespace kinesphere::program {
namespace {

/// Returns the time of day in UTC for a date or seconds since 1970; otherwise the number of the stream.
std::string clock_text(const TimeScale& times, double time) {
  if (!times.is_number()) {
    const std::string date = times.text(time, 0);
    const std::size_t day = date.find('T');
    return day == std::string::npos ? date : date.substr(day + 1);
  }
  const std::string number = times.text(time, 1);
  constexpr double earliest_date = 1e8;  // in 1973
  const double seconds = std::strtod(number.c_str(), nullptr);
  if (seconds < earliest_date) return number;
  const auto second = static_cast<std::int64_t>(std::floor(seconds)) % 86400;
  return fmt::format("{:02}:{:02}:{:02}Z", second / 3600, second / 60 % 60, second % 60);
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  return whole < 120 ? fmt::format("{} s", whole) : fmt::format("{} min {} s", whole / 60, whole % 60);
}

/// Returns a length in nautical miles if separations are given in these, in metres or kilometres on the
/// earth, and otherwise as a number of the stream's unit.
std::string length_text(const AlertContext& context, double length) {
  if (!std::isfinite(length)) return "unknown";
  const auto& separations = context.settings.separations;
  const bool in_miles = std::any_of(separations.begin(), separations.end(), [](const NamedSeparation& named) {
    return named.name.find("NM") != std::string::npos;
  });
  constexpr double mile = 1852.0;
  if (in_miles) return fmt::format("{:.2f} NM", length / mile);
  constexpr double many_digits = 1e4;
  if (!context.is_geographic)
    return length < many_digits ? fmt::format("{:.4g}", length) : fmt::format("{:.0f}", length);
  return length < 10e3 ? fmt::format("{:.0f} m", length) : fmt::format("{:.1f} km", length / 1e3);
}

/// Returns the name of a track, or its id if it has none. Both are text of the stream.
std::string name_in_text(const AlertContext& context, TrackId id) {
  const NamedTrack* const track = context.names.find(id);
  return without_controls(track != nullptr && !track->name.empty() ? track->name : context.names.text(id));
}

std::string pair_text(const AlertContext& context, TrackId one, TrackId other) {
  const auto [first, second] = in_text_order(context.names, one, other);
  return fmt::format("{} and {}", name_in_text(context, first), name_in_text(context, second));
}

std::string line_of(const AlertContext& context, double time, std::string_view what, std::string_view whom,
                    std::string_view more) {
  return fmt::format("{}  {:<11}{}{}{}\n", clock_text(context.times, time), what, whom,
                     more.empty() ? "" : ": ", more);
}

std::string_view what_of(const MonitorEvent& event) {
  if (event.kind == MonitorEventKind::verdict)
    return event.verdict == Verdict::apart && event.before == Verdict::within ? "over"
                                                                              : name_of(event.verdict);
  return event.kind == MonitorEventKind::prediction_ended ? "over" : name_of(event.kind);
}

std::string text_of_pair(const AlertContext& context, const MonitorEvent& event) {
  const auto answer = context.monitor.answer(event.first, event.second, event.level);
  std::string more = context.settings.separations[event.level].name;
  if (answer) {
    const double to_go = answer->closest_time - event.time;
    const double now = 0.5 * (answer->lower / context.stretch + answer->upper);
    more += fmt::format(", now {}", length_text(context, now));
    // What is farther off says nothing: two that keep their distance.
    constexpr double an_hour = 3600.0;
    if (to_go > 0.0 && to_go <= an_hour)
      more += fmt::format(", closest {} in {}", length_text(context, answer->closest_distance),
                          duration_text(to_go));
  }
  return line_of(context, event.time, what_of(event), pair_text(context, event.first, event.second), more);
}

}  // namespace

std::string alert_text(const AlertContext& context, const MonitorEvent& event, std::string_view left_for) {
  if (is_of_pair(event.kind)) return text_of_pair(context, event);
  return line_of(context, event.time, name_of(event.kind), name_in_text(context, event.first),
                 event.kind == MonitorEventKind::dropped ? left_for : "");
}

std::string lost_text(const AlertContext& context, const MonitorEvent& event, const AlertPolicy::Key& key,
                      const Encounter& encounter) {
  const std::string more =
      fmt::format("{} {}; closest {}, expected at {}", name_in_text(context, event.first),
                  event.kind == MonitorEventKind::stale ? "is stale" : "was dropped",
                  length_text(context, encounter.loss->closest_distance),
                  clock_text(context.times, encounter.loss->closest_time));
  return line_of(context, event.time, "lost", pair_text(context, key.first, key.second), more);
}

std::string refused_text(const AlertContext& context, const AlertPolicy::Refused& refused) {
  return line_of(context, refused.since + 1.0, "held back",
                 fmt::format("{} alerts of the last second", refused.alerts), "");
}

std::string group_text(const AlertContext& context, double time, const std::string& name,
                       std::size_t tracks) {
  return line_of(context, time, "group", name, fmt::format("{} tracks stand there", tracks));
}

}  // namespace kinesphere::program
