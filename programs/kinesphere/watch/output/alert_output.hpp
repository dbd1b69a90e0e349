// Destinations of the alerts of a watch.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "watch/source/report_source.hpp"
#include "watch/source/stop_signals.hpp"

namespace kinesphere::program {

/// How far alerts have been written to a file.
struct AlertsPlace {
  std::uint64_t bytes = 0;
  std::uint64_t check = 0;  ///< a checksum of the last ones
};

/// Functions throw ProgramError naming the destination that cannot be written to.
class AlertOutput {
 public:
  virtual ~AlertOutput() = default;
  /// Writes one line, with its end, of a share of the pairs.
  virtual void write(std::uint64_t share, std::string_view line) = 0;
  /// Sends the lines since the last flush, which result from the input at `position` of the stream. Returns
  /// when they have left this process.
  virtual void flush(std::uint64_t position) = 0;
  /// Returns when all lines would survive a crash of the machine, and from where a later run has to continue.
  virtual AlertsPlace sync() = 0;
};

/// Writes to standard output.
std::unique_ptr<AlertOutput> make_alert_lines();
/// The alerts of an earlier run, for a run that continues from its snapshot.
struct ToldBefore {
  AlertsPlace place{};
  bool was_here = false;       ///< in the file of this name
  bool is_told_again = false;  ///< true if alerts behind that place will come again
};
/// Writes alerts to a file at once; no other program may write to it meanwhile. Keeps the alerts of an
/// earlier run up to its snapshot and cuts off the rest, which will be written again. Refuses a file with
/// other content. Without an earlier run the file begins empty.
std::unique_ptr<AlertOutput> make_alert_file(const std::string& path,
                                             const std::optional<ToldBefore>& before);

}  // namespace kinesphere::program
