// The options of `kinesphere watch`.
#include <CLI/CLI.hpp>

#include "base/help_text.hpp"
#include "base/validators.hpp"
#include "formats/streams/input_options.hpp"
#include "watch/watch.hpp"

namespace kinesphere::program {
namespace {

/// Adds the options of one group of the help.
class OptionGroup {
 public:
  OptionGroup(CLI::App& command, const char* group) : command_(command), group_(group) {}

  /// Adds an option with one value. `type` is that of the value in the help; null: the usual one.
  template <class Value>
  CLI::Option* add(const char* name, Value& value, const char* type, const char* description) {
    CLI::Option* const option = command_.add_option(name, value, description)->group(group_);
    return type != nullptr ? option->type_name(type) : option;
  }
  /// Adds an option that may be given several times, with one value each: the FILE may come behind it.
  void add_several(const char* name, std::vector<std::string>& values, const char* type,
                   const char* description) {
    add(name, values, type, description)->expected(1)->allow_extra_args(false)->take_all();
  }
  void add_flag(const char* name, bool& value, const char* description) {
    command_.add_flag(name, value, description)->group(group_);
  }

 private:
  CLI::App& command_;
  const char* group_;
};

void add_separations(CLI::App& command, WatchOptions& options) {
  OptionGroup group(command, "What is watched for");
  group.add_several("--separation", options.separations, "SHAPE[:TIME]",
                    "What is watched for, at least once: sphere:50, cylinder:5NM:1000ft, "
                    "ellipsoid:5NM:1000ft, well-clear:0.66NM:450ft:35s, do365:corrective; with or without a "
                    "look-ahead time of its own, as sphere:1NM:20min");
  group.add("--look-ahead", options.look_ahead, "TIME",
            "How far ahead predictions reach where a separation has no time of its own; 60 s when not given, "
            "of tables, JSON and recordings 10 s; with 0 nothing is predicted");
  group.add("--confirm", options.confirm, "TIME",
            "A prediction begins once it has held for so long; at once when not given");
  group.add("--hold", options.hold, "TIME",
            "A prediction ends once it has not held for so long; 60 s when not given");
  group.add(
      "--own", options.own, "ID",
      "Watch only the pairs with the track of this id; of AIS gps is the receiver's own position (RMC)");
}

void add_identities(CLI::App& command, WatchOptions& options) {
  OptionGroup group(command, "Which ids are one body");
  group.add_several("--same", options.ids.same, "A=B|@FILE",
                    "Two ids of one body, once or several times: reports of A count as those of B; or a file "
                    "with A=B or A,B in each line");
  group.add_several(
      "--ignore", options.ids.ignore, "ID|@FILE",
      "Leave out the reports of this id, once or several times, or of a file with an id in each line");
  group.add_flag("--distinct-ids", options.distinct_ids,
                 "Each id is a body of its own: no track goes on under another id, and no two ids are one "
                 "body. Always so with --only undecided");
  group.add("--rest", options.rest, "SPEED",
            "Two tracks that both have been no faster than this for three minutes, or since they were first "
            "heard, are told once until one of them gets under way; 0.5 m/s of vessels when not given, of "
            "others 0: no track is at rest");
}

void add_alert_choices(CLI::App& command, WatchOptions& options) {
  OptionGroup group(command, "Which alerts");
  group
      .add("--only", options.only, nullptr,
           "Write alerts of these kinds; within,predicted,lost when not given: at most three for each "
           "encounter. With undecided, each change of a verdict")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"within", "predicted", "lost", "undecided", "tracks", "all"}))
      ->type_name("KINDS");
  group.add_several("--area", options.areas, "LAT,LON,RADIUS|X,Y,RADIUS",
                    "Write only alerts about pairs with a track in this circle, or in one of several");
  group
      .add("--most-alerts", options.most_alerts, nullptr,
           "At most so many alerts in a second, and one that counts the others; any number when not given")
      ->check(whole_number(std::uint64_t{1} << 53, 1));
}

void add_promises(CLI::App& command, WatchOptions& options) {
  OptionGroup group(command, "What tracks promise");
  group.add("--acceleration", options.acceleration, "NUMBER[:NUMBER]",
            "No acceleration is larger: one number, or horizontal:vertical");
  group.add("--largest-speed", options.largest_speed, "NUMBER[:NUMBER]",
            "No speed is larger: one number, or horizontal:vertical");
  group.add_several("--class", options.classes, "CLASS=EXPRESSION|@FILE",
                    "Tracks with other limits, once or several times; the first that holds counts: a preset "
                    "or limits of acceleration and speed (5:2,40:10), and who has them: an expression as in "
                    "--where, or a file with an id in each line");
  group.add_flag("--no-classes", options.no_classes,
                 "No classes by what the stream says: status, ship type, emitter category");
  group.add("--silence", options.silence, "TIME", "A track of which nothing is heard for so long is stale");
  group.add("--forget", options.forget, "TIME", "A track of which nothing is heard for so long is dropped");
}

