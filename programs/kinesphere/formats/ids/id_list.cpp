#include "formats/ids/id_list.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/ascii_text.hpp"
#include "base/input_file.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), lower_case);
  return lower;
}

std::string_view without_quotes(std::string_view text) {
  text = trimmed(text);
  const bool is_quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

std::string_view first_of_line(std::string_view line) {
  return without_quotes(line.substr(0, line.find_first_of(",;\t")));
}

std::vector<ListedLine> lines_of_list(const std::string& path, std::string_view option) {
  const std::string content = read_input(path);
  std::string_view rest = content;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  std::vector<ListedLine> lines;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const std::string_view text = trimmed(line);
    if (!text.empty() && !text.starts_with('#'))
      lines.push_back({std::string(text), fmt::format("{}:{}", path, number)});
  }
  if (lines.empty()) throw ProgramError(fmt::format("{}: expected ids in {}, but it has none", option, path));
  return lines;
}

}  // namespace kinesphere::program
