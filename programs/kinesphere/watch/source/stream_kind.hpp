// Which format a stream has, by its first text.
#pragma once

#include <optional>
#include <string_view>

#include "formats/streams/report_format.hpp"
#include "watch/source/report_source.hpp"

namespace kinesphere::program {

/// Finds out which format a stream has.
class StreamKind {
 public:
  /// `by_arrival`: the clock is this machine's. The references must outlive it.
  StreamKind(const ColumnHints& hints, bool by_arrival, const ReportSource& source)
      : hints_(hints), by_arrival_(by_arrival), source_(source) {}

  /// Returns the format of a stream with this beginning; nothing while more text may tell. `has_ended`: no
  /// more comes. Throws ProgramError for what is no stream of reports.
  std::optional<StreamFormat> of(std::string_view beginning, bool has_ended);
  /// The text begins anew: what came before is lost.
  void begin_again() { examined_ = 0; }

 private:
  std::optional<StreamFormat> of_beginning(std::string_view beginning, bool is_enough) const;
  std::optional<StreamFormat> of_recording(std::string_view beginning,
                                           const std::optional<StreamFormat>& shown) const;
  [[noreturn]] void refuse(std::string_view kind) const;

  const ColumnHints& hints_;
  bool by_arrival_;
  const ReportSource& source_;
  std::size_t examined_ = 0;  ///< bytes in which no sentence of AIS has been found
};

}  // namespace kinesphere::program
