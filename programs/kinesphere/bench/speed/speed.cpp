#include "bench/speed/speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bench/report.hpp"
#include "bench/speed/contest.hpp"
#include "bench/speed/tree_kernels.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

/// What a motion step or probe may cost (seconds).
constexpr double prices[] = {0.0, 100e-9, 1e-6, 10e-6};

using Results = std::map<std::string, std::vector<SpeedRow>>;

Cell cell(const std::optional<double>& value, double scale = 1.0) {
  return value ? Cell(scale * *value) : Cell();
}

const std::vector<std::string> columns{
    "scene",      "n",        "detector", "rate",     "us",       "total_100ns",    "total_1us",
    "total_10us", "to_world", "moves",    "to_floor", "contacts", "per_cpu_second", "missed_percent",
    "bytes",      "build_s",  "settings", "hash"};

void add_row(ResultTable& table, const SpeedScene& scene, const SpeedRow& row) {
  table.row({scene.name, std::uint64_t{scene.bodies}, row.detector, cell(row.rate),
             1e6 * row.total(prices[0]), 1e6 * row.total(prices[1]), 1e6 * row.total(prices[2]),
             1e6 * row.total(prices[3]), row.to_world, row.moves, cell(row.to_floor), cell(row.contacts),
             cell(row.contacts, 1.0 / row.detection), cell(row.missed, 100.0), cell(row.bytes),
             cell(row.building), row.settings, fmt::format("{:016x}", row.hash)});
}

/// The row of this detector at this rate, if it took part.
const SpeedRow* find(const std::vector<SpeedRow>& rows, const std::string& detector,
                     std::optional<double> rate = std::nullopt) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const SpeedRow& one) {
    return one.detector == detector && one.rate == rate;
  });
  return row == rows.end() ? nullptr : &*row;
}

Cell microseconds(const SpeedRow* row, double price = 0.0) {
  return row != nullptr ? Cell(1e6 * row->total(price)) : Cell();
}

/// Against the slowest fixed steps that miss no contact: how many times as much they take.
void save_verdicts(const Report& report, const std::vector<SpeedScene>& scenes, const Results& results) {
  ResultTable table({"scene", "n", "safe_detector", "safe_rate", "safe_us", "world_us", "ratio",
                     "ratio_100ns", "ratio_1us", "ratio_10us"});
  for (const SpeedScene& scene : scenes) {
    const auto rows = results.find(scene.name);
    if (rows == results.end()) continue;
    const SpeedRow& world = *find(rows->second, "world");
    for (const char* const name : {"tuned", "swept"}) {
      const auto safe = std::find_if(rows->second.begin(), rows->second.end(), [&](const SpeedRow& row) {
        return row.detector == name && row.missed == 0.0;
      });
      if (safe == rows->second.end()) continue;
      std::vector<Cell> row{scene.name,       std::uint64_t{scene.bodies}, std::string(name),
                            cell(safe->rate), 1e6 * safe->detection,       1e6 * world.detection};
      for (const double price : prices) row.emplace_back(safe->total(price) / world.total(price));
      table.row(std::move(row));
    }
  }
  report.note(
      "The slowest steps of those tried that miss no contact where all pass through, and how many times as "
      "much they "
      "take as the default engine, when a step or probe costs nothing, 100 ns, 1 us and 10 us.");
  report.table("verdicts", table);
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

/// Saves and draws those lines that have a point.
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

void plot_over_n(const Report& report, const std::vector<SpeedScene>& scenes, const Results& results) {
  Figure figure({.name = "over_n", .title = "Detection, spheres as dense as 1000 in the paper''s box"},
                engine_and_tuned());
  for (const SpeedScene& scene : scenes) {
    const auto rows = results.find(scene.name);
    if (rows == results.end() || (scene.name != "paper1-1000" && !scene.name.starts_with("dense-"))) continue;
    figure.point(std::uint64_t{scene.bodies}, [&](const Line& line) {
      return microseconds(find(rows->second, line.detector, line.rate));
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
          find(rows, line.detector, line.detector == "world" ? std::nullopt : std::optional(rate)));
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
    figure.point(1e9 * price,
                 [&](const Line& line) { return microseconds(find(rows, line.detector, line.rate), price); });
  }
  figure.save(report);
}

std::vector<std::string> names_of(const std::vector<SpeedScene>& scenes) {
  std::vector<std::string> names;
  names.reserve(scenes.size());
  for (const SpeedScene& scene : scenes) names.push_back(scene.name);
  return names;
}

void explain(const Report& report, const SpeedSettings& settings) {
  report.note(fmt::format(
      "Effort {}. \"us\" is CPU time for detection alone, in microseconds for a sphere and a simulated "
      "second: event-driven detectors get the answers of their probes, and the kicks, from a run that was "
      "written down before; fixed-step detectors look at recorded steps. \"total\" adds what moving costs, "
      "at "
      "so much for each probe or step (\"moves\", per body-second). Medians of {} turns; \"to world\" is "
      "the median ratio to the default engine in the same turn.",
      settings.name, settings.repetitions));
  report.note(
      "tuned: the fastest of several grids and Verlet lists for this scene and rate (\"settings\"), which "
      "sees "
      "overlaps at steps; swept: the same, with a test along the straight ways between steps. \"to floor\": "
      "probes "
      "to the least that a method that knew all other motion would need. \"missed percent\": contacts that "
      "are "
      "overlooked in the same scene without bounces. \"contacts\" are those of a body-second, \"per cpu "
      "second\" "
      "those that are found in a second of this machine.");
  if (!make_bullet_kernel({}))
    report.note("Bullet is left out: it was not installed when this program was built (libbullet-dev).");
  if (!make_fcl_kernel({}))
    report.note("FCL is left out: it was not installed when this program was built (libfcl-dev).");
}

}  // namespace

void add_bench_speed_command(CLI::App& bench, BenchOptions& options) {
  CLI::App* speed = bench.add_subcommand("speed", "Compare with fixed steps and others; takes minutes");
  add_bench_options(*speed, options, names_of(speed_scenes(speed_settings(Effort::full))),
                    "Up to a million bodies; takes an hour");
}

int bench_speed(const BenchOptions& options) {
  const SpeedSettings& settings = speed_settings(effort_of(options));
  const std::vector<SpeedScene> scenes = speed_scenes(settings);
  check_bench_options(options, names_of(scenes));
  const Report report(options.output);
  describe_machine(report);
  explain(report, settings);
  Results results;
  ResultTable all(columns);
  for (const SpeedScene& scene : scenes) {
    if (!is_chosen(options, scene.name)) continue;
    report.heading(fmt::format("{}, {} bodies", scene.name, scene.bodies));
    const std::vector<SpeedRow>& rows = results[scene.name] = compare_speed(scene, settings);
    ResultTable table(columns);
    for (const SpeedRow& row : rows) {
      add_row(table, scene, row);
      add_row(all, scene, row);
    }
    fmt::print("{}\n", table.text());
    report.save("speed", all);  // as far as it is known: the rest may take long
  }
  save_verdicts(report, scenes, results);
  plot_over_n(report, scenes, results);
  if (const auto found = results.find("paper1-1000"); found != results.end()) {
    plot_over_rate(report, found->second);
    plot_over_price(report, found->second);
  }
  return exit_fine;
}

}  // namespace kinesphere::program
