// `kinesphere tracks`: finds close approaches in a track set of real motion.
#include "tracks/tracks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

#include "base/chart.hpp"
#include "base/help_text.hpp"
#include "base/input_file.hpp"
#include "base/number_text.hpp"
#include "base/output_paths.hpp"
#include "base/program_error.hpp"
#include "base/progress.hpp"
#include "base/standard_output.hpp"
#include "base/table_file.hpp"
#include "base/validators.hpp"
#include "scenes/summary.hpp"
#include "scenes/verify.hpp"
#include "simulation/oracle/comparison.hpp"
#include "simulation/tracks/approaches.hpp"
#include "simulation/tracks/cylinder_approaches.hpp"
#include "simulation/tracks/rectangle_approaches.hpp"
#include "tracks/approach_files.hpp"
#include "tracks/approach_plot.hpp"
#include "tracks/closeness.hpp"
#include "tracks/coverage_summary.hpp"
#include "tracks/handovers.hpp"
#include "tracks/implied_speeds.hpp"
#include "tracks/minima_table.hpp"
#include "tracks/reading_options.hpp"
#include "tracks/reading_summary.hpp"
#include "tracks/sample_steps.hpp"
#include "tracks/summary_file.hpp"
#include "tracks/track_file.hpp"
#include "tracks/track_scene.hpp"

