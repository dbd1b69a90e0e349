#include "tracks/approach_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "simulation/tracks/rectangle_approaches.hpp"
#include "tracks/track_scene.hpp"
#include "tracks/xml_text.hpp"

namespace kinesphere::program {
namespace {

/// Colours of the closest approaches, one each; distinct for all kinds of colour vision (Okabe and Ito 2008).
constexpr std::array<std::string_view, 6> colours{"#d55e00", "#0072b2", "#009e73",
                                                  "#cc79a7", "#e69f00", "#56b4e9"};
constexpr int curve_points = 200;  ///< points of the curve of a distance
constexpr int piece_points = 4;    ///< points of a piece of a track

struct Point {
  double x, y;
};

/// A part of the picture with axes. Unit: pixels.
struct Panel {
  double left, top, width, height;
  double low_x, high_x, low_y, high_y;  ///< shown range

  double x(double value) const { return left + (value - low_x) / (high_x - low_x) * width; }
  double y(double value) const { return top + height - (value - low_y) / (high_y - low_y) * height; }
};

std::string text_at(double x, double y, std::string_view text, std::string_view more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, more, xml_text(text));
}

std::string polyline(const std::vector<Point>& points, std::string_view style) {
  std::string svg = "<polyline points=\"";
  for (const Point& point : points) svg += fmt::format("{:.1f},{:.1f} ", point.x, point.y);
  return svg + fmt::format("\" {}/>\n", style);
}

/// Returns the value with enough digits to distinguish ticks `step` apart.
std::string tick_text(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
  return fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
}

std::string axes(const Panel& panel, std::string_view title, std::string_view x_label,
                 std::string_view y_label) {
  std::string svg = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"white\" stroke=\"#444\"/>\n",
      panel.left, panel.top, panel.width, panel.height);
  const double bottom = panel.top + panel.height;
  const auto xs = ticks(panel.low_x, panel.high_x, 5);
  for (const double value : xs) {
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#e4e4e4\"/>\n",
        panel.x(value), panel.top + 0.5, bottom - 0.5);
    svg += text_at(panel.x(value), bottom + 16, tick_text(value, xs.size() > 1 ? xs[1] - xs[0] : 1.0),
                   "text-anchor=\"middle\"");
  }
  const auto ys = ticks(panel.low_y, panel.high_y, 6);
  for (const double value : ys) {
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#e4e4e4\"/>\n",
        panel.left + 0.5, panel.left + panel.width - 0.5, panel.y(value));
    svg += text_at(panel.left - 6, panel.y(value) + 4, tick_text(value, ys.size() > 1 ? ys[1] - ys[0] : 1.0),
                   "text-anchor=\"end\"");
  }
  svg += text_at(panel.left + panel.width / 2, bottom + 36, x_label, "text-anchor=\"middle\"");
  svg += text_at(0, 0, y_label,
                 fmt::format("text-anchor=\"middle\" transform=\"translate({:.1f} {:.1f}) rotate(-90)\"",
                             panel.left - 60, panel.top + panel.height / 2));
  return svg + text_at(panel.left, panel.top - 10, title, "font-weight=\"bold\"");
}

/// The two axes along which a track set is widest, and their names.
struct View {
  int across = 0, up = 1;
  std::string x_label, y_label;

  Point of(const Vec3& position) const { return {position[across], position[up]}; }
};

class Picture {
 public:
  Picture(const TrackSet& track_set, const Scene& scene, const std::vector<Approach>& approaches,
          double distance)
      : track_set_(track_set),
        scene_(scene),
        approaches_(approaches),
        distance_(distance),
        closest_(closest_of(approaches, colours.size())) {}

  std::string svg() {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1000 520\" width=\"1000\" height=\"520\" "
           "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"1000\" height=\"520\" "
           "fill=\"white\"/>\n" +
           map() + distances() + legend() + "</svg>\n";
  }

 private:
  Vec3 in_file(const Vec3& local) const { return track_set_.coordinates.as_in_file(local); }

