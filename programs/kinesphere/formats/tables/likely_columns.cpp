// Columns that may be meant, for messages that ask for --columns.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "formats/tables/column_steps.hpp"

namespace kinesphere::program {

bool is_position(Quantity quantity) {
  constexpr Quantity positions[] = {Quantity::id,   Quantity::time,      Quantity::frame,
                                    Quantity::date, Quantity::x,         Quantity::y,
                                    Quantity::z,    Quantity::longitude, Quantity::latitude};
  return std::find(std::begin(positions), std::end(positions), quantity) != std::end(positions);
}

bool is_of_no_place(std::string_view body) {
  constexpr std::string_view words[] = {"orientation", "linear",       "angular",
                                        "velocity",    "acceleration", "rotation"};
  return std::any_of(std::begin(words), std::end(words),
                     [&](std::string_view word) { return body.ends_with(word); });
}

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

}  // namespace kinesphere::program
