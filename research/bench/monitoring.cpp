#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "base/program_error.hpp"
#include "base/validators.hpp"
#include "research/bench/commands.hpp"
#include "research/bench/report.hpp"
#include "research/monitoring/alarms.hpp"
#include "tracks/reading_options.hpp"
#include "tracks/track_file.hpp"

namespace kinesphere::program {
namespace {

struct MonitoringOptions {
  std::vector<std::string> files;
  TrackOptions reading;
  double distance = 0.0;
  double look_ahead = 0.0;
  ReportingSettings reporting;
  double window = 1.0;
  std::uint64_t seeds = 3;
  std::vector<double> polling_tolerances;
};

/// Relative error of the spans of the truth: they are exact to about this part of the distance.
constexpr double rounding = 1e-9;
constexpr double monitor_tolerance = 1e-3;

RecordedSky sky_of(const MonitoringOptions& options) {
  const TrackSet track_set = read_tracks(options.files, options.reading);
  std::vector<Track> tracks;
  for (const RecordedTrack& track : track_set.tracks) tracks.push_back(track.samples);
  return require(RecordedSky::create(tracks, track_set.is_plane ? 2 : 3));
}

void add_certainty(ResultTable& table, const RecordedSky& sky, const MonitoringOptions& options,
                   std::uint64_t seed) {
  ReportingSettings reporting = options.reporting;
  reporting.seed = seed;
  const std::vector<Delivery> deliveries = sky.deliveries(reporting);
  const auto truth = require(sky.within(options.distance));
  const auto clearly = require(sky.within(options.distance * (1.0 - rounding)));
  const auto loosely = require(sky.within((options.distance + monitor_tolerance) * (1.0 + rounding)));
  Monitor monitor = require(Monitor::create({.dimensions = sky.dimensions(),
                                             .start_time = deliveries.front().time,
                                             .classes = {sky.promise()},
                                             .separations = {{0, 0, {Separation::sphere(options.distance)}}},
                                             .tolerance = monitor_tolerance,
                                             .window = options.window}));
  const VerdictHistory history = watch(monitor, sky, deliveries);
  const Correctness correctness = correctness_of(history, sky, clearly, loosely);
  const AlarmScore certain = score_of(alarms_of(history, sky), truth, options.look_ahead);
  const AlarmScore straight = score_of(straight_on_alarms(sky, deliveries, options.distance,
                                                          options.look_ahead, options.reporting.interval / 4),
                                       truth, options.look_ahead);
  table.row({seed, std::uint64_t{deliveries.size()}, correctness.wrong_time,
             correctness.undecided_time / correctness.pair_time, std::uint64_t{certain.approaches},
             std::uint64_t{certain.missed + certain.late}, std::uint64_t{certain.alarms},
             std::uint64_t{certain.false_alarms}, std::uint64_t{straight.missed},
             std::uint64_t{straight.late}, std::uint64_t{straight.alarms},
             std::uint64_t{straight.false_alarms}});
}

void add_polling(ResultTable& table, const RecordedSky& sky, const MonitoringOptions& options,
                 double at_most) {
  const PollingSettings settings{options.distance, at_most, options.window};
  const double at_ten_hertz = 10.0 * sky.track_time();
  const auto row = [&](const char* who, std::uint64_t reports, Cell undecided) {
    table.row(
        {options.distance, at_most, std::string(who), reports, double(reports) / at_ten_hertz, undecided});
  };
  const Polling needed = poll_when_needed(sky, settings);
  row("when needed", needed.reports, needed.undecided_time);
  constexpr double parts_of_an_answer = 1e-3;
  row("floor", polling_floor(sky, settings, parts_of_an_answer), {});
  for (const auto& [who, interval] :
       {std::pair("all at 1 Hz", 1.0), {"all at 5 Hz", 0.2}, {"all at 10 Hz", 0.1}}) {
    const Polling all = poll_everybody(sky, settings, interval);
    row(who, all.reports, all.undecided_time);
  }
}

int bench_monitoring(const MonitoringOptions& options) {
  for (const double at_most : options.polling_tolerances)
    if (at_most > options.distance)
      throw ProgramError(
          fmt::format("--polling must be at most --distance, {}, but is {}", options.distance, at_most));
  const RecordedSky sky = sky_of(options);
  const TrackClass track_class = sky.promise();
  fmt::print("{} tracks, {:.6g} s in all; accelerations up to {:.4g}, speeds up to {:.4g}\n\n", sky.size(),
             sky.track_time(), track_class.acceleration_limit.total(), track_class.largest_speed.total());
  if (options.seeds > 0) {
    ResultTable table({"seed", "reports", "wrong_time", "undecided_share", "approaches", "missed_or_late",
                       "alarms", "false_alarms", "straight_missed", "straight_late", "straight_alarms",
                       "straight_false_alarms"});
    for (std::uint64_t seed = 1; seed <= options.seeds; ++seed) add_certainty(table, sky, options, seed);
    fmt::print("{}\n", table.text());
  }
  if (!options.polling_tolerances.empty()) {
    ResultTable table({"distance", "tolerance", "asked", "reports", "of_10_Hz", "undecided_time"});
    for (const double at_most : options.polling_tolerances) add_polling(table, sky, options, at_most);
    fmt::print("{}", table.text());
  }
  return exit_fine;
}

}  // namespace

Command add_monitoring(CLI::App& app) {
  const auto options = std::make_shared<MonitoringOptions>();
  CLI::App* const command = app.add_subcommand(
      "monitoring", "What is certain about recorded tracks from few and noisy reports, and how few will do");
  add_reading_options(*command, options->files, options->reading);
  command->add_option("--distance", options->distance, "Which separation is watched (length)")
      ->required()
      ->check(finite_number() & CLI::PositiveNumber);
  command->add_option("--interval", options->reporting.interval, "Mean time between two reports of a track")
      ->check(finite_number() & CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--delay", options->reporting.delay, "Largest delay of a report")
      ->check(finite_number() & CLI::NonNegativeNumber);
  command->add_option("--position-error", options->reporting.position_error, "Of reports, at most (length)")
      ->check(finite_number() & CLI::NonNegativeNumber);
  command
      ->add_option("--velocity-error", options->reporting.velocity_error,
                   "Of reports, at most (length / time)")
      ->check(finite_number() & CLI::NonNegativeNumber);
  command
      ->add_option("--look-ahead", options->look_ahead, "Of the alarms that take everybody to go straight on")
      ->check(finite_number() & CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--window", options->window, "Of the monitor")
      ->check(finite_number() & CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--seeds", options->seeds, "How many times, each with other errors and times of reports")
      ->check(whole_number(1000))
      ->capture_default_str();
  command
      ->add_option("--polling", options->polling_tolerances,
                   "Also how few reports keep every pair decided, within these tolerances (length)")
      ->check(finite_number() & CLI::PositiveNumber);
  return {command, [options] { return bench_monitoring(*options); }};
}

}  // namespace kinesphere::program
