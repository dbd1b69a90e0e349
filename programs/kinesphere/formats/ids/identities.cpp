#include "formats/ids/identities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/input_file.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"

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
  LineCutter cutter(rest);
  while (const auto text = cutter.next())
    if (!text->empty() && !text->starts_with('#'))
      lines.push_back({std::string(*text), fmt::format("{}:{}", path, cutter.line())});
  if (lines.empty()) throw ProgramError(fmt::format("{}: expected ids in {}, but it has none", option, path));
  return lines;
}

namespace {

/// Calls f with each text and where it stands: those of the command line, and the lines of files.
template <class F>
void for_each_text(const std::vector<std::string>& texts, std::string_view option, F f) {
  for (const std::string& text : texts) {
    if (text.starts_with('@')) {
      for (const auto& [line, where] : lines_of_list(text.substr(1), option)) f(line, where, false);
    } else {
      f(text, std::string(option), true);
    }
  }
}

}  // namespace

Identities::Identities(const IdentityChoice& choice) {
  for_each_text(choice.ignore, "--ignore", [this](const auto& text, const auto& where, bool is_said) {
    add_ignored(is_said ? text : std::string(first_of_line(text)), where, is_said);
  });
  for_each_text(choice.same, "--same", [this](const auto& text, const auto& where, bool is_said) {
    add_same(text, where, is_said);
  });
  join_chains();
}

void Identities::add_ignored(const std::string& id, const std::string& where, bool is_said) {
  if (id.empty()) throw ProgramError(fmt::format("{}: expected an id, but got nothing", where));
  ignored_.insert(in_lower_case(id));
  if (is_said) awaited_.emplace(in_lower_case(id), Awaited{id, where});
}

void Identities::add_same(const std::string& text, const std::string& where, bool is_said) {
  const bool is_equation = is_said || text.find('=') != std::string::npos;
  const std::size_t sign = is_equation ? text.find('=') : text.find_first_of(",;\t");
  const bool is_pair = sign != std::string::npos && text.find('=', sign + 1) == std::string::npos;
  const std::string from(is_pair ? without_quotes(std::string_view(text).substr(0, sign)) : ""),
      to(is_pair ? without_quotes(std::string_view(text).substr(sign + 1)) : "");
  if (from.empty() || to.empty() || in_lower_case(from) == in_lower_case(to))
    throw ProgramError(fmt::format("{}: expected two ids as in A=B, but got '{}'", where, text));
  for (const std::string& id : {from, to})
    if (ignored_.contains(in_lower_case(id)))
      throw ProgramError(fmt::format("{}: expected an id that is not ignored, but got '{}'", where, id));
  const auto [place, is_new] = same_.emplace(in_lower_case(from), to);
  if (!is_new && in_lower_case(place->second) != in_lower_case(to))
    throw ProgramError(fmt::format("{}: expected '{}' to be the same as one id, but it is '{}' and '{}'",
                                   where, from, place->second, to));
  if (is_said) awaited_.emplace(in_lower_case(from), Awaited{from, where});
}

void Identities::join_chains() {
  for (auto& [from, to] : same_) {
    std::size_t steps = 0;
    for (auto next = same_.find(in_lower_case(to)); next != same_.end();
         next = same_.find(in_lower_case(to))) {
      to = next->second;
      if (in_lower_case(to) == from || ++steps > same_.size())
        throw ProgramError(fmt::format("--same: expected no circle, but '{}' is the same as itself", from));
    }
  }
  // However a body's own id is written, it is the one that the user names.
  for (const auto& [from, to] : std::map(same_)) same_.emplace(in_lower_case(to), to);
}

std::optional<std::string_view> Identities::name_of(std::string_view id) const {
  if (is_empty()) return id;
  const std::string lower = in_lower_case(id);
  if (ignored_.contains(lower)) return std::nullopt;
  const auto found = same_.find(lower);
  return found == same_.end() ? id : found->second;
}

void Identities::note(std::string_view id) {
  if (!awaited_.empty()) awaited_.erase(in_lower_case(id));
}

void Identities::ask_about_unknown(const std::string& known) const {
  if (awaited_.empty()) return;
  const auto& [id, option] = awaited_.begin()->second;
  throw ProgramError(
      fmt::format("{}: expected an id of the recording, such as '{}', but got '{}'", option, known, id));
}

}  // namespace kinesphere::program
