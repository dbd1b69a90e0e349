// `kinesphere tracks`: who came close to whom in a recording of real motion.
#include "tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include "approaches.hpp"
#include "kinesphere/comparison.hpp"
#include "program_error.hpp"
#include "progress.hpp"
#include "summary.hpp"
#include "table_file.hpp"
#include "validators.hpp"
#include "verify.hpp"

namespace kinesphere::program {
namespace {

double positive(std::string_view option, double value) {
  if (value > 0 && std::isfinite(value)) return value;
  throw ProgramError(fmt::format("{}: expected a finite number > 0, but got {}", option, value));
}

void write_approaches(const std::string& path, const std::vector<Approach>& approaches,
                      const Recording& recording) {
  TableFile table(path, {"begin", "end", "first", "second", "begins_with_track", "ends_with_track"});
  for (const Approach& approach : approaches) {
    const Cell cells[] = {approach.begin,
                          approach.end,
                          recording.tracks[approach.first].id,
                          recording.tracks[approach.second].id,
                          approach.begins_with_track,
                          approach.ends_with_track};
    table.write(cells);
  }
  table.commit();
}

void add_recording(Summary& summary, const TracksOptions& options, const Recording& recording,
                   const Scene& scene) {
  const TrackColumns& columns = recording.columns;
  summary.row("file", options.file);
  std::string format = fmt::format("{}, {}", columns.format, columns.z ? "3D" : "2D");
  if (columns.frame_rate != 1.0) format += fmt::format(", {} frames/s", columns.frame_rate);
  summary.row("format", std::move(format));
  summary.row(
      "tracks", grouped(recording.tracks.size()),
      fmt::format("of {} ids, cut at gaps over {} s", grouped(recording.ids), number(recording.max_gap)));
  std::string samples = fmt::format("every {} s", number(recording.sample_interval));
  if (recording.left_out > 0)
    samples += fmt::format(", {} more left out: alone", grouped(recording.left_out));
  summary.row("samples", grouped(recording.samples), std::move(samples));
  summary.row("span", fmt::format("{} s", number(scene.end_time - scene.world.start_time)),
              fmt::format("from {} to {}", scene.world.start_time, scene.end_time));
}

void add_approaches(Summary& summary, double distance, const std::vector<Approach>& approaches) {
  const auto cut = std::count_if(approaches.begin(), approaches.end(),
                                 [](const Approach& approach) { return approach.ends_with_track; });
  summary.row("approaches", grouped(approaches.size()),
              fmt::format("below {}, {} of them until a track's end", distance,
                          grouped(static_cast<std::uint64_t>(cut))));
  if (approaches.empty()) return;
  const auto shorter = [](const Approach& a, const Approach& b) { return a.end - a.begin < b.end - b.begin; };
  const auto [shortest, longest] = std::minmax_element(approaches.begin(), approaches.end(), shorter);
  summary.row("duration", fmt::format("{} s to {} s", number(shortest->end - shortest->begin),
                                      number(longest->end - longest->begin)));
}

std::string first_approaches(const std::vector<Approach>& approaches, const Recording& recording) {
  constexpr std::size_t shown = 10;
  std::string text = fmt::format("\n{:>14}  {:>14}  {:>10}  {}\n", "begin", "end", "duration", "ids");
  for (std::size_t k = 0; k < std::min(shown, approaches.size()); ++k) {
    const Approach& approach = approaches[k];
    text += fmt::format("{}{:>13.6f}  {:>14.6f}{}{:>10.6f}  {} {}\n", approach.begins_with_track ? "<" : " ",
                        approach.begin, approach.end, approach.ends_with_track ? "> " : "  ",
                        approach.end - approach.begin, recording.tracks[approach.first].id,
                        recording.tracks[approach.second].id);
  }
  text += "< close from a track's first sample on, > close until a track's last sample\n";
  if (approaches.size() > shown) {
    text += fmt::format("and {} more: --contacts FILE has them all\n", grouped(approaches.size() - shown));
  }
  return text;
}

}  // namespace

CLI::App* add_tracks_command(CLI::App& program, TracksOptions& options) {
  CLI::App* command = program.add_subcommand("tracks", "Find every approach in a recording of real motion");
  command->footer(
      "Known by themselves: UCY obsmat, PedPy, mosquito tracks, and tables with a header\n"
      "id, time (or frame), x, y and perhaps z; .gz too. Separators: ; , tab or blanks.");
  command->add_option("FILE", options.file, "Text table of positions, plain or gzipped")->required();
  command->add_option("--distance", options.distance, "How close counts as an approach")
      ->check(finite_number())
      ->required();
  command
      ->add_option("--tolerance", options.tolerance,
                   "Tolerance of that distance; a millionth of it when not given")
      ->check(finite_number());
  command
      ->add_option("--columns", options.reading.hints.columns,
                   "Where what is, by name or number from 1: id=...,time=...,x=...,y=...[,z=...]")
      ->type_name("LIST");
  command
      ->add_option("--frame-rate", options.reading.hints.frame_rate,
                   "Frames per second, when the time column counts frames")
      ->check(finite_number());
  command
      ->add_option(
          "--max-gap", options.reading.max_gap,
          "A longer time between samples of an id ends its track; 2.5 times the median interval of the "
          "file when not given")
      ->check(finite_number());
  command->add_option("--contacts", options.contacts, "Write every approach to this .csv or .jsonl file")
      ->type_name("FILE");
  command->add_flag("--verify", options.verify, "Compare with the exact oracle on the same curves");
  command->add_flag("--quiet", options.quiet, "No progress bar and no summary");
  return command;
}

Scene scene_of(const Recording& recording, const std::string& file, double distance, double tolerance) {
  Scene scene;
  scene.name = file;
  scene.world.contact_tolerance = tolerance;
  scene.world.start_time = recording.tracks.front().samples.front().time;
  scene.end_time = scene.world.start_time;
  std::vector<Track> curves;
  for (const RecordedTrack& track : recording.tracks) {
    const double begin = track.samples.front().time;
    const double end = track.samples.back().time;
    scene.bodies.push_back({.radius = distance / 2, .appears = begin, .vanishes = end});
    scene.world.start_time = std::min(scene.world.start_time, begin);
    scene.end_time = std::max(scene.end_time, end);
    curves.push_back(track.samples);
  }
  Result<RecordedTracks> motion = RecordedTracks::create(curves);
  if (!motion) throw ProgramError(fmt::format("{}: {}", file, motion.error().message));
  scene.motion = std::make_unique<RecordedTracks>(std::move(motion).value());
  return scene;
}

int tracks(const TracksOptions& options) {
  const double distance = positive("--distance", options.distance);
  const double tolerance = positive("--tolerance", options.tolerance.value_or(1e-6 * distance));
  if (tolerance >= distance)
    throw ProgramError(
        fmt::format("--tolerance: expected less than the distance {}, but got {}", distance, tolerance));
  const Recording recording = read_tracks(options.file, options.reading);
  const Scene scene = scene_of(recording, options.file, distance, tolerance);

  std::vector<Event> events;
  SimulationObserver observer;
  observer.on_event = [&](const Event& event) { events.push_back(event); };
  std::optional<Progress> progress;
  if (!options.quiet) progress.emplace(scene.world.start_time, scene.end_time);
  if (progress && progress->visible()) {
    observer.between_events = [&](const Detector& detector) { progress->show(detector.time()); };
  }
  const auto started = std::chrono::steady_clock::now();
  const SimulationResult result = require(simulate(scene, make_world_detector, observer));
  const std::chrono::duration<double> real_time = std::chrono::steady_clock::now() - started;
  progress.reset();

  const std::vector<Approach> approaches = approaches_in(scene, events);
  if (!options.contacts.empty()) write_approaches(options.contacts, approaches, recording);
  Summary summary;
  add_recording(summary, options, recording, scene);
  summary.space();
  add_approaches(summary, distance, approaches);
  summary.row("probes", grouped(result.counters.probes),
              fmt::format("for {} samples: {}", grouped(recording.samples),
                          percent(static_cast<double>(result.counters.probes),
                                  static_cast<double>(recording.samples))));
  int exit_code = exit_fine;
  if (options.verify) {
    const ContactComparison comparison = require(compare_with_oracle(scene, events));
    summary.space();
    add_comparison(summary, comparison);
    if (!comparison.agrees()) exit_code = exit_disagreement;
  }
  summary.space();
  summary.row("hash", fmt::format("{:016x}", result.contact_hash));
  add_speed(summary, result.simulated_time, real_time.count());
  if (!options.quiet) {
    fmt::print("{}", summary.text());
    if (options.contacts.empty() && !approaches.empty())
      fmt::print("{}", first_approaches(approaches, recording));
  }
  return exit_code;
}

}  // namespace kinesphere::program
