// Classes by the user's word: --class NAME=EXPRESSION and NAME=@FILE.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "formats/streams/report_format.hpp"
#include "watch/tracks/track_classes.hpp"

namespace kinesphere::program {

/// Parses "NAME=EXPRESSION" and "NAME=@FILE", a file with an id at the begin of each line, and adds their
/// classes. Throws ProgramError naming --class or the file.
std::vector<ClassRule> parse_class_rules(const std::vector<std::string>& texts, TrackClasses& classes);

/// Returns a format whose reports have the class of the first rule that holds. Expressions may name the
/// columns of a table; of other formats id, category, type, status and speed (m/s) of a report. Throws
/// ProgramError naming --class, for a table with its first row.
std::unique_ptr<ReportFormat> make_ruled_format(std::unique_ptr<ReportFormat> format,
                                                const std::vector<ClassRule>& rules, bool is_table);

}  // namespace kinesphere::program