void add_errors(CLI::App& command, WatchOptions& options) {
  const char* const name = "How far off reports are at most";
  OptionGroup group(command, name);
  group
      .add("--containment", options.choices.containment, nullptr,
           "So many times an accuracy of 95 % (nac_p, nac_v, gva) is declared to contain all errors")
      ->check(finite_number())
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  group.add("--position-error", options.position_error, "NUMBER[:NUMBER]",
            "Where the stream has none: one number, or horizontal:vertical");
  group.add("--velocity-error", options.velocity_error, "NUMBER[:NUMBER]",
            "Where the stream has none: one number, or horizontal:vertical");
  group.add("--stamp-error", options.stamp_error, "TIME", "Where the stream has none");
  using PositionBound = FormatChoices::PositionBound;
  add_choice<PositionBound>(command, "--position-bound", options.choices.position_bound,
                            {{"rc", PositionBound::containment_radius}, {"nac_p", PositionBound::accuracy}},
                            "rc", "Of readsb: which of the two bounds positions, where there are both", name);
}

void add_continuation(CLI::App& command, WatchOptions& options) {
  OptionGroup group(command, "Going on, and several that watch");
  group.add("--snapshot", options.snapshot, "FILE",
            "Keep the state in this file, and go on from it when it is there");
  group.add("--snapshot-every", options.snapshot_every, "TIME",
            "So often, and at the end; 10 s when not given");
  group.add("--alerts", options.alerts, "FILE|ADDRESS",
            "Write alerts to this file or subject of NATS, each once however often the program is started "
            "again");
  group.add("--share", options.share, "PART/OF",
            "Watch this part of all pairs, where others watch the rest: 2/4, or 1-8/16");
}

void add_reading(CLI::App& command, WatchOptions& options) {
  OptionGroup group(command, input_group);
  group
      .add("--clock", options.clock, nullptr,
           "What time it is: as the stream tells, its stamps, or this machine's clock")
      ->check(CLI::IsMember({"stream", "stamps", "arrival"}))
      ->capture_default_str();
  group.add("--leap", options.leap, "TIME",
            "A time that is ahead by more is not believed unless others confirm it; when not given 60 s, or "
            "--silence where that is longer");
  group
      .add("--most-malformed", options.most_malformed, nullptr,
           "More malformed lines end it; any number when not given")
      ->check(whole_number(std::uint64_t{1} << 53));
  group
      .add("--most-tracks", options.most_tracks, nullptr,
           "At most so many tracks are watched: reports of more are not taken; 50000 when not given")
      ->check(whole_number(std::uint64_t{1} << 28, 1));
  group
      .add("--most-pairs", options.most_pairs, nullptr,
           "At most so many pairs may be not certainly apart: from half of them on new tracks are not taken, "
           "beyond all of them the tracks in most of them leave; 1000000 when not given")
      ->check(whole_number(std::uint64_t{1} << 32, 1));
}

void add_output(CLI::App& command, WatchOptions& options) {
  OptionGroup group(command, "What comes out");
  group.add("--summary", options.summary, "FILE", "Write the summary to this file, as JSON");
  group.add("--plot", options.plot, "FILE",
            "Draw a map, and when which pairs had alerts, into this .svg file at the end");
  group
      .add("--serve", options.serve, nullptr,
           "Serve a map, the state and metrics on this port of 127.0.0.1; 0 for any that is free")
      ->check(CLI::Range(0, 65535))
      ->type_name("PORT");
  group.add_flag("--text", options.text, "Alerts are short lines to read, instead of JSON");
  group.add_flag("--quiet", options.quiet, "No summary and no warnings on standard error");
}

}  // namespace

CLI::App* add_watch_command(CLI::App& program, WatchOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "watch", "Tell what is certain about the separation of tracks in a stream of reports");
  command.footer("docs/watch.md explains the formats, the alerts, and what is certain about them.");
  command
      .add_option(
          "FILE", options.file,
          "The stream, one file, plain or gzipped; - for standard input; tcp://HOST:PORT for what a server "
          "sends there; udp://127.0.0.1:PORT for datagrams to this port; nats://HOST:PORT/SUBJECT for what a "
          "server of NATS has")
      ->capture_default_str();
  command.add_option("more", options.more_files)->group("");
  add_separations(command, options);
  add_identities(command, options);
  add_alert_choices(command, options);
  add_input_options(command, options.choices, "plane|lonlat");
  OptionGroup(command, input_group)
      .add("--dimensions", options.dimensions, nullptr, "2 or 3; else as the format has heights or not")
      ->check(CLI::Range(2, 3));
  add_promises(command, options);
  add_errors(command, options);
  OptionGroup map(command, "Latitudes and longitudes");
  map.add("--origin", options.origin, "LAT,LON", "The middle of the map; the first position when not given");
  map.add("--radius", options.radius, "LENGTH",
          "Reports from farther off are not taken; 500 km when not given");
  add_continuation(command, options);
  add_reading(command, options);
  add_output(command, options);
  add_examples(command, {"kinesphere watch tcp://127.0.0.1:30003 --separation cylinder:5NM:1000ft",
                         "kinesphere watch ships.nmea --separation sphere:0.5NM --text",
                         "kinesphere watch drones.jsonl --separation sphere:20 --largest-speed 20"});
  options.command = &command;
  return &command;
}

}  // namespace kinesphere::program
