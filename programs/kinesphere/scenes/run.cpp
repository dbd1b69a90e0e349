// `kinesphere run`: simulates a scene and prints its events and cost.
#include "scenes/run.hpp"
#include "kinesphere/inspection.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/chart.hpp"
#include "base/help_text.hpp"
#include "base/output_file.hpp"
#include "base/output_paths.hpp"
#include "base/program_error.hpp"
#include "base/progress.hpp"
#include "base/standard_output.hpp"
#include "base/validators.hpp"
#include "scenes/busiest_bodies.hpp"
#include "scenes/contact_log.hpp"
#include "scenes/frames_xyz.hpp"
#include "scenes/run_plot.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

double frame_interval_of(const RunOptions& options, const Scene& scene) {
  const double duration = scene.end_time - scene.world.start_time;
  const double interval = options.frame_interval.value_or(duration > 0 ? duration / 100 : 1.0);
  if (interval > 0 && std::isfinite(interval)) return interval;
  throw ProgramError(fmt::format("--frame-interval: expected a finite number > 0, but got {}", interval));
}

/// Files, progress bar and audit of a running simulation.
struct Attachments {
  std::unique_ptr<ContactLog> contacts;
  std::unique_ptr<FramesXyz> frames;
  std::unique_ptr<OutputFile> recording, picture;
  std::unique_ptr<RunPlot> plot;
  std::unique_ptr<Progress> progress;
  std::vector<BusyBody> busiest;
  std::optional<Event> hardest;  ///< the contact with the largest approach speed
  std::optional<AuditFinding> finding;
  double finding_time = 0.0;
};

Attachments attach(const RunOptions& options, const std::string& name, const Scene& scene) {
  Attachments attached;
  require_svg_name(options.plot);
  if (options.threads && options.audit) throw ProgramError("--audit: expected only without --threads");
  if (!options.contacts.empty()) attached.contacts = std::make_unique<ContactLog>(options.contacts);
  if (!options.frames.empty()) attached.frames = std::make_unique<FramesXyz>(options.frames, scene);
  if (!options.record.empty()) attached.recording = std::make_unique<OutputFile>(options.record);
  if (!options.plot.empty()) {
    attached.picture = std::make_unique<OutputFile>(options.plot);
    attached.plot = std::make_unique<RunPlot>(name, scene);
  }
  if (!options.quiet && !options.hash_only) {
    attached.progress = std::make_unique<Progress>(scene.world.start_time, scene.end_time);
  }
  return attached;
}

SceneObserver observer_of(const RunOptions& options, const Scene& scene, Attachments& attached) {
  SceneObserver observer;
  if (attached.contacts || attached.plot || !(options.quiet || options.hash_only)) {
    observer.on_event = [&](const Event& event) {
      const bool is_contact = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
      if (is_contact && !(attached.hardest && event.approach_speed <= attached.hardest->approach_speed))
        attached.hardest = event;
      if (attached.contacts) attached.contacts->write(event);
      if (attached.plot) attached.plot->add(event);
    };
  }
  if (attached.frames) {
    observer.frame_interval = frame_interval_of(options, scene);
    observer.on_frame = [&](const Detector& detector, const Motion& motion, double time) {
      attached.frames->write(detector, motion, time);
    };
  }
  if (attached.recording || options.explain) {
    observer.at_start = [&attached, explain = options.explain](Detector& detector) -> Result<void> {
      if (explain)
        if (auto profiling = detector.set_profiling(true); !profiling) return profiling;
      return attached.recording ? detector.start_recording() : Result<void>();
    };
    observer.at_end = [&attached, explain = options.explain](Detector& detector) -> Result<void> {
      if (explain) {
        auto busiest = detector.busiest(listed_bodies);
        if (!busiest) return busiest.error();
        attached.busiest = *std::move(busiest);
      }
      if (!attached.recording) return {};
      const auto recording = detector.stop_recording();
      if (!recording) return recording.error();
      attached.recording->write({reinterpret_cast<const char*>(recording->data()), recording->size()});
      return {};
    };
  }
  const bool show = attached.progress && attached.progress->visible();
  if (show || options.audit) {
    observer.between_events = [&attached, show, audit = options.audit](const Detector& detector) {
      if (show) attached.progress->show(detector.time());
      if (!audit || attached.finding) return;
      attached.finding = detector.audit();
      attached.finding_time = detector.time();
    };
  }
  return observer;
}

