// Tables with columns for each body, under headers of several lines: motion capture and trackers of parts.
#include "formats/body_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ascii_text.hpp"
#include "formats/field_text.hpp"
#include "number_text.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

class BodyRows {
 public:
  BodyRows(const BodyTable& table, LineCutter lines, const std::string& file)
      : table_(table), lines_(lines), file_(file) {}

  ConvertedTable read() {
    result_.format = table_.format;
    result_.rows_per_line = table_.bodies.size();
    begin();
    for (std::size_t line = 0; line < lines_.line(); ++line) pass_line();
    while (const auto line = lines_.next()) {
      if (line->empty() && frames_ > 0) break;
      if (line->empty())
        pass_line();
      else
        add_rows(fields_of(lines_.whole(), table_.separator));
    }
    return std::move(result_);
  }

 private:
  /// Writes the header, whose lines are not in the file.
  void begin() {
    if (table_.frame_rate) result_.text = fmt::format("# framerate: {} fps\n", *table_.frame_rate);
    result_.text += table_.time ? "id,time" : "id,frame";
    for (const std::string& name : table_.names) {
      const bool is_length = name.size() == 1;
      result_.text += "," + name + (is_length && !table_.unit.empty() ? "_" + table_.unit : "");
    }
    result_.text += '\n';
    result_.lines_before = static_cast<std::size_t>(std::ranges::count(result_.text, '\n'));
  }
  void pass_line() { result_.text.append(result_.rows_per_line, '\n'); }

  [[noreturn]] void fail(std::string_view what, std::size_t column, std::string_view got) const {
    throw ProgramError(fmt::format("{}:{}: expected a number as {} (column {}), but got {}", file_,
                                   lines_.line(), what, column + 1, shown_field(got)));
  }

  void add_rows(std::vector<std::string_view> fields) {
    if (fields.size() < needed())
      throw ProgramError(fmt::format("{}:{}: expected {} columns, but got {}", file_, lines_.line(), needed(),
                                     fields.size()));
    std::string time = fmt::format("{}", frames_++);
    if (const auto& column = table_.time ? table_.time : table_.frame) {
      if (!parse_number(fields[*column])) fail(table_.time ? "time" : "frame", *column, fields[*column]);
      time = fields[*column];
    }
    for (const BodyColumns& body : table_.bodies) {
      bool is_zero = table_.zero_is_missing;
      for (std::size_t k = 0; k < body.columns.size(); ++k) {
        const std::string_view field = fields[body.columns[k]];
        const auto number = parse_number(field);
        if (!number && !is_missing(field))
          fail(fmt::format("{} of {}", table_.names[k], body.id), body.columns[k], field);
        is_zero = is_zero && number == 0.0;
      }
      result_.text += fmt::format("{},{}", quoted_field(body.id), time);
      for (const std::size_t column : body.columns) {
        result_.text += ',';
        if (!is_zero) result_.text += fields[column];
      }
      result_.text += '\n';
    }
  }

  std::size_t needed() const {
    std::size_t last = std::max(table_.time.value_or(0), table_.frame.value_or(0));
    for (const BodyColumns& body : table_.bodies)
      last = std::max(last, *std::ranges::max_element(body.columns));
    return last + 1;
  }

  const BodyTable& table_;
  LineCutter lines_;
  const std::string& file_;
  ConvertedTable result_;
  std::size_t frames_ = 0;
};

}  // namespace

ConvertedTable read_body_rows(const BodyTable& table, LineCutter lines, const std::string& file) {
  if (table.bodies.empty())
    throw ProgramError(fmt::format("{}:{}: expected columns of bodies in the header of {}, but found none",
                                   file, lines.line(), table.format));
  return BodyRows(table, lines, file).read();
}

}  // namespace kinesphere::program