  View view(const Vec3& size) const {
    if (track_set_.coordinates.are_geographic()) return {0, 1, "longitude (degrees)", "latitude (degrees)"};
    const int narrowest = size.z <= size.x && size.z <= size.y ? 2 : size.y <= size.x ? 1 : 0;
    View view{.across = narrowest == 0 ? 1 : 0, .up = narrowest == 2 ? 1 : 2, .x_label = {}, .y_label = {}};
    constexpr std::array<const char*, 3> names{"x", "y", "z"};
    view.x_label = fmt::format("{} (as in the file)", names[static_cast<std::size_t>(view.across)]);
    view.y_label = fmt::format("{} (as in the file)", names[static_cast<std::size_t>(view.up)]);
    return view;
  }

  /// Returns a panel with one scale for both axes; for longitudes and latitudes the scale of the middle.
  static Panel fitted(Point low, Point high, double x_scale) {
    Panel panel{80, 40, 400, 420, 0, 0, 0, 0};
    const Point middle{0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
    double per_pixel =
        1.05 * std::max((high.x - low.x) * x_scale / panel.width, (high.y - low.y) / panel.height);
    if (!(per_pixel > 0.0)) per_pixel = 1.0;
    panel.low_x = middle.x - 0.5 * panel.width * per_pixel / x_scale;
    panel.high_x = middle.x + 0.5 * panel.width * per_pixel / x_scale;
    panel.low_y = middle.y - 0.5 * panel.height * per_pixel;
    panel.high_y = middle.y + 0.5 * panel.height * per_pixel;
    return panel;
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
    const Point lowest = view.of(low), highest = view.of(high);
    const double x_scale = track_set_.coordinates.are_geographic()
                               ? std::max(0.02, std::cos(0.5 * (lowest.y + highest.y) * 0.017453292519943295))
                               : 1.0;
    const Panel panel = fitted(lowest, highest, x_scale);
    std::string svg =
        axes(panel, fmt::format("{} tracks, {} approaches", track_set_.tracks.size(), approaches_.size()),
             view.x_label, view.y_label);
    svg += fmt::format(
        "<clipPath id=\"map\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n<g "
        "clip-path=\"url(#map)\">\n",
        panel.left, panel.top, panel.width, panel.height);
    for (std::uint32_t track = 0; track < track_set_.tracks.size(); ++track)
      svg += polyline(course(track, view, panel),
                      R"(fill="none" stroke="#7a8793" stroke-width="0.7" stroke-opacity="0.5")");
    svg += marks(view, panel);
    return svg + "</g>\n";
  }

  /// Returns the curve of a track, without points that move it by less than half a pixel.
  std::vector<Point> course(std::uint32_t track, const View& view, const Panel& panel) const {
    std::vector<Point> points;
    const RecordedTrack& recorded = track_set_.tracks[track];
    const auto& samples = recorded.samples;
    const auto add = [&](double time, bool always) {
      const Point at = view.of(in_file(scene_.motion->state(track, time).position));
      const Point pixel{panel.x(at.x), panel.y(at.y)};
      if (points.empty() || always || std::hypot(pixel.x - points.back().x, pixel.y - points.back().y) > 0.5)
        points.push_back(pixel);
    };
    add(recorded.from(), true);
    for (std::size_t k = 0; k + 1 < samples.size(); ++k)
      for (int part = 0; part < piece_points; ++part)
        add(samples[k].time + (samples[k + 1].time - samples[k].time) * part / piece_points, false);
    add(recorded.until(), true);
    return points;
  }

  Point middle_of(const Approach& approach, const View& view, const Panel& panel) const {
    const Point at = view.of(in_file(0.5 * (approach.closest.first + approach.closest.second)));
    return {panel.x(at.x), panel.y(at.y)};
  }

  /// Returns one dot for all approaches in a pixel, and rings around the closest ones.
  std::string marks(const View& view, const Panel& panel) const {
    std::string svg;
    std::vector<std::pair<int, int>> drawn;
    for (const Approach& approach : approaches_) {
      const Point at = middle_of(approach, view, panel);
      drawn.emplace_back(static_cast<int>(at.x), static_cast<int>(at.y));
    }
    std::sort(drawn.begin(), drawn.end());
    drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
    for (const auto& [x, y] : drawn)
      svg += fmt::format("<circle cx=\"{}.5\" cy=\"{}.5\" r=\"1.6\" fill=\"#222\" fill-opacity=\"0.55\"/>\n",
                         x, y);
    for (std::size_t k = closest_.size(); k-- > 0;) {
      const Point at = middle_of(approaches_[closest_[k]], view, panel);
      svg += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\"/>\n",
          at.x, at.y, colours[k]);
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
    const Panel panel{590, 40, 390, 280, -around, around, 0.0, 2.0 * distance_};
    const std::string unit = track_set_.coordinates.are_geographic() ? " (m)" : " (unit of --distance)";
    std::string svg =
        axes(panel, "Distance of the closest pairs", "time from the closest approach (s)", "distance" + unit);
    svg += fmt::format(
        "<clipPath id=\"distances\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n",
        panel.left, panel.top, panel.width, panel.height);
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#444\" "
        "stroke-dasharray=\"5 4\"/>\n",
        panel.left, panel.left + panel.width, panel.y(distance_));
    svg += "<g clip-path=\"url(#distances)\">\n";
    for (std::size_t k = closest_.size(); k-- > 0;) {
      const Approach& approach = approaches_[closest_[k]];
      const auto [from, to] = shown_time(approach, around);
      std::vector<Point> points;
      for (int step = 0; step <= curve_points; ++step) {
        const double time = std::min(to, from + (to - from) * step / curve_points);
        points.push_back({panel.x(time - approach.closest.time), panel.y(distance_at(approach, time))});
      }
      svg += polyline(points, fmt::format(R"(fill="none" stroke="{}" stroke-width="2")", colours[k]));
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", panel.x(0.0),
                         panel.y(approach.closest.distance), colours[k]);
    }
    svg += "</g>\n";
    svg += text_at(panel.left + panel.width - 6, panel.y(distance_) - 5, "counts as an approach below",
                   "text-anchor=\"end\" font-size=\"11\" fill=\"#444\" stroke=\"white\" stroke-width=\"3\" "
                   "paint-order=\"stroke\"");
    return svg;
  }

