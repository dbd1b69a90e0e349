// Where the alerts of a watch go.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "watch/report_source.hpp"
#include "watch/stop_signals.hpp"

namespace kinesphere::program {

/// How far alerts have been written to a file.
struct AlertsPlace {
  std::uint64_t bytes = 0;
  std::uint32_t check = 0;  ///< a checksum of the last ones
};

/// Functions throw ProgramError naming the place that cannot be written to.
class AlertOutput {
 public:
  virtual ~AlertOutput() = default;
  /// One line with its end, of a share of the pairs.
  virtual void write(std::uint64_t share, std::string_view line) = 0;
  /// All of this, and nothing before, came of what stands at `position` of the stream. Returns when it is
  /// out.
  virtual void flush(std::uint64_t position) = 0;
  /// Returns when all of it would outlive the machine: from where a later run is to go on.
  virtual AlertsPlace sync() = 0;
};

/// Standard output.
std::unique_ptr<AlertOutput> make_alert_lines();
/// What an earlier run has told, for one that goes on from its snapshot.
struct ToldBefore {
  AlertsPlace place{};
  bool was_here = false;       ///< in the file of this name
  bool is_told_again = false;  ///< what came behind that place
};
/// A file that is written as alerts come, and to which no other program may write meanwhile. Nothing of an
/// earlier run is lost: what will be told again is cut off, and a file with something else is refused.
/// Without an earlier run it begins empty.
std::unique_ptr<AlertOutput> make_alert_file(const std::string& path,
                                             const std::optional<ToldBefore>& before);

}  // namespace kinesphere::program
