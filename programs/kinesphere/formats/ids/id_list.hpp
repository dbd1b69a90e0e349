// Lists of ids in files: one in each line.
#pragma once

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

}  // namespace kinesphere::program
