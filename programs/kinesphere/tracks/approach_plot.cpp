#include "tracks/approach_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "base/chart.hpp"
#include "formats/fields/units.hpp"
#include "simulation/tracks/rectangle_approaches.hpp"
#include "tracks/track_scene.hpp"

namespace kinesphere::program {
namespace {

constexpr int curve_points = 200;  ///< points of the curve of a distance
constexpr int piece_points = 4;    ///< points of a piece of a track

/// The two axes along which a track set is widest, and their names.
struct View {
  int across = 0, up = 1;
  std::string x_label, y_label;

  ChartPoint of(const Vec3& position) const { return {position[across], position[up]}; }
};

class Picture {
 public:
  Picture(const TrackSet& track_set, const Scene& scene, const std::vector<Approach>& approaches,
          double distance)
      : track_set_(track_set),
        scene_(scene),
        approaches_(approaches),
        distance_(distance),
        closest_(closest_of(approaches, chart_colours.size())) {}

  std::string svg() { return chart_svg(1200, 520, map() + distances() + legend()); }

 private:
  Vec3 in_file(const Vec3& local) const { return track_set_.coordinates.as_in_file(local); }

  View view(const Vec3& size) const {
    if (track_set_.coordinates.are_geographic()) return {0, 1, "longitude (degrees)", "latitude (degrees)"};
    const auto [across, up] = widest_axes(size.x, size.y, size.z);
    constexpr std::array<const char*, 3> names{"x", "y", "z"};
    View view{.across = across, .up = up, .x_label = {}, .y_label = {}};
    const std::string unit = unit_of_file();
    view.x_label = fmt::format("{} ({})", names[static_cast<std::size_t>(across)], unit);
    view.y_label = fmt::format("{} ({})", names[static_cast<std::size_t>(up)], unit);
    return view;
  }

  /// Returns the unit of positions in the file.
  std::string unit_of_file() const {
    if (!track_set_.in_metres) return "unit of the file";
    const Vec3 step = in_file({1, 0, 0}) - in_file({});
    constexpr std::array<std::pair<double, const char*>, 6> units{
        {{1.0, "m"}, {1e3, "km"}, {1e-2, "cm"}, {1e-3, "mm"}, {1e-6, "um"}, {foot, "ft"}}};
    for (const auto& [metres, name] : units)
      if (std::abs(step.x * metres - 1.0) < 1e-6) return name;
    return "unit of the file";
  }
  std::string unit_of_distance() const { return track_set_.in_metres ? "m" : "unit of the file"; }
  /// Returns a distance with its unit, if it is known.
  std::string distance_text(double distance) const {
    if (track_set_.in_metres && std::abs(distance) >= 1e4) return fmt::format("{:.1f} km", distance / 1e3);
    return fmt::format("{:.4g}{}", distance, track_set_.in_metres ? " m" : "");
  }

