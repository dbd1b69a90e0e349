// Alerts as short lines for people (`--text`).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/ascii_text.hpp"
#include "formats/fields/units.hpp"
#include "watch/output/alert_lines.hpp"
#include "watch/output/pair_distance.hpp"

namespace kinesphere::program {
namespace {

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  constexpr std::int64_t minute = 60, hour = 3600;
  if (whole < 2 * minute) return fmt::format("{} s", whole);
  if (whole < hour) return fmt::format("{} min {} s", whole / minute, whole % minute);
  return fmt::format("{} h {} min", whole / hour, whole / minute % 60);
}

std::string_view what_of(const MonitorEvent& event) {
  if (event.kind == MonitorEventKind::verdict)
    return event.verdict == Verdict::apart && event.before == Verdict::within ? "over"
                                                                              : name_of(event.verdict);
  return event.kind == MonitorEventKind::prediction_ended ? "over" : name_of(event.kind);
}

std::string goes_on_text(const LeftFor& left_for) {
  return fmt::format("goes on as {}", without_controls(left_for.later));
}

class TextAlerts final : public AlertDesk::Next {
 public:
  TextAlerts(const WatchView& view, AlertFn write) : view_(view), write_(std::move(write)) {}

  void write_event(std::uint64_t share, const MonitorEvent& event, const LeftFor& left_for) override {
    if (is_of_pair(event.kind))
      return write(share, event.time, what_of(event), pair_text(event.first, event.second),
                   pair_event_text(event));
    std::string more;
    if (event.kind == MonitorEventKind::dropped)
      more = left_for.later.empty() ? std::string(left_for.reason) : goes_on_text(left_for);
    write(share, event.time, name_of(event.kind), name_of_track(event.first), more);
  }
  void write_lost(std::uint64_t share, const LostTrack& lost) override {
    const auto& [time, track, key, encounter, left_for] = lost;
    const std::string what = !left_for.later.empty()      ? goes_on_text(left_for)
                             : left_for.reason == "stale" ? "is stale"
                                                          : "was dropped";
    write(
        share, time, "lost", pair_text(key.first, key.second),
        fmt::format("{} {}; closest {}, expected at {}", name_of_track(track), what,
                    length_text(encounter.loss->closest_distance), clock_text(encounter.loss->closest_time)));
  }
  void write_one_body(std::uint64_t share, double time, TrackId a, TrackId b) override {
    write(share, time, "one body", pair_text(a, b),
          "one sender under two ids, or two side by side: place and velocity are the same");
  }
  void write_group(std::uint64_t share, double time, const std::string& name, std::size_t tracks) override {
    write(share, time, "group", name, fmt::format("{} tracks stand there", tracks));
  }
  void write_refused(std::uint64_t share, const AlertPolicy::Refused& refused) override {
    write(share, refused.since + 1.0, "held back",
          fmt::format("{} alerts of the last second", refused.alerts), "");
  }

 private:
  /// Names of alerts stand in a column that is as wide as the longest one that may come.
  void write(std::uint64_t share, double time, std::string_view what, std::string_view whom,
             std::string_view more) const {
    constexpr std::size_t of_pairs = 9, of_tracks = 13;
    const std::size_t width = view_.settings.kinds.tracks ? of_tracks : of_pairs;
    write_(share, fmt::format("{}  {:<{}}  {}{}{}\n", clock_text(time), what, width, whom,
                              more.empty() ? "" : ": ", more));
  }

  /// Returns the time of day, and before it the date on all days but the first one of the stream.
  std::string clock_text(double time) const {
    const TimeScale& times = view_.clock.times();
    const Moment moment = moment_of(times, time);
    const bool is_first_day = moment.date == moment_of(times, view_.clock.first()).date;
    return is_first_day ? moment.time : fmt::format("{} {}", moment.date, moment.time);
  }

