// Finds the columns of a recording or stream in a table, and the units of their numbers.
#include "formats/tables/table_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/tables/presets.hpp"

namespace kinesphere::program {
namespace {

using Film = TableColumns::Film;

/// Returns the only column of that name, or the only one if case is ignored.
std::optional<std::size_t> column_named(const TableHead& head, std::string_view name) {
  const auto& names = head.names;
  for (const bool exact : {true, false}) {
    const auto matches = [&](const std::string& each) {
      return exact ? each == name : same_name(each, name);
    };
    const auto found = std::find_if(names.begin(), names.end(), matches);
    if (found == names.end()) continue;
    if (std::count_if(names.begin(), names.end(), matches) > 1)
      throw ProgramError(
          fmt::format("{}: expected one column '{}', but it has {}", head.file, name, head.text()));
    return static_cast<std::size_t>(found - names.begin());
  }
  return std::nullopt;
}

std::string column_text(const TableHead& head, std::size_t place) {
  return head.names.empty() ? fmt::format("column {}", place + 1)
                            : fmt::format("column '{}'", head.names[place]);
}

/// Returns the column's name as --columns takes it: its number where a comma would end it, or others have it.
std::string column_word(const TableHead& head, std::size_t place) {
  const bool by_name = !head.names.empty() && head.names[place].find_first_of(",\"'") == std::string::npos &&
                       std::count(head.names.begin(), head.names.end(), head.names[place]) == 1;
  return by_name ? head.names[place] : fmt::format("{}", place + 1);
}

/// Returns "id=mmsi,time=t,lon=lon,lat=lat" of the columns found, with a unit behind that of `quantity`, and
/// without the column `without`.
std::string columns_text(const TableHead& head, const TableColumns& columns,
                         std::optional<Quantity> quantity = {}, std::string_view unit = {},
                         std::optional<Quantity> without = {}) {
  std::string text = columns.id_is_file ? "id=@file" : "";
  for (std::size_t k = 0; k < quantity_count; ++k) {
    const auto each = static_cast<Quantity>(k);
    if (!columns.of[k] || each == without) continue;
    const std::string said = columns.of[k]->said_unit.empty() ? "" : ":" + columns.of[k]->said_unit;
    text += fmt::format("{}{}={}{}", text.empty() ? "" : ",", key_of(each),
                        column_word(head, columns.of[k]->place), each == quantity ? unit : said);
  }
  return text;
}

/// Returns the option --columns with this list.
std::string columns_option(std::string_view list) { return "--columns " + shell_word(list); }

// Units.

/// Sets the unit of a column; returns false if the measure has none of this name.
bool set_unit(Column& column, std::string_view unit, Quantity quantity) {
  const Measure measure = measure_of(quantity);
  // Lengths that are degrees turn out to be so below.
  auto size = unit_named(unit, measure);
  if (!size && measure == Measure::length && !is_pixel(unit)) size = unit_named(unit, Measure::angle);
  if (!size) return measure == Measure::length && is_pixel(unit);
  column.unit = *size;
  column.has_unit = true;
  return true;
}

/// True if the row of units has one without brackets for the times, so that all its labels are units.
bool has_plain_units(const TableHead& head) {
  for (std::size_t place = 0; place < std::min(head.names.size(), head.units.size()); ++place) {
    const auto meaning = meaning_of(head.names[place]);
    if (meaning && meaning->quantity == Quantity::time && unit_named(head.units[place], Measure::time))
      return true;
  }
  return false;
}

/// Returns the unit of a column in its name or in the row of units; empty if there is none.
std::string unit_of_column(const TableHead& head, std::size_t place, Quantity quantity) {
  if (!head.names.empty()) {
    if (const auto meaning = meaning_of(head.names[place]); meaning && meaning->quantity == quantity) {
      if (!meaning->unit.empty()) return meaning->unit;
    } else if (const auto unit = unit_in_name(head.names[place], measure_of(quantity)); !unit.empty()) {
      return std::string(unit);
    }
  }
  if (head.units.empty() || measure_of(quantity) == Measure::none) return {};
  const std::string_view text = head.units[place];
  const std::string_view unit = without_brackets(text);
  Column ignored;
  if (unit.empty() || unit == "-" || set_unit(ignored, unit, quantity))
    return std::string(unit == "-" ? "" : unit);
  // A label without brackets says nothing, but among units.
  if (unit.size() == trimmed(text).size() && !has_plain_units(head)) return {};
  // A time in a unit of length is a mistake that some programs make in all files.
  if (quantity == Quantity::time || is_unit(unit)) return {};
  throw ProgramError(
      fmt::format("{}: {} is in '{}', which is no known unit: say its unit with --columns, as {}={}:m",
                  head.file, column_text(head, place), unit, key_of(quantity), column_word(head, place)));
}

void take_unit_of_column(const TableHead& head, Quantity quantity, Column& column) {
  const std::string unit = unit_of_column(head, column.place, quantity);
  if (!unit.empty()) set_unit(column, unit, quantity);
}

// Columns that are said: by --columns, or by a preset.

/// Returns a column by its name in the header or its number from 1; nothing if there is none.
std::optional<std::size_t> place_of(const TableHead& head, std::string_view name) {
  if (const auto place = column_named(head, name)) return place;
  const double number = parse_number(name).value_or(0.0);
  for (std::size_t place = 0; place < head.columns(); ++place)
    if (number == static_cast<double>(place + 1)) return place;
  return std::nullopt;
}

/// Reads the entries KEY=COLUMN[:UNIT] of a list.
class SaidColumns {
 public:
  SaidColumns(const TableHead& head, std::string_view list, const Preset* preset)
      : head_(head), list_(list), preset_(preset) {}

