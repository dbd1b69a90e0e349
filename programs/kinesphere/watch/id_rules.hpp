// Ids by the user's word: --same A=B, --ignore ID, and files with an id in each line.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace kinesphere::program {

/// Returns the text in lower case: ids are compared so.
std::string in_lower_case(std::string_view text);
/// Returns the lines of a file without the blanks around them; blank lines and those that begin with # have
/// none. Throws ProgramError naming the option or the file.
std::vector<std::string> lines_of_list(const std::string& path, std::string_view option);
/// Returns the first field of a line, without quotes: what stands before a comma, semicolon or tab.
std::string_view first_field(std::string_view line);

class IdRules {
 public:
  IdRules() = default;
  /// Parses each "A=B" or "@FILE", which has A=B or A,B in each line, and each id or "@FILE", with an id in
  /// each line. Throws ProgramError naming --same, --ignore or the file.
  IdRules(const std::vector<std::string>& same, const std::vector<std::string>& ignored);

  bool is_empty() const { return same_.empty() && ignored_.empty(); }
  bool ignores(std::string_view id) const { return ignored_.contains(in_lower_case(id)); }
  /// Returns the id of the body that this id belongs to; `id` itself where nothing is said. The text is valid
  /// as long as both.
  std::string_view body_of(std::string_view id) const;

 private:
  void add_same(std::string_view body, std::string_view other, const std::string& text);

  std::unordered_map<std::string, std::string> same_;  ///< ids of bodies by other ids in lower case
  std::unordered_set<std::string> ignored_;            ///< in lower case
};

}  // namespace kinesphere::program