namespace kinesphere::program {
namespace {

void add_approaches(Summary& summary, const Closeness& closeness, const std::vector<Approach>& approaches,
                    const ErrorOptions& errors) {
  const auto cut = std::count_if(approaches.begin(), approaches.end(),
                                 [](const Approach& approach) { return approach.ends_with_track; });
  summary.row("approaches", grouped(approaches.size()),
              fmt::format("{}, {} of them until a track's end", closeness.text,
                          grouped(static_cast<std::uint64_t>(cut))));
  if (approaches.empty()) return;
  if (errors.any()) {
    const auto certain = std::ranges::count_if(approaches, &Approach::is_certain);
    summary.row(
        "certain", grouped(static_cast<std::uint64_t>(certain)),
        fmt::format("of the approaches; the others are possible, with positions off by {}", errors.text()));
  }
  const auto shorter = [](const Approach& a, const Approach& b) { return a.end - a.begin < b.end - b.begin; };
  const auto [shortest, longest] = std::minmax_element(approaches.begin(), approaches.end(), shorter);
  summary.row("duration", fmt::format("{} s to {} s", number(shortest->end - shortest->begin),
                                      number(longest->end - longest->begin)));
}

void add_left_out(Summary& summary, const ApproachChoice& choice, const LeftOut& left_out) {
  if (!choice.only.empty())
    summary.row("left out", grouped(left_out.by_ids),
                fmt::format("approaches without {}", fmt::join(choice.only, ",")));
  if (choice.min_duration)
    summary.row("left out", grouped(left_out.by_duration),
                fmt::format("approaches shorter than {} s", *choice.min_duration));
}

std::string closest_approaches(const std::vector<Approach>& approaches, const TrackSet& track_set,
                               bool by_cylinder) {
  constexpr std::size_t shown = 10;
  const auto distances = [&](const std::string& one, const std::string& two) {
    return by_cylinder ? fmt::format("{:>12}  {:>12}", one, two) : fmt::format("{:>12}", one);
  };
  std::string text = fmt::format("\n{:>24}  {}  {:>14}  {:>12}   {:>8}  {}\n", "closest at",
                                 distances(by_cylinder ? "horizontally" : "distance", "vertically"),
                                 "relative speed", "duration", "samples", "ids");
  const ImpliedSpeeds speeds(track_set);
  bool any_absurd = false;
  const auto marked = [&](std::uint32_t track, double time) {
    const bool is_absurd = speeds.is_absurd_at(track, time);
    any_absurd = any_absurd || is_absurd;
    return track_set.tracks[track].id + (is_absurd ? " (?)" : "");
  };
  for (const std::size_t k : closest_of(approaches, shown)) {
    const Approach& approach = approaches[k];
    const ClosestApproach& closest = approach.closest;
    const auto apart = steps_of(approach, track_set).longest();
    text += fmt::format(
        "{:>24}  {}  {:>14}  {}{:>11}{} {:>8}  {} {}{}\n", track_set.times.text(closest.time, 6),
        by_cylinder ? distances(number(horizontal_distance(closest)), number(vertical_distance(closest)))
                    : distances(number(closest.distance), ""),
        number(closest.relative_speed), approach.begins_with_track ? "<" : " ",
        number(approach.end - approach.begin), approach.ends_with_track ? "> " : "  ",
        apart ? number(*apart) : "-", marked(approach.first, closest.time),
        marked(approach.second, closest.time), approach.is_certain ? "" : " (possible)");
  }
  text += "< close from a track's first sample (or --from) on, > until a track's last sample (or --until)\n";
  text += "samples: seconds from the sample before to the one after, 0 at a sample, - where there is none\n";
  if (any_absurd)
    text += "(?) samples around that time imply a speed more than 10 times the usual one: see --max-speed\n";
  if (approaches.size() > shown) {
    text += fmt::format("and {} more: --contacts FILE has them all\n", grouped(approaches.size() - shown));
  }
  return text;
}

/// Warns of bodies that jump to one place, or keep together at one.
void warn_of_one_place(const std::vector<Approach>& approaches, const TrackSet& track_set, double tolerance) {
  const ImpliedSpeeds speeds(track_set);
  const auto is_at_one = [&](const Approach& approach) {
    const auto& [time, distance, first, second, relative_speed] = approach.closest;
    return norm(second - first) <= tolerance &&
           (relative_speed <= tolerance || speeds.is_absurd_at(approach.first, time) ||
            speeds.is_absurd_at(approach.second, time));
  };
  const auto first = std::find_if(approaches.begin(), approaches.end(), is_at_one);
  if (first == approaches.end()) return;
  const Vec3 at = track_set.coordinates.as_in_file(first->closest.first);
  print_message(
      "kinesphere: warning: two bodies are at exactly one place in {} approaches, as {} and {} are at {}, at "
      "{:.9g}, {:.9g}: such places may stand for none (--where), or be of one body with two ids\n",
      grouped(static_cast<std::uint64_t>(std::count_if(approaches.begin(), approaches.end(), is_at_one))),
      track_set.tracks[first->first].id, track_set.tracks[first->second].id,
      track_set.times.text(first->closest.time, 6), at.x, at.y);
}

/// Returns the diagonal of the box around all samples.
double size_of(const TrackSet& track_set) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Box extent{{none, none, none}, {-none, -none, -none}};
  for (const RecordedTrack& track : track_set.tracks) {
    for (const TrackSample& sample : track.samples) {
      for (int axis = 0; axis < 3; ++axis) {
        extent.lower[axis] = std::min(extent.lower[axis], sample.position[axis]);
        extent.upper[axis] = std::max(extent.upper[axis], sample.position[axis]);
      }
    }
  }
  return norm(extent.upper - extent.lower);
}

/// Warns of a distance without a unit that is larger than a track set in another unit than metres, or a few
/// metres among places that are kilometres apart: it may have been meant in another unit.
void warn_of_distance(const Closeness& closeness, const TrackSet& track_set) {
  const Coordinates& coordinates = track_set.coordinates;
  if (closeness.has_unit || !track_set.in_metres) return;
  const double size = size_of(track_set);
  if (coordinates.are_geographic()) {
    constexpr double few_metres = 10.0, wide = 20e3;
    if (closeness.distance < few_metres && size > wide)
      print_message("kinesphere: warning: {} {} is in metres; another unit is said as in 5NM\n",
                    closeness.option, closeness.given);
    return;
  }
  const Vec3 step = coordinates.as_in_file({1, 0, 0}) - coordinates.as_in_file({});
  if (closeness.distance <= size || std::abs(step.x - 1.0) < 1e-9) return;
  print_message(
      "kinesphere: warning: all positions are within {:.4g} m of each other, so that all pairs are close all "
      "the time: {} {} is in metres; another unit is said as in 5mm\n",
      size, closeness.option, closeness.given);
}

/// Returns a callback that shows a progress bar over the span of the scene.
ComparisonProgress shown(const TracksOptions& options, const Scene& scene) {
  const auto progress = std::make_shared<Progress>(scene.world.start_time, scene.end_time);
  if (options.quiet || !progress->visible()) return {};
  const double span = scene.end_time - scene.world.start_time;
  return [=, start = scene.world.start_time](double part) { progress->show(start + part * span); };
}

/// All output besides the summary. The constructor opens the files, before the work begins.
class TracksFiles {
 public:
  explicit TracksFiles(const TracksOptions& options) {
    const OutputPath outputs[] = {{"--contacts", options.contacts},
                                  {"--minima", options.minima},
                                  {"--pairs", options.pairs},
                                  {"--summary", options.summary},
                                  {"--plot", options.plot}};
    check_outputs(outputs, options.files);
    require_svg_name(options.plot);
    if (!options.contacts.empty())
      contacts_.emplace(options.contacts,
                        ApproachColumns{.by_cylinder = options.separation.starts_with("cylinder"),
                                        .has_errors = options.errors.any()});
    if (!options.minima.empty()) minima_.emplace(options.minima);
    if (!options.pairs.empty()) pairs_.emplace(options.pairs);
    if (!options.plot.empty()) plot_.emplace(options.plot);
    if (!options.summary.empty()) summary_.emplace(options.summary);
  }

