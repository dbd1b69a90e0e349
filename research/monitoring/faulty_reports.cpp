#include "research/monitoring/faulty_reports.hpp"

#include <algorithm>

namespace kinesphere {
namespace {

RandomForces motion_of(const FaultySettings& settings, Random& random) {
  std::vector<State> start(settings.tracks);
  for (State& state : start)
    state = {{random.uniform(0.0, settings.width), random.uniform(0.0, settings.width),
              random.uniform(0.0, settings.height)},
             settings.speed * random.point_in_ball()};
  return RandomForces::create({.start = start,
                               .acceleration_limits = std::vector(settings.tracks, settings.acceleration),
                               .interval = 2.0,
                               .seed = settings.seed})
      .value();
}

/// Good reports made between two wrong ones, and after a gap. Fewer would let wrong reports arrive next to
/// each other, as good reports overtake each other.
constexpr std::uint32_t good_between = 9;

}  // namespace

FaultyReports::FaultyReports(const FaultySettings& settings)
    : settings_(settings), random_(settings.seed), motion_(motion_of(settings, random_)) {
  for (std::uint32_t track = 0; track < settings_.tracks; ++track) {
    clocks_.push_back(settings_.clock_error * random_.uniform(-1.0, 1.0));
    good_.push_back(0);
    due_.push({settings_.interval * random_.uniform(0.0, 1.0), track});
  }
}

Delivery FaultyReports::next() {
  while (waiting_.empty() || due_.top().time <= waiting_.top().delivery.time) {
    const Due due = due_.top();
    due_.pop();
    make_report(due.time, due.track);
    double pause = settings_.interval * random_.uniform(0.5, 1.5);
    if (random_.uniform() < settings_.gaps) {
      ++counts_.gaps;
      good_[due.track] = 0;
      pause += settings_.interval * random_.uniform(20.0, 40.0);
    }
    due_.push({due.time + pause, due.track});
  }
  const Delivery delivery = waiting_.top().delivery;
  waiting_.pop();
  ++counts_.reports;
  return delivery;
}

void FaultyReports::make_report(double time, std::uint32_t track) {
  TrackReport report{.timestamp = time + clocks_[track], .state = motion_.state(track, time)};
  report.position_error = settings_.position_error;
  report.velocity_error = settings_.velocity_error;
  report.timestamp_error = settings_.clock_error;
  report.state.position += settings_.position_error * random_.point_in_ball();
  report.state.velocity += settings_.velocity_error * random_.point_in_ball();
  const auto may_be_wrong = [this](std::uint32_t id) { return good_[id] >= good_between; };
  // A wrong report is delivered at once; delayed, it could arrive between other wrong ones.
  const double fate = random_.uniform();
  if (fate < settings_.outliers && may_be_wrong(track)) {
    ++counts_.outliers;
    good_[track] = 0;
    report.state.position += random_.uniform(500.0, 5000.0) * random_.unit_vector();
    return send(time, track, report);
  }
  if (fate > 1.0 - settings_.swapped) {
    const auto other = static_cast<std::uint32_t>(random_.uniform(0.0, settings_.tracks));
    // A swapped report near the other track could not be detected.
    if (may_be_wrong(other) && norm(motion_.state(other, time).position - report.state.position) > 500.0) {
      ++counts_.swapped;
      good_[other] = 0;
      return send(time, other, report);
    }
  }
  ++good_[track];
  const double arrival = time + settings_.delay * random_.uniform();
  send(arrival, track, report);
  if (random_.uniform() < settings_.repeated) {
    ++counts_.repeated;
    send(arrival + settings_.delay * random_.uniform(), track, report);
  }
}

void FaultyReports::send(double time, TrackId id, const TrackReport& report) {
  waiting_.push({{time, id, report}, made_++});
}

}  // namespace kinesphere
