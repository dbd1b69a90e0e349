// The clock of a watch: lets reports pass once their times are believed.
#include "watch/clock/report_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace kinesphere::program {
namespace {

/// Maximum reports held until their times are accepted. A document of all aircraft on earth has fewer.
constexpr std::size_t most_held = 65536;

}  // namespace

ReportClock::ReportClock(const WatchSettings& settings, WatchCounts& counts, Next& next)
    : settings_(settings),
      counts_(counts),
      next_(next),
      clock_(settings.clock == WatchSettings::Clock::stamps ? StreamClock::Source::stamps
                                                            : StreamClock::Source::arrivals,
             settings.leap),
      is_chosen_(settings.clock != WatchSettings::Clock::stream) {}

/// Decides, once, what the clock goes by where no option says it.
void ReportClock::choose(bool has_arrivals) {
  if (std::exchange(is_chosen_, true)) return;
  clock_.set_source(has_arrivals ? StreamClock::Source::arrivals : StreamClock::Source::stamps);
}

void ReportClock::take(const SourceReport& report) {
  choose(report.arrival.has_value());
  // The caller sets the machine's clock before it passes a record.
  if (settings_.clock == WatchSettings::Clock::machine) return pass(report);
  if (!goes_by_stamps() && !report.arrival)
    return next_.refuse(
        fmt::format("expected a time of arrival of {}, as reports before had one", report.id));
  const FileTime& time = time_of(report);
  if (clock_.believes(time)) {
    drop_held();
    go_on(time);
    return pass(report);
  }
  const bool confirmed = clock_.confirms(time, std::string(report.id), next_.has_several_tracks());
  hold(report);
  if (!confirmed) return;
  start(time, report.time_kind);
  pass_held();
}

void ReportClock::time_is(const FileTime& arrival, TimeKind kind) {
  if (settings_.clock != WatchSettings::Clock::stream) return;
  choose(true);
  if (goes_by_stamps()) return;
  if (clock_.believes(arrival)) {
    drop_held();
    return go_on(arrival);
  }
  const bool confirmed = clock_.confirms(arrival, "", true);
  if (clock_.in_a_row() == 1) drop_held();
  if (!confirmed) return;
  start(arrival, kind);
  pass_held();
}

void ReportClock::machine_time_is(const FileTime& now) {
  if (!clock_.has_begun()) start(now, TimeKind::number);
  go_on(now);
}

void ReportClock::finish() {
  // A stream may be too short for its times to confirm each other.
  if (!clock_.has_begun() && !held_.empty()) {
    const SourceReport& first = held_.front().report;
    start(time_of(first), first.time_kind);
    pass_held();
  }
  drop_held();
}

void ReportClock::hold(const SourceReport& report) {
  if (clock_.in_a_row() == 1) drop_held();
  if (held_.size() < most_held)
    held_.push_back(KeptReport::of(report));
  else
    ++counts_.ahead;
}

void ReportClock::drop_held() {
  counts_.ahead += held_.size();
  held_.clear();
}

void ReportClock::pass_held() {
  clock_.interrupt();
  for (KeptReport& held : std::exchange(held_, {})) {
    if (!clock_.is_confirmed(time_of(held.report))) {
      ++counts_.ahead;
      continue;
    }
    go_on(time_of(held.report));
    pass(held.get());
  }
}

void ReportClock::start(const FileTime& time, TimeKind kind) {
  if (clock_.has_begun()) return go_on(held_.empty() ? time : time_of(held_.front().report));
  FileTime first = time;
  for (const KeptReport& held : held_) first = std::min(first, time_of(held.report), is_earlier);
  begin_times(first, kind);
  clock_.go_on(first);
}

void ReportClock::begin_times(const FileTime& first, TimeKind kind) {
  // Sufficient for years.
  constexpr std::int64_t span = std::int64_t{1} << 20;
  times_ = TimeScale(kind);
  times_.set_origin(first, {first.whole + span, 0.0});
  first_ = first;
}

void ReportClock::go_on(const FileTime& time) {
  clock_.interrupt();
  clock_.go_on(time);
  next_.go_on();
}

/// Delivers a report that is neither too old nor ahead.
void ReportClock::pass(const SourceReport& report) {
  const double age = age_of(report.stamp);
  if (age > settings_.forget)
    ++counts_.stale;
  else if (-age > settings_.leap)
    ++counts_.ahead;
  else
    next_.deliver(report);
}

}  // namespace kinesphere::program
