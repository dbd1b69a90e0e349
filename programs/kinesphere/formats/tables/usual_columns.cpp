// Columns by their usual names.
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "base/program_error.hpp"
#include "formats/tables/column_steps.hpp"

namespace kinesphere::program {
namespace {

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

}  // namespace

bool is_used(Quantity quantity, const ColumnHints& hints, ColumnUse use) {
  if (is_of_shape(quantity)) return hints.sizes;
  if (hints.sizes && quantity == Quantity::course) return true;
  return use == ColumnUse::reports || is_position(quantity);
}

TableColumns usual_columns(const TableHead& head, const ColumnHints& hints, ColumnUse use) {
  return UsualColumns(head, hints, use).found();
}

}  // namespace kinesphere::program
