// `kinesphere watch`: reports certain facts about the separation of tracks in a stream.
#include "watch/watch.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "base/ascii_text.hpp"
#include "base/help_text.hpp"
#include "base/output_file.hpp"
#include "base/output_paths.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "base/validators.hpp"
#include "formats/streams/input_options.hpp"
#include "watch/nats/nats_address.hpp"
#include "watch/output/watch_report.hpp"
#include "watch/source/tcp_source.hpp"
#include "watch/source/udp_source.hpp"
#include "watch/watch_loop.hpp"

namespace kinesphere::program {
CLI::App* add_watch_command(CLI::App& program, WatchOptions& options) {
  CLI::App* command = program.add_subcommand(
      "watch", "Tell what is certain about the separation of tracks in a stream of reports");
  command->footer("docs/watch.md explains the formats, the alerts, and what is certain about them.");
  command
      ->add_option(
          "FILE", options.file,
          "The stream, one file, plain or gzipped; - for standard input; tcp://HOST:PORT for what a server "
          "sends there; udp://127.0.0.1:PORT for datagrams to this port; nats://HOST:PORT/SUBJECT for what a "
          "server of NATS has")
      ->capture_default_str();
  command->add_option("more", options.more_files)->group("");
  command->option_defaults()->group("What is watched for");
  // Options that may be given several times take one value each: the FILE may come behind it.
  command
      ->add_option(
          "--separation", options.separations,
          "What is watched for, at least once: sphere:50, cylinder:5NM:1000ft, ellipsoid:5NM:1000ft, "
          "well-clear:0.66NM:450ft:35s, do365:corrective; with or without a look-ahead time of its own, as "
          "sphere:1NM:20min")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("SHAPE[:TIME]");
  command
      ->add_option("--look-ahead", options.look_ahead,
                   "How far ahead predictions reach where a separation has no time of its own; 60 s when not "
                   "given, of tables, JSON and recordings 10 s; with 0 nothing is predicted")
      ->type_name("TIME");
  command
      ->add_option("--confirm", options.confirm,
                   "A prediction begins once it has held for so long; at once when not given")
      ->type_name("TIME");
  command
      ->add_option("--hold", options.hold,
                   "A prediction ends once it has not held for so long; 60 s when not given")
      ->type_name("TIME");
  command
      ->add_option(
          "--own", options.own,
          "Watch only the pairs with the track of this id; of AIS gps is the receiver's own position (RMC)")
      ->type_name("ID");
  command->option_defaults()->group("Which ids are one body");
  command
      ->add_option(
          "--same", options.ids.same,
          "Two ids of one body, once or several times: reports of A count as those of B; or a file with "
          "A=B or A,B in each line")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("A=B|@FILE");
  command
      ->add_option(
          "--ignore", options.ids.ignore,
          "Leave out the reports of this id, once or several times, or of a file with an id in each line")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("ID|@FILE");
  command->add_flag("--distinct-ids", options.distinct_ids,
                    "Each id is a body of its own: no track goes on under another id, and no two ids are one "
                    "body. Always so with --only undecided");
  command
      ->add_option(
          "--rest", options.rest,
          "Two tracks that both have been no faster than this for three minutes, or since they were first "
          "heard, are told once until one of them gets under way; 0.5 m/s of vessels when not given, of "
          "others 0: no track is at rest")
      ->type_name("SPEED");
  command->option_defaults()->group("Which alerts");
  command
      ->add_option(
          "--only", options.only,
          "Write alerts of these kinds; within,predicted,lost when not given: at most three for each "
          "encounter. With undecided, each change of a verdict")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"within", "predicted", "lost", "undecided", "tracks", "all"}))
      ->type_name("KINDS");
  command
      ->add_option("--area", options.areas,
                   "Write only alerts about pairs with a track in this circle, or in one of several")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("LAT,LON,RADIUS|X,Y,RADIUS");
  command
      ->add_option(
          "--most-alerts", options.most_alerts,
          "At most so many alerts in a second, and one that counts the others; any number when not given")
      ->check(whole_number(std::uint64_t{1} << 53, 1));
  add_input_options(*command, options.choices, "plane|lonlat");
  command->add_option("--dimensions", options.dimensions, "2 or 3; else as the format has heights or not")
      ->check(CLI::Range(2, 3))
      ->group(input_group);
  const auto measure = [command](const std::string& name, std::string& value, const std::string& description,
                                 const char* type, const char* group) {
    command->add_option(name, value, description)->type_name(type)->group(group);
  };
  const char* const promises = "What tracks promise";
  measure("--acceleration", options.acceleration,
          "No acceleration is larger: one number, or horizontal:vertical", "NUMBER[:NUMBER]", promises);
  measure("--largest-speed", options.largest_speed, "No speed is larger: one number, or horizontal:vertical",
          "NUMBER[:NUMBER]", promises);
  command
      ->add_option(
          "--class", options.classes,
          "Tracks with other limits, once or several times; the first that holds counts: a preset or "
          "limits of acceleration and speed (5:2,40:10), and who has them: an expression as in "
          "--where, or a file with an id in each line")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all()
      ->type_name("CLASS=EXPRESSION|@FILE")
      ->group(promises);
  command
      ->add_flag("--no-classes", options.no_classes,
                 "No classes by what the stream says: status, ship type, emitter category")
      ->group(promises);
  measure("--silence", options.silence, "A track of which nothing is heard for so long is stale", "TIME",
          promises);
  measure("--forget", options.forget, "A track of which nothing is heard for so long is dropped", "TIME",
          promises);
  const char* const errors = "How far off reports are at most";
  command
      ->add_option("--containment", options.choices.containment,
                   "So many times an accuracy of 95 % (nac_p, nac_v, gva) is declared to contain all errors")
      ->check(finite_number())
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str()
      ->group(errors);
  measure("--position-error", options.position_error,
          "Where the stream has none: one number, or horizontal:vertical", "NUMBER[:NUMBER]", errors);
  measure("--velocity-error", options.velocity_error,
          "Where the stream has none: one number, or horizontal:vertical", "NUMBER[:NUMBER]", errors);
  measure("--stamp-error", options.stamp_error, "Where the stream has none", "TIME", errors);
  using PositionBound = FormatChoices::PositionBound;
  add_choice<PositionBound>(*command, "--position-bound", options.choices.position_bound,
                            {{"rc", PositionBound::containment_radius}, {"nac_p", PositionBound::accuracy}},
                            "rc", "Of readsb: which of the two bounds positions, where there are both",
                            errors);
  const char* const map = "Latitudes and longitudes";
  measure("--origin", options.origin, "The middle of the map; the first position when not given", "LAT,LON",
          map);
  measure("--radius", options.radius, "Reports from farther off are not taken; 500 km when not given",
          "LENGTH", map);
  const char* const keeping = "Going on, and several that watch";
  command
      ->add_option("--snapshot", options.snapshot,
                   "Keep the state in this file, and go on from it when it is there")
      ->type_name("FILE")
      ->group(keeping);
  measure("--snapshot-every", options.snapshot_every, "So often, and at the end; 10 s when not given", "TIME",
          keeping);
  command
      ->add_option("--alerts", options.alerts,
                   "Write alerts to this file or subject of NATS, each once however often the program is "
                   "started again")
      ->type_name("FILE|ADDRESS")
      ->group(keeping);
  command
      ->add_option("--share", options.share,
                   "Watch this part of all pairs, where others watch the rest: 2/4, or 1-8/16")
      ->type_name("PART/OF")
      ->group(keeping);
  const char* const reading = input_group;
  command
      ->add_option("--clock", options.clock,
                   "What time it is: as the stream tells, its stamps, or this machine's clock")
      ->check(CLI::IsMember({"stream", "stamps", "arrival"}))
      ->capture_default_str()
      ->group(reading);
  measure("--leap", options.leap,
          "A time that is ahead by more is not believed unless others confirm it; when not given 60 s, or "
          "--silence where that is longer",
          "TIME", reading);
  command
      ->add_option("--most-malformed", options.most_malformed,
                   "More malformed lines end it; any number when not given")
      ->check(whole_number(std::uint64_t{1} << 53))
      ->group(reading);
  command
      ->add_option("--most-tracks", options.most_tracks,
                   "At most so many tracks are watched: reports of more are not taken; 50000 when not given")
      ->check(whole_number(std::uint64_t{1} << 28, 1))
      ->group(reading);
  command
      ->add_option(
          "--most-pairs", options.most_pairs,
          "At most so many pairs may be not certainly apart: from half of them on new tracks are not "
          "taken, beyond all of them the tracks in most of them leave; 1000000 when not given")
      ->check(whole_number(std::uint64_t{1} << 32, 1))
      ->group(reading);
  command->option_defaults()->group("What comes out");
  command->add_option("--summary", options.summary, "Write the summary to this file, as JSON")
      ->type_name("FILE");
  command
      ->add_option("--serve", options.serve,
                   "Serve a map, the state and metrics on this port of 127.0.0.1; 0 for any that is free")
      ->check(CLI::Range(0, 65535))
      ->type_name("PORT");
  command->add_flag("--text", options.text, "Alerts are short lines to read, instead of JSON");
  command->add_flag("--quiet", options.quiet, "No summary and no warnings on standard error");
  add_examples(*command, {"kinesphere watch tcp://127.0.0.1:30003 --separation cylinder:5NM:1000ft",
                          "kinesphere watch ships.nmea --separation sphere:0.5NM --text",
                          "kinesphere watch drones.jsonl --separation sphere:20 --largest-speed 20"});
  return command;
}

