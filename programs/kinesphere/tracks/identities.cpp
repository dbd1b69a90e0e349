// Which ids are one body, and which are none of interest: --same and --ignore.
#include "tracks/identities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/input_file.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

/// Behind the first field of a line.
constexpr std::string_view separators = ",;\t";

/// Calls f with each text and where it stands: those of the command line, and the lines of files.
template <class F>
void for_each_text(const std::vector<std::string>& texts, std::string_view option, F f) {
  for (const std::string& text : texts) {
    if (!text.starts_with('@')) {
      f(text, std::string(option), true);
      continue;
    }
    const std::string file = text.substr(1), content = read_input(file);
    std::size_t number = 0;
    for (std::size_t begin = content.starts_with("\xEF\xBB\xBF") ? 3 : 0; begin < content.size();) {
      const std::size_t end = std::min(content.find('\n', begin), content.size());
      const std::string line(trimmed(std::string_view(content).substr(begin, end - begin)));
      begin = end + 1;
      ++number;
      if (!line.empty() && !line.starts_with('#')) f(line, fmt::format("{}:{}", file, number), false);
    }
  }
}

}  // namespace

Identities::Identities(const IdentityChoice& choice) {
  for_each_text(choice.ignore, "--ignore", [this](const auto& text, const auto& where, bool is_said) {
    add_ignored(is_said ? text : std::string(trimmed(text.substr(0, text.find_first_of(separators)))), where,
                is_said);
  });
  for_each_text(choice.same, "--same", [this](const auto& text, const auto& where, bool is_said) {
    add_same(text, where, is_said);
  });
  join_chains();
}

void Identities::add_ignored(const std::string& id, const std::string& where, bool is_said) {
  if (id.empty()) throw ProgramError(fmt::format("{}: expected an id, but got nothing", where));
  ignored_.insert(id);
  if (is_said) awaited_.emplace(id, where);
}

void Identities::add_same(const std::string& text, const std::string& where, bool is_said) {
  const bool is_equation = is_said || text.find('=') != std::string::npos;
  const std::size_t sign = is_equation ? text.find('=') : text.find_first_of(separators);
  const bool is_pair = sign != std::string::npos && text.find('=', sign + 1) == std::string::npos;
  const std::string from(is_pair ? trimmed(std::string_view(text).substr(0, sign)) : ""),
      to(is_pair ? trimmed(std::string_view(text).substr(sign + 1)) : "");
  if (from.empty() || to.empty() || from == to)
    throw ProgramError(fmt::format("{}: expected two ids as in A=B, but got '{}'", where, text));
  for (const std::string& id : {from, to})
    if (ignored_.contains(id))
      throw ProgramError(fmt::format("{}: expected an id that is not ignored, but got '{}'", where, id));
  const auto [place, is_new] = same_.emplace(from, to);
  if (!is_new && place->second != to)
    throw ProgramError(fmt::format("{}: expected '{}' to be the same as one id, but it is '{}' and '{}'",
                                   where, from, place->second, to));
  if (is_said) awaited_.emplace(from, where);
}

void Identities::join_chains() {
  for (auto& [from, to] : same_) {
    std::size_t steps = 0;
    for (auto next = same_.find(to); next != same_.end(); next = same_.find(to)) {
      to = next->second;
      if (to == from || ++steps > same_.size())
        throw ProgramError(fmt::format("--same: expected no circle, but '{}' is the same as itself", from));
    }
  }
}

std::optional<std::string_view> Identities::name_of(std::string_view id) {
  if (same_.empty() && ignored_.empty()) return id;
  if (const auto awaited = awaited_.find(id); awaited != awaited_.end()) awaited_.erase(awaited);
  if (ignored_.contains(id)) return std::nullopt;
  const auto found = same_.find(id);
  return found == same_.end() ? id : found->second;
}

void Identities::ask_about_unknown(const std::string& known) const {
  if (awaited_.empty()) return;
  const auto& [id, where] = *awaited_.begin();
  throw ProgramError(
      fmt::format("{}: expected an id of the recording, such as '{}', but got '{}'", where, known, id));
}

}  // namespace kinesphere::program
