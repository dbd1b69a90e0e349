// Tables in text files: whatever separates their columns, with or without a header.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinesphere::program {

struct TextTable {
  struct Row {
    int line;  ///< from 1
    std::vector<std::string_view> fields;
  };

  std::string file;
  std::vector<std::string_view> comments;   ///< lines that begin with #, without it
  std::vector<std::string_view> header;     ///< names of the columns; empty when the file has none
  std::vector<Row> rows;                    ///< all as long as the first
  std::shared_ptr<const std::string> text;  ///< what all of these point into
};

/// The separator is the first of ; , tab that the first line without # has, else blanks. That line is the
/// header when no field of it is a number; without one, the last comment is when it has as many words as
/// there are columns. Throws ProgramError naming file and line when a row has more or fewer fields than the
/// first, and when there is no row at all.
TextTable parse_table(std::string text, const std::string& file);

/// The number that `field` is, all of it, when it is one and finite.
std::optional<double> parse_number(std::string_view field);

}  // namespace kinesphere::program
