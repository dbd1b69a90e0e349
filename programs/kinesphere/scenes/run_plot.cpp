// A picture of a run: where contacts were, how many there were at each time, and how fast.
#include "scenes/run_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/chart.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t most_kept = 400'000;
constexpr std::string_view body_colour = chart_colours[0], wall_colour = chart_colours[1];

}  // namespace

RunPlot::RunPlot(std::string name, const Scene& scene)
    : name_(std::move(name)), start_(scene.world.start_time), end_(scene.end_time) {}

void RunPlot::add(const Event& event) {
  const bool is_of_wall = event.kind == EventKind::wall_begin;
  if (!is_of_wall && event.kind != EventKind::contact_begin) return;
  const double part = end_ > start_ ? (event.time - start_) / (end_ - start_) : 0.0;
  const auto bin = static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * bins);
  ++(is_of_wall ? of_walls_ : of_bodies_)[std::min(bin, bins - 1)];
  if (seen_++ % stride_ != 0) return;
  kept_.push_back({event.point, event.approach_speed, is_of_wall});
  if (kept_.size() <= most_kept) return;
  for (std::size_t k = 0; 2 * k < kept_.size(); ++k) kept_[k] = kept_[2 * k];
  kept_.resize((kept_.size() + 1) / 2);
  stride_ *= 2;
}

std::string RunPlot::svg() const { return chart_svg(1000, 520, map() + rates() + speeds()); }

std::string RunPlot::map() const {
  const auto count = [](const Counts& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  };
  Vec3 low{}, high{};
  for (std::size_t k = 0; k < kept_.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = k == 0 ? kept_[k].point[axis] : std::min(low[axis], kept_[k].point[axis]);
      high[axis] = k == 0 ? kept_[k].point[axis] : std::max(high[axis], kept_[k].point[axis]);
    }
  const Vec3 size = high - low;
  const auto [across, up] = widest_axes(size.x, size.y, size.z);
  const Panel panel =
      fitted_panel({80, 40, 400, 420, 0, 0, 0, 0}, {low[across], low[up]}, {high[across], high[up]});
  constexpr std::string_view names = "xyz";
  std::string text = fmt::format("{}: {}", name_, counted(count(of_bodies_), "contact"));
  if (const auto walls = count(of_walls_); walls > 0)
    text += fmt::format(", {}", counted(walls, "wall contact"));
  const std::string frame =
      axes(panel, {text, fmt::format("{} (length)", names[static_cast<std::size_t>(across)]),
                   fmt::format("{} (length)", names[static_cast<std::size_t>(up)])});
  std::vector<ChartPoint> bodies, walls;
  for (const Contact& contact : kept_)
    (contact.is_of_wall ? walls : bodies)
        .push_back({panel.x(contact.point[across]), panel.y(contact.point[up])});
  return frame +
         clipped(panel, "map", dots(bodies, 1.3, body_colour, 0.5) + dots(walls, 1.3, wall_colour, 0.5));
}

std::string RunPlot::rates() const {
  const double span = end_ > start_ ? end_ - start_ : 1.0;
  const double seconds = span / static_cast<double>(bins);
  const auto largest = std::max(*std::max_element(of_bodies_.begin(), of_bodies_.end()),
                                *std::max_element(of_walls_.begin(), of_walls_.end()));
  const double top = std::max(1.0, 1.1 * static_cast<double>(largest)) / seconds;
  const Panel panel{570, 40, 390, 160, start_, start_ + span, 0.0, top};
  const auto curve = [&](const Counts& counts, std::string_view colour) {
    std::vector<ChartPoint> points;
    for (std::size_t k = 0; k < bins; ++k) {
      const double y = panel.y(static_cast<double>(counts[k]) / seconds);
      for (const std::size_t edge : {k, k + 1})
        points.push_back({panel.x(start_ + static_cast<double>(edge) * seconds), y});
    }
    return polyline(points, fmt::format(R"(fill="none" stroke="{}" stroke-width="2")", colour));
  };
  const auto key = [&](double x, std::string_view text, std::string_view colour) {
    return text_at(x, panel.top - 10, text,
                   fmt::format(R"(fill="{}" font-weight="bold" text-anchor="end")", colour));
  };
  return axes(panel, {"Contacts in a second", "time (s)", "number in a second"}) +
         curve(of_walls_, wall_colour) + curve(of_bodies_, body_colour) +
         key(panel.right() - 60, "of bodies", body_colour) + key(panel.right(), "of walls", wall_colour);
}

std::string RunPlot::speeds() const {
  constexpr std::size_t columns = 40;
  std::array<std::uint64_t, columns> counts{};
  double fastest = 0.0;
  for (const Contact& contact : kept_) fastest = std::max(fastest, contact.speed);
  if (!(fastest > 0.0)) fastest = 1.0;
  for (const Contact& contact : kept_) {
    const auto column = static_cast<std::size_t>(std::max(contact.speed, 0.0) / fastest * columns);
    counts[std::min(column, columns - 1)] += stride_;
  }
  const double top =
      std::max(1.0, 1.1 * static_cast<double>(*std::max_element(counts.begin(), counts.end())));
  const Panel panel{570, 290, 390, 170, 0.0, fastest, 0.0, top};
  std::string bars;
  for (std::size_t k = 0; k < columns; ++k) {
    const double left = panel.x(fastest * static_cast<double>(k) / columns);
    const double y = panel.y(static_cast<double>(counts[k]));
    bars += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                        left + 0.5, y, panel.width / columns - 1.0, panel.bottom() - y, chart_colours[2]);
  }
  return axes(panel, {"How fast they approached", "approach speed (length / s)", "contacts"}) + bars;
}

}  // namespace kinesphere::program