  TableColumns read() {
    for (std::string_view rest = list_; !rest.empty();) {
      const std::string_view entry = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(entry.size() + 1, rest.size()));
      read_entry(entry);
    }
    return std::move(columns_);
  }

 private:
  void read_entry(std::string_view entry) {
    const std::size_t equals = std::min(entry.find('='), entry.size());
    std::string_view key = entry.substr(0, equals);
    const bool is_optional = key.ends_with('?');
    if (is_optional) key.remove_suffix(1);
    const auto quantity = quantity_of_key(key);
    if (equals == entry.size() || !quantity)
      throw ProgramError(fmt::format("--columns: expected KEY=COLUMN with one of the keys {}, but got '{}'",
                                     key_list(), entry));
    if (columns_[*quantity]) throw ProgramError(fmt::format("--columns: expected '{}' once", key));
    std::string_view names = entry.substr(equals + 1), unit;
    if (const std::size_t colon = names.rfind(':');
        colon != std::string_view::npos && !column_named(head_, names)) {
      unit = names.substr(colon + 1);
      names = names.substr(0, colon);
    }
    if (*quantity == Quantity::id && names == "@file") {
      columns_.id_is_file = true;
      return;
    }
    const auto place = place_of_any(names);
    if (!place && is_optional) return;
    if (!place) fail(key, names);
    Column column{.place = *place};
    take_unit_of_column(head_, *quantity, column);
    if (!unit.empty() && !set_unit(column, unit, *quantity))
      throw ProgramError(fmt::format("--columns: expected a unit ({}) behind the colon, but got '{}'",
                                     unit_list(measure_of(*quantity)), entry));
    if (preset_ == nullptr) column.said_unit = unit;
    columns_[*quantity] = column;
  }

  std::optional<std::size_t> place_of_any(std::string_view names) const {
    if (preset_ == nullptr) return place_of(head_, names);
    while (!names.empty()) {
      const std::string_view name = names.substr(0, names.find('|'));
      names.remove_prefix(std::min(name.size() + 1, names.size()));
      if (const auto place = preset_column(head_, name)) return place;
      if (const auto place = place_of(head_, name)) return place;
    }
    return std::nullopt;
  }

  [[noreturn]] void fail(std::string_view key, std::string_view name) const {
    if (preset_ != nullptr)
      throw ProgramError(fmt::format("{}: expected {} with --format {}, but it has {}", head_.file,
                                     preset_->header.empty()
                                         ? fmt::format("{} columns or more", preset_->least_columns)
                                         : fmt::format("the columns {}", preset_->header),
                                     preset_->name, head_.text()));
    throw ProgramError(fmt::format(
        "--columns: expected '{}' to be a column's name or number from 1 to {}, but got '{}': {} has {}", key,
        head_.columns(), name, head_.file, head_.text()));
  }