  std::string map() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 low{infinity, infinity, infinity};
    Vec3 high = -low;
    for (const RecordedTrack& track : track_set_.tracks)
      for (const TrackSample& sample : track.samples) {
        const Vec3 at = in_file(sample.position);
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], at[axis]);
          high[axis] = std::max(high[axis], at[axis]);
        }
      }
    const View view = this->view(high - low);
    const ChartPoint lowest = view.of(low), highest = view.of(high);
    const double x_scale = track_set_.coordinates.are_geographic()
                               ? std::max(0.02, std::cos(0.5 * (lowest.y + highest.y) * 0.017453292519943295))
                               : 1.0;
    const Panel panel = fitted_panel({80, 40, 400, 420, 0, 0, 0, 0}, lowest, highest, x_scale);
    const std::string frame = axes(
        panel, {fmt::format("{}, {} closer than {}", counted(track_set_.tracks.size(), "track"),
                            counted(approaches_.size(), "approach", "approaches"), distance_text(distance_)),
                view.x_label, view.y_label});
    std::string svg;
    for (std::uint32_t track = 0; track < track_set_.tracks.size(); ++track)
      svg += polyline(
          course(track, view, panel, track_set_.tracks[track].from(), track_set_.tracks[track].until()),
          R"(fill="none" stroke="#7a8793" stroke-width="0.7" stroke-opacity="0.5")");
    // The ways of the closest pairs, for as long as their distances are drawn.
    for (std::size_t k = closest_.size(); k-- > 0;) {
      const Approach& approach = approaches_[closest_[k]];
      const auto [from, until] = shown_time(approach, time_around());
      for (const std::uint32_t track : {approach.first, approach.second})
        svg += polyline(course(track, view, panel, from, until),
                        fmt::format(R"(fill="none" stroke="{}" stroke-width="2")", chart_colours[k]));
    }
    return frame + clipped(panel, "map", svg + marks(view, panel));
  }

  /// Returns the curve of a track in this time, without points that move it by less than half a pixel.
  std::vector<ChartPoint> course(std::uint32_t track, const View& view, const Panel& panel, double from,
                                 double until) const {
    std::vector<ChartPoint> points;
    const RecordedTrack& recorded = track_set_.tracks[track];
    const auto& samples = recorded.samples;
    const auto add = [&](double time, bool always) {
      const ChartPoint at = view.of(in_file(scene_.motion->state(track, time).position));
      const ChartPoint pixel{panel.x(at.x), panel.y(at.y)};
      if (points.empty() || always || std::hypot(pixel.x - points.back().x, pixel.y - points.back().y) > 0.5)
        points.push_back(pixel);
    };
    add(from, true);
    for (std::size_t k = 0; k + 1 < samples.size(); ++k)
      for (int part = 0; part < piece_points; ++part) {
        const double time = samples[k].time + (samples[k + 1].time - samples[k].time) * part / piece_points;
        if (time > from && time < until) add(time, false);
      }
    add(until, true);
    return points;
  }

  ChartPoint middle_of(const Approach& approach, const View& view, const Panel& panel) const {
    const ChartPoint at = view.of(in_file(0.5 * (approach.closest.first + approach.closest.second)));
    return {panel.x(at.x), panel.y(at.y)};
  }

  /// Returns dots for all approaches, and rings around the closest ones.
  std::string marks(const View& view, const Panel& panel) const {
    std::vector<ChartPoint> places;
    for (const Approach& approach : approaches_) places.push_back(middle_of(approach, view, panel));
    std::string svg = dots(places, 1.6, "#222", 0.55);
    for (std::size_t k = closest_.size(); k-- > 0;) {
      const ChartPoint at = middle_of(approaches_[closest_[k]], view, panel);
      svg += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\"/>\n",
          at.x, at.y, chart_colours[k]);
    }
    return svg;
  }

  /// Returns the part of the time around the closest approach in which both tracks are present.
  std::pair<double, double> shown_time(const Approach& approach, double around) const {
    const SceneBody& first = scene_.bodies[approach.first];
    const SceneBody& second = scene_.bodies[approach.second];
    return {std::max({first.appears, second.appears, approach.closest.time - around}),
            std::min({first.vanishes, second.vanishes, approach.closest.time + around})};
  }

  double distance_at(const Approach& approach, double time) const {
    if (track_set_.has_rectangles)
      return kinesphere::distance_at(*scene_.motion, shapes_, approach.first, approach.second, time);
    return norm(scene_.motion->state(approach.first, time).position -
                scene_.motion->state(approach.second, time).position) -
           track_set_.tracks[approach.first].radius - track_set_.tracks[approach.second].radius;
  }

  /// Returns the typical duration of the drawn approaches, shown on each side of the closest.
  double time_around() const {
    std::vector<double> lengths;
    for (const std::size_t k : closest_) lengths.push_back(approaches_[k].end - approaches_[k].begin);
    if (lengths.empty()) return 1.0;
    std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                     lengths.end());
    const double length = lengths[lengths.size() / 2];
    return length > 0.0 ? length : 1.0;
  }

  std::string distances() const {
    const double around = time_around();
    constexpr double minute = 60.0, hour = 3600.0, several = 5.0;
    const double unit = around > several * hour ? hour : around > several * minute ? minute : 1.0;
    const Panel panel{570, 40, 340, 420, -around / unit, around / unit, 0.0, 2.0 * distance_};
    const std::string frame =
        axes(panel, {"Distance of the closest pairs",
                     fmt::format("time from the closest approach ({})", unit == hour     ? "h"
                                                                        : unit == minute ? "min"
                                                                                         : "s"),
                     fmt::format("distance ({})", unit_of_distance())});
    std::string svg = fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#444\" "
        "stroke-dasharray=\"5 4\"/>\n",
        panel.left, panel.right(), panel.y(distance_));
    for (std::size_t k = closest_.size(); k-- > 0;) {
      const Approach& approach = approaches_[closest_[k]];
      const auto [from, to] = shown_time(approach, around);
      std::vector<ChartPoint> points;
      for (int step = 0; step <= curve_points; ++step) {
        const double time = std::min(to, from + (to - from) * step / curve_points);
        points.push_back(
            {panel.x((time - approach.closest.time) / unit), panel.y(distance_at(approach, time))});
      }
      svg += polyline(points, fmt::format(R"(fill="none" stroke="{}" stroke-width="2")", chart_colours[k]));
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", panel.x(0.0),
                         panel.y(approach.closest.distance), chart_colours[k]);
    }
    return frame + clipped(panel, "distances", svg) +
           text_at(panel.right() - 6, panel.y(distance_) - 5,
                   fmt::format("an approach below {}", distance_text(distance_)),
                   "text-anchor=\"end\" font-size=\"11\" fill=\"#444\" stroke=\"white\" stroke-width=\"3\" "
                   "paint-order=\"stroke\"");
  }

  std::string legend() const {
    constexpr double left = 935.0;
    if (closest_.empty()) return text_at(left, 52, "No approaches.");
    std::string svg = text_at(left, 30, "The closest", "font-weight=\"bold\"") +
                      text_at(80, 512, "Each dot is an approach; rings are around the closest.",
                              R"(fill="#444" font-size="11")");
    double y = 52;
    for (std::size_t k = 0; k < closest_.size(); ++k, y += 48) {
      const Approach& approach = approaches_[closest_[k]];
      const Moment when = moment_of(track_set_.times, approach.closest.time);
      svg += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\"/>\n",
          left + 7, y - 4, chart_colours[k]);
      svg += text_at(left + 22, y,
                     fmt::format("{} and {}", shortened(track_set_.tracks[approach.first].id),
                                 shortened(track_set_.tracks[approach.second].id)));
      svg += text_at(left + 22, y + 17,
                     fmt::format("{} at {}{}{}", distance_text(approach.closest.distance), when.date,
                                 when.date.empty() ? "" : " ", when.time),
                     R"(fill="#444")");
    }
    return svg;
  }

  static std::string shortened(const std::string& id) {
    constexpr std::size_t longest = 16;
    return id.size() <= longest ? id : id.substr(0, longest) + "...";
  }

  const TrackSet& track_set_;
  const Scene& scene_;
  const std::vector<Approach>& approaches_;
  std::vector<RectangleBody> shapes_ = shapes_of(track_set_);
  double distance_;
  std::vector<std::size_t> closest_;
};

}  // namespace

std::string plot_of(const TrackSet& track_set, const Scene& scene, const std::vector<Approach>& approaches,
                    double distance) {
  return Picture(track_set, scene, approaches, distance).svg();
}

}  // namespace kinesphere::program