  void check(const TrackSet& track_set) const {
    if (contacts_) contacts_->check(track_set);
  }
  void write(const TrackSet& track_set, const Scene& scene, const std::vector<Approach>& approaches,
             double distance) {
    if (contacts_) contacts_->write(approaches, track_set);
    if (minima_) {
      const auto minima = track_set.has_rectangles
                              ? minima_in(*scene.motion, approaches, shapes_of(track_set))
                              : minima_in(*scene.motion, approaches, radii_of(track_set));
      write_minima(*minima_, minima, approaches, track_set);
    }
    if (pairs_) write_pairs(*pairs_, pairs_in(approaches, track_set, *scene.motion), track_set);
    if (plot_) plot_->write(plot_of(track_set, scene, approaches, distance));
  }
  void write_summary(const std::vector<std::string>& files, const TrackSet& track_set,
                     const TrackScene& scene, const TracksResult& result) {
    if (summary_) summary_->write(summary_json(files, track_set, scene, result));
  }
  void commit() {
    if (contacts_) contacts_->commit();
    if (minima_) minima_->commit();
    if (pairs_) pairs_->commit();
    if (plot_) plot_->commit();
    if (summary_) summary_->commit();
  }

 private:
  std::optional<ApproachFile> contacts_;
  std::optional<TableFile> minima_, pairs_;
  std::optional<OutputFile> plot_, summary_;
};

}  // namespace