  const TableHead& head_;
  std::string_view list_;
  const Preset* preset_;
  TableColumns columns_;
};

bool is_position(Quantity quantity) {
  constexpr Quantity positions[] = {Quantity::id,   Quantity::time,      Quantity::frame,
                                    Quantity::date, Quantity::x,         Quantity::y,
                                    Quantity::z,    Quantity::longitude, Quantity::latitude};
  return std::find(std::begin(positions), std::end(positions), quantity) != std::end(positions);
}

bool is_size(Quantity quantity) { return quantity == Quantity::length || quantity == Quantity::width; }

bool is_used(Quantity quantity, const ColumnHints& hints, ColumnUse use) {
  if (is_size(quantity)) return hints.sizes;
  return use == ColumnUse::reports || is_position(quantity);
}

/// Leaves out what is not read.
void keep_used(const ColumnHints& hints, ColumnUse use, TableColumns& columns) {
  for (std::size_t k = 0; k < quantity_count; ++k)
    if (!is_used(static_cast<Quantity>(k), hints, use)) columns.of[k].reset();
}

void require_sizes(const TableHead& head, const TableColumns& columns) {
  if (!columns[Quantity::length] || !columns[Quantity::width])
    throw ProgramError(
        fmt::format("{}: expected columns of length and width for --sizes, by their names or --columns "
                    "length=...,width=...; it has {}",
                    head.file, head.text()));
  if (columns.is_ais)
    throw ProgramError(
        fmt::format("{}: expected positions of the middle for --sizes, but those of AIS are of the "
                    "antenna, anywhere on the ship",
                    head.file));
}

TableColumns preset_columns(const TableHead& head, const Preset& preset) {
  if (head.columns() < preset.least_columns)
    throw ProgramError(fmt::format("{}: expected {} columns or more with --format {}, but it has {}",
                                   head.file, preset.least_columns, preset.name, head.text()));
  TableColumns columns = SaidColumns(head, preset.columns, &preset).read();
  columns.format = preset.title;
  columns.has_own_heights = preset.has_own_heights;
  columns.has_own_origin = preset.has_own_origin;
  columns.film = preset.film;
  columns.dates = preset.dates;
  columns.where = preset.where;
  if (preset.frame_rate > 0.0) {
    columns.time_unit.rate = preset.frame_rate;
    columns.time_unit_said = true;
  }
  return columns;
}

// What to say.

/// True for parts of the messages of robots that have axes, but are no places: pose.orientation,
/// twist.linear.
bool is_of_no_place(std::string_view body) {
  constexpr std::string_view words[] = {"orientation", "linear",       "angular",
                                        "velocity",    "acceleration", "rotation"};
  return std::any_of(std::begin(words), std::end(words),
                     [&](std::string_view word) { return body.ends_with(word); });
}

/// Adds columns that may be meant, for messages: vessel_mmsi, OSD.latitude, field.pose.position.x. Of several
/// that are alike it adds none.
void add_likely_columns(const TableHead& head, TableColumns& columns) {
  std::array<std::vector<std::size_t>, quantity_count> likely;
  for (std::size_t place = 0; place < head.names.size(); ++place) {
    if (is_of_no_place(axis_and_body(head.names[place]).body)) continue;
    auto meaning = meaning_of_ending(head.names[place]);
    for (const Quantity angle : {Quantity::longitude, Quantity::latitude})
      if (!meaning && looks_like_angle(head.names[place], angle)) meaning = ColumnMeaning{angle, ""};
    if (!meaning && may_be_id(head.names[place])) meaning = ColumnMeaning{Quantity::id, ""};
    if (meaning && is_position(meaning->quantity))
      likely[static_cast<std::size_t>(meaning->quantity)].push_back(place);
  }
  const bool has_place = columns[Quantity::x] || columns[Quantity::longitude];
  for (std::size_t k = 0; k < quantity_count; ++k) {
    const Measure measure = measure_of(static_cast<Quantity>(k));
    const bool is_place = measure == Measure::length || measure == Measure::angle;
    if (!columns.of[k] && likely[k].size() == 1 && !(is_place && has_place))
      columns.of[k] = Column{.place = likely[k].front()};
  }
  if (columns[Quantity::time]) columns[Quantity::frame].reset();
  if (columns[Quantity::longitude] && columns[Quantity::latitude])
    columns[Quantity::x] = columns[Quantity::y] = std::nullopt;
}

/// Returns the option --columns with these columns and those that are likely, and with id=..., time=... and
/// x=...,y=... for what is none of them.
std::string whole_columns_option(const TableHead& head, TableColumns columns) {
  add_likely_columns(head, columns);
  const bool has_bodies = !columns.bodies.empty();
  if (has_bodies)
    for (const Quantity quantity :
         {Quantity::id, Quantity::x, Quantity::y, Quantity::z, Quantity::longitude, Quantity::latitude})
      columns[quantity].reset();
  const std::string found = columns_text(head, columns);
  const auto has = [&](Quantity quantity) { return columns[quantity].has_value(); };
  const bool has_place =
      (has(Quantity::x) && has(Quantity::y)) || (has(Quantity::longitude) && has(Quantity::latitude));
  std::vector<std::string> said;
  if (!has(Quantity::id) && !columns.id_is_file && !has_bodies) said.emplace_back("id=...");
  if (!has(Quantity::time) && !has(Quantity::frame)) said.emplace_back("time=...");
  if (!found.empty()) said.push_back(found);
  if (!has_place && !has_bodies) said.emplace_back("x=...,y=...");
  return columns_option(fmt::format("{}", fmt::join(said, ","))) +
         (said.front() == "id=..." ? ", with id=@file where each file is one body" : "");
}

// Columns by their usual names.

class UsualColumns {
 public:
  UsualColumns(const TableHead& head, const ColumnHints& hints, ColumnUse use) : head_(head) {
    for (std::size_t place = 0; place < head.names.size(); ++place) {
      const auto meaning = meaning_of(head.names[place]);
      if (!meaning || !is_used(meaning->quantity, hints, use)) continue;
      places_[static_cast<std::size_t>(meaning->quantity)].push_back(place);
    }
    // If the file has both kinds of columns, an option must choose one.
    const bool has_degrees = !places(Quantity::longitude).empty() && !places(Quantity::latitude).empty();
    if (has_degrees && (hints.positions == "lonlat" || hints.unit == "deg"))
      forget({Quantity::x, Quantity::y});
    if (hints.positions == "plane" || hints.positions.starts_with("utm"))
      forget({Quantity::longitude, Quantity::latitude});
    take_track_as_id();
    // Frame numbers are not needed if there are times, nor dates without a clock.
    if (!places(Quantity::time).empty()) forget({Quantity::frame});
    auto& times = places_[static_cast<std::size_t>(Quantity::time)];
    if (times.empty() && places(Quantity::frame).empty())
      times.swap(places_[static_cast<std::size_t>(Quantity::date)]);
  }

  TableColumns found() const {
    if (!places(Quantity::x).empty() && !places(Quantity::longitude).empty())
      ask(places(Quantity::x).front(), places(Quantity::longitude).front());
    TableColumns columns;
    columns.format = "table";
    for (std::size_t k = 0; k < quantity_count; ++k) {
      if (places_[k].size() > 1) ask(places_[k][0], places_[k][1]);
      if (places_[k].empty()) continue;
      const auto quantity = static_cast<Quantity>(k);
      Column column{.place = places_[k].front()};
      take_unit_of_column(head_, quantity, column);
      columns[quantity] = column;
    }
    return columns;
  }