  std::string legend() const {
    std::string svg;
    if (closest_.empty()) return text_at(590, 390, "No approaches.");
    svg += text_at(590, 382, "Ids, least distance and when", "font-weight=\"bold\"");
    svg += text_at(80, 512, "Each dot is an approach; rings are around the closest.",
                   R"(fill="#444" font-size="11")");
    double y = 402;
    for (std::size_t k = 0; k < closest_.size(); ++k, y += 19) {
      const Approach& approach = approaches_[closest_[k]];
      svg += fmt::format(
          "<circle cx=\"597\" cy=\"{:.1f}\" r=\"6\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\"/>\n",
          y - 4, colours[k]);
      svg += text_at(612, y,
                     fmt::format("{} and {}: {:.4g} at {}", shortened(track_set_.tracks[approach.first].id),
                                 shortened(track_set_.tracks[approach.second].id), approach.closest.distance,
                                 track_set_.times.text(approach.closest.time, 2)));
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

std::vector<double> ticks(double low, double high, int wanted) {
  std::vector<double> result;
  const double rough = (high - low) / wanted;
  if (!(rough > 0.0) || !std::isfinite(rough)) return result;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double part = rough / power;
  const double step = power * (part < 1.5 ? 1.0 : part < 3.5 ? 2.0 : part < 7.5 ? 5.0 : 10.0);
  for (double k = std::ceil(low / step); k * step <= high && result.size() < 100; ++k)
    result.push_back(k * step);
  return result;
}

std::string plot_of(const TrackSet& track_set, const Scene& scene, const std::vector<Approach>& approaches,
                    double distance) {
  return Picture(track_set, scene, approaches, distance).svg();
}

}  // namespace kinesphere::program