namespace {

void add_closeness_options(CLI::App& command, TracksOptions& options) {
  constexpr const char* group = "How close";
  command
      .add_option("--distance", options.distance,
                  "How close counts as an approach: a number, and perhaps a unit, such as 500m, 5NM, 2um")
      ->type_name("LENGTH")
      ->group(group);
  command
      .add_option("--separation", options.separation,
                  "Instead of --distance: cylinder:HORIZONTAL:VERTICAL, such as cylinder:5NM:1000ft, or "
                  "sphere:LENGTH")
      ->type_name("SHAPE")
      ->group(group);
  command
      .add_option(
          "--error", options.errors.error,
          "How far positions may be off: at samples, and for each second from the nearest sample, such as "
          "10m:2m/s. Approaches are then possible ones, and say which are certain")
      ->type_name("LENGTH[:SPEED]")
      ->group(group);
  command
      .add_option(
          "--largest-speed", options.errors.largest_speed,
          "No body is faster, such as 20kt: bounds how far it may be from the straight way between two "
          "samples. Approaches are then possible ones, as with --error")
      ->type_name("SPEED")
      ->group(group);
  command
      .add_option(
          "--acceleration", options.errors.acceleration,
          "No body accelerates more, such as 0.3g or 2m/s2: bounds it likewise, alone or with the speed")
      ->type_name("ACCELERATION")
      ->group(group);
  command
      .add_option("--tolerance", options.tolerance,
                  "Tolerance of that distance; when not given a millionth of it, or 1e-12 of the extent")
      ->check(finite_number())
      ->group(group);
  command
      .add_flag(
          "--sizes", options.reading.hints.sizes,
          "Distances are between rectangles (in 3D upright boxes) of the columns length and width, which "
          "turn as "
          "their heading or their motion says; --pairs has times to collision, post-encroachment times and "
          "decelerations that avoid a crash")
      ->group(group);
}

void add_output_options(CLI::App& command, TracksOptions& options) {
  constexpr const char* group = "What comes out";
  const auto add_file = [&](const char* name, std::string& file, const char* description) {
    command.add_option(name, file, description)->type_name("FILE")->group(group);
  };
  add_file("--contacts", options.contacts,
           "Write every approach to this .csv or .jsonl file or, where positions are on the earth, .geojson, "
           ".gpx or .kml file");
  add_file("--minima", options.minima,
           "Write every local minimum of the distance during approaches to this .csv or .jsonl file");
  add_file("--pairs", options.pairs, "Write a line for each pair of ids to this .csv or .jsonl file");
  add_file("--plot", options.plot, "Draw a map and the closest approaches into this .svg file");
  add_file("--summary", options.summary, "Write the summary to this file, as JSON");
  command.add_flag("--verify", options.verify, "Compare with the exact oracle on the same curves")
      ->group(group);
  command.add_flag("--quiet", options.quiet, "No progress bar and no summary")->group(group);
}

}  // namespace

CLI::App* add_tracks_command(CLI::App& program, TracksOptions& options) {
  CLI::App* command = program.add_subcommand("tracks", "Find every approach in a recording of real motion");
  add_closeness_options(*command, options);
  add_choice_options(*command, options.choice);
  add_output_options(*command, options);
  add_reading_options(*command, options.files, options.reading);
  add_motion_options(*command, options.reading);
  add_examples(*command, {"kinesphere tracks walk.csv --distance 0.5m --contacts near.csv",
                          "kinesphere tracks flights.csv --separation cylinder:5NM:1000ft",
                          "kinesphere tracks cars.csv --distance 2 --sizes --pairs pairs.csv"});
  return command;
}

namespace {

struct EngineRun {
  std::vector<Event> events;
  SceneResult result;
  double seconds = 0.0;  ///< of the machine
};

/// Runs the scene, with a progress bar.
EngineRun run_engine(const Scene& scene, bool quiet) {
  EngineRun run;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) { run.events.push_back(event); };
  std::optional<Progress> progress;
  if (!quiet) progress.emplace(scene.world.start_time, scene.end_time);
  if (progress && progress->visible())
    observer.between_events = [&](const Detector& detector) { progress->show(detector.time()); };
  const auto started = std::chrono::steady_clock::now();
  run.result = require(run_scene(scene, make_world_detector, observer));
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return run;
}

