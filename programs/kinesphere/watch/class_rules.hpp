// Classes by the user's word: --class NAME=EXPRESSION and NAME=@FILE.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "columns/row_filter.hpp"
#include "watch/report_format.hpp"
#include "watch/track_classes.hpp"

namespace kinesphere::program {

/// Parses "NAME=EXPRESSION" and "NAME=@FILE", a file with an id at the begin of each line, and adds their
/// classes. Throws ProgramError naming --class or the file.
std::vector<ClassRule> parse_class_rules(const std::vector<std::string>& texts, TrackClasses& classes);

/// Rules for the columns of a table.
class ClassRules {
 public:
  ClassRules() = default;
  /// Throws ProgramError naming --class and what was expected.
  ClassRules(const std::vector<ClassRule>& rules, const TableHead& head, const TableColumns& columns);

  /// Returns the class of the first rule that holds; 0: none.
  std::size_t class_of(std::string_view id, const std::vector<std::string_view>& fields) const;

 private:
  struct Rule {
    std::size_t motion_class = 0;
    std::shared_ptr<const std::unordered_set<std::string>> ids;  ///< null: the expression counts
    RowFilter filter;
  };
  std::vector<Rule> rules_;
};

/// Returns a format without columns whose reports have the class of the first rule that holds. Expressions
/// may name id, category, type, status and speed (m/s) of a report. Throws ProgramError naming --class.
std::unique_ptr<ReportFormat> make_ruled_format(std::unique_ptr<ReportFormat> format,
                                                const std::vector<ClassRule>& rules);

}  // namespace kinesphere::program
