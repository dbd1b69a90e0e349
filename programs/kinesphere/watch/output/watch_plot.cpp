// A picture of a watch: a map of its tracks, and when which pairs had alerts.
#include "watch/output/watch_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "base/ascii_text.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t most_places = 400'000;
constexpr std::size_t most_pairs = 10'000;
constexpr std::size_t most_spans = 1'000;  ///< of a pair
constexpr std::size_t most_rows = 14;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string_view colour_of(std::size_t rank) {
  return rank < chart_colours.size() ? chart_colours[rank] : "#7a8793";
}

}  // namespace

void WatchPlot::look() {
  if (!view_.pairs.monitor()) return;
  const double now = view_.clock.now();
  if (last_look_ && now < *last_look_ + interval_) return;
  last_look_ = now;
  for (const TrackId id : view_.monitor().tracks()) {
    const auto track = view_.monitor().track(id);
    if (!track || track->places.empty() || track->stale) continue;
    ways_[id].push_back({now, on_map(track->places.front().centre)});
    ++places_;
  }
  look_at_encounters();
  if (places_ <= most_places) return;
  places_ = 0;
  interval_ *= 2.0;
  for (auto at = ways_.begin(); at != ways_.end();) {
    auto& way = at->second;
    for (std::size_t k = 0; 2 * k < way.size(); ++k) way[k] = way[2 * k];
    way.resize(way.size() / 2);
    places_ += way.size();
    at = way.empty() ? ways_.erase(at) : std::next(at);
  }
}

/// Not all changes within an encounter are told (--only).
void WatchPlot::look_at_encounters() {
  const double now = view_.clock.now();
  std::set<std::pair<TrackId, TrackId>> predicted;
  for (const auto& open : view_.monitor().predicted_pairs()) {
    const auto [first, second] = view_.in_text_order(open.first, open.second);
    predicted.emplace(first, second);
  }
  for (Pair& pair : pairs_) {
    const bool goes_on = std::any_of(pair.spans.begin(), pair.spans.end(),
                                     [](const Span& span) { return span.until == infinity; });
    if (!goes_on) continue;
    const auto answer = view_.monitor().answer(pair.first, pair.second, pair.level);
    if (answer && answer->verdict == Verdict::within)
      begin(pair, true, now);
    else
      end(pair, true, now);
    if (!predicted.contains({pair.first, pair.second})) end(pair, false, now);
  }
}

void WatchPlot::write_event(std::uint64_t share, const MonitorEvent& event, const LeftFor& left_for) {
  next_->write_event(share, event, left_for);
  if (!is_of_pair(event.kind)) return;
  Pair* const pair = pair_of(event.first, event.second);
  if (pair == nullptr) return;
  pair->level = event.level;
  note_closest(*pair);
  if (event.kind == MonitorEventKind::predicted) begin(*pair, false, event.time);
  if (event.kind == MonitorEventKind::prediction_ended) end(*pair, false, event.time);
  if (event.kind != MonitorEventKind::verdict) return;
  if (event.verdict == Verdict::within)
    begin(*pair, true, event.time);
  else
    end(*pair, true, event.time);
}

void WatchPlot::write_lost(std::uint64_t share, const LostTrack& lost) {
  next_->write_lost(share, lost);
  Pair* const pair = pair_of(lost.key.first, lost.key.second);
  if (pair == nullptr) return;
  end(*pair, true, lost.time);
  end(*pair, false, lost.time);
}

WatchPlot::Pair* WatchPlot::pair_of(TrackId first, TrackId second) {
  const auto [one, other] = view_.in_text_order(first, second);
  const auto known = numbers_.find({one, other});
  if (known != numbers_.end()) return &pairs_[known->second];
  if (pairs_.size() >= most_pairs) return nullptr;
  numbers_.emplace(std::pair{one, other}, pairs_.size());
  return &pairs_.emplace_back(
      Pair{.first = one,
           .second = other,
           .names = fmt::format("{} and {}", name_of_track(one), name_of_track(other)),
           .level = 0,
           .spans = {},
           .closest = infinity,
           .closest_at = {},
           .closest_time = 0.0});
}

