#include "watch/id_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/ascii_text.hpp"
#include "base/input_file.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

std::string_view without_quotes(std::string_view text) {
  text = trimmed(text);
  const bool is_quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

}  // namespace

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), lower_case);
  return lower;
}

std::vector<std::string> lines_of_list(const std::string& path, std::string_view option) {
  const std::string text = read_input(path);
  std::vector<std::string> lines;
  for (std::string_view rest = text; !rest.empty();) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    line = trimmed(line);
    if (!line.empty() && !line.starts_with('#')) lines.emplace_back(line);
  }
  if (lines.empty()) throw ProgramError(fmt::format("{}: expected ids in {}, but it has none", option, path));
  return lines;
}

std::string_view first_field(std::string_view line) {
  return without_quotes(line.substr(0, line.find_first_of(",;\t")));
}

IdRules::IdRules(const std::vector<std::string>& same, const std::vector<std::string>& ignored) {
  const auto add = [this](const std::string& text, std::string_view separators) {
    const std::size_t at = std::min(text.find_first_of(separators), text.size());
    add_same(without_quotes(std::string_view(text).substr(0, at)),
             without_quotes(std::string_view(text).substr(std::min(at + 1, text.size()))), text);
  };
  for (const std::string& text : same) {
    if (!text.starts_with('@')) {
      add(text, "=");
      continue;
    }
    for (const std::string& line : lines_of_list(text.substr(1), "--same")) add(line, "=,;\t");
  }
  // A body may be another id of a further one.
  for (auto& [other, body] : same_)
    for (std::size_t k = 0; k <= same_.size(); ++k) {
      const auto further = same_.find(in_lower_case(body));
      if (further == same_.end()) break;
      if (k == same_.size())
        throw ProgramError(
            fmt::format("--same: expected one id that the others belong to, but {} belongs to itself", body));
      body = further->second;
    }
  for (const std::string& text : ignored) {
    if (text.empty() || text == "@") throw ProgramError("--ignore: expected an id or @FILE, but got ''");
    if (!text.starts_with('@')) {
      ignored_.insert(in_lower_case(text));
      continue;
    }
    for (const std::string& line : lines_of_list(text.substr(1), "--ignore"))
      ignored_.insert(in_lower_case(first_field(line)));
  }
}

void IdRules::add_same(std::string_view body, std::string_view other, const std::string& text) {
  if (body.empty() || other.empty() || in_lower_case(body) == in_lower_case(other))
    throw ProgramError(
        fmt::format("--same: expected two ids of one body as A=B, or @FILE, but got '{}'", text));
  const auto [at, is_new] = same_.emplace(in_lower_case(other), body);
  if (!is_new && in_lower_case(at->second) != in_lower_case(body))
    throw ProgramError(
        fmt::format("--same: expected one body for {}, but got {} and {}", other, at->second, body));
}

std::string_view IdRules::body_of(std::string_view id) const {
  const auto at = same_.find(in_lower_case(id));
  return at == same_.end() ? id : std::string_view(at->second);
}

}  // namespace kinesphere::program
