// Tables with columns for each body, under headers of several lines: motion capture and trackers of parts.
#include "formats/converted/body_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"

namespace kinesphere::program {
namespace {

class BodyRows {
 public:
  BodyRows(const BodyLayout& layout, LineCutter lines, const std::string& file)
      : layout_(layout), lines_(lines), file_(file) {}

  ConvertedTable read() {
    result_.format = layout_.format;
    result_.rows_per_line = layout_.bodies.size();
    begin();
    for (std::size_t line = 0; line < lines_.line(); ++line) pass_line();
    for (bool is_behind_blank = false; lines_.next();) {
      const std::string_view line = lines_.whole();
      const bool is_blank = line.find_first_not_of('\r') == std::string_view::npos;
      const auto fields = fields_of(line, layout_.separator);
      // Another section of the file.
      if (is_behind_blank && frames_ > 0 && !is_blank && !parse_number(fields[0])) break;
      if (is_blank)
        pass_line();
      else
        add_rows(fields);
      is_behind_blank = is_blank;
    }
    return std::move(result_);
  }

 private:
  /// Writes the header, whose lines are not in the file.
  void begin() {
    if (layout_.frame_rate) result_.text = fmt::format("# framerate: {} fps\n", *layout_.frame_rate);
    result_.text += layout_.time ? "id,time" : "id,frame";
    for (const std::string& name : layout_.names) {
      const bool is_length = name.size() == 1;
      result_.text += "," + name + (is_length && !layout_.unit.empty() ? "_" + layout_.unit : "");
    }
    result_.text += '\n';
    result_.lines_before = static_cast<std::size_t>(std::ranges::count(result_.text, '\n'));
  }
  void pass_line() { result_.text.append(result_.rows_per_line, '\n'); }

  [[noreturn]] void fail(std::string_view what, std::size_t column, std::string_view got) const {
    throw ProgramError(fmt::format("{}:{}: expected a number as {} (column {}), but got {}", file_,
                                   lines_.line(), what, column + 1, shown_field(got)));
  }

  void add_rows(const std::vector<std::string_view>& fields) {
    if (fields.size() < needed())
      throw ProgramError(fmt::format("{}:{}: expected {} columns, but got {}", file_, lines_.line(), needed(),
                                     fields.size()));
    std::string time = fmt::format("{}", frames_++);
    if (const auto& column = layout_.time ? layout_.time : layout_.frame) {
      if (!parse_number(fields[*column])) fail(layout_.time ? "time" : "frame", *column, fields[*column]);
      time = fields[*column];
    }
    for (const BodyColumns& body : layout_.bodies) {
      bool is_zero = layout_.zero_is_missing;
      for (std::size_t k = 0; k < body.columns.size(); ++k) {
        const std::string_view field = fields[body.columns[k]];
        const auto number = parse_number(field);
        if (!number && !is_missing(field))
          fail(fmt::format("{} of {}", layout_.names[k], body.id), body.columns[k], field);
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
    std::size_t last = std::max(layout_.time.value_or(0), layout_.frame.value_or(0));
    for (const BodyColumns& body : layout_.bodies)
      last = std::max(last, *std::ranges::max_element(body.columns));
    return last + 1;
  }

  const BodyLayout& layout_;
  LineCutter lines_;
  const std::string& file_;
  ConvertedTable result_;
  std::size_t frames_ = 0;
};

}  // namespace

ConvertedTable read_body_rows(const BodyLayout& layout, LineCutter lines, const std::string& file) {
  if (layout.bodies.empty())
    throw ProgramError(fmt::format("{}:{}: expected columns of bodies in the header of {}, but found none",
                                   file, lines.line(), layout.format));
  return BodyRows(layout, lines, file).read();
}

}  // namespace kinesphere::program