/// Adds the reasons for which the world was active.
void add_steps(Summary& summary, const Counters& counters) {
  if (counters.starts == 0) return;
  const auto row = [&](const char* kind, std::uint64_t count) {
    summary.row(kind, grouped(count),
                percent(static_cast<double>(count), static_cast<double>(counters.steps())));
  };
  summary.row("steps", grouped(counters.steps()));
  row("  starts", counters.starts);
  row("  restarts", counters.restarts);
  row("  pair checks", counters.pair_checks);
  row("  wall checks", counters.wall_checks);
}

/// Adds the event counts of the detectors from papers.
void add_paper_events(Summary& summary, const DetectorCounters& counters) {
  const std::uint64_t crossings = counters.entering + counters.leaving;
  const std::uint64_t events = crossings + counters.resetting + counters.colliding;
  const auto row = [&](const char* kind, std::uint64_t count) {
    summary.row(kind, grouped(count), percent(static_cast<double>(count), static_cast<double>(events)));
  };
  if (events > 0) {
    summary.row("candidates", grouped(counters.event_insertions),
                fmt::format("{} of them removed, at most {} at a time", grouped(counters.event_removals),
                            grouped(counters.largest_queue)));
    row("  entering", counters.entering);
    row("  leaving", counters.leaving);
    row("  resetting", counters.resetting);
    row("  colliding", counters.colliding);
  }
  if (counters.rebuilds > 0) summary.row("rebuilds", grouped(counters.rebuilds), "of all bounds");
}

/// Adds what the engine did.
void add_internals(Summary& summary, const Scene& scene, const SceneResult& result) {
  const DetectorCounters& counters = result.counters;
  add_steps(summary, counters);
  add_paper_events(summary, counters);
  if (counters.searches > 0) {
    summary.row("searches", grouped(counters.searches),
                fmt::format("{} candidates", grouped(counters.candidates)));
  }
  summary.row("pair tests", grouped(counters.certificates));
  if (result.memory && !scene.bodies.empty()) {
    summary.row("memory", grouped((result.memory->total() - result.memory->recording) / scene.bodies.size()),
                "bytes per body");
  }
}

std::string summary_of(const SceneParameters& parameters, const RunOptions& options,
                       const NamedDetector& detector, const Scene& scene, const SceneResult& result,
                       const std::optional<Event>& hardest, double real_seconds) {
  const DetectorCounters& counters = result.counters;
  const auto probes = static_cast<double>(counters.probes);
  Summary summary;
  add_events(summary, result,
             {.ends = scene.response == SceneResponse::pass_through, .internals = options.verbose});
  if (hardest) add_hardest(summary, *hardest);
  summary.space();
  summary.row("simulated", fmt::format("{} s", number(result.simulated_time)),
              fmt::format("{} body-seconds", number(result.body_time)));
  add_speed(summary, result.simulated_time, real_seconds);
  summary.row("probes", grouped(counters.probes),
              fmt::format("{} per body-second", number(probes / result.body_time)));
  summary.space();
  add_scene(summary, parameters);
  if (options.verbose || options.threads) {
    const std::string threads =
        options.threads ? "by itself, " + counted(static_cast<std::uint64_t>(*options.threads), "thread")
                        : "";
    summary.row("detector", detector.name, threads);
  }
  summary.row("hash", fmt::format("{:016x}", result.contact_hash));
  if (options.verbose) {
    summary.space();
    add_internals(summary, scene, result);
  }
  return summary.text(output_has_colour());
}

}  // namespace

