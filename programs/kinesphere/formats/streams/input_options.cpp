// The command-line options about what files and streams mean, which all commands share.
#include "formats/streams/input_options.hpp"

#include <fmt/format.h>

#include "base/validators.hpp"

namespace kinesphere::program {

void add_input_options(CLI::App& command, FormatChoices& choices, const char* positions) {
  ColumnHints& hints = choices.hints;
  const auto add = [&](const std::string& name, std::string& value, const std::string& description,
                       const std::string& type) {
    return command.add_option(name, value, description)->type_name(type)->group(input_group);
  };
  const auto unknown_format = [](const std::string& text) {
    return format_named(text) ? std::string()
                              : fmt::format("expected one of {}, but got '{}'", format_names(), text);
  };
  add("--format", hints.format, "A format that does not say what it is", format_names())
      ->check(CLI::Validator(unknown_format, "", "format"));
  add("--columns", hints.columns,
      "Of tables: where what is, by name or number from 1, and its unit: "
      "id=...,time=...:ms,x=...,y=...[,z=...:ft], or lon=...,lat=... in place of x and y",
      "LIST");
  add("--where", hints.where,
      "Only rows for which this holds: comparisons of columns (= != < <= > >=) joined by and, or, not, ()",
      "EXPRESSION");
  command
      .add_option("--frame-rate", hints.frame_rate, "Frames per second, when the time column counts frames")
      ->check(finite_number())
      ->group(input_group);
  add("--time-unit", hints.time_unit,
      "Unit of times that are numbers; clock: times such as 09:30:15 count from midnight",
      "s|ms|us|ns|min|h|d|frames|clock");
  add("--unit", hints.unit, "Unit of the file's lengths; all other lengths are then in metres",
      "m|km|cm|mm|um|ft|nmi|yd|mi|deg");
  add_choice<DateOrder>(command, "--dates", hints.dates,
                        {{"day-first", DateOrder::day_first},
                         {"month-first", DateOrder::month_first},
                         {"year-first", DateOrder::year_first}},
                        "", "What dates such as 03/04/2025 begin with");
  add("--positions", hints.positions, "Of tables: what x and y are", positions);
  add_choice<FormatChoices::Altitude>(command, "--altitude", choices.altitude,
                                      {{"barometric", FormatChoices::Altitude::barometric},
                                       {"geometric", FormatChoices::Altitude::geometric}},
                                      "barometric", "Of aircraft: which altitude is their height");
}

}  // namespace kinesphere::program
