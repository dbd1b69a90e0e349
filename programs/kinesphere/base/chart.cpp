// Charts as SVG: panels with axes, curves and text.
#include "base/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/escaped_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

/// Returns the value with enough digits to distinguish ticks `step` apart.
std::string tick_text(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
  return fmt::format("{:.{}f}", value == 0.0 ? 0.0 : value, decimals);
}

std::string clock_text(double since_1970, double step) {
  using namespace std::chrono;
  const sys_seconds second{seconds(static_cast<std::int64_t>(std::floor(since_1970)))};
  const year_month_day date{floor<days>(second)};
  const hh_mm_ss clock{second - floor<days>(second)};
  constexpr double minute = 60.0, day = 86400.0;
  if (step >= day)
    return fmt::format("{:02}-{:02}", static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  std::string text = fmt::format("{:02}:{:02}", clock.hours().count(), clock.minutes().count());
  if (step < minute) text += fmt::format(":{:02}", clock.seconds().count());
  return text;
}

}  // namespace

Panel fitted_panel(Panel panel, ChartPoint low, ChartPoint high, double x_scale) {
  const ChartPoint middle{0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
  constexpr double with_room = 1.05;
  double per_pixel =
      with_room * std::max((high.x - low.x) * x_scale / panel.width, (high.y - low.y) / panel.height);
  if (!(per_pixel > 0.0) || !std::isfinite(per_pixel)) per_pixel = 1.0;
  panel.low_x = middle.x - 0.5 * panel.width * per_pixel / x_scale;
  panel.high_x = middle.x + 0.5 * panel.width * per_pixel / x_scale;
  panel.low_y = middle.y - 0.5 * panel.height * per_pixel;
  panel.high_y = middle.y + 0.5 * panel.height * per_pixel;
  return panel;
}

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

std::vector<Tick> number_ticks(double low, double high, int wanted) {
  const auto places = ticks(low, high, wanted);
  const double step = places.size() > 1 ? places[1] - places[0] : 1.0;
  std::vector<Tick> result;
  result.reserve(places.size());
  for (const double place : places) result.push_back({place, tick_text(place, step)});
  return result;
}

std::vector<Tick> clock_ticks(double low, double high, double origin, int wanted) {
  constexpr std::array<double, 20> steps{1,   2,    5,    10,   15,    30,    60,    120,   300,    600,
                                         900, 1800, 3600, 7200, 10800, 21600, 43200, 86400, 172800, 604800};
  double step = steps.back();
  for (const double one : steps)
    if ((high - low) / one <= wanted) {
      step = one;
      break;
    }
  while ((high - low) / step > wanted) step *= 2;
  std::vector<Tick> result;
  if (!std::isfinite(high - low)) return result;
  for (double k = std::ceil((origin + low) / step); k * step <= origin + high; ++k)
    result.push_back({k * step - origin, clock_text(k * step, step)});
  return result;
}

std::string axes(const Panel& panel, const AxisLabels& labels,
                 const std::optional<std::vector<Tick>>& x_ticks) {
  std::string svg = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"white\" stroke=\"#444\"/>\n",
      panel.left, panel.top, panel.width, panel.height);
  for (const auto& [at, text] : x_ticks ? *x_ticks : number_ticks(panel.low_x, panel.high_x, 5)) {
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#e4e4e4\"/>\n",
        panel.x(at), panel.top + 0.5, panel.bottom() - 0.5);
    svg += text_at(panel.x(at), panel.bottom() + 16, text, "text-anchor=\"middle\"");
  }
  for (const auto& [at, text] : number_ticks(panel.low_y, panel.high_y, 6)) {
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#e4e4e4\"/>\n",
        panel.left + 0.5, panel.right() - 0.5, panel.y(at));
    svg += text_at(panel.left - 6, panel.y(at) + 4, text, "text-anchor=\"end\"");
  }
  svg += text_at(panel.left + panel.width / 2, panel.bottom() + 36, labels.x, "text-anchor=\"middle\"");
  svg += text_at(0, 0, labels.y,
                 fmt::format("text-anchor=\"middle\" transform=\"translate({:.1f} {:.1f}) rotate(-90)\"",
                             panel.left - 60, panel.top + panel.height / 2));
  return svg + text_at(panel.left, panel.top - 10, labels.title, "font-weight=\"bold\"");
}

std::string text_at(double x, double y, std::string_view text, std::string_view attributes) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes, xml_text(text));
}

std::string polyline(const std::vector<ChartPoint>& points, std::string_view attributes) {
  std::string svg = "<polyline points=\"";
  for (const ChartPoint& point : points) svg += fmt::format("{:.1f},{:.1f} ", point.x, point.y);
  return svg + fmt::format("\" {}/>\n", attributes);
}

std::string dots(const std::vector<ChartPoint>& points, double radius, std::string_view colour,
                 double opacity) {
  constexpr double far = 1e5;
  std::vector<std::pair<int, int>> drawn;
  drawn.reserve(points.size());
  for (const ChartPoint& point : points)
    drawn.emplace_back(static_cast<int>(std::clamp(point.x, -far, far)),
                       static_cast<int>(std::clamp(point.y, -far, far)));
  std::sort(drawn.begin(), drawn.end());
  drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
  if (drawn.empty()) return {};
  // One path, in which a dot is a line of no length with round ends.
  std::string path;
  for (const auto& [x, y] : drawn) path += fmt::format("M{} {}h0", x, y);
  return fmt::format(
      "<path d=\"{}\" stroke=\"{}\" stroke-width=\"{:.1f}\" stroke-opacity=\"{}\" "
      "stroke-linecap=\"round\"/>\n",
      path, colour, 2.0 * radius, opacity);
}

std::string clipped(const Panel& panel, std::string_view id, std::string_view content) {
  return fmt::format(
      "<clipPath id=\"{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>\n"
      "<g clip-path=\"url(#{0})\">\n{5}</g>\n",
      id, panel.left, panel.top, panel.width, panel.height, content);
}

std::string chart_svg(int width, int height, std::string_view content) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" "
      "fill=\"white\"/>\n{2}</svg>\n",
      width, height, content);
}

std::string counted(std::uint64_t count, std::string_view one, std::string_view several) {
  if (count == 1) return fmt::format("1 {}", one);
  return several.empty() ? fmt::format("{} {}s", grouped(count), one)
                         : fmt::format("{} {}", grouped(count), several);
}

void require_svg_name(const std::string& path) {
  if (!path.empty() && std::filesystem::path(path).extension() != ".svg")
    throw ProgramError(fmt::format("{}: expected a name that ends in .svg", path));
}

ChartAxes widest_axes(double x, double y, double z) {
  const int narrowest = z <= x && z <= y ? 2 : y <= x ? 1 : 0;
  return {.across = narrowest == 0 ? 1 : 0, .up = narrowest == 2 ? 1 : 2};
}

}  // namespace kinesphere::program
