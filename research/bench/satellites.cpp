#include "research/bench/satellites.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "number_text.hpp"
#include "program_error.hpp"
#include "research/bench/machine.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/report.hpp"
#include "research/bench/satellite_file.hpp"
#include "research/satellites/monitor_satellites.hpp"
#include "research/satellites/satellite_approach.hpp"
#include "research/satellites/step_satellites.hpp"
#include "research/satellites/true_approaches.hpp"
#include "standard_output.hpp"
#include "table_file.hpp"
#include "validators.hpp"

namespace kinesphere::program {
namespace {

constexpr double day = 86400.0;
/// Cost that cascade's authors published (docs/satellites.md), in milliseconds for an object and day.
constexpr double cascade_cost = 115e3 / 19700;
/// Distance beyond the tolerance at which a pair counts as apart, not within (km).
constexpr double doubt = 1e-4;

CLI::Validator positive_number() {
  const auto problem = [](const std::string& text) {
    const auto number = parse_number(text);
    return number && *number > 0.0 ? std::string() : fmt::format("expected a number > 0, but got '{}'", text);
  };
  return CLI::Validator(problem, "", "number > 0");
}

/// Cost and findings of one detector of approaches.
struct Look {
  std::string name;
  std::vector<double> seconds;  ///< CPU time of each repetition
  std::vector<SatelliteApproach> approaches;
};

template <class Work>
Look timed(std::string name, std::uint32_t repetitions, const Work& work) {
  Look look{.name = std::move(name), .seconds = {}, .approaches = {}};
  for (std::uint32_t k = 0; k < repetitions; ++k) {
    const double begin = cpu_seconds();
    look.approaches = work();
    look.seconds.push_back(cpu_seconds() - begin);
  }
  return look;
}

SatelliteMotion chosen_satellites(const SatelliteOptions& options) {
  const std::vector<State> all = read_satellites(options.file);
  std::vector<State> chosen;
  chosen.reserve(all.size() / options.every + 1);
  for (std::size_t k = 0; k < all.size(); k += options.every) chosen.push_back(all[k]);
  return require(SatelliteMotion::create(chosen));
}

void write_approaches(const SatelliteOptions& options, const std::vector<SatelliteApproach>& approaches) {
  TableFile file(options.approaches, {"first", "second", "begin", "end"});
  for (const auto& [first, second, begin, end] : approaches)
    file.write(std::vector<Cell>{std::uint64_t{first} * options.every, std::uint64_t{second} * options.every,
                                 begin, end});
  file.commit();
}

double median_length(const std::vector<SatelliteApproach>& approaches) {
  std::vector<double> lengths;
  lengths.reserve(approaches.size());
  for (const SatelliteApproach& approach : approaches) lengths.push_back(approach.end - approach.begin);
  return lengths.empty() ? 0.0 : median(lengths);
}

}  // namespace

CLI::App* add_bench_satellites_command(CLI::App& bench, SatelliteOptions& options) {
  CLI::App* const command =
      bench.add_subcommand("satellites", "Approaches of satellites, against brute force and fixed steps");
  command->add_option("FILE", options.file, "Table of states, x,y,z (km) and vx,vy,vz (km/s); may be gzipped")
      ->required();
  command->add_option("--days", options.days, "For how long")
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--distance", options.distance, "What is an approach (km)")
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--window", options.window, "Of the monitor (s), rounded down to a power of two")
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--every", options.every, "Take every N-th satellite only")
      ->type_name("N")
      ->check(whole_number(1'000'000, 1))
      ->capture_default_str();
  command->add_option("--repetitions", options.repetitions, "Medians of so many runs of the monitor")
      ->check(whole_number(1000, 1))
      ->capture_default_str();
  command->add_option("--steps", options.steps, "Fixed steps to compare with (s)")
      ->type_name("S,...")
      ->delimiter(',')
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--approaches", options.approaches, "Table of approaches to write, .csv or .jsonl")
      ->type_name("FILE");
  command->add_option("--output", options.output, "Folder for tables (CSV)")
      ->type_name("FOLDER")
      ->capture_default_str();
  return command;
}

int bench_satellites(const SatelliteOptions& options) {
  const SatelliteMotion motion = chosen_satellites(options);
  const Report report(options.output);
  const std::string machine = machine_description();
  report.file("machine.txt", machine);
  print("{}\n", machine);
  const double until = options.days * day;
  const double object_days = static_cast<double>(motion.size()) * options.days;
  report.note(fmt::format(
      "{} satellites for {} days under the gravity of a point mass and J2, every time at which two are "
      "within {} km. "
      "Costs are CPU time of this process, in milliseconds for a satellite and day. An approach counts as "
      "missed where a method does not see it at any time; the oracle looks at all pairs by brute force.",
      motion.size(), options.days, options.distance));

  const WatchOptions how{.distance = options.distance, .window = options.window};
  SatelliteWatch watch;
  std::vector<Look> looks;
  looks.push_back(timed("monitor", options.repetitions, [&] {
    watch = require(monitor_satellites(motion, until, how));
    return watch.approaches;
  }));
  looks.push_back(timed("oracle", 1, [&] { return true_approaches(motion, until, options.distance); }));
  for (const double step : options.steps)
    looks.push_back(timed(fmt::format("steps of {} s", step), 1,
                          [&] { return step_satellites(motion, until, options.distance, step); }));
  const std::vector<SatelliteApproach>& truth = looks[1].approaches;

  ResultTable table({"method", "cpu_seconds", "cost", "approaches", "missed", "missed_percent"});
  for (const Look& look : looks) {
    const double seconds = median(look.seconds);
    const auto missed = static_cast<std::uint64_t>(not_met(truth, look.approaches).size());
    table.row(
        {look.name, seconds, 1e3 * seconds / object_days, std::uint64_t{look.approaches.size()}, missed,
         truth.empty() ? 0.0 : 100.0 * static_cast<double>(missed) / static_cast<double>(truth.size())});
  }
  report.table("satellites", table);

  const auto per_object_day = [&](std::uint64_t count) { return static_cast<double>(count) / object_days; };
  ResultTable counts({"window", "polls", "searches", "near_pairs", "looks", "undecided_seconds"});
  counts.row({options.window, per_object_day(watch.counters.polls), per_object_day(watch.counters.searches),
              per_object_day(watch.counters.near_pairs), per_object_day(watch.counters.rechecks),
              watch.undecided_time});
  report.note("What the monitor did, for a satellite and day (undecided: in all, of all pairs):");
  report.table("monitor", counts);

  // The monitor must be right at all times, so it is not enough that it met each approach.
  std::uint64_t uncovered = not_inside(truth, watch.approaches).size();
  for (std::size_t k = 2; k < looks.size(); ++k)
    uncovered += not_inside(looks[k].approaches, watch.approaches, options.steps[k - 2]).size();
  const std::size_t wrong =
      not_within(motion, watch.approaches, options.distance + how.tolerance + doubt).size();
  const double cost = 1e3 * median(looks[0].seconds) / object_days;
  report.note(fmt::format(
      "Half of all approaches last less than {:.2f} s. The monitor was wrong about {} of those that others "
      "have seen, at some time, and told of {} that are none. Its cost is {:.2f} ms for a satellite and day; "
      "that which was published of cascade, on other hardware and with more forces, is "
      "{:.2f} "
      "ms.",
      median_length(truth), uncovered, wrong, cost, cascade_cost));
  if (!options.approaches.empty()) write_approaches(options, watch.approaches);
  return uncovered == 0 && wrong == 0 ? exit_fine : exit_disagreement;
}

}  // namespace kinesphere::program