CLI::App* add_run_command(CLI::App& program, RunOptions& options) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene and summarise it");
  add_scene_options(*command, options.scene);
  add_response_options(*command, options.scene);
  command->add_option("--contacts", options.contacts, "Write every event to this .csv or .jsonl file")
      ->type_name("FILE");
  command->add_option("--frames", options.frames, "Write snapshots to this file (extended XYZ, for OVITO)")
      ->type_name("FILE");
  command->add_option("--record", options.record, "Write a recording to this file, for `kinesphere replay`")
      ->type_name("FILE");
  command
      ->add_option("--plot", options.plot, "Draw where contacts were, when and how fast, into this .svg file")
      ->type_name("FILE");
  command
      ->add_option("--frame-interval", options.frame_interval,
                   "Time between snapshots; a hundredth of the scene's when not given")
      ->check(finite_number());
  command
      ->add_option(
          "--threads", options.threads,
          "Let the world go on by itself (World::run); so many threads share the reports of many bodies "
          "at once, and the outcome is the same for any number")
      ->check(whole_number(Workers::most_threads, 1));
  command->add_flag("--explain", options.explain,
                    "Print the bodies that cost most probes, with the reasons and what helps (one thread)");
  command->add_flag("--audit", options.audit, "Check the detector's own records before every event (slow)");
  command->add_flag("--hash-only", options.hash_only, "Print the hash of the contacts and nothing else");
  command->add_flag("--verbose", options.verbose, "Print what the engine did, too");
  command->add_flag("--quiet", options.quiet, "No progress bar and no summary");
  add_examples(*command, {"kinesphere run paper1", "kinesphere run gas --bodies 2000 --contacts events.csv",
                          "kinesphere run my_scene.json --seconds 5 --record run.ksr"});
  return command;
}

int run(const RunOptions& options, const NamedDetector& detector) {
  const SceneSource source = options.scene.source();
  const Scene scene = make_scene(source);
  const OutputPath outputs[] = {{"--contacts", options.contacts},
                                {"--frames", options.frames},
                                {"--record", options.record},
                                {"--plot", options.plot}};
  check_outputs(outputs, {&source.file, 1});
  Attachments attached = attach(options, source.parameters.name, scene);
  const SceneObserver observer = observer_of(options, scene, attached);

  std::optional<Workers> workers;
  if (options.threads) workers = require(Workers::create(*options.threads));

  const auto started = std::chrono::steady_clock::now();
  const SceneResult result =
      require(run_scene(scene, detector.make, observer, workers ? &*workers : nullptr));
  const std::chrono::duration<double> real_time = std::chrono::steady_clock::now() - started;

  attached.progress.reset();
  // A full disk must not suppress the summary.
  std::optional<ProgramError> failure;
  const auto commit = [&failure](auto& file) {
    try {
      if (file) file->commit();
    } catch (const ProgramError& error) {
      if (!failure) failure = error;
    }
  };
  commit(attached.contacts);
  commit(attached.frames);
  commit(attached.recording);
  if (attached.plot) attached.picture->write(attached.plot->svg());
  commit(attached.picture);
  if (options.hash_only) {
    print("{:016x}\n", result.contact_hash);
  } else if (!options.quiet) {
    print("{}", summary_of(source.parameters, options, detector, scene, result, attached.hardest,
                           real_time.count()));
  }
  if (options.explain && !options.hash_only)
    print("{}", text_of_busiest(attached.busiest, result.counters.probes));
  if (failure) throw ProgramError(*failure);
  if (!attached.finding) return exit_fine;
  print_message("kinesphere: audit at time {}: {}: {}\n", attached.finding_time, attached.finding->where,
                attached.finding->what);
  return exit_disagreement;
}

}  // namespace kinesphere::program
