// Charts as SVG: panels with axes, curves and text. Unit of places: pixels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinesphere::program {

/// Colours distinct for all kinds of colour vision (Okabe and Ito 2008).
inline constexpr std::array<std::string_view, 6> chart_colours{"#d55e00", "#0072b2", "#009e73",
                                                               "#cc79a7", "#e69f00", "#56b4e9"};

struct ChartPoint {
  double x, y;
};

/// A part of a chart with axes.
struct Panel {
  double left, top, width, height;
  double low_x, high_x, low_y, high_y;  ///< shown range

  double x(double value) const { return left + (value - low_x) / (high_x - low_x) * width; }
  double y(double value) const { return top + height - (value - low_y) / (high_y - low_y) * height; }
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

/// Returns a panel with one scale for both axes, where a unit of x is `x_scale` times as long as one of y.
Panel fitted_panel(Panel panel, ChartPoint low, ChartPoint high, double x_scale = 1.0);

/// Returns round numbers from `low` to `high`, about `wanted` of them: multiples of 1, 2 or 5 times a power
/// of ten.
std::vector<double> ticks(double low, double high, int wanted);

struct Tick {
  double at;
  std::string text;
};
/// Returns ticks() with enough digits to distinguish them.
std::vector<Tick> number_ticks(double low, double high, int wanted);
/// Returns ticks at round times of day, at most `wanted`, from `low` to `high` seconds behind a time that is
/// `origin` seconds since 1970 (UTC); dates where they are days apart.
std::vector<Tick> clock_ticks(double low, double high, double origin, int wanted);

struct AxisLabels {
  std::string title, x, y;
};
/// Returns the frame of a panel with ticks, by default about five and six numbers.
std::string axes(const Panel& panel, const AxisLabels& labels,
                 const std::optional<std::vector<Tick>>& x_ticks = {});

std::string text_at(double x, double y, std::string_view text, std::string_view attributes = "");
std::string polyline(const std::vector<ChartPoint>& points, std::string_view attributes);
/// Returns dots of this radius, one for all points in a pixel.
std::string dots(const std::vector<ChartPoint>& points, double radius, std::string_view colour,
                 double opacity);
/// Returns content of which only what lies in the panel is shown. `id` must be unique in the chart.
std::string clipped(const Panel& panel, std::string_view id, std::string_view content);
/// Returns the whole picture, on white.
std::string chart_svg(int width, int height, std::string_view content);

/// Returns "1 approach", "2,000 approaches"; the plural is `one` and "s" where it is not given.
std::string counted(std::uint64_t count, std::string_view one, std::string_view several = "");

/// Refuses names of pictures that do not end in .svg. Throws ProgramError.
void require_svg_name(const std::string& path);

/// Returns the two axes (0 to 2) along which a space of this size is widest, x before y before z.
struct ChartAxes {
  int across = 0, up = 1;
};
ChartAxes widest_axes(double x, double y, double z);

}  // namespace kinesphere::program