TracksResult result_of(const EngineRun& run, const TrackSet& track_set, const TrackScene& scene,
                       const Closeness& closeness, const ApproachFilter& filter,
                       const PositionErrors& errors) {
  TracksResult result{.approaches = approaches_in(scene.searched(), run.events),
                      .left_out = {},
                      .of_one_body = 0,
                      .coverage = coverage_of(track_set, filter),
                      .vanishings = vanishings_in(track_set, filter, closeness),
                      .probes = run.result.counters.probes,
                      .hash = run.result.contact_hash};
  if (closeness.vertical)
    result.approaches = approaches_within({.horizontal = closeness.distance,
                                           .vertical = *closeness.vertical,
                                           .tolerance = scene.scene.world.contact_tolerance},
                                          *scene.scene.motion, result.approaches);
  if (track_set.has_rectangles || errors.any())
    result.approaches =
        approaches_of_rectangles(closeness.distance, scene.scene.world.contact_tolerance, *scene.scene.motion,
                                 shapes_of(track_set), result.approaches, errors);
  result.of_one_body = leave_out_handovers(result.approaches, track_set);
  const bool found_none = result.approaches.empty();
  result.left_out = filter.apply(result.approaches);
  // Finer steps take more than they tell: what is found is refined.
  constexpr double part_of_distance = 1e-4;
  if (track_set.has_rectangles)
    find_closest(*scene.scene.motion, result.approaches, shapes_of(track_set),
                 part_of_distance * closeness.distance);
  else
    find_closest(*scene.scene.motion, result.approaches, radii_of(track_set));
  if (result.of_one_body > 0)
    print_message("kinesphere: warning: {}\n", warning_of_handovers(track_set, result.of_one_body));
  for (const std::string& warning : warnings_of(result.coverage, track_set, found_none))
    print_message("kinesphere: warning: {}\n", warning);
  if (found_none)
    for (const std::string& warning : warnings_of(result.vanishings, track_set))
      print_message("kinesphere: warning: {}\n", warning);
  warn_of_one_place(result.approaches, track_set, scene.scene.world.contact_tolerance);
  return result;
}

void add_result(Summary& summary, const TracksOptions& options, const Closeness& closeness,
                const TracksResult& result, const TrackSet& track_set) {
  summary.space();
  add_approaches(summary, closeness, result.approaches, options.errors);
  add_left_out(summary, options.choice, result.left_out);
  add_handovers(summary, track_set, result.of_one_body);
  add_vanishings(summary, result.vanishings, track_set);
  summary.row(
      "probes", grouped(result.probes),
      fmt::format("for {} samples: {}", grouped(track_set.samples),
                  percent(static_cast<double>(result.probes), static_cast<double>(track_set.samples))));
}

}  // namespace

int tracks(const TracksOptions& options) {
  for (const std::string& file : options.files) require_input(file);
  const Closeness closeness = closeness_of(options.distance, options.separation);
  const Interpolation interpolation = interpolation_for(options.errors, options.reading);
  TracksFiles files(options);
  TrackSet track_set = read_tracks(options.files, reading_for(closeness, options.reading));
  // A cylinder has limits of its own along and across the plane, for discs that cover the bodies.
  if (closeness.vertical) track_set.has_rectangles = false;
  check_closeness(closeness, track_set);
  files.check(track_set);
  const ApproachFilter filter(options.choice, track_set);
  const PositionErrors errors = errors_of(options.errors, closeness, track_set);
  const TrackScene scene =
      scene_of(track_set, {.distance = closeness.distance + largest_error(errors, track_set),
                           .vertical = closeness.vertical,
                           .tolerance = options.tolerance,
                           .interpolation = interpolation,
                           .from = filter.window().from,
                           .until = filter.window().until});
  for (const std::string& warning : warnings_of(track_set, scene))
    print_message("kinesphere: warning: {}\n", warning);
  warn_of_distance(closeness, track_set);

  const EngineRun run = run_engine(scene.searched(), options.quiet);
  const TracksResult result = result_of(run, track_set, scene, closeness, filter, errors);
  files.write(track_set, scene.scene, result.approaches, closeness.distance);
  files.write_summary(options.files, track_set, scene, result);
  Summary summary;
  add_track_set(summary, options.files, track_set, scene, result.coverage);
  add_result(summary, options, closeness, result, track_set);
  int exit_code = exit_fine;
  if (options.verify) {
    const ContactComparison comparison =
        require(compare_with_oracle(scene.searched(), run.events, shown(options, scene.searched())));
    summary.space();
    add_comparison(summary, comparison);
    if (!comparison.agrees()) exit_code = exit_disagreement;
  }
  summary.space();
  summary.row("hash", fmt::format("{:016x}", result.hash));
  add_speed(summary, run.result.simulated_time, run.seconds);
  if (!options.quiet) {
    print("{}", summary.text());
    if (!result.approaches.empty())
      print("{}", closest_approaches(result.approaches, track_set, closeness.vertical.has_value()));
  }
  // The commit comes last: a full disk must not suppress the summary.
  files.commit();
  return exit_code;
}

}  // namespace kinesphere::program
