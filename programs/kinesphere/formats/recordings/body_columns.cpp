// Tables with columns for each body, under headers of several lines: motion capture and trackers of parts.
#include "formats/recordings/body_columns.hpp"

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
      : layout_(layout), lines_(lines), file_(file), table_(layout.format) {}

  RowTable read() {
    begin();
    for (bool is_behind_blank = false; lines_.next();) {
      const std::string_view line = lines_.whole();
      const bool is_blank = line.find_first_not_of('\r') == std::string_view::npos;
      const auto fields = fields_of(line, layout_.separator);
      // Another section of the file.
      if (is_behind_blank && frames_ > 0 && !is_blank && !parse_number(fields[0])) break;
      if (!is_blank) add_rows(fields);
      is_behind_blank = is_blank;
    }
    return std::move(table_);
  }

 private:
  /// Makes the columns.
  void begin() {
    if (layout_.frame_rate) table_.comments.push_back(fmt::format("framerate: {} fps", *layout_.frame_rate));
    table_.column_of("id");
    table_.column_of(layout_.time ? "time" : "frame");
    for (const std::string& name : layout_.names) {
      const bool is_length = name.size() == 1;
      table_.column_of(name + (is_length && !layout_.unit.empty() ? "_" + layout_.unit : ""));
    }
  }

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
      table_.add_row(lines_.line(), body.id, time);
      for (std::size_t k = 0; k < body.columns.size() && !is_zero; ++k)
        table_.set(columns_before + k, fields[body.columns[k]]);
    }
  }

  std::size_t needed() const {
    std::size_t last = std::max(layout_.time.value_or(0), layout_.frame.value_or(0));
    for (const BodyColumns& body : layout_.bodies)
      last = std::max(last, *std::ranges::max_element(body.columns));
    return last + 1;
  }

  static constexpr std::size_t columns_before = 2;  ///< of the id and the time
  const BodyLayout& layout_;
  LineCutter lines_;
  const std::string& file_;
  RowTable table_;
  std::size_t frames_ = 0;
};

}  // namespace

RowTable read_body_rows(const BodyLayout& layout, LineCutter lines, const std::string& file) {
  if (layout.bodies.empty())
    throw ProgramError(fmt::format("{}:{}: expected columns of bodies in the header of {}, but found none",
                                   file, lines.line(), layout.format));
  return BodyRows(layout, lines, file).read();
}

}  // namespace kinesphere::program
