#include "bench/speed/speed_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

namespace kinesphere::program {
namespace {

Cell microseconds(const SpeedRow* row, double price = 0.0) {
  return row != nullptr ? Cell(1e6 * row->total(price)) : Cell();
}

constexpr double plotted_rates[] = {60.0, 240.0, 1000.0};

/// A column of a figure: the default engine, or a detector at a rate.
struct Line {
  Curve curve;
  std::string detector;
  std::optional<double> rate{};
};

std::vector<Line> engine_and_tuned() {
  std::vector<Line> lines{{{"world", "default engine"}, "world"}};
  for (const double rate : plotted_rates)
    lines.push_back(
        {{fmt::format("tuned_{}", rate), fmt::format("tuned, {} steps a second", rate)}, "tuned", rate});
  return lines;
}

/// Saves and draws those lines that have a point; nothing where there is no second one to draw them to.
class Figure {
 public:
  Figure(Plot plot, std::vector<Line> lines) : plot_(std::move(plot)), lines_(std::move(lines)) {}

  /// A point of each line, as far as they are there.
  template <class Value>
  void point(Cell x, Value value) {
    points_.push_back({std::move(x)});
    for (const Line& line : lines_) points_.back().push_back(value(line));
  }

  void save(const Report& report) {
    if (points_.size() < 2) return;
    for (std::size_t column = lines_.size(); column > 0; --column) {
      const auto is_empty = [column](const std::vector<Cell>& row) {
        return std::holds_alternative<std::monostate>(row[column]);
      };
      if (!std::all_of(points_.begin(), points_.end(), is_empty)) continue;
      lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(column - 1));
      for (auto& row : points_) row.erase(row.begin() + static_cast<std::ptrdiff_t>(column));
    }
    if (lines_.empty()) return;
    std::vector<std::string> names{plot_.x_column};
    for (const Line& line : lines_) {
      names.push_back(line.curve.column);
      plot_.curves.push_back(line.curve);
    }
    ResultTable table(names);
    for (auto& row : points_) table.row(std::move(row));
    plot_.table = plot_.name;
    plot_.y_label = "microseconds per sphere and simulated second";
    plot_.logarithmic = true;
    report.save(plot_.name, table);
    report.plot(plot_);
  }

 private:
  Plot plot_;
  std::vector<Line> lines_;
  std::vector<std::vector<Cell>> points_;
};

void plot_over_n(const Report& report, const std::vector<SpeedScene>& scenes, const SpeedResults& results) {
  Figure figure(
      {.name = "over_n", .title = "Detection, spheres as dense as 1000 in the paper''s box, first 0.2 s"},
      engine_and_tuned());
  for (const SpeedScene& scene : scenes) {
    const auto rows = results.find(scene.name);
    if (rows == results.end() || !scene.name.starts_with("dense-")) continue;
    figure.point(std::uint64_t{scene.bodies}, [&](const Line& line) {
      return microseconds(find_row(rows->second, line.detector, line.rate));
    });
  }
  figure.save(report);
}

void plot_over_rate(const Report& report, const std::vector<SpeedRow>& rows) {
  Figure figure({.name = "over_rate",
                 .title = "Detection, the paper''s first scene, 1000 spheres",
                 .x_column = "rate",
                 .x_label = "steps per simulated second"},
                {{{"world", "default engine (no steps)"}, "world"},
                 {{"tuned", "tuned"}, "tuned"},
                 {{"swept", "tuned, swept"}, "swept"},
                 {{"bullet", "Bullet"}, "bullet"},
                 {{"fcl", "FCL"}, "fcl"}});
  for (const double rate : plotted_rates) {
    figure.point(rate, [&](const Line& line) {
      return microseconds(
          find_row(rows, line.detector, line.detector == "world" ? std::nullopt : std::optional(rate)));
    });
  }
  figure.save(report);
}

void plot_over_price(const Report& report, const std::vector<SpeedRow>& rows) {
  Figure figure({.name = "over_price",
                 .title = "Detection and motion, the paper''s first scene, 1000 spheres",
                 .x_column = "price_ns",
                 .x_label = "ns per motion step or probe"},
                engine_and_tuned());
  for (const double price : {1e-9, 3e-9, 10e-9, 30e-9, 100e-9, 300e-9, 1e-6, 3e-6, 10e-6}) {
    figure.point(1e9 * price, [&](const Line& line) {
      return microseconds(find_row(rows, line.detector, line.rate), price);
    });
  }
  figure.save(report);
}

}  // namespace

void draw_speed_figures(const Report& report, const std::vector<SpeedScene>& scenes,
                        const SpeedResults& results) {
  plot_over_n(report, scenes, results);
  const auto found = results.find("paper1-1000");
  if (found == results.end()) return;
  plot_over_rate(report, found->second);
  plot_over_price(report, found->second);
}

}  // namespace kinesphere::program
