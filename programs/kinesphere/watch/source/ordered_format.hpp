// Reports of a file in which those of one track stand behind those of another, in the order of their times.
#pragma once

#include <memory>
#include <string>

#include "formats/streams/report_format.hpp"

namespace kinesphere::program {

/// A format that may keep reports back.
class OrderedFormat : public ReportFormat {
 public:
  /// True while all reports so far are kept back: a run that begins later has to read them again.
  virtual bool keeps_all() const = 0;
};

/// Returns a format that passes the reports of `format` on. Those of the first track are kept back until
/// another one reports. If that report is far behind, the file is grouped by id: then all reports are kept
/// back, and passed on by finish(), in the order of their times. It passes at once what has times of arrival,
/// and what is more than some hundred thousand reports. `source`: its name, for the warning.
std::unique_ptr<OrderedFormat> make_ordered_format(std::unique_ptr<ReportFormat> format,
                                                   const std::string& source);

}  // namespace kinesphere::program
