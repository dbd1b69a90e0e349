#include "research/monitoring/soak.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "research/measures/peak_memory.hpp"

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

std::uint64_t key(std::uint64_t a, std::uint64_t b) { return std::min(a, b) << 32 | std::max(a, b); }

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

VerdictCheck::VerdictCheck(const FaultySettings& settings, const RandomForces& motion, double distance,
                           double tolerance)
    // near_ is below the distance, and far_ above the distance and the tolerance, by more than the world's
    // tolerances.
    : near_(distance - margin),
      far_(distance + tolerance + margin),
      begin_(2.0 * settings.interval + settings.delay),
      motion_(motion.clone()),
      world_(World::create({.contact_tolerance = 1e-4 * margin}).value()) {
  world_.set_sensor(0, {.distances = {far_, near_}}).value();
  for (std::uint32_t track = 0; track < settings.tracks; ++track) {
    BodyDefinition body = motion_->definition(track, 0.0);
    body.radius = 0.0;
    body.solid = false;
    body.user_data = track;
    world_.add(body).value();
  }
}

void VerdictCheck::compare(double until, std::span<const MonitorEvent> reported) {
  auto next = reported.begin();
  const auto take_reported = [&](double time) {
    for (; next != reported.end() && next->time <= time; ++next) take(*next);
  };
  const auto probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = motion_->state(ids[k].index, time);
  };
  for (const Event& event : world_.events(until, probe)) {
    take_reported(event.time);
    take(event);
  }
  take_reported(until);
}

/// Counts an approach, as missed if the pair is not reported yet. A pair has to stay reported until it has
/// parted.
void VerdictCheck::approach(std::uint64_t pair, double time) {
  if (time < begin_) return;
  ++counts_.approaches;
  if (!verdicts_.contains(pair)) ++counts_.missed;
}

void VerdictCheck::begin() {
  if (begun_) return;
  begun_ = true;
  for (const std::uint64_t pair : truly_near_) approach(pair, begin_);
}

void VerdictCheck::take(const Event& event) {
  const std::uint64_t pair = key(event.first_user_data, event.second_user_data);
  const bool enters = event.kind == EventKind::sensor_enter;
  if (event.time >= begin_) begin();
  if (event.distance == near_) {
    if (enters) {
      truly_near_.insert(pair);
      approach(pair, event.time);
    } else {
      truly_near_.erase(pair);
    }
  } else if (enters) {
    truly_within_.insert(pair);
  } else {
    truly_within_.erase(pair);
    const auto verdict = verdicts_.find(pair);
    if (verdict != verdicts_.end() && verdict->second == Verdict::within) ++counts_.wrongly_within;
  }
}

void VerdictCheck::take(const MonitorEvent& event) {
  if (event.kind != MonitorEventKind::verdict) return;
  const std::uint64_t pair = key(event.first, event.second);
  if (event.before == Verdict::apart) ++counts_.warnings;
  if (event.verdict == Verdict::apart) {
    verdicts_.erase(pair);
    if (begun_ && truly_near_.contains(pair)) ++counts_.missed;
    return;
  }
  verdicts_[pair] = event.verdict;
  if (event.verdict == Verdict::within && !truly_within_.contains(pair)) ++counts_.wrongly_within;
}

Soak soak(const SoakSettings& settings, const std::function<void(std::uint64_t)>& progress) {
  using Clock = std::chrono::steady_clock;
  FaultyReports reports(settings.faults);
  VerdictCheck check(settings.faults, reports.motion(), settings.distance, settings.tolerance);
  Monitor monitor = Monitor::create({.classes = {reports.promise()},
                                     .separations = {{0, 0, {Separation::sphere(settings.distance)}}},
                                     .tolerance = settings.tolerance,
                                     .window = settings.faults.interval,
                                     .stale_after = 10.0 * settings.faults.interval,
                                     .drop_after = 1000.0 * settings.faults.interval})
                        .value();
  Soak result;
  std::vector<MonitorEvent> reported;
  constexpr std::uint64_t at_once = 1024;
  std::vector<Delivery> deliveries(at_once);
  for (std::uint64_t taken = 0; taken < settings.reports; taken += at_once) {
    for (Delivery& delivery : deliveries) delivery = reports.next();
    const Clock::time_point begin = Clock::now();
    for (const Delivery& delivery : deliveries) {
      for (const MonitorEvent& event : monitor.events(delivery.time)) reported.push_back(event);
      monitor.report(delivery.track, delivery.report).value();
    }
    for (const MonitorEvent& event : monitor.events(monitor.time())) reported.push_back(event);
    result.monitor_seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    check.compare(monitor.time(), reported);
    reported.clear();
    if (result.memory_early == 0 && 4 * taken >= settings.reports) result.memory_early = peak_memory();
    if (progress && taken % (64 * at_once) == 0) progress(taken);
  }
  result.faults = reports.counts();
  result.counters = monitor.counters();
  result.time = monitor.time();
  result.verdicts = check.counts();
  result.memory = peak_memory();
  result.open = monitor.open_pairs().size();
  return result;
}

}  // namespace kinesphere
