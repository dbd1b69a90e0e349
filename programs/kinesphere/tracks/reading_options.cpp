// The command-line options for reading track sets.
#include "tracks/reading_options.hpp"

#include "base/validators.hpp"

namespace kinesphere::program {

namespace {

void add_identity_options(CLI::App& command, IdentityChoice& identities) {
  const auto add_ids = [&](const char* name, std::vector<std::string>& texts, const char* type,
                           const char* description) {
    command.add_option(name, texts, description)
        ->type_name(type)
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group(input_group);
  };
  add_ids("--same", identities.same, "A=B|@FILE",
          "Samples of the id A are samples of the id B; FILE has A=B or A,B in each line. May be repeated");
  add_ids("--ignore", identities.ignore, "ID|@FILE",
          "Leave out an id, or those at the begin of each line of FILE. May be repeated");
}

/// Adds options about who is who, and where bodies are that do not say it.
void add_meaning_options(CLI::App& command, TrackOptions& options) {
  add_identity_options(command, options.identities);
  command
      .add_option("--ground", options.ground,
                  "Height of aircraft that are on the ground and send none, which are left out else")
      ->type_name("LENGTH")
      ->group(input_group);
  command
      .add_flag(
          "--plan", options.is_plan,
          "Rows are waypoints of plans: however far apart, the way goes straight on from one to the next")
      ->group(input_group);
}

}  // namespace

std::string_view name_of(Outside outside) {
  switch (outside) {
    case Outside::vanish:
      return "vanish";
    case Outside::stay:
      return "stay";
    case Outside::go_on:
      break;
  }
  return "go-on";
}

CLI::Option* add_reading_options(CLI::App& command, std::vector<std::string>& files, TrackOptions& options) {
  command.footer(
      "Tables with separators ; , tab or blanks, quoted or not, with the usual column names: id (mmsi, "
      "track_id, agent, ...), time (t, timestamp, datetime, ...) or frame, x y z or lon lat. GPX, logs of "
      "NMEA, JSON, XYZ, dumps of LAMMPS, FCD output of SUMO, OEM, sentences of AIS, messages of ADS-B, "
      "ASTERIX and GTFS-realtime in JSON. docs/tables.md explains each kind of file, and how others become "
      "tables, and docs/tracks.md every option.");
  CLI::Option* const file_option =
      command
          .add_option(
              "FILE", files,
              "Text files of positions, plain or gzipped; - for standard input. An id goes on from one "
              "file to the next")
          ->required();
  add_input_options(command, options, "plane|lonlat|utm:ZONE");
  add_choice(command, "--projection", options.projection,
             {{"auto", ProjectionChoice::automatic},
              {"plane", ProjectionChoice::plane},
              {"earth", ProjectionChoice::earth}},
             "auto", "How longitudes and latitudes become lengths");
  add_choice(command, "--missing", options.missing,
             {{"fail", MissingPolicy::fail}, {"skip", MissingPolicy::skip}, {"split", MissingPolicy::split}},
             "fail", "Rows without a time or a position: skip them, or end the track there too");
  add_choice(
      command, "--duplicates", options.duplicates,
      {{"fail", DuplicatePolicy::fail}, {"first", DuplicatePolicy::first}, {"mean", DuplicatePolicy::mean}},
      "fail", "Samples of one id at one time: take the first, or their mean");
  command
      .add_option("--max-speed", options.max_speed,
                  "Leave out samples that cannot be reached at this speed (lengths per second)")
      ->check(finite_number())
      ->group(input_group);
  command
      .add_option("--max-gap", options.max_gap,
                  "A longer time (seconds) between samples of an id ends its track; 2.5 times the median "
                  "interval of that id when not given")
      ->check(finite_number())
      ->group(input_group);
  add_meaning_options(command, options);
  return file_option;
}

void add_motion_options(CLI::App& command, TrackOptions& options) {
  add_choice<std::optional<Interpolation>>(
      command, "--interpolate", options.interpolation,
      {{"spline", Interpolation::spline}, {"linear", Interpolation::linear}}, "spline",
      "The motion between two samples; with --plan linear");
  command
      .add_flag("--count-handovers", options.counts_handovers,
                "An id that begins where and when another one ends is another body, and comes near it")
      ->group(input_group);
  add_choice<std::optional<HeadingFrom>>(
      command, "--heading", options.heading_from,
      {{"motion", HeadingFrom::motion}, {"x-axis", HeadingFrom::x_axis}, {"compass", HeadingFrom::north}}, "",
      "With --sizes: what headings count from, counterclockwise from the x axis or "
      "clockwise from north; motion: bodies point where they go");
  add_choice(command, "--outside", options.outside,
             {{"vanish", Outside::vanish}, {"stay", Outside::stay}, {"go-on", Outside::go_on}}, "vanish",
             "Before its first and after its last sample a body is not there, stays at that sample, or goes "
             "straight on");
}

std::string given_reading_option(const CLI::App& command) {
  for (const CLI::Option* const option : command.get_options()) {
    if (option->get_group() == input_group && option->count() > 0) return option->get_name();
  }
  return {};
}

}  // namespace kinesphere::program
