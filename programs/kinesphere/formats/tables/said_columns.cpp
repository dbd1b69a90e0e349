// Columns as the option --columns takes them, and messages say them; those of presets are said likewise.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/fields/units.hpp"
#include "formats/tables/column_steps.hpp"

namespace kinesphere::program {

std::optional<std::size_t> column_named(const TableHead& head, std::string_view name) {
  const auto& names = head.names;
  for (const bool exact : {true, false}) {
    const auto matches = [&](const std::string& each) {
      return exact ? each == name : same_name(each, name);
    };
    const auto found = std::find_if(names.begin(), names.end(), matches);
    if (found == names.end()) continue;
    if (std::count_if(names.begin(), names.end(), matches) > 1)
      refuse(head, "expected one column '{}', but it has {}", name, head.text());
    return static_cast<std::size_t>(found - names.begin());
  }
  return std::nullopt;
}

std::optional<std::size_t> place_of(const TableHead& head, std::string_view name) {
  if (const auto place = column_named(head, name)) return place;
  const double number = parse_number(name).value_or(0.0);
  for (std::size_t place = 0; place < head.columns(); ++place)
    if (number == static_cast<double>(place + 1)) return place;
  return std::nullopt;
}

std::string column_text(const TableHead& head, std::size_t place) {
  return head.names.empty() ? fmt::format("column {}", place + 1)
                            : fmt::format("column '{}'", head.names[place]);
}

std::string column_word(const TableHead& head, std::size_t place) {
  const bool by_name = !head.names.empty() && head.names[place].find_first_of(",\"'") == std::string::npos &&
                       std::count(head.names.begin(), head.names.end(), head.names[place]) == 1;
  return by_name ? head.names[place] : fmt::format("{}", place + 1);
}

std::string columns_text(const TableHead& head, const TableColumns& columns, std::optional<Quantity> quantity,
                         std::string_view unit, std::optional<Quantity> without) {
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

std::string columns_option(std::string_view list) { return "--columns " + shell_word(list); }

namespace {

/// Reads the entries KEY=COLUMN[:UNIT] of a list.
class SaidColumns {
 public:
  SaidColumns(const TableHead& head, std::string_view list, const Preset* preset)
      : head_(head), list_(list), preset_(preset) {}

  TableColumns read() {
    for (std::string_view rest = list_; !rest.empty();) read_entry(take_part(rest, ','));
    if (preset_ == nullptr) require_different_coordinates();
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

  /// Refuses one column for two coordinates, a slip that would be a recording on a line.
  void require_different_coordinates() const {
    constexpr Quantity coordinates[] = {Quantity::x, Quantity::y, Quantity::z, Quantity::longitude,
                                        Quantity::latitude};
    for (const Quantity& one : coordinates)
      for (const Quantity* other = &one + 1; other != std::end(coordinates); ++other)
        if (columns_[one] && columns_[*other] && columns_[one]->place == columns_[*other]->place)
          throw ProgramError(fmt::format("--columns: expected two columns for {} and {}, but both are {}",
                                         key_of(one), key_of(*other),
                                         column_word(head_, columns_[one]->place)));
  }

  std::optional<std::size_t> place_of_any(std::string_view names) const {
    if (preset_ == nullptr) return place_of(head_, names);
    while (!names.empty()) {
      const std::string_view name = take_part(names, '|');
      if (const auto place = preset_column(head_, name)) return place;
      if (const auto place = place_of(head_, name)) return place;
    }
    return std::nullopt;
  }

  [[noreturn]] void fail(std::string_view key, std::string_view name) const {
    if (preset_ != nullptr)
      refuse(head_, "expected {} with --format {}, but it has {}",
             preset_->header.empty() ? fmt::format("{} columns or more", preset_->rules.least_columns)
                                     : fmt::format("the columns {}", preset_->header),
             preset_->name, head_.text());
    throw ProgramError(fmt::format(
        "--columns: expected '{}' to be a column's name or number from 1 to {}, but got '{}': {} has {}", key,
        head_.columns(), name, head_.file, head_.text()));
  }

  const TableHead& head_;
  std::string_view list_;
  const Preset* preset_;
  TableColumns columns_;
};

}  // namespace

TableColumns said_columns(const TableHead& head, std::string_view list, const Preset* preset) {
  return SaidColumns(head, list, preset).read();
}

TableColumns preset_columns(const TableHead& head, const Preset& preset) {
  if (head.columns() < preset.rules.least_columns)
    refuse(head, "expected {} columns or more with --format {}, but it has {}", preset.rules.least_columns,
           preset.name, head.text());
  TableColumns columns = said_columns(head, preset.columns, &preset);
  columns.format = preset.title;
  columns.has_own_heights = preset.rules.has_own_heights;
  columns.has_own_origin = preset.rules.has_own_origin;
  columns.film = preset.rules.film;
  columns.place = preset.rules.place;
  columns.heading_is_from_x = columns[Quantity::heading].has_value();
  columns.dates = preset.rules.dates;
  columns.where = preset.rules.where;
  if (preset.rules.frame_rate > 0.0) {
    columns.time_unit.rate = preset.rules.frame_rate;
    columns.time_unit_said = true;
  }
  return columns;
}

}  // namespace kinesphere::program