 private:
  const std::vector<std::size_t>& places(Quantity quantity) const {
    return places_[static_cast<std::size_t>(quantity)];
  }
  /// A column called track has courses beside speeds, and else ids.
  void take_track_as_id() {
    const bool has_speed = std::any_of(head_.names.begin(), head_.names.end(), [](const std::string& name) {
      const auto meaning = meaning_of(name);
      return meaning && meaning->quantity == Quantity::speed;
    });
    auto& ids = places_[static_cast<std::size_t>(Quantity::id)];
    if (has_speed || !ids.empty()) return;
    for (std::size_t place = 0; place < head_.names.size(); ++place)
      if (plain_name(head_.names[place]) == "track") ids.push_back(place);
    if (!ids.empty()) forget({Quantity::course});
  }
  void forget(std::initializer_list<Quantity> forgotten) {
    for (Quantity quantity : forgotten) places_[static_cast<std::size_t>(quantity)].clear();
  }
  [[noreturn]] void ask(std::size_t one, std::size_t other) const {
    TableColumns example;
    for (std::size_t k = 0; k < quantity_count; ++k)
      if (!places_[k].empty()) example.of[k] = Column{.place = places_[k].back()};
    // Beside longitudes, x, y and z are something else, such as accelerations.
    if (example[Quantity::longitude] && example[Quantity::x]) {
      example[Quantity::x] = example[Quantity::y] = example[Quantity::z] = std::nullopt;
      for (std::size_t place = head_.names.size(); place-- > 0;)
        if (plain_name(head_.names[place]) != "z" && looks_like_height(head_.names[place]))
          example[Quantity::z] = Column{.place = place};
    }
    // Whole seconds have their rest in another column.
    for (const std::size_t place : places(Quantity::time))
      if (!plain_name(head_.names[place]).ends_with("sec")) example[Quantity::time] = Column{.place = place};
    // Of ids that of a track, not of a sample of it.
    for (const std::size_t place : places(Quantity::id))
      if (plain_name(head_.names[place]).find("track") != std::string::npos)
        example[Quantity::id] = Column{.place = place};
    throw ProgramError(fmt::format("{}: columns '{}' and '{}' may both be meant: say which, as in {}",
                                   head_.file, head_.names[one], head_.names[other],
                                   whole_columns_option(head_, example)));
  }

