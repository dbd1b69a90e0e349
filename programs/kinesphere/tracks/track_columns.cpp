// Finds the columns of a recorded motion in a table, and the units of their numbers.
#include "tracks/track_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "ascii_text.hpp"
#include "number_text.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

using Film = TrackColumns::Film;

std::string names_in(const TextTable& table) {
  if (table.header().empty()) return fmt::format("no header and {} columns", table.columns());
  return fmt::format("the columns {}", fmt::join(table.header(), ", "));
}

/// Returns the only column of that name, or the only one if case is ignored.
std::optional<std::size_t> column_named(const TextTable& table, std::string_view name) {
  const auto& header = table.header();
  for (const bool exact : {true, false}) {
    const auto matches = [&](const std::string& each) {
      return exact ? each == name : same_name(each, name);
    };
    const auto found = std::find_if(header.begin(), header.end(), matches);
    if (found == header.end()) continue;
    if (std::count_if(header.begin(), header.end(), matches) > 1)
      throw ProgramError(
          fmt::format("{}: expected one column '{}', but it has {}", table.file(), name, names_in(table)));
    return static_cast<std::size_t>(found - header.begin());
  }
  return std::nullopt;
}

/// True for rows of person and frame: frame id x z(=0) y vx vz(=0) vy, without a header.
bool looks_like_obsmat(const TextTable& table) {
  const auto& fields = table.first_row().fields;
  return table.header().empty() && fields.size() == 8 && parse_number(fields[3]) == 0.0 &&
         parse_number(fields[6]) == 0.0;
}

bool is_pedpy(const TextTable& table) {
  return column_named(table, "id") && column_named(table, "frame") && column_named(table, "x/m") &&
         column_named(table, "y/m");
}

bool is_mosquitoes(const TextTable& table) {
  return column_named(table, "oldobject") && column_named(table, "time") && column_named(table, "XSplined") &&
         column_named(table, "YSplined");
}

void want_columns(const TextTable& table, std::string_view format, std::size_t at_least) {
  if (table.columns() >= at_least) return;
  throw ProgramError(fmt::format("{}: expected {} columns or more with --format {}, but it has {}",
                                 table.file(), at_least, format, names_in(table)));
}

TrackColumns obsmat(const TextTable& table, Film film) {
  want_columns(table, film == Film::eth ? "eth" : "ucy", 8);
  TrackColumns columns;
  columns.format = film == Film::eth ? "ETH obsmat" : film == Film::ucy ? "UCY obsmat" : "obsmat";
  columns.time = 0;
  columns.id = 1;
  columns.x = 2;
  columns.y = 4;
  columns.time_kind = TimeKind::frames;
  columns.time_unit.rate = 25.0;
  columns.time_unit_said = true;
  columns.length_unit = 1.0;
  columns.film = film;
  if (film == Film::none) {
    columns.time_problem =
        "it looks like an obsmat, which does not say its frame rate: expected --format ucy, --format eth or "
        "--frame-rate";
  }
  return columns;
}

/// Reads a rate from a comment such as "framerate: 25 fps".
std::optional<double> frame_rate_in(const TextTable& table) {
  constexpr std::string_view label = "framerate:";
  for (std::string_view comment : table.comments()) {
    if (!comment.starts_with(label)) continue;
    comment.remove_prefix(std::min(comment.find_first_not_of(' ', label.size()), comment.size()));
    const auto rate = parse_number(comment.substr(0, comment.find(' ')));
    if (rate && *rate > 0) return rate;
  }
  return std::nullopt;
}

void count_frames(const TextTable& table, TrackColumns& columns) {
  columns.time_kind = TimeKind::frames;
  if (const auto rate = frame_rate_in(table)) {
    columns.time_unit.rate = *rate;
    columns.time_unit_said = true;
  } else {
    columns.time_problem =
        fmt::format("expected --frame-rate, because {} counts frames",
                    table.header().empty() ? fmt::format("column {}", columns.time + 1)
                                           : fmt::format("column '{}'", table.header()[columns.time]));
  }
}

/// z is the person's height.
TrackColumns pedpy(const TextTable& table) {
  want_columns(table, "pedpy", 4);
  TrackColumns columns;
  columns.format = "PedPy";
  columns.id = column_named(table, "id").value_or(0);
  columns.time = column_named(table, "frame").value_or(1);
  columns.x = column_named(table, "x/m").value_or(2);
  columns.y = column_named(table, "y/m").value_or(3);
  columns.length_unit = 1.0;
  count_frames(table, columns);
  return columns;
}

