// The command-line options for reading recordings.
#include "tracks/reading_options.hpp"

#include <CLI/CLI.hpp>
#include <map>

#include "formats/presets.hpp"
#include "validators.hpp"

namespace kinesphere::program {
namespace {

constexpr const char* group = "Reading";

/// Adds an option that takes one of a few names.
template <class Value>
void add_choice(CLI::App& command, const std::string& name, Value& value,
                const std::map<std::string, Value>& choices, const std::string& default_name,
                const std::string& description, const std::string& group_name = group) {
  std::string names;
  for (const auto& [each, ignored] : choices) names += (names.empty() ? "" : "|") + each;
  const auto problem = [name, names, choices](const std::string& text) {
    return choices.contains(text) ? std::string() : "expected one of " + names + ", but got '" + text + "'";
  };
  command
      .add_option_function<std::string>(
          name, [&value, choices](const std::string& text) { value = choices.at(text); }, description)
      ->check(CLI::Validator(problem, "", "choice"))
      ->type_name(names)
      ->default_str(default_name)
      ->group(group_name);
}

}  // namespace

CLI::Option* add_reading_options(CLI::App& command, std::vector<std::string>& files, TrackOptions& options) {
  command.footer(
      "Tables with separators ; , tab or blanks, quoted or not, with the usual column names: id (mmsi,\n"
      "track_id, agent, ...), time (t, timestamp, datetime, ...) or frame, x y z or lon lat. docs/tracks.md\n"
      "explains every option, with an example of each kind of file.");
  CLI::Option* const file_option =
      command
          .add_option(
              "FILE", files,
              "Text tables of positions, plain or gzipped; - for standard input. An id goes on from one "
              "file to the next")
          ->required();
  command.add_option("--format", options.hints.format, "A format that does not say what it is")
      ->type_name(preset_names())
      ->group(group);
  command
      .add_option("--columns", options.hints.columns,
                  "Where what is, by name or number from 1, and its unit: "
                  "id=...,time=...:ms,x=...,y=...[,z=...:ft], or "
                  "lon=...,lat=... in place of x and y")
      ->type_name("LIST")
      ->group(group);
  add_row_options(command, options.hints, group);
  command
      .add_option("--frame-rate", options.hints.frame_rate,
                  "Frames per second, when the time column counts frames")
      ->check(finite_number())
      ->group(group);
  command.add_option("--time-unit", options.hints.time_unit, "Unit of times that are numbers")
      ->type_name("s|ms|us|ns|min|h|d|frames")
      ->group(group);
  command
      .add_option("--unit", options.hints.unit,
                  "Unit of the file's lengths; all other lengths are then in metres")
      ->type_name("m|km|cm|mm|um|ft|nmi|yd|mi|deg")
      ->group(group);
  command
      .add_option("--positions", options.hints.positions,
                  "What the positions are: longitude and latitude, or UTM")
      ->type_name("plane|lonlat|utm:ZONE")
      ->group(group);
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
      ->group(group);
  command
      .add_option("--max-gap", options.max_gap,
                  "A longer time (seconds) between samples of an id ends its track; 2.5 times the median "
                  "interval of that id when not given")
      ->check(finite_number())
      ->group(group);
  return file_option;
}

void add_row_options(CLI::App& command, ColumnHints& hints, const std::string& group_name) {
  command
      .add_option("--where", hints.where,
                  "Only rows for which this holds: comparisons of columns (= != < <= > >=) joined by and, "
                  "or, not, ()")
      ->type_name("EXPRESSION")
      ->group(group_name);
  const std::map<std::string, DateOrder> orders{{"day-first", DateOrder::day_first},
                                                {"month-first", DateOrder::month_first}};
  add_choice(command, "--dates", hints.dates, orders, "", "What dates such as 03/04/2025 begin with",
             group_name);
}

void add_interpolation_option(CLI::App& command, TrackOptions& options) {
  add_choice(command, "--interpolate", options.interpolation,
             {{"spline", Interpolation::spline}, {"linear", Interpolation::linear}}, "spline",
             "The motion between two samples");
}

std::string given_reading_option(const CLI::App& command) {
  for (const CLI::Option* const option : command.get_options()) {
    if (option->get_group() == group && option->count() > 0) return option->get_name();
  }
  return {};
}

}  // namespace kinesphere::program
