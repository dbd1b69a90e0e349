// A report that is kept for later.
#pragma once

#include <string>

#include "formats/streams/known_names.hpp"
#include "formats/streams/source_report.hpp"

namespace kinesphere::program {

/// Holds the id and the name of a report, which are valid during a call alone. Its other texts are left out.
struct KeptReport {
  std::string id, name;
  SourceReport report;

  static KeptReport of(const SourceReport& report) {
    KeptReport kept{std::string(report.id), std::string(shown_name(report.name)), report};
    kept.report.row = nullptr;
    kept.report.category = kept.report.craft_type = kept.report.status = {};
    return kept;
  }
  /// Returns the report, valid as long as this.
  const SourceReport& get() {
    report.id = id;
    report.name = name;
    return report;
  }
};

}  // namespace kinesphere::program
