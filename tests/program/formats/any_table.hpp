// Reads any bytes as a file of tracks, for fuzz_tables and for a test with damaged files.
#pragma once

#include <optional>
#include <string>

namespace kinesphere::program {

struct AnyTable {
  bool was_read = false;  ///< else it was refused
  /// What is wrong with the outcome, if anything: it has to be tracks of at least two samples in the order of
  /// their times, or an error of one line that names the file.
  std::optional<std::string> complaint{};
};

/// Reads a text as a file; `choice` chooses the options.
AnyTable read_any_table(const std::string& text, unsigned choice);

}  // namespace kinesphere::program
