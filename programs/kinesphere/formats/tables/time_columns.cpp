// The column of times, and the unit of its numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/units.hpp"
#include "formats/tables/column_steps.hpp"

namespace kinesphere::program {
namespace {

/// Reads a rate from a comment such as "framerate: 25 fps".
std::optional<double> frame_rate_in(const TableHead& head) {
  constexpr std::string_view label = "framerate:";
  for (std::string_view comment : head.comments) {
    if (!comment.starts_with(label)) continue;
    comment.remove_prefix(std::min(comment.find_first_not_of(' ', label.size()), comment.size()));
    const auto rate = parse_number(comment.substr(0, comment.find(' ')));
    if (rate && *rate > 0) return rate;
  }
  return std::nullopt;
}

}  // namespace

void find_parts_of_time(const TableHead& head, TableColumns& columns) {
  const auto& time = columns[Quantity::time];
  if (!time || head.names.empty()) return;
  const std::string& name = head.names[time->place];
  const bool is_whole = is_whole_seconds(name);
  const bool is_given = columns.format == "columns as given" && is_whole && time->said_unit.empty();
  if (columns.format != "table" && !is_given) return;
  for (std::size_t place = 0; place < head.names.size(); ++place)
    if (are_parts_of_time(name, head.names[place])) columns.nanoseconds = place;
  const bool is_part = is_part_of_clock(name);
  for (std::size_t place = 0; place < head.names.size(); ++place)
    if (place != time->place && place != columns.nanoseconds &&
        (is_part_of_time(head.names[place]) || (is_part && is_part_of_clock(head.names[place]))))
      throw ProgramError(
          fmt::format("{}: {} may be a part of the time, as {} is: write both as one column of times, "
                      "or say {} to use the latter alone",
                      head.file, column_text(head, place), column_text(head, time->place),
                      columns_option(columns_text(head, columns, Quantity::time, is_whole ? ":s" : ""))));
}

void understand_time(const TableHead& head, ColumnUse use, TableColumns& columns) {
  auto &time = columns[Quantity::time], &frame = columns[Quantity::frame];
  const auto meaning = time && !head.names.empty() ? meaning_of(head.names[time->place]) : std::nullopt;
  const bool is_frame = frame || (meaning && meaning->quantity == Quantity::frame);
  if (is_frame) {
    if (frame) time = std::exchange(frame, std::nullopt);
    columns.time_kind = TimeKind::frames;
    // The rate of these films turns out with their last row.
    if (columns.film != TableColumns::Film::none && use == ColumnUse::reports) columns.time_unit_said = false;
    if (columns.time_unit_said || !columns.time_problem.empty()) return;
    if (const auto rate = frame_rate_in(head)) {
      columns.time_unit.rate = *rate;
      columns.time_unit_said = true;
    } else {
      columns.time_problem =
          fmt::format("expected --frame-rate, because {} counts frames", column_text(head, time->place));
    }
    return;
  }
  if (time->has_unit) {
    // The quotient keeps 1/1000 exact.
    columns.time_unit =
        time->unit < 1.0 ? TimeUnit{1.0, std::round(1.0 / time->unit)} : TimeUnit{time->unit, 1.0};
    columns.time_unit_said = true;
  } else if (use == ColumnUse::positions && !(meaning && meaning->quantity == Quantity::time)) {
    columns.time_problem = fmt::format(
        "expected --time-unit or --frame-rate, because column {} does not say whether its numbers are "
        "seconds",
        time->place + 1);
  }
}

void apply_time_hints(const ColumnHints& hints, TableColumns& columns) {
  const std::string& unit = hints.time_unit;
  const bool frames = unit == "frames";
  columns.times_are_clocks = unit == "clock";
  const auto known = columns.times_are_clocks ? TimeUnit{} : time_unit_named(unit);
  if (!unit.empty() && !frames && !known)
    throw ProgramError(
        fmt::format("--time-unit: expected s, ms, us, ns, min, h, d, frames or clock, but got '{}'", unit));
  if (known && hints.frame_rate)
    throw ProgramError(
        fmt::format("--frame-rate: expected only where frames are counted, not with --time-unit {}", unit));
  if (hints.frame_rate) {
    if (!(*hints.frame_rate > 0))
      throw ProgramError(fmt::format("--frame-rate: expected a number > 0, but got {}", *hints.frame_rate));
    columns.time_kind = TimeKind::frames;
    columns.time_unit = {1.0, *hints.frame_rate};
    columns.film = TableColumns::Film::none;
  } else if (known) {
    columns.time_kind = TimeKind::number;
    columns.time_unit = *known;
    columns.film = TableColumns::Film::none;
  } else if (frames && (columns.time_kind != TimeKind::frames || !columns.time_problem.empty())) {
    columns.time_problem = "expected --frame-rate with --time-unit frames";
    return;
  } else {
    return;
  }
  columns.time_unit_said = true;
  columns.time_problem.clear();
}

}  // namespace kinesphere::program
