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
#include "output_paths.hpp"
#include "program_error.hpp"
#include "progress.hpp"
#include "standard_output.hpp"
#include "summary.hpp"
#include "table_file.hpp"
#include "tracks/reading_options.hpp"
#include "tracks/reading_summary.hpp"
#include "tracks/track_file.hpp"
#include "tracks/track_scene.hpp"
#include "validators.hpp"
#include "verify.hpp"

namespace kinesphere::program {
namespace {

double positive(std::string_view option, double value) {
  if (value > 0 && std::isfinite(value)) return value;
  throw ProgramError(fmt::format("{}: expected a finite number > 0, but got {}", option, value));
}

Cell time_cell(const TimeScale& times, double time) {
  std::string text = times.text(time);
  if (times.is_number()) return DecimalText{std::move(text)};
  return text;
}

void write_approaches(TableFile& table, const std::vector<Approach>& approaches, const Recording& recording) {
  for (const Approach& approach : approaches) {
    const Cell cells[] = {time_cell(recording.times, approach.begin),
                          time_cell(recording.times, approach.end),
                          recording.tracks[approach.first].id,
                          recording.tracks[approach.second].id,
                          approach.begins_with_track,
                          approach.ends_with_track};
    table.write(cells);
  }
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
  std::string text = fmt::format("\n{:>24}  {:>24}  {:>10}  {}\n", "begin", "end", "duration", "ids");
  for (std::size_t k = 0; k < std::min(shown, approaches.size()); ++k) {
    const Approach& approach = approaches[k];
    text += fmt::format("{}{:>23}  {:>24}{}{:>10.6f}  {} {}\n", approach.begins_with_track ? "<" : " ",
                        recording.times.text(approach.begin, 6), recording.times.text(approach.end, 6),
                        approach.ends_with_track ? "> " : "  ", approach.end - approach.begin,
                        recording.tracks[approach.first].id, recording.tracks[approach.second].id);
  }
  text += "< close from a track's first sample on, > close until a track's last sample\n";
  if (approaches.size() > shown) {
    text += fmt::format("and {} more: --contacts FILE has them all\n", grouped(approaches.size() - shown));
  }
  return text;
}

/// A progress bar over the span of the scene for what is done in parts.
ComparisonProgress shown(const TracksOptions& options, const Scene& scene) {
  const auto progress = std::make_shared<Progress>(scene.world.start_time, scene.end_time);
  if (options.quiet || !progress->visible()) return {};
  const double span = scene.end_time - scene.world.start_time;
  return [=, start = scene.world.start_time](double part) { progress->show(start + part * span); };
}

}  // namespace

CLI::App* add_tracks_command(CLI::App& program, TracksOptions& options) {
  CLI::App* command = program.add_subcommand("tracks", "Find every approach in a recording of real motion");
  command->add_option("--distance", options.distance, "How close counts as an approach")
      ->check(finite_number())
      ->required();
  command
      ->add_option("--tolerance", options.tolerance,
                   "Tolerance of that distance; when not given a millionth of it, or 1e-12 of the extent")
      ->check(finite_number());
  command->add_option("--contacts", options.contacts, "Write every approach to this .csv or .jsonl file")
      ->type_name("FILE");
  add_reading_options(*command, options.files, options.reading);
  command->add_flag("--verify", options.verify, "Compare with the exact oracle on the same curves");
  command->add_flag("--quiet", options.quiet, "No progress bar and no summary");
  return command;
}

int tracks(const TracksOptions& options) {
  const double distance = positive("--distance", options.distance);
  const OutputPath outputs[] = {{"--contacts", options.contacts}};
  check_outputs(outputs, options.files);
  std::optional<TableFile> table;
  if (!options.contacts.empty()) {
    table.emplace(options.contacts, std::vector<std::string>{"begin", "end", "first", "second",
                                                             "begins_with_track", "ends_with_track"});
  }
  const Recording recording = read_tracks(options.files, options.reading);
  const TrackScene scene_and_notes = scene_of(
      recording,
      {.distance = distance, .tolerance = options.tolerance, .interpolation = options.reading.interpolation});
  const Scene& scene = scene_and_notes.scene;
  for (const std::string& warning : warnings_of(recording, scene_and_notes))
    fmt::print(stderr, "kinesphere: warning: {}\n", warning);

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
  if (table) write_approaches(*table, approaches, recording);
  Summary summary;
  add_recording(summary, options.files, recording, scene_and_notes);
  summary.space();
  add_approaches(summary, distance, approaches);
  summary.row("probes", grouped(result.counters.probes),
              fmt::format("for {} samples: {}", grouped(recording.samples),
                          percent(static_cast<double>(result.counters.probes),
                                  static_cast<double>(recording.samples))));
  int exit_code = exit_fine;
  if (options.verify) {
    const ContactComparison comparison = require(compare_with_oracle(scene, events, shown(options, scene)));
    summary.space();
    add_comparison(summary, comparison);
    if (!comparison.agrees()) exit_code = exit_disagreement;
  }
  summary.space();
  summary.row("hash", fmt::format("{:016x}", result.contact_hash));
  add_speed(summary, result.simulated_time, real_time.count());
  if (!options.quiet) {
    print("{}", summary.text());
    if (options.contacts.empty() && !approaches.empty()) print("{}", first_approaches(approaches, recording));
  }
  // Last: what a full disk does to the file must not take the summary with it.
  if (table) table->commit();
  return exit_code;
}

}  // namespace kinesphere::program
