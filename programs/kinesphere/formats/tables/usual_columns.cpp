// Columns by their names: the usual ones, those that may be meant, and those of a body each.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/tables/column_steps.hpp"

namespace kinesphere::program {
namespace {

/// True for what says where and when a body is.
bool is_position(Quantity quantity) {
  constexpr Quantity positions[] = {Quantity::id,   Quantity::time,      Quantity::frame,
                                    Quantity::date, Quantity::x,         Quantity::y,
                                    Quantity::z,    Quantity::longitude, Quantity::latitude};
  return std::find(std::begin(positions), std::end(positions), quantity) != std::end(positions);
}

/// True for parts of the messages of robots that have axes, but are no places: pose.orientation,
/// twist.linear.
bool is_of_no_place(std::string_view body) {
  constexpr std::string_view words[] = {"orientation", "linear",       "angular",
                                        "velocity",    "acceleration", "rotation"};
  return std::any_of(std::begin(words), std::end(words),
                     [&](std::string_view word) { return body.ends_with(word); });
}

/// True for what --sizes needs of a body.
bool is_of_shape(Quantity quantity) {
  return quantity == Quantity::length || quantity == Quantity::width || quantity == Quantity::body_height ||
         quantity == Quantity::heading;
}

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
    std::erase_if(times, [&, all = times](std::size_t rest) {
      return std::any_of(all.begin(), all.end(), [&](std::size_t whole) {
        return are_parts_of_time(head.names[whole], head.names[rest]);
      });
    });
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
        if (plain_name(head_.names[place]) != "z" && hints_at(head_.names[place], NameHint::height))
          example[Quantity::z] = Column{.place = place};
    }
    // Whole seconds have their rest in another column.
    for (const std::size_t place : places(Quantity::time))
      if (!plain_name(head_.names[place]).ends_with("sec")) example[Quantity::time] = Column{.place = place};
    // Of ids that of a track, not of a sample of it.
    for (const std::size_t place : places(Quantity::id))
      if (plain_name(head_.names[place]).find("track") != std::string::npos)
        example[Quantity::id] = Column{.place = place};
    refuse(head_, "columns '{}' and '{}' may both be meant: say which, as in {}", head_.names[one],
           head_.names[other], whole_columns_option(head_, example));
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

/// True for a column that names a body: id1 or name_1 beside x1, robots.0.id beside robots.0.x.
bool is_name_of_body(const std::string& column, const std::string& body) {
  constexpr std::string_view between = " _-./";
  if (column.size() <= body.size()) return false;
  const auto is_name = [](std::string_view name) {
    const auto meaning = meaning_of(name);
    return (meaning && meaning->quantity == Quantity::id) || hints_at(name, NameHint::id);
  };
  const std::string_view begin = std::string_view(column).substr(0, body.size());
  if (same_name(begin, body)) {
    std::string_view rest = std::string_view(column).substr(body.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(between), rest.size()));
    const std::string plain = plain_name(rest);
    return is_name(rest) || rest.ends_with("Id") || rest.ends_with("_id") || plain == "trackableobject" ||
           plain == "uuid" || plain == "token";
  }
  std::string_view rest = std::string_view(column).substr(0, column.size() - body.size());
  if (!same_name(std::string_view(column).substr(rest.size()), body)) return false;
  rest = rest.substr(0, rest.find_last_not_of(between) + 1);
  return is_name(rest);
}

/// Asks about bodies that have names beside their positions, which may be others in each row.
void ask_about_names(const TableHead& head, const std::vector<TableColumns::Body>& bodies) {
  for (const TableColumns::Body& body : bodies) {
    const auto name =
        std::find_if(head.names.begin(), head.names.end(),
                     [&, &id = body.id](const auto& each) { return is_name_of_body(each, id); });
    if (name == head.names.end()) continue;
    // Of a list in JSON.
    const std::string list = body.id.substr(0, body.id.rfind('.'));
    const bool is_list =
        list.size() < body.id.size() && list.find_first_of("0123456789.") == std::string::npos;
    refuse(head,
           "'{}' may name another body in each row than '{}' and '{}' of the row before: write a row for "
           "each body{}, or say --format table if it is one and the same in all rows",
           *name, head.names[body.x], head.names[body.y],
           is_list ? fmt::format(", with jq -c '(arrays[], objects) | . + .{0}[] | del(.{0})'", list) : "");
  }
}

/// True for a name that ends as an id does: MetaData.MMSI.
bool has_likely_id(const TableHead& head) {
  return std::any_of(head.names.begin(), head.names.end(), [](const std::string& name) {
    const auto meaning = meaning_of_ending(name);
    return meaning && meaning->quantity == Quantity::id && !hints_at(name, NameHint::scene);
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
      refuse(head, "expected one unit of {}, but {} and {} have different ones", key_of(quantity),
             column_text(head, column.place), column_text(head, place));
  }
}

}  // namespace

void add_likely_columns(const TableHead& head, TableColumns& columns) {
  std::array<std::vector<std::size_t>, quantity_count> likely;
  for (std::size_t place = 0; place < head.names.size(); ++place) {
    if (is_of_no_place(axis_and_body(head.names[place]).body)) continue;
    auto meaning = meaning_of_ending(head.names[place]);
    for (const auto& [hint, quantity] :
         {std::pair(NameHint::longitude, Quantity::longitude),
          std::pair(NameHint::latitude, Quantity::latitude), std::pair(NameHint::id, Quantity::id)})
      if (!meaning && hints_at(head.names[place], hint)) meaning = ColumnMeaning{quantity, ""};
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

bool is_used(Quantity quantity, const ColumnHints& hints, ColumnUse use) {
  if (is_of_shape(quantity)) return hints.sizes;
  if (hints.sizes && quantity == Quantity::course) return true;
  return use == ColumnUse::reports || is_position(quantity);
}

TableColumns usual_columns(const TableHead& head, const ColumnHints& hints, ColumnUse use) {
  return UsualColumns(head, hints, use).found();
}

void find_pairs(const TableHead& head, const ColumnHints& hints, TableColumns& columns) {
  if (columns[Quantity::id] || columns[Quantity::x] || columns[Quantity::longitude]) return;
  const auto plane = bodies_in_names(head, Quantity::x, Quantity::y);
  const auto earth = bodies_in_names(head, Quantity::longitude, Quantity::latitude);
  const bool is_earth = plane.empty() || (!earth.empty() && hints.positions == "lonlat");
  if (!plane.empty() && !earth.empty() && hints.positions.empty())
    refuse(head, "columns '{}' and '{}' may both be meant: say --positions plane or lonlat",
           head.names[plane[0].x], head.names[earth[0].x]);
  const std::vector<TableColumns::Body>& bodies = is_earth ? earth : plane;
  const bool numbered = are_numbered(bodies);
  if (bodies.empty() || (!numbered && (bodies.size() == 1 || has_likely_id(head)))) return;
  if (hints.format != "table") ask_about_names(head, bodies);
  const auto heights =
      std::count_if(bodies.begin(), bodies.end(), [](const auto& each) { return each.z.has_value(); });
  if (heights != 0 && heights != std::ssize(bodies))
    refuse(head, "expected a height for each pair of columns or for none; it has {}", head.text());
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
    refuse(head,
           "{}, {}, {} and {} may be two bodies or {}: say --format table if each such pair is a body, else "
           "say the columns with --columns",
           head.names[bodies[0].x], head.names[bodies[0].y], head.names[bodies[1].x], head.names[bodies[1].y],
           numbered ? "the corners of boxes" : "parts of one");
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

}  // namespace kinesphere::program