int watch(const WatchOptions& options) {
  // Not left to CLI11, which would say so before it names a misspelled option.
  if (options.separations.empty())
    throw ProgramError(
        "--separation: expected it, as sphere:50 or cylinder:5NM:1000ft: how near is too near (see --help)");
  if (!options.more_files.empty())
    throw ProgramError(fmt::format(
        "expected one stream, but got {} and {}: join them in the order of their times, as sort -m does with "
        "lines that begin with a time; kinesphere tracks {} {} --distance LENGTH reads several recordings",
        options.file, options.more_files.front(), shell_word(options.file),
        shell_word(options.more_files.front())));
  const OutputPath outputs[] = {{"--summary", options.summary},
                                {"--snapshot", options.snapshot},
                                {"--alerts", is_nats_address(options.alerts) ? "" : options.alerts}};
  const bool is_file = options.file != "-" && !is_nats_address(options.file) &&
                       !is_udp_address(options.file) && !is_tcp_address(options.file);
  const std::string inputs[] = {is_file ? options.file : ""};
  check_outputs(outputs, inputs);
  std::optional<OutputFile> summary;
  if (!options.summary.empty()) summary.emplace(options.summary);
  WatchLoop watch(options);
  const WatchView& view = watch.view();
  const auto started = std::chrono::steady_clock::now();
  const auto conclude = [&] {
    watch.close();
    const std::vector<Warning> warnings = watch.warnings();
    const WatchEnd end{
        .format = watch.format_name(),
        .warnings = warnings,
        .real_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count()};
    if (!options.quiet) write_message(watch_summary_text(view, end));
    if (!summary) return;
    summary->write(watch_summary_json(view, end));
    summary->commit();
  };
  try {
    watch.run();
  } catch (const ProgramError&) {
    // An error that stops the watch at its first report leaves no summary.
    if (view.counters().reports > 0 || view.counts.malformed > 0) conclude();
    throw;
  }
  conclude();
  const std::uint64_t taken = view.counters().reports;
  if (view.counts.stale > taken && taken > 0 && watch.is_file())
    throw ProgramError(fmt::format(
        "{}: expected rows in the order of their times, but {} of {} reports are older than others "
        "before them by more than --forget, and were not taken: sort them first; tracks reads "
        "rows in any order",
        view.settings.source, view.counts.stale, view.counts.stale + taken));
  if (taken > 0) return exit_fine;
  if (const std::string reasons = reasons_text(view); !reasons.empty())
    throw ProgramError(fmt::format(
        "{}: expected reports of format {} that can be used, but there are none: {}{}", view.settings.source,
        watch.format_name(), reasons,
        view.counts.first_malformed.empty() ? "" : "; " + view.counts.first_malformed.front().reason));
  return exit_fine;
}

}  // namespace kinesphere::program
