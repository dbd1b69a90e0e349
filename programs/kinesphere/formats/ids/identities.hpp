// Which ids are one body, and which are none of interest: --same and --ignore, and lists of ids in files.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace kinesphere::program {

/// Returns the text in lower case: ids that the user names are compared so.
std::string in_lower_case(std::string_view text);
/// Returns the text without blanks around it, and without quotes around what is left.
std::string_view without_quotes(std::string_view text);
/// Returns what stands before a comma, semicolon or tab, without quotes.
std::string_view first_of_line(std::string_view line);

/// A line of a file, without the blanks around it.
struct ListedLine {
  std::string text;
  std::string where;  ///< "FILE:LINE"
};
/// Returns the lines of a file but those that are blank or begin with #. Throws ProgramError naming the file,
/// and the option if there are none.
std::vector<ListedLine> lines_of_list(const std::string& path, std::string_view option);

/// The texts of the options. @FILE stands for the lines of a file, of which those that begin with # do not
/// count.
struct IdentityChoice {
  std::vector<std::string> same;    ///< each "A=B", or @FILE of such lines or "A,B": what A reports is of B
  std::vector<std::string> ignore;  ///< each an id, or @FILE with an id at the begin of each line
};

/// Upper and lower case are the same.
class Identities {
 public:
  Identities() = default;
  /// Throws ProgramError naming the option: for a text of another form, an id that is the same as two others,
  /// a circle of ids, an id that is ignored and the same as another, and a file that cannot be read.
  explicit Identities(const IdentityChoice& choice);

  /// Returns true if nothing is said of any id.
  bool is_empty() const { return same_.empty() && ignored_.empty(); }
  /// Returns the id under which reports of this id count, nothing if they do not. The result is valid as long
  /// as both.
  std::optional<std::string_view> name_of(std::string_view id) const;
  /// An id has come.
  void note(std::string_view id);
  /// Throws ProgramError if an id that the command line itself names has not come. `known` is one that has.
  void ask_about_unknown(const std::string& known) const;

 private:
  void add_same(const std::string& text, const std::string& where, bool is_said);
  void add_ignored(const std::string& id, const std::string& where, bool is_said);
  void join_chains();

  // By id in lower case.
  std::map<std::string, std::string, std::less<>> same_;
  std::set<std::string, std::less<>> ignored_;
  /// Ids of the command line that have not come, with their options.
  struct Awaited {
    std::string id, option;
  };
  std::map<std::string, Awaited, std::less<>> awaited_;
};

}  // namespace kinesphere::program