/// "object" joins interrupted tracks, with jumps at the joints; "oldobject" does not.
TrackColumns mosquitoes(const TextTable& table) {
  if (!is_mosquitoes(table)) {
    throw ProgramError(
        fmt::format("{}: expected the columns oldobject, time, XSplined and YSplined with --format "
                    "mosquito, but it has {}",
                    table.file(), names_in(table)));
  }
  TrackColumns columns;
  columns.format = "mosquito tracks";
  columns.id = *column_named(table, "oldobject");
  columns.time = *column_named(table, "time");
  columns.x = *column_named(table, "XSplined");
  columns.y = *column_named(table, "YSplined");
  columns.z = column_named(table, "ZSplined");
  columns.time_unit_said = true;
  columns.length_unit = 1.0;
  return columns;
}

/// Derives the unit of times from the time column's name, or from its absence.
void understand_time(const TextTable& table, TrackColumns& columns) {
  const auto meaning = table.header().empty() ? std::nullopt : meaning_of(table.header()[columns.time]);
  if (meaning && meaning->quantity == Quantity::time) {
    columns.time_unit = time_unit_named(meaning->unit).value_or(TimeUnit{});
    columns.time_unit_said = !meaning->unit.empty();
  } else if (meaning && meaning->quantity == Quantity::frame) {
    count_frames(table, columns);
  } else {
    columns.time_problem = fmt::format(
        "expected --time-unit or --frame-rate, because column {} does not say whether its numbers are "
        "seconds",
        columns.time + 1);
  }
}

/// Derives the units of positions from the names of columns x and y.
void understand_positions(const TextTable& table, TrackColumns& columns) {
  if (table.header().empty()) return;
  const auto x = meaning_of(table.header()[columns.x]);
  const auto y = meaning_of(table.header()[columns.y]);
  if (!x || !y) return;
  if (x->quantity == Quantity::longitude && y->quantity == Quantity::latitude) columns.geographic = true;
  if (x->unit == y->unit && !columns.geographic) columns.length_unit = length_unit_named(x->unit);
}

class UsualNames {
 public:
  UsualNames(const TextTable& table, const TrackHints& hints) : table_(table) {
    const auto& header = table.header();
    for (std::size_t column = 0; column < header.size(); ++column) {
      if (const auto meaning = meaning_of(header[column])) columns_[meaning->quantity].push_back(column);
    }
    // If the file has both kinds of columns, an option must choose one.
    if (hints.from == "lonlat" || hints.unit == "deg") forget({Quantity::x, Quantity::y});
    if (hints.from == "plane" || hints.from.starts_with("utm"))
      forget({Quantity::longitude, Quantity::latitude});
    // Frame numbers are not needed if there are times.
    if (columns_.contains(Quantity::time)) forget({Quantity::frame});
  }

  std::optional<TrackColumns> found() const {
    const auto id = only({Quantity::id}), time = only({Quantity::time, Quantity::frame});
    const auto x = only({Quantity::x, Quantity::longitude}), y = only({Quantity::y, Quantity::latitude});
    if (!id || !time || !x || !y) return std::nullopt;
    TrackColumns columns;
    columns.format = "table";
    columns.id = *id;
    columns.time = *time;
    columns.x = *x;
    columns.y = *y;
    columns.z = only({Quantity::z});
    return columns;
  }

 private:
  void forget(std::initializer_list<Quantity> quantities) {
    for (Quantity quantity : quantities) columns_.erase(quantity);
  }
  std::optional<std::size_t> only(std::initializer_list<Quantity> quantities) const {
    std::vector<std::size_t> all;
    for (Quantity quantity : quantities) {
      if (const auto found = columns_.find(quantity); found != columns_.end())
        all.insert(all.end(), found->second.begin(), found->second.end());
    }
    if (all.size() > 1) {
      throw ProgramError(fmt::format("{}: columns '{}' and '{}' may both be meant: say which with --columns",
                                     table_.file(), table_.header()[all[0]], table_.header()[all[1]]));
    }
    return all.empty() ? std::nullopt : std::optional(all.front());
  }

  const TextTable& table_;
  std::map<Quantity, std::vector<std::size_t>> columns_;
};

/// Returns a column by its name in the header or its number from 1.
std::size_t column_of(const TextTable& table, std::string_view key, std::string_view name) {
  if (const auto column = column_named(table, name)) return *column;
  const double number = parse_number(name).value_or(0.0);
  for (std::size_t column = 1; column <= table.columns(); ++column) {
    if (number == static_cast<double>(column)) return column - 1;
  }
  throw ProgramError(fmt::format(
      "--columns: expected '{}' to be a column's name or number from 1 to {}, but got '{}': {} has {}", key,
      table.columns(), name, table.file(), names_in(table)));
}

