#include "watch/alert_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/ascii_text.hpp"
#include "formats/fields/units.hpp"
#include "watch/pair_distance.hpp"

namespace kinesphere::program {
namespace {

/// A time as a date and a time of day; the date is empty for a stream without dates.
struct Moment {
  std::string date, time;
};

/// Returns a date and the time of day in UTC for a date or seconds since 1970; otherwise the number of the
/// stream.
Moment moment_of(const TimeScale& times, double time) {
  if (!times.is_number()) {
    const std::string text = times.text(time, 0);
    const std::size_t day = text.find('T');
    return day == std::string::npos ? Moment{{}, text} : Moment{text.substr(0, day), text.substr(day + 1)};
  }
  const std::string number = times.text(time, 1);
  constexpr double earliest_date = 1e8;  // in 1973
  const double seconds = std::strtod(number.c_str(), nullptr);
  if (seconds < earliest_date) return {{}, number};
  using namespace std::chrono;
  const sys_seconds second{std::chrono::seconds(static_cast<std::int64_t>(std::floor(seconds)))};
  const year_month_day day{floor<days>(second)};
  const hh_mm_ss clock{second - floor<days>(second)};
  return {fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                      static_cast<unsigned>(day.day())),
          fmt::format("{:02}:{:02}:{:02}Z", clock.hours().count(), clock.minutes().count(),
                      clock.seconds().count())};
}

/// Returns the time of day, and before it the date on all days but the first one of the stream.
std::string clock_text(const AlertContext& context, double time) {
  const Moment moment = moment_of(context.times, time);
  const bool is_first_day = moment.date == moment_of(context.times, context.first_time).date;
  return is_first_day ? moment.time : fmt::format("{} {}", moment.date, moment.time);
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  constexpr std::int64_t minute = 60, hour = 3600;
  if (whole < 2 * minute) return fmt::format("{} s", whole);
  if (whole < hour) return fmt::format("{} min {} s", whole / minute, whole % minute);
  return fmt::format("{} h {} min", whole / hour, whole / minute % 60);
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

/// Returns a height in feet if the separation is given in these, and otherwise as length_text() does where no
/// separation is in miles.
std::string height_text(const AlertContext& context, const NamedSeparation& named, double height) {
  if (named.name.find("ft") != std::string::npos || named.name.starts_with("do365"))
    return fmt::format("{:.0f} ft", height / foot);
  if (context.is_geographic) return fmt::format("{:.0f} m", height);
  return fmt::format("{:.4g}", height);
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

/// Names of alerts stand in a column that is as wide as the longest one that may come.
std::string line_of(const AlertContext& context, double time, std::string_view what, std::string_view whom,
                    std::string_view more) {
  constexpr std::size_t of_pairs = 9, of_tracks = 13;
  const std::size_t width = context.settings.kinds.tracks ? of_tracks : of_pairs;
  return fmt::format("{}  {:<{}}  {}{}{}\n", clock_text(context, time), what, width, whom,
                     more.empty() ? "" : ": ", more);
}

std::string_view what_of(const MonitorEvent& event) {
  if (event.kind == MonitorEventKind::verdict)
    return event.verdict == Verdict::apart && event.before == Verdict::within ? "over"
                                                                              : name_of(event.verdict);
  return event.kind == MonitorEventKind::prediction_ended ? "over" : name_of(event.kind);
}

/// True if the height of one of the two is not known.
bool lacks_height(const AlertContext& context, const MonitorEvent& event) {
  for (const TrackId id : {event.first, event.second})
    if (const NamedTrack* const track = context.names.find(id);
        track != nullptr && track->height_by == unknown_height)
      return true;
  return false;
}

/// Returns ", now 0.44 NM" with the limits of that distance, if these say something else than it does.
std::string now_text(const AlertContext& context, const PairAnswer& answer, double likely) {
  const double lower = answer.lower / context.stretch, upper = answer.upper;
  std::string text = fmt::format(", now {}", length_text(context, likely));
  constexpr double much = 2.0;
  if (lower * much < likely || upper > much * likely)
    text += fmt::format(" ({} to {})", length_text(context, lower), length_text(context, upper));
  return text;
}

std::string text_of_pair(const AlertContext& context, const MonitorEvent& event) {
  const auto answer = context.monitor.answer(event.first, event.second, event.level);
  const NamedSeparation& named = context.settings.separations[event.level];
  std::string more = named.name;
  if (answer) {
    const PairDistance now = distance_now(context.monitor, named.separation, event.first, event.second);
    const bool has_vertical = now.vertical && named.separation.shape != Separation::Shape::ellipsoid;
    const auto vertical_text = [&](double height) {
      if (!has_vertical) return std::string();
      return lacks_height(context, event) ? " at any height"
                                          : fmt::format(" and {}", height_text(context, named, height));
    };
    more += now_text(context, *answer, now.likely) + vertical_text(now.vertical ? now.vertical->likely : 0.0);
    // What is farther off than this and the look-ahead time says nothing: two that keep their distance.
    constexpr double an_hour = 3600.0;
    const double to_go = answer->closest_time - event.time;
    if (to_go > 0.0 && to_go <= std::max(an_hour, named.separation.look_ahead))
      more += fmt::format(", closest {}{} in {}", length_text(context, answer->closest_distance),
                          vertical_text(answer->closest_vertical), duration_text(to_go));
  }
  return line_of(context, event.time, what_of(event), pair_text(context, event.first, event.second), more);
}

std::string goes_on_text(const LeftFor& left_for) {
  return fmt::format("goes on as {}", without_controls(left_for.later));
}

}  // namespace

std::string alert_text(const AlertContext& context, const MonitorEvent& event, const LeftFor& left_for) {
  if (is_of_pair(event.kind)) return text_of_pair(context, event);
  std::string more;
  if (event.kind == MonitorEventKind::dropped)
    more = left_for.later.empty() ? std::string(left_for.reason) : goes_on_text(left_for);
  return line_of(context, event.time, name_of(event.kind), name_in_text(context, event.first), more);
}

std::string lost_text(const AlertContext& context, const LostTrack& lost) {
  const auto& [time, track, key, encounter, left_for] = lost;
  const std::string what = !left_for.later.empty()      ? goes_on_text(left_for)
                           : left_for.reason == "stale" ? "is stale"
                                                        : "was dropped";
  const std::string more = fmt::format("{} {}; closest {}, expected at {}", name_in_text(context, track),
                                       what, length_text(context, encounter.loss->closest_distance),
                                       clock_text(context, encounter.loss->closest_time));
  return line_of(context, time, "lost", pair_text(context, key.first, key.second), more);
}

std::string one_body_text(const AlertContext& context, double time, TrackId a, TrackId b) {
  return line_of(context, time, "one body", pair_text(context, a, b),
                 "one sender under two ids, or two side by side: place and velocity are the same");
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