void WatchPlot::begin(Pair& pair, bool is_within, double time) {
  const bool goes_on = std::any_of(pair.spans.begin(), pair.spans.end(), [&](const Span& span) {
    return span.is_within == is_within && span.until == infinity;
  });
  if (!goes_on && pair.spans.size() < most_spans) pair.spans.push_back({is_within, time, infinity});
}

void WatchPlot::end(Pair& pair, bool is_within, double time) {
  for (Span& span : pair.spans)
    if (span.is_within == is_within && span.until == infinity) span.until = time;
}

void WatchPlot::note_closest(Pair& pair) {
  const auto answer = view_.monitor().answer(pair.first, pair.second, pair.level);
  if (!answer || !(answer->closest_distance < pair.closest)) return;
  // What is farther off than this and the look-ahead time says nothing: two that keep their distance.
  constexpr double an_hour = 3600.0;
  const double farthest = std::max(an_hour, view_.separation(pair.level).separation.look_ahead);
  if (answer->closest_time > view_.monitor().time() + farthest) return;
  const auto track = view_.monitor().track(pair.first);
  if (!track || track->places.empty()) return;
  const auto& place = track->places.front();
  const double ahead = std::clamp(answer->closest_time - view_.monitor().time(), 0.0, 1e6);
  pair.closest = answer->closest_distance;
  pair.closest_time = answer->closest_time;
  pair.closest_at = on_map(place.centre + place.velocity * ahead);
}

std::string WatchPlot::name_of_track(TrackId id) const {
  constexpr std::size_t longest = 16;
  const NamedTrack* const track = view_.track(id);
  const std::string name = without_controls(
      track != nullptr && !track->name.empty() ? track->name : view_.tracks.names().text(id));
  return name.size() <= longest ? name : name.substr(0, longest) + "...";
}

std::string WatchPlot::distance_text(double distance) const {
  if (!std::isfinite(distance)) return "unknown";
  if (!view_.tracks.map().is_geographic()) return fmt::format("{:.4g}", distance);
  return distance < 10e3 ? fmt::format("{:.0f} m", distance) : fmt::format("{:.1f} km", distance / 1e3);
}

ChartPoint WatchPlot::on_map(const Vec3& place) const {
  const auto& frame = view_.tracks.map().frame();
  const Vec3 at = frame ? frame->geographic(place) : place;
  return {at.x, at.y};
}

std::string WatchPlot::svg() const {
  std::vector<const Pair*> shown;
  for (const Pair& pair : pairs_) shown.push_back(&pair);
  std::stable_sort(shown.begin(), shown.end(),
                   [](const Pair* a, const Pair* b) { return a->closest < b->closest; });
  if (shown.size() > most_rows) shown.resize(most_rows);
  return chart_svg(1200, 520, map(shown) + times(shown));
}

