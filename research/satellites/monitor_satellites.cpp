#include "research/satellites/monitor_satellites.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "input/input_check.hpp"

namespace kinesphere {
namespace {

/// ApproachLog collects the events of a monitor as approaches.
class ApproachLog {
 public:
  explicit ApproachLog(double until) : until_(until) {}

  void add(const MonitorEvent& event) {
    if (event.kind != MonitorEventKind::verdict) return;
    if (event.before == Verdict::undecided) watch_.undecided_time += event.time - event.since;
    const std::pair pair(event.first, event.second);
    if (event.verdict == Verdict::within) {
      open_[pair] = watch_.approaches.size();
      watch_.approaches.push_back({.first = static_cast<std::uint32_t>(event.first),
                                   .second = static_cast<std::uint32_t>(event.second),
                                   .begin = event.time,
                                   .end = until_});
    } else if (event.before == Verdict::within) {
      watch_.approaches[open_.at(pair)].end = event.time;
    }
  }

  SatelliteWatch finish(const Monitor& monitor) {
    sort_by_pair(watch_.approaches);
    watch_.counters = monitor.counters();
    for (const OpenPair& pair : monitor.open_pairs())
      if (pair.verdict == Verdict::undecided) watch_.undecided_time += until_ - pair.since;
    return std::move(watch_);
  }

 private:
  double until_;
  SatelliteWatch watch_;
  std::map<std::pair<TrackId, TrackId>, std::size_t> open_;
};

}  // namespace

TrackReport report_of(const Arc& arc, double time, double end) {
  const double ahead = end - time;
  // The plan is the acceleration half-way; until `end` the true one differs from it by at most the largest
  // jerk times half of the time ahead.
  return {.timestamp = time,
          .state = arc.state_at(time),
          .position_error = SatelliteMotion::position_error,
          .velocity_error = SatelliteMotion::velocity_error,
          .plan = TrackReport::Plan{.acceleration = arc.acceleration_at(time + 0.5 * ahead),
                                    .acceleration_limit = 0.5 * ahead * arc.largest_jerk() * (1.0 + 0x1p-40),
                                    .valid_until = end}};
}

Result<SatelliteWatch> monitor_satellites(SatelliteMotion motion, double until, const WatchOptions& options) {
  InputCheck check("monitor_satellites");
  check.positive({"window"}, options.window)
      .require(options.window <= SatelliteMotion::arc_length, ErrorCode::out_of_range, {"window"},
               "must be no longer than an arc,", SatelliteMotion::arc_length, options.window);
  if (check.error()) return *check.error();
  const double window = std::exp2(std::floor(std::log2(options.window)));
  const double acceleration = motion.largest_acceleration();
  auto created = Monitor::create({.classes = {{.acceleration_limit = acceleration}},
                                  .separations = {{0, 0, {Separation::sphere(options.distance)}}},
                                  .tolerance = options.tolerance,
                                  // While two satellites pass the tolerance at the largest relative speed,
                                  // there is time for another report.
                                  .time_resolution = 0.25 * options.tolerance / motion.largest_speed(),
                                  .window = window});
  if (!created) return created.error();
  Monitor& monitor = created.value();

  double largest = 0.0;
  const auto report = [&](TrackId id, double time) {
    const Arc& arc = motion.arc(static_cast<std::uint32_t>(id), time);
    largest = std::max(largest, arc.largest_acceleration());
    // Plans end at the ends of windows.
    return report_of(arc, time, (std::floor(time / window) + 1.0) * window);
  };
  for (std::uint32_t k = 0; k < motion.size(); ++k)
    if (const Result<void> taken = monitor.report(k, report(k, 0.0)); !taken) return taken.error();
  const Poll poll = [&](std::span<const TrackId> ids, double time,
                        std::span<std::optional<TrackReport>> reports) {
    for (std::size_t k = 0; k < ids.size(); ++k) reports[k] = report(ids[k], time);
  };
  ApproachLog log(until);
  for (;;) {
    const auto event = monitor.advance(until, poll);
    if (!event) return event.error();
    if (!*event) break;
    log.add(**event);
  }
  check.require(largest <= acceleration, ErrorCode::out_of_range, {"acceleration"},
                "must be no larger than was promised of all satellites,", acceleration, largest);
  if (check.error()) return *check.error();
  return log.finish(monitor);
}

}  // namespace kinesphere
