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

/// Functions throw ProgramError naming the place that cannot be written to.
class AlertOutput {
 public:
  virtual ~AlertOutput() = default;
  /// One line with its end, of a share of the pairs.
  virtual void write(std::uint64_t share, std::string_view line) = 0;
  /// All of this, and nothing before, came of what was read up to `position` of the stream. Returns when it
  /// is out.
  virtual void flush(std::uint64_t position) = 0;
  /// Returns when all of it would outlive the machine: how many bytes a later run, which goes on from here,
  /// is to keep.
  virtual std::uint64_t sync() = 0;
};

/// Standard output.
std::unique_ptr<AlertOutput> make_alert_lines();
/// A file that is written as alerts come. Of what it has, `kept` bytes are kept: those of an earlier run.
std::unique_ptr<AlertOutput> make_alert_file(const std::string& path, std::uint64_t kept);

}  // namespace kinesphere::program