std::string WatchPlot::map(const std::vector<const Pair*>& shown) const {
  ChartPoint low{infinity, infinity}, high{-infinity, -infinity};
  const auto include = [&](const ChartPoint& at) {
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  };
  for (const auto& [id, way] : ways_)
    for (const Place& place : way) include(place.at);
  if (!(low.x <= high.x)) low = high = {0.0, 0.0};
  const bool is_geographic = !ways_.empty() && view_.tracks.map().is_geographic();
  constexpr double radians = 0.017453292519943295;
  const double x_scale = is_geographic ? std::max(0.02, std::cos(0.5 * (low.y + high.y) * radians)) : 1.0;
  const Panel panel = fitted_panel({80, 40, 400, 420, 0, 0, 0, 0}, low, high, x_scale);
  const auto points_of = [&](TrackId id, double from, double until) {
    std::vector<ChartPoint> points;
    const auto way = ways_.find(id);
    if (way == ways_.end()) return points;
    for (const Place& place : way->second)
      if (place.time >= from && place.time <= until)
        points.push_back({panel.x(place.at.x), panel.y(place.at.y)});
    return points;
  };
  std::string svg;
  std::vector<TrackId> ids;
  for (const auto& [id, way] : ways_) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  for (const TrackId id : ids)
    svg += polyline(points_of(id, -infinity, infinity),
                    R"(fill="none" stroke="#7a8793" stroke-width="0.7" stroke-opacity="0.6")");
  for (std::size_t rank = std::min(shown.size(), chart_colours.size()); rank-- > 0;) {
    const Pair& pair = *shown[rank];
    for (const Span& span : pair.spans)
      for (const TrackId id : {pair.first, pair.second})
        svg += polyline(points_of(id, span.from, span.until),
                        fmt::format(R"(fill="none" stroke="{}" stroke-width="2")", colour_of(rank)));
    if (std::isfinite(pair.closest))
      svg += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\"/>\n",
          panel.x(pair.closest_at.x), panel.y(pair.closest_at.y), colour_of(rank));
  }
  const AxisLabels labels{
      fmt::format("{}, {} with alerts", counted(ways_.size(), "track"), counted(pairs_.size(), "pair")),
      is_geographic ? "longitude (degrees)" : "x (unit of the stream)",
      is_geographic ? "latitude (degrees)" : "y (unit of the stream)"};
  return axes(panel, labels) + clipped(panel, "map", svg) +
         text_at(80, 512, "Rings are where the closest approaches were expected.",
                 R"(fill="#444" font-size="11")");
}

std::string WatchPlot::times(const std::vector<const Pair*>& shown) const {
  const bool has_begun = view_.clock.has_begun();
  const double first = has_begun ? view_.clock.first() : 0.0;
  const double last = has_begun ? std::max(view_.clock.now(), first + 1.0) : 1.0;
  const Panel panel{810, 40, 370, 420, first, last, 0.0, 1.0};
  const auto origin = has_begun ? view_.clock.times().since_1970(0.0) : std::nullopt;
  const bool is_clock = has_begun && view_.clock.times().since_1970(first).has_value();
  const double zero = is_clock ? *view_.clock.times().since_1970(first) - first : origin.value_or(0.0);
  std::string x_label = "time (s)";
  if (is_clock) {
    const Moment begin = moment_of(view_.clock.times(), first);
    x_label = fmt::format("time from {}{}", begin.date, begin.time.ends_with('Z') ? " on (UTC)" : " on");
  }
  const auto x_ticks = is_clock ? clock_ticks(first, last, zero, 6) : number_ticks(first, last, 5);
  std::string svg = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"white\" stroke=\"#444\"/>\n",
      panel.left, panel.top, panel.width, panel.height);
  for (const auto& [at, text] : x_ticks)
    svg += fmt::format(
               "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" "
               "stroke=\"#e4e4e4\"/>\n",
               panel.x(at), panel.top + 0.5, panel.bottom() - 0.5) +
           text_at(panel.x(at), panel.bottom() + 16, text, "text-anchor=\"middle\"");
  svg += text_at(panel.left + panel.width / 2, panel.bottom() + 36, x_label, "text-anchor=\"middle\"");
  svg += text_at(panel.left, panel.top - 10, "Thin: predicted. Thick: certainly within.",
                 "font-weight=\"bold\"");
  if (shown.empty()) return svg + text_at(panel.left + 12, panel.top + 24, "No alerts.");
  constexpr double row = 30.0;
  for (std::size_t rank = 0; rank < shown.size(); ++rank) {
    const Pair& pair = *shown[rank];
    const double y = panel.top + row * (static_cast<double>(rank) + 0.5);
    svg += text_at(panel.left - 12, y, pair.names, "text-anchor=\"end\"");
    if (std::isfinite(pair.closest))
      svg += text_at(panel.left - 12, y + 13,
                     fmt::format("closest {} at {}", distance_text(pair.closest),
                                 moment_of(view_.clock.times(), pair.closest_time).time),
                     R"(text-anchor="end" fill="#444" font-size="11")");
    for (const Span& span : pair.spans) {
      const double left = panel.x(std::max(span.from, first)), right = panel.x(std::min(span.until, last));
      const double height = span.is_within ? 14.0 : 4.0;
      svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                         left, y + 2 - height / 2, std::max(2.0, right - left), height, colour_of(rank));
    }
  }
  return svg;
}

}  // namespace kinesphere::program