TrackColumns columns_given(const TextTable& table, const std::string& given) {
  constexpr std::string_view keys[] = {"id", "time", "x", "y", "z"};
  const auto fail = [&] {
    throw ProgramError(fmt::format(
        "--columns: expected id=...,time=...,x=...,y=... and perhaps z=..., but got '{}'", given));
  };
  std::map<std::string_view, std::size_t> columns;
  for (std::string_view rest = given; !rest.empty();) {
    const std::string_view entry = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(entry.size() + 1, rest.size()));
    const std::size_t equals = entry.find('=');
    if (equals == std::string_view::npos) fail();
    const auto key = std::find(std::begin(keys), std::end(keys), entry.substr(0, equals));
    if (key == std::end(keys) || columns.count(*key) > 0) fail();
    columns[*key] = column_of(table, *key, entry.substr(equals + 1));
  }
  const bool plane = columns.count("z") == 0;
  if (columns.size() != (plane ? 4u : 5u)) fail();
  TrackColumns found;
  found.format = "columns as given";
  found.id = columns["id"];
  found.time = columns["time"];
  found.x = columns["x"];
  found.y = columns["y"];
  if (!plane) found.z = columns["z"];
  return found;
}

TrackColumns table_columns(const TextTable& table, const TrackHints& hints) {
  std::optional<TrackColumns> columns =
      hints.columns.empty() ? UsualNames(table, hints).found() : columns_given(table, hints.columns);
  if (!columns) {
    throw ProgramError(fmt::format(
        "{}: expected columns for id, time, x and y (or lon and lat) by their usual names, --columns or "
        "--format; it has {}",
        table.file(), names_in(table)));
  }
  understand_time(table, *columns);
  understand_positions(table, *columns);
  return *columns;
}

TrackColumns recognised(const TextTable& table, const TrackHints& hints) {
  if (hints.format == "table" || !hints.columns.empty()) return table_columns(table, hints);
  if (hints.format == "ucy") return obsmat(table, Film::ucy);
  if (hints.format == "eth") return obsmat(table, Film::eth);
  if (hints.format == "pedpy") return pedpy(table);
  if (hints.format == "mosquito") return mosquitoes(table);
  if (!hints.format.empty()) {
    throw ProgramError(
        fmt::format("--format: expected ucy, eth, pedpy, mosquito or table, but got '{}'", hints.format));
  }
  if (looks_like_obsmat(table)) return obsmat(table, Film::none);
  if (is_mosquitoes(table)) return mosquitoes(table);
  if (is_pedpy(table)) return pedpy(table);
  return table_columns(table, hints);
}

void apply_time_hints(const TrackHints& hints, TrackColumns& columns) {
  const std::string& unit = hints.time_unit;
  const bool frames = unit == "frames";
  const auto known = time_unit_named(unit);
  if (!unit.empty() && !frames && !known)
    throw ProgramError(
        fmt::format("--time-unit: expected s, ms, us, ns, min, h, d or frames, but got '{}'", unit));
  if (known && hints.frame_rate)
    throw ProgramError(
        fmt::format("--frame-rate: expected only where frames are counted, not with --time-unit {}", unit));
  if (hints.frame_rate) {
    if (!(*hints.frame_rate > 0))
      throw ProgramError(fmt::format("--frame-rate: expected a number > 0, but got {}", *hints.frame_rate));
    columns.time_kind = TimeKind::frames;
    columns.time_unit = {1.0, *hints.frame_rate};
    columns.film = Film::none;
  } else if (known) {
    columns.time_kind = TimeKind::number;
    columns.time_unit = *known;
    columns.film = Film::none;
  } else if (frames && (columns.time_kind != TimeKind::frames || !columns.time_problem.empty())) {
    columns.time_problem = "expected --frame-rate with --time-unit frames";
    return;
  } else {
    return;
  }
  columns.time_unit_said = true;
  columns.time_problem.clear();
}

void apply_length_hints(const TrackHints& hints, TrackColumns& columns) {
  if (hints.from == "lonlat" || hints.unit == "deg") {
    columns.geographic = true;
  } else if (hints.from == "plane") {
    columns.geographic = false;
  } else if (hints.from.starts_with("utm:")) {
    columns.geographic = false;
    columns.zone = parse_utm_zone(std::string_view(hints.from).substr(4), "--from utm");
    columns.length_unit = columns.length_unit.value_or(1.0);
  } else if (!hints.from.empty()) {
    throw ProgramError(fmt::format(
        "--from: expected lonlat, plane or a UTM zone such as utm:33N, but got '{}'", hints.from));
  }
  if (hints.unit.empty() || hints.unit == "deg") return;
  columns.length_unit = length_unit_named(hints.unit);
  if (!columns.length_unit) {
    throw ProgramError(
        fmt::format("--unit: expected m, km, cm, mm, ft, nmi or deg, but got '{}'", hints.unit));
  }
}

}  // namespace

TrackColumns find_columns(const TextTable& table, const TrackHints& hints) {
  TrackColumns columns = recognised(table, hints);
  apply_time_hints(hints, columns);
  apply_length_hints(hints, columns);
  return columns;
}

}  // namespace kinesphere::program