  /// Returns a length in nautical miles if separations are given in these, in metres or kilometres on the
  /// earth, and otherwise as a number of the stream's unit.
  std::string length_text(double length) const {
    if (!std::isfinite(length)) return "unknown";
    const auto& separations = view_.settings.separations;
    const bool in_miles =
        std::any_of(separations.begin(), separations.end(),
                    [](const NamedSeparation& named) { return named.name.find("NM") != std::string::npos; });
    constexpr double mile = 1852.0;
    if (in_miles) return fmt::format("{:.2f} NM", length / mile);
    constexpr double many_digits = 1e4;
    if (!view_.tracks.map().is_geographic())
      return length < many_digits ? fmt::format("{:.4g}", length) : fmt::format("{:.0f}", length);
    return length < 10e3 ? fmt::format("{:.0f} m", length) : fmt::format("{:.1f} km", length / 1e3);
  }

  /// Returns a height in feet if the separation is given in these, and otherwise as length_text() does where
  /// no separation is in miles.
  std::string height_text(const NamedSeparation& named, double height) const {
    if (named.name.find("ft") != std::string::npos || named.name.starts_with("do365"))
      return fmt::format("{:.0f} ft", height / foot);
    if (view_.tracks.map().is_geographic()) return fmt::format("{:.0f} m", height);
    return fmt::format("{:.4g}", height);
  }

  /// Returns the name of a track, or its id if it has none. Both are text of the stream.
  std::string name_of_track(TrackId id) const {
    const NamedTrack* const track = view_.track(id);
    return without_controls(track != nullptr && !track->name.empty() ? track->name
                                                                     : view_.tracks.names().text(id));
  }
  std::string pair_text(TrackId one, TrackId other) const {
    const auto [first, second] = view_.in_text_order(one, other);
    return fmt::format("{} and {}", name_of_track(first), name_of_track(second));
  }

  bool lacks_height(TrackId id) const {
    const NamedTrack* const track = view_.track(id);
    return track != nullptr && track->declared.height_by == unknown_height;
  }

  /// Returns ", now 0.44 NM" with the limits of that distance, if these say something else than it does.
  std::string now_text(const PairAnswer& answer, double likely) const {
    const double lower = answer.lower / view_.tracks.map().stretch(), upper = answer.upper;
    std::string text = fmt::format(", now {}", length_text(likely));
    constexpr double much = 2.0;
    if (lower * much < likely || upper > much * likely)
      text += fmt::format(" ({} to {})", length_text(lower), length_text(upper));
    return text;
  }

  std::string pair_event_text(const MonitorEvent& event) const {
    const NamedSeparation& named = view_.separation(event.level);
    const auto answer = view_.monitor().answer(event.first, event.second, event.level);
    if (!answer) return named.name;
    const PairDistance now = distance_now(view_.monitor(), named.separation, event.first, event.second);
    const bool has_vertical = now.vertical && named.separation.shape != Separation::Shape::ellipsoid;
    const auto vertical_text = [&](double height) {
      if (!has_vertical) return std::string();
      return lacks_height(event.first) || lacks_height(event.second)
                 ? " at any height"
                 : fmt::format(" and {}", height_text(named, height));
    };
    std::string text =
        named.name + now_text(*answer, now.likely) + vertical_text(now.vertical ? now.vertical->likely : 0.0);
    // What is farther off than this and the look-ahead time says nothing: two that keep their distance.
    constexpr double an_hour = 3600.0;
    const double to_go = answer->closest_time - event.time;
    if (to_go > 0.0 && to_go <= std::max(an_hour, named.separation.look_ahead))
      text += fmt::format(", closest {}{} in {}", length_text(answer->closest_distance),
                          vertical_text(answer->closest_vertical), duration_text(to_go));
    return text;
  }

  const WatchView& view_;
  AlertFn write_;
};

}  // namespace

std::unique_ptr<AlertDesk::Next> make_text_alerts(const WatchView& view, AlertFn write) {
  return std::make_unique<TextAlerts>(view, std::move(write));
}

}  // namespace kinesphere::program
