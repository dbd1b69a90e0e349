// A watch: takes the reports of a stream and emits certain alerts.
#include "watch/watcher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/streams/known_names.hpp"

namespace kinesphere::program {
namespace {

/// Maximum reports held until their times are accepted. A document of all aircraft on earth has fewer.
constexpr std::size_t most_held = 65536;

}  // namespace

Watcher::Watcher(WatchSettings settings, AlertFn alert)
    : settings_(std::move(settings)),
      alert_(std::move(alert)),
      policy_(settings_.kinds, settings_.most_alerts),
      clock_(settings_.clock == WatchSettings::Clock::stamps ? StreamClock::Source::stamps
                                                             : StreamClock::Source::arrivals,
             settings_.leap),
      clock_is_chosen_(settings_.clock != WatchSettings::Clock::stream) {
  counts_.turns.resize(settings_.separations.size());
}

void Watcher::take(const SourceReport& report) {
  if (settings_.ids.is_empty()) return take_of_body(report);
  const auto body = settings_.ids.name_of(report.id);
  if (!body) return pass_over(Passed::filtered);
  SourceReport of_body = report;
  of_body.id = *body;
  take_of_body(of_body);
}

void Watcher::take_of_body(const SourceReport& report) {
  if (!clock_is_chosen_) {
    clock_is_chosen_ = true;
    clock_.set_source(report.arrival ? StreamClock::Source::arrivals : StreamClock::Source::stamps);
  }
  // The caller sets the machine's clock before it passes a record.
  if (settings_.clock == WatchSettings::Clock::machine) return deliver(report);
  const bool by_arrival = clock_.source() == StreamClock::Source::arrivals;
  if (by_arrival && !report.arrival)
    return refuse(fmt::format("expected a time of arrival of {}, as reports before had one", report.id));
  const FileTime& time = clock_time(report);
  if (!clock_.believes(time)) {
    const bool confirmed = clock_.confirms(time, std::string(report.id), names_.size() > 1);
    hold(report);
    if (confirmed) {
      start(time, report.time_kind);
      deliver_held();
    }
    return;
  }
  drop_held();
  go_on(time);
  deliver(report);
}

void Watcher::time_is(const FileTime& arrival, TimeKind kind) {
  if (settings_.clock != WatchSettings::Clock::stream) return;
  if (!clock_is_chosen_) {
    clock_is_chosen_ = true;
    clock_.set_source(StreamClock::Source::arrivals);
  }
  if (clock_.source() != StreamClock::Source::arrivals) return;
  if (clock_.believes(arrival)) {
    drop_held();
    go_on(arrival);
  } else {
    const bool confirmed = clock_.confirms(arrival, "", true);
    if (clock_.in_a_row() == 1) drop_held();
    if (confirmed) {
      start(arrival, kind);
      deliver_held();
    }
  }
}

void Watcher::machine_time_is(const FileTime& now) {
  if (!clock_.has_begun()) start(now, TimeKind::number);
  go_on(now);
}

void Watcher::pass_over(Passed reason) {
  ++(reason == Passed::no_position ? counts_.no_position
     : reason == Passed::no_bound  ? counts_.no_bound
                                   : counts_.filtered);
}

void Watcher::refuse(std::size_t line, const std::string& reason) {
  constexpr std::size_t most_told = 10;
  ++counts_.malformed;
  const bool is_too_much = counts_.malformed > settings_.most_malformed;
  if (counts_.first_malformed.size() == most_told && !is_too_much) return;
  const std::string text = without_controls(reason);
  if (counts_.first_malformed.size() < most_told) counts_.first_malformed.push_back({line, text});
  if (is_too_much)
    throw ProgramError(fmt::format("{}:{}: {}; that makes {} malformed, and --most-malformed allows {}",
                                   settings_.source, line, text, counts_.malformed,
                                   settings_.most_malformed));
}

void Watcher::end_record() {
  if (monitor_) advance(monitor_->time());
}

void Watcher::finish() {
  // A stream may be too short for its times to confirm each other.
  if (!clock_.has_begun() && !held_.empty()) {
    const SourceReport& first = held_.front().report;
    start(clock_time(first), first.time_kind);
    deliver_held();
  }
  drop_held();
  end_record();
  write_refused(std::numeric_limits<double>::infinity());
}

void Watcher::hold(const SourceReport& report) {
  if (!monitor_ && settings_.has_automatic_classes) settings_.classes.begin(report.sayable);
  if (clock_.in_a_row() == 1) drop_held();
  if (held_.size() == most_held) {
    ++counts_.ahead;
    return;
  }
  held_.push_back({std::string(report.id), std::string(shown_name(report.name)), report});
}

void Watcher::drop_held() {
  if (held_.empty()) return;
  counts_.ahead += held_.size();
  held_.clear();
}

void Watcher::deliver_held() {
  clock_.interrupt();
  std::vector<HeldReport> reports = std::move(held_);
  held_.clear();
  for (HeldReport& held : reports) {
    if (!clock_.is_confirmed(clock_time(held.report))) {
      ++counts_.ahead;
      continue;
    }
    held.report.id = held.id;
    held.report.name = held.name;
    go_on(clock_time(held.report));
    deliver(held.report);
  }
}

void Watcher::start(const FileTime& time, TimeKind kind) {
  if (!clock_.has_begun()) {
    FileTime first = time;
    for (const HeldReport& held : held_) first = std::min(first, clock_time(held.report), is_earlier);
    begin_times(first, kind);
    clock_.go_on(first);
    return;
  }
  go_on(held_.empty() ? time : clock_time(held_.front().report));
}

void Watcher::begin_times(const FileTime& first, TimeKind kind) {
  // Sufficient for years.
  constexpr std::int64_t span = std::int64_t{1} << 20;
  times_ = TimeScale(kind);
  times_.set_origin(first, {first.whole + span, 0.0});
  first_ = first;
  first_time_ = times_.seconds(first);
}

void Watcher::go_on(const FileTime& time) {
  clock_.interrupt();
  clock_.go_on(time);
  if (!monitor_) return;
  const double now = std::max(monitor_->time(), times_.seconds(clock_.now()));
  give_up_until(now);
  advance(now);
  if (monitor_->time() < next_forgetting_) return;
  next_forgetting_ = monitor_->time() + settings_.forget;
  if (bodies_) bodies_->forget_before(monitor_->time() - settings_.forget);
  for (const TrackGroups::Cell& group : groups_->forget_before(monitor_->time() - settings_.forget))
    end_group(group);
}

void Watcher::advance(double until) {
  for (;;) {
    const auto event = require(monitor_->advance(until));
    if (!event) return;
    report(*event);
    drop_crowd();
  }
}

bool Watcher::has_room() const {
  // The other half is reserved for watched tracks that approach each other.
  return names_.size() < settings_.most_tracks && monitor_->open_pair_count() < settings_.most_pairs / 2 + 1;
}

void Watcher::drop_crowd() {
  if (monitor_->open_pair_count() <= settings_.most_pairs) return;
  for (const TrackId id : monitor_->crowd(settings_.most_pairs / 2)) {
    remove(id, {"crowd"});
    ++counts_.dropped;
  }
}

void Watcher::remove(TrackId track, const LeftFor& left_for) {
  require(monitor_->remove(track));
  removed_.insert_or_assign(track, left_for);
}

}  // namespace kinesphere::program
