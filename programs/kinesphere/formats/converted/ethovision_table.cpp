// Track files of EthoVision: lines about the trial, of which the first says how many, then names and units of
// columns, and rows of one subject.
#include <fmt/format.h>

#include <algorithm>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/converted/converted_table.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/tables/row_reader.hpp"

namespace kinesphere::program {
namespace {

constexpr std::string_view ethovision_begin = "Number of header lines:";

/// Returns the field without its quotes.
std::string_view unquoted(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  return trimmed(field);
}

}  // namespace

bool is_ethovision(std::string_view text) {
  if (text.starts_with('"')) text.remove_prefix(1);
  return text.starts_with(ethovision_begin);
}

std::optional<ConvertedTable> convert_ethovision(std::string_view text, const std::string& file) {
  if (!is_ethovision(text)) return std::nullopt;
  LineCutter lines(text);
  const std::string_view first = lines.next().value_or("");
  const std::size_t behind_name = std::min(first.find_first_of(";,\t"), first.size() - 1);
  const char separator = first[behind_name];
  const auto count = count_in(unquoted(first.substr(behind_name + 1)));
  if (!count || *count < 3)
    throw ProgramError(fmt::format("{}:1: expected the number of header lines, 3 or more, but got {}", file,
                                   shown_field(first)));
  ConvertedTable table{.format = "EthoVision", .text = "\n"};
  std::string subject;
  while (lines.line() < *count - 2 && lines.next()) {
    const auto fields = fields_of(lines.whole(), separator);
    if (fields.size() > 1 && same_name(unquoted(fields[0]), "Subject name")) subject = unquoted(fields[1]);
    table.text += '\n';
  }
  if (subject.empty()) subject = id_of_file(file);
  while (const auto line = lines.next()) {
    const bool is_head = lines.line() <= *count;
    if (!line->empty())
      table.text += quoted_field(!is_head ? subject : lines.line() < *count ? "id" : "") + separator;
    table.text += std::string(*line) + '\n';
  }
  return table;
}

}  // namespace kinesphere::program
