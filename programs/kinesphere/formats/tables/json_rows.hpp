// Objects of JSON as rows of a table.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/json_reading.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/fields/time_text.hpp"
#include "formats/tables/column_names.hpp"
#include "formats/tables/record_cutter.hpp"
#include "formats/tables/row_table.hpp"

namespace kinesphere::program {

/// Gathers objects as rows. Objects and short lists in them become several columns, with . between the names.
class JsonRows {
 public:
  void add(ondemand::object object, std::size_t line) {
    table.begin_row(line);
    add_fields("", object, 1);
  }
  /// Adds an object, or the objects of a list. Throws MalformedRecord for other documents.
  void add_document(ondemand::document& document, std::size_t line) {
    if (document.type() != ondemand::json_type::array) {
      add(document.get_object(), line);
    } else {
      for (ondemand::value value : document.get_array()) add(value.get_object(), line);
    }
    require_end(document, "one JSON object, or one list of objects, in a line");
  }

  RowTable table{"JSON records"};

  /// Returns the name of a list of objects that was too long for columns, or of the list that it is in; empty
  /// if there was none.
  const std::string& long_list() const { return long_list_; }
  /// True if another list of objects was too long for columns.
  bool has_several_lists() const { return has_several_lists_; }
  /// Sets what the row that was begun last has of this name. `depth` is the number of objects and lists
  /// around the value.
  void add_value(const std::string& name, ondemand::value value, std::size_t depth = 1) {
    // Each level takes some of the stack.
    constexpr std::size_t deepest = 64;
    if (depth > deepest)
      throw MalformedRecord(fmt::format("expected records nested at most {} deep, but got deeper", deepest));
    switch (value.type()) {
      case ondemand::json_type::object: {
        ondemand::object object = value.get_object();
        if (const auto time = time_of_ros(object)) return set(name, *time);
        return add_fields(name + '.', object, depth + 1);
      }
      case ondemand::json_type::array: {
        // Longer lists are no positions, but a quaternion may say how a body is turned.
        const std::size_t longest = plain_name(name).ends_with("rotation") ? 4 : 3;
        ondemand::array list = value.get_array();
        if (list.count_elements() > longest) return note_list(name, list);
        std::size_t place = 0;
        for (ondemand::value element : list)
          add_value(fmt::format("{}.{}", name, place++), element, depth + 1);
        return;
      }
      case ondemand::json_type::string:
        return set(name, dated_text(name, value.get_string()));
      case ondemand::json_type::null:
        return set(name, "");
      default:
        // Numbers keep all their digits.
        return set(name, token_of(value));
    }
  }
  void set(const std::string& name, std::string_view field) {
    const std::size_t column = table.column_of(name);
    // Objects whose keys are ids or times would need a field for each of them in each row.
    constexpr std::size_t most_columns = 1000;
    if (table.names().size() > most_columns)
      throw MalformedRecord(fmt::format("expected records of at most {} names, but got more", most_columns));
    table.set(column, field);
  }

 private:
  void note_list(const std::string& name, ondemand::array& list) {
    if (has_several_lists_) return;
    for (ondemand::value element : list) {
      if (element.type() != ondemand::json_type::object) return;
      // tracks of tracks.0.points.
      std::size_t end = name.find('.');
      while (end < name.size() && !(name[end + 1] >= '0' && name[end + 1] <= '9'))
        end = name.find('.', end + 1);
      const std::string outer = name.substr(0, end);
      has_several_lists_ = !long_list_.empty() && long_list_ != outer;
      if (long_list_.empty()) long_list_ = outer;
      return;
    }
  }