  const TableHead& head_;
  std::array<std::vector<std::size_t>, quantity_count> places_;
};

/// Finds the bodies whose columns are called after an axis and the body: x1 and y1, car_1.lon and car_1.lat.
/// Each has `along` and `across`, and perhaps z.
std::vector<TableColumns::Body> bodies_in_names(const TableHead& head, Quantity along, Quantity across) {
  struct Named {
    std::string body;
    std::optional<std::size_t> x, y, z;
  };
  std::vector<Named> all;
  for (std::size_t place = 0; place < head.names.size(); ++place) {
    const auto [axis, body] = axis_and_body(head.names[place]);
    if (body.empty()) continue;
    auto known = std::find_if(all.begin(), all.end(),
                              [&, &name = body](const Named& each) { return each.body == name; });
    if (known == all.end()) known = all.insert(all.end(), {.body = body, .x = {}, .y = {}, .z = {}});
    if (axis == along) known->x = place;
    if (axis == across) known->y = place;
    if (axis == Quantity::z) known->z = place;
  }
  std::vector<TableColumns::Body> bodies;
  for (const Named& each : all)
    if (each.x && each.y && !is_of_no_place(each.body))
      bodies.push_back({each.body, *each.x, *each.y, each.z});
  return bodies;
}

/// True for bodies that are told apart by a number alone: 1 and 2, car_1 and car_2.
bool are_numbered(const std::vector<TableColumns::Body>& bodies) {
  const auto kind_of = [](std::string_view body) {
    return body.substr(0, body.find_last_not_of("0123456789") + 1);
  };
  return std::all_of(bodies.begin(), bodies.end(), [&](const TableColumns::Body& each) {
    return kind_of(each.id).size() < each.id.size() && kind_of(each.id) == kind_of(bodies.front().id);
  });
}

/// True for a name that ends as an id does: MetaData.MMSI.
bool has_likely_id(const TableHead& head) {
  return std::any_of(head.names.begin(), head.names.end(), [](const std::string& name) {
    const auto meaning = meaning_of_ending(name);
    return meaning && meaning->quantity == Quantity::id;
  });
}

/// Takes the unit of the first body's column, which must be that of the others.
void take_unit_of_bodies(const TableHead& head, Quantity quantity, TableColumns& columns) {
  Column& column = *columns[quantity];
  take_unit_of_column(head, quantity, column);
  for (const TableColumns::Body& body : columns.bodies) {
    const bool is_across = quantity == Quantity::y || quantity == Quantity::latitude;
    const std::size_t place = quantity == Quantity::z ? *body.z : is_across ? body.y : body.x;
    if (unit_of_column(head, place, quantity) != unit_of_column(head, column.place, quantity))
      throw ProgramError(fmt::format("{}: expected one unit of {}, but {} and {} have different ones",
                                     head.file, key_of(quantity), column_text(head, column.place),
                                     column_text(head, place)));
  }
}

/// Finds a pair of columns for each body: x1, y1, x2, y2, as idtracker.ai writes them, or lon1, lat1 and so
/// on; or three, with z or alt.
void find_pairs(const TableHead& head, const ColumnHints& hints, TableColumns& columns) {
  if (columns[Quantity::id] || columns[Quantity::x] || columns[Quantity::longitude]) return;
  const auto plane = bodies_in_names(head, Quantity::x, Quantity::y);
  const auto earth = bodies_in_names(head, Quantity::longitude, Quantity::latitude);
  const bool is_earth = plane.empty() || (!earth.empty() && hints.positions == "lonlat");
  if (!plane.empty() && !earth.empty() && hints.positions.empty())
    throw ProgramError(
        fmt::format("{}: columns '{}' and '{}' may both be meant: say --positions plane or lonlat", head.file,
                    head.names[plane[0].x], head.names[earth[0].x]));
  const std::vector<TableColumns::Body>& bodies = is_earth ? earth : plane;
  const bool numbered = are_numbered(bodies);
  if (bodies.empty() || (!numbered && (bodies.size() == 1 || has_likely_id(head)))) return;
  const auto heights =
      std::count_if(bodies.begin(), bodies.end(), [](const auto& each) { return each.z.has_value(); });
  if (heights != 0 && heights != std::ssize(bodies))
    throw ProgramError(fmt::format("{}: expected a height for each pair of columns or for none; it has {}",
                                   head.file, head.text()));
  // Of the bodies, as x1 and p1 are (x0, y0, x1, y1 are mostly corners), or the time.
  const auto is_usual = [&](std::size_t place) {
    const std::string& name = head.names[place];
    const auto meaning = meaning_of(name);
    const bool is_said = std::any_of(columns.of.begin(), columns.of.end(),
                                     [&](const auto& column) { return column && column->place == place; });
    const bool is_of_body = std::any_of(bodies.begin(), bodies.end(), [&](const TableColumns::Body& body) {
      return body.id != "0" && (body.x == place || body.y == place || body.z == place);
    });
    return is_of_body || name.ends_with('1') || name.ends_with('2') || is_said ||
           (meaning && (meaning->quantity == Quantity::time || meaning->quantity == Quantity::frame));
  };
  bool all_usual = true;
  for (std::size_t place = 0; place < head.names.size(); ++place) all_usual = all_usual && is_usual(place);
  const bool may_be_corners =
      bodies.size() == 2 && heights == 0 && parse_number(bodies.front().id) && !all_usual;
  if ((!numbered || may_be_corners) && hints.format != "table")
    throw ProgramError(fmt::format(
        "{}: {}, {}, {} and {} may be two bodies or {}: say --format table if each such pair is a "
        "body, else say the columns with --columns",
        head.file, head.names[bodies[0].x], head.names[bodies[0].y], head.names[bodies[1].x],
        head.names[bodies[1].y], numbered ? "the corners of boxes" : "parts of one"));
  columns.bodies = bodies;
  columns.format = fmt::format("{} {} of columns", bodies.size(), heights == 0 ? "pairs" : "triples");
  const TableColumns::Body& first = columns.bodies.front();
  columns[is_earth ? Quantity::longitude : Quantity::x] = Column{.place = first.x};
  columns[is_earth ? Quantity::latitude : Quantity::y] = Column{.place = first.y};
  if (first.z) columns[Quantity::z] = Column{.place = *first.z};
  for (const Quantity quantity :
       {Quantity::x, Quantity::y, Quantity::z, Quantity::longitude, Quantity::latitude})
    if (columns[quantity]) take_unit_of_bodies(head, quantity, columns);
}

/// Asks about a second column of the time: nanoseconds, as ROS has them, or weeks, as GPS has. Of columns
/// that are given, those of whole seconds without a unit are asked about.
void ask_for_parts_of_time(const TableHead& head, const TableColumns& columns) {
  const auto& time = columns[Quantity::time];
  if (!time || head.names.empty()) return;
  const std::string name = plain_name(head.names[time->place]);
  const bool is_whole = name.ends_with("sec") || name.ends_with("secs");
  const bool is_given = columns.format == "columns as given" && is_whole && time->said_unit.empty();
  if (columns.format != "table" && !is_given) return;
  for (std::size_t place = 0; place < head.names.size(); ++place)
    if (place != time->place && is_part_of_time(head.names[place]))
      throw ProgramError(
          fmt::format("{}: {} may be a part of the time, as {} is: write both as one column of times, "
                      "or say {} to use the latter alone",
                      head.file, column_text(head, place), column_text(head, time->place),
                      columns_option(columns_text(head, columns, Quantity::time, is_whole ? ":s" : ""))));
}

/// True where a column of widths has the same name: height and width, bb_h and bb_w.
bool is_height_of_box(const TableHead& head, std::string_view name) {
  const std::string plain = plain_name(name);
  return std::any_of(head.names.begin(), head.names.end(), [&](const std::string& other) {
    std::string width = plain_name(other);
    if (const std::size_t at = width.find("width"); at != std::string::npos) {
      width.replace(at, 5, "height");
    } else if (width.ends_with('w')) {
      width.back() = 'h';
    }
    return width == plain && plain_name(other) != plain;
  });
}

/// Asks about a column that may be a height, where no column is known to be one.
void ask_for_heights(const TableHead& head, const TableColumns& columns) {
  if (columns.z()) return;
  std::vector<std::string> heights;
  std::size_t first = 0;
  for (std::size_t place = 0; place < head.names.size(); ++place) {
    const std::string& name = head.names[place];
    const bool is_known = std::any_of(columns.of.begin(), columns.of.end(),
                                      [&](const auto& column) { return column && column->place == place; });
    if (is_known || is_height_of_box(head, name) || !looks_like_height(name)) continue;
    if (heights.empty()) first = place;
    heights.push_back(fmt::format("'{}'", name));
  }
  if (heights.empty()) return;
  const std::string others = columns_text(head, columns);
  throw ProgramError(fmt::format(
      "{}: {} may be {}: say {} to use {}, or {} to leave heights out", head.file,
      heights.size() == 1 ? "column " + heights.front() : fmt::format("columns {}", fmt::join(heights, ", ")),
      heights.size() == 1 ? "a height" : "heights",
      columns_option(fmt::format("{},z={}", others, column_word(head, first))),
      heights.size() == 1 ? "it" : "one", columns_option(others)));
}

/// True for rows of person and frame: frame id x z(=0) y vx vz(=0) vy, without a header.
bool looks_like_obsmat(const TableHead& head) {
  const auto& fields = head.first;
  return head.names.empty() && fields.size() == 8 && parse_number(fields[3]) == 0.0 &&
         parse_number(fields[6]) == 0.0;
}

TableColumns unlabelled_obsmat(const TableHead& head) {
  TableColumns columns = preset_columns(head, *preset_named("ucy"));
  columns.format = "obsmat";
  columns.film = Film::none;
  columns.time_problem =
      "it looks like an obsmat, which does not say its frame rate: expected --format ucy, --format eth or "
      "--frame-rate";
  return columns;
}

TableColumns recognised(const TableHead& head, const ColumnHints& hints, ColumnUse use) {
  if (!hints.columns.empty()) {
    TableColumns columns = SaidColumns(head, hints.columns, nullptr).read();
    columns.format = "columns as given";
    // Those of the bodies are found beside the time that is said.
    if (!columns.id_is_file && (columns[Quantity::time] || columns[Quantity::frame]))
      find_pairs(head, hints, columns);
    return columns;
  }
  if (!hints.format.empty() && hints.format != "table") {
    if (const Preset* const preset = preset_named(hints.format)) return preset_columns(head, *preset);
    throw ProgramError(
        fmt::format("--format: expected one of {}, but got '{}'", preset_names(), hints.format));
  }
  if (hints.format.empty()) {
    if (const Preset* const preset = recognised_preset(head)) return preset_columns(head, *preset);
    if (use == ColumnUse::positions && looks_like_obsmat(head)) return unlabelled_obsmat(head);
  }
  TableColumns columns = UsualColumns(head, hints, use).found();
  find_pairs(head, hints, columns);
  return columns;
}

// Places.

/// Makes x and y longitude and latitude if their names, their units or the hints say so.
void understand_places(const TableHead& head, const ColumnHints& hints, TableColumns& columns) {
  auto &x = columns[Quantity::x], &y = columns[Quantity::y];
  auto &lon = columns[Quantity::longitude], &lat = columns[Quantity::latitude];
  const auto is_angle = [&](const std::optional<Column>& column, Quantity angle) {
    if (!column || head.names.empty()) return false;
    const std::string& name = head.names[column->place];
    if (looks_like_angle(name, angle)) return true;
    const auto meaning = meaning_of(name);
    return meaning && (meaning->quantity == angle || unit_named(meaning->unit, Measure::angle).has_value());
  };
  const bool said = hints.positions == "lonlat" || hints.unit == "deg";
  const bool by_name = is_angle(x, Quantity::longitude) && is_angle(y, Quantity::latitude);
  const bool swapped = is_angle(x, Quantity::latitude) && is_angle(y, Quantity::longitude) && !by_name;
  if (swapped && hints.positions.empty())
    throw ProgramError(fmt::format(
        "--columns: expected a longitude as x and a latitude as y, but got '{}' and '{}': say lon={},lat={}",
        head.names[x->place], head.names[y->place], column_word(head, y->place),
        column_word(head, x->place)));
  const bool one_alone = is_angle(x, Quantity::longitude) != is_angle(y, Quantity::latitude);
  if (x && y && one_alone && !swapped && !said && hints.positions != "plane")
    throw ProgramError(
        fmt::format("{}: {} are degrees, but {} are not said to be: say --positions lonlat or plane",
                    head.file, column_text(head, is_angle(x, Quantity::longitude) ? x->place : y->place),
                    column_text(head, is_angle(x, Quantity::longitude) ? y->place : x->place)));
  if (x && y && !lon && !lat && hints.positions != "plane" && (said || by_name)) {
    lon = std::exchange(x, std::nullopt);
    lat = std::exchange(y, std::nullopt);
    take_unit_of_column(head, Quantity::longitude, *lon);
    take_unit_of_column(head, Quantity::latitude, *lat);
  }
  if (lon && lat && !x && !y) {
    if (hints.positions == "plane") {
      x = Column{.place = std::exchange(lon, std::nullopt)->place};
      y = Column{.place = std::exchange(lat, std::nullopt)->place};
    }
    columns.positions_said = true;
  }
  if (!hints.positions.empty() || !hints.unit.empty()) columns.positions_said = true;
  columns.geographic = lon.has_value();
}

/// Returns the message about columns that were not found, with those that were.
std::string missing_columns_text(const TableHead& head, const TableColumns& columns) {
  const std::string text = fmt::format(
      "{}: expected columns for id, time, x and y (or lon and lat) by their usual names, --columns or "
      "--format; it has {}",
      head.file, head.text());
  const std::string_view above = "lines above the header have to be left out or begin with #";
  if (head.names.empty())
    return fmt::format(
        "{}: say --columns id=...,time=...,x=...,y=... with the numbers of its columns, whose "
        "first row is {} ({})",
        text, shown_field(fmt::format("{}", fmt::join(head.first, " "))), above);
  constexpr std::size_t fewest = 4;
  TableColumns likely = columns;
  add_likely_columns(head, likely);
  if (columns_text(head, likely).empty() && head.names.size() < fewest)
    return fmt::format("{} ({})", text, above);
  return fmt::format("{}: say {}", text, whole_columns_option(head, columns));
}

void require_columns(const TableHead& head, const ColumnHints& hints, const TableColumns& columns) {
  const auto has = [&](Quantity quantity) { return columns[quantity].has_value(); };
  const bool plane = has(Quantity::x) && has(Quantity::y);
  const bool earth = has(Quantity::longitude) && has(Quantity::latitude);
  const bool half =
      has(Quantity::x) != has(Quantity::y) || has(Quantity::longitude) != has(Quantity::latitude);
  const bool has_id = has(Quantity::id) || columns.id_is_file || !columns.bodies.empty();
  const bool has_time = has(Quantity::time) != has(Quantity::frame), has_place = plane != earth && !half;
  if (!has_id || !has_time || !has_place) {
    if (!hints.columns.empty())
      throw ProgramError(
          fmt::format("--columns: expected id=... (or id=@file), time=... (or frame=...), x=...,y=... (or "
                      "lon=...,lat=...) and "
                      "perhaps z=..., but got '{}'",
                      hints.columns));
    throw ProgramError(missing_columns_text(head, columns));
  }
  if (has(Quantity::vx) != has(Quantity::vy) || (has(Quantity::course) && !has(Quantity::speed)) ||
      (has(Quantity::vx) && has(Quantity::speed)))
    throw ProgramError(
        fmt::format("{}: expected either vx and vy or speed and course, or neither: say which with --columns",
                    head.file));
}

/// Finds columns of N, S, E and W, each behind that of its degrees.
void find_hemispheres(const TableHead& head, TableColumns& columns) {
  if (!columns.geographic || !columns.bodies.empty()) return;
  const auto behind = [&](const Column& angle, std::string_view letters) -> std::optional<std::size_t> {
    const std::size_t place = angle.place + 1;
    if (place >= head.columns() || head.first[place].size() != 1) return std::nullopt;
    return letters.find(head.first[place][0]) != std::string_view::npos ? std::optional(place) : std::nullopt;
  };
  columns.east_or_west = behind(columns.x(), "EWew");
  columns.north_or_south = behind(columns.y(), "NSns");
}

// Lengths.

/// Asks for the units of heights and speeds beside ten-millionths of degrees: in messages of MAVLink and GPS
/// they are mostly millimetres, and centimetres or millimetres a second.
void ask_beside_whole_degrees(const TableHead& head, const TableColumns& columns) {
  if (*unit_named("degE7", Measure::angle) != columns.x().unit) return;
  for (const auto& [quantity, unit] : {std::pair(Quantity::z, "mm"), std::pair(Quantity::vx, "cm/s"),
                                       std::pair(Quantity::vy, "cm/s"), std::pair(Quantity::vz, "cm/s")}) {
    const auto& column = columns[quantity];
    if (column && !column->has_unit)
      throw ProgramError(
          fmt::format("{}: {} does not say its unit, which beside ten-millionths of degrees is mostly {}: "
                      "say {}, or another unit",
                      head.file, column_text(head, column->place), unit,
                      columns_option(columns_text(head, columns, quantity, fmt::format(":{}", unit)))));
  }
}

/// Asks for the unit of heights of aircraft, which are in feet as transponders send them, and of speeds of
/// aircraft and ships, which are in knots.
void ask_for_units_of_craft(const TableHead& head, const TableColumns& columns) {
  if (!columns.geographic) return;
  const auto is_of_ships = [](const std::string& name) {
    return same_name(name, "mmsi") || same_name(name, "sourcemmsi") || same_name(name, "imo");
  };
  ask_beside_whole_degrees(head, columns);
  const auto craft = std::find_if(head.names.begin(), head.names.end(), [&](const std::string& name) {
    return is_of_aircraft(name) || is_of_ships(name);
  });
  if (craft == head.names.end()) return;
  const auto ask = [&](Quantity quantity, std::string_view what, std::string_view unit,
                       std::string_view other) {
    const auto& column = columns[quantity];
    if (!column || column->has_unit || (quantity == Quantity::z && is_of_ships(*craft))) return;
    throw ProgramError(
        fmt::format("{}: {} does not say its unit, which for {} (column '{}') may be {} or {}: say "
                    "{} (or :{})",
                    head.file, column_text(head, column->place), what, *craft, unit, other,
                    columns_option(columns_text(head, columns, quantity, fmt::format(":{}", unit))), other));
  };
  ask(Quantity::z, "heights of aircraft", "ft", "m");
  ask(Quantity::speed, "speeds of ships and aircraft", "kt", "m/s");
}

/// Returns the columns that are lengths or speeds.
std::vector<Quantity> measured(const TableColumns& columns) {
  std::vector<Quantity> all;
  for (std::size_t k = 0; k < quantity_count; ++k) {
    const Measure measure = measure_of(static_cast<Quantity>(k));
    if (columns.of[k] && (measure == Measure::length || measure == Measure::speed))
      all.push_back(static_cast<Quantity>(k));
  }
  return all;
}

/// Gives a unit to lengths and speeds without one. Asks where only some have one.
void understand_lengths(const TableHead& head, const ColumnHints& hints, TableColumns& columns) {
  const bool unit_is_said = !hints.unit.empty() && hints.unit != "deg";
  const double said =
      unit_is_said && hints.unit != "nm" ? unit_named(hints.unit, Measure::length).value_or(0.0) : 0.0;
  if (unit_is_said && said == 0.0)
    throw ProgramError(
        fmt::format("--unit: expected {} or deg, but got '{}'", unit_list(Measure::length), hints.unit));
  const std::vector<Quantity> lengths = measured(columns);
  std::optional<Quantity> with, without;
  for (const Quantity quantity : lengths) {
    Column& column = *columns[quantity];
    if (unit_is_said && column.has_unit && column.unit != said && measure_of(quantity) == Measure::length)
      throw ProgramError(
          fmt::format("--unit: expected none, or that of {} of {}, but got {}: {} says it of "
                      "one column",
                      column_text(head, column.place), head.file, hints.unit,
                      columns_option(fmt::format("{}={}:{}", key_of(quantity),
                                                 column_word(head, column.place), hints.unit))));
    const auto meaning = head.names.empty() ? std::nullopt : meaning_of(head.names[column.place]);
    const bool needs_unit = meaning && meaning->needs_unit;
    if (unit_is_said && !column.has_unit && measure_of(quantity) == Measure::length) {
      column.unit = said;
      column.has_unit = true;
    }
    // Where lengths are metres, speeds are metres a second.
    if (said == 1.0 && measure_of(quantity) == Measure::speed && !needs_unit) column.has_unit = true;
    if (!column.has_unit && needs_unit)
      throw ProgramError(fmt::format("{}: {} does not say its unit: say {}, or another unit ({})", head.file,
                                     column_text(head, column.place),
                                     columns_option(columns_text(head, columns, quantity, ":kt")),
                                     unit_list(Measure::speed)));
    (column.has_unit ? with : without) = (column.has_unit ? with : without).value_or(quantity);
  }
  // Heights and speeds of places on the earth are metres and seconds.
  const bool zone = hints.positions.starts_with("utm");
  columns.in_metres = columns.geographic || zone || with.has_value();
  if (columns.geographic || !with || !without) return;
  throw ProgramError(fmt::format("{}: {} does not say its unit, but {} does: say {}={}:UNIT with --columns{}",
                                 head.file, column_text(head, columns[*without]->place),
                                 column_text(head, columns[*with]->place), key_of(*without),
                                 column_word(head, columns[*without]->place),
                                 measure_of(*without) == Measure::length ? ", or --unit" : ""));
}

// Times.

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

/// Derives the unit of times from the time column's name, or from its absence.
void understand_time(const TableHead& head, ColumnUse use, TableColumns& columns) {
  auto &time = columns[Quantity::time], &frame = columns[Quantity::frame];
  const auto meaning = time && !head.names.empty() ? meaning_of(head.names[time->place]) : std::nullopt;
  const bool is_frame = frame || (meaning && meaning->quantity == Quantity::frame);
  if (is_frame) {
    if (frame) time = std::exchange(frame, std::nullopt);
    columns.time_kind = TimeKind::frames;
    // The rate of these films turns out with their last row.
    if (columns.film != Film::none && use == ColumnUse::reports) columns.time_unit_said = false;
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

void list_unused(const TableHead& head, TableColumns& columns) {
  for (std::size_t place = 0; place < head.columns(); ++place) {
    const bool is_used = std::any_of(columns.of.begin(), columns.of.end(),
                                     [&](const auto& column) { return column && column->place == place; }) ||
                         std::any_of(columns.bodies.begin(), columns.bodies.end(),
                                     [&](const auto& body) {
                                       return body.x == place || body.y == place || body.z == place;
                                     }) ||
                         columns.east_or_west == place || columns.north_or_south == place;
    if (!is_used) columns.unused.push_back(place);
  }
}

}  // namespace

TableColumns find_columns(const TableHead& head, const ColumnHints& hints, ColumnUse use) {
  const bool may_be_zone = use == ColumnUse::positions;
  if (!(hints.positions.empty() || hints.positions == "lonlat" || hints.positions == "plane" ||
        (may_be_zone && hints.positions.starts_with("utm:"))))
    throw ProgramError(fmt::format("--positions: expected lonlat{}, but got '{}'",
                                   may_be_zone ? ", plane or a UTM zone such as utm:33N" : " or plane",
                                   hints.positions));
  TableColumns columns = recognised(head, hints, use);
  keep_used(hints, use, columns);
  columns.decimal_comma = has_decimal_commas(head.separator);
  understand_places(head, hints, columns);
  require_columns(head, hints, columns);
  if (hints.columns.empty() && !columns.has_own_heights) ask_for_heights(head, columns);
  ask_for_parts_of_time(head, columns);
  understand_lengths(head, hints, columns);
  understand_time(head, use, columns);
  apply_time_hints(hints, columns);
  if (hints.dates != DateOrder::unknown) columns.dates = hints.dates;
  columns.height_advice =
      fmt::format("{} (or :m)", columns_option(columns_text(head, columns, Quantity::z, ":ft")));
  columns.time_advice = columns_option(columns_text(head, columns, {}, {}, Quantity::date));
  columns.file_advice = columns_option("id=@file," + columns_text(head, columns, {}, {}, Quantity::id));
  ask_for_units_of_craft(head, columns);
  find_hemispheres(head, columns);
  if (columns.geographic && columns.z() && !columns.z()->has_unit) columns.format += ", heights in m";
  if (!hints.where.empty())
    columns.where =
        columns.where.empty() ? hints.where : fmt::format("({}) and ({})", columns.where, hints.where);
  list_unused(head, columns);
  columns.is_ais = columns[Quantity::id] && !head.names.empty() &&
                   same_name(head.names[columns[Quantity::id]->place], "MMSI");
  if (hints.sizes) require_sizes(head, columns);
  return columns;
}

}  // namespace kinesphere::program