  /// Returns a text of 14 digits that is a date by its name and its digits, as rxtime of AIS-catcher is, as
  /// 20240131T123015; else the text.
  static std::string dated_text(const std::string& name, std::string_view text) {
    constexpr std::size_t digits = 14, of_day = 8;
    const std::string plain = plain_name(name);
    const bool is_time = plain.find("time") != plain.npos || plain.find("date") != plain.npos;
    if (!is_time || text.size() != digits) return std::string(text);
    const std::string date = fmt::format("{}T{}", text.substr(0, of_day), text.substr(of_day));
    return parse_date_time(date) ? date : std::string(text);
  }
  /// Returns the seconds of {"secs": 7, "nsecs": 5000000} and {"sec": 7, "nanosec": 5000000}; nothing for
  /// another object, which is then at its begin again.
  static std::optional<std::string> time_of_ros(ondemand::object& object) {
    constexpr std::pair<std::string_view, std::string_view> names[] = {
        {"secs", "nsecs"}, {"sec", "nanosec"}, {"sec", "nsec"}};
    if (object.count_fields() != 2) return std::nullopt;
    for (const auto& [whole, rest] : names) {
      std::uint64_t seconds = 0, nanoseconds = 0;
      const bool are_both =
          !object[whole].get_uint64().get(seconds) && !object[rest].get_uint64().get(nanoseconds);
      object.reset();
      constexpr std::uint64_t second = 1'000'000'000;
      if (are_both && nanoseconds < second) return fmt::format("{}.{:09}", seconds, nanoseconds);
    }
    return std::nullopt;
  }
  void add_fields(const std::string& prefix, ondemand::object object, std::size_t depth) {
    for (auto field : object) {
      const std::string name = prefix + std::string(std::string_view(field.unescaped_key()));
      add_value(name, field.value(), depth);
    }
  }

  std::string long_list_;
  bool has_several_lists_ = false;
};

/// The line of a document that has been read so far.
class JsonLine {
 public:
  explicit JsonLine(ondemand::document& document) : document_(document), at_(document.current_location()) {}

  std::size_t now() {
    const char* next = nullptr;
    if (document_.current_location().get(next)) return line_;
    line_ += static_cast<std::size_t>(std::count(at_, next, '\n'));
    at_ = next;
    return line_;
  }

 private:
  ondemand::document& document_;
  const char* at_;
  std::size_t line_ = 1;
};

/// Calls `read`; throws ProgramError naming file and line of JSON that is none.
template <class Action>
void read_json(const std::string& file, const std::size_t& line, Action read) {
  try {
    read();
  } catch (const simdjson::simdjson_error& error) {
    const bool is_other_type = error.error() == simdjson::INCORRECT_TYPE;
    throw ProgramError(fmt::format("{}:{}: expected JSON records: {}", file, line,
                                   is_other_type ? "objects, or one list of them" : error.what()));
  } catch (const MalformedRecord& error) {
    throw ProgramError(fmt::format("{}:{}: {}", file, line, error.what()));
  }
}

/// Calls `take` with each outermost object of a text and its line: documents one behind the other, with
/// commas or line ends between them, or in a list. Throws ProgramError naming file and line.
template <class Take>
void for_each_object(const std::string& file, std::string_view text, Take take) {
  RecordCutter cutter(RecordCutter::Kind::documents);
  cutter.feed(text);
  simdjson::dom::parser parser;
  const auto read = [&](const Record& record) {
    if (!record.text.starts_with('{')) return;
    simdjson::dom::element object;
    if (const auto error = parser.parse(record.text.data(), record.text.size()).get(object))
      throw ProgramError(
          fmt::format("{}:{}: expected JSON: {}", file, record.line, simdjson::error_message(error)));
    take(object, record.line);
  };
  while (const auto record = cutter.next()) read(*record);
  if (const auto record = cutter.rest()) read(*record);
}

/// Returns the value of an object with this name, however its words are separated; nothing if there is none.
inline std::optional<simdjson::dom::element> member(simdjson::dom::element element, std::string_view name) {
  simdjson::dom::object object;
  if (element.get(object)) return std::nullopt;
  for (const auto& [key, value] : object)
    if (plain_name(key) == plain_name(name)) return value;
  return std::nullopt;
}

/// Returns a text or number behind names with / between them, as "vehicle/position/latitude"; empty if there
/// is none.
inline std::string text_at(std::optional<simdjson::dom::element> element, std::string_view path) {
  while (element && !path.empty()) element = member(*element, take_part(path, '/'));
  if (!element) return {};
  if (element->is_string()) return std::string(element->get_string().value_unsafe());
  if (element->is_int64()) return fmt::format("{}", element->get_int64().value_unsafe());
  return element->is_double() ? fmt::format("{}", element->get_double().value_unsafe()) : std::string();
}

}  // namespace kinesphere::program
